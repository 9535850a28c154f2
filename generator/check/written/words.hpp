// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the words between formulas say.

#include <string>
#include <string_view>
#include <vector>

namespace alembert {

/// "if", "for", "when": what follows is a condition.
bool begins_condition(std::string_view words);

/// "therefore", "hence", "so".
bool speaks_of_consequence(std::string_view words);

/// "small angles", "linearize", "first order".
bool speaks_of_first_order(std::string_view words);

/// "No approximation like c ≪ … is made", "even as x → 0": the limit in the sentence is not taken.
bool denies_limit(std::string_view sentence);

/// "The exact equation", "for arbitrary angles": it is no longer linearized.
bool speaks_of_exact_motion(std::string_view words);

/// "If the wedge is held", "for a cart that does not move": what the last sentence says holds for a part of the
/// motions. "When the bead moves", "if we insert" are no conditions.
bool states_condition(std::string_view words);

/// "If the pendulum hangs at a constant angle, then": what follows holds under a condition that the words
/// describe. Not so where they tell what is done with formulas, as "if we differentiate".
bool is_conditional(std::string_view words);

/// "Near the straight column a = b = 0": lines are held to first order from then on.
bool speaks_of_nearness(std::string_view words);

/// "What is conserved is Jacobi's function": what follows is said to keep its value.
bool says_conserved_is(std::string_view words);

/// "We have", "hence": what follows is said to be so, and no condition.
bool asserts(std::string_view words);

/// "In the Kepler problem the analogous thing is": what follows is about another system.
bool speaks_of_other_system(std::string_view words);

/// "The effective potential is": what it names is not the potential of the forces.
bool speaks_of_effective_potential(std::string_view words);

/// "Let φ' = Ω be constant", "with constant r = a".
bool speaks_of_constant_value(std::string_view words);

/// "Without damping", "neglecting friction".
bool neglects_resistance(std::string_view words);

/// "Neglecting the square of Ω", "if both are small": what follows holds approximately.
bool neglects_terms(std::string_view words);

/// "In the rotating frame": components are along axes of the author's own.
bool speaks_of_turning_axes(std::string_view words);

/// Whether the last word is "when", "if": the formula that follows is a condition.
bool ends_with_condition(std::string_view words);

/// "Without gravity".
bool neglects_gravity(std::string_view words);

/// "Without damping, c = 0": letters that the words set to zero.
std::vector<std::string> letters_that_are_zero(std::string_view words);

/// "The virtual work of the weights": one kind of forces alone.
bool names_part_of_forces(std::string_view words);

/// "if", "at", "for" before a formula: if that describes a state, what follows holds there.
bool begins_condition_of_state(std::string_view words);

/// "in the special case", "for", "if" before a formula: it may be a condition on parameters.
bool speaks_of_special_case(std::string_view words);

/// "at rest", "in equilibrium": the last sentence speaks of states of rest, and not of a start or of a place from
/// which something is measured.
bool speaks_of_rest(std::string_view words);

/// "In equilibrium. We find": any of the sentences speaks of rest, or of steady motion.
bool mentions_rest(std::string_view words);

/// "steady motion", "conical pendulum": the motions of which the last sentence speaks are special ones.
bool speaks_of_special_motion(std::string_view words);
/// The same of all the words, not of the last sentence alone.
bool mentions_special_motion(std::string_view words);

/// "starts from rest": constants of the motion are zero.
bool speaks_of_start_from_rest(std::string_view words);

/// "It is released at θ = α", "initially θ' = β".
bool speaks_of_start(std::string_view words);

/// "The force function is", and not "we do not use the force function": U, of which −U is the potential energy.
bool asserts_force_function(std::string_view words);

/// "The moment of inertia about the hinge is".
bool speaks_of_inertia(std::string_view words);

/// "If the block is clamped", "the cart is held": it does not move in what follows.
bool says_held(std::string_view words);

/// "A particular solution is": of one motion.
bool speaks_of_solution(std::string_view words);

/// "after the impact": what follows holds just after impulses.
bool speaks_of_impact(std::string_view words);

/// "Before the impact", "the blow": the text is about one.
bool mentions_impact(std::string_view words);

bool speaks_of_angular_momentum(std::string_view words);

/// "where", "with", "and": a definition follows what is defined by it.
bool explains(std::string_view words);

/// "The kinetic energy is": T, V or L, of which the formula that comes next is the value; null of other words.
const char* spoken_energy(std::string_view words);

/// "is conserved", "the energy integral": what is said then keeps its value.
bool speaks_of_conservation(std::string_view words);

/// "The velocity of the bob is": it is that of the thing of this name.
bool speaks_of_motion_of(std::string_view words, const std::string& name);

/// "The natural frequency", "mode".
bool speaks_of_frequency(std::string_view words);

/// "The period".
bool speaks_of_period(std::string_view words);

/// "The y axis points downwards": the author has laid axes of his own.
bool speaks_of_axes(std::string_view words);

/// "During the motion", "afterwards": it is no longer at rest, nor just after an impact.
bool speaks_of_motion(std::string_view words);

/// "About the top", "in the mode in which": a state or a mode that only the words name.
bool names_state_or_mode(std::string_view words);

/// "In general", a new heading: values of parameters that were stated before hold no longer.
bool speaks_of_general_case(std::string_view words);

/// "At the lowest point," before a formula: it describes the state there.
bool ends_at_place(std::string_view words);

/// "Set", "put": the formula that comes next is set so, and claims nothing.
bool sets_value(std::string_view words);

/// "constraint", "rolls without slipping".
bool speaks_of_constraint(std::string_view words);

/// "It is not true that": what follows is no claim.
bool denies(std::string_view words);

/// "Not only for r' = 0", "r' = 0 only at the turns": what is said of the condition is not meant of what follows.
bool limits_a_condition(std::string_view before, std::string_view behind);

/// "N = 0 gives cos θ = …": the words behind a formula go on from it as from a condition.
bool sets_a_condition_behind(std::string_view behind);

/// "Does … hold only for small angles?": the words before and behind a formula make a question of its sentence.
bool asks(std::string_view before, std::string_view behind);

}  // namespace alembert
