// SPDX-License-Identifier: GPL-2.0-or-later
// Lines about states of rest: equilibria, conditions of rest, and what holds at some of these states alone.
#include "check/derivation/marker.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "algebra/notation/readable.hpp"
#include "base/language/say.hpp"
#include "check/derivation/rest_states.hpp"
#include "check/frequency.hpp"
#include "check/written/words.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;
using Found = RestStates::Found;

/// cos θ = (a + √(a² + 32 r²))/(8 r): the angle of an equilibrium.
bool Marker::is_angle_of_rest(MarkedLine& line, const Math& side, const ClaimText& value) {
    const bool is_function = side.kind == Kind::call && side.args.size() == 1 &&
                             (side.text == "cos" || side.text == "sin" || side.text == "tan");
    if (!is_function || side.args[0]->kind != Kind::letter || side.args[0]->dots > 0) return false;
    const auto name = letters_.name_of(side.args[0]->letter);
    if (!name || !letters_.moves(*name) || !holds_letters_only(value.names, system_.scene())) return false;
    const Expression angle = parsed("a" + side.text + "(" + value.text + ")");
    if (!angle) return false;
    const CheckedClaim found =
        check_equilibrium({system_.scene(), system_.mechanism(), {{*name, angle}}, system_.sheets()});
    if (found.verdict == Verdict::refuted) return false;
    line.status = found.verdict == Verdict::proved ? LineStatus::right : LineStatus::undecided;
    line.reason = found.verdict == Verdict::proved ? say("an equilibrium") : say("it could not be evaluated");
    notes_.back().claim = {};
    return true;
}

/// States of rest or of steady motion in numbers, for special values of parameters.
RestStates& Marker::states_of_rest(bool steady, const GiNaC::exmap& special) {
    const auto is_same = [&](const std::unique_ptr<RestStates>& known) {
        const GiNaC::exmap& other = known->kind().special;
        return known->kind().steady == steady && other.size() == special.size() &&
               std::equal(other.begin(), other.end(), special.begin(), [](const auto& x, const auto& y) {
                   return x.first.is_equal(y.first) && x.second.is_equal(y.second);
               });
    };
    const auto known = std::find_if(states_.begin(), states_.end(), is_same);
    if (known != states_.end()) return **known;
    const RestStates::Kind kind{.special = special, .steady = steady};
    return *states_.emplace_back(std::make_unique<RestStates>(system_, kind));
}

/// What is asked of all states of rest, of those of the special case, and then of steady motions. The answer that
/// says most; `reason` tells it.
Found Marker::found_at_rest(const std::function<Found(RestStates&)>& ask, bool may_be_steady,
                            std::string& reason) {
    bool is_nowhere = false, is_elsewhere = false, is_trivial = false;
    is_of_case_ = false;
    const GiNaC::exmap none;
    std::vector<const GiNaC::exmap*> cases = special_.cases();
    cases.insert(cases.begin(), &none);
    for (const bool steady : {false, true})
        for (const GiNaC::exmap* special : cases) {
            const bool of_case = special != &none;
            if (steady && !may_be_steady) continue;
            Found found = Found::unknown;
            try {
                found = ask(states_of_rest(steady, *special));
            } catch (const std::exception&) {  // what has no value in numbers
            }
            is_nowhere = is_nowhere || found == Found::nowhere;
            is_elsewhere = is_elsewhere || found == Found::elsewhere;
            is_trivial = is_trivial || found == Found::trivially;
            if (found != Found::everywhere && found != Found::on_branch) continue;
            is_of_case_ = of_case;
            reason = of_case  ? say("of states of rest found in numbers, for the values of parameters that the "
                                     "derivation states: {}",
                                    told_values(*special))
                     : steady ? say("of steady motions found in numbers")
                     : found == Found::everywhere ? say("of states of rest found in numbers")
                                                  : say("of one of the states of rest found in numbers");
            return found;
        }
    return is_trivial     ? Found::trivially
           : is_elsewhere ? Found::elsewhere
           : is_nowhere   ? Found::nowhere
                          : Found::unknown;
}

