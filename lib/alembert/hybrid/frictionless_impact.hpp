// SPDX-License-Identifier: MIT
#pragma once

/// Rates after an impact. It may come from impulses, from constraints that the rates before break, and from
/// contacts that bounce.
///
///     // a ball of mass 2 falls on the floor at 3 m/s; gap' = v, e = 1/2
///     auto hit = strike({{2.0}}, before, impulse, {no_rows, no_offset}, {{{1.0}}, offset}, restitution);
///     hit.after[0];       // 1.5
///     hit.contact[0];     // 9 = 2·(1.5 + 3)
///
/// With n coordinates, m bilateral rows A q' + b = 0 and k closed contacts gap' = G q' + c:
///
///     M (q'⁺ − q'⁻) = Q̂ + AᵀΛ + GᵀΠ,     A q'⁺ + b = 0,     Π ≥ 0  ⊥  gap'⁺ + e gap'⁻ ≥ 0
///
/// (Zhang & Qin, Advanced Dynamics, the impulse equations of ch. 1; Newton's law of restitution with
/// complementarity: Moreau 1988; Glocker, Set-Valued Force Laws (2001), on impacts.) Three things happen in the
/// same instant, one after the other: 1. A constraint that q'⁻ breaks is imposed plastically: the new rates are
/// those that obey it and are nearest in the metric of M. The energy lost is the kinetic energy of the lost
/// velocities (Carnot). 2. The impulses act, and every contact that approaches or rests resists them by the law
/// above. The new rates are, of all that the law allows, the nearest to those that the impulses alone would give,
/// and therefore unique. e applies to the velocity of approach before the impact: a resting contact that an
/// impulse presses does not rebound. 3. A contact that was opening takes no part in 2. If it is thrown back, it
/// has a collision of its own by the same law; and so on. `collisions` counts 2 and these. Approaches below 1e-9
/// of what the rates allow end without a rebound, and so do contacts that still rebound after 1000 rounds, such as
/// those of an elastic ball between two walls that both touch it.
///
/// Impulses do the work ½ Q̂·(rates before 2 + rates after 2), moving constraints and floors −b·Λ − c·Π. Then loss
/// = T⁻ − T⁺ + these works = Σ ½ (1 − e) Π |gap'⁻| + Carnot's part ≥ 0, for any e. Redundant rows are allowed;
/// their impulses are those of least norm, if these are not negative.

#include <Eigen/Dense>
#include <string>
#include <vector>

namespace alembert {

/// Some of the rows A q' + b, or G q' + c.
struct RateRows {
    Eigen::MatrixXd rows;
    Eigen::VectorXd offset;
};

struct FrictionlessImpact {
    std::string failure;  ///< if not empty, the reason why there are no rates after the impact; the other members
                          ///< are then empty
    Eigen::VectorXd after;           ///< n, q'⁺
    Eigen::VectorXd bilateral;       ///< m, Λ
    Eigen::VectorXd contact;         ///< k, Π ≥ 0
    std::vector<bool> stays_closed;  ///< k, whether gap'⁺ is zero to rounding
    int collisions = 0;              ///< 0 if there are no contacts
    double work = 0;                 ///< the work of the impulses
    double loss = 0;                 ///< the energy lost in constraints and contacts; never negative
    explicit operator bool() const { return failure.empty(); }
};

/// `mass` is n × n and positive definite, at least on the rates that the bilateral rows leave free; rows are m × n
/// and k × n, `restitution` 0 to 1. Pass only closed contacts (gap = 0). Contradictory conditions, a singular mass
/// matrix and values that are not finite come back as `failure`; the caller must see to it that the sizes fit.
FrictionlessImpact strike(const Eigen::MatrixXd& mass, const Eigen::VectorXd& before,
                          const Eigen::VectorXd& impulse, const RateRows& bilateral, const RateRows& contacts,
                          const Eigen::VectorXd& restitution);

/// The same law for accelerations, which have no values before: M a = F + AᵀΛ + GᵀΠ, A a + b = 0, Π ≥ 0 ⊥ G a + c
/// ≥ 0; `after` is a. All contacts take part, whatever the sign of c.
FrictionlessImpact press(const Eigen::MatrixXd& mass, const Eigen::VectorXd& force, const RateRows& bilateral,
                         const RateRows& contacts);

}  // namespace alembert
