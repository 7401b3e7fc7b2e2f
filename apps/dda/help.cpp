#include "help.hpp"

#include "call_error.hpp"
#include "call_problem.hpp"
#include "completion.hpp"
#include "exit_status.hpp"
#include "help_texts.hpp"
#include "messages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ddacontact/scene/catalog.hpp>
#include <ddacontact/scene/documentation.hpp>
#include <ddacontact/scene/json_schema.hpp>

#include <span>
#include <vector>

namespace dda {

using namespace ddacontact::scene_format;

namespace {

std::string without_backticks(std::string text) {
  std::erase(text, '`');
  return text;
}

/// A key, what it may be, its default and its sentence.
std::string key_text(const KeyRow& row) {
  const std::string given =
      row.default_text == "required" ? "required" : "default " + without_backticks(row.default_text);
  return fmt::format("  {}: {}; {}\n", row.name, row.value, given) +
         (row.what.empty() ? "" : fmt::format("      {}\n", without_backticks(row.what)));
}

std::string table_text(const std::string& heading, const std::string& table) {
  std::string text = heading + "\n";
  for (const KeyRow& row : key_rows(table)) text += key_text(row);
  return text;
}

/// Tables inside a table, by their full names.
std::vector<std::string> inner_tables(const CatalogEntry& entry) {
  std::vector<std::string> names;
  for (const std::string_view key : entry.keys) {
    const std::string name = std::string(entry.name) + '.' + std::string(key);
    if (!key_rows(name).empty()) names.push_back(name);
  }
  return names;
}

/// Every key of a table of the scene, empty for an unknown name.
std::string scene_table(const std::string& topic) {
  for (const CatalogEntry& entry : catalog()) {
    if (entry.kind == CatalogEntry::Kind::key || entry.name != topic) continue;
    const char* form = entry.kind == CatalogEntry::Kind::tables ? "[[{}]]" : "[{}]";
    std::string text = table_text(fmt::format(fmt::runtime(form), topic), topic);
    for (const std::string& inner : inner_tables(entry)) text += "\n" + table_text(inner, inner);
    return text;
  }
  return {};
}

std::string scene_text() {
  std::string text = table_text("Keys at the top of a scene file", "") + "\nTables (dda help TABLE)\n ";
  for (const CatalogEntry& entry : catalog())
    if (entry.kind != CatalogEntry::Kind::key) text += fmt::format(" {}", entry.name);
  return text + "\n";
}

/// All topics: prose, tables of the scene, verbs.
std::vector<std::string> topics(const CLI::App& app) {
  std::vector<std::string> names{"scene", "completion"};
  for (const HelpText& text : help_texts()) names.emplace_back(text.topic);
  for (const CatalogEntry& entry : catalog())
    if (entry.kind != CatalogEntry::Kind::key) names.emplace_back(entry.name);
  for (const CLI::App* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

/// Of a topic that is no verb; empty for an unknown one.
std::string topic_text(const CLI::App& app, const std::string& topic) {
  if (topic == "completion") return completion_script(app, topics(app));
  if (topic == "scene") return scene_text();
  for (const HelpText& text : help_texts())
    if (topic == text.topic) return std::string(text.text);
  return scene_table(topic);
}

/// Of the verb, or the kind of a verb, that all of the words name; empty when there is none.
std::string verb_text(const CLI::App& app, std::span<const std::string> words) {
  if (words.empty()) return app.help(call_of(*app.get_parent()));
  for (const CLI::App* verb : app.get_subcommands({}))
    if (verb->get_name() == words[0]) return verb_text(*verb, words.subspan(1));
  return {};
}

}  // namespace

std::string help_footer() {
  return R"(Examples:
  dda make joints -o rock.toml            a slope with two joint sets, ready to run
  dda check rock.toml                     every problem of the scene, with line, column and cure
  dda run rock.toml                       results in rock-out/
  dda info rock-out                       how it went, in words
  dda plot rock-out --field s1 -o s1.svg  a picture of the last frame
  dda view rock-out -o rock.html          all frames in one page for the browser

Exit status: 0 done; 2 wrong input or call, nothing written; 3 the analysis stopped, results kept;
  4 a file could not be read or written; 130 and 143 interrupted.

dda help VERB lists the options of a verb, dda help the topics of the manual.
)";
}

int help(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty()) {
    fmt::print("dda help TOPIC prints one of\n  {}\n", fmt::join(topics(app), " "));
    return done;
  }
  std::string text = verb_text(app, words);
  if (text.empty() && words.size() == 1) text = topic_text(app, words[0]);
  if (!text.empty()) return fmt::print("{}", text), done;
  const std::vector<std::string> known = topics(app);
  const std::string topic = fmt::format("{}", fmt::join(words, " "));
  print_error(
      fmt::format("no help on \"{}\" ({})", topic, choice_among(topic, {known.begin(), known.end()})));
  return wrong_input;
}

int schema() {
  fmt::print("{}", json_schema());
  return done;
}

}  // namespace dda
