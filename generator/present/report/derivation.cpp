// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/derivation.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "algebra/notation/latex.hpp"
#include "algebra/notation/operations.hpp"
#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"
#include "present/report/formula_page.hpp"
#include "scene/concluded_dimensions.hpp"

namespace alembert {

namespace {

void add_to(Block& block, std::string left, std::string right, std::size_t operations) {
    block.equalities.emplace_back(std::move(left), std::move(right));
    block.operations.push_back(operations);
}

/// The four steps of the book without the equations themselves.
std::vector<Block> steps(const Derivation& shown, const Notation& n) {
    const auto block_of = [&](const std::string& words, const std::vector<Statement>& list) {
        Block result{words, {}};
        for (const Statement& s : list) add_to(result, n.left(s), n.phrase(s.value), operations_in(s.value));
        return result;
    };
    std::string names;
    for (const Phrase& q : shown.coordinates) names += (names.empty() ? "" : ", ") + n.inline_phrase(q);
    const int freedom = shown.degrees_of_freedom;
    std::vector<Block> blocks{
        {say("1. The system has {} degree{} of freedom; generalized coordinate{}: {}.", freedom,
             freedom == 1 ? "" : "s", shown.coordinates.size() == 1 ? "" : "s", names),
         {}}};

    if (!shown.motion.empty())
        blocks.push_back(
            block_of(say("Positions of the mass centres along the axes of N, and velocities:"), shown.motion));
    if (!shown.angular.empty())
        blocks.push_back(block_of(say("Angular velocities along the axes of the bodies:"), shown.angular));
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
    blocks.push_back(block_of(shown.lagrangian ? say("2. The Lagrangian, as the scene gives it:")
                                               : say("2. Kinetic and potential energy:"),
                              energies));
    blocks.push_back(block_of(shown.forces.empty()
                                  ? say("3. No force does virtual work beside what is in the energies.")
                                  : say("3. Generalized forces, from the virtual work dW = sum of Q(q) dq:"),
                              shown.forces));
    if (!shown.choice.empty()) {  // the formalism's own steps are in these speeds
        blocks.push_back({shown.choice, {}, Block::Kind::equation});
        for (const auto& [speed, form] : shown.speeds)
            add_to(blocks.back(), n.phrase(speed), n.phrase(form), operations_in(form));
    }
    for (std::size_t k = 0; k < shown.sections.size(); ++k) {
        const Section& section = shown.sections[k];
        blocks.push_back(block_of((k == 0 ? "4. " : "") + section.words, section.statements));
        for (const auto& [left, right] : section.equalities)
            add_to(blocks.back(), n.phrase(left), n.phrase(right), operations_in(left) + operations_in(right));
    }
    if (!shown.sections.empty()) return blocks;
    blocks.push_back(block_of(shown.lagrangian ? say("4. For Lagrange's equations d/dt dL/dq' - dL/dq = Q:")
                                               : say("4. For Lagrange's equations d/dt dT/dq' - dT/dq = Q:"),
                              shown.derivatives));
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
    for (const Mechanism::State& z : m.states) result["states"].push_back(z.derivative[0].get_name());
    for (const auto& [rate, value] : shown.states)
        result["state_rates"].push_back(
            {{"text", text(rate) + " = " + text(value)}, {"latex", latex(rate) + " = " + latex(value)}});
    result["multipliers"] = Json::array();
    for (const auto* list : {&m.constraints, &m.redundant})
        for (const Mechanism::Constraint& c : *list) result["multipliers"].push_back(c.multiplier.get_name());
    if (!shown.gaps.empty()) {
        result["gaps"] = Json::object();
        for (const auto& [name, phrase] : shown.gaps) result["gaps"][name] = text(phrase);
    }
    for (const Derivation::Rubs& f : shown.frictions) {
        Json one = {
            {"name", f.name},
            {"slip", f.across ? Json{text(f.sliding_velocity), text(*f.across)} : Json(text(f.sliding_velocity))},
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
    for (const ReadableSign& sign : shown.signs) result["where"].push_back(text(sign.of) + ' ' + sign.words);
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
    if (d.mechanism.q.empty())
        return d.mechanism.states.empty() ? say("The scene has no coordinates: nothing in it moves.")
                                          : say("The scene has no coordinates.");
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

namespace {

/// The blocks of a derivation, one after the other.
class DerivationBlocks {
public:
    DerivationBlocks(const DerivedScene& d, const Notation& n) : d_(d), shown_(d.shown), n_(n) {}

    std::vector<Block> run(bool with_steps) {
        add_definitions(with_steps);
        add_equations();
        add_constraints();
        add_reactions();
        add_gaps();
        for (const Derivation::Rubs& f : shown_.frictions) add_friction(f);
        for (std::size_t i = 0; i < shown_.equations.size(); ++i)
            if (shown_.equations[i].divided_by)
                begin(scaling(shown_.rows[i], *shown_.equations[i].divided_by, n_), Kind::remark);
        return std::move(blocks_);
    }

private:
    using Kind = Block::Kind;

    void begin(const std::string& words, Kind kind) {
        blocks_.push_back({.words = words, .equalities = {}, .kind = kind});
    }
    void add(std::string left, std::string right, std::size_t operations) {
        add_to(blocks_.back(), std::move(left), std::move(right), operations);
    }
    void add(const std::vector<Statement>& list) {
        for (const Statement& s : list) add(n_.left(s), n_.phrase(s.value), operations_in(s.value));
    }
    void add(const Phrase& left, const Phrase& right) {
        add(n_.phrase(left), n_.phrase(right), operations_in(left) + operations_in(right));
    }
    void add(const std::vector<ReadableEquation>& list) {
        for (const ReadableEquation& e : list) add(e.lhs, e.rhs);
    }
    void add(const std::vector<std::pair<Phrase, Phrase>>& list) {
        for (const auto& [left, right] : list) add(left, right);
    }

    /// The intermediate symbols, or the steps of the derivation.
    void add_definitions(bool with_steps) {
        if (!shown_.definitions.empty()) {
            begin(say("The equations are beyond the readable size; intermediate symbols:"), Kind::definition);
            add(shown_.definitions);
            blocks_.back().with_symbols = true;
            for (const Section& section : shown_.sections) {
                if (!with_steps) break;
                begin(section.words, Kind::step);
                add(section.statements);
            }
        } else if (with_steps && shown_.program_operations == 0) {
            blocks_ = steps(shown_, n_);
            return;
        }
        if (!shown_.choice.empty()) begin(shown_.choice, Kind::equation);
        add(shown_.speeds);
    }

    void add_equations() {
        begin(words_before_equations(d_), Kind::equation);
        if (shown_.program_operations > 0)
            begin(say("({} lines, left out because of the length; as a program they take {} operations. 'derive "
                      "--full' "
                      "prints everything, --json has it, and 'emit' writes that program.)",
                      shown_.coordinates.size(), shown_.program_operations),
                  Kind::remark);
        add(shown_.equations);
        blocks_.back().with_symbols = !shown_.definitions.empty();
        if (!shown_.states.empty()) {
            begin(say("with the rates of the states:"), Kind::equation);
            add(shown_.states);
            blocks_.back().with_symbols = !shown_.definitions.empty();
        }
        if (!shown_.abbreviations.empty()) {
            begin(say("with the scene's definitions:"), Kind::equation);
            add(shown_.abbreviations);
        }
        if (shown_.has_unit_quaternions)
            begin(say("e.e = 1 of each quaternion e has been used in all terms, after differentiation."),
                  Kind::equation);
        for (const ReadableSign& sign : shown_.signs)
            begin(say("valid while {} {}", n_.inline_phrase(sign.of), sign.words), Kind::equation);
        if (!shown_.kinematics.empty()) {
            begin(say("with the rates of the coordinates:"), Kind::equation);
            add(shown_.kinematics);
            blocks_.back().with_symbols = !shown_.definitions.empty();
        }
        for (const Phrase& pole : shown_.poles)
            begin(say("They do not follow from the speeds where {} = 0.", n_.inline_phrase(pole)), Kind::equation);
    }

    void add_constraints() {
        if (!shown_.constraints.empty()) {
            const bool all = d_.equations.A.empty();
            begin(all ? say("The constraints, which the speeds obey:")
                      : say("with the constraints (multipliers stand on the right with a plus: M q'' = F "
                            "+ A^T lambda):"),
                  Kind::equation);
            for (const auto& [name, phrase] : shown_.constraints) add(phrase, phrases::number(0));
        }
        if (!shown_.shares.empty()) {
            begin(say("with the least reactions, since constraints depend on each other:"), Kind::equation);
            add(shown_.shares);
        }
    }

    void add_reactions() {
        if (!shown_.reactions.empty()) {
            begin(say("Reactions as generalized forces, Q = A^T lambda:"), Kind::remark);
            add(shown_.reactions);
        }
        if (!d_.joint_loads.empty()) {
            begin(say("Joints bear, as force and moment on the child at its point, along the joint's axes "
                      "in the parent:"),
                  Kind::remark);
            add(d_.joint_loads);
        }
        if (!d_.normal_reactions.empty()) {
            begin(say("The ground presses bodies that roll with the normal reactions (lambda_NAME_normal):"),
                  Kind::remark);
            add(d_.normal_reactions);
        }
    }

    void add_gaps() {
        if (shown_.gaps.empty()) return;
        begin(say("with the unilateral constraints gap >= 0, lambda >= 0, lambda*gap = 0 for the gaps:"),
              Kind::equation);
        for (const auto& [name, phrase] : shown_.gaps)
            add(n_.left({Statement::Kind::energy, "gap", name, {}, {}}), n_.phrase(phrase), operations_in(phrase));
    }

    void add_friction(const Derivation::Rubs& f) {
        begin(say("Friction '{}' acts with the force {} against the sliding velocity {}. Where that is 0 it "
                  "sticks: the velocity stays 0, and a force of at most {} takes the place of the sliding "
                  "one.",
                  f.name, n_.inline_phrase(f.sliding),
                  f.across
                      ? fmt::format("({}, {})", n_.inline_phrase(f.sliding_velocity), n_.inline_phrase(*f.across))
                      : n_.inline_phrase(f.sliding_velocity),
                  n_.inline_phrase(f.sticking)),
              Kind::remark);
        if (f.operations > 0)
            begin(say("While '{}' sticks, with its force {}, the equations are too long to be read: they have {} "
                      "operations even with intermediate symbols. 'derive --full' prints them.",
                      f.name, fmt::join(f.forces, ", "), f.operations),
                  Kind::remark);
        if (f.held.empty()) return;
        begin(say("While '{}' sticks, with its force {}:", f.name, fmt::join(f.forces, ", ")), Kind::remark);
        add(f.held);
    }

    const DerivedScene& d_;
    const Derivation& shown_;
    const Notation& n_;
    std::vector<Block> blocks_;
};

}  // namespace

void leave_out_what_is_too_long(std::vector<Block>& blocks, const Readable& most) {
    std::size_t lines = 0, operations = 0;
    bool without_symbols = false;  // nobody can read the equations without them
    std::vector<Block> result;
    for (Block& block : blocks) {
        const std::size_t own_lines = block.equalities.size(),
                          own = std::accumulate(block.operations.begin(), block.operations.end(), std::size_t{0});
        const bool longest = std::any_of(block.operations.begin(), block.operations.end(),
                                         [&](std::size_t one) { return one > most.of_one; });
        const bool fits = !longest && lines + own_lines <= most.lines && operations + own <= most.operations;
        const bool kept = fits && !(block.with_symbols && without_symbols);
        without_symbols = without_symbols || (block.with_symbols && !kept);
        result.push_back(std::move(block));
        if (kept) {
            lines += own_lines;
            operations += own;
            continue;
        }
        result.back().equalities.clear();
        result.push_back(
            {say("({} line{} with {} operations, left out because of the length. 'derive --full' prints "
                 "everything, --json has it, and 'emit' writes the equations as a program.)",
                 own_lines, own_lines == 1 ? "" : "s", own),
             {}});
    }
    blocks = std::move(result);
}

std::vector<Block> blocks_of(const DerivedScene& d, const Notation& n, bool with_steps) {
    return DerivationBlocks(d, n).run(with_steps);
}

std::string as_page(const DerivedScene& d, const PageOptions& options) {
    const Notation n = notation_of(options.format);
    std::vector<Block> blocks = blocks_of(d, n, options.steps);
    if (!options.full) leave_out_what_is_too_long(blocks);
    if (options.dimensions) blocks.push_back(dimensions_of(d.scene));
    if (options.format == "text" && !d.scene.title.empty()) blocks.insert(blocks.begin(), {d.scene.title, {}});
    return n.page(blocks);
}

}  // namespace alembert
