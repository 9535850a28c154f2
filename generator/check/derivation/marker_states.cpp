// SPDX-License-Identifier: GPL-2.0-or-later
// Formulas that state one moment, a condition or a number of an equation, and so nothing of all motions: theta(0)
// = 0.2, theta = theta_0, "at theta = pi/2 we have", (4) = (2) cos(theta) + (3) sin(theta).
#include "check/derivation/marker.hpp"

#include <algorithm>
#include <cctype>

#include "base/language/say.hpp"
#include "check/written/sentences.hpp"
#include "check/written/surroundings.hpp"
#include "check/written/word_kinds.hpp"
#include "check/written/words.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

/// (4) = (2)cos θ + (3)sin θ: numbers of equations in parentheses.
bool speaks_of_numbered_equations(const std::string& source) {
    int numbered = 0;
    for (std::size_t at = source.find('('); at != std::string::npos; at = source.find('(', at + 1)) {
        std::size_t end = at + 1;
        while (end < source.size() && std::isdigit(static_cast<unsigned char>(source[end])) != 0) ++end;
        const bool follows_letter = at > 0 && std::isalpha(static_cast<unsigned char>(source[at - 1])) != 0;
        if (end > at + 1 && end < source.size() && source[end] == ')' && !follows_letter) ++numbered;
    }
    return numbered > 1 && source.find('(') == source.find_first_not_of(" {\\quad");
}

/// α' = 0, α' = α'': rates alone, and zero.
bool are_rates_at_rest(const Math& lhs, const Math& rhs) {
    const auto is_zero = [](const Math& side) { return side.kind == Kind::number && side.text == "0"; };
    const auto is_rate = [](const Math& side) { return side.kind == Kind::letter && side.dots > 0; };
    return (is_rate(lhs) || is_zero(lhs)) && (is_rate(rhs) || is_zero(rhs)) && (is_rate(lhs) || is_rate(rhs));
}

}  // namespace

/// "Without damping, c = 0": values that the words give.
void Marker::hear_special_values(const std::string& words) {
    const auto take = [&](const ex& parameter, const ex& value) {
        set_special_value(parameter, value);
        special_.open();
    };
    if (neglects_resistance(words))
        for (const auto& [parameter, none] : system_.without_resistance()) take(parameter, none);
    if (neglects_gravity(words))
        for (const Mechanism::Parameter& p : system_.mechanism().parameters)
            if (std::any_of(system_.mechanism().gravity.begin(), system_.mechanism().gravity.end(),
                            [&](const ex& g) { return g.is_equal(p.symbol) || g.is_equal(-p.symbol); }))
                take(p.symbol, 0);
    for (const std::string& word : letters_that_are_zero(words)) {
        const std::size_t bar = word.find('_');
        const Letter letter{.base = word.substr(0, bar),
                            .index = bar == std::string::npos ? "" : word.substr(bar + 1)};
        const auto name = letters_.name_of(letter);
        if (!name || !letters_.is_of_scene(*name) || letters_.moves(*name) || letters_.is_function(*name))
            continue;
        if (const ex parameter = truth_.value(*name); GiNaC::is_a<GiNaC::symbol>(parameter)) take(parameter, 0);
    }
}

/// θ₀ where θ is a coordinate and the scene has no θ₀.
bool Marker::is_value_of_state(const Letter& letter) const {
    if (state_letters_.contains(letter)) return true;
    if (moving_letters_.contains(letter)) return false;
    if (!letter.raised.empty() && letter.raised != "*") {  // y_1^0
        Letter plain = letter;
        plain.raised.clear();
        const auto name = letters_.name_of(plain);
        const std::vector<std::string>& all = letters_.coordinates();
        return letter.raised == "0" && !letters_.name_of(letter) && name &&
               std::find(all.begin(), all.end(), *name) != all.end();
    }
    if (letters_.name_of(letter) || letter.index.empty()) return false;
    static const std::set<std::string> indices{"0", "eq", "e", "s", "st", "max", "min", "i", "f", "(0)", "star"};
    Letter plain = letter;
    plain.index.clear();
    const auto name = letters_.name_of(plain);
    return indices.contains(letter.index) && name && letters_.is_of_scene(*name) && letters_.moves(*name);
}

