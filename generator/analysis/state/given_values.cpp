// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/given_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "analysis/state/assemble.hpp"
#include "analysis/state/given_inputs.hpp"
#include "analysis/state/prepared.hpp"
#include "base/language/say.hpp"
#include "model/constant.hpp"
#include "scene/check.hpp"
#include "scene/known_names.hpp"
#include "scene/point_table.hpp"
#include "scene/text_file.hpp"
#include "scene/units.hpp"

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
            if (!p.shown.value.empty()) p.shown.value = fmt::format("{}", constant_number(value) / p.shown.size);
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

/// Behind the text, by which an interrupted sweep knows its scene again.
void note(Scene& scene, const std::string& given) {
    scene.text += fmt::format("\n# given for this run: {}", given);
}

[[noreturn]] void refuse(const std::string& name, const std::string& how, const std::string& why) {
    throw ModelError(say("--input {}={}: {}", name, how, why));
}

/// A name for the table that the scene has not.
std::string free_name(const Scene& scene, std::string name) {
    const KnownNames names(scene);
    do name += "_of_t";
    while (names.has(name));
    return name;
}

/// The input as a call of the table, which joins the functions of the scene.
Expression by_table(Scene& scene, const std::string& name, const std::string& file) {
    PointRows rows = rows_in_text(text_of_file(file, most_point_bytes), 1);
    if (rows.rows.size() == 1) rows.rows.push_back({{rows.rows[0].numbers[0] + 1, rows.rows[0].numbers[1]}, 0});
    MadeTable made = table_of(std::move(rows), {.arguments = {"t"},
                                                .outside = TabulatedFunction::Outside::hold,
                                                .sizes = {1, unit_of_name(scene, name).size}});
    if (!made.table) refuse(name, file, made.mistake);
    note(scene, fmt::format("{}: {}", name, made.table->fingerprint()));
    const std::string called = free_name(scene, name);
    const auto input = std::find_if(scene.inputs.begin(), scene.inputs.end(),
                                    [&](const Input& one) { return one.name.text == name; });
    const Place place = input->name.place;
    scene.functions.push_back(
        {.name = {called, place}, .arguments = {{"t", place}}, .table = std::move(made.table)});
    const auto time = std::make_shared<const Tree>(Tree{.kind = Tree::Kind::name, .text = "t"});
    return {.text = file,
            .places = {},
            .tree = std::make_shared<const Tree>(Tree{.kind = Tree::Kind::call, .text = called, .args = {time}})};
}

Expression function_of(Scene& scene, const std::string& name, const std::string& how) {
    if (how.ends_with(".csv")) return by_table(scene, name, how);
    std::vector<Diagnostic> mistakes;
    const KnownNames names(scene);
    note(scene, fmt::format("{} = {}", name, how));
    Expression result = parse_expression(in_si(scene, name, how), {}, mistakes, &names);
    if (!result) refuse(name, how, mistakes.empty() ? say("this is no expression") : mistakes.front().message);
    return result;
}

}  // namespace

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
        note(scene, fmt::format("{} = {}", name, value));
    }
    return scene;
}

Scene with_input(Scene scene, const std::string& name, const std::string& how) {
    const auto input = std::find_if(scene.inputs.begin(), scene.inputs.end(),
                                    [&](const Input& one) { return one.name.text == name; });
    if (input == scene.inputs.end()) refuse(name, how, say("the scene has no input of this name"));
    if (!input->from_outside)
        refuse(name, how,
               say("this input has its function in the scene; one that is given by whoever runs the equations has "
                   "given = \"outside\""));
    input->value = function_of(scene, name, how);
    input->from_outside = false;
    std::vector<Diagnostic> warnings;
    const std::vector<Diagnostic> mistakes = check_scene(scene, {}, warnings);
    if (!mistakes.empty()) refuse(name, how, mistakes.front().message);
    return scene;
}

}  // namespace alembert
