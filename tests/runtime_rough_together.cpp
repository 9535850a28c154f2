// SPDX-License-Identifier: MIT
// Simultaneous impacts with dry friction in planes: closed forms by symmetry, the laws that they have to obey, the
// choices of modes along lines, and each contact by itself where contacts do not feel each other.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "alembert/rough_choice.hpp"
#include "alembert/rough_cones.hpp"
#include "alembert/rough_impact.hpp"
#include "alembert/rough_strike.hpp"

namespace runtime_rough_together {

using namespace alembert;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

namespace {

constexpr double pi = 3.14159265358979323846;

/// A plate on `feet` feet at the distance R from its middle and h below it: x', y', z', and the angular velocities
/// about x, y, z.
struct Plate {
    double m = 2, J = 0.03, A = 0.05, R = 0.3, h = 0, mu = 0.2, mu_s = 0.2, e = 0.3;
    int feet = 3;

    MatrixXd mass() const { return VectorXd{{m, m, m, A, A, J}}.asDiagonal(); }
    Situation at(const VectorXd& u) const {
        Situation here{.M = mass(), .f = VectorXd::Zero(6), .bilateral = rows(0), .contacts = rows(feet)};
        for (int i = 0; i < feet; ++i) {
            const double x = R * std::cos(2 * pi * i / feet), y = R * std::sin(2 * pi * i / feet);
            here.contacts.rows.row(i) = RowVectorXd{{0, 0, 1, y, -x, 0}};
            MatrixXd slip(2, 6);
            slip << 1, 0, 0, 0, -h, -y, 0, 1, 0, h, 0, x;
            here.rough.push_back({.contact = i,
                                  .slip = slip,
                                  .drift = VectorXd::Zero(2),
                                  .velocity = slip * u,
                                  .acceleration = VectorXd::Zero(2),
                                  .coefficient = mu,
                                  .resting = mu_s,
                                  .restitution = 0});
        }
        return here;
    }
    RoughStrike struck(const VectorXd& u) const {
        std::vector<int> near;
        for (int i = 0; i < feet; ++i) near.push_back(i);
        return strike_rough_contacts(at(u), u, near, std::vector<double>(static_cast<std::size_t>(feet), e),
                                     VectorXd());
    }
    static Situation::Rows rows(int count) {
        return {.rows = MatrixXd::Zero(count, 6),
                .value = VectorXd::Zero(count),
                .drift = VectorXd::Zero(count),
                .acceleration = VectorXd::Zero(count)};
    }
};

double energy(const MatrixXd& M, const VectorXd& u) {
    return u.dot(M * u) / 2;
}

/// The rates agree to 1e-13 of the largest.
void check_rates(const RoughStrike& hit, const VectorXd& expected) {
    REQUIRE_MESSAGE(hit.failure.empty(), hit.failure);
    INFO("found    " << hit.after.transpose());
    INFO("expected " << expected.transpose());
    CHECK((hit.after - expected).norm() <= 1e-13 * expected.norm());
}

MatrixXd random_mass(std::mt19937& random, int n) {
    std::normal_distribution<double> any;
    const MatrixXd B = MatrixXd::NullaryExpr(n, n, [&] { return any(random); });
    return B * B.transpose() + MatrixXd::Identity(n, n);
}

VectorXd random_vector(std::mt19937& random, int n) {
    std::normal_distribution<double> any;
    return VectorXd::NullaryExpr(n, [&] { return any(random); });
}

}  // namespace

TEST_CASE("rough together: a spinning plate that falls flat on its feet loses spin until it stops") {
    // The feet press with m v (1 + e) together; friction turns against the spin with R times mu of that.
    for (const int feet : {3, 4, 6})
        for (const double h : {0.0, 0.1}) {
            CAPTURE(feet);
            CAPTURE(h);
            Plate plate{.h = h, .feet = feet};
            const double v = 1.5, loss = plate.mu * plate.m * v * (1 + plate.e) * plate.R / plate.J;
            check_rates(plate.struck(VectorXd{{0, 0, -v, 0, 0, 10}}),
                        VectorXd{{0, 0, plate.e * v, 0, 0, 10 - loss}});
            check_rates(plate.struck(VectorXd{{0, 0, -v, 0, 0, -5}}), VectorXd{{0, 0, plate.e * v, 0, 0, 0}});
        }
}

TEST_CASE("rough together: a plate that slides without spin is braked along its velocity, or stopped") {
    const Plate plate;
    const double v = 1.5, loss = plate.mu * v * (1 + plate.e);
    check_rates(plate.struck(VectorXd{{3, -4, -v, 0, 0, 0}}),
                VectorXd{{3 - 0.6 * loss, -4 + 0.8 * loss, plate.e * v, 0, 0, 0}});
    check_rates(plate.struck(VectorXd{{0.1, 0.1, -v, 0, 0, 0}}), VectorXd{{0, 0, plate.e * v, 0, 0, 0}});
    Plate held = plate;
    held.mu_s = 0.5;  // more than the kinetic coefficient holds what that would let go
    check_rates(held.struck(VectorXd{{0.5, 0, -v, 0, 0, 0}}), VectorXd{{0, 0, plate.e * v, 0, 0, 0}});
}

TEST_CASE("rough together: turned and mirrored impacts have turned and mirrored results") {
    Plate plate{.h = 0.05};
    const VectorXd u{{0.9, 0.4, -1.2, 0, 0, 7}};
    const RoughStrike hit = plate.struck(u);
    REQUIRE(hit);
    const double c = std::cos(2 * pi / 3), s = std::sin(2 * pi / 3);
    const auto turned = [&](const VectorXd& x) {
        return VectorXd{
            {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2], c * x[3] - s * x[4], s * x[3] + c * x[4], x[5]}};
    };
    check_rates(plate.struck(turned(u)), turned(hit.after));
    const auto mirrored = [](const VectorXd& x) {  // in the plane y = 0
        return VectorXd{{x[0], -x[1], x[2], -x[3], x[4], -x[5]}};
    };
    check_rates(plate.struck(mirrored(u)), mirrored(hit.after));
}

