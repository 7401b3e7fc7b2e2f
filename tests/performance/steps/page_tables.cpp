#include "page_tables.hpp"

#include "growth.hpp"
#include "pictures.hpp"

#include <fmt/format.h>
#include <polyfem/core/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace step_performance {

using benchmark_page::Table;

namespace {

std::vector<RigidWall> read_box2d(const std::filesystem::path& path) {
  std::vector<RigidWall> walls;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    RigidWall wall;
    for (double* value :
         {&wall.bricks, &wall.settling, &wall.settled, &wall.sunk, &wall.leaning, &wall.largest_speed}) {
      std::string field;
      std::getline(fields, field, ',');
      *value = std::stod(field);
    }
    walls.push_back(wall);
  }
  return walls;
}

std::string way_of(const Measurement& m) {
  std::string way = fmt::format("{}, {}, {} s", m.scene, m.start, m.time_step);
  if (m.method == "coarse") way += ", contacts to 1e-3";
  if (m.method == "explicit" || m.method == "classic") way += ", " + m.method;
  if (!m.without.empty()) way += fmt::format(", without {}", m.without);
  return way;
}

std::string ratio_text(double value) {
  return std::isfinite(value) && value > 0 ? fmt::format("{:.2g}", value) : "-";
}

}  // namespace

std::string time_text(double seconds) {
  if (seconds <= 0) return "-";
  if (seconds < 1e-3) return fmt::format("{:.3g} us", 1e6 * seconds);
  return seconds < 1 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.3g} s", seconds);
}

std::string number_text(double value) {
  return value == 0 ? "-" : fmt::format("{:.3g}", value);
}

Tables read_tables(const std::filesystem::path& directory) {
  return {.growth = read_table(directory / "growth.csv"),
          .scenes = read_table(directory / "scenes.csv"),
          .skips = read_table(directory / "skips.csv"),
          .walls = read_table(directory / "walls.csv"),
          .threads = read_table(directory / "threads.csv"),
          .field = read_table(directory / "field.csv"),
          .box2d = read_box2d(directory / "box2d.csv")};
}

Table growth_table(std::span<const Measurement> table) {
  constexpr std::array sizes{1e3, 1e4, 1e5, 1e6};
  Table rows{{"a step of", "1e3", "1e4", "1e5", "1e6 blocks", "exponent"}};
  for (const SizeSeries& series : size_series(table)) {
    std::vector<std::string> row{series.name};
    std::vector<double> blocks, seconds;
    for (const double size : sizes) {
      const auto m = std::ranges::find(series.rows, size, &Measurement::size);
      row.push_back(m == series.rows.end() ? "-" : time_text(m->total));
      if (m == series.rows.end()) continue;
      blocks.push_back(m->blocks);
      seconds.push_back(m->total);
    }
    row.push_back(blocks.size() > 1 ? fmt::format("{:.2f}", growth_exponent(blocks, seconds)) : "-");
    rows.push_back(row);
  }
  return rows;
}

Table phase_table(std::span<const Measurement> table) {
  Table rows{{"us a block and step", "blocks", "detection", "assembly", "analysis", "factorization",
              "solution", "rest of the solver", "update", "rest", "total", "substeps", "solutions",
              "factorizations", "contacts a block"}};
  for (const Measurement& m : table) {
    if (m.steps == 0) {
      rows.push_back({way_of(m), number_text(m.size), m.status});
      rows.back().resize(rows.front().size());
      continue;
    }
    std::vector<std::string> row{way_of(m), fmt::format("{}", m.blocks)};
    for (const double seconds : {m.detection, m.assembly, m.analysis, m.factorization, m.solution, m.solver,
                                 m.update, m.rest, m.total})
      row.push_back(seconds > 0 ? fmt::format("{:.3g}", 1e6 * seconds / m.blocks) : "-");
    for (const double count : {m.substeps, m.linear_solves, m.factorizations, m.contacts / m.blocks})
      row.push_back(number_text(count));
    rows.push_back(row);
  }
  return rows;
}

Table factor_table(std::span<const Measurement> table) {
  Table rows{{"", "blocks", "AMD: analysis", "factorization", "solution", "METIS: analysis", "factorization",
              "solution", "fronts: analysis", "factorization", "solution", "fronts over CHOLMOD", "the step",
              "the step over one factor of fronts", "outside over linear solver"}};
  for (const Measurement& m : table) {
    if (m.steps == 0 || m.cholmod() == 0) continue;
    const double own = m.own_factorization + m.own_solution;
    rows.push_back({way_of(m), fmt::format("{}", m.blocks), time_text(m.amd_analysis),
                    time_text(m.amd_factorization), time_text(m.amd_solution), time_text(m.metis_analysis),
                    time_text(m.metis_factorization), time_text(m.metis_solution), time_text(m.own_analysis),
                    time_text(m.own_factorization), time_text(m.own_solution), ratio_text(own / m.cholmod()),
                    time_text(m.total), ratio_text(m.total / own), ratio_text(m.outside() / m.linear())});
  }
  return rows;
}

