// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Inverse dynamics in the scene's generalized speeds. With u' = W q'' + w and the constraints that the speeds
/// eliminate, q'' = H u' + h, and loads of the same power along speeds and coordinates, Q·u = τ·q', are Q = Hᵀ τ
/// and τ = Wᵀ Q (Kane & Levinson, Dynamics: Theory and Applications (1985), §2.14, §4.6).

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "program/lower/start.hpp"
#include "scene/scene.hpp"

namespace alembert {

struct SpeedsAt {
    Eigen::VectorXd value, rest;  ///< u; w
    Eigen::MatrixXd W, H;         ///< H has no columns where the speeds do not determine the accelerations
    Eigen::VectorXd h;
    std::vector<Eigen::Index> kept;  ///< positions of the constraints that the speeds do not eliminate
    bool determine() const { return H.cols() > 0; }
};

/// At a state that obeys the constraints; A and γ are those of A q'' = γ for all constraints.
SpeedsAt speeds_at(const Mechanism& mechanism, const State<double>& state, const Eigen::MatrixXd& A,
                   const Eigen::VectorXd& gamma);

/// The rates of speeds among the values of `--at`, "v'=2", by speed; nothing where none is given. They are taken
/// out of `at`. Throws std::invalid_argument for a value that is not finite.
std::vector<std::optional<double>> take_speed_rates(Overrides& at, const Scene& scene);

}  // namespace alembert
