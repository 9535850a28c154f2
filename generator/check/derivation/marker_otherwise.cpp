// SPDX-License-Identifier: GPL-2.0-or-later
// Lines that are right in another sense: up to a constant, of all forces, of a quantity that shares its letter.
#include "check/derivation/marker.hpp"

#include <algorithm>
#include <functional>

#include "base/language/say.hpp"
#include "check/total_derivative.hpp"
#include "check/written/word_kinds.hpp"
#include "check/written/words.hpp"
#include "model/energy.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

/// T = ½ m v² in a scene whose string pulls with T: what stands alone may be the kinetic energy.
bool Marker::is_of_quantity(MarkedLine& line, const Sides& sides) {
    if (notes_.back().alone_is_quantity) return false;
    const auto differs = [&](const Math& side) {
        if (side.kind != Kind::letter || side.dots > 0) return false;
        const auto quantity = letters_.name_of(side.letter, true);
        return quantity && known_.contains(*quantity) && quantity != letters_.name_of(side.letter);
    };
    if (!differs(*sides.lhs) && !differs(*sides.rhs)) return false;
    const LineNotes before = notes_.back();
    MarkedLine other = line;
    notes_.back().alone_is_quantity = true;
    judge_pair(other, *sides.lhs, *sides.rhs);
    const bool is_force = is_accelerated(*sides.lhs) || is_accelerated(*sides.rhs);  // no energy
    if (other.status == LineStatus::mistake && is_force) {
        notes_.back() = before;
        return false;
    }
    line = std::move(other);
    return true;
}

/// ∂v/∂ψ' = −a cos φ where rolling has been solved for φ': the other rates change with the independent one.
bool Marker::is_in_independent_rates(MarkedLine& line, const Sides& sides) {
    const auto is_partial = [&](const Math& side) {
        if (side.kind != Kind::partial || side.args.size() != 2 || side.args[1]->dots == 0) return false;
        const auto by = letters_.name_of(side.args[1]->letter);
        return by && speeds_.contains(*by + "'");
    };
    if (notes_.back().rates_are_speeds || (!is_partial(*sides.lhs) && !is_partial(*sides.rhs))) return false;
    notes_.back().rates_are_speeds = true;
    const Sides other = sides_of(*sides.lhs, *sides.rhs);
    MotionRows& rows = system_.rows();
    if (rows.holds(rows.row(truth_.value(other.left.text) - truth_.value(other.right.text))) == true) {
        solves_constraints_ = true;
        judge_pair(line, *sides.lhs, *sides.rhs);
        return true;
    }
    notes_.back().rates_are_speeds = solves_constraints_;
    if (solves_constraints_) judge_pair(line, *sides.lhs, *sides.rhs);
    return solves_constraints_;
}

/// θ'' = θ' dθ'/dθ: slopes along the motion.
bool Marker::is_along_motion(MarkedLine& line, const Sides& sides) {
    const std::function<bool(const Math&)> has_slope = [&](const Math& math) {
        return (math.kind == Kind::partial && math.text == "d") ||
               std::any_of(math.args.begin(), math.args.end(),
                           [&](const MathPtr& arg) { return has_slope(*arg); });
    };
    if (notes_.back().slopes_are_of_motion || (!has_slope(*sides.lhs) && !has_slope(*sides.rhs))) return false;
    notes_.back().slopes_are_of_motion = true;
    const Sides other = sides_of(*sides.lhs, *sides.rhs);
    MotionRows& rows = system_.rows();
    const bool is_exact =
        rows.holds(rows.row(truth_.value(other.left.text) - truth_.value(other.right.text))) == true;
    const bool holds = is_exact || is_on_branch(line, other);  // dr/dφ = √…
    if (is_exact) judge_pair(line, *sides.lhs, *sides.rhs);
    notes_.back().slopes_are_of_motion = holds;
    return holds;
}

/// l = 2 m: a number for a parameter of the scene says nothing about its mechanics.
bool Marker::is_given_value(MarkedLine& line, const Sides& sides) {
    const auto is_value = [&](const ClaimText& side) {
        return side.names.empty() && (side.text != "0" || !statement_->displayed);
    };
    const bool left = !sides.left.names.empty() && is_value(sides.right);
    const bool right = !sides.right.names.empty() && is_value(sides.left);
    if (!left && !right) return false;
    const std::set<std::string>& names = left ? sides.left.names : sides.right.names;
    if (std::any_of(names.begin(), names.end(),
                    [&](const std::string& name) { return !letters_.is_of_scene(name) || letters_.moves(name); }))
        return false;
    const std::string name = left ? sides.left.text : sides.right.text;
    if (!statement_->displayed) heard_.put_under_condition();
    line.status = LineStatus::not_about_scene;
    line.reason = say("a value of {}; lines are judged for all values", name);
    return true;
}

