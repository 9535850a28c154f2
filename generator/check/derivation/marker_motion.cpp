// SPDX-License-Identifier: GPL-2.0-or-later
// What is true in motion, on a branch, or for some values of the parameters alone: derivatives that are written
// out, roots of first integrals, special cases.
#include "check/derivation/marker.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"
#include "check/written/sentences.hpp"
#include "check/written/words.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

bool holds_derivative(const Math& math) {
    return math.kind == Kind::partial || math.kind == Kind::rate || math.kind == Kind::variation ||
           std::any_of(math.args.begin(), math.args.end(),
                       [](const MathPtr& arg) { return holds_derivative(*arg); });
}

/// √(…) with factors before it; what stands under it is no number, as in √2 m.
bool is_root_sign(const Math& math, const std::function<bool(const Math&)>& may_change) {
    if (math.kind == Kind::call) return math.text == "sqrt" && may_change(*math.args[0]);
    const bool is_factor = math.kind == Kind::product || math.kind == Kind::negate || math.kind == Kind::quotient;
    return is_factor && std::any_of(math.args.begin(), math.args.end(),
                                    [&](const MathPtr& arg) { return is_root_sign(*arg, may_change); });
}

}  // namespace

/// d/dt of something written, or the rate of a quantity that the derivation has named.
bool Marker::is_written_rate(const Math& side) const {
    if (side.kind == Kind::rate) return true;
    if (side.kind != Kind::letter) return false;
    const auto name = letters_.name_of(side.letter);
    if (!name || letters_.is_of_scene(*name) || !known_.contains(*name)) return false;
    const Mechanism& m = system_.mechanism();
    return side.dots > 0 || m.z->depends(known_.at(*name), m.qddot);  // F* of Kane
}

/// d/dt(m r² φ') = m r φ'' + 2 m r' φ': both sides vanish in motion, and yet it is no derivative.
bool Marker::is_wrong_derivative(MarkedLine& line, const Sides& sides) {
    const auto is_plain = [&](const Math& side) {
        return !holds_derivative(side) && !(side.kind == Kind::number && side.text == "0") &&
               !is_written_rate(side);
    };
    const bool turned = is_written_rate(*sides.rhs) && is_plain(*sides.lhs);
    if (!turned && !(is_written_rate(*sides.lhs) && is_plain(*sides.rhs))) return false;
    MotionRows& rows = system_.rows();
    const Mechanism& m = system_.mechanism();
    const ex left = truth_.value(sides.left.text), right = truth_.value(sides.right.text);
    if (rows.holds(rows.row(left)) != true || rows.holds(rows.row(right)) != true) return false;
    const ex difference = m.z->name(left - right);
    const bool is_accelerated = m.z->depends(left, m.qddot) || m.z->depends(right, m.qddot);
    if (is_identically_zero(difference, m)) return false;
    if (is_accelerated && rows.is_identity(rows.row(difference)) == true) return false;  // on the constraints
    line.status = LineStatus::mistake;
    line.reason = say("both sides vanish in motion, but one is not the derivative that the other is");
    notes_.back().claim = {};
    return true;
}

/// r' = √(2(E − V)/m): true on the branch that the root shows.
bool Marker::is_on_branch(MarkedLine& line, const Sides& sides) {
    if (holds_root(*sides.lhs) ||
        holds_root(*sides.rhs)) {  // x = r cos α + √(l² − r² sin²α), on the scene's branch
        const std::vector<CheckedClaim> verdicts = checked_alone(notes_.back().claim);
        if (!verdicts.empty() && verdicts[0].verdict == Verdict::proved) {
            line.status = LineStatus::right;
            return true;
        }
    }
    const auto may_change = [&](const Math& math) {
        std::map<Letter, int> all;
        collect_letters(math, all);
        return std::any_of(all.begin(), all.end(), [&](const auto& item) {
            const auto name = letters_.name_of(item.first);
            return !name || !letters_.is_of_scene(*name) || letters_.moves(*name);
        });
    };
    if (!is_root_sign(*sides.lhs, may_change) && !is_root_sign(*sides.rhs, may_change)) return false;
    if (!holds_rates(*sides.lhs) && !holds_rates(*sides.rhs)) return false;  // a place has the sign that it has
    const ex left = truth_.value(sides.left.text), right = truth_.value(sides.right.text);
    const ex difference = GiNaC::pow(left, 2) - GiNaC::pow(right, 2);
    MotionRows& rows = system_.rows();
    if (rows.holds(rows.row(difference)) != true) return false;
    line.status = LineStatus::right;
    line.reason = say("on the branch where both sides have one sign");
    notes_.back().claim = {};
    return true;
}

