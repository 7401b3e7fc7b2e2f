#include <ddacontact/scene/block_copies.hpp>
#include <ddacontact/scene/complete_document.hpp>
#include <ddacontact/scene/domain_blocks.hpp>
#include <ddacontact/scene/geometry_file.hpp>
#include <ddacontact/scene/history_file.hpp>
#include <ddacontact/scene/initial_stress.hpp>
#include <ddacontact/scene/selectors.hpp>
#include <ddacontact/scene/snap_blocks.hpp>

namespace ddacontact::scene_format {

bool complete_document(const std::filesystem::path& directory, Document& document, ProblemList& problems) {
  const bool has_geometry = add_geometry(directory, document, problems);
  const bool has_domain = add_domain(directory, document, problems);
  add_copies(document, problems);
  snap_blocks(document, problems);
  put_initial_stress(document);
  const bool has_histories = read_histories(directory, document, problems);
  expand_selectors(document, problems);
  return has_geometry && has_domain && has_histories;
}

}  // namespace ddacontact::scene_format
