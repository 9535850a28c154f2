// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "alembert/hybrid/frictionless_impact.hpp"

namespace runtime_impact {

using namespace alembert;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

VectorXd vector(std::initializer_list<double> values) {
    VectorXd result(static_cast<Eigen::Index>(values.size()));
    std::copy(values.begin(), values.end(), result.data());
    return result;
}

VectorXd zeros(Eigen::Index n) {
    return VectorXd::Zero(n);
}

MatrixXd rows(std::initializer_list<std::initializer_list<double>> list) {
    MatrixXd result(static_cast<Eigen::Index>(list.size()), static_cast<Eigen::Index>(list.begin()->size()));
    Eigen::Index i = 0;
    for (const auto& row : list) result.row(i++) = vector(row).transpose();
    return result;
}

MatrixXd none(Eigen::Index n) {
    return MatrixXd(0, n);
}

/// Contacts alone, one restitution.
FrictionlessImpact bounce(const MatrixXd& M, const VectorXd& before, const MatrixXd& G, double e) {
    return strike(M, before, zeros(before.size()), {none(before.size()), zeros(0)}, {G, zeros(G.rows())},
                  VectorXd::Constant(G.rows(), e));
}

double energy(const MatrixXd& M, const VectorXd& v) {
    return v.dot(M * v) / 2;
}

bool near(const VectorXd& a, const VectorXd& b, double tolerance = 1e-13) {
    return (a - b).norm() <= tolerance * (1 + b.norm());
}

}  // namespace

TEST_CASE("impact: a ball leaves the floor with e times the speed, and the floor gives (1 + e) m v") {
    for (const double e : {0.0, 0.25, 1.0}) {
        const FrictionlessImpact hit = bounce(rows({{2}}), vector({-3}), rows({{1}}), e);
        REQUIRE(hit);
        CHECK(near(hit.after, vector({3 * e})));
        CHECK(near(hit.contact, vector({2 * 3 * (1 + e)})));
        CHECK(hit.stays_closed[0] == (e == 0));
        CHECK(hit.collisions == 1);
    }
    const FrictionlessImpact opening = bounce(rows({{2}}), vector({3}), rows({{1}}), 0.5);
    CHECK(near(opening.after, vector({3})));
    CHECK(opening.contact[0] == 0);
    CHECK_FALSE(opening.stays_closed[0]);
}

// A moving floor: the speed is relative to it. Floor upwards at 2: gap' = v − 2.
TEST_CASE("impact: restitution is of the relative speed") {
    const FrictionlessImpact hit = strike(rows({{1}}), vector({-3}), zeros(1), {none(1), zeros(0)},
                                          {rows({{1}}), vector({-2})}, vector({0.5}));
    CHECK(near(hit.after, vector({2 + 0.5 * 5})));
}

TEST_CASE("impact: two equal elastic balls exchange their velocities") {
    const FrictionlessImpact hit = bounce(MatrixXd::Identity(2, 2), vector({1, 0}), rows({{-1, 1}}), 1);
    CHECK(near(hit.after, vector({0, 1})));
}

// Three balls that touch: γ⁺ = (1, 0) from x' = (1, 0, 0) and equal masses give (−1, 2, 2)/3 (Glocker, ch. 7):
// Newton's law at all contacts at once differs from successive collisions.
TEST_CASE("impact: three touching balls share the impulse according to the law") {
    const FrictionlessImpact hit =
        bounce(MatrixXd::Identity(3, 3), vector({1, 0, 0}), rows({{-1, 1, 0}, {0, -1, 1}}), 1);
    CHECK(near(hit.after, vector({-1. / 3, 2. / 3, 2. / 3})));
}

// Coordinates y, θ of the centre of a rod of length 2, supports at both ends: gaps y ∓ θ.
TEST_CASE("impact: a rod dropped flat on two supports stays level and each takes half") {
    for (const double e : {0.0, 0.6}) {
        const FrictionlessImpact hit = bounce(rows({{3, 0}, {0, 1}}), vector({-2, 0}), rows({{1, -1}, {1, 1}}), e);
        CHECK(near(hit.after, vector({2 * e, 0})));
        CHECK(near(hit.contact, vector({3 * (1 + e), 3 * (1 + e)})));
    }
}

