#include <ddacontact/scene/scene.hpp>

namespace ddacontact {

std::string Scene::block_name(int block) const {
  const std::string& name = blocks[block].name;
  return name.empty() ? std::to_string(block) : name;
}

}  // namespace ddacontact
