// SPDX-License-Identifier: MIT
// Impacts with dry friction against closed forms and against the laws that they have to obey.
#include "alembert/hybrid/routh_impact.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "solved.hpp"

namespace runtime_rough_impact {

using namespace alembert;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

namespace {

const MatrixXd no_rows(0, 3);

/// A sphere of mass 1 and radius 1 over the floor: x, y, phi.
RoughContact sphere(double mu) {
    return {.normal = RowVectorXd{{0, 1, 0}},
            .tangent = RowVectorXd{{1, 0, -1}},
            .normal_offset = 0,
            .tangent_offset = 0,
            .coefficient = mu,
            .resting = mu};
}

double energy(const MatrixXd& M, const VectorXd& u) {
    return u.dot(M * u) / 2;
}

}  // namespace

TEST_CASE("rough impact: a sphere slides through the impact, or grips and keeps 5/7 of its sliding") {
    const MatrixXd M = VectorXd{{1, 1, 0.4}}.asDiagonal();
    const VectorXd before{{5, -2, 0}};
    const RouthImpact slides = strike_rough(M, before, no_rows, sphere(0.2), 0.5);
    REQUIRE(slides);
    CHECK(slides.after[0] == doctest::Approx(5 - 0.2 * 3).epsilon(1e-14));
    CHECK(slides.after[1] == doctest::Approx(1).epsilon(1e-14));
    CHECK(slides.impulse == doctest::Approx(3).epsilon(1e-14));
    CHECK(slides.tangential == doctest::Approx(-0.6).epsilon(1e-14));
    const RouthImpact grips = strike_rough(M, before, no_rows, sphere(0.9), 0.5);
    REQUIRE(grips);
    CHECK(grips.after[0] == doctest::Approx(5 - 2.0 / 7 * 5).epsilon(1e-14));
    CHECK(grips.after[0] == doctest::Approx(grips.after[2]).epsilon(1e-14));
    CHECK(grips.loss == doctest::Approx(energy(M, before) - energy(M, grips.after)).epsilon(1e-13));
}

TEST_CASE("rough impact: a rod that strikes with its end slides back within the impact") {
    // Uniform rod of mass 1 and half length 1 at the angle a, end at (x, y): u = (x', y', a'). For v > 0 small it
    // stops, and slides back where mu is below (1/a_nt)/… : the direction of sliding follows from a_nt.
    const double a = 0.8, c = std::cos(a), s = std::sin(a);
    // The centre is at (x + cos a, y + sin a).
    MatrixXd M(3, 3);
    M << 1, 0, -s, 0, 1, c, -s, c, 1 + 1.0 / 3;
    const RoughContact end{.normal = RowVectorXd{{0, 1, 0}},
                           .tangent = RowVectorXd{{1, 0, 0}},
                           .normal_offset = 0,
                           .tangent_offset = 0,
                           .coefficient = 0.3,
                           .resting = 0.3};
    const MatrixXd inverse = test::inverse_of(M);
    const double nn = inverse(1, 1), nt = inverse(0, 1), tt = inverse(0, 0);
    REQUIRE(std::abs(nt) > 0.3 * tt);              // it cannot stick
    const double v = nt > 0 ? -0.1 : 0.1, n = -1;  // against the way in which the impulse pushes
    const VectorXd before{{v, n, 0}};
    const RouthImpact hit = strike_rough(M, before, no_rows, end, 0.5);
    REQUIRE(hit);
    const double first = v > 0 ? 1 : -1;
    const double stop = -v / (nt - 0.3 * first * tt);
    const double n_then = n + stop * (nn - 0.3 * first * nt);
    const double compression = stop - n_then / (nn + 0.3 * first * nt), all = 1.5 * compression;
    CHECK(hit.impulse == doctest::Approx(all).epsilon(1e-13));
    CHECK(hit.tangential == doctest::Approx(0.3 * first * (all - 2 * stop)).epsilon(1e-13));
    CHECK(hit.after[0] * first < 0);
}

TEST_CASE("rough impact: momenta, Coulomb's law and the energy hold in random impacts") {
    std::mt19937 random(20);
    const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
    int done = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        CAPTURE(trial);
        MatrixXd L(3, 3);
        for (int i = 0; i < 9; ++i) L(i / 3, i % 3) = number();
        const MatrixXd M = L * L.transpose() + 0.1 * MatrixXd::Identity(3, 3);
        RoughContact contact{.normal = RowVectorXd{{number(), number(), number()}},
                             .tangent = RowVectorXd{{number(), number(), number()}},
                             .normal_offset = 0,
                             .tangent_offset = 0,
                             .coefficient = std::abs(number()),
                             .resting = 0};
        contact.resting = contact.coefficient * (1 + std::abs(number()));
        const VectorXd before{{number(), number(), number()}};
        if (contact.normal.dot(before) >= 0) continue;
        const RouthImpact hit = strike_rough(M, before, no_rows, contact, std::abs(number()));
        REQUIRE(hit);
        ++done;
        const VectorXd momentum =
            contact.normal.transpose() * hit.impulse + contact.tangent.transpose() * hit.tangential;
        CHECK((M * (hit.after - before) - momentum).norm() <= 1e-11 * (1 + momentum.norm()));
        CHECK(std::abs(hit.tangential) <= contact.resting * hit.impulse * (1 + 1e-12));
        CHECK(contact.normal.dot(hit.after) >= -1e-11 * (1 + hit.impulse));
        CHECK(hit.loss >= -1e-11 * (1 + energy(M, before)));
        CHECK(hit.loss == doctest::Approx(energy(M, before) - energy(M, hit.after)).epsilon(1e-8));
    }
    CHECK(done > 500);
}

