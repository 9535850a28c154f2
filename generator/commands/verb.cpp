// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/verb.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "alembert/error.hpp"
#include "commands/values.hpp"
#include "model/constant.hpp"

namespace alembert {

namespace {

CLI::Validator number(bool zero) {
    return CLI::Validator(
        [zero](const std::string& text) {
            const double x = std::strtod(text.c_str(), nullptr);
            const bool is_right = std::isfinite(x) && (x > 0 || (zero && x == 0));
            return is_right ? std::string()
                            : text + ": expected a number " + (zero ? "of zero or more" : "above zero");
        },
        "");
}

}  // namespace

CLI::Validator positive_number() {
    return number(false);
}
CLI::Validator nonnegative_number() {
    return number(true);
}

void add_scene_options(CLI::App& verb, SceneOptions& options) {
    verb.add_option("scene", options.scene, "the scene, a TOML file")->type_name(values::scene)->required();
    verb.add_flag("--json", options.json, "print one JSON object");
}

void add_by_option(CLI::App& verb, std::string& by) {
    verb.add_option("--by", by, "the formalism; default: the program chooses")->type_name(values::formalism);
}

CLI::App* add_verb(CLI::App& app, const VerbText& text) {
    CLI::App* const verb = app.add_subcommand(text.name, text.about);
    verb->footer(text.example);
    return verb;
}

void add_reactions_option(CLI::App& verb, bool& reactions) {
    verb.add_flag("--reactions", reactions, "what constraints exert along coordinates, and joints");
}

void add_at_option(CLI::App& verb, std::vector<std::string>& at) {
    verb.add_option("--at", at, "sets a coordinate, a rate (\"theta1'=1\"), a parameter, t; pi/2 is read")
        ->type_name(values::assignment);
}

void add_verbs(CLI::App& app, Chosen& chosen) {
    for (const auto add : {add_derive, add_agree, add_audit, add_check, add_eval, add_equilibrium, add_linearize,
                           add_stability, add_inverse, add_impact, add_emit, add_import, add_simulate, add_sweep,
                           add_bench, add_report, add_watch, add_completion, add_manual})
        add(app, chosen);
}

Overrides overrides_of(const std::vector<std::string>& at) {
    Overrides result;
    for (const std::string& item : at) {
        const std::size_t equals = item.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == item.size())
            throw ModelError(fmt::format(
                "--at {}: expected NAME=VALUE with a number, as in --at theta1=0.3 or --at theta1=pi/2", item));
        try {
            result.emplace_back(item.substr(0, equals), number_of(item.substr(equals + 1)));
        } catch (const ModelError& mistake) {
            throw ModelError(fmt::format(
                "--at {}: {}; expected NAME=VALUE with a number, as in --at theta1=0.3 or --at theta1=pi/2", item,
                mistake.what()));
        }
    }
    return result;
}

double number_of(const std::string& text) {
    std::size_t used = 0;
    try {
        const double value = std::stod(text, &used);
        if (used == text.size()) return value;
    } catch (const std::exception&) {
    }
    return constant_number(text);
}

}  // namespace alembert
