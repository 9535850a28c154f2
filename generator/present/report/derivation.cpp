// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/derivation.hpp"

#include <fmt/ranges.h>

#include "algebra/notation/latex.hpp"
#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"
#include "present/report/formula_page.hpp"
#include "scene/concluded_dimensions.hpp"

namespace alembert {

namespace {

/// The four steps of the book without the equations themselves.
std::vector<Block> steps(const Derivation& shown, const Notation& n) {
    const auto statements = [&](const std::vector<Statement>& list) {
        std::vector<std::pair<std::string, std::string>> result;
        for (const Statement& s : list) result.emplace_back(n.left(s), n.phrase(s.value));
        return result;
    };
    std::string names;
    for (const Phrase& q : shown.coordinates) names += (names.empty() ? "" : ", ") + n.inline_phrase(q);
    const int freedom = shown.degrees_of_freedom;
    std::vector<Block> blocks{
        {say("1. The system has {} degree{} of freedom; generalized coordinate{}: {}.", freedom,
             freedom == 1 ? "" : "s", shown.coordinates.size() == 1 ? "" : "s", names),
         {}}};

    if (!shown.angular.empty())
        blocks.push_back({say("Angular velocities along the axes of the bodies:"), statements(shown.angular)});
    std::vector<Statement> energies = shown.energies;
    const auto total = [&](const char* letter, const Phrase& value) {
        energies.push_back({Statement::Kind::energy, letter, "", {}, value});
    };
    if (shown.lagrangian) {
        total("L", *shown.lagrangian);
    } else {
        total("T", shown.kinetic);
        total("V", shown.potential);
    }
    blocks.push_back({shown.lagrangian ? say("2. The Lagrangian, as the scene gives it:")
                                       : say("2. Kinetic and potential energy:"),
                      statements(energies)});
    blocks.push_back({shown.forces.empty()
                          ? say("3. No force does virtual work beside what is in the energies.")
                          : say("3. Generalized forces, from the virtual work dW = sum of Q(q) dq:"),
                      statements(shown.forces)});
    for (std::size_t k = 0; k < shown.sections.size(); ++k) {
        const Section& section = shown.sections[k];
        blocks.push_back({(k == 0 ? "4. " : "") + section.words, statements(section.statements)});
        for (const auto& [left, right] : section.equalities)
            blocks.back().equalities.emplace_back(n.phrase(left), n.phrase(right));
    }
    if (!shown.sections.empty()) return blocks;
    blocks.push_back({shown.lagrangian ? say("4. For Lagrange's equations d/dt dL/dq' - dL/dq = Q:")
                                       : say("4. For Lagrange's equations d/dt dT/dq' - dT/dq = Q:"),
                      statements(shown.derivatives)});
    return blocks;
}

/// "The equation of x has been divided by m*l." or, if that is 1/6, "… multiplied by 6."
std::string scaling(const Phrase& row, const Phrase& divisor, const Notation& n) {
    const bool is_fraction = divisor.kind == Phrase::Kind::quotient && divisor.args[0].is_number(1);
    const bool is_part = divisor.kind == Phrase::Kind::number && divisor.value < 1;
    const Phrase factor = is_fraction ? divisor.args[1] : is_part ? phrases::number(1 / divisor.value) : divisor;
    return say("The equation of {} has been {} by {}.", n.inline_phrase(row),
               is_fraction || is_part ? say("multiplied") : say("divided"), n.inline_phrase(factor));
}

}  // namespace

namespace {

/// "Dimensions: x: m; phi: 1, concluded."
Block dimensions_of(const Scene& scene) {
    std::string list;
    for (const ConcludedDimension& one : concluded_dimensions(scene)) {
        if (!list.empty()) list += "; ";
        list += one.name + ": ";
        list += !one.dimension ? say("does not follow from the units")
                : one.is_given ? alembert::text_of(*one.dimension)
                               : say("{}, concluded", alembert::text_of(*one.dimension));
    }
    return {say("Dimensions in base units: {}.", list), {}};
}

Json dimensions_as_json(const Scene& scene) {
    Json all = Json::object();
    for (const ConcludedDimension& one : concluded_dimensions(scene))
        all[one.name] = {{"unit", one.dimension ? Json(alembert::text_of(*one.dimension)) : Json()},
                         {"is_given", one.is_given}};
    return all;
}

}  // namespace

Json as_json(const DerivedScene& d, bool dimensions) {
    const Derivation& shown = d.shown;
    const Mechanism& m = d.mechanism;
    Json result;
    result["formalism"] = shown.formalism;
    result["degrees_of_freedom"] = shown.degrees_of_freedom;
    result["coordinates"] = Json::array();
    result["speeds"] = Json::array();
    for (const GiNaC::symbol& q : m.q) {
        result["coordinates"].push_back(q.get_name());
        if (m.speeds.empty()) result["speeds"].push_back(q.get_name() + "'");
    }
    for (const Mechanism::Speed& speed : m.speeds) result["speeds"].push_back(speed.u.get_name());
    result["multipliers"] = Json::array();
    for (const auto* list : {&m.constraints, &m.redundant})
        for (const Mechanism::Constraint& c : *list) result["multipliers"].push_back(c.multiplier.get_name());
    if (!shown.gaps.empty()) {
        result["gaps"] = Json::object();
        for (const auto& [name, phrase] : shown.gaps) result["gaps"][name] = text(phrase);
    }
    for (const Derivation::Rubs& f : shown.frictions) {
        Json one = {{"name", f.name},
                    {"slip", f.across ? Json{text(f.slip), text(*f.across)} : Json(text(f.slip))},
                    {"sliding", text(f.sliding)},
                    {"sticking", text(f.sticking)}};
        for (const ReadableEquation& e : f.held)
            one["while_sticking"].push_back(
                {{"text", text(e.lhs) + " = " + text(e.rhs)}, {"latex", latex(e.lhs) + " = " + latex(e.rhs)}});
        result["friction"].push_back(std::move(one));
    }
    if (!shown.reactions.empty()) {
        result["reactions"] = Json::object();
        for (const Statement& r : shown.reactions) result["reactions"][r.of][text(*r.by)] = text(r.value);
    }
    result["kinetic"] = text(shown.kinetic);
    result["potential"] = text(shown.potential);
    if (shown.lagrangian) result["lagrangian"] = text(*shown.lagrangian);
    result["equations"] = Json::array();
    for (const ReadableEquation& e : shown.equations) {
        Json one = {{"text", text(e.lhs) + " = " + text(e.rhs)}, {"latex", latex(e.lhs) + " = " + latex(e.rhs)}};
        if (e.divided_by) one["divided_by"] = text(*e.divided_by);
        result["equations"].push_back(std::move(one));
    }
    for (const Phrase& positive : shown.positive) result["where"].push_back(text(positive) + " > 0");
    for (const ReadableEquation& e : shown.shares)
        result["shares"].push_back(
            {{"text", text(e.lhs) + " = " + text(e.rhs)}, {"latex", latex(e.lhs) + " = " + latex(e.rhs)}});
    if (!shown.kinematics.empty()) {
        result["kinematics"] = Json::array();
        for (const auto& [rate, value] : shown.kinematics)
            result["kinematics"].push_back(
                {{"text", text(rate) + " = " + text(value)}, {"latex", latex(rate) + " = " + latex(value)}});
    }
    for (const auto* list : {&shown.speeds, &shown.definitions, &shown.abbreviations})
        for (const auto& [name, value] : *list)
            result["definitions"].push_back({{"name", text(name)}, {"text", text(value)}});
    for (const Statement& s : d.joint_loads) result["joint_reactions"][s.of][s.letter] = text(s.value);
    for (const Statement& s : d.normal_reactions)
        result["normal_reactions"]["lambda_" + s.of + "_normal"] = text(s.value);
    if (dimensions) result["dimensions"] = dimensions_as_json(d.scene);
    return result;
}

std::string words_before_equations(const DerivedScene& d) {
    if (d.mechanism.q.empty()) return say("The scene has no coordinates: nothing in it moves.");
    const bool free =
        d.mechanism.constraints.size() == (d.has_unilateral_reactions ? d.mechanism.unilateral.size() : 0);
    return say("Equations of motion ({}{}):", d.shown.title,
               !d.by.empty()                     ? ""
               : !d.equations.speeds_are_rates() ? say("; the scene has generalized speeds")
               : free && d.has_unilateral_reactions
                   ? say("; the coordinates are independent while all gaps are open")
               : free ? say("; the coordinates are independent")
                      : say("; the coordinates are not independent"));
}

std::vector<Block> blocks_of(const DerivedScene& d, const Notation& n, bool with_steps) {
    const Derivation& shown = d.shown;
    std::vector<Block> blocks;
    if (!shown.definitions.empty()) {
        blocks.push_back({say("The equations are beyond the readable size; intermediate symbols:"), {}});
        for (const auto& [name, value] : shown.definitions)
            blocks.back().equalities.emplace_back(n.phrase(name), n.phrase(value));
        for (const Section& section : shown.sections) {
            if (!with_steps) break;
            blocks.push_back({section.words, {}});
            for (const Statement& s : section.statements)
                blocks.back().equalities.emplace_back(n.left(s), n.phrase(s.value));
        }
    } else if (with_steps) {
        for (Block& block : steps(shown, n)) blocks.push_back(std::move(block));
    }
    if (!shown.choice.empty()) blocks.push_back({shown.choice, {}});
    for (const auto& [speed, form] : shown.speeds)
        blocks.back().equalities.emplace_back(n.phrase(speed), n.phrase(form));
    blocks.push_back({words_before_equations(d), {}});
    for (const ReadableEquation& e : shown.equations)
        blocks.back().equalities.emplace_back(n.phrase(e.lhs), n.phrase(e.rhs));
    if (!shown.abbreviations.empty()) {
        blocks.push_back({say("with the scene's definitions:"), {}});
        for (const auto& [name, value] : shown.abbreviations)
            blocks.back().equalities.emplace_back(n.phrase(name), n.phrase(value));
    }
    if (shown.has_unit_quaternions)
        blocks.push_back(
            {say("e.e = 1 of each quaternion e has been used in all terms, after differentiation."), {}});
    for (const Phrase& positive : shown.positive)
        blocks.push_back({say("on the sheet of roots where {} > 0", n.inline_phrase(positive)), {}});
    if (!shown.kinematics.empty()) {
        blocks.push_back({say("with the rates of the coordinates:"), {}});
        for (const auto& [rate, value] : shown.kinematics)
            blocks.back().equalities.emplace_back(n.phrase(rate), n.phrase(value));
    }
    for (const Phrase& pole : shown.poles)
        blocks.push_back({say("They do not follow from the speeds where {} = 0.", n.inline_phrase(pole)), {}});
    if (!shown.constraints.empty()) {
        const bool all = d.equations.A.empty();
        blocks.push_back({all ? say("The constraints, which the speeds obey:")
                              : say("with the constraints (multipliers stand on the right with a plus: M q'' = F "
                                    "+ A^T lambda):"),
                          {}});
        for (const auto& [name, phrase] : shown.constraints)
            blocks.back().equalities.emplace_back(n.phrase(phrase), "0");
    }
    if (!shown.shares.empty()) {
        blocks.push_back({say("with the least reactions, since constraints depend on each other:"), {}});
        for (const ReadableEquation& e : shown.shares)
            blocks.back().equalities.emplace_back(n.phrase(e.lhs), n.phrase(e.rhs));
    }
    if (!shown.reactions.empty()) {
        blocks.push_back({say("Reactions as generalized forces, Q = A^T lambda:"), {}});
        for (const Statement& r : shown.reactions)
            blocks.back().equalities.emplace_back(n.left(r), n.phrase(r.value));
    }
    if (!d.joint_loads.empty()) {
        blocks.push_back({say("Joints bear, as force and moment on the child at its point, along the joint's axes "
                              "in the parent:"),
                          {}});
        for (const Statement& s : d.joint_loads)
            blocks.back().equalities.emplace_back(n.left(s), n.phrase(s.value));
    }
    if (!d.normal_reactions.empty()) {
        blocks.push_back(
            {say("The ground presses bodies that roll with the normal reactions (lambda_NAME_normal):"), {}});
        for (const Statement& s : d.normal_reactions)
            blocks.back().equalities.emplace_back(n.left(s), n.phrase(s.value));
    }
    if (!shown.gaps.empty()) {
        blocks.push_back(
            {say("with the unilateral constraints gap >= 0, lambda >= 0, lambda*gap = 0 for the gaps:"), {}});
        for (const auto& [name, phrase] : shown.gaps)
            blocks.back().equalities.emplace_back(n.left({Statement::Kind::energy, "gap", name, {}, {}}),
                                                  n.phrase(phrase));
    }
    for (const Derivation::Rubs& f : shown.frictions) {
        blocks.push_back(
            {say("Friction '{}' acts with the force {} against the sliding velocity {}. Where that is 0 it "
                 "sticks: the velocity stays 0, and a force of at most {} takes the place of the sliding "
                 "one.",
                 f.name, n.inline_phrase(f.sliding),
                 f.across ? fmt::format("({}, {})", n.inline_phrase(f.slip), n.inline_phrase(*f.across))
                          : n.inline_phrase(f.slip),
                 n.inline_phrase(f.sticking)),
             {}});
        if (f.held.empty()) continue;
        blocks.push_back({say("While '{}' sticks, with its force {}:", f.name, fmt::join(f.forces, ", ")), {}});
        for (const ReadableEquation& e : f.held)
            blocks.back().equalities.emplace_back(n.phrase(e.lhs), n.phrase(e.rhs));
    }
    for (std::size_t i = 0; i < shown.equations.size(); ++i)
        if (shown.equations[i].divided_by)
            blocks.push_back({scaling(shown.rows[i], *shown.equations[i].divided_by, n), {}});
    return blocks;
}

std::string as_page(const DerivedScene& d, const PageOptions& options) {
    const Notation n = notation_of(options.format);
    std::vector<Block> blocks = blocks_of(d, n, options.steps);
    if (options.dimensions) blocks.push_back(dimensions_of(d.scene));
    if (options.format == "text" && !d.scene.title.empty()) blocks.insert(blocks.begin(), {d.scene.title, {}});
    return n.page(blocks);
}

}  // namespace alembert