/// A deviation from a state, as ξ of θ = θ_0 + ξ, and what is written in such letters.
bool Marker::depends_on_state(const Letter& letter) const {
    const auto name = letters_.name_of(letter);
    const auto known = name ? known_.find(*name) : known_.end();
    return known != known_.end() && !places_.empty() &&
           system_.mechanism().z->depends(known->second, symbols_of_places());
}

bool Marker::is_multiplier(const std::string& name) const {
    const std::vector<GiNaC::symbol>& all = system_.equations().lambda;
    return std::any_of(all.begin(), all.end(), [&](const GiNaC::symbol& one) { return one.get_name() == name; });
}

bool Marker::is_input(const std::string& name) const {
    const std::vector<Input>& all = system_.scene().inputs;
    return std::any_of(all.begin(), all.end(), [&](const Input& input) { return name == input.name.text; });
}

/// m_1 = m_2, I = 0, M → ∞: parameters of the scene alone, which would be numbers otherwise.
bool Marker::states_special_case(const Math& lhs, const Math& rhs, const std::map<Letter, int>& all) const {
    const Mechanism& m = system_.mechanism();
    const auto is_quantity = [&](const std::string& name) {
        return std::any_of(all.begin(), all.end(), [&](const auto& item) {
            return quantity_of(item.first) && letters_.name_of(item.first) == name;
        });
    };
    const auto is_own = [&](const std::string& name) {  // ω_0 = √(k/m), which the author has defined
        const auto known = known_.find(name);
        const auto depends = [&](const auto& symbols) { return m.z->depends(known->second, symbols); };
        return known != known_.end() && !statement_->displayed && !is_quantity(name) && !depends(m.q) &&
               !depends(m.qdot) && !depends(m.qddot) && !depends(system_.equations().lambda) &&
               !depends(std::vector{m.t});
    };
    const auto is_parameter = [&](const std::string& name) {
        const bool may_be = letters_.is_of_scene(name) && !letters_.is_function(name);
        return name == "pi" || (may_be && (is_input(name) || (!letters_.moves(name) && !is_multiplier(name))));
    };
    const bool is_said = (!statement_->displayed && speaks_of_special_case(statement_->words)) ||
                         ends_with_condition(statement_->words);  // "for ω² = 2 g c"
    if (all.empty() || (lhs.kind != Kind::letter && rhs.kind != Kind::letter && !is_said)) return false;
    const auto name_of = [&](const auto& item) { return letters_.name_of(item.first).value_or(""); };
    const auto is_of_scene = [&](const auto& item) {
        return name_of(item) != "pi" && is_parameter(name_of(item));
    };
    return std::any_of(all.begin(), all.end(), is_of_scene) &&
           std::all_of(all.begin(), all.end(), [&](const auto& item) {
               const bool is_rate = item.second > 0 && is_input(name_of(item));  // the hand is at rest, h' = 0
               return is_rate || (item.second == 0 && (is_parameter(name_of(item)) || is_own(name_of(item))));
           });
}

/// "Set α' = 0", "in steady rotation α' = α'' = 0", or the whole chain of rates that is set to zero.
bool Marker::assumes_rest() const {
    const bool is_chain = statement_->sides.size() > 2 && statement_->sides.back()->kind == Kind::number;
    return is_chain || heard_.assumed_rest || says_rest() || sets_value(statement_->words) ||
           speaks_of_special_motion(statement_->words) || begins_condition_of_state(statement_->words);
}

