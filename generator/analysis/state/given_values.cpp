// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/given_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "analysis/state/assemble.hpp"
#include "analysis/state/given_inputs.hpp"
#include "analysis/state/prepared.hpp"
#include "base/language/say.hpp"
#include "model/constant.hpp"
#include "scene/check.hpp"
#include "scene/known_names.hpp"
#include "scene/lists.hpp"
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

using Row = std::pair<double, double>;

constexpr std::size_t most_rows = 500;

/// A header may come first; lines that are empty are left out.
std::vector<Row> rows_of(const std::string& name, const std::string& file) {
    std::vector<Row> rows;
    std::istringstream text(text_of_file(file));
    std::size_t count = 0;
    for (std::string line; std::getline(text, line);) {
        ++count;
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        const std::vector<std::string> fields = at_commas(line);
        Row row;
        try {
            if (fields.size() != 2) throw std::invalid_argument("");
            row = {std::stod(fields[0]), std::stod(fields[1])};
        } catch (const std::exception&) {
            if (rows.empty() && count == 1) continue;  // the names of the columns
            refuse(name, file,
                   say("line {} is '{}'; expected a time and a value with a comma between", count, line));
        }
        if (!std::isfinite(row.first) || !std::isfinite(row.second))
            refuse(name, file, say("line {} has a value that is not finite", count));
        if (!rows.empty() && !(row.first > rows.back().first))
            refuse(name, file, say("the time in line {} is not later than the one before", count));
        rows.push_back(row);
    }
    if (rows.empty()) refuse(name, file, say("there is no row; expected a time and a value in each line"));
    if (rows.size() > most_rows)
        refuse(name, file,
               say("there are {} rows; a run takes at most {}: leave out those between which the input is nearly "
                   "linear",
                   rows.size(), most_rows));
    return rows;
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
TreePtr linear_between(const std::vector<Row>& rows) {
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

Expression function_of(Scene& scene, const std::string& name, const std::string& how) {
    if (how.ends_with(".csv")) {
        std::vector<Row> rows = rows_of(name, how);
        const double size = unit_of_name(scene, name).size;
        for (Row& row : rows) {
            note(scene, fmt::format("{} = {:.17g} at {:.17g}", name, row.second, row.first));
            row.second *= size;
        }
        return {.text = how, .places = {}, .tree = linear_between(rows)};
    }
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
