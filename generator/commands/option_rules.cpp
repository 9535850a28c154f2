// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/option_rules.hpp"

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>

namespace alembert {

namespace {

enum class Rule { needs, excludes };

/// The verb by its name in the tree, which for a mode such as `stability --matrices` is its earlier one
/// (modes.cpp).
struct OptionRule {
    const char* verb;
    const char* option;
    Rule rule;
    const char* other;
};

constexpr OptionRule option_rules[] = {
    // A step is fixed or chosen by its error.
    {"simulate", "--step", Rule::excludes, "--tolerance"},
    {"sweep", "--step", Rule::excludes, "--tolerance"},
    // What is added to a file, a picture or another answer.
    {"simulate", "--reactions", Rule::needs, "--output"},
    {"simulate", "--show", Rule::needs, "--svg"},
    {"simulate", "--sensitivity-of", Rule::needs, "--sensitivity"},
    {"simulate", "--digits", Rule::excludes, "--json"},  // which has all digits
    {"sweep", "--show", Rule::needs, "--svg"},
    {"sweep", "--sampling", Rule::needs, "--samples"},
    {"sweep", "--seed", Rule::needs, "--samples"},
    {"linearize", "--duration", Rule::needs, "--along"},
    {"linearize", "--tolerance", Rule::needs, "--along"},
    {"linearize", "--sample", Rule::needs, "--along"},
    {"linearize", "--output", Rule::needs, "--along"},
    // Different questions.
    {"simulate", "--proof", Rule::excludes, "--method"},
    {"simulate", "--proof", Rule::excludes, "--tolerance"},
    {"simulate", "--proof", Rule::excludes, "--step"},
    {"simulate", "--proof", Rule::excludes, "--output"},
    {"simulate", "--proof", Rule::excludes, "--svg"},
    {"simulate", "--proof", Rule::excludes, "--sensitivity"},
    {"simulate", "--proof", Rule::excludes, "--poincare"},
    {"simulate", "--proof", Rule::excludes, "--max-step"},
    {"simulate", "--proof", Rule::excludes, "--budget"},
    {"simulate", "--proof", Rule::excludes, "--code"},
    {"simulate", "--proof", Rule::excludes, "--fast-math"},
    {"simulate", "--proof", Rule::excludes, "--no-tuning"},
    {"simulate", "--proof", Rule::excludes, "--digits"},
    {"simulate", "--proof", Rule::excludes, "--regularize"},
    {"simulate", "--proof", Rule::excludes, "--no-estimate"},
    {"linearize", "--along", Rule::excludes, "--affine"},
    {"stability", "--modes", Rule::excludes, "--vary"},
    {"stability", "--modes", Rule::excludes, "--exponents"},
    {"report", "--no-motion", Rule::excludes, "--duration"},
    {"report", "--no-motion", Rule::excludes, "--budget"},
    {"report", "--no-motion", Rule::excludes, "--poincare"},
};

CLI::Option& named(CLI::App& verb, const std::string& name) {
    CLI::Option* const option = verb.get_option_no_throw(name);
    if (option == nullptr) throw std::logic_error(verb.get_name() + " has no option " + name);
    return *option;
}

}  // namespace

void tie_options(CLI::App& app) {
    for (const OptionRule& rule : option_rules) {
        CLI::App& verb = *app.get_subcommand(rule.verb);
        CLI::Option &option = named(verb, rule.option), &other = named(verb, rule.other);
        if (rule.rule == Rule::needs)
            option.needs(&other);
        else
            option.excludes(&other);
    }
}

}  // namespace alembert