TEST_CASE("rough together: contacts that do not feel each other are struck each by itself") {
    std::mt19937 random(7);
    for (int trial = 0; trial < 40; ++trial) {
        CAPTURE(trial);
        // Two bodies of three coordinates each: a normal and two tangential directions that are coupled.
        const MatrixXd first = random_mass(random, 3), second = random_mass(random, 3);
        MatrixXd M = MatrixXd::Zero(6, 6);
        M.topLeftCorner(3, 3) = first;
        M.bottomRightCorner(3, 3) = second;
        VectorXd u = random_vector(random, 6);
        u[0] = -std::abs(u[0]);
        u[3] = -std::abs(u[3]);
        Situation here{.M = M, .f = VectorXd::Zero(6), .bilateral = Plate::rows(0), .contacts = Plate::rows(2)};
        VectorXd expected(6);
        double loss = 0;
        bool possible = true;
        for (int i = 0; i < 2; ++i) {
            here.contacts.rows(i, 3 * i) = 1;
            MatrixXd slip = MatrixXd::Zero(2, 6);
            slip(0, 3 * i + 1) = slip(1, 3 * i + 2) = 1;
            here.rough.push_back({.contact = i,
                                  .slip = slip,
                                  .drift = VectorXd::Zero(2),
                                  .velocity = slip * u,
                                  .acceleration = VectorXd::Zero(2),
                                  .coefficient = 0.3,
                                  .resting = 0.3,
                                  .restitution = 0});
            const RoughImpact alone = strike_rough(i == 0 ? first : second, u.segment(3 * i, 3), MatrixXd(0, 3),
                                                   {.normal = RowVectorXd{{1, 0, 0}},
                                                    .slip = RowVectorXd{{0, 1, 0}},
                                                    .coefficient = 0.3,
                                                    .resting = 0.3,
                                                    .across = RowVectorXd{{0, 0, 1}}},
                                                   0.5);
            possible = possible && alone;
            if (alone) expected.segment(3 * i, 3) = alone.after;
            loss += alone.loss;
        }
        const RoughStrike hit = strike_rough_contacts(here, u, {0, 1}, {0.5, 0.5}, VectorXd());
        REQUIRE(bool(hit) == possible);
        if (!possible) continue;
        CHECK((hit.after - expected).norm() <= 1e-11 * expected.norm());  // that of the integrated impacts
        CHECK(hit.events.size() == 2);
        CHECK(energy(M, u) - energy(M, hit.after) == doctest::Approx(loss).epsilon(1e-9));
    }
}

TEST_CASE("rough together: along lines the cones have the result of the choices of modes") {
    std::mt19937 random(11);
    int compared = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const int n = 5, contacts = 2 + trial % 2;
        const MatrixXd M = random_mass(random, n);
        const VectorXd momentum = random_vector(random, n);
        std::vector<RoughRows> lines;
        std::vector<ConeRows> cones;
        for (int i = 0; i < contacts; ++i) {
            const RowVectorXd normal = random_vector(random, n).transpose(),
                              slip = random_vector(random, n).transpose();
            const VectorXd offsets = 0.3 * random_vector(random, 2);
            lines.push_back({.normal = normal,
                             .offset = offsets[0],
                             .slip = slip,
                             .slip_offset = offsets[1],
                             .coefficient = 0.15,
                             .resting = 0.15});
            cones.push_back({.normal = normal,
                             .offset = offsets[0],
                             .slip = slip,
                             .slip_offset = VectorXd::Constant(1, offsets[1]),
                             .coefficient = 0.15,
                             .resting = 0.15});
        }
        const RoughChoice line = choose_rough(M, momentum, MatrixXd(0, n), VectorXd(), lines);
        const ConeChoice cone = choose_in_cones(M, momentum, MatrixXd(0, n), VectorXd(), cones);
        CAPTURE(trial);
        if (!line.exists || !cone) continue;
        ++compared;
        CHECK((line.after - cone.after).norm() <= 1e-9 * (1 + line.after.norm()));
        for (int i = 0; i < contacts; ++i) {
            CHECK(std::abs(line.normal[i] - cone.normal[i]) <= 1e-9);
            CHECK(std::abs(line.tangential[i] - cone.tangential[static_cast<std::size_t>(i)][0]) <= 1e-9);
        }
    }
    CHECK(compared > 280);
}