/// "Let θ = α and φ' = Ω be constant", "φ' = Ω = const", "it is released at θ = α": a letter for the value of
/// a coordinate or of its rate in a steady motion or at the start.
bool Marker::is_steady_value(const Math& side, const Math& letter) {
    const Lone last = lone_letter(*statement_->sides.back());
    const bool is_chain_to_constant = statement_->sides.size() > 2 && side.dots > 0 && last.letter != nullptr &&
                                      is_word_for_constant(last.letter->letter.base);
    const bool is_start = speaks_of_start(side.dots == 0 ? heard_.around : last_sentence(statement_->words));
    const bool is_said = heard_.steady_lines > 0 || heard_.condition_lines > 0 || is_chain_to_constant ||
                         is_start || speaks_of_constant_value(heard_.around);
    if (!is_said || side.kind != Kind::letter || side.dots > 1 || letter.kind != Kind::letter || letter.dots > 0)
        return false;
    const auto name = letters_.name_of(side.letter);
    if (!name || letters_.name_of(letter.letter) || letters_.is_authors(letter.letter)) return false;
    const Mechanism& m = system_.mechanism();
    for (std::size_t i = 0; i < m.q.size(); ++i)
        if (m.q[i].get_name() == *name) {
            know_state_letter(letter.letter, side.dots == 0 ? m.q[i] : m.qdot[i]);
            return true;
        }
    return false;
}

/// μ = m_1 m_2/(m_1 + m_2) where the scene has it so.
bool Marker::is_parameter_identity(const Math& lhs, const Math& rhs) {
    const ex left = truth_.value(claim_text(lhs, as_written()).text),
             right = truth_.value(claim_text(rhs, as_written()).text);
    MotionRows& rows = system_.rows();
    return rows.is_identity(rows.row(left - right)) == true;
}

/// Whether the line states one moment or a condition; then it is told so.
bool Marker::is_of_state(MarkedLine& line, const Math& lhs, const Math& rhs) {
    const MarkedLine before = line;
    const auto tell = [&](std::string reason) {
        line.status = LineStatus::not_about_scene;
        line.reason = std::move(reason);
        return true;
    };
    const auto is_of_input = [&](const Math& side) {
        return side.kind == Kind::letter && is_input(letters_.name_of(side.letter).value_or(""));
    };
    if (are_rates_at_rest(lhs, rhs) && !is_of_input(lhs) && !is_of_input(rhs) && assumes_rest()) {
        heard_.assumed_rest = true;
        return tell(say("a state of rest"));
    }
    if (heard_.condition_behind)
        return tell(say("the words state a condition for it; lines are judged for all motions"));
    if (denies(statement_->words)) return tell(say("the words say that it does not hold"));
    if (!statement_->displayed && asks(statement_->words, heard_.behind))
        return tell(say("the words ask whether it holds"));
    if (speaks_of_numbered_equations(written_.text.substr(statement_->offset, statement_->length)))
        return tell(say("it speaks of equations by their numbers"));
    if (says_rest() && is_lone_force(lhs) && rhs.kind == Kind::number && rhs.text == "0")
        return tell(say("a state of rest"));
    if (is_of_one_motion(lhs, rhs)) return tell(say("it describes one motion; lines are judged for all motions"));
    if (is_at_number(line, lhs, rhs)) return true;
    for (const Math* side : {&lhs, &rhs})
        if (side->kind == Kind::applied && side->args.size() == 1 && side->args[0]->kind == Kind::number) {
            const auto name = letters_.name_of(side->letter);
            if (name && (!letters_.is_of_scene(*name) || letters_.moves(*name)))  // θ(0), V''(0)
                return tell(say("a value at one moment; lines are judged for all motions"));
        }
    if (is_steady_value(lhs, rhs) || is_steady_value(rhs, lhs))
        return tell(say("it describes a state; lines are judged for all motions"));
    std::map<Letter, int> all;
    collect_letters(lhs, all);
    collect_letters(rhs, all);
    const auto state = std::find_if(all.begin(), all.end(), [&](const auto& item) {
        return is_value_of_state(item.first) || depends_on_state(item.first);
    });
    if (state != all.end() && !letters_.is_authors(state->first)) {
        const LineNotes notes = notes_.back();
        try {
            for (const auto& [letter, dots] : all)
                if (is_value_of_state(letter) && !letters_.is_authors(letter) && !state_letters_.contains(letter))
                    know_state_letter(letter, coordinate_of_value(letter));
            if (is_of_state_letter(line, lhs, rhs)) return true;
        } catch (const NoMeaning& reason) {  // a deviation is introduced here
            if (reason.unknown && determine(line, lhs, rhs, *reason.unknown)) return true;
        }
        line = before;
        notes_.back() = notes;
        return tell(
            say("it speaks of the value of a coordinate at one state, {}; lines are judged for all motions",
                identifier_of(state->first)));
    }
    const bool is_case = !statement_->displayed && speaks_of_special_case(statement_->words);
    const bool is_value = is_number(lhs) || is_number(rhs);  // F = 0
    if (says_rest() && !is_case && !is_value &&
        states_special_case(lhs, rhs, all)) {  // P = (R − r) M g/(2 R) in equilibrium
        judge_pair(line, lhs, rhs);
        if (is_right(line.status)) return true;
        line = before;
        notes_.back() = {};
    }
    if (states_special_case(lhs, rhs, all) && !is_parameter_identity(lhs, rhs)) {
        take_in_special_case(lhs, rhs);
        return tell(say("a condition on parameters; lines are judged for all their values"));
    }
    const auto is_zero = [](const Math& side) { return side.kind == Kind::number && side.text == "0"; };
    const auto name = lhs.kind == Kind::letter ? letters_.name_of(lhs.letter) : std::nullopt;
    if (statement_->displayed || !is_zero(rhs) || !name) return false;
    if (*name == letters_.name_of(MechanicalQuantity::potential))
        return tell(say("the zero of the potential, which is free"));
    if (heard_.rest && lhs.dots > 0 && letters_.moves(*name)) return tell(say("a state of rest"));
    return false;
}

