#include "plain_help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace dda {

namespace {

class PlainHelp : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_positional())
      return option->get_expected_max() == CLI::detail::expected_max_vector_size ? "..." : "";
    return option->get_items_expected_max() > 0 ? ' ' + option->get_type_name() : "";
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    std::vector<std::string> facts;
    if (option->get_required()) facts.emplace_back("required");
    if (!option->get_default_str().empty()) facts.push_back("default " + option->get_default_str());
    for (const CLI::Option* other : option->get_needs()) facts.push_back("with " + other->get_name());
    for (const CLI::Option* other : option->get_excludes()) facts.push_back("not with " + other->get_name());
    const std::string& text = option->get_description();
    return facts.empty() ? text : fmt::format("{} ({})", text, fmt::join(facts, "; "));
  }
};

}  // namespace

std::shared_ptr<CLI::Formatter> plain_help(const std::string& verbs) {
  auto help = std::make_shared<PlainHelp>();
  help->label("SUBCOMMAND", verbs);
  help->label("Positionals", "Arguments");
  return help;
}

}  // namespace dda