/// The verdict on one claim; none where it could not be asked for.
std::vector<CheckedClaim> Marker::checked_alone(const LineClaim& claim) const {
    try {
        return system_.check({claim}, known_to_check());
    } catch (const std::exception&) {
        return {};
    }
}

/// "Momentum is conserved, so … = C": the words say that it keeps its value. Returns whether they do.
bool Marker::is_said_to_be_conserved(MarkedLine& line, const ClaimText& text, const Letter& letter, bool turned) {
    const Mechanism& m = system_.mechanism();
    const ex value = truth_.value(text.text);
    static const std::set<std::string> of_integrals{"h", "H", "J", "E", "C", "K", "I"};
    const bool is_named = statement_->displayed && of_integrals.contains(letter.base) &&
                          says_conserved_is(statement_->words);  // "What is conserved is h = …"
    const bool is_said =
        turned ? speaks_of_conservation(heard_.around) : is_named || speaks_of_conservation(heard_.behind);
    const bool is_integral = turned && statement_->displayed && is_letter_of_constant(letter);
    if (!(is_said || is_integral) || !m.z->depends(value, m.qdot)) return false;
    if (m.z->depends(value, m.qddot)) return false;
    if (follows_in_special_case(m.time_derivative({value})[0])) {
        settle_in_special_case(line);
        return true;
    }
    line.status = LineStatus::mistake;
    line.reason = say("it does not keep its value");
    follows_as_constant(line, text);
    return true;
}

/// An integral of the derivation's own wrong equations.
void Marker::follows_as_constant(MarkedLine& line, const ClaimText& text) {
    const MotionRow rate = system_.rows().row(system_.mechanism().time_derivative({own_.value(text.text)})[0]);
    const auto from = [&] { return own_.explained_by(rate, heard_.small); };
    line.follows_from = from();
    if (!line.follows_from && is_from_inertia(line, from)) return;
    if (!line.follows_from) return;
    line.status = LineStatus::follows;
    line.reason = say("it follows from line {}", lines[*line.follows_from].line);
}

/// m_1 = m_2 or k = 40: from then on lines may hold for these values alone.
void Marker::take_in_special_case(const Math& lhs, const Math& rhs) {
    const Mechanism& m = system_.mechanism();
    const auto is_parameter = [&](const Math* letter) {
        const auto name = letter == nullptr ? std::nullopt : letters_.name_of(letter->letter);
        return name && letters_.is_of_scene(*name);
    };
    const auto alone = [&](const Math& side) {  // h'' of an input too
        const bool is_rate = side.kind == Kind::letter && is_input(letters_.name_of(side.letter).value_or(""));
        return is_rate ? Lone{&side, 1} : lone_letter(side);
    };
    const Lone left = alone(lhs), right = alone(rhs);
    const bool is_left = is_parameter(left.letter);
    if (!is_left && !is_parameter(right.letter)) {
        heard_.put_under_condition();
        return take_in_relation(lhs, rhs);
    }
    try {
        const Lone& lone = is_left ? left : right;
        const ex name = truth_.value(claim_text(*lone.letter, as_written()).text);
        const Math& stated = is_left ? rhs : lhs;
        const std::optional<ex> datum = datum_of(name, stated);
        const ex value =
            datum ? m.z->expand(*datum) : m.z->expand(truth_.value(claim_text(stated, as_written()).text));
        if (!GiNaC::is_a<GiNaC::symbol>(name) || value.has(name)) return;
        set_special_value(name, GiNaC::pow(value, GiNaC::numeric(1, lone.power)));
        stop_input(name, value);
        const bool is_datum = GiNaC::is_a<GiNaC::numeric>(value) && !value.is_zero();
        if (!is_datum) special_.open();  // k = 40 N/m holds for the whole page
    } catch (const NoMeaning&) {
        heard_.put_under_condition();
    }
}

/// k_1 a = k_2 b: one of the parameters by the others.
void Marker::take_in_relation(const Math& lhs, const Math& rhs) try {
    const Mechanism& m = system_.mechanism();
    const ex residual = m.z->expand(truth_.value(claim_text(lhs, as_written()).text) -
                                    truth_.value(claim_text(rhs, as_written()).text))
                            .expand();
    if (!is_of_parameters(residual)) return;
    for (const Mechanism::Parameter& p : m.parameters) {
        if (!p.independent || !residual.is_polynomial(p.symbol) || residual.degree(p.symbol) != 1) continue;
        const ex slope = residual.coeff(p.symbol, 1);
        if (slope.is_zero()) continue;
        set_special_value(p.symbol, (-residual.coeff(p.symbol, 0) / slope).normal());
        special_.open();
        return;
    }
} catch (const NoMeaning&) {  // a letter that nothing gives
}

