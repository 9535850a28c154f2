// SPDX-License-Identifier: GPL-2.0-or-later
// What a line says of a letter that nothing has said before: a definition, a constant of the motion, a force that
// the line determines.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "base/language/say.hpp"
#include "check/derivation/bindings.hpp"
#include "check/derivation/marker.hpp"
#include "check/written/word_kinds.hpp"
#include "check/written/words.hpp"
#include "model/formalism/elements.hpp"
#include "scene/concluded_dimensions.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

/// A letter alone on one side may be introduced here. Returns whether it was; then the line is judged.
bool Marker::introduce(MarkedLine& line, const Math& lhs, const Math& rhs, bool turned) {
    const Lone lone = lone_letter(lhs);
    if (lone.letter == nullptr) return false;
    const bool is_gibbs = heard_.energy_of_accelerations && lone.letter->letter.base == "S" && is_accelerated(rhs);
    const auto name = letters_.name_of(lone.letter->letter);
    if (is_gibbs && name && letters_.is_of_scene(*name)) {  // an impulse S of the scene is another thing
        define(line, *lone.letter, rhs, lone.power);
        return true;
    }
    if (name) {  // introduced here, and used before
        if (!ahead_.contains(lone.letter->letter) || !known_.contains(*name)) return false;
        ahead_.erase(lone.letter->letter);
        judge_pair(line, lhs, rhs);
        if (line.status == LineStatus::right) line.status = LineStatus::definition;
        return true;
    }
    if (heard_.abbreviations || letters_.is_authors(lone.letter->letter)) {
        define(line, *lone.letter, rhs, lone.power);
        if (lone.power == 1 && speaks_of_angular_momentum(statement_->words))
            hold_against_momenta(line, *lone.letter, rhs);
        return true;
    }
    if (bind_to_part(lone.letter->letter, &rhs)) return false;
    const ClaimText text = claim_text(rhs, {.letters = letters_});
    if (lone.power == 1 && is_constant_of_motion(line, *lone.letter, text, turned)) return true;
    if (is_frequency(line, *lone.letter, rhs, lone.power)) return true;
    if (bind_to_scene(line, *lone.letter, rhs, lone.power)) return true;
    define(line, *lone.letter, rhs, lone.power);
    return true;
}

namespace {

/// What else than a generalized momentum may be called the angular momentum: x p_y − y p_x; and for a unit of mass
/// that one and, where it keeps its value, each momentum, as r² φ'.
std::vector<ex> other_angular_momenta(const DerivedSystem& system, const std::vector<ex>& momenta, bool is_kept) {
    const Mechanism& m = system.mechanism();
    const Scene& scene = system.scene();
    std::set<std::string> no_lengths, no_masses;
    for (const ConcludedDimension& one : concluded_dimensions(scene))
        if (one.dimension && *one.dimension != Dimension{{"m", 1}}) no_lengths.insert(one.name);
    for (const Parameter& parameter : scene.parameters)
        if (const auto dimension = dimension_of_unit(parameter.unit);
            dimension && *dimension != Dimension{{"kg", 1}})
            no_masses.insert(parameter.name.text);
    std::vector<ex> result = is_kept ? momenta : std::vector<ex>{};
    for (std::size_t i = 0; i < momenta.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!no_lengths.contains(m.q[i].get_name()) && !no_lengths.contains(m.q[j].get_name()))
                result.push_back(m.q[j] * momenta[i] - m.q[i] * momenta[j]);
    for (const ex& momentum : std::vector<ex>(result))
        for (const auto& mass : m.parameters) {
            const std::string name = mass.symbol.get_name();
            if ((!name.starts_with("m") && !name.starts_with("M")) || no_masses.contains(name)) continue;
            const ex of_unit = m.z->pull_back({{momentum, 1}}, {mass.symbol})[0];
            if (m.z->depends(of_unit, m.q) && !m.z->depends(of_unit, {mass.symbol})) result.push_back(of_unit);
        }
    return result;
}

}  // namespace

