// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A mechanism with some of its unilateral contacts closed, and the values that contacts need at one state.
///
///     // the gap of contact 0 is a holonomic constraint now
///     const Mechanism lying = with_closed(mechanism, {0});
///     const ContactView view(mechanism);
///     const Situation here = view.at(state);                    // alembert/hybrid/lasting_contacts.hpp
///     const LastingContacts mode = contacts_at_rest(view, state, 1e-9); // what eval shows
///
/// `with_closed` makes each contact mode an ordinary mechanism, which is derived, lowered and emitted in the same
/// way as any other.

#include <vector>

#include "alembert/hybrid/lasting_contacts.hpp"
#include "model/mechanism.hpp"
#include "program/interpret.hpp"
#include "program/named_function.hpp"

namespace alembert {

/// The mechanism in which the gaps of these contacts are constraints, after the scene's own, in ascending order.
Mechanism with_closed(Mechanism mechanism, const std::vector<int>& closed);

/// The mechanism with all contacts closed.
Mechanism with_all_closed(const Mechanism& mechanism);

/// Adds an event for each contact, after the scene's own: its multiplier if it is closed, its gap if it is open.
Mechanism with_contacts_watched(Mechanism mechanism, const std::vector<int>& closed);

/// The mechanism in which no contact closes by itself: each is a force along its gap whose size is a parameter,
/// with the name of its multiplier, after all others. Its value is 0.
Mechanism with_contact_forces(Mechanism mechanism);

/// The function contacts_at, with a row for each contact: gap, gap', δ of gap'' = G q'' − δ, restitution, and G.
FunctionProgram contact_function(const Mechanism& mechanism);

/// Evaluates mass matrix, forcing, constraint rows and gaps by interpretation. It is used at the end of a phase,
/// not in each step.
class ContactView {
public:
    explicit ContactView(const Mechanism& mechanism);
    Situation at(const State<double>& state) const;
    const std::vector<std::string>& names() const { return names_; }

private:
    Program program_;
    int n_, bilateral_;
    struct ContactOfFriction {
        int contact;             ///< −1 for a friction that is not at a contact
        std::size_t components;  ///< of its sliding velocity
    };
    static std::vector<ContactOfFriction> contacts_of_frictions(const Mechanism& mechanism);
    std::vector<ContactOfFriction> rough_;  ///< for each friction
    std::vector<std::string> names_;
};

/// The restitutions at these values of the independent parameters.
std::vector<double> restitutions(const Mechanism& mechanism, const std::vector<double>& parameters);

/// The gaps that are negative by more than `tolerance` · max(1, |q|), with their places and values.
std::vector<Diagnostic> negative_gaps(const Mechanism& mechanism, const ContactView& view,
                                      const State<double>& state, double tolerance);

/// Throws SceneError if there are any.
void check_gaps(const Scene& scene, const Mechanism& mechanism, const ContactView& view,
                const State<double>& state, double tolerance);

/// The contacts that are closed and stay closed at this state. Throws IntegrationError if no choice is consistent.
LastingContacts contacts_at_rest(const ContactView& view, const State<double>& state, double tolerance);

/// The names, in the order of the scene, of contacts in `lasting.closed` that touch without a force. On one side
/// of the state they open and on the other they press, so that they do not act as constraints near it.
std::vector<std::string> touching_without_force(const ContactView& view, const State<double>& state,
                                                const LastingContacts& lasting);

}  // namespace alembert
