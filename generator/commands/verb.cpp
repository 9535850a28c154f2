// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/verb.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "alembert/base/error.hpp"
#include "analysis/state/given_functions.hpp"
#include "analysis/state/given_values.hpp"
#include "base/language/say.hpp"
#include "commands/help.hpp"
#include "commands/modes.hpp"
#include "commands/option_rules.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "model/constant.hpp"
#include "scene/advice.hpp"
#include "scene/known_names.hpp"
#include "scene/typed_words.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

/// CLI11 would print the range with 309 digits.
CLI::Validator number(bool zero) {
    return CLI::Validator(
        [zero](const std::string& text) {
            const double x = std::strtod(text.c_str(), nullptr);
            const bool is_right = std::isfinite(x) && (x > 0 || (zero && x == 0));
            return is_right            ? std::string()
                   : !std::isfinite(x) ? say("{}: expected a finite number", text)
                   : zero              ? say("{}: expected a number of zero or more", text)
                                       : say("{}: expected a number above zero", text);
        },
        "");
}

}  // namespace

AddedOption& AddedOption::type_name(const char* kind) {
    option_->type_name(kind);
    const ValueKind* const known = value_kind(kind);
    if (known == nullptr || known->words.empty()) return *this;
    const std::vector<std::string>& words = known->words;
    option_->transform([&words](const std::string& text) {
        const auto same = std::find_if(words.begin(), words.end(),
                                       [&](const std::string& word) { return bare(word) == bare(text); });
        return same == words.end() ? text : *same;
    });
    if (!known->plural.empty()) return *this;  // formalisms and methods, of which others say what is wrong
    option_->check(CLI::Validator(
        [&words](const std::string& text) {
            const bool is_known = std::find(words.begin(), words.end(), text) != words.end();
            return is_known ? std::string() : say("{}: expected {}", text, fmt::join(words, ", "));
        },
        ""));
    return *this;
}

AddedOption& AddedOption::as(const SharedOption& shared) {
    if (shared.kind != nullptr) type_name(shared.kind);
    if (shared.number == SharedOption::Number::positive) positive();
    if (shared.number == SharedOption::Number::nonnegative) nonnegative();
    return *this;
}

AddedOption& AddedOption::silent() {
    option_->group("");
    return *this;
}

AddedOption& AddedOption::required() {
    option_->required();
    return *this;
}

AddedOption& AddedOption::positive() {
    option_->check(number(false));
    return *this;
}

AddedOption& AddedOption::nonnegative() {
    option_->check(number(true));
    return *this;
}

AddedOption& AddedOption::between(int least, int most) {
    option_->check(CLI::Validator(
        [least, most](const std::string& text) {
            char* end = nullptr;
            const double x = std::strtod(text.c_str(), &end);
            return *end == '\0' && !text.empty() && std::floor(x) == x && x >= least && x <= most
                       ? std::string()
                       : say("{}: expected a whole number from {} to {}", text, least, most);
        },
        ""));
    return *this;
}

template <typename T>
AddedOption Verb::add_option(const std::string& names, T& value, const std::string& about) {
    return AddedOption(app_->add_option(names, value, about));
}
template AddedOption Verb::add_option(const std::string&, std::string&, const std::string&);
template AddedOption Verb::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template AddedOption Verb::add_option(const std::string&, int&, const std::string&);
template AddedOption Verb::add_option(const std::string&, double&, const std::string&);
template AddedOption Verb::add_option(const std::string&, std::optional<double>&, const std::string&);
template AddedOption Verb::add_option(const std::string&, std::optional<std::string>&, const std::string&);
template AddedOption Verb::add_option(const std::string&, std::optional<int>&, const std::string&);
template AddedOption Verb::add_option(const std::string&, long&, const std::string&);

AddedOption Verb::add_flag(const std::string& names, bool& value, const std::string& about) {
    return AddedOption(app_->add_flag(names, value, about));
}

void Verb::callback(std::function<void()> chosen) {
    app_->callback(std::move(chosen));
}

void add_scene_options(Verb& verb, SceneOptions& options) {
    verb.take("scene", options.scene).required();
    verb.take("--json", options.json);
    verb.take("--strict", are_warnings_errors());
}

Verb add_verb(CLI::App& app, const VerbText& text) {
    CLI::App* const verb = app.add_subcommand(text.name, text.about);
    verb->footer(text.example);
    if (verb->get_name() != "emit")  // whose --language is that of the code; choose_language takes "zh" out before
        AddedOption(verb->add_option(
                        "--language", [](const CLI::results_t&) { return true; },
                        say("of what is printed for people: en or zh")))
            .type_name(values::reading);
    if (const VerbMode* const mode = mode_that_was(text.name); mode != nullptr && mode->kind == nullptr)
        AddedOption(verb->add_flag(mode->option)).silent();
    return Verb(*verb);
}