/// Whether the difference of the sides does not change in motion.
bool Marker::is_kept(const Sides& sides) {
    const Mechanism& m = system_.mechanism();
    const ex residual = truth_.value(sides.left.text) - truth_.value(sides.right.text);
    return !m.z->depends(residual, m.qddot) && does_not_change(residual);
}

/// θ' = 3 S / (7 m l) of the rates just after the scene's impulses.
bool Marker::holds_after_impact(MarkedLine& line, const Sides& sides) {
    if (heard_.mentioned_impact && holds_at_pose(sides)) {
        line.status = LineStatus::right;
        line.reason = say("at the pose of the impact");
        notes_.back().claim = {};
        return true;
    }
    const bool is_energy_given = heard_.mentioned_impact &&
                                 sides.left.text == letters_.name_of(MechanicalQuantity::kinetic) &&
                                 is_of_parameters(truth_.value(sides.right.text));  // T = S² b²/(2 I)
    if (!(heard_.impact || is_energy_given || speaks_of_conservation(heard_.around)) ||
        system_.scene().impulses.empty() || (has_quantities(sides) && !is_energy_given) ||
        is_accelerated(*sides.lhs) || is_accelerated(*sides.rhs))
        return false;
    LineClaim claim = notes_.back().claim;
    claim.at_impact = true;
    Verdict verdict;
    try {
        verdict = system_.check({claim}, known_in_motion())[0].verdict;
    } catch (const std::exception&) {
        return false;
    }
    if (is_energy_given && verdict != Verdict::proved) return false;
    if (speaks_of_conservation(heard_.around) && (verdict != Verdict::proved || !is_kept(sides))) return false;
    notes_.back().claim = claim;
    line.status = verdict == Verdict::proved    ? LineStatus::right
                  : verdict == Verdict::refuted ? LineStatus::mistake
                                                : LineStatus::undecided;
    line.reason = say("just after the impact");
    return true;
}

}  // namespace alembert