/// p_x = (2 M + m) x' with rolling put in for the other rates: the momentum of the reduced Lagrangian, of
/// displacements in which the coordinates that no constraint binds stay.
bool Marker::is_reduced_momentum(MarkedLine& line, const Sides& sides) {
    const Mechanism& m = system_.mechanism();
    const std::string& name = sides.left.text;
    if (!name.starts_with("p_") || !known_.contains(name) || system_.equations().A.empty()) return false;
    const std::vector<ex> momenta = m.z->pull_back({{m.lagrangian(), 1}}, m.qdot);
    const ex stated = truth_.value(sides.right.text);
    std::vector<ex> factors;
    for (std::size_t i = 0; i < m.q.size(); ++i) {
        const bool is_bound = std::any_of(system_.equations().A.begin(), system_.equations().A.end(),
                                          [&](const auto& row) { return !row[i].is_zero(); });
        const bool is_it = name == "p_" + m.q[i].get_name();
        factors.push_back(is_bound || is_it ? m.z->name(momenta[i] - (is_it ? stated : ex(0))) : ex(0));
    }
    if (system_.rows().is_bound(factors) != true) return false;
    line.status = LineStatus::right;
    line.reason = say("with the constraints put in");
    notes_.back().claim = {};
    return true;
}

/// "(r'' = 0)"
bool Marker::is_aside() const {
    const std::size_t at =
        written_.text.find_last_not_of("$", statement_->offset > 0 ? statement_->offset - 1 : 0);
    return statement_->offset > 0 && at != std::string::npos && written_.text[at] == '(';
}

/// "In the mode θ₁ = θ₂", "at θ = 0": among words, coordinates alone or with numbers describe a state.
bool Marker::is_assumption(MarkedLine& line, const Sides& sides) {
    const auto is_plain = [&](const Math& math) {
        const Math& inner = math.kind == Kind::negate ? *math.args[0] : math;
        std::map<Letter, int> all;
        collect_letters(inner, all);
        const bool is_constant = std::all_of(all.begin(), all.end(), [&](const auto& item) {
            const std::string name = letters_.name_of(item.first).value_or("");
            return name == "pi" || (letters_.is_of_scene(name) && !letters_.moves(name));
        });
        const int most_dots =  // "if the hand is at rest, h'' = 0", "(r'' = 0)"
            is_aside() || begins_condition_of_state(statement_->words) ? 2 : 1;
        return is_constant || (inner.kind == Kind::letter && inner.dots <= most_dots);
    };
    if (statement_->displayed || !is_plain(*sides.lhs) || !is_plain(*sides.rhs)) return false;
    if (speaks_of_nearness(statement_->words)) heard_.small = true;  // "near θ = 0 it gives"
    const Mechanism& m = system_.mechanism();
    const auto moves = [&](const ClaimText& side) {
        return std::any_of(side.names.begin(), side.names.end(), [&](const std::string& name) {
            if (letters_.moves(name)) return !is_input(name);
            const ex value = truth_.value(name);  // λ, or ω for φ'
            return m.z->depends(value, system_.equations().lambda) || m.z->depends(value, m.qdot) ||
                   (m.z->depends(value, m.q) && is_number(*sides.rhs) && !has_quantities(sides));
        });
    };
    if (!is_aside() && !moves(sides.left) && !moves(sides.right)) return false;
    if (is_aside() || speaks_of_special_case(statement_->words) || ends_at_place(statement_->words) ||
        sets_value(statement_->words))
        heard_.put_under_condition();
    note_place(*sides.lhs, *sides.rhs);
    line.status = LineStatus::not_about_scene;
    line.reason = say("it describes a state; lines are judged for all motions");
    return true;
}

/// Q_θ alone on a side.
bool Marker::is_lone_force(const Math& side) const {
    return side.kind == Kind::letter && side.dots == 0 && quantity_of(side.letter) == MechanicalQuantity::force;
}

/// Whether the reading of Q_θ = … is that of the other forces too: it says which forces the derivation counts.
void Marker::note_forces(const Sides& sides) {
    if (!is_lone_force(*sides.lhs) && !is_lone_force(*sides.rhs)) return;
    const bool before = all_forces_;
    use_all_forces(!before);
    const MotionRow other = system_.rows().row(truth_.value(sides.left.text) - truth_.value(sides.right.text));
    use_all_forces(before);
    if (system_.rows().holds(other) != true) has_told_forces_ = true;
}

