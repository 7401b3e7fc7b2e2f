#include <ddacontact/page/page_frame.hpp>

#include <ddacontact/picture/field.hpp>

namespace ddacontact {

PageArrays arrays_of(const Frame& frame) {
  return {holds(frame, Field::displacement), holds(frame, Field::velocity), holds(frame, Field::s1)};
}

PageFrame page_frame(Frame frame) {
  PageFrame shown{std::move(frame), {}};
  if (!arrays_of(shown.frame).stress) return shown;
  for (int c = 0; c < shown.frame.n_cells(); ++c) shown.stress.push_back(fit_stress(shown.frame, c));
  return shown;
}

}  // namespace ddacontact