/// dV/dφ = 0 is what states of rest obey, whatever the words say.
bool Marker::is_condition_on_potential(MarkedLine& line, const Math& lhs, const Math& rhs) {
    const std::string potential = letters_.name_of(MechanicalQuantity::potential);
    const bool is_function = lhs.kind == Kind::applied && lhs.dots == 1 && lhs.args.size() == 1 &&
                             letters_.moves(letters_.name_of(lhs.args[0]->letter).value_or(""));  // V'(θ)
    const bool is_slope = is_function ? letters_.name_of(lhs.letter) == potential
                                      : lhs.kind == Kind::partial && lhs.args[0]->kind == Kind::letter &&
                                            letters_.name_of(lhs.args[0]->letter) == potential;
    const bool is_said = says_rest() || lhs.text == "d" || is_function;
    if (!is_slope || !is_said || rhs.kind != Kind::number || rhs.text != "0") return false;
    const ex slope = truth_.value(sides_of(lhs, rhs).left.text);
    std::string reason;
    const Found found =
        found_at_rest([&](RestStates& states) { return states.vanishes(slope, {}); }, false, reason);
    if (found != Found::everywhere && found != Found::on_branch && found != Found::trivially) return false;
    line.status = LineStatus::right;
    line.reason = found == Found::trivially ? say("of states of rest found in numbers") : std::move(reason);
    heard_.assumed_rest = true;
    return true;
}

/// Right where the expression vanishes at states of rest; not judged where it does at some that are unstable and
/// far away, so that it is not known whether they are meant. Returns whether it is one of these.
bool Marker::is_at_rest(MarkedLine& line, const ex& residual, const RestStates::About& about, bool may_be_steady) {
    std::string reason;
    const Found found =
        found_at_rest([&](RestStates& states) { return states.vanishes(residual, about); }, may_be_steady, reason);
    if (found == Found::elsewhere)
        reason = say("it holds at some unstable states of rest; whether they are meant is not said");
    else if (found == Found::trivially)
        reason = say("all of its terms vanish at the states of rest that were found, which says nothing of them");
    else if (found != Found::everywhere && found != Found::on_branch)
        return false;
    const bool is_open = found == Found::elsewhere || found == Found::trivially ||
                         (is_of_case_ && !special_.is_fresh(statement_->words));
    line.status = is_open ? LineStatus::undecided : LineStatus::right;
    line.reason = std::move(reason);
    notes_.back().claim = {};
    return true;
}

/// Whether it holds at some states of rest: the others are other branches.
bool Marker::holds_at_some_rest(MarkedLine& line, const Sides& sides) {
    if (!says_rest() || displacements_ != nullptr || has_quantities(sides)) return false;
    if (holds_rates(*sides.lhs) || holds_rates(*sides.rhs)) return false;
    const bool names_place = names_coordinate(*sides.lhs) || names_coordinate(*sides.rhs);
    return is_at_rest(line, truth_.value(sides.left.text) - truth_.value(sides.right.text),
                      {.names_place = names_place, .of_number = is_number(*sides.lhs) || is_number(*sides.rhs)},
                      false);
}

/// θ or cos θ alone: the line then states the place.
bool Marker::names_coordinate(const Math& side) const {
    const Math& inner = side.kind == Kind::call && side.args.size() == 1 ? *side.args[0] : side;
    if (inner.kind != Kind::letter || inner.dots > 0) return false;
    return state_letters_.contains(inner.letter) || letters_.moves(letters_.name_of(inner.letter).value_or(""));
}

/// θ of θ_0.
GiNaC::symbol Marker::coordinate_of_value(const Letter& letter) const {
    Letter plain = letter;
    if (plain.raised.empty())
        plain.index.clear();
    else
        plain.raised.clear();
    const std::string name = *letters_.name_of(plain);
    const std::vector<GiNaC::symbol>& all = system_.mechanism().q;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const GiNaC::symbol& q) { return q.get_name() == name; });
    if (found == all.end()) throw NoMeaning{.reason = say("'{}' is no coordinate", name)};
    return *found;
}