TEST_CASE("rough together: random impacts obey Moreau's law with cones, and gain no energy") {
    std::mt19937 random(3);
    int found = 0, gaining = 0;
    for (int trial = 0; trial < 300; ++trial) {
        CAPTURE(trial);
        Plate plate{.h = 0.2 * (trial % 3), .mu = 0.1 + 0.05 * (trial % 9), .e = 0.25 * (trial % 4)};
        plate.mu_s = plate.mu;
        VectorXd u = random_vector(random, 6);
        u[2] = -2 - std::abs(u[2]);  // all feet strike
        u[5] *= 5;
        const Situation here = plate.at(u);
        const RoughStrike hit = plate.struck(u);
        if (!hit) {
            gaining += hit.failure.find("gain energy") != std::string::npos;
            continue;
        }
        ++found;
        const VectorXd change = plate.mass() * (hit.after - u);
        const double size = change.norm();
        // The impulses of the feet follow from the events and the change of momentum: horizontal sums and moments.
        double pressed = 0, lost = 0;
        for (const ContactEvent& event : hit.events) {
            CHECK(event.impulse > 0);
            if (hit.events.size() > 1)  // one foot by itself has Poisson's law
                CHECK(event.speed_after == doctest::Approx(-plate.e * event.speed_before).epsilon(1e-10));
            pressed += event.impulse;
            lost += event.energy_loss;
        }
        CHECK(pressed == doctest::Approx(change[2]).epsilon(1e-10));
        CHECK(std::hypot(change[0], change[1]) <= plate.mu * pressed + 1e-9 * size);
        CHECK(energy(plate.mass(), u) - energy(plate.mass(), hit.after) ==
              doctest::Approx(lost).epsilon(1e-10).scale(energy(plate.mass(), u)));
        CHECK(lost >= -1e-9 * energy(plate.mass(), u));
        // Where all feet slide, the whole impulse follows from their directions.
        VectorXd whole = VectorXd::Zero(6);
        bool all_slide = hit.events.size() == 3;
        for (const ContactEvent& event : hit.events) {
            const Situation::Rough& rough = here.rough[static_cast<std::size_t>(event.contact)];
            const VectorXd slip = rough.slip * hit.after;
            all_slide = all_slide && slip.norm() > 1e-6;
            whole += event.impulse * here.contacts.rows.row(event.contact).transpose();
            whole -= plate.mu * event.impulse * rough.slip.transpose() * slip / slip.norm();
        }
        if (all_slide) CHECK((whole - change).norm() <= 1e-9 * size);
    }
    CHECK(found > 200);
    INFO(gaining);
    CHECK(found + gaining == 300);
}

TEST_CASE("rough together: an impact with more than one consistent result is told, and so is one without") {
    // A contact whose sliding lifts it strongly: with a large coefficient it sticks, or lifts off without sliding.
    const auto choice = [](double mu, double coupling, double unit, int bound = 0) {
        MatrixXd M = unit * MatrixXd::Identity(3, 3);
        M(0, 1) = M(1, 0) = unit * coupling;
        std::vector<ConeRows> rows;
        rows.push_back({.normal = RowVectorXd{{1, 0, 0}},
                        .offset = 0,
                        .slip = MatrixXd{{0, 1, 0}, {0, 0, 1}},
                        .slip_offset = VectorXd::Zero(2),
                        .coefficient = mu,
                        .resting = mu});
        MatrixXd A = MatrixXd::Zero(bound, 3);
        if (bound > 0) A(0, 0) = 1;
        return choose_in_cones(M, M * VectorXd{{0.2, -1, 0}}, A, VectorXd::Ones(bound), rows);
    };
    for (const double unit : {1.0, 1e8, 1e-8}) {  // kg
        CAPTURE(unit);
        CHECK(choice(0.1, 0.5, unit));
        CHECK(choice(3, 0.9, unit).failure.find("several choices") != std::string::npos);
        // A constraint moves the contact into the floor at the speed 1.
        CHECK(choice(0.1, 0.5, unit, 1).failure.find("no choice") != std::string::npos);
    }
}

}  // namespace runtime_rough_together