bool Marker::holds_with_all_forces(MarkedLine& line, const Sides& sides) {
    const auto speaks = [](const std::set<std::string>& names) {
        return std::any_of(names.begin(), names.end(),
                           [](const std::string& name) { return name.starts_with("Q_"); });
    };
    if (!speaks(sides.left.names) && !speaks(sides.right.names)) return false;
    const bool states_one = is_lone_force(*sides.lhs) || is_lone_force(*sides.rhs);
    const bool before = all_forces_;
    use_all_forces(!before);
    const MotionRow row = system_.rows().row(truth_.value(sides.left.text) - truth_.value(sides.right.text));
    if (states_one && has_told_forces_) {  // one text has one meaning of Q
        if (system_.rows().holds(row) == true) notes_.back().claim = {};
        use_all_forces(before);
        return false;
    }
    if (system_.rows().holds(row) == true) {
        has_told_forces_ = has_told_forces_ || states_one;
        judge_true(line, sides, row);
        if (line.reason.empty())
            line.reason = all_forces_ ? say("here generalized forces are those of all forces, with those of V")
                                      : say("here generalized forces are those of forces that are not in V");
        return true;
    }
    use_all_forces(before);
    return false;
}

bool Marker::follows_with_all_forces(MarkedLine& line, const Sides& sides) {
    const std::set<std::string> names = sides.own_names();
    if (std::none_of(names.begin(), names.end(), [](const std::string& name) { return name.starts_with("Q_"); }))
        return false;
    use_all_forces(!all_forces_);
    if (follows(line, sides)) return true;
    use_all_forces(!all_forces_);
    return false;
}

void Marker::use_all_forces(bool all) {
    all_forces_ = all;
    own_.count_potential_forces(all);
    const std::vector<ex> forces = system_.forces(all);
    for (std::size_t i = 0; i < forces.size(); ++i) {
        const std::string name = "Q_" + system_.mechanism().q[i].get_name();
        if (!known_.contains(name)) continue;
        known_[name] = forces[i];
        truth_.know(name, forces[i]);
    }
}

/// V = −m g l cos θ − P x: the loads that have a potential are in it.
bool Marker::is_potential_of_all(MarkedLine& line, const Sides& sides) {
    const std::string name = letters_.name_of(MechanicalQuantity::potential);
    if (sides.left.text != name) return false;
    const Mechanism& m = system_.mechanism();
    const std::vector<ex> slopes = m.z->pull_back({{truth_.value(sides.right.text), 1}}, m.q),
                          all = system_.forces(true), others = system_.forces(false);
    std::vector<ex> of_loads;  // beside those that the scene's V gives
    for (std::size_t i = 0; i < all.size(); ++i) of_loads.push_back(others[i] - all[i] - slopes[i]);
    if (!is_sum_of(forces_of_loads(), of_loads)) return false;
    line.status = LineStatus::right_up_to_constant;
    line.reason = say("with the potential of the loads");
    notes_.back().claim = {};
    know_potential(truth_.value(sides.right.text));
    return true;
}

/// From then on V, and L, E and H with it, are those of all forces that have a potential.
void Marker::know_potential(const ex& value) {
    const auto name = [&](MechanicalQuantity quantity) { return letters_.name_of(quantity); };
    const ex T = truth_.value(name(MechanicalQuantity::kinetic)),
             more = value - truth_.value(name(MechanicalQuantity::potential));
    const std::pair<MechanicalQuantity, ex> all[] = {
        {MechanicalQuantity::potential, value},
        {MechanicalQuantity::lagrangian, T - value},
        {MechanicalQuantity::energy, T + value},
        {MechanicalQuantity::hamiltonian, truth_.value(name(MechanicalQuantity::hamiltonian)) + more}};
    for (const auto& [quantity, meant] : all) {
        known_[name(quantity)] = system_.mechanism().z->name(meant);
        truth_.know(name(quantity), known_[name(quantity)]);
    }
    has_potential_of_all_ = true;
}

/// A potential has any zero, and the derivative of a function of coordinates and time changes nothing in a
/// Lagrangian.
bool Marker::holds_up_to(MarkedLine& line, const Sides& sides, const ex& residual) {
    const auto speaks_of = [&](std::initializer_list<MechanicalQuantity> list) {  // as what is said to be equal
        return std::any_of(list.begin(), list.end(), [&](MechanicalQuantity quantity) {
            const std::string name = letters_.name_of(quantity);
            return sides.left.text == name || sides.right.text == name;
        });
    };
    const Mechanism& m = system_.mechanism();
    MotionRows& rows = system_.rows();
    if (m.z->depends(residual, m.qddot)) return false;
    if (speaks_of({MechanicalQuantity::potential, MechanicalQuantity::energy, MechanicalQuantity::hamiltonian,
                   MechanicalQuantity::lagrangian})) {
        const ex rate = m.time_derivative({residual})[0];
        if (rows.is_identity(rows.row(rate)) == true) {
            line.status = LineStatus::right_up_to_constant;
            return true;
        }
    }
    if (speaks_of({MechanicalQuantity::potential}) && is_potential_of_all(line, sides)) return true;
    if (!speaks_of({MechanicalQuantity::lagrangian})) return false;
    for (const ex& row : euler_operator(residual, m))
        if (rows.is_identity(rows.row(row)) != true) return false;
    line.status = LineStatus::right_up_to_derivative;
    has_own_gauge_ = true;
    return true;
}

