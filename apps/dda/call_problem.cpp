#include "call_problem.hpp"

#include "call_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ddacontact/scene/spelling.hpp>

#include <sstream>

namespace dda {

namespace {

std::string see_help(const CLI::App& app) {
  return fmt::format("try {} --help", call_of(app));
}

/// What a call must write: "SCENE", "--output FILE".
std::string form_of(const CLI::Option& option) {
  return option.get_positional() ? option.get_name() : option.get_name() + ' ' + option.get_type_name();
}

std::string without_value(const CLI::Option& option) {
  return fmt::format("needs a value (write {})", form_of(option));
}

/// The verbs of the program, or the kinds of one verb.
std::vector<std::string> verbs_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

/// "verb", or "kind" of a verb.
std::string word_for_verbs(const CLI::App& app) {
  return CLI::detail::to_lower(app.get_formatter()->get_label("SUBCOMMAND"));
}

std::string cure_of_option(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
  const std::string name = word.substr(0, word.find('='));
  for (const CLI::App* verb : app.get_subcommands({}))
    if (verb->get_option_no_throw(name)) return fmt::format("write it after the {}", word_for_verbs(app));
  const std::string& nearest = names[ddacontact::scene_format::nearest(name, {names.begin(), names.end()})];
  return ddacontact::scene_format::is_near(name, nearest) ? fmt::format("did you mean \"{}\"?", nearest)
                                                          : see_help(app);
}

std::string unknown_word(const CLI::App& app, const std::string& word) {
  if (word.starts_with('-'))
    return fmt::format("unknown option \"{}\" ({})", word, cure_of_option(app, word));
  const std::vector<std::string> verbs = verbs_of(app);
  if (verbs.empty()) return fmt::format("\"{}\" is one word too many ({})", word, see_help(app));
  return fmt::format("unknown {} \"{}\" ({})", word_for_verbs(app), word,
                     choice_among(word, {verbs.begin(), verbs.end()}));
}

/// The options that an error of CLI11 names, in its order; it has no other way to tell them.
std::vector<const CLI::Option*> options_named(const CLI::App& app, const std::string& text) {
  std::vector<const CLI::Option*> options;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word.ends_with(':')) word.pop_back();
    if (const CLI::Option* option = app.get_option_no_throw(word)) options.push_back(option);
  }
  return options;
}

/// Of a call without a word that nothing takes.
std::string problem_of_options(const CLI::App& app, const CLI::ParseError& error) {
  const std::string kind = error.get_name(), text = error.what();
  const std::vector<const CLI::Option*> options = options_named(app, text);
  if (options.empty())
    return kind == "RequiredError" ? fmt::format("no {} is given (there are: {}; {})", word_for_verbs(app),
                                                 fmt::join(verbs_of(app), ", "), see_help(app))
                                   : fmt::format("{} ({})", text, see_help(app));
  const CLI::Option& option = *options[0];
  const std::string name = option.get_name();
  if (kind == "ValidationError") return name + text.substr(name.size() + 1);  // without the colon
  if (kind == "RequiredError") return fmt::format("{} is missing ({})", form_of(option), see_help(app));
  if (kind == "RequiresError" && options.size() > 1)
    return fmt::format("{} needs {} ({})", name, form_of(*options[1]), see_help(app));
  if (kind == "ExcludesError" && options.size() > 1)
    return fmt::format("{} and {} exclude each other ({})", name, options[1]->get_name(), see_help(app));
  const int n = option.get_items_expected_max();
  if (n == 0) return fmt::format("{} takes no value (write {})", name, name);
  if (option.count() == 0) return name + ' ' + without_value(option);
  return fmt::format("{} takes {} value{}, not {} (write {} once)", name, n, n == 1 ? "" : "s",
                     option.count(), form_of(option));
}

}  // namespace

std::string call_of(const CLI::App& app) {
  return app.get_parent() ? call_of(*app.get_parent()) + ' ' + app.get_name() : app.get_name();
}

void expect_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (!option->nonpositional() || option->get_items_expected_max() == 0) continue;
    const auto forgotten = [&app, option](const std::string& word) {
      const bool is_option = word.starts_with('-') && app.get_option_no_throw(word.substr(0, word.find('=')));
      return is_option ? without_value(*option) : std::string();
    };
    option->transform(CLI::Validator(forgotten, ""));  // these come before the checks of what the value is
  }
  for (CLI::App* verb : app.get_subcommands({})) expect_values(*verb);
}

std::string call_problem(const CLI::App& app, const CLI::ParseError& error) {
  // A word that nothing takes comes first: what CLI11 misses may be what that was meant to be.
  for (const std::string& word : app.remaining())
    if (word != "--") return unknown_word(app, word);
  const std::vector<CLI::App*> given = app.get_subcommands();
  return given.empty() ? problem_of_options(app, error) : call_problem(*given[0], error);
}

}  // namespace dda