/// L = m l² θ' as an angular momentum: right if it is a generalized momentum; of another one it is not known about
/// which point it is.
void Marker::hold_against_momenta(MarkedLine& line, const Math& letter, const Math& value) {
    const Mechanism& m = system_.mechanism();
    MotionRows& rows = system_.rows();
    const ex stated = truth_.value(claim_text(value, as_written()).text);
    const std::vector<ex> momenta = m.z->pull_back({{m.lagrangian(), 1}}, m.qdot);
    if (rows.is_identity(rows.row(stated - m.lagrangian())) == true) {
        line.status = LineStatus::right;
        return;
    }
    const auto is_among = [&](const std::vector<ex>& candidates) {
        return std::any_of(candidates.begin(), candidates.end(), [&](const ex& momentum) {
            return rows.is_identity(rows.row(stated - momentum)) == true;
        });
    };
    const bool is_kept = does_not_change(stated);
    if (!is_kept && (is_word_for_constant(letter.letter.base) || speaks_of_conservation(heard_.around))) {
        line.status = LineStatus::mistake;
        line.reason = say("it does not keep its value");
        return;
    }
    if (is_among(momenta)) {
        line.status = LineStatus::right;
        line.reason = say("a generalized momentum");
        return;
    }
    if (is_among(other_angular_momenta(system_, momenta, is_kept))) {
        line.status = LineStatus::right;
        line.reason = say("an angular momentum");
        return;
    }
    if (is_kept && is_word_for_constant(letter.letter.base)) {
        line.status = LineStatus::right;
        line.reason = say("a constant of the motion");
        return;
    }
    line.status = LineStatus::undecided;  // a multiple of a momentum keeps its value too
    line.reason = is_kept ? say("a constant of the motion; whether it is the angular momentum is not judged")
                          : say("an angular momentum that is none of the generalized momenta; it is not judged");
}

/// T + V = const: an expression that changes with the state and keeps its value.
bool Marker::is_constant_of_motion(MarkedLine& line, const Math& letter, const ClaimText& text, bool turned) {
    const Mechanism& m = system_.mechanism();
    const ex value = truth_.value(text.text);
    if (m.z->depends(value, m.qddot) ||
        (!m.z->depends(value, m.qdot) && !is_word_for_constant(letter.letter.base)))
        return false;
    const MotionRow rate = system_.rows().row(m.time_derivative({value})[0]);
    const bool holds = system_.rows().holds(rate) == true;
    const bool is_state = std::any_of(m.q.begin(), m.q.end(), [&](const auto& q) { return value.is_equal(q); });
    if (!holds && is_state && is_word_for_constant(letter.letter.base) && !statement_->displayed) {  // φ = const
        line.status = LineStatus::not_about_scene;
        line.reason = say("it describes a state; lines are judged for all motions");
        heard_.put_under_condition();
        return true;
    }
    if (!holds && is_word_for_constant(letter.letter.base) && follows_in_special_case(rate.residual)) {
        settle_in_special_case(line);
        return true;
    }
    if (!holds && is_word_for_constant(letter.letter.base) && holds_from_start(rate.residual)) {
        line.status = LineStatus::right;
        line.reason = say("of the motion that starts there from rest");
        return true;
    }
    if (!holds && !is_word_for_constant(letter.letter.base))
        return is_said_to_be_conserved(line, text, letter.letter, turned);
    std::string name =
        letters_.free_name(is_word_for_constant(letter.letter.base) ? "const" : identifier_of(letter.letter));
    while (constants_.contains(name)) name = letters_.free_name(name + "_");  // each "const" is one of its own
    if (is_word_for_constant(letter.letter.base)) constants_.insert(name);
    line.claim = text.text + " = " + name;
    notes_.back().claim = {.lhs = text.text, .rhs = name, .constants = {name}};
    if (has_potential_of_all_) notes_.back().claim = {};  // the check has the scene's V
    notes_.back().left = text;
    line.status = holds ? LineStatus::right : LineStatus::mistake;
    if (!holds) follows_as_constant(line, text);
    notes_.back().is_sure = line.status == LineStatus::mistake;
    if (holds && !is_word_for_constant(letter.letter.base)) kept_.insert(bind(letter.letter, value));
    return true;
}

/// A letter that stands among others: one of the scene's places and speeds with which the line is right, or a
/// force that the line determines.
bool Marker::find_meaning(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter) {
    if (bind_to_part(letter)) {
        judge(line, lhs, rhs, Relation::equal);
        return true;
    }
    if (bind_to_momentum(line, lhs, rhs, letter)) return true;
    const Letters before = letters_;
    for (const Binding& binding : bindings(letter)) {
        const std::string name = bind(letter, truth_.value(binding.text));
        try {
            const Sides sides = sides_of(lhs, rhs);
            const MotionRow row =
                system_.rows().row(truth_.value(sides.left.text) - truth_.value(sides.right.text));
            if (system_.rows().holds(row) == true || ((binding.named || binding.spoken) && !spoken_.empty())) {
                roaming_.insert(letter);
                judge_pair(line, lhs, rhs);
                return true;
            }
        } catch (const NoMeaning&) {  // another letter is not known either
        }
        known_.erase(name);
        letters_ = before;
    }
    return determine(line, lhs, rhs, letter);
}

