#include "info_run.hpp"

#include "energy_terms.hpp"

#include <ddacontact/picture/number_text.hpp>

#include <algorithm>
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
  answer.line(*at_rest == 1 ? "at rest: all blocks are in balance"
              : *out > 0    ? "not at rest"
                            : "not at rest: blocks are in balance, but move");
  if (*out > 0)
    answer.line(plural(*out, "block is", "blocks are") +
                fmt::format(" out of balance; most block {}, by {} of the largest force on it",
                            summary.text("unbalanced_block"), number_text(*unbalanced, 2)));
  else if (*unbalanced > 0)
    answer.line(fmt::format("largest out-of-balance force: {} of the largest force on its block",
                            number_text(*unbalanced, 2)));
  if (*fastest > 0)
    answer.line(fmt::format("block {} moves fastest, {}", summary.text("fastest_block"),
                            quantity_text(*fastest, "m/s")));
  if (const auto furthest = summary.number("furthest"); furthest && *furthest > 0)
    answer.line(fmt::format("block {} has moved furthest, by {} of its size", summary.text("furthest_block"),
                            number_text(*furthest, 2)));
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
  if (summary.number("contacts_max").value_or(0) > 0)
    add("contacts_max", "contact at most", "contacts at most");
  else
    text += text.empty() ? "no contacts" : ", no contacts";
  if (!text.empty()) answer.line(text);
}

void tell_work(Answer& answer, const SummaryTable& summary) {
  answer.topic("work");
  const auto substeps = summary.number("substeps"), rejected = summary.number("rejected_steps"),
             unconverged = summary.number("unconverged_steps"),
             passes = summary.number("open_close_iterations"), solves = summary.number("linear_solves"),
             factorizations = summary.number("factorizations");
  if (substeps && rejected)
    answer.line(fmt::format("{}, {} trial steps rejected", plural(*substeps, "substep", "substeps"),
                            *rejected == 0 ? "no" : fmt::format("{:.0f}", *rejected)));
  if (unconverged)
    answer.line(*unconverged == 0
                    ? "every substep converged"
                    : plural(*unconverged, "substep", "substeps") + " accepted without convergence");
  if (const auto residual = summary.number("max_residual"); residual && *residual > 0)
    answer.line(fmt::format("residual at most {} of the forces", number_text(*residual, 2)));
  if (passes && substeps && *substeps > 0)
    answer.line(fmt::format("{}, {} a substep", plural(*passes, "contact iteration", "contact iterations"),
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
  if (bonds && *bonds > 0)
    answer.line(plural(*bonds, "bond broke", "bonds broke") +
                ": a broken contact keeps no cohesion ('dda safety' can let all act at once)");
}

namespace {

struct EnergyPart {
  std::string name;
  double amount = 0;  ///< J/m, > 0
};

constexpr double least_percent = 0.1;  // that is worth a line
constexpr double much_missing = 1e-3;  // of the balance

/// A line for each part that matters, the largest first, with its share.
void tell_parts(Answer& answer, const char* word, std::vector<EnergyPart> parts, double total) {
  std::sort(parts.begin(), parts.end(),
            [](const EnergyPart& a, const EnergyPart& b) { return a.amount > b.amount; });
  for (const EnergyPart& part : parts)
    if (const double percent = 100 * part.amount / total; percent >= least_percent)
      answer.line(fmt::format("{} {} {} ({} %)", word, part.name, quantity_text(part.amount, "J/m"),
                              number_text(percent, percent < 99.95 ? 2 : 3)));
}

double sum_of(const std::vector<EnergyPart>& parts) {
  double sum = 0;
  for (const EnergyPart& part : parts) sum += part.amount;
  return sum;
}

}  // namespace

void tell_energy(Answer& answer, const SummaryTable& summary) {
  answer.topic("energy");
  const auto number = [&](const char* key) {
    return summary.number(fmt::format("energy.{}", key)).value_or(0);
  };
  if (!summary.number("energy.kinetic")) return;
  std::vector<EnergyPart> came, went;
  const auto count = [&](double amount, const char* into, const char* from) {
    if (amount > 0) went.push_back({into, amount});
    if (amount < 0) came.push_back({from, -amount});
  };
  for (const EnergyTerm& term : energy_terms) count(term.sign * number(term.column), term.into, term.from);
  const double total = std::max(sum_of(came), sum_of(went));
  if (!(total > 0)) return answer.line("none was exchanged");
  count(sum_of(came) - sum_of(went), "what there was less than at the start", "the state at the start");
  tell_parts(answer, "from", came, total);
  tell_parts(answer, "into", went, total);
  const double error = std::abs(number("balance_error"));
  const std::string share = number_text(error, 2) + " of the largest energy exchanged";
  if (error > much_missing)
    answer.line(share + " is missing (a smaller 'time_step')");
  else
    answer.line(error > 0 ? "the balance closes to " + share : "the balance closes");
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
      if (const auto spent = summary.number(fmt::format("wall_seconds.{}", name)))
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
  if (const auto memory = summary.number("peak_memory_mb"); memory && *memory > 0)
    text += fmt::format(", at most {} MB of memory", number_text(*memory, 3));
  answer.line(text);
  text.clear();
  for (const char* part : {"setup", "detection", "assembly", "solver", "update", "output"})
    if (const auto seconds = summary.number(fmt::format("wall_seconds.{}", part)); seconds && *total > 0)
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", part, 100 * *seconds / *total);
  if (!text.empty()) answer.line(text);
  tell_step_times(answer, summary);
}

}  // namespace dda
