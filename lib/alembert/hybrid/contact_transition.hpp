// SPDX-License-Identifier: MIT
#pragma once

/// What happens at contacts between two smooth phases of a motion: they are struck, come to rest or open.
///
///     std::vector<double> state = …;                       // where a gap has just closed
///     const ContactTransition next = settle(contacts, {.t = t, .tolerance = 1e-9, .touched = {0}}, state);
///     next.closed;                                         // constraints of the phase that follows
///
/// The following happens in this order:
///  - Positions are moved so that the gaps of contacts that touch are zero (by the least change in the
///    metric of M).
///  - Impulses act, and every gap that closes with a speed has an impact (frictionless_impact.hpp: Newton's law;
///    all closed contacts take part).
///  - A contact whose bounces have become too low is brought to rest. That is so where the bounces still to come
///    displace no coordinate by more than tolerance · max(1, |q|). With speed v after the impact and gap'' = −a
///    they take the time (2v/a)/(1 − e) in all, a geometric sum; this is the time reported for `rest`. The speed
///    is removed along M⁻¹Gᵀ at once, which gives the momenta that the bounces would give: they add Π = v (1 +
///    e)/(1 − e)/(G M⁻¹Gᵀ) in that time, and the contact at rest adds 2v/(1 − e)/(G M⁻¹Gᵀ); the difference is what
///    is removed.
///  - lasting_contacts.hpp determines which contacts stay closed. A contact whose reaction has fallen to zero
///    opens if that is consistent.

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "alembert/hybrid/impulsive_events.hpp"
#include "alembert/hybrid/lasting_contacts.hpp"

namespace alembert {

struct Contacts {
    std::vector<std::string> names = {};
    std::vector<double> restitution = {};
    std::function<Situation(double t, const double* state)> situation = {};
    /// Called where rates jump; `work` is that of the impulses, Σ Π·(mean rate of their points). May be empty.
    std::function<void(double t, const double* before, const double* after, double work)> on_jump = {};
    ImpulsiveEvents kicks = {};  ///< the kicks of the scene's events
};

/// Is k one of them?
inline bool contains(const std::vector<int>& list, int k) {
    return std::find(list.begin(), list.end(), k) != list.end();
}

struct ContactEvent {
    enum class Kind {
        impact,
        release,  ///< a closed contact opens
        rest      ///< a contact stays closed from now on, perhaps after infinitely many impacts
    };
    Kind kind = Kind::impact;
    int contact = 0;
    double time = 0;
    double speed_before = 0, speed_after = 0;  ///< the rate of the gap
    double energy_loss = 0;  ///< T before − T after; for `rest`, in the impacts that are left out
    double impulse = 0;      ///< Π of M (q'⁺ − q'⁻) = … + GᵀΠ
};

/// The instant at which the last phase has ended, and why.
struct PhaseEnd {
    double t = 0;
    double tolerance = 1e-9;
    std::vector<int> closed = {},
                     resting = {};     ///< the contacts until now (lasting_contacts.hpp: LastingContacts)
    std::vector<int> touched = {};     ///< gaps that have just closed
    std::optional<int> released = {};  ///< a closed contact whose reaction has come down to zero
    Eigen::VectorXd impulse = {};      ///< the generalized impulse of kicks; empty if there is none
};

struct ContactTransition {
    std::string
        failure;  ///< if not empty, the reason why no contact mode is consistent, with the names of the contacts
    std::vector<int> closed, resting;
    std::vector<ContactEvent> events;
    Eigen::VectorXd struck;        ///< q' after the impulses and impacts, before any contact is brought to rest
    Eigen::VectorXd acceleration;  ///< q'' at the start of the phase that follows
};

/// Moves `state`, which holds q, q' and perhaps more; what follows q' is not changed.
ContactTransition settle(const Contacts& contacts, const PhaseEnd& instant, std::vector<double>& state);

}  // namespace alembert
