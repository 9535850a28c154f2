// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The texts of `--help`, the manual and completion in shells, all made from the tree of verbs and options of
/// CLI11. A verb's footer is its example.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace alembert {

/// One option of a verb in the form in which it is typed.
struct OptionText {
    std::vector<std::string> names;    ///< "-o", "--output"; for a positional argument, only its word
    std::vector<std::string> earlier;  ///< names that are taken and not shown
    std::string value;                 ///< "FILE"; empty for a flag
    std::string about;
    bool positional = false, required = false, repeated = false;
};

/// The options: positional arguments first, then the others in the order in which they were added, and --help
/// last.
std::vector<OptionText> options_of(const CLI::App& app);

/// The verbs that are shown, in the order of their groups: those that are not names of before
/// (commands/modes.hpp).
std::vector<CLI::App*> listed_verbs(const CLI::App& app);

/// The option of the verb that has this name, earlier names too; null if there is none.
const CLI::Option* option_of(const CLI::App& verb, const std::string& name);

/// "alembert simulate SCENE [OPTION…]".
std::string usage_of(const CLI::App& app);

/// The exit codes and their meanings.
const std::vector<std::pair<int, std::string>>& exit_codes();

/// The text of --help, lines of at most 80 columns; it begins with the example.
std::string help_of(const CLI::App& app);

/// Makes help_of the `--help` of an application and of all verbs that are added afterwards.
void set_help(CLI::App& app);

/// `words` as lines of at most `width` columns.
std::vector<std::string> filled(const std::string& words, std::size_t width);

}  // namespace alembert