/// θ_0 of a coordinate θ, or Ω of a steady rate φ': a symbol from now on.
void Marker::know_state_letter(const Letter& letter, const GiNaC::symbol& value) {
    const std::string name = letters_.free_name(identifier_of(letter));
    const GiNaC::symbol symbol = system_.held(name);
    places_[symbol] = value;
    letters_.bind(letter, name);
    known_[name] = symbol;
    truth_.know(name, symbol);
    own_.state(name, symbol, {});
    state_letters_.insert(letter);
}

std::vector<std::string> Marker::remarks() const {
    std::vector<std::string> result = remarks_;
    for (const auto& [letter, coordinate] : places_)
        result.push_back(say("{} is read as the value of {} at a state of rest, in a steady motion or at a start",
                             GiNaC::ex_to<GiNaC::symbol>(letter).get_name(),
                             GiNaC::ex_to<GiNaC::symbol>(coordinate).get_name()));
    return result;
}

/// θ_eq and the like, or letters that lines have shown to be of rest.
bool Marker::names_state(const std::map<Letter, int>& all) const {
    static const std::set<std::string> indices{"eq", "e", "s", "st", "star"};
    return std::all_of(all.begin(), all.end(), [&](const auto& item) {
        return !state_letters_.contains(item.first) || indices.contains(item.first.index) ||
               rest_letters_.contains(item.first);
    });
}

/// Whether it is surely a state of rest or of steady motion, and not where a motion turns, begins or ends.
bool Marker::says_state(const std::map<Letter, int>& all) const {
    static const std::set<std::string> of_motion{"max", "min", "i", "f"};
    const bool is_of_turn = std::any_of(all.begin(), all.end(), [&](const auto& item) {
        return state_letters_.contains(item.first) && of_motion.contains(item.first.index);
    });
    return !heard_.start_from_rest && !is_of_turn && relation_ != Relation::approximately &&
           (says_rest() || names_state(all) || heard_.steady_lines > 0);
}

/// A line with θ_0, the value of θ at one state: right of states of rest, near them, or of the motion that starts
/// there. Returns whether that is decided.
bool Marker::is_of_state_letter(MarkedLine& line, const Math& lhs, const Math& rhs) {
    std::map<Letter, int> all;
    collect_letters(lhs, all);
    collect_letters(rhs, all);
    for (const auto& [letter, dots] : all)
        if (dots > 0 && state_letters_.contains(letter)) return false;  // φ'_0
    if (holds_function_of_state(lhs) || holds_function_of_state(rhs)) {
        const MathPtr left = with_slopes(std::make_shared<Math>(lhs)),
                      right = with_slopes(std::make_shared<Math>(rhs));
        if (holds_function_of_state(*left) || holds_function_of_state(*right)) return false;
        is_taken_there_ = true;
        const bool is_decided = is_of_state_letter(line, *left, *right);
        is_taken_there_ = false;
        return is_decided;
    }
    const bool is_named = names_state(all), is_said = says_state(all);
    const bool is_case = speaks_of_special_case(statement_->words);
    if (!statement_->displayed && is_case) {  // "if ω = Ω", "Resonance ω_1 = 2 ω_2"
        heard_.put_under_condition();
        return false;
    }
    const Lone lone = lone_letter(lhs);
    if (is_rounded_value(lhs) || is_rounded_value(rhs) || value_of_numbers(lhs) || value_of_numbers(rhs))
        return false;
    if (lone.letter != nullptr && lone.letter->letter.base == "omega" &&
        !state_letters_.contains(lone.letter->letter) &&
        !letters_.is_of_scene(letters_.name_of(lone.letter->letter).value_or("")) &&
        (heard_.frequency || heard_.small)) {  // ω² = g cos θ_0/l
        const std::string text = claim_text(rhs, as_written()).text;
        return is_frequency_at_rest(line, *lone.letter, rhs, lone.power,
                                    lone.power == 2 ? text : "(" + text + ")^2");
    }
    if (lone.letter != nullptr && !letters_.name_of(lone.letter->letter)) {
        define(line, *lone.letter, rhs, lone.power);
        return true;
    }
    const Sides sides = sides_of(lhs, rhs);
    if (has_quantities(sides)) return false;
    const Mechanism& m = system_.mechanism();
    const ex residual = truth_.value(sides.left.text) - truth_.value(sides.right.text);
    const bool is_of_motion =
        !is_taken_there_ &&
        (m.z->depends(residual, m.q) || m.z->depends(residual, m.qddot) || holds_rates(lhs) || holds_rates(rhs));
    const RestStates::About about{.places = places_,
                                  .names_place = names_coordinate(lhs) || names_coordinate(rhs),
                                  .of_number = is_number(lhs) || is_number(rhs)};
    line.claim = sides.left.text + " = " + sides.right.text;
    if (is_taken_there_ && vanishes_at(residual, places_)) {  // U''(r_0) = 3 l²/(m r_0⁴), at any place
        line.status = LineStatus::right;
        notes_.back().claim = {};
        return true;
    }
    const bool is_of_start = heard_.start_from_rest && !is_named && !about.names_place;  // θ_0 of the release
    RestStates::About there = about;  // a line that names the place may name another one than those above
    if (!about.names_place) there.relations = rest_relations_;
    if (!is_of_start && has_steady_rates_alone(residual, lhs, rhs) && is_at_rest(line, residual, there, true)) {
        if (line.status == LineStatus::right && about.names_place) rest_relations_ = {residual};
        if (line.status == LineStatus::right)
            for (const auto& [letter, dots] : all)
                if (state_letters_.contains(letter)) rest_letters_.insert(letter);
        return true;
    }
    if (!is_of_start && is_of_motion && is_near_state(line, residual, there)) return true;
    if (keeps_its_start_at(residual, lhs, rhs)) {
        line.status = LineStatus::right;
        line.reason = say("of the motion that starts there from rest");
        return true;
    }
    if (special_.empty() && is_wrong_energy_of_start(residual, lhs, rhs)) {  // "the ladder alone (m = 0)"
        line.status = LineStatus::mistake;
        line.reason = say("it does not hold on the motion that starts there from rest");
        notes_.back().is_sure = true;
        return true;
    }
    const bool is_value =  // "θ_0 = π/2", "r_0 = 1 m"
        !statement_->displayed && (is_number(lhs) || is_number(rhs) || may_be_number_with_unit(rhs, letters_));
    return is_said && !is_value && is_refuted_at_state(line, residual, there, is_of_motion);
}

