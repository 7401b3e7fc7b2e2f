#include "info.hpp"

#include "exit_status.hpp"
#include "messages.hpp"
#include "result.hpp"

#include <fmt/format.h>
#include <ddacontact/output/csv_table.hpp>
#include <ddacontact/output/summary_reader.hpp>
#include <ddacontact/picture/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace dda {

namespace fs = std::filesystem;
using namespace ddacontact;

namespace {

/// Lines of the answer; a topic's further lines stand below its first.
class Answer {
 public:
  void topic(const std::string& name) { topic_ = name; }
  void line(const std::string& text) {
    text_ += fmt::format("  {:<11} {}\n", topic_, text);
    topic_.clear();
  }
  void heading(const std::string& text) { text_ += text + "\n"; }
  const std::string& text() const { return text_; }

 private:
  std::string text_, topic_;
};

std::string plural(double count, const std::string& one, const std::string& many) {
  return fmt::format("{:.0f} {}", count, count == 1 ? one : many);
}

void tell_outcome(Answer& answer, const SummaryTable& summary) {
  answer.topic("ended");
  std::string text = summary.text("status").empty() ? "unknown" : summary.text("status");
  if (const auto steps = summary.number("steps_completed"))
    text += " after " + plural(*steps, "step", "steps");
  if (const auto time = summary.number("time"))
    text += fmt::format(", at t = {}", number_text(*time, 4) + " s");
  answer.line(text);
  if (!summary.text("reason").empty()) answer.line("because: " + summary.text("reason"));
}

void tell_size(Answer& answer, const SummaryTable& summary) {
  answer.topic("system");
  std::string text;
  const auto add = [&](const char* key, const char* one, const char* many) {
    if (const auto count = summary.number(key))
      text += (text.empty() ? "" : ", ") + plural(*count, one, many);
  };
  add("blocks", "block", "blocks");
  add("dofs", "unknown", "unknowns");
  add("contacts_max", "contact at most", "contacts at most");
  if (!text.empty()) answer.line(text);
}

void tell_work(Answer& answer, const SummaryTable& summary) {
  answer.topic("work");
  const auto substeps = summary.number("substeps"), rejected = summary.number("rejected_steps"),
             unconverged = summary.number("unconverged_steps"),
             passes = summary.number("open_close_iterations"), solves = summary.number("linear_solves"),
             factorizations = summary.number("factorizations");
  if (substeps && rejected)
    answer.line(fmt::format("{}, {} tries rejected", plural(*substeps, "substep", "substeps"),
                            *rejected == 0 ? "no" : fmt::format("{:.0f}", *rejected)));
  if (unconverged)
    answer.line(*unconverged == 0
                    ? "every substep converged"
                    : plural(*unconverged, "substep", "substeps") + " accepted without convergence");
  if (passes && substeps && *substeps > 0)
    answer.line(fmt::format("{}, {} a substep",
                            plural(*passes, "open-close iteration", "open-close iterations"),
                            number_text(*passes / *substeps, 3)));
  if (solves && factorizations)
    answer.line(fmt::format("{}, {}", plural(*solves, "linear solution", "linear solutions"),
                            plural(*factorizations, "factorization", "factorizations")));
}

/// The place of the largest of some numbers.
std::size_t at_largest(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

std::vector<double> lengths(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < x.size(); ++i) lengths.push_back(std::hypot(x[i], y[i]));
  return lengths;
}

void tell_motion(Answer& answer, const fs::path& directory) {
  answer.topic("motion");
  const CsvTable vertices(directory / "vertices.csv"), blocks(directory / "blocks.csv");
  if (vertices.n_rows() == 0 || blocks.n_rows() == 0) return;
  const std::vector<double> moved = lengths(vertices.numbers("ux"), vertices.numbers("uy"));
  const std::vector<double> speed = lengths(blocks.numbers("vx"), blocks.numbers("vy"));
  const std::size_t i = at_largest(moved), b = at_largest(speed);
  if (moved[i] > 0)
    answer.line(fmt::format("largest displacement {}: block {}, vertex {}", quantity_text(moved[i], "m"),
                            vertices.texts("block")[i], vertices.texts("vertex")[i]));
  if (speed[b] > 0)
    answer.line(fmt::format("fastest block {}: {} at the end", blocks.texts("block")[b],
                            quantity_text(speed[b], "m/s")));
  if (moved[i] == 0 && speed[b] == 0) answer.line("nothing moved");
}

void tell_stress(Answer& answer, const fs::path& directory) {
  answer.topic("stress");
  const CsvTable blocks(directory / "blocks.csv");
  if (blocks.n_rows() == 0) return;
  const std::vector<std::string> names = blocks.texts("block");
  std::vector<double> s1 = blocks.numbers("s1_max"), s2 = blocks.numbers("s2_min");
  for (double& value : s2) value = -value;
  const std::size_t i = at_largest(s1), j = at_largest(s2);
  answer.line(fmt::format("largest principal stress {} in block {}", quantity_text(s1[i], "Pa"), names[i]));
  answer.line(
      fmt::format("smallest {} in block {} (tension positive)", quantity_text(-s2[j], "Pa"), names[j]));
}

void tell_contacts(Answer& answer, const SummaryTable& summary, const fs::path& directory) {
  answer.topic("contacts");
  const CsvTable contacts(directory / "contacts.csv");
  std::map<std::string, int> states;
  for (const std::string& state : contacts.texts("state")) ++states[state];
  answer.line(fmt::format("at the end {} stick, {} slip, {} just opened", states["stick"], states["slip"],
                          states["open"]));
  if (contacts.n_rows() > 0) {
    const std::vector<double> force =
        lengths(contacts.numbers("normal_force"), contacts.numbers("shear_force"));
    const std::size_t i = at_largest(force);
    answer.line(fmt::format("largest force {}: block {}, vertex {} on block {}",
                            quantity_text(force[i], "N/m"), contacts.texts("block_a")[i],
                            contacts.texts("vertex")[i], contacts.texts("block_b")[i]));
  }
  const auto penetration = summary.number("max_penetration");
  if (!penetration) return;
  const std::vector<double> areas = CsvTable(directory / "blocks.csv").numbers("area");
  std::string text = "deepest penetration " + quantity_text(*penetration, "m");
  if (!areas.empty() && *penetration > 0) {
    const double size = std::sqrt(*std::min_element(areas.begin(), areas.end()));
    text += fmt::format(", {} of the smallest block's size ({})", number_text(*penetration / size, 2),
                        quantity_text(size, "m"));
  }
  answer.line(text);
}

void tell_energy(Answer& answer, const SummaryTable& summary) {
  answer.topic("energy");
  const auto number = [&](const char* key) { return summary.number(std::string("energy.") + key); };
  const auto text = [&](const char* key) { return quantity_text(number(key).value_or(0), "J/m"); };
  if (!number("kinetic")) return;
  answer.line(fmt::format("kinetic {}, elastic {}, gravity {}, external work {}", text("kinetic"),
                          text("elastic"), text("gravity"), text("external")));
  answer.line(fmt::format("lost to friction {}, to damping {}, to the time scheme {}",
                          text("friction_dissipated"), text("damping_dissipated"),
                          text("numerical_dissipated")));
  const double error = std::abs(number("balance_error").value_or(0));
  answer.line(error == 0 ? "the balance closes"
                         : fmt::format("the balance closes to {} of the largest energy exchanged",
                                       number_text(error, 2)));
}

/// The weight of all blocks, a vector; nothing without the scene.
std::optional<Vec2> weight(const std::optional<Scene>& scene, const fs::path& directory) {
  if (!scene) return std::nullopt;
  const CsvTable blocks(directory / "blocks.csv");
  const std::vector<double> areas = blocks.numbers("area"), ratios = blocks.numbers("area_ratio");
  if (areas.size() != scene->blocks.size()) return std::nullopt;
  double mass = 0;
  for (std::size_t b = 0; b < areas.size(); ++b)
    mass +=
        scene->materials[static_cast<std::size_t>(scene->blocks[b].material)].density * areas[b] / ratios[b];
  return mass * scene->analysis.gravity;
}

void tell_reactions(Answer& answer, const std::optional<Scene>& scene, const fs::path& directory) {
  answer.topic("reactions");
  std::error_code error;
  if (!fs::exists(directory / "supports.csv", error)) return;
  const CsvTable supports(directory / "supports.csv");
  if (supports.n_rows() == 0) return answer.line("nothing is held");
  Vec2 sum(0, 0);
  for (const double force : supports.numbers("fx")) sum.x() += force;
  for (const double force : supports.numbers("fy")) sum.y() += force;
  std::string text =
      fmt::format("sum ({}, {})", quantity_text(sum.x(), "N/m", 4), quantity_text(sum.y(), "N/m", 4));
  if (const auto w = weight(scene, directory)) {
    text += fmt::format("; the blocks weigh {}", quantity_text(w->norm(), "N/m", 4));
    if (!scene->loads.empty())
      text += " and " + plural(static_cast<double>(scene->loads.size()), "load acts", "loads act");
  }
  answer.line(text);
}

void tell_times(Answer& answer, const SummaryTable& summary) {
  answer.topic("wall time");
  const auto total = summary.number("wall_seconds.total");
  if (!total) return;
  std::string text = quantity_text(*total, "s");
  if (const auto memory = summary.number("peak_memory_mb"))
    text += fmt::format(", at most {} MB of memory", number_text(*memory, 3));
  answer.line(text);
  text.clear();
  for (const char* part : {"setup", "detection", "assembly", "solver", "update", "output"})
    if (const auto seconds = summary.number(std::string("wall_seconds.") + part); seconds && *total > 0)
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", part, 100 * *seconds / *total);
  if (!text.empty()) answer.line(text);
}

void tell_frames(Answer& answer, const fs::path& directory) {
  answer.topic("frames");
  std::error_code error;
  if (!fs::exists(directory / "results.pvd", error)) return answer.line("none");
  const FrameSeries series = read_series(directory);
  answer.line(
      fmt::format("{}: {} {}", series.size(), series.size() == 1 ? "step" : "steps", steps_text(series)));
}

void tell_files(Answer& answer, const fs::path& directory) {
  answer.topic("files");
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory))
    names.push_back(entry.path().filename().string() + (entry.is_directory() ? "/" : ""));
  std::sort(names.begin(), names.end());
  answer.line(fmt::format("{}", fmt::join(names, ", ")));
}

