// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Checks a hand derivation.
///
///     const CheckedScene result = check(scene);                // the claims of the scene
///     result.checked.claims[0].verdict == Verdict::proved
///
/// A claim is an equation in the names that the scene declares. It is right if it holds at every state that obeys
/// the constraints and their derivatives, with the accelerations and multipliers that the equations give there; so
/// multiples, combinations and rewritings with the constraints are right in any form. This is decided by exact
/// evaluation modulo 2⁶¹ − 1 at random such states (analysis/exact/motions.hpp), until the probability of an error
/// is below 2⁻⁶⁰. If the normal form of claim − Σ c_i · equation_i is zero, that is a proof by itself.
///
///  - unknowns are functions of the state that the author leaves open. Claims are linear in them: B(state) μ =
///    d(state) must be solvable at every state. A claim whose row does not follow from the rows of the others is
///    vacuous: some unknown can be chosen so that it holds.
///  - constants of the motion: F(state, c) = 0 and, c being constant, its time derivatives, as a linear system for
///    c.
///  - kinematic: claims that need no equation of motion are told so; a scene without masses has no others.
///  - at a solution: put into the equations, a motion in closed form must satisfy them (solution.hpp).
///  - near a point: to first order (first_order.hpp).
///  - at rest: at states with q' = q'' = 0 that the equations allow.
///
/// A false claim gets a state at which it fails, in exact numbers (analysis/exact/real_state.hpp).

#include <memory>
#include <string>
#include <vector>

#include "analysis/derive/derived.hpp"
#include "check/verdict.hpp"

namespace alembert {

struct Checked {
    std::vector<CheckedClaim> claims;  ///< in the order of Scene::claims
    bool complete = false;  ///< whether the proved claims, with the constraints, determine every acceleration
    int missing = 0;  ///< how many equations of motion are still missing, of `freedom`; 0 too if that is unknown
    int freedom = 0;
    bool has_states = false;          ///< whether the scene has first-order states, whose rates it gives
    bool is_of_states_alone = false;  ///< and no coordinates
};

/// Judges any number of claims about one scene. Its equations are derived once, and the exact states at which
/// claims are compared with them are found once.
///
///     Checker checker(derived(scene, {.on_sheets = true}));
///     checker.check(with_claims(scene, "m*x'' + k*x = 0", "line 1"));
///     checker.check(with_claims(scene, "m*x'' - k*x = 0", "line 2"));
class Checker {
public:
    /// `derived.by`: the formalism whose intermediate symbols and speeds claims may hold, z1 and u1; empty: the
    /// one that `derive` would choose.
    explicit Checker(const Derived& derived);
    /// The same, of a scene whose equations are not known.
    explicit Checker(Prepared prepared, const std::string& by = {});
    Checker(Checker&&) noexcept;
    ~Checker();

    /// Judges the claims of `scene`, which is the same scene but for its claims. They are judged together: what
    /// they leave open has the same name in all of them. Throws SceneError for a claim that the mechanism cannot
    /// read.
    Checked check(const Scene& scene);

private:
    class Modes;
    std::unique_ptr<Modes> modes_;
};

/// The claims of `scene` alone. `sheets`: those on which the mechanism was built, if it was. Throws what Checker
/// throws.
Checked check(const Scene& scene, const Mechanism& mechanism, const std::shared_ptr<RootSheets>& sheets = {},
              const std::string& by = {});

/// The result of the verb: the claims of the scene, compared with equations derived by the named formalism, or by
/// the one that a teacher would choose. Throws ModelError if there are no claims.
struct CheckedScene : Derived {
    Checked checked = {};
};
CheckedScene check(Scene scene, const std::string& by = {});

}  // namespace alembert
