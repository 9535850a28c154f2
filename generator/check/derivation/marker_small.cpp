// SPDX-License-Identifier: GPL-2.0-or-later
// Lines about states of rest and about small deviations from them.
#include "check/derivation/marker.hpp"

#include <algorithm>
#include <utility>

#include "algebra/notation/readable.hpp"
#include "base/language/say.hpp"
#include "check/frequency.hpp"
#include "check/written/words.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

bool holds_letters_only(const std::set<std::string>& names, const Scene& scene) {
    return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
        return name == "pi" || std::any_of(scene.parameters.begin(), scene.parameters.end(),
                                           [&](const Parameter& p) { return p.name.text == name; });
    });
}

Expression parsed(const std::string& text) {
    std::vector<Diagnostic> mistakes;
    return parse_expression(text, {}, mistakes);
}

std::vector<std::pair<std::string, Expression>> parsed(const BaseState& base) {
    std::vector<std::pair<std::string, Expression>> result;
    for (const auto& [name, value] : base.values) result.emplace_back(name, parsed(value));
    return result;
}

/// T_2, V_1: energies of parts too.
bool is_energy_alone(const Math& side) {
    static constexpr const char* letters[] = {"T", "K", "V", "U", "L", "E", "H"};
    return side.kind == Kind::letter && side.dots == 0 &&
           std::find(std::begin(letters), std::end(letters), side.letter.base) != std::end(letters);
}

}  // namespace

/// The letter is that of a frequency of which nothing is judged.
void Marker::define_frequency(MarkedLine& line, const Math& letter, const Math& rhs, int power) {
    if (!letters_.name_of(letter.letter)) define(line, letter, rhs, power);
    line.status = LineStatus::undecided;
}

/// ω² = g/l, T = 2π √(l/g): a letter for a frequency or a period, in parameters. Judged if the words say so, or
/// once the derivation has linearized; before that, ω₀² = g/l only gives a name.
bool Marker::is_frequency(MarkedLine& line, const Math& letter, const Math& rhs, int power) {
    const std::string& base = letter.letter.base;
    const bool of_period = (base == "T" || base == "tau" || base == "P") && speaks_of_period_;
    const bool of_turns = (base == "f" || base == "nu") && speaks_of_frequency_;
    const bool of_angle = base == "omega" || base == "Omega" || base == "lambda";
    if (!of_period && !of_turns && !(of_angle && (speaks_of_frequency_ || speaks_of_small_))) return false;
    const ClaimText text = claim_text(rhs, as_written());
    if (!holds_letters_only(text.names, system_.scene())) return false;
    std::string omega = power == 2 ? text.text : "(" + text.text + ")^2";
    if (of_period) omega = "4*pi^2/(" + omega + ")";
    if (of_turns) omega = "4*pi^2*(" + omega + ")";
    const Expression square = parsed(omega);
    if (!square) return false;
    bool known = false;
    for (const BaseState& state : bases()) {
        const CheckedFrequency found =
            check_frequency({system_.scene(), system_.mechanism(), parsed(state), system_.sheets()}, square);
        if (found.verdict == Verdict::undecided) continue;
        known = true;
        line.checked = found;
        if (found.verdict != Verdict::proved) continue;
        const Expression other = parsed("2*(" + omega + ")"), third = parsed("3*(" + omega + ")");
        const AtPoint at{system_.scene(), system_.mechanism(), parsed(state), system_.sheets()};
        if (check_frequency(at, other).verdict == Verdict::proved &&
            check_frequency(at, third).verdict == Verdict::proved) {
            known = false;  // where the inertia matrix is singular any value is one
            continue;
        }
        if (!near_ && own_bases_.empty() && names_state_or_mode(said_)) {
            define_frequency(line, letter, rhs, power);
            line.reason =
                say("it is a frequency about {}; whether of the state or mode that the words name is not judged",
                    state.text);
            return true;
        }
        line.status = LineStatus::right_near;
        line.reason = say("a frequency of small vibrations about {}", state.text);
        break;
    }
    if (!known && (speaks_of_frequency_ || speaks_of_period_)) {
        define_frequency(line, letter, rhs, power);
        line.reason = say("no state of rest is known about which it is a frequency");
        return true;
    }
    if (!known || (line.status != LineStatus::right_near && !speaks_of_frequency_ && !speaks_of_period_))
        return false;
    if (line.status != LineStatus::right_near) {
        line.follows_from = own_.explains_frequency(truth_.value(omega));
        line.status = line.follows_from ? LineStatus::follows : LineStatus::mistake;
        line.reason = line.follows_from ? say("it follows from line {}", lines[*line.follows_from].line)
                                        : say("it is no frequency of small vibrations");
    }
    const LineStatus status = line.status;
    const std::string reason = line.reason;
    const bool is_open = !letters_.name_of(letter.letter);
    if (is_open) define(line, letter, rhs, power);
    line.status = status;
    line.reason = reason;
    if (line.claim.empty())
        line.claim = identifier_of(letter.letter) + (power == 2 ? "^2" : "") + " = " + text.text;
    return true;
}

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