/// A part that cannot be told is a problem of its own: the others are told all the same.
int tell_all(Answer& answer, const std::vector<std::function<void()>>& parts) {
  int status = done;
  for (const auto& part : parts) try {
      part();
    } catch (const Error& error) {
      answer.line("not known");
      print_error(error.what());
      status = file_error;
    }
  return status;
}

}  // namespace

int info(const std::string& name) try {
  const fs::path directory(name);
  expect_result_directory(directory);
  const SummaryTable summary = read_summary(directory / "summary.json");
  const std::optional<Scene> scene = scene_of(directory);
  Answer answer;
  answer.heading(title_of(directory, scene));
  const int status = tell_all(
      answer, {[&] { tell_outcome(answer, summary); }, [&] { tell_size(answer, summary); },
               [&] { tell_work(answer, summary); }, [&] { tell_motion(answer, directory); },
               [&] { tell_stress(answer, directory); }, [&] { tell_contacts(answer, summary, directory); },
               [&] { tell_energy(answer, summary); }, [&] { tell_reactions(answer, scene, directory); },
               [&] { tell_times(answer, summary); }, [&] { tell_frames(answer, directory); },
               [&] { tell_files(answer, directory); }});
  fmt::print("{}", answer.text());
  return status;
} catch (const Error& error) {
  print_error(error.what());
  return file_error;
}

}  // namespace dda