TEST_CASE("impact: a table dropped flat on four legs is not singular, and each leg takes a quarter") {
    const MatrixXd M = vector({8, 1, 1}).asDiagonal();
    const FrictionlessImpact hit =
        bounce(M, vector({-1, 0, 0}), rows({{1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {1, -1, -1}}), 0);
    REQUIRE(hit);
    CHECK(near(hit.after, zeros(3)));
    CHECK(near(hit.contact, VectorXd::Constant(4, 2.0)));
}

// Tip of a rod at angle θ to the table: gap' = y' − (l/2) cos θ θ', Π (1/m + 3 cos²θ/m) = (1 + e) v.
TEST_CASE("impact: a slanting rod is turned by the table as in closed form") {
    const double m = 2, l = 0.8, theta = 0.6, v = 1.5, e = 0.4;
    const MatrixXd M = vector({m, m * l * l / 12}).asDiagonal();
    const FrictionlessImpact hit = bounce(M, vector({-v, 0}), rows({{1, -l / 2 * std::cos(theta)}}), e);
    const double P = (1 + e) * m * v / (1 + 3 * std::cos(theta) * std::cos(theta));
    CHECK(near(hit.contact, vector({P})));
    CHECK(near(hit.after, vector({-v + P / m, -6 * P * std::cos(theta) / (m * l)})));
}

TEST_CASE("impact: in a right-angled corner each wall acts alone") {
    const MatrixXd M = MatrixXd::Identity(2, 2);
    const FrictionlessImpact hit =
        strike(M, vector({-1, -2}), zeros(2), {none(2), zeros(0)}, {M, zeros(2)}, vector({0.5, 0.25}));
    CHECK(near(hit.after, vector({0.5, 0.5})));
}

// Walls y = 0 and the one at angle α, normals (0, 1) and (sin α, −cos α).
TEST_CASE("impact: in a sharp wedge an elastic ball keeps its speed and leaves both walls") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int i = 0; i < 50; ++i) {
        const double alpha = 0.05 + 0.7 * std::abs(any(random));
        const MatrixXd G = rows({{0, 1}, {std::sin(alpha), -std::cos(alpha)}});
        const VectorXd before = vector({-1, 0.8 * any(random) * alpha});
        const FrictionlessImpact hit = bounce(MatrixXd::Identity(2, 2), before, G, 1);
        INFO(alpha << " " << before.transpose());
        REQUIRE(hit);
        CHECK(std::abs(hit.after.norm() - before.norm()) < 1e-10);
        CHECK((G * hit.after).minCoeff() > -1e-11);
        CHECK(hit.contact.minCoeff() >= 0);
    }
    // Unfolding a wedge of π/4: four reflections turn (cos φ, sin φ) by π about the apex, whatever φ between the
    // walls' own.
    for (const double phi : {3.3, 3.5, 3.8}) {
        const double alpha = std::numbers::pi / 4;
        const FrictionlessImpact hit = bounce(MatrixXd::Identity(2, 2), vector({std::cos(phi), std::sin(phi)}),
                                              rows({{0, 1}, {std::sin(alpha), -std::cos(alpha)}}), 1);
        CHECK(near(hit.after, vector({-std::cos(phi), -std::sin(phi)}), 1e-12));
    }
}

// The body leaves at 1, is struck back at once to −2 and bounces to 1; the impulse did ½(−3)(−2 + 1).
TEST_CASE("impact: an opening contact that is pressed back has a collision of its own") {
    const FrictionlessImpact hit = strike(rows({{1}}), vector({1}), vector({-3}), {none(1), zeros(0)},
                                          {rows({{1}}), zeros(1)}, vector({0.5}));
    CHECK(near(hit.after, vector({1})));
    CHECK(near(hit.contact, vector({3})));
    CHECK(hit.collisions == 2);
    CHECK(hit.work == doctest::Approx(1.5));
    CHECK(hit.loss == doctest::Approx(1.5));
}

TEST_CASE(
    "impact: two shafts coupled at once share their angular momentum, and the lost velocities' energy is lost") {
    const MatrixXd M = vector({2, 3}).asDiagonal();
    const VectorXd before = vector({5, -1});
    const FrictionlessImpact hit =
        strike(M, before, zeros(2), {rows({{1, -1}}), zeros(1)}, {none(2), zeros(0)}, zeros(0));
    CHECK(near(hit.after, VectorXd::Constant(2, 7.0 / 5)));
    CHECK(near(hit.bilateral, vector({2 * (7.0 / 5 - 5)})));
    CHECK(energy(M, before) - energy(M, hit.after) ==
          doctest::Approx(energy(M, before - hit.after)).epsilon(1e-14));
}

TEST_CASE(
    "impact: a blow on a held ball is borne by what holds it; on a resting one by the floor, if it presses") {
    const VectorXd at_rest = zeros(1);
    const MatrixXd M = rows({{2}}), row = rows({{1}});
    const FrictionlessImpact held =
        strike(M, at_rest, vector({4}), {row, zeros(1)}, {none(1), zeros(0)}, zeros(0));
    CHECK(near(held.after, at_rest));
    CHECK(near(held.bilateral, vector({-4})));
    const FrictionlessImpact pressed =
        strike(M, at_rest, vector({-4}), {none(1), zeros(0)}, {row, zeros(1)}, vector({1}));
    CHECK(near(pressed.after, at_rest));
    CHECK(near(pressed.contact, vector({4})));
    const FrictionlessImpact lifted =
        strike(M, at_rest, vector({4}), {none(1), zeros(0)}, {row, zeros(1)}, vector({1}));
    CHECK(near(lifted.after, vector({2})));
    CHECK(lifted.contact[0] == 0);
}

