// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/given_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/state/assemble.hpp"
#include "analysis/state/given_inputs.hpp"
#include "analysis/state/prepared.hpp"
#include "model/constant.hpp"

namespace alembert {

namespace {

/// A number, or an expression of numbers and pi.
Expression constant(const std::string& value) {
    std::vector<Diagnostic> none;
    return parse_expression(value, {}, none);
}

/// Gives the name its value; nothing happens to a name that is none of these, which `prepared` has refused.
void give(Scene& scene, const std::string& name, const std::string& value) {
    if (name == "t") scene.simulation.start = constant(value);
    for (Parameter& p : scene.parameters)
        if (p.name.text == name) {
            p.value = constant(value);
            if (!p.shown.value.empty())
                p.shown.value = fmt::format("{:.15g}", constant_number(value) / p.shown.size);
        }
    for (Coordinate& c : scene.coordinates) {
        if (c.name.text == name) c.initial = constant(value), c.initial_is_guess = false;
        if (c.name.text + "'" == name) c.rate = constant(value), c.rate_is_guess = false;
    }
    for (Speed& s : scene.speeds)
        if (s.name.text == name) s.initial = constant(value);
    for (FirstOrderState& z : scene.states)
        if (z.name.text == name) z.initial = constant(value);
}

}  // namespace

void note_given(Scene& scene, const std::string& given) {
    scene.text += fmt::format("\n# given for this run: {}", given);
}

Scene with_values(Scene scene, const std::vector<std::pair<std::string, std::string>>& at) {
    if (at.empty()) return scene;
    Overrides numbers;
    for (const auto& [name, value] : at) numbers.emplace_back(name, constant_number(value));
    Scene quiet = scene;
    quiet.on_warning = [](const Warning&) {};
    const Overrides others = with_inputs_given(scene, numbers);
    start_of(prepared(std::move(quiet), numbers).mechanism, others);  // refuses what is wrong
    for (const auto& [name, value] : at) {
        const auto is_it = [&of = name](const auto& one) { return one.first == of; };
        if (std::any_of(others.begin(), others.end(), is_it)) give(scene, name, value);
        note_given(scene, fmt::format("{} = {}", name, value));
    }
    return scene;
}

Scene with_numbers(Scene scene, const std::vector<std::pair<std::string, double>>& at) {
    std::vector<std::pair<std::string, std::string>> typed;
    for (const auto& [name, value] : at) typed.emplace_back(name, fmt::format("{:.17g}", value));
    return with_values(std::move(scene), typed);
}

}  // namespace alembert
