// SPDX-License-Identifier: MIT
#pragma once

/// Rates after an impact: impulses, constraints that the rates before may break, and contacts that bounce.
///
///     // a ball of mass 2 falls on the floor at 3 m/s; gap' = v, e = 1/2
///     ImpactResult hit = strike({{2.0}}, before, impulse, no_rows, no_drift, {{1.0}}, drift, restitution);
///     hit.after[0];       // 1.5
///     hit.contact[0];     // 9 = 2·(1.5 + 3)
///
/// With n coordinates, m bilateral rows A q' + b = 0 and k closed contacts gap' = G q' + c:
///
///     M (q'⁺ − q'⁻) = Q̂ + AᵀΛ + GᵀΠ,     A q'⁺ + b = 0,     Π ≥ 0  ⊥  gap'⁺ + e gap'⁻ ≥ 0
///
/// (Zhang & Qin, Advanced Dynamics, the impulse equations of ch. 1; Newton's law of restitution with
/// complementarity: Moreau 1988; Glocker, Set-Valued Force Laws (2001), on impacts.) In the same instant, one
/// after the other: 1. A constraint that q'⁻ breaks is imposed, plastically: the nearest rates in the metric of M
/// that obey it. What is lost is the kinetic energy of the lost velocities (Carnot). 2. The impulses act, and
/// every contact that approaches or rests resists them by the law above. Of all rates that the law allows they are
/// the nearest to those that the impulses alone would give, so they are the only ones. e belongs to the approach
/// before: an impulse that presses a resting contact finds it hard, not elastic. 3. A contact that was opening
/// takes no part in 2. If it is thrown back, it has a collision of its own by the same law; and so on.
/// `collisions` counts 2 and these. Approaches below 1e-9 of what the rates allow end without a rebound, and so
/// does whatever still rebounds after 1000 rounds: an elastic ball between two walls that both touch it.
///
/// Impulses do the work ½ Q̂·(rates before 2 + rates after 2), moving constraints and floors −b·Λ − c·Π. Then
/// loss = T⁻ − T⁺ + these works = Σ ½ (1 − e) Π |gap'⁻| + Carnot's part ≥ 0, whatever the e.
/// Redundant rows are allowed; their impulses are the least ones where these are not negative.

#include <Eigen/Dense>
#include <string>
#include <vector>

namespace alembert {

struct ImpactResult {
    std::string failure;             ///< empty, or why there are no rates after; then the rest is empty
    Eigen::VectorXd after;           ///< n, q'⁺
    Eigen::VectorXd bilateral;       ///< m, Λ
    Eigen::VectorXd contact;         ///< k, Π ≥ 0
    std::vector<bool> stays_closed;  ///< k, gap'⁺ is zero to rounding
    int collisions = 0;              ///< 0 where there are no contacts
    double work = 0;                 ///< of the impulses
    double loss = 0;                 ///< of energy, in constraints and contacts; never negative
    explicit operator bool() const { return failure.empty(); }
};

/// `mass` is n × n and positive definite, at least on the rates that the bilateral rows leave free; rows are m × n
/// and k × n, `restitution` 0 to 1. Only closed contacts (gap = 0) belong in here. Contradictory conditions, a
/// singular mass matrix and values that are not finite come back as `failure`; sizes that do not fit are a mistake
/// of the caller.
ImpactResult strike(const Eigen::MatrixXd& mass, const Eigen::VectorXd& before, const Eigen::VectorXd& impulse,
                    const Eigen::MatrixXd& bilateral_rows, const Eigen::VectorXd& bilateral_drift,
                    const Eigen::MatrixXd& contact_rows, const Eigen::VectorXd& contact_drift,
                    const Eigen::VectorXd& restitution);

/// Accelerations: the same without a before. M a = F + AᵀΛ + GᵀΠ, A a + b = 0, Π ≥ 0 ⊥ G a + c ≥ 0; `after` is a.
/// All contacts take part, whatever c says.
ImpactResult press(const Eigen::MatrixXd& mass, const Eigen::VectorXd& force,
                   const Eigen::MatrixXd& bilateral_rows, const Eigen::VectorXd& bilateral_drift,
                   const Eigen::MatrixXd& contact_rows, const Eigen::VectorXd& contact_drift);

}  // namespace alembert