/// Whether a line that is surely about the state holds at none of them, or near none.
bool Marker::is_refuted_at_state(MarkedLine& line, const ex& residual, const RestStates::About& there,
                                 bool is_of_motion) {
    const bool is_surely_meant =
        system_.mechanism().inputs.empty() && !is_state_wrong_ && (!is_of_motion || heard_.small);
    if (!is_surely_meant || line.status == LineStatus::not_about_scene) return false;
    std::string reason;
    const Found found = found_at_rest(
        [&](RestStates& states) {
            return is_of_motion ? states.vanishes_near(residual, there) : states.vanishes(residual, there);
        },
        true, reason);
    if (found != Found::nowhere) return false;
    line.status = LineStatus::mistake;
    line.reason = is_of_motion ? say("it does not hold to first order near any state of rest that was found")
                               : say("it holds at none of the states of rest that were found");
    is_state_wrong_ = true;
    return true;
}

/// U''(r_0), a derivative that is taken before r is r_0.
bool Marker::holds_function_of_state(const Math& math) const {
    const bool is_here = math.kind == Kind::applied && math.args.size() == 1 &&
                         math.args[0]->kind == Kind::letter && state_letters_.contains(math.args[0]->letter);
    return is_here || std::any_of(math.args.begin(), math.args.end(),
                                  [&](const MathPtr& arg) { return holds_function_of_state(*arg); });
}

/// Whether no rates stand in it but those of coordinates that move steadily.
bool Marker::has_steady_rates_alone(const ex& residual, const Math& lhs, const Math& rhs) {
    const Mechanism& m = system_.mechanism();
    if (m.z->depends(residual, m.qddot)) return false;
    if (!holds_rates(lhs) && !holds_rates(rhs)) return true;
    const std::vector<std::size_t>& moving = states_of_rest(true, {}).moving();
    for (std::size_t i = 0; i < m.q.size(); ++i)
        if (std::find(moving.begin(), moving.end(), i) == moving.end() && m.z->depends(residual, {m.qdot[i]}))
            return false;
    return true;
}

