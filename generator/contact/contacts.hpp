// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A mechanism with some of its unilateral contacts closed, and what contacts need to know at one state.
///
///     // the gap of contact 0 is a holonomic constraint now
///     const Mechanism lying = with_closed(mechanism, {0});
///     const ContactView view(mechanism);
///     const Situation here = view.at(state);                    // alembert/contact.hpp
///     const Lasting mode = contacts_at_rest(view, state, 1e-9); // what eval shows
///
/// `with_closed` is what makes each mode a mechanism like any other: derived, lowered and emitted the same way.

#include <vector>

#include "alembert/contact.hpp"
#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// The gaps of these contacts become constraints, after the scene's own, in ascending order.
Mechanism with_closed(Mechanism mechanism, const std::vector<int>& closed);

/// All contacts closed.
Mechanism with_all_closed(const Mechanism& mechanism);

/// An event for each contact, after the scene's own: the multiplier where it is closed, the gap where it is open.
Mechanism with_contacts_watched(Mechanism mechanism, const std::vector<int>& closed);

/// Mass matrix, forcing, constraint rows and gaps, by interpretation: asked for where a phase ends, not in each
/// step.
class ContactView {
public:
    explicit ContactView(const Mechanism& mechanism);
    Situation at(const State<double>& state) const;
    const std::vector<std::string>& names() const { return names_; }

private:
    Program program_;
    int n_, bilateral_;
    std::vector<int> rough_;  ///< of each friction: its contact, or −1
    std::vector<std::string> names_;
};

/// Restitutions at these values of the independent parameters.
std::vector<double> restitutions(const Mechanism& mechanism, const std::vector<double>& parameters);

/// Throws SceneError for a gap that is negative by more than `tolerance` · max(1, |q|), with its place and how
/// deep.
void check_gaps(const Scene& scene, const Mechanism& mechanism, const ContactView& view,
                const State<double>& state, double tolerance);

/// The contacts that are closed and last at this state. Throws IntegrationError where no choice is consistent.
Lasting contacts_at_rest(const ContactView& view, const State<double>& state, double tolerance);

/// Contacts in `lasting.closed` that touch without a force: on one side of the state they open, on the other they
/// press, so that the motion near it is not that of a constraint. Names, in the order of the scene.
std::vector<std::string> touching_without_force(const ContactView& view, const State<double>& state,
                                                const Lasting& lasting);

}  // namespace alembert
