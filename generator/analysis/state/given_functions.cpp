// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/given_functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "alembert/base/error.hpp"
#include "analysis/state/given_values.hpp"
#include "base/language/say.hpp"
#include "scene/check.hpp"
#include "scene/dimension_check.hpp"
#include "scene/known_names.hpp"
#include "scene/point_table.hpp"
#include "scene/text_file.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

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
    note_given(scene, fmt::format("{}: {}", name, made.table->fingerprint()));
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

/// Gives the input its value as the reader of scenes does, in the unit that the scene gives for it.
void read_function(Scene& scene, Input& input, const std::string& how) {
    const std::string& name = input.name.text;
    std::vector<Diagnostic> found;
    const KnownNames names(scene);
    note_given(scene, fmt::format("{} = {}", name, how));
    input.value = parse_expression(how, {}, found, &names);
    if (!input.value) refuse(name, how, found.empty() ? say("this is no expression") : found.front().message);
    if (!input.shown.unit.empty()) input.unit = std::exchange(input.shown, {}).unit;
    convert_units(scene, found);
    for (Diagnostic& one : contradicting_dimensions(scene)) found.push_back(std::move(one));
    for (Diagnostic& one : found) {
        if (one.severity == Severity::error) refuse(name, how, one.message);
        if (one.place.line > 0) continue;  // the scene's own, told with it
        one.message = say("--input {}={}: {}", name, how, one.message);
        scene.warnings.push_back(std::move(one));
    }
}

}  // namespace

Scene with_input(Scene scene, const std::string& name, const std::string& how) {
    const auto input = std::find_if(scene.inputs.begin(), scene.inputs.end(),
                                    [&](const Input& one) { return one.name.text == name; });
    if (input == scene.inputs.end()) refuse(name, how, say("the scene has no input of this name"));
    if (!input->from_outside)
        refuse(name, how,
               say("this input has its function in the scene; one that is given by whoever runs the equations has "
                   "given = \"outside\""));
    input->from_outside = false;
    if (how.ends_with(".csv"))
        input->value = by_table(scene, name, how);
    else
        read_function(scene, *input, how);
    std::vector<Diagnostic> warnings;
    const std::vector<Diagnostic> mistakes = check_scene(scene, {}, warnings);
    if (!mistakes.empty()) refuse(name, how, mistakes.front().message);
    return scene;
}

}  // namespace alembert
