/// \file What is wrong with a call, in the program's own words.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace dda {

/// A value that is the name of another option of the verb was forgotten: makes that an error of every option
/// of every verb. After all of them are declared.
void expect_values(CLI::App& app);

/// How a verb is called: "dda make wall".
std::string call_of(const CLI::App& app);

/// The sentence for a call that `app` could not parse, with its cure.
std::string call_problem(const CLI::App& app, const CLI::ParseError& error);

}  // namespace dda
