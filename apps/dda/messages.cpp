#include "messages.hpp"

#include "exit_status.hpp"

#include <fmt/format.h>

namespace dda {

void print_error(const std::string& text) {
  say("dda: error: {}\n", text);
}

void tell_of_older(const std::string& file, const std::optional<std::filesystem::path>& kept) {
  if (kept) fmt::print("the older {} is {} now\n", file, kept->string());
}

int report(const ddacontact::SceneReading& reading) {
  for (const ddacontact::Problem& problem : reading.problems) say("{}\n", problem.text());
  if (reading.unreadable) return file_error;
  return reading.scene ? done : wrong_input;
}

}  // namespace dda
