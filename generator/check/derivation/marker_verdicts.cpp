// SPDX-License-Identifier: GPL-2.0-or-later
// A line that holds, and one that does not: does it follow from what stands above, and from which line does it
// come?
#include <algorithm>

#include "base/language/say.hpp"
#include "check/derivation/marker.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

bool is_rate_alone(const Math& side) {
    return (side.kind == Kind::letter && side.dots == 1) ||
           (side.kind == Kind::rate && side.dots == 1 && side.args[0]->kind == Kind::letter);
}

}  // namespace

/// q' = ∂H/∂p, p' = −∂H/∂q: true of the scene's H whatever the author has found it to be.
bool Marker::is_law_of_hamilton(const Sides& sides) const {
    const auto is_slope = [&](const Math& side) {
        const Math& inner = side.kind == Kind::negate ? *side.args[0] : side;
        return inner.kind == Kind::partial && inner.args[0]->kind == Kind::letter &&
               letters_.name_of(inner.args[0]->letter) == letters_.name_of(MechanicalQuantity::hamiltonian);
    };
    return (is_slope(*sides.lhs) && is_rate_alone(*sides.rhs)) ||
           (is_rate_alone(*sides.lhs) && is_slope(*sides.rhs));
}

/// d/dt ∂L/∂q' = ∂L/∂q is right, and gives no equation of motion that is written out.
bool Marker::repeats_law(const Sides& sides) const {
    const auto is_law = [&](const std::string& name) {
        const auto is = [&](MechanicalQuantity quantity) { return name == letters_.name_of(quantity); };
        return name.starts_with("Q_") || is(MechanicalQuantity::kinetic) || is(MechanicalQuantity::potential) ||
               is(MechanicalQuantity::lagrangian) || is(MechanicalQuantity::energy) ||
               is(MechanicalQuantity::hamiltonian);
    };
    return std::any_of(sides.left.names.begin(), sides.left.names.end(), is_law) ||
           std::any_of(sides.right.names.begin(), sides.right.names.end(), is_law);
}

bool Marker::has_quantities(const Sides& sides) const {
    std::set<std::string> energies;
    for (const MechanicalQuantity quantity :
         {MechanicalQuantity::kinetic, MechanicalQuantity::potential, MechanicalQuantity::lagrangian,
          MechanicalQuantity::energy, MechanicalQuantity::hamiltonian})
        energies.insert(letters_.name_of(quantity));
    const auto is_one = [&](const std::string& name) {
        const bool is_along = name.starts_with("p_") || name.starts_with("Q_");
        return known_.contains(name) && (is_along || energies.contains(name));
    };
    return std::any_of(sides.left.names.begin(), sides.left.names.end(), is_one) ||
           std::any_of(sides.right.names.begin(), sides.right.names.end(), is_one);
}

/// Q = 0, of rest
bool Marker::is_balance(const Sides& sides) const {
    return is_lone_force(*sides.lhs) && is_number(*sides.rhs);
}

/// Newton's law of a part, p' = …, what an energy is in letters: a law that no other line has to give, so that no
/// mistake above says anything about it.
bool Marker::stands_by_itself(const Sides& sides, bool is_identity) const {
    if (is_new_law_ || (!is_identity && repeats_law(sides))) return true;
    const Mechanism& m = system_.mechanism();
    const std::set<std::string> names = sides.own_names();
    const bool has_force = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        const auto known = known_.find(name);
        const bool is_force = known != known_.end() && (m.z->depends(known->second, m.qddot) ||
                                                        m.z->depends(known->second, system_.equations().lambda));
        return is_multiplier(name) || is_force;
    });
    const auto is_rate_of_momentum = [&](const Math& side) {
        if (!is_rate_alone(side)) return false;
        const Letter& letter = side.kind == Kind::rate ? side.args[0]->letter : side.letter;
        const std::string name = letters_.name_of(letter).value_or("");
        return name.starts_with("p_") && !letters_.is_of_scene(name);
    };
    const bool is_momentum_law = is_rate_of_momentum(*sides.lhs) || is_rate_of_momentum(*sides.rhs);
    const Lone lone = lone_letter(*statement_->sides.front());
    const bool is_energy = lone.letter != nullptr && quantity_of(lone.letter->letter) && is_identity;
    return has_force || is_balance(sides) || is_momentum_law || is_energy;
}

void Marker::judge_true(MarkedLine& line, const Sides& sides, const MotionRow& row) {
    if (is_wrong_derivative(line, sides)) return;
    line.status = LineStatus::right;
    MotionRows& rows = system_.rows();
    const bool is_identity = rows.is_identity(row) == true;
    const MotionRow own = rows.row(own_residual(sides));
    if (is_law_of_hamilton(sides)) return;
    note_forces(sides);
    if (!is_identity && !repeats_law(sides)) notes_.back().equation = row;
    const std::optional<std::size_t> wrong = own_.wrong_in(sides.own_names());
    const bool has_mistake = std::any_of(lines.begin(), lines.end(), [](const MarkedLine& one) {
        return one.status == LineStatus::mistake || one.status == LineStatus::follows;
    });
    if (!has_mistake) return note_reduced(sides, row);  // nothing stands above from which it could not follow
    if (stands_by_itself(sides, is_identity)) return note_reduced(sides, row);
    const bool founded =
        is_identity ? !wrong || rows.is_identity(own) == true : own_.founds(own) || own_.founds(row);
    if (founded) return note_reduced(sides, row);
    line.status = LineStatus::unfounded;
    line.follows_from = wrong;
    line.reason = say("it is right, but it does not follow from what stands above");
}