/// Whether the line holds to first order near the states for which θ_0 stands.
bool Marker::is_near_state(MarkedLine& line, const ex& residual, const RestStates::About& about) {
    std::string reason;
    const Found found = found_at_rest([&](RestStates& states) { return states.vanishes_near(residual, about); },
                                      !about.places.empty(), reason);
    if (found != Found::everywhere && found != Found::on_branch) return false;
    line.status = LineStatus::right_near;
    line.reason = std::move(reason);
    return true;
}

/// Equilibria: θ = 0, or an equation that holds there.
bool Marker::is_equilibrium(MarkedLine& line, const Sides& sides) {
    if ((heard_.roots || says_rest()) && is_root(line, sides)) return true;
    const bool is_of_motion = holds_rates(*sides.lhs) || holds_rates(*sides.rhs);
    if (says_rest() && !is_of_motion && !has_quantities(sides) && is_condition_of_rest(line, sides)) return true;
    if (!heard_.rest && !statement_->displayed) return false;
    if (says_rest() &&
        (is_angle_of_rest(line, *sides.lhs, sides.right) || is_angle_of_rest(line, *sides.rhs, sides.left)))
        return true;
    const auto is_state = [&](const Math& a, const ClaimText& b) {
        return a.kind == Kind::letter && a.dots == 0 && letters_.moves(letters_.name_of(a.letter).value_or("")) &&
               holds_letters_only(b.names, system_.scene());
    };
    const bool left = is_state(*sides.lhs, sides.right), right = is_state(*sides.rhs, sides.left);
    if (!left && !right) return false;
    const std::string name = left ? sides.left.text : sides.right.text,
                      value = left ? sides.right.text : sides.left.text;
    const auto checked = [&](const std::vector<std::pair<std::string, Expression>>& place) {
        return check_equilibrium({system_.scene(), system_.mechanism(), place, system_.sheets()});
    };
    CheckedClaim found = checked({{name, parsed(value)}});
    for (const BaseState& base : base_states(system_.scene())) {  // the others where they may rest
        if (found.verdict == Verdict::proved) break;
        std::vector<std::pair<std::string, Expression>> place = parsed(base);
        for (auto& [q, expression] : place)
            if (q == name) expression = parsed(value);
        if (CheckedClaim other = checked(place); other.verdict == Verdict::proved) found = std::move(other);
    }
    if (found.verdict == Verdict::undecided || (found.verdict != Verdict::proved && !heard_.rest)) return false;
    if (found.verdict != Verdict::proved && holds_at_some_rest(line, sides)) return true;
    line.checked = found;
    notes_.back().claim = {};
    line.status = found.verdict == Verdict::proved ? LineStatus::right : LineStatus::mistake;
    line.reason = found.verdict == Verdict::proved ? say("an equilibrium") : found.reason;
    return true;
}

/// "with the roots": θ = π, or cos θ = g/(R Ω²), makes one of the conditions of rest zero, whether or not the
/// system can stay there.
bool Marker::is_root(MarkedLine& line, const Sides& sides) {
    constexpr double largest = 3000;
    constexpr std::size_t most_terms = 500;
    const Mechanism& m = system_.mechanism();
    MotionRows& rows = system_.rows();
    const ex left = m.z->expand(truth_.value(sides.left.text)),
             right = m.z->expand(truth_.value(sides.right.text));
    if (!GiNaC::is_a<GiNaC::symbol>(left) && !GiNaC::is_a<GiNaC::function>(left)) return false;
    if (!m.z->depends(left, m.q)) return false;  // Ω = ω_0 is a condition on parameters
    for (const ex& condition : system_.conditions_of_rest()) {
        if (m.z->tree_size(condition) > largest || rows.is_identity(rows.row(condition)) == true) continue;
        const auto sum = fourier(m.z->expand(condition), *m.symbols, most_terms);
        if (!sum) continue;
        const ex there = expression(readable(*sum)).subs(left == right);  // in sines and cosines of single angles
        if (rows.is_identity(rows.row(m.z->name(there))) != true) continue;
        notes_.back().claim = {};
        line.status = LineStatus::right;
        line.reason = say("a root of the condition of rest");
        return true;
    }
    return false;
}