TEST_CASE(
    "rough impact: in a plane momentum, the cone and the energy are kept, and a fine polygon comes near it") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto row = [&] { return RowVectorXd{{uniform(random), uniform(random), uniform(random)}}; };
    int done = 0;
    for (int trial = 0; trial < 60; ++trial) {
        CAPTURE(trial);
        MatrixXd L(3, 3);
        for (int i = 0; i < 9; ++i) L(i / 3, i % 3) = uniform(random);
        const MatrixXd M = L * L.transpose() + 0.5 * MatrixXd::Identity(3, 3), response = test::inverse_of(M);
        RoughContact contact{.normal = row(), .tangent = row()};
        contact.across = row();
        contact.coefficient = std::abs(uniform(random)) + 0.01;
        contact.resting = contact.coefficient;
        const VectorXd before = row().transpose();
        if (contact.normal.dot(before) >= 0) continue;
        const RouthImpact hit = strike_rough(M, before, no_rows, contact, 0.5);
        REQUIRE(hit);
        ++done;
        const VectorXd momentum = contact.normal.transpose() * hit.impulse +
                                  contact.tangent.transpose() * hit.tangential +
                                  contact.across.transpose() * hit.across;
        CHECK((M * (hit.after - before) - momentum).norm() <= 1e-11 * (1 + momentum.norm()));
        CHECK(std::hypot(hit.tangential, hit.across) <= contact.resting * hit.impulse * (1 + 1e-11));
        CHECK(hit.loss == doctest::Approx(energy(M, before) - energy(M, hit.after)).epsilon(1e-9));
        // Friction of the size mu against the present sliding velocity, in many small steps of the impulse: where
        // it sticks, the polygon trembles about v = 0 by a step.
        const int steps = 20000;
        const double step = hit.impulse / steps;
        VectorXd u = before;
        for (int n = 0; n < steps; ++n) {
            const double v = contact.tangent.dot(u), w = contact.across.dot(u), speed = std::hypot(v, w);
            const double mu = speed > 0 ? contact.coefficient / speed : 0;
            u += step * response * (contact.normal - mu * (v * contact.tangent + w * contact.across)).transpose();
        }
        CHECK((u - hit.after).norm() < 100 * step * response.norm());
    }
    CHECK(done > 20);
}

TEST_CASE(
    "rough impact: a gripping impact with restitution reverses the sliding velocity as far as the cone allows") {
    // A solid ball of mass 1 and radius 1 with the rates x', y', phi': the lowest point has v = x' − phi'.
    MatrixXd M = MatrixXd::Identity(3, 3);
    M(2, 2) = 0.4;
    RoughContact contact{.normal = RowVectorXd{{0, 1, 0}}, .tangent = RowVectorXd{{1, 0, -1}}};
    contact.coefficient = contact.resting = 10;
    contact.grip = 0.5;
    const VectorXd before{{1, -2, -3}};
    const RouthImpact whole = strike_rough(M, before, no_rows, contact, 1);
    CHECK(contact.tangent.dot(whole.after) == doctest::Approx(-2).epsilon(1e-14));
    CHECK(whole.after[1] == doctest::Approx(2).epsilon(1e-14));
    CHECK(whole.loss == doctest::Approx((16 - 4) / 7.0).epsilon(1e-13));  // of the reduced mass 2/7
    contact.coefficient = contact.resting = 0.36;
    const RouthImpact part = strike_rough(M, before, no_rows, contact, 1);
    CHECK(std::abs(part.tangential) == doctest::Approx(0.36 * 4).epsilon(1e-14));
    CHECK(contact.tangent.dot(part.after) == doctest::Approx(4 - 3.5 * 0.36 * 4).epsilon(1e-13));
}

}  // namespace runtime_rough_impact
