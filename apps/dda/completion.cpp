#include "completion.hpp"

#include "call_problem.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ddacontact/picture/field.hpp>

namespace dda {

namespace {

/// The options of a verb with their dashes.
std::string options_of(const CLI::App& verb) {
  std::string words;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_snames()) words += " -" + name;
    for (const std::string& name : option->get_lnames()) words += " --" + name;
  }
  return words;
}

std::string field_names() {
  std::string words;
  for (const ddacontact::FieldDescription& field : ddacontact::all_fields())
    words += fmt::format(" {}", field.name);
  return words;
}

/// A case of the script for the words before the one to complete, and those of each verb in its place. What
/// follows options are files, but for the word at the place of a verb.
std::string cases_of(const CLI::App& app, const std::string& topics) {
  std::string cases, verbs;
  for (const CLI::App* verb : app.get_subcommands({})) {
    cases += cases_of(*verb, topics);
    verbs += ' ' + verb->get_name();
  }
  if (app.get_name() == "help") verbs = topics;
  const std::string call = call_of(app), options = options_of(app);
  if (!verbs.empty()) cases += fmt::format("    \"{} \") words=\"{}{}\" ;;\n", call, verbs, options);
  return cases + fmt::format("    \"{} \"*) [[ $word == -* ]] && words=\"{}\" ;;\n", call, options);
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::vector<std::string>& topics) {
  return fmt::format(
      R"(# Where it is not installed with the program: save as ~/.local/share/bash-completion/completions/dda
_dda() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=
  local call="dda ${{COMP_WORDS[*]:1:COMP_CWORD-1}}"
  case "${{call% }} " in
{}  esac
  case $before in
    --field) words="{}" ;;
    --history) words="x y ux uy vx vy" ;;
    --vectors) words="displacement velocity" ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _dda dda
)",
      cases_of(app, fmt::format(" {}", fmt::join(topics, " "))), field_names());
}

}  // namespace dda