TEST_CASE("impact: a coordinate without mass goes with the constraint that holds it") {
    const MatrixXd M = vector({2, 0}).asDiagonal();
    const FrictionlessImpact hit =
        strike(M, vector({0, 0}), vector({1, 3}), {rows({{1, -1}}), zeros(1)}, {none(2), zeros(0)}, zeros(0));
    REQUIRE(hit);
    CHECK(near(hit.after, vector({2, 2})));
    CHECK(near(hit.bilateral, vector({3})));  // 0 = 3 − Λ
}

TEST_CASE("impact: contradictory conditions are reported, not computed") {
    const MatrixXd M = MatrixXd::Identity(1, 1);
    const auto twice = [&](double b) {
        return strike(M, zeros(1), zeros(1), {rows({{1}, {2}}), vector({-1, b})}, {none(1), zeros(0)}, zeros(0));
    };
    CHECK(twice(-2));
    CHECK(near(twice(-2).after, vector({1})));
    CHECK(twice(-3).failure.find("contradict") != std::string::npos);
    CHECK(strike(rows({{0}}), zeros(1), zeros(1), {none(1), zeros(0)}, {none(1), zeros(0)}, zeros(0))
              .failure.find("singular") != std::string::npos);
    CHECK(strike(M, vector({NAN}), zeros(1), {none(1), zeros(0)}, {none(1), zeros(0)}, zeros(0))
              .failure.find("finite") != std::string::npos);
    // Two walls that close on a ball from both sides; a constraint that drives it into the floor.
    CHECK(strike(M, zeros(1), zeros(1), {none(1), zeros(0)}, {rows({{1}, {-1}}), vector({-1, -1})}, zeros(2))
              .failure.find("apart") != std::string::npos);
    CHECK(strike(M, zeros(1), zeros(1), {rows({{1}}), vector({1})}, {rows({{1}}), zeros(1)}, zeros(1))
              .failure.find("prescribe") != std::string::npos);
}

// The result is tested by its defining conditions: momenta, constraints, signs, complementarity. It is unique, so
// nothing else need be compared. After several collisions complementarity holds for each of them, and is not
// tested.
TEST_CASE("impact: random systems obey the law, and the balance of energy closes without a gain") {
    constexpr std::uint64_t seed = 20040301;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> any;
    const auto matrix = [&](Eigen::Index r, Eigen::Index c) -> MatrixXd {
        return MatrixXd::NullaryExpr(r, c, [&] { return any(random); });
    };
    int contacts = 0, rounds = 0;
    for (int i = 0; i < 2000; ++i) {
        const Eigen::Index n = 1 + i % 6, m = (i / 6) % n, k = (i / 7) % 6;
        const MatrixXd root = matrix(n, n), M = root * root.transpose() + 0.1 * MatrixXd::Identity(n, n);
        MatrixXd A = matrix(m, n), G = matrix(k, n);
        if (m > 1 && i % 3 == 0) A.row(0) = 2 * A.row(1);  // redundant ones too
        if (k > 1 && i % 5 == 0) G.row(0) = 0.5 * G.row(1);
        const VectorXd before = matrix(n, 1), impulse = i % 2 == 0 ? zeros(n) : VectorXd(matrix(n, 1));
        const VectorXd e = i % 4 == 0 ? zeros(k) : VectorXd(matrix(k, 1).cwiseAbs().cwiseMin(1));
        const FrictionlessImpact hit = strike(M, before, impulse, {A, zeros(m)}, {G, zeros(k)}, e);
        INFO("seed " << seed << " case " << i << ": " << hit.failure);
        REQUIRE(hit);
        const double size = M.norm() * (before.norm() + hit.after.norm()) + A.norm() + G.norm() + impulse.norm();
        CHECK((M * (hit.after - before) - impulse - A.transpose() * hit.bilateral - G.transpose() * hit.contact)
                  .norm() < 1e-10 * size);
        CHECK((A * hit.after).norm() < 1e-10 * size);
        CHECK(hit.loss >= 0);
        CHECK(std::abs(energy(M, before) - energy(M, hit.after) + hit.work - hit.loss) < 1e-10 * size * size);
        if (impulse.isZero()) CHECK(energy(M, hit.after) <= energy(M, before) * (1 + 1e-12));
        // Rates with the bilateral rows imposed: the approach that restitution refers to.
        const VectorXd imposed = strike(M, before, zeros(n), {A, zeros(m)}, {none(n), zeros(0)}, zeros(0)).after;
        for (Eigen::Index c = 0; c < k; ++c) {
            const double speed = G.row(c).dot(hit.after), approach = G.row(c).dot(imposed);
            CHECK(speed >= -1e-10 * size);
            CHECK(hit.contact[c] >= 0);
            if (hit.collisions > 1) continue;
            if (approach < 0) CHECK(speed >= -e[c] * approach - 1e-10 * size);
            CHECK(hit.contact[c] * std::abs(speed + e[c] * approach) < 1e-9 * size * size);
        }
        contacts += k > 1;
        rounds += hit.collisions > 1;
    }
    CHECK(contacts > 500);
    CHECK(rounds > 20);
}

}  // namespace runtime_impact