/// E = ½ μ r'² + V_eff of the relative motion: a constant of the motion, but no multiple of the whole energy.
bool Marker::is_energy_of_part(MarkedLine& line, const Sides& sides) {
    const std::string name = letters_.name_of(MechanicalQuantity::energy);
    if (sides.left.text != name) return false;
    const Mechanism& m = system_.mechanism();
    MotionRows& rows = system_.rows();
    const ex stated = truth_.value(sides.right.text), whole = truth_.value(name);
    if (m.z->depends(stated, m.qddot) || !m.z->depends(stated, m.qdot)) return false;
    if (!does_not_change(stated)) return false;
    for (const GiNaC::symbol& rate : m.qdot) {  // a multiple of the whole has the same ratio of all slopes
        const ex own = m.z->pull_back({{stated, 1}}, {rate})[0], other = m.z->pull_back({{whole, 1}}, {rate})[0];
        if (rows.is_identity(rows.row(own)) == true && rows.is_identity(rows.row(other)) != true) {
            line.status = LineStatus::definition;
            line.reason = say("a constant of the motion, and not the energy of the whole");
            notes_.back().claim = {};
            return true;
        }
    }
    return false;
}

/// T = ¾ m (R − a)² φ'² with rolling put in: its derivatives are those of the author's T.
void Marker::note_reduced(const Sides& sides, const MotionRow& row) {
    if (system_.equations().A.empty()) return;
    for (const MechanicalQuantity quantity : {MechanicalQuantity::kinetic, MechanicalQuantity::lagrangian,
                                              MechanicalQuantity::potential, MechanicalQuantity::hamiltonian})
        if (sides.left.text == letters_.name_of(quantity) &&
            !is_identically_zero(row.residual, system_.mechanism()))
            has_own_gauge_ = true;
}

/// V = … + const: right if the constant is one.
bool Marker::is_constant_of_potential(MarkedLine& line, const Sides& sides, const Letter& letter,
                                      const ex& value) {
    const bool is_name = is_word_for_constant(letter.base) || is_letter_of_constant(letter) ||
                         (letter.base == "V" && letter.index == "0") ||
                         (letter.base == "U" && letter.index == "0");
    const std::string V = letters_.name_of(MechanicalQuantity::potential);
    if (!is_name || (sides.left.text != V && sides.right.text != V)) return false;
    const Mechanism& m = system_.mechanism();
    std::vector<ex> slopes = m.z->pull_back({{value, 1}}, m.q);
    MotionRows& rows = system_.rows();
    const bool is_constant = std::all_of(
        slopes.begin(), slopes.end(), [&](const ex& slope) { return rows.is_identity(rows.row(slope)) == true; });
    const std::vector<BaseState> near = bases();
    if (!is_constant && heard_.small && std::any_of(near.begin(), near.end(), [&](const BaseState& base) {
            return is_small(value, base, 2, true, system_);
        })) {
        line.status = LineStatus::right_near;
        line.reason = say("to first order near {}", near.front().text);
        return true;
    }
    line.status = is_constant ? LineStatus::right_up_to_constant : LineStatus::mistake;
    line.claim = sides.left.text + " = " + sides.right.text;
    return true;
}

/// A momentum of the Lagrangian that the derivation has stated, which is right up to a total derivative.
bool Marker::is_of_own_gauge(MarkedLine& line, const Sides& sides) {
    if (!has_own_gauge_ || own_.wrong_in(sides.own_names())) return false;
    MotionRows& rows = system_.rows();
    if (rows.is_identity(rows.row(own_residual(sides))) != true) return false;
    line.status = LineStatus::right;
    line.reason = say("with the energies that stand above");
    notes_.back().claim = {};
    return true;
}

/// L' = L + d/dt f: a prime that makes another Lagrangian, and no rate.
bool Marker::is_of_authors_function(MarkedLine& line, const Math& lhs, const Math& rhs) {
    const bool may_be = lhs.kind == Kind::letter && lhs.dots == 1 &&
                        letters_.name_of(lhs.letter) == letters_.name_of(MechanicalQuantity::lagrangian);
    if (!may_be) return false;
    Math plain = lhs;
    plain.dots = 0;
    MarkedLine other = line;
    other.status = LineStatus::undecided;
    LineNotes before = notes_.back();
    judge_pair(other, plain, rhs);
    if (!is_right(other.status)) {
        notes_.back() = std::move(before);
        return false;
    }
    line = std::move(other);
    return true;
}

}  // namespace alembert
