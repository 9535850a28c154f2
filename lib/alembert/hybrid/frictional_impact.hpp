// SPDX-License-Identifier: MIT
#pragma once

/// The impact of contacts of which at least one has dry friction.
///
/// Contacts that do not feel each other (the feet of two bodies) are struck each by itself. A contact that strikes
/// alone follows the impulse through its impact (routh_impact.hpp), if no other contact is pressed by that: the
/// corner on which a block has stood lifts off when the other one strikes. Otherwise all contacts that feel each
/// other are struck together by Moreau's law: a contact that has borne an impulse parts with e times its speed
/// before, and sticks, or slides against its friction; the result must not gain energy, and must be the only one.
/// Along lines that is proved for up to five contacts by trying all choices (friction_modes.hpp); otherwise a
/// second result is looked for once, from other impulses (contact_cone.hpp).

#include "alembert/hybrid/contact_transition.hpp"

namespace alembert {

struct FrictionalImpact {
    std::string failure;  ///< if not empty, the reason why there are no rates after the impact; the other members
                          ///< are then empty
    Eigen::VectorXd after;
    double work = 0;                        ///< of all impulses along the rates, without the offsets
    std::vector<ContactEvent> events = {};  ///< impacts, without their time
    explicit operator bool() const { return failure.empty(); }
};

/// `near` are the contacts with gap 0; `kick` is a generalized impulse that acts at the same instant, or empty.
FrictionalImpact strike_rough_contacts(const Situation& here, const Eigen::VectorXd& before,
                                       const std::vector<int>& near, const std::vector<double>& restitution,
                                       const Eigen::VectorXd& kick);

}  // namespace alembert
