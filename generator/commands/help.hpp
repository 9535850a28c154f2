// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the program says about itself: `--help`, the manual and completion in shells, all from the one tree of
/// verbs and options of CLI11. A verb's footer is its example.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace alembert {

/// One option of a verb as it is typed.
struct OptionText {
    std::vector<std::string> names;  ///< "-o", "--output"; of a positional its word alone
    std::string value;               ///< "FILE"; empty: a flag
    std::string about;
    bool positional = false, required = false, repeated = false;
};

/// Positional ones first, then in the order in which they were added, --help last.
std::vector<OptionText> options_of(const CLI::App& app);

/// "alembert simulate SCENE [OPTION…]".
std::string usage_of(const CLI::App& app);

/// Code and meaning.
const std::vector<std::pair<int, std::string>>& exit_codes();

/// The text of --help, lines of at most 80 columns; it begins with the example.
std::string help_of(const CLI::App& app);

/// `--help` of an application and of all verbs that are added afterwards is help_of.
void set_help(CLI::App& app);

/// What CLI11 found wrong, and where there is help.
std::string failure_message(const CLI::App* app, const CLI::Error& error);

/// What is wrong with the words of a command line, as far as verbs and names of options are concerned; empty where
/// nothing is.
std::string mistake_in(const CLI::App& app, const std::vector<std::string>& words);

/// `words` as lines of at most `width` columns.
std::vector<std::string> filled(const std::string& words, std::size_t width);

}  // namespace alembert