double kilobytes(const Measurement& m) {
  return 1e3 * (m.heap_blocks + m.heap_steps - m.factor_memory) / m.blocks;
}

Table memory_table(std::span<const Measurement> table) {
  Table rows{{"kB a block", "blocks", "all", "factor", "largest while it ran, with the scene"}};
  for (const Measurement& m : table)
    if (m.steps > 0)
      rows.push_back({way_of(m), fmt::format("{}", m.blocks), fmt::format("{:.2f}", kilobytes(m)),
                      number_text(1e3 * m.factor_memory / m.blocks),
                      fmt::format("{:.2f}", 1e3 * m.peak / m.blocks)});
  return rows;
}

Table skip_table(std::span<const Measurement> table) {
  Table rows{{"without", "scene", "a step with all skips", "a step without", "ratio", "solutions",
              "factorizations", "setting up", "memory of blocks"}};
  const auto both = [](double with, double without) {
    return fmt::format("{} -> {}", number_text(with), number_text(without));
  };
  for (const Measurement& m : table) {
    if (m.without.empty()) continue;
    const auto with = std::ranges::find_if(table, [&](const Measurement& other) {
      return other.without.empty() && other.scene == m.scene && other.start == m.start &&
             other.time_step == m.time_step && other.size == m.size;
    });
    if (with == table.end()) continue;
    rows.push_back({m.without,
                    fmt::format("{}, {}, {} s, {} blocks", m.scene, m.start, m.time_step, m.blocks),
                    time_text(with->total), time_text(m.total), ratio_text(m.total / with->total),
                    both(with->linear_solves, m.linear_solves), both(with->factorizations, m.factorizations),
                    ratio_text(m.setup / with->setup), ratio_text(m.heap_blocks / with->heap_blocks)});
  }
  return rows;
}

Table peer_table(const Tables& tables) {
  Table rows{{"wall, steps of 0.01 s", "bricks", "settling", "settled", "sinks, m", "leans, m",
              "speed at the end, m/s"}};
  for (const RigidWall& wall : tables.box2d)
    rows.push_back({"Box2D, rigid", fmt::format("{}", wall.bricks), time_text(wall.settling),
                    time_text(wall.settled), fmt::format("{:.2g}", wall.sunk),
                    fmt::format("{:.2g}", wall.leaning), fmt::format("{:.1e}", wall.largest_speed)});
  // Of what was settled and what was not, a row each way and size.
  std::map<std::pair<std::string, double>, std::array<const Measurement*, 2>> ways;
  for (const Measurement& m : tables.walls) {
    std::string way = m.method == "classic"    ? "classic DDA, six unknowns"
                      : m.method == "explicit" ? "polydda, explicit"
                      : m.method == "coarse"   ? "polydda, contacts to 1e-3"
                                               : "polydda";
    if (!m.without.empty()) way += fmt::format(", without {}", m.without);
    ways[{way, m.size}][m.start == "settled"] = &m;
  }
  for (const auto& [way, starts] : ways) {
    const auto time = [](const Measurement* m) {
      return m == nullptr ? "-" : m->steps == 0 ? m->status : time_text(m->mean);
    };
    const Measurement* const settled = starts[1];
    rows.push_back({way.first, fmt::format("{}", (starts[0] ? starts[0] : starts[1])->blocks),
                    time(starts[0]), time(settled), "-", "-",
                    settled == nullptr ? "-" : fmt::format("{:.1e}", settled->largest_speed)});
  }
  return rows;
}

Table thread_table(std::span<const Measurement> table) {
  Table rows{{"", "blocks", "1 thread", "2 threads", "ratio", "but for the factorization", "detection",
              "assembly", "rest of the solver", "update"}};
  for (const Measurement& one : table) {
    if (one.threads != 1) continue;
    const auto two = std::ranges::find_if(table, [&](const Measurement& m) {
      return m.threads == 2 && way_of(m) == way_of(one) && m.size == one.size;
    });
    if (two == table.end()) continue;
    rows.push_back({way_of(one), fmt::format("{}", one.blocks), time_text(one.total), time_text(two->total),
                    ratio_text(one.total / two->total),
                    ratio_text((one.total - one.factorization) / (two->total - two->factorization)),
                    ratio_text(one.detection / two->detection), ratio_text(one.assembly / two->assembly),
                    ratio_text(one.solver / two->solver), ratio_text(one.update / two->update)});
  }
  return rows;
}

}  // namespace step_performance