void Marker::judge_false(MarkedLine& line, const Sides& sides, const MotionRow& row) {
    if (is_balance(sides)) heard_.assumed_rest = true;
    if (is_approximation(line, sides) || is_of_own_gauge(line, sides) || is_energy_of_part(line, sides) ||
        (is_aside() && is_assumption(line, sides)) || holds_after_impact(line, sides) ||
        is_assumption(line, sides) || is_reduced_momentum(line, sides))
        return;
    if (is_of_quantity(line, sides) || is_in_independent_rates(line, sides) || is_along_motion(line, sides) ||
        is_equilibrium(line, sides) || is_given_value(line, sides) || is_on_branch(line, sides) ||
        holds_with_all_forces(line, sides) || holds_up_to(line, sides, row.residual) ||
        holds_at_rest(line, sides) || holds_at_some_rest(line, sides) || holds_near(line, sides, row.residual) ||
        holds_near_some_rest(line, row.residual) || follows(line, sides) || follows_with_all_forces(line, sides) ||
        follows_from_inertia(line, sides))
        return;
    if (deviates_from_motion()) {
        line.status = LineStatus::undecided;
        line.reason = say("the state from which it deviates is no state of rest");
        notes_.back().claim = {};
        return;
    }
    line.status = LineStatus::mistake;
    notes_.back().has_assumed = has_assumed_;
    notes_.back().is_of_rest = says_rest();
    if (heard_.small) notes_.back().near = near_;
    if (heard_.small && !near_ && order_of(notes_.back().claim) == 2)
        notes_.back().near = base_states(system_.scene()).front();
    if (own_.wrong_in(sides.own_names())) notes_.back().own = own_.values();
}

/// p' = −∂H/∂q and q' = ∂H/∂p with the author's own H.
bool Marker::is_from_own_hamiltonian(MarkedLine& line, const Sides& sides) {
    const Math& rate = is_rate_alone(*sides.lhs) ? *sides.lhs : *sides.rhs;
    const std::string& value = &rate == sides.lhs ? sides.own_right.text : sides.own_left.text;
    if (!is_rate_alone(rate)) return false;
    const Letter& letter = rate.kind == Kind::rate ? rate.args[0]->letter : rate.letter;
    const std::string name = letters_.name_of(letter).value_or(""),
                      H = letters_.name_of(MechanicalQuantity::hamiltonian);
    const bool is_momentum = name.starts_with("p_") && !letters_.is_of_scene(name);
    const std::string key =
        is_momentum ? "diff(" + H + "," + name.substr(2) + ")" : "diff(" + H + ",p_" + name + ")";
    const auto step = own_.steps().find(key);
    if (step == own_.steps().end() || !own_.is_wrong_step(key)) return false;
    MotionRows& rows = system_.rows();
    const ex slope = own_.value(step->second);
    if (rows.is_identity(rows.row((is_momentum ? -slope : slope) - own_.value(value))) != true) return false;
    line.follows_from = own_.wrong_in({step->second});
    line.status = LineStatus::follows;
    line.reason = say("it follows from line {}", lines[*line.follows_from].line);
    return true;
}

/// Whether both, at rest, are the same condition but for a factor without coordinates.
bool Marker::is_same_at_rest(const ex& residual, const ex& other) const {
    const Mechanism& m = system_.mechanism();
    const auto numerator = [&](const ex& of) {
        const ex argument = GiNaC::wild(0);
        const ex whole = m.z->expand(system_.at_rest({of})[0]);
        return whole.subs(GiNaC::tan(argument) == GiNaC::sin(argument) / GiNaC::cos(argument)).normal().numer();
    };
    constexpr double most_at_rest = 1000;  // nodes
    if (m.z->tree_size(residual) + m.z->tree_size(other) > most_at_rest) return false;
    const ex a = numerator(residual), b = numerator(other);
    if (a.is_zero() || b.is_zero()) return false;
    return std::all_of(m.q.begin(), m.q.end(), [&](const GiNaC::symbol& q) {
        return is_identically_zero(m.z->name(a * b.diff(q) - b * a.diff(q)), m);
    });
}

bool Marker::follows(MarkedLine& line, const Sides& sides) {
    MotionRows& rows = system_.rows();
    const MotionRow own = rows.row(own_residual(sides));
    line.follows_from =
        rows.is_identity(own) == true ? own_.wrong_in(sides.own_names()) : own_.explained_by(own, heard_.small);
    if (!line.follows_from) line.follows_from = own_.explained_by_relations(own.residual);
    if (!line.follows_from && is_from_own_hamiltonian(line, sides)) return true;
    if (!line.follows_from && heard_.small) {
        const BaseState base = near_ ? *near_ : base_states(system_.scene()).front();
        line.follows_from = own_.explained_by_linearizing(
            own.residual, [&](const ex& e) { return linear_part(e, base, system_); });
    }
    const bool is_of_rest = says_rest() && !holds_rates(*sides.lhs) && !holds_rates(*sides.rhs);
    if (!line.follows_from && is_of_rest)
        line.follows_from = own_.explained_at_rest([&](const ex& e) { return is_same_at_rest(own.residual, e); });
    if (!line.follows_from) return false;
    line.status = LineStatus::follows;
    line.reason = say("it follows from line {}", lines[*line.follows_from].line);
    return true;
}

}  // namespace alembert