namespace {

/// The modes of each verb as its options, for what is written from the tree: their words never come here.
void add_modes(const CLI::App& app) {
    for (CLI::App* const verb : listed_verbs(app))
        for (const VerbMode& mode : modes_of(verb->get_name())) {
            const std::string about = app.get_subcommand(mode.earlier)->get_description();
            if (mode.kind == nullptr)
                verb->add_flag(mode.option, about);
            else
                verb->add_option(mode.option, about)->type_name(mode.kind);
        }
}

}  // namespace

void add_verbs(CLI::App& app, Chosen& chosen) {
    struct Group {
        std::string title;
        std::vector<void (*)(CLI::App&, Chosen&)> verbs;
    };
    for (const auto& [title, verbs] : std::initializer_list<Group>{
             {say("Equations"), {add_derive, add_check, add_audit}},
             {say("One state"), {add_eval}},
             {say("Equilibria"), {add_equilibrium, add_stability}},
             {say("Motion"), {add_simulate, add_sweep, add_bench}},
             {say("Code and page"), {add_emit, add_import, add_report, add_new}},
             {"",
              {add_agree, add_kinematics, add_inertia, add_identify, add_inverse, add_impact, add_linearize,
               add_fmu, add_watch, add_completion, add_manual}}})
        for (const auto add : verbs) {
            add(app, chosen);
            app.get_subcommands({}).back()->group(title);
        }
    tie_options(app);
    add_modes(app);
}

std::string in_words_of(const Scene& scene, const std::string& text) {
    return text.empty() ? text : written_name(text, KnownNames(scene));
}

ExactOverrides exact_overrides_of(const std::vector<std::string>& at, const Scene& scene) {
    ExactOverrides result;
    for (const std::string& typed : at) {
        const std::string item = in_words_of(scene, typed);
        const std::size_t equals = item.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == item.size())
            throw ModelError(say(
                "--at {}: expected NAME=VALUE with a number, as in --at theta1=0.3 or --at theta1=pi/2", typed));
        const std::string name = item.substr(0, item.find_last_not_of(' ', equals - 1) + 1);
        for (const auto& other : result)
            if (other.first == name) throw ModelError(say("--at {}: '{}' is given twice", typed, name));
        try {
            result.emplace_back(name, in_si(scene, name, item.substr(equals + 1)));
        } catch (const ModelError& mistake) {
            throw ModelError(say("--at {}: {}", typed, mistake.what()));
        }
    }
    return result;
}

Overrides overrides_of(const std::vector<std::string>& at, const Scene& scene) {
    Overrides result;
    const ExactOverrides exact = exact_overrides_of(at, scene);
    for (std::size_t k = 0; k < at.size(); ++k) {
        const std::string& item = at[k];
        try {
            result.emplace_back(exact[k].first, number_of(exact[k].second));
        } catch (const ModelError& mistake) {
            throw ModelError(
                say("--at {}: {}; expected NAME=VALUE with a number, as in --at theta1=0.3 or --at theta1=pi/2",
                    item, mistake.what()));
        }
    }
    return result;
}

void add_given_state(Verb& verb, GivenValues& given) {
    verb.take("--at", given.at, say("in place of a value of the scene: l=2, \"theta'=1\""));
}

void add_given_values(Verb& verb, GivenValues& given) {
    add_given_state(verb, given);
    verb.take("--input", given.inputs);
}

Scene with_given(Scene scene, const GivenValues& given) {
    std::set<std::string> named;
    for (const std::string& typed : given.inputs) {
        const std::size_t equals = typed.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == typed.size())
            throw ModelError(
                say("--input {}: expected NAME=FILE.csv or NAME=EXPRESSION, as in --input \"u=sin(t)\"", typed));
        const std::string name = in_words_of(scene, typed.substr(0, equals)), how = typed.substr(equals + 1);
        if (!named.insert(name).second) throw ModelError(say("--input gives '{}' twice", name));
        scene = with_input(std::move(scene), name, how.ends_with(".csv") ? how : in_words_of(scene, how));
    }
    overrides_of(given.at, scene);  // refuses what is no number
    const ExactOverrides at = exact_overrides_of(given.at, scene);
    for (const auto& [name, value] : at)
        if (named.contains(name)) throw ModelError(say("'{}' is given by --input and by --at", name));
    return with_values(std::move(scene), at);
}

Scene scene_of(const SceneOptions& options) {
    return with_given(scene_of(options.scene), options.given);
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