/// H = p²/(2 m l²) + V of one coordinate: p is its momentum if that makes the line right.
bool Marker::bind_to_momentum(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter) {
    if (letter != Letter{.base = "p"} || letters_.coordinates().size() != 1) return false;
    const Letters before = letters_;
    letters_.bind(letter, "p_" + letters_.coordinates()[0]);
    try {
        const Sides sides = sides_of(lhs, rhs);
        MotionRows& rows = system_.rows();
        if (rows.holds(rows.row(truth_.value(sides.left.text) - truth_.value(sides.right.text))) == true) {
            judge_pair(line, lhs, rhs);
            return true;
        }
    } catch (const NoMeaning&) {  // another letter is not known either
    }
    letters_ = before;
    return false;
}

/// M x'' = F + S sin θ determines S. What follows must agree with it.
bool Marker::determine(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter) {
    std::map<Letter, int> all;
    collect_letters(lhs, all);
    collect_letters(rhs, all);
    if (all[letter] > 0) return determine_by_rate(line, lhs, rhs, letter);
    const Letters before = letters_;
    const std::string name = bind(letter, 0);
    const auto give_up = [&] {
        known_.erase(name);
        letters_ = before;
        return false;
    };
    Sides sides;
    try {
        sides = sides_of(lhs, rhs);
    } catch (const NoMeaning&) {
        return give_up();
    }
    const Mechanism& m = system_.mechanism();
    const auto solved = [&](const std::function<ex(const ex&)>& residual) -> std::optional<ex> {
        const ex none = residual(0), slope = residual(1) - none;
        if (!system_.rows().is_identity(system_.rows().row(residual(2) - none - 2 * slope)).value_or(false))
            return std::nullopt;
        if (m.z->name(slope).is_zero() || m.z->depends(slope, m.qddot)) return std::nullopt;
        const ex plain = m.z->expand(slope);  // pi - theta of theta = pi - alpha, without a quotient
        if (GiNaC::is_a<GiNaC::numeric>(plain)) return m.z->name((m.z->expand(none) / -plain).expand());
        return m.z->name(-none / slope);
    };
    const auto truth = solved([&](const ex& value) {
        truth_.know(name, value);
        return truth_.value(sides.left.text) - truth_.value(sides.right.text);
    });
    if (!truth) return give_up();
    const auto own = solved([&](const ex& value) {
        own_.state(name, value, {});
        return own_residual(sides);
    });
    known_[name] = *truth;
    truth_.know(name, *truth);
    if (is_constant_of_potential(line, sides, letter, *truth)) return true;
    own_.state(name, own.value_or(*truth), own_.wrong_in(sides.own_names()));
    if (m.z->depends(*truth, m.qdot) && does_not_change(*truth)) kept_.insert(name);  // φ' = p/(m r²)
    note_base(lhs, rhs, letter);
    line.status = LineStatus::definition;  // it may absorb any slip
    line.claim = sides.left.text + " = " + sides.right.text;
    line.reason = say("it determines {}", name);
    return true;
}

/// φ' = x'/r, or x' = r φ' of rolling: φ is x/r, counted from where x is zero.
bool Marker::determine_by_rate(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter) {
    const Letters before = letters_;
    const std::string name = bind(letter, 0);
    const auto give_up = [&] {
        known_.erase(name);
        letters_ = before;
        return false;
    };
    const Mechanism& m = system_.mechanism();
    std::optional<ex> place;
    try {
        const Sides sides = sides_of(lhs, rhs);
        const auto residual = [&](int rate) {  // with φ = rate · t
            truth_.know(name, rate * m.t);
            return truth_.value(sides.left.text) - truth_.value(sides.right.text);
        };
        const ex none = residual(0), slope = residual(1) - none;
        if (!is_identically_zero(m.z->name(residual(2) - none - 2 * slope), m)) return give_up();
        if (is_identically_zero(m.z->name(slope), m)) return give_up();
        const ex rate = m.z->name(-none / slope);
        const std::vector<ex> shares = m.z->pull_back({{rate, 1}}, m.qdot);
        GiNaC::exvector terms, rates;
        for (std::size_t i = 0; i < shares.size(); ++i) {
            if (!is_of_parameters(shares[i])) return give_up();
            terms.push_back(shares[i] * m.q[i]);
            rates.push_back(shares[i] * m.qdot[i]);
        }
        if (!is_identically_zero(m.z->name(rate - GiNaC::add(rates)), m)) return give_up();
        place = m.z->expand(GiNaC::add(terms)).normal();
        line.claim = sides.left.text + " = " + sides.right.text;
    } catch (const NoMeaning&) {
        return give_up();
    }
    known_[name] = m.z->name(*place);
    truth_.know(name, known_[name]);
    own_.state(name, known_[name], {});
    of_rate_.insert(letter);
    line.status = LineStatus::definition;
    line.reason = say("it determines {}", name);
    return true;
}

