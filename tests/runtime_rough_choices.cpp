// SPDX-License-Identifier: MIT
// The modes of contacts with dry friction in planes (rough_choice.hpp): what holds by static coefficients, and
// which choices are left, against all choices solved by elimination.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <vector>

#include "alembert/hybrid/friction_modes.hpp"
#include "solved.hpp"

namespace runtime_rough_choices {

using namespace alembert;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

// A block that a force pulls along the floor, at rest: it stays below μₛ N, and the force above starts it with
// (F − μ N)/m. Below, sliding with the kinetic coefficient would be a second solution.
TEST_CASE("rough choices: what rests slides only where its static coefficient does not hold it") {
    const Eigen::MatrixXd none(0, 2);
    for (const double pull : {0.3, 0.7, 0.9, 1.1, 1.5}) {
        const std::vector<FrictionRows> floor{{.normal = Eigen::RowVector2d(0, 1),
                                               .tangent = Eigen::RowVector2d(1, 0),
                                               .coefficient = 0.5,
                                               .resting = 1}};
        const FrictionModes all = consistent_friction_modes(
            2 * Eigen::Matrix2d::Identity(), Eigen::Vector2d(pull, -1), none, Eigen::VectorXd(), floor);
        CAPTURE(pull);
        CHECK(all.is_complete);
        REQUIRE(all.different.size() == 1);
        CHECK(all.different[0].after[0] == doctest::Approx(pull > 1 ? (pull - 0.5) / 2 : 0).epsilon(1e-14));
    }
}

// Of a block on a slope each foot needs |τ| ≤ μₛ π, and the block stays up to tan α = μₛ, if it does not tip over.
// Every choice in which only one foot sticks, and the other one has its kinetic coefficient, gives way before.
TEST_CASE("rough choices: feet of which each sticks at its static bound hold what one alone would not") {
    const double mu = 0.5, resting = 1, b = 1, h = 0.1;
    for (const double slope : {0.4, 0.6, 0.74, 0.76, 0.9, 0.99, 1.01, 1.2}) {
        std::vector<FrictionRows> feet;
        for (const double x : {-b, b})
            feet.push_back({.normal = Eigen::RowVector3d(0, 1, x),
                            .tangent = Eigen::RowVector3d(1, 0, h),
                            .coefficient = mu,
                            .resting = resting});
        const FrictionModes all =
            consistent_friction_modes(MatrixXd(Eigen::Vector3d(1, 1, 2).asDiagonal()),
                                      Eigen::Vector3d(slope, -1, 0), MatrixXd(0, 3), VectorXd(), feet);
        CAPTURE(slope);
        REQUIRE(all.different.size() == 1);
        CHECK(all.different[0].after[0] == doctest::Approx(slope > resting ? slope - mu : 0).epsilon(1e-14));
        CHECK(all.different[0].moves[0] == (slope > resting ? 1 : 0));
    }
}

namespace {

struct Weighed {
    VectorXd after;
    std::array<int, 2> sliding;  ///< the sign of η, 0 where the contact sticks
    std::array<bool, 2> closed;
    bool clear;  ///< no inequality is nearly an equation
};

/// All consistent choices of two contacts by Gaussian elimination of the whole system, each with its conditions;
/// nothing if one has no unique solution.
std::optional<std::vector<Weighed>> weighed(const MatrixXd& M, const VectorXd& f,
                                            const std::vector<FrictionRows>& contacts) {
    const Index n = f.size();
    std::vector<Weighed> result;
    for (int code = 0; code < 16; ++code) {
        const std::array modes{code % 4, code / 4};  // 0 sticks, 1 and 2 slide with η ≥ 0 and η ≤ 0, 3 is open
        MatrixXd K = MatrixXd::Zero(n + 4, n + 4);
        VectorXd right = VectorXd::Zero(n + 4);
        K.topLeftCorner(n, n) = M;
        right.head(n) = f;
        for (std::size_t i = 0; i < 2; ++i) {
            const FrictionRows& c = contacts[i];
            const Index row = n + 2 * static_cast<Index>(i);
            K.col(row).head(n) = -c.normal.transpose();
            K.col(row + 1).head(n) = -c.tangent.transpose();
            if (modes[i] == 3) {
                K(row, row) = K(row + 1, row + 1) = 1;
                continue;
            }
            K.row(row).head(n) = c.normal;
            if (modes[i] == 0) {
                K.row(row + 1).head(n) = c.tangent;
            } else {
                K(row + 1, row + 1) = 1;
                K(row + 1, row) = modes[i] == 1 ? c.coefficient : -c.coefficient;
            }
        }
        const std::optional<MatrixXd> solution = test::solved(K, right);
        if (!solution) return std::nullopt;
        const VectorXd x = *solution;
        Weighed one{.after = x.head(n), .sliding = {0, 0}, .closed = {false, false}, .clear = true};
        bool holds = true;
        const auto need = [&](double value) {
            holds = holds && value > 0;
            one.clear = one.clear && std::abs(value) > 1e-6;
        };
        for (std::size_t i = 0; i < 2; ++i) {
            const FrictionRows& c = contacts[i];
            const double pi = x[n + 2 * static_cast<Index>(i)], tau = x[n + 2 * static_cast<Index>(i) + 1];
            if (modes[i] == 3) {
                need(c.normal.dot(one.after));
                continue;
            }
            one.closed[i] = true;
            need(pi);
            if (modes[i] == 0) {
                need(c.resting * pi - std::abs(tau));
                continue;
            }
            one.sliding[i] = modes[i] == 1 ? 1 : -1;
            need(one.sliding[i] * c.tangent.dot(one.after));
        }
        if (!one.clear) return std::nullopt;
        if (holds) result.push_back(one);
    }
    return result;
}

}  // namespace

// Found among random systems in exact arithmetic: a contact that slides in the only choice that counts would be
// within its static bound if the other one kept its mode, but then that mode would not be consistent.
TEST_CASE("rough choices: a choice is given up only for one that is consistent as a whole") {
    struct Case {
        MatrixXd M;
        VectorXd f;
        RowVectorXd g0, w0, g1, w1;
        std::array<double, 4> coefficients;
        VectorXd after;
    };
    const std::vector<Case> cases{
        {MatrixXd{{1, -2, 0, -1}, {-2, 8, 2, 4}, {0, 2, 2, 0}, {-1, 4, 0, 12}},
         VectorXd{{2, 1, 3, -5}},
         RowVectorXd{{-1, 0, 1, 0}},
         RowVectorXd{{1, -1, -1, 0}},
         RowVectorXd{{-1, -2, -1, -1}},
         RowVectorXd{{1, 0, -1, 2}},
         {0.2, 0.5, 0.1, 0.7},
         VectorXd{{-56.0 / 505, -569.0 / 2020, 1101.0 / 1010, -42.0 / 101}}},
        {MatrixXd{{1, -2, 1, -2}, {-2, 8, -2, 8}, {1, -2, 10, -8}, {-2, 8, -8, 16}},
         VectorXd{{4, 2, -2, -5}},
         RowVectorXd{{-2, -1, 0, 1}},
         RowVectorXd{{-2, 2, 0, -1}},
         RowVectorXd{{-2, -2, 2, 1}},
         RowVectorXd{{-2, -2, 0, 1}},
         {0.1, 0.2, 0.1, 0.7},
         VectorXd{{-14.0 / 137, 0, 0, -28.0 / 137}}},
        {MatrixXd{{1, -1, 2, -1}, {-1, 10, -8, -5}, {2, -8, 17, -1}, {-1, -5, -1, 15}},
         VectorXd{{-4, 3, -5, -5}},
         RowVectorXd{{1, 0, 2, 1}},
         RowVectorXd{{-2, 1, -1, 1}},
         RowVectorXd{{2, -2, -1, -2}},
         RowVectorXd{{0, 1, 0, 2}},
         {0.2, 0.8, 0.3, 0.7},
         VectorXd{{6382.0 / 134867, 20479.0 / 134867, 15430.0 / 404601, -50006.0 / 404601}}}};
    for (const Case& one : cases) {
        const std::vector<FrictionRows> rows{{.normal = one.g0,
                                              .tangent = one.w0,
                                              .coefficient = one.coefficients[0],
                                              .resting = one.coefficients[1]},
                                             {.normal = one.g1,
                                              .tangent = one.w1,
                                              .coefficient = one.coefficients[2],
                                              .resting = one.coefficients[3]}};
        const FrictionModes all = consistent_friction_modes(one.M, one.f, MatrixXd(0, 4), VectorXd(), rows);
        REQUIRE(all.different.size() == 1);
        CHECK((all.different[0].after - one.after).norm() < 1e-13);
    }
}

TEST_CASE("rough choices: with static coefficients the choices are those that no consistent one holds more of") {
    std::mt19937 random(19);
    std::uniform_int_distribution<int> entry(-2, 2), load(-5, 5), tenth(1, 6);
    std::map<std::size_t, int> counts;
    int judged = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        MatrixXd L = MatrixXd::Identity(4, 4);
        for (Index r = 0; r < 4; ++r)
            for (Index c = 0; c < r; ++c) L(r, c) = entry(random);
        const MatrixXd M = L * L.transpose();
        VectorXd f(4);
        for (double& x : f) x = load(random);
        std::vector<FrictionRows> rows;
        for (int i = 0; i < 2; ++i) {
            FrictionRows row{.normal = RowVectorXd(4), .tangent = RowVectorXd(4)};
            for (double& x : row.normal) x = entry(random);
            for (double& x : row.tangent) x = entry(random);
            row.coefficient = 0.3 * tenth(random);
            row.resting = row.coefficient + 0.1 * tenth(random);
            rows.push_back(row);
        }
        const std::optional<std::vector<Weighed>> consistent = weighed(M, f, rows);
        if (!consistent) continue;
        std::vector<VectorXd> kept;
        for (const Weighed& one : *consistent) {
            const bool beaten = std::any_of(consistent->begin(), consistent->end(), [&](const Weighed& other) {
                bool more = false;
                for (std::size_t i = 0; i < 2; ++i) {
                    const bool sticks = one.closed[i] && one.sliding[i] == 0,
                               would = other.closed[i] && other.sliding[i] == 0;
                    if (sticks && !would) return false;
                    more = more || (one.sliding[i] != 0 && would);
                }
                return more;
            });
            if (!beaten) kept.push_back(one.after);
        }
        const FrictionModes all = consistent_friction_modes(M, f, MatrixXd(0, 4), VectorXd(), rows);
        CAPTURE(trial);
        ++judged;
        ++counts[kept.size()];
        REQUIRE(all.different.size() == kept.size());
        for (const VectorXd& after : kept)
            CHECK(std::any_of(all.different.begin(), all.different.end(), [&](const FrictionMode& one) {
                return (one.after - after).norm() < 1e-9 * (1 + after.norm());
            }));
    }
    CHECK(judged > 1000);
    for (const std::size_t count : {1, 2}) CHECK(counts[count] > 0);
}

}  // namespace runtime_rough_choices