/// An input that is constant, or whose rate is, has no higher derivatives: of h' = 0 also h'' = 0.
void Marker::stop_input(const ex& name, const ex& value) {
    if (!is_of_parameters(value)) return;
    for (const Mechanism::Input& input : system_.mechanism().inputs)
        for (std::size_t k = 0; k + 1 < input.derivative.size(); ++k)
            if (name.is_equal(input.derivative[k]))
                for (std::size_t higher = k + 1; higher < input.derivative.size(); ++higher)
                    set_special_value(input.derivative[higher], 0);
}

void Marker::set_special_value(const ex& name, const ex& value) {
    const bool is_line = statement_->sides.size() > 1 && is_judging_;
    special_.state(name, value, is_line ? SpecialValues::From::line : SpecialValues::From::words);
}

/// Whether the line follows from the equations of motion for the values that the derivation has stated.
bool Marker::follows_in_special_case(const ex& residual) {
    for (const GiNaC::exmap* values : special_.cases()) {
        if (!follows_with(residual, *values)) continue;
        used_values_ = *values;
        return true;
    }
    return false;
}

bool Marker::follows_with(const ex& residual, const GiNaC::exmap& values) {
    const bool says_nothing = is_identically_zero(system_.mechanism().z->name(residual), system_.mechanism());
    if (values.empty() || says_nothing) return false;
    const Mechanism& m = system_.mechanism();
    std::vector<ex> all{residual};
    for (int i = 0; i < m.size(); ++i) all.push_back(system_.motion_residual(i));
    std::vector<ex> special;
    try {
        special = substitute(*m.z, all, values);  // of inputs too, F = 0
        special = substitute(*m.z, substitute(*m.z, special, system_.inputs_in_time()), values);
    } catch (const std::exception&) {  // m = 0 where something is divided by m
        return false;
    }
    const auto follow = [&](const std::vector<ex>& parts, bool bound) {
        MotionRows& rows = system_.rows();
        std::vector<MotionRow> given;
        std::vector<const MotionRow*> pointers;
        for (std::size_t k = 1; k < parts.size(); ++k) given.push_back(rows.row(parts[k]));
        for (const MotionRow& row : given) pointers.push_back(&row);
        return rows.follows(rows.row(parts[0]), pointers, bound);
    };
    if (follow(special, true)) return true;
    if (!heard_.small || !m.z->depends(residual, m.qddot)) return false;  // energies have no part of first order
    for (const BaseState& base : bases()) {
        std::vector<ex> parts;
        for (const ex& value : special)
            if (const auto part = part_of_first_order(value, base, system_)) parts.push_back(m.z->name(*part));
        if (parts.size() == special.size() && follow(parts, false)) return true;
    }
    return false;
}

/// "c = 0, m1 = m2".
std::string Marker::told_values(const GiNaC::exmap& values) const {
    constexpr std::size_t most_terms = 20;
    std::string told;
    for (const auto& [name, value] : values) {
        const auto sum = fourier(system_.mechanism().z->expand(value), *system_.mechanism().symbols, most_terms);
        told += (told.empty() ? "" : ", ") + GiNaC::ex_to<GiNaC::symbol>(name).get_name() + " = " +
                (sum ? text(readable(*sum)) : "…");
    }
    return told;
}

/// Right for these values; not judged where a sentence has ended since they were stated.
void Marker::settle_in_special_case(MarkedLine& line) {
    const bool is_over = special_.is_over(statement_->words);
    const bool is_of_other_part =
        statement_->words.find("**") != std::string::npos || statement_->words.find('#') != std::string::npos;
    const bool leaves_out = std::any_of(used_values_.begin(), used_values_.end(),
                                        [](const auto& item) { return item.second.is_zero(); });
    if (is_over && is_of_other_part && leaves_out) return;  // what fails there is a mistake
    line.status = is_over ? LineStatus::not_about_scene : LineStatus::right;
    line.reason =
        is_over
            ? say("it holds for values of parameters that stand above; whether they are still meant is not said")
            : say("for the values of parameters that the derivation states: {}", told_values(used_values_));
    notes_.back().claim = {};
}

}  // namespace alembert
