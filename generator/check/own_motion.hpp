// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The scene's own motion in floating point: its initial state, assembled, with the accelerations and multipliers
/// that its equations give there, and states that follow. What is proved must hold there too.
///
///     OwnMotion own(claims, equations);
///     if (own.fails(residual, positive)) …      // it is not proved, whatever was found elsewhere

#include <optional>
#include <vector>

#include "check/claims.hpp"
#include "check/counterexample.hpp"
#include "program/lower/start.hpp"

namespace alembert {

class OwnMotion {
public:
    /// The arguments must outlive it.
    OwnMotion(const Claims& claims, const Equations& equations) : claims_(claims), e_(equations) {}

    /// Is `value` (of coordinates, rates, accelerations and multipliers) positive at the initial state? False also
    /// if that cannot be decided.
    bool is_positive_at_start(const GiNaC::ex& value);
    /// The same of zero, to what positions are assembled to.
    bool is_zero_at_start(const GiNaC::ex& value);

    /// The first state of the motion at which `residual` is surely not zero though all of `positive` are positive,
    /// and whether it is the initial one. Nothing if there is none, or where there are no values.
    struct Failure {
        Counterexample state;
        bool at_start = true;
    };
    std::optional<Failure> fails(const GiNaC::ex& residual, const std::vector<GiNaC::ex>& positive);
    /// The same for the initial state alone, of a claim about states of rest: nothing if the scene moves there.
    std::optional<Counterexample> fails_at_rest(const GiNaC::ex& residual);

private:
    /// Those that have what the value depends on: all, or the initial state alone where there are no
    /// accelerations.
    const std::vector<State<double>>& states_for(const std::vector<GiNaC::ex>& values);
    std::optional<double> at_start(const GiNaC::ex& value);
    void make();
    void follow(Start start, const Program& constraints);
    std::optional<Failure> failure(const GiNaC::ex& residual, const std::vector<GiNaC::ex>& positive,
                                   const std::vector<State<double>>& states) const;
    void complete(State<double>& state) const;

    const Claims& claims_;
    const Equations& e_;
    bool is_made_ = false;
    std::vector<State<double>> start_, motion_;  ///< without accelerations, and with them; empty: there are none
};

}  // namespace alembert
