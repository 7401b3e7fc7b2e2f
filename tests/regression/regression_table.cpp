// Runs the scenes of scenes.csv and compares their invariants with table.csv.
//   regression_table [SCENE...]  says what deviates and by how many tolerances
#include "quantities.hpp"
#include "table.hpp"

#include <ddacontact/core/types.hpp>
#include <polyfem/assembly/blas.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace {

using namespace regression;
using ddacontact::Error;

const std::filesystem::path directory = POLYDDA_REGRESSION;

/// Compares the rows of a scene with its numbers, and says where they differ.
bool agrees(const std::string& scene, const Measured& measured, const std::vector<Row>& table) {
  int rows = 0, deviations = 0;
  for (const Row& row : table) {
    if (row.scene != scene) continue;
    ++rows;
    const auto found = measured.find(row.quantity);
    if (found == measured.end()) {
      fmt::print("{}: {} is in the table and not computed\n", scene, row.quantity);
      ++deviations;
      continue;
    }
    const double deviation = row.deviation(found->second);
    if (deviation <= 1) continue;
    fmt::print("{}: {} is {:.9g}, {} {:.9g} {}: {:.3g} times what it may deviate\n", scene, row.quantity,
               found->second, row.expectation == Expectation::known ? "known" : "at most", row.value,
               row.unit, deviation);
    ++deviations;
  }
  fmt::print("{}: {} of {} numbers as expected\n", scene, rows - deviations, rows);
  return rows > 0 && deviations == 0;
}

/// A scene that the list does not have is a slip of the pen.
void require_listed(const std::string& name, const std::vector<ListedScene>& scenes) {
  if (std::ranges::none_of(scenes, [&](const ListedScene& scene) { return scene.name == name; }))
    throw Error("scenes.csv has no scene \"" + name + "\"");
}

int run(const std::vector<std::string>& names) {
  const std::vector<ListedScene> scenes = read_scene_list(directory / "scenes.csv");
  const std::vector<Row> table = read_table(directory / "table.csv");
  for (const std::string& name : names) require_listed(name, scenes);
  for (const Row& row : table) require_listed(row.scene, scenes);
  bool all_agree = true;
  for (const ListedScene& scene : scenes) {
    if (!names.empty() && std::ranges::find(names, scene.name) == names.end()) continue;
    try {
      if (!agrees(scene.name, measure(scene), table)) all_agree = false;
    } catch (const Error& error) {
      fmt::print("{}: {}\n", scene.name, error.what());
      all_agree = false;
    }
  }
  return all_agree ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    polyfem::pin_blas_to_one_thread();
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "regression_table: error: {}\n", error.what());
    return 2;
  }
}
