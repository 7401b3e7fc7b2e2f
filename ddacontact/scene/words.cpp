#include <ddacontact/scene/words.hpp>

namespace ddacontact::scene_format {

const std::vector<Word<Preset>>& words_of(Preset) {
  static const std::vector<Word<Preset>> words{{"default", Preset::standard}, {"paper", Preset::paper}};
  return words;
}

const std::vector<Word<Mode>>& words_of(Mode) {
  static const std::vector<Word<Mode>> words{{"dynamic", Mode::dynamic}, {"static", Mode::statics}};
  return words;
}

const std::vector<Word<Plane>>& words_of(Plane) {
  static const std::vector<Word<Plane>> words{{"strain", Plane::strain}, {"stress", Plane::stress}};
  return words;
}

const std::vector<Word<BlockModel>>& words_of(BlockModel) {
  static const std::vector<Word<BlockModel>> words{{"auto", BlockModel::automatic},
                                                   {"wachspress", BlockModel::wachspress},
                                                   {"mean_value", BlockModel::mean_value},
                                                   {"affine", BlockModel::affine},
                                                   {"mesh", BlockModel::mesh}};
  return words;
}

const std::vector<Word<CellKind>>& words_of(CellKind) {
  static const std::vector<Word<CellKind>> words{
      {"auto", CellKind::by_shape}, {"voronoi", CellKind::voronoi}, {"quads", CellKind::quads}};
  return words;
}

const std::vector<Word<Kinematics>>& words_of(Kinematics) {
  static const std::vector<Word<Kinematics>> words{{"corotational", Kinematics::corotational},
                                                   {"incremental", Kinematics::incremental}};
  return words;
}

const std::vector<Word<Scheme>>& words_of(Scheme) {
  static const std::vector<Word<Scheme>> words{
      {"decaying", Scheme::decaying}, {"explicit", Scheme::central_difference},
      {"midpoint", Scheme::midpoint}, {"dda", Scheme::dda},
      {"newmark", Scheme::newmark},   {"backward_euler", Scheme::backward_euler}};
  return words;
}

const std::vector<Word<ContactMethod>>& words_of(ContactMethod) {
  static const std::vector<Word<ContactMethod>> words{{"staged", ContactMethod::staged},
                                                      {"classic", ContactMethod::classic}};
  return words;
}

const std::vector<Word<Interpolation>>& words_of(Interpolation) {
  static const std::vector<Word<Interpolation>> words{{"linear", Interpolation::linear},
                                                      {"smooth", Interpolation::smooth}};
  return words;
}

const std::vector<Word<Axes>>& words_of(Axes) {
  static const std::vector<Word<Axes>> words{{"xy", Axes::xy}, {"x", Axes::x}, {"y", Axes::y}};
  return words;
}

const std::vector<Word<Load::Kind>>& words_of(Load::Kind) {
  static const std::vector<Word<Load::Kind>> words{
      {"point", Load::Kind::point}, {"pressure", Load::Kind::pressure}, {"body", Load::Kind::body}};
  return words;
}

const std::vector<Word<RockBolt::Kind>>& words_of(RockBolt::Kind) {
  static const std::vector<Word<RockBolt::Kind>> words{{"anchored", RockBolt::Kind::anchored},
                                                       {"grouted", RockBolt::Kind::grouted}};
  return words;
}

const std::vector<Word<SliverPolicy>>& words_of(SliverPolicy) {
  static const std::vector<Word<SliverPolicy>> words{
      {"merge", SliverPolicy::merge}, {"keep", SliverPolicy::keep}, {"refuse", SliverPolicy::refuse}};
  return words;
}

const std::vector<Word<TVertices>>& words_of(TVertices) {
  static const std::vector<Word<TVertices>> words{{"drop", TVertices::drop}, {"keep", TVertices::keep}};
  return words;
}

const std::vector<Word<std::string>>& field_words() {
  static const std::vector<Word<std::string>> words{{"displacement", "displacement"},
                                                    {"velocity", "velocity"},
                                                    {"stress", "stress"},
                                                    {"principal", "principal"}};
  return words;
}

}  // namespace ddacontact::scene_format
