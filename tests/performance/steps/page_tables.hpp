/// \file The tables of doc/benchmarks/dda.md.
#pragma once

#include <tests/performance/page/marked_page.hpp>
#include <tests/performance/steps/measurement.hpp>

#include <span>

namespace step_performance {

/// A wall of rigid bricks by Box2D.
struct RigidWall {
  double bricks = 0, settling = 0, settled = 0;  ///< s a step
  double sunk = 0, leaning = 0;                  ///< m, the brick that moved most
  double largest_speed = 0;                      ///< m/s, at the end
};

/// Everything that was measured, each as a file of its name.
struct Tables {
  std::vector<Measurement> growth, scenes, skips, walls, threads, field;
  std::vector<RigidWall> box2d;  ///< empty where there is no Box2D
};

/// Throws polyfem::Error when a file other than box2d.csv is missing.
Tables read_tables(const std::filesystem::path& directory);

/// A time: "1.2 ms", "3.4 s".
std::string time_text(double seconds);
/// Three digits, or "-" for what is not known.
std::string number_text(double value);

benchmark_page::Table growth_table(std::span<const Measurement> table);
benchmark_page::Table phase_table(std::span<const Measurement> table);
benchmark_page::Table factor_table(std::span<const Measurement> table);
benchmark_page::Table memory_table(std::span<const Measurement> table);
/// Each case without a skip beside that with all.
benchmark_page::Table skip_table(std::span<const Measurement> table);
benchmark_page::Table peer_table(const Tables& tables);
benchmark_page::Table thread_table(std::span<const Measurement> table);

/// kB of a block, of all parts, without its share of the factor.
double kilobytes(const Measurement& m);

}  // namespace step_performance
