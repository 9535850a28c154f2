// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/given_functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "alembert/base/error.hpp"
#include "analysis/state/given_values.hpp"
#include "analysis/state/input_rows.hpp"
#include "base/language/say.hpp"
#include "scene/check.hpp"
#include "scene/dimension_check.hpp"
#include "scene/known_names.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& how, const std::string& why) {
    throw ModelError(say("--input {}={}: {}", name, how, why));
}

TreePtr made(Tree tree) {
    return std::make_shared<const Tree>(std::move(tree));
}

TreePtr literal(double value) {
    const TreePtr size = made({.kind = Tree::Kind::number, .text = fmt::format("{:.17g}", std::abs(value))});
    return value < 0 ? made({.kind = Tree::Kind::negate, .text = {}, .args = {size}}) : size;
}

TreePtr after(double time) {
    return made({.kind = Tree::Kind::sum,
                 .text = {},
                 .args = {made({.kind = Tree::Kind::name, .text = "t"}), literal(-time)}});
}

/// Σ (v_k + s_k (t − t_k)) (σ_k − σ_{k+1})/2 with σ_k = sign(t − t_k): all terms but one are exactly zero.
TreePtr linear_between(const std::vector<InputRow>& rows) {
    const auto sign = [](double time) {
        return made({.kind = Tree::Kind::call, .text = "sign", .args = {after(time)}});
    };
    const auto minus = [](TreePtr x) { return made({.kind = Tree::Kind::negate, .text = {}, .args = {x}}); };
    const auto sum = [](std::vector<TreePtr> args) {
        return made({.kind = Tree::Kind::sum, .text = {}, .args = std::move(args)});
    };
    const auto half_of = [](TreePtr value, TreePtr switches) {
        return made({.kind = Tree::Kind::product, .text = {}, .args = {literal(0.5), value, switches}});
    };
    std::vector<TreePtr> terms{
        half_of(literal(rows.front().second), sum({literal(1), minus(sign(rows[0].first))})),
        half_of(literal(rows.back().second), sum({literal(1), sign(rows.back().first)}))};
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
        const double slope = (rows[k + 1].second - rows[k].second) / (rows[k + 1].first - rows[k].first);
        const TreePtr rise =
            made({.kind = Tree::Kind::product, .text = {}, .args = {literal(slope), after(rows[k].first)}});
        terms.push_back(half_of(sum({literal(rows[k].second), rise}),
                                sum({sign(rows[k].first), minus(sign(rows[k + 1].first))})));
    }
    return sum(std::move(terms));
}

Expression table_of(Scene& scene, const std::string& name, const std::string& file) try {
    std::vector<InputRow> rows = input_rows(file);
    const double size = unit_of_name(scene, name).size;
    for (InputRow& row : rows) {
        note_given(scene, fmt::format("{} = {:.17g} at {:.17g}", name, row.second, row.first));
        row.second *= size;
    }
    return {.text = file, .places = {}, .tree = linear_between(rows)};
} catch (const ModelError& mistake) {
    refuse(name, file, mistake.what());
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
        input->value = table_of(scene, name, how);
    else
        read_function(scene, *input, how);
    std::vector<Diagnostic> warnings;
    const std::vector<Diagnostic> mistakes = check_scene(scene, {}, warnings);
    if (!mistakes.empty()) refuse(name, how, mistakes.front().message);
    return scene;
}

}  // namespace alembert
