#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/text.hpp>

#include <cmath>

namespace ddacontact::scene_format {

std::string Bounds::text() const {
  std::string text;
  if (std::isfinite(low)) text = (with_low ? ">= " : "> ") + short_number(low);
  if (std::isfinite(high))
    text += (text.empty() ? "" : " and ") + std::string(with_high ? "<= " : "< ") + short_number(high);
  return text;
}

}  // namespace ddacontact::scene_format
