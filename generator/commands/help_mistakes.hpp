// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What is wrong with a command line, in our words: no text of CLI11 is shown.
///
///     alembert simulate p.toml --tol 1e-6     simulate has no option '--tol'; did you mean --tolerance?
///     alembert run p.toml                     unknown verb 'run'; did you mean simulate?

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace alembert {

/// The mistake in the verb or the option names of a command line of at least one word; empty if there is none.
std::string mistake_in(const CLI::App& app, const std::vector<std::string>& words);

/// The mistake that CLI11 found, and a reference to the help.
std::string failure_message(const CLI::App* app, const CLI::Error& error);

}  // namespace alembert
