/// \file What options take, as --help and errors say it.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace dda {

/// From `least` to `most`; returns the option, as the others do.
CLI::Option* expect_whole_number(CLI::Option* option, std::int64_t least,
                                 std::int64_t most = std::numeric_limits<int>::max());

/// From `least` to `most`.
CLI::Option* expect_number(CLI::Option* option, double least, double most);

/// Any that is larger than 0.
CLI::Option* expect_positive_number(CLI::Option* option);

/// One of these.
CLI::Option* expect_word(CLI::Option* option, const std::vector<std::string>& words);

}  // namespace dda