/// Equilibria: θ = 0, or an equation that holds there.
bool Marker::is_equilibrium(MarkedLine& line, const Sides& sides) {
    if ((speaks_of_roots_ || says_rest()) && is_root(line, sides)) return true;
    const bool is_of_motion = holds_rates(*sides.lhs) || holds_rates(*sides.rhs);
    if (says_rest() && !is_of_motion && !has_quantities(sides) && is_condition_of_rest(line, sides)) return true;
    if (!speaks_of_rest_ && !statement_->displayed) return false;
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
    if (found.verdict == Verdict::undecided || (found.verdict != Verdict::proved && !speaks_of_rest_))
        return false;
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
    return speaks_of_rest_ || is_rest_assumed_;
}

bool Marker::holds_at_rest(MarkedLine& line, const Sides& sides) {
    if (at_rest_of_rates_) {
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
        const std::vector<CheckedClaim> verdicts = system_.check({claim}, known_);
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
    notes_.back().claim = claim;
    line.status = LineStatus::right;
    line.reason = say("of states of rest");
    return true;
}

/// The states about which lines may be linearized: the one that a line has shown, or those that the author
/// deviates from, or the scene's own.
std::vector<BaseState> Marker::bases() const {
    if (near_) return {*near_};
    return own_bases_.empty() ? base_states(system_.scene()) : own_bases_;
}

/// r = l_0 + m g/k + ξ: a deviation ξ from a state of rest.
void Marker::note_base(const Math& lhs, const Math& rhs, const Letter& deviation) {
    const Math& coordinate = lhs.kind == Kind::letter ? lhs : rhs;
    const Math& sum = &coordinate == &lhs ? rhs : lhs;
    if (coordinate.kind != Kind::letter || coordinate.dots > 0 || sum.kind != Kind::sum) return;
    const auto name = letters_.name_of(coordinate.letter);
    const std::vector<std::string>& all = letters_.coordinates();
    if (!name || std::find(all.begin(), all.end(), *name) == all.end()) return;
    Math rest = sum;
    std::erase_if(rest.args, [&](const MathPtr& term) {
        const Math& inner = term->kind == Kind::negate ? *term->args[0] : *term;
        return inner.kind == Kind::letter && inner.letter == deviation;
    });
    if (rest.args.size() + 1 != sum.args.size()) return;
    const ClaimText value = claim_text(rest.args.size() == 1 ? *rest.args[0] : rest, as_written());
    if (!holds_letters_only(value.names, system_.scene())) return;
    std::vector<BaseState> bases = own_bases_.empty() ? base_states(system_.scene()) : own_bases_;
    for (BaseState& base : bases) {
        base.text.clear();
        for (auto& [q, place] : base.values) {
            if (q == *name) place = value.text;
            base.text += (base.text.empty() ? "" : ", ") + q + " = " + place;
        }
    }
    own_bases_ = std::move(bases);
    near_.reset();
}

/// cos θ ≈ 1 + θ²/2: terms of second order that are written are to be right.
bool Marker::states_second_order(const Sides& sides, const ex& residual, const BaseState& base) {
    if (is_accelerated(*sides.lhs) || is_accelerated(*sides.rhs)) return false;
    if (is_small(residual, base, 2, false, system_)) return false;
    const ex value = truth_.value(sides.right.text);
    const std::optional<ex> first = linear_part(value, base, system_);
    return first && !is_small(value - *first, base, 2, true, system_);
}

bool Marker::holds_near(MarkedLine& line, const Sides& sides, const ex& residual) {
    if (!speaks_of_small_) return false;
    const auto speaks_of = [&](MechanicalQuantity quantity) {
        const std::string name = letters_.name_of(quantity);
        return sides.left.names.contains(name) || sides.right.names.contains(name);
    };
    const bool of_potential = speaks_of(MechanicalQuantity::potential) ||
                              speaks_of(MechanicalQuantity::lagrangian) || speaks_of(MechanicalQuantity::energy);
    const int order =
        of_potential || speaks_of(MechanicalQuantity::kinetic) || is_energy_alone(*sides.lhs) ? 2 : 1;
    for (const BaseState& base : bases()) {
        if (!may_rest(base, system_)) continue;
        bool holds = is_small(residual, base, order, of_potential, system_);
        if (holds && order == 1 && states_second_order(sides, residual, base)) continue;
        if (!holds && order == 1) {
            const auto checked = checked_near(notes_.back().claim, base, system_, known_);
            holds = checked && checked->verdict == Verdict::proved;
            if (checked) near_ = base;
        }
        if (!holds) continue;
        line.status = LineStatus::right_near;
        line.reason = say("to first order near {}", base.text);
        return true;
    }
    return false;
}

}  // namespace alembert
