#include "info_run.hpp"

#include <ddacontact/picture/number_text.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace dda {

using namespace ddacontact;

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

void tell_rest(Answer& answer, const SummaryTable& summary) {
  const auto at_rest = summary.number("at_rest"), unbalanced = summary.number("unbalanced"),
             out = summary.number("blocks_unbalanced"), fastest = summary.number("fastest");
  if (!at_rest || !unbalanced || !out || !fastest) return;
  answer.topic("rest");
  answer.line(*at_rest == 1 ? "at rest: all blocks are in balance" : "not at rest");
  if (*out > 0)
    answer.line(plural(*out, "block is", "blocks are") +
                fmt::format(" out of balance; most block {}, by {} of the largest force on it",
                            summary.text("unbalanced_block"), number_text(*unbalanced, 2)));
  else if (*unbalanced > 0)
    answer.line(fmt::format("out of balance by {} of the largest force on a block at most",
                            number_text(*unbalanced, 2)));
  if (*fastest > 0)
    answer.line(fmt::format("block {} moves fastest, {}", summary.text("fastest_block"),
                            quantity_text(*fastest, "m/s")));
  for (int k = 0; summary.number(fmt::format("stages.{}.steps", k + 1)); ++k) {
    const std::string stage = fmt::format("stages.{}.", k);
    const std::string name = summary.text(stage + "name");
    answer.line(fmt::format("stage {} ended {}at rest after {}", name.empty() ? std::to_string(k) : name,
                            summary.number(stage + "at_rest") == 1. ? "" : "not ",
                            plural(summary.number(stage + "steps").value_or(0), "step", "steps")));
  }
}

void tell_warnings(Answer& answer, const SummaryTable& summary) {
  answer.topic("warnings");
  for (int k = 0;; ++k) {
    const std::string text = summary.text(fmt::format("warnings.{}", k));
    if (text.empty()) break;
    answer.line(text);
  }
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
  if (const auto residual = summary.number("max_residual"))
    answer.line(fmt::format("residual at most {} of the forces", number_text(*residual, 2)));
  if (passes && substeps && *substeps > 0)
    answer.line(fmt::format("{}, {} a substep",
                            plural(*passes, "open-close iteration", "open-close iterations"),
                            number_text(*passes / *substeps, 3)));
  if (solves && factorizations)
    answer.line(fmt::format("{}, {}", plural(*solves, "linear solution", "linear solutions"),
                            plural(*factorizations, "factorization", "factorizations")));
}

void tell_impacts(Answer& answer, const SummaryTable& summary) {
  const auto impacts = summary.number("impacts"), limited = summary.number("limited_impacts"),
             unsettled = summary.number("unsettled_impacts"), bonds = summary.number("broken_bonds");
  answer.topic("events");
  if (impacts) {
    std::string text = plural(*impacts, "contact met", "contacts met") + " at speed";
    if (limited && *limited > 0) text += "; restitution was reduced " + plural(*limited, "time", "times");
    if (unsettled && *unsettled > 0)
      text += "; friction did not settle " + plural(*unsettled, "time", "times");
    answer.line(text);
  }
  if (bonds && *bonds > 0) answer.line(plural(*bonds, "bond broke", "bonds broke"));
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
  if (number("pushed_out").value_or(0) > 0)
    answer.line(fmt::format("put in by contacts that push penetration out {}", text("pushed_out")));
  const double error = std::abs(number("balance_error").value_or(0));
  answer.line(error == 0 ? "the balance closes"
                         : fmt::format("the balance closes to {} of the largest energy exchanged",
                                       number_text(error, 2)));
}

namespace {

/// What each phase of a step costs a block.
void tell_step_times(Answer& answer, const SummaryTable& summary) {
  const auto blocks = summary.number("blocks"), seconds = summary.number("wall_seconds.steps");
  const double steps =
      summary.number("steps_completed").value_or(0) - summary.number("resumed_after").value_or(0);
  if (!blocks || !seconds || steps <= 0 || *blocks <= 0) return;
  const auto phases = [&](const std::vector<const char*>& names) {
    std::string text;
    for (const char* name : names)
      if (const auto spent = summary.number(std::string("wall_seconds.") + name))
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name,
                            quantity_text(*spent / steps / *blocks, "s", 2));
    return text;
  };
  answer.topic("a step");
  answer.line(fmt::format("{}; of each block {}", quantity_text(*seconds / steps, "s"),
                          quantity_text(*seconds / steps / *blocks, "s", 2)));
  if (const std::string text = phases({"detection", "assembly", "solver", "update"}); !text.empty())
    answer.line(text);
  if (const std::string text = phases({"analysis", "factorization", "solution"}); !text.empty())
    answer.line("of the solver: " + text);
}

}  // namespace

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
  tell_step_times(answer, summary);
}

}  // namespace dda
