// SPDX-License-Identifier: MIT
#pragma once

/// What contacts do between two smooth phases of a motion: strike, come to rest, let go.
///
///     std::vector<double> state = …;                       // where a gap has just closed
///     const Settled next = settle(contacts, {.t = t, .tolerance = 1e-9, .touched = {0}}, state);
///     next.closed;                                         // constraints of the phase that follows
///
/// In this order:
///  - positions move to where the gaps of contacts that touch are zero (the least change in the metric of M);
///  - impulses act, and what closes with a speed is struck (impact.hpp: Newton's law; all closed contacts take
///    part);
///  - what bounces too low is laid down: where the bounces still to come displace no coordinate by more than
///    tolerance · max(1, |q|). With speed v after the impact and gap'' = −a they take (2v/a)/(1 − e) in all, a
///    geometric sum: this is the time told for `rest`. The speed is taken away along M⁻¹Gᵀ at once, which leaves
///    the momenta that the bounces would leave: they add Π = v (1 + e)/(1 − e)/(G M⁻¹Gᵀ) in that time, and the
///    contact at rest adds 2v/(1 − e)/(G M⁻¹Gᵀ), more by what is taken;
///  - the contacts that last are those of contact.hpp; one whose reaction has come down to zero is let go if that
///    is consistent.

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "alembert/contact.hpp"
#include "alembert/kick.hpp"

namespace alembert {

struct Contacts {
    std::vector<std::string> names = {};
    std::vector<double> restitution = {};
    std::function<Situation(double t, const double* state)> situation = {};
    /// Called where rates jump; `work` is that of the impulses, Σ Π·(mean rate of their points). May be empty.
    std::function<void(double t, const double* before, const double* after, double work)> on_jump = {};
    Kicks kicks = {};  ///< of events beside the contacts
};

/// Is k one of them?
inline bool contains(const std::vector<int>& list, int k) {
    return std::find(list.begin(), list.end(), k) != list.end();
}

struct ContactEvent {
    enum class Kind {
        impact,
        release,  ///< a lasting contact ends
        rest      ///< one begins, perhaps after infinitely many impacts
    };
    Kind kind = Kind::impact;
    int contact = 0;
    double time = 0;
    double speed_before = 0, speed_after = 0;  ///< of the gap
    double energy_loss = 0;                    ///< T before − T after; for `rest` of the impacts left out
    double impulse = 0;                        ///< Π of M (q'⁺ − q'⁻) = … + GᵀΠ
};

/// Where the last phase has ended, and why.
struct PhaseEnd {
    double t = 0;
    double tolerance = 1e-9;
    std::vector<int> closed = {}, resting = {};  ///< until now (contact.hpp: Lasting)
    std::vector<int> touched = {};               ///< gaps that have just closed
    std::optional<int> released = {};            ///< a closed contact whose reaction has come down to zero
    Eigen::VectorXd impulse = {};                ///< generalized; empty: none
};

struct Settled {
    std::string failure;  ///< empty, or why no contact mode is consistent, with the names of the contacts
    std::vector<int> closed, resting;
    std::vector<ContactEvent> events;
    Eigen::VectorXd struck;        ///< q' after the impulses and impacts, before anything is laid down
    Eigen::VectorXd acceleration;  ///< of what follows
};

/// Moves `state` (q, q', and what there is beyond, which stays).
Settled settle(const Contacts& contacts, const PhaseEnd& instant, std::vector<double>& state);

}  // namespace alembert