/// A line that is one of the conditions of rest but for a constant factor, inputs and multipliers being open.
bool Marker::is_condition_of_rest(MarkedLine& line, const Sides& sides) {
    const Mechanism& m = system_.mechanism();
    MotionRows& rows = system_.rows();
    std::vector<GiNaC::symbol> open = m.moving();
    const std::vector<GiNaC::symbol>& lambda = system_.equations().lambda;
    open.insert(open.end(), lambda.begin(), lambda.end());
    const auto slopes = [&](const ex& e) { return m.z->pull_back({{e, 1}}, open); };
    const ex residual = m.z->name(truth_.value(sides.left.text) - truth_.value(sides.right.text));
    const std::vector<ex> own = slopes(residual);
    for (const ex& condition : system_.conditions_of_rest()) {
        if (rows.is_identity(rows.row(condition)) == true) continue;
        const std::vector<ex> others = slopes(condition);
        bool is_multiple = true;
        for (std::size_t k = 0; is_multiple && k < open.size(); ++k)
            is_multiple = is_identically_zero(m.z->name(condition * own[k] - residual * others[k]), m);
        if (!is_multiple) continue;
        notes_.back().claim = {};
        line.status = LineStatus::right;
        line.reason = say("of states of rest");
        return true;
    }
    return false;
}

/// Whether a rate stands in it that vanishes at rest: not that of a function of time, which moves the support.
bool Marker::holds_rates(const Math& math) const {
    const bool is_letter = (math.kind == Kind::letter || math.kind == Kind::applied) && math.dots > 0;
    const std::string name = is_letter ? letters_.name_of(math.letter).value_or("") : "";
    if (is_letter && !letters_.is_function(name) && !is_input(name)) return true;
    if (math.kind == Kind::rate) return true;
    return std::any_of(math.args.begin(), math.args.end(), [&](const MathPtr& arg) { return holds_rates(*arg); });
}

/// "In equilibrium. We find": rest is spoken of here, or was a line before.
bool Marker::says_rest() const {
    return heard_.rest || heard_.assumed_rest;
}

bool Marker::holds_at_rest(MarkedLine& line, const Sides& sides) {
    if (heard_.no_accelerations) {
        const ex residual = truth_.value(sides.left.text) - truth_.value(sides.right.text);
        MotionRows& rows = system_.rows();
        if (rows.is_identity(rows.row(system_.without_accelerations(residual))) == true) {
            line.status = LineStatus::right;
            line.reason = say("where the accelerations of the coordinates are zero");
            notes_.back().claim = {};
            return true;
        }
    }
    if (!says_rest() || holds_rates(*sides.lhs) || holds_rates(*sides.rhs)) return false;  // at rest all vanish
    LineClaim claim = notes_.back().claim;
    claim.at_rest = true;
    if (has_quantities(sides)) return false;
    try {
        const std::vector<CheckedClaim> verdicts = system_.check({claim}, known_in_motion());
        const auto& other = verdicts[0].other_branch;
        const bool on_a_branch = other && other->verdict == Verdict::proved;
        const bool is_vacuous = verdicts[0].verdict == Verdict::vacuous;
        if ((is_vacuous || verdicts[0].verdict == Verdict::undecided) && !on_a_branch) {
            line.status = LineStatus::undecided;
            line.reason = is_vacuous ? say("no state of rest was found") : say("it could not be evaluated");
            notes_.back().claim = {};
            return true;
        }
        if (verdicts[0].verdict == Verdict::refuted && !on_a_branch) return false;
    } catch (const std::exception&) {
        return false;
    }
    const ex residual = truth_.value(sides.left.text) - truth_.value(sides.right.text);
    const RestStates::About about{.names_place = names_coordinate(*sides.lhs) || names_coordinate(*sides.rhs)};
    std::string reason;
    const Found found =
        found_at_rest([&](RestStates& states) { return states.vanishes(residual, about); }, false, reason);
    if (found == Found::trivially) return is_at_rest(line, residual, about, false);
    notes_.back().claim = claim;
    line.status = LineStatus::right;
    line.reason = say("of states of rest");
    return true;
}

}  // namespace alembert