void Marker::define(MarkedLine& line, const Math& letter, const Math& rhs, int power) {
    if (power == 1 && rhs.kind == Kind::letter && rhs.dots == 0) {  // q_1 = x
        const auto name = letters_.name_of(rhs.letter);
        const std::vector<std::string>& all = letters_.coordinates();
        if (name && std::find(all.begin(), all.end(), *name) != all.end()) {
            letters_.bind(letter.letter, *name);
            line.status = LineStatus::definition;
            line.claim = identifier_of(letter.letter) + " = " + *name;
            return;
        }
    }
    if (!statement_->displayed && is_number(rhs)) heard_.put_under_condition();  // "at the pole, λ = π/2"
    const ClaimText text = claim_text(rhs, {.letters = letters_}),
                    own = claim_text(rhs, {.letters = letters_, .steps = &own_.steps()});
    const GiNaC::numeric exponent(1, power);
    const ex truth = GiNaC::pow(truth_.value(text.text), exponent),
             stated = GiNaC::pow(own_.value(own.text), exponent);
    const std::optional<std::size_t> wrong = own_.wrong_in(own.names);
    const std::string name = bind(letter.letter, truth);
    own_.state(name, stated, wrong);
    if (holds_decimals(rhs)) rounded_.insert(name);
    const Mechanism& m = system_.mechanism();
    if (power == 1 && m.z->depends(truth, m.qdot) && does_not_change(truth)) kept_.insert(name);
    line.status = LineStatus::definition;
    line.claim = (power == 1 ? name : name + "^2") + " = " + text.text;
    if (power == 1) hold_momenta(name, text, own, wrong);
    if (power == 1 && !wrong && is_meant_as_inertia(letter.letter) && is_foreign_inertia(letter.letter, truth))
        inertias_[lines.size()] = truth;
}

/// U_eff(θ) = V + J²/(2 m l² sin²θ): ∂U/∂θ is taken with J held, ∂H/∂p with q held, of what the author has
/// written.
void Marker::hold_momenta(const std::string& name, const ClaimText& text, const ClaimText& own,
                          std::optional<std::size_t> wrong) {
    const Mechanism& m = system_.mechanism();
    std::map<std::string, ex> letters;
    GiNaC::exmap truths;
    std::vector<GiNaC::symbol> by = m.q;
    by.insert(by.end(), m.qdot.begin(), m.qdot.end());
    std::vector<std::string> names;
    for (const GiNaC::symbol& coordinate : by) names.push_back(coordinate.get_name());
    for (const std::string& held : text.names) {
        if (!known_.contains(held) || (!held.starts_with("p_") && !kept_.contains(held))) continue;
        const GiNaC::symbol letter = system_.held(held);
        letters[held] = letter;
        truths[letter] = known_.at(held);
        by.push_back(letter);
        names.push_back(held);
    }
    if (letters.empty()) return;
    for (const auto& [held, letter] : letters) truth_.know(held, letter);
    const ex value = truth_.value(text.text);
    for (const auto& [held, letter] : letters) truth_.know(held, known_.at(held));
    const auto hold = [&](const std::string& key, const ex& slope, const ex& own_slope) {
        own_.state_step(key, substitute(*m.z, {own_slope}, truths)[0], wrong);
        const auto quantity = quantity_of({.base = name});
        if (quantity && letters_.name_of(*quantity) == name) return;  // H itself is what it is
        const std::string step = letters_.free_name(fmt::format("held_{}", held_.size() + 1));
        held_[key] = step;
        known_[step] = m.z->name(substitute(*m.z, {slope}, truths)[0]);
        truth_.know(step, known_[step]);
        own_.state(step, known_[step], {});
    };
    const std::vector<ex> slopes = m.z->pull_back({{value, 1}}, by),
                          own_slopes = m.z->pull_back({{own_.value_with(own.text, letters), 1}}, by);
    for (std::size_t k = 0; k < by.size(); ++k)
        hold(fmt::format("diff({},{})", name, names[k]), slopes[k], own_slopes[k]);
    for (std::size_t k = 0; k < m.q.size(); ++k)  // ∂²U/∂r², of frequencies about a state
        hold(fmt::format("diff({0},{1},{1})", name, names[k]), m.z->pull_back({{slopes[k], 1}}, {m.q[k]})[0],
             m.z->pull_back({{own_slopes[k], 1}}, {m.q[k]})[0]);
}

}  // namespace alembert
