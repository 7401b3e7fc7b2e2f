#include <ddacontact/output/block_field.hpp>

namespace ddacontact {

const std::vector<BlockField>& block_fields() {
  static const std::vector<BlockField> fields = {
      {"rotation", "rad", [](const Stepper& stepper, int b) { return stepper.state().rotation[b]; }}};
  return fields;
}

}  // namespace ddacontact
