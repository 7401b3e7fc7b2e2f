#include <ddacontact/scene/block_copies.hpp>

#include <utility>

namespace ddacontact::scene_format {

namespace {

BlockRecord copy_of(const BlockRecord& block, int column, int row) {
  const GridRecord& grid = *block.grid;
  BlockRecord copy = block;
  copy.grid.reset();
  if (block.name) copy.name = *block.name + '.' + std::to_string(column) + '.' + std::to_string(row);
  const double shift = row % 2 == 1 ? grid.bond : 0;
  copy.vertices.points.colwise() += Vec2((column + shift) * grid.step.x(), row * grid.step.y());
  return copy;
}

}  // namespace

void add_copies(Document& document, ProblemList& problems) {
  std::vector<BlockRecord> all;
  all.reserve(document.blocks.size());
  for (BlockRecord& block : document.blocks) {
    if (!block.grid || !block.locations.good("grid") || !block.locations.good("vertices")) {
      all.push_back(std::move(block));
      continue;
    }
    const auto [columns, rows] = block.grid->count;
    if (static_cast<double>(columns) * rows > most_copies) {
      problems.error(block.locations.of("grid"),
                     "'grid' makes " + std::to_string(std::int64_t{columns} * rows) + " blocks",
                     "at most " + std::to_string(most_copies));
      all.push_back(std::move(block));
      continue;
    }
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) all.push_back(copy_of(block, column, row));
  }
  document.blocks = std::move(all);
}

}  // namespace ddacontact::scene_format
