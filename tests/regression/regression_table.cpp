// Runs the scenes of scenes.csv and compares their invariants with table.csv.
//   regression_table [SCENE...]          compares; says what deviates and by how many tolerances
//   regression_table --write [SCENE...]  writes what is computed anew; what is known stays
#include "quantities.hpp"

#include <ddacontact/core/types.hpp>
#include <polyfem/assembly/blas.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace {

using namespace regression;
using ddacontact::Error;

const std::filesystem::path directory = POLYDDA_REGRESSION;

bool is_same(const Row& a, const Row& b) {
  return a.scene == b.scene && a.quantity == b.quantity &&
         (a.expectation == Expectation::known) == (b.expectation == Expectation::known);
}

/// Compares the rows of a scene with its numbers, and says where they differ.
bool agrees(const ListedScene& scene, const std::vector<Measured>& measured, const std::vector<Row>& table) {
  int deviations = 0;
  double worst = 0;
  std::string where;
  for (const Measured& one : measured)
    if (std::none_of(table.begin(), table.end(), [&](const Row& row) { return is_same(row, one.row); })) {
      fmt::print("{}: {} is not in the table\n", scene.name, one.row.quantity);
      ++deviations;
    }
  for (const Row& row : table) {
    if (row.scene != scene.name) continue;
    const auto found = std::find_if(measured.begin(), measured.end(),
                                    [&](const Measured& one) { return one.row.quantity == row.quantity; });
    if (found == measured.end()) {
      fmt::print("{}: {} is in the table and not computed\n", scene.name, row.quantity);
      ++deviations;
      continue;
    }
    const double deviation = row.deviation(found->seen);
    if (row.expectation == Expectation::computed && deviation > worst) {
      worst = deviation;
      where = row.quantity;
    }
    if (deviation <= 1) continue;
    fmt::print("{}: {} is {:.9g}, {} {:.9g} {}: {:.3g} times what it may deviate\n", scene.name, row.quantity,
               found->seen, name_of(row.expectation), row.value, row.unit, deviation);
    ++deviations;
  }
  fmt::print("{}: {} numbers, computed ones have changed by {:.2g} of what they may{}\n", scene.name,
             measured.size(), worst, where.empty() ? "" : " (" + where + ")");
  return deviations == 0;
}

/// The numbers of a scene in place of those that the table had of it, but for what is known.
void replace(const std::string& scene, const std::vector<Measured>& measured, std::vector<Row>& table) {
  std::erase_if(table,
                [&](const Row& row) { return row.scene == scene && row.expectation != Expectation::known; });
  for (const Measured& one : measured) table.push_back(one.row);
}

/// Sorts by the order of the list, what is known last; throws Error for rows of a scene that is not listed.
void sort_by(const std::vector<ListedScene>& scenes, std::vector<Row>& table) {
  const auto place = [&](const Row& row) {
    const auto found = std::find_if(scenes.begin(), scenes.end(),
                                    [&](const ListedScene& scene) { return scene.name == row.scene; });
    if (found == scenes.end()) throw Error("scenes.csv has no scene \"" + row.scene + "\" of table.csv");
    return std::pair(found - scenes.begin(), row.expectation == Expectation::known);
  };
  std::stable_sort(table.begin(), table.end(),
                   [&](const Row& a, const Row& b) { return place(a) < place(b); });
}

int run(bool write, const std::vector<std::string>& names) {
  const std::vector<ListedScene> scenes = read_scene_list(directory / "scenes.csv");
  for (const std::string& name : names)
    if (std::none_of(scenes.begin(), scenes.end(),
                     [&](const ListedScene& scene) { return scene.name == name; }))
      throw Error("scenes.csv has no scene \"" + name + "\"");
  std::vector<Row> table = read_table(directory / "table.csv");
  sort_by(scenes, table);
  bool all_agree = true;
  for (const ListedScene& scene : scenes) {
    if (!names.empty() && std::find(names.begin(), names.end(), scene.name) == names.end()) continue;
    try {
      const std::vector<Measured> measured = measure(scene);
      if (write) replace(scene.name, measured, table);
      if (!agrees(scene, measured, table)) all_agree = false;
    } catch (const Error& error) {
      fmt::print("{}: {}\n", scene.name, error.what());
      all_agree = false;
    }
  }
  if (write) {
    sort_by(scenes, table);
    write_table(directory / "table.csv", table);
  }
  return all_agree ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  const bool write = std::erase(names, "--write") > 0;
  try {
    polyfem::pin_blas_to_one_thread();
    return run(write, names);
  } catch (const std::exception& error) {
    fmt::print(stderr, "regression_table: error: {}\n", error.what());
    return 2;
  }
}
