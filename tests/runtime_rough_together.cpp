// SPDX-License-Identifier: MIT
// Simultaneous impacts with dry friction in planes: closed forms by symmetry, the laws that they have to obey, the
// choices of modes along lines, and each contact by itself where contacts do not feel each other.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>

#include "alembert/hybrid/contact_cone.hpp"
#include "alembert/hybrid/frictional_impact.hpp"
#include "alembert/hybrid/routh_impact.hpp"
#include "solved.hpp"

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
            MatrixXd tangent(2, 6);
            tangent << 1, 0, 0, 0, -h, -y, 0, 1, 0, h, 0, x;
            here.rough.push_back({.contact = i,
                                  .tangent = tangent,
                                  .offset = VectorXd::Zero(2),
                                  .velocity = tangent * u,
                                  .acceleration = VectorXd::Zero(2),
                                  .coefficient = mu,
                                  .resting = mu_s,
                                  .restitution = 0});
        }
        return here;
    }
    FrictionalImpact struck(const VectorXd& u) const {
        std::vector<int> near;
        for (int i = 0; i < feet; ++i) near.push_back(i);
        return strike_rough_contacts(at(u), u, near, std::vector<double>(static_cast<std::size_t>(feet), e),
                                     VectorXd());
    }
    static Situation::Rows rows(int count) {
        return {.rows = MatrixXd::Zero(count, 6),
                .value = VectorXd::Zero(count),
                .offset = VectorXd::Zero(count),
                .acceleration = VectorXd::Zero(count)};
    }
};

double energy(const MatrixXd& M, const VectorXd& u) {
    return u.dot(M * u) / 2;
}

/// The rates agree to 1e-13 of the largest.
void check_rates(const FrictionalImpact& hit, const VectorXd& expected) {
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
    const FrictionalImpact hit = plate.struck(u);
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
            MatrixXd tangent = MatrixXd::Zero(2, 6);
            tangent(0, 3 * i + 1) = tangent(1, 3 * i + 2) = 1;
            here.rough.push_back({.contact = i,
                                  .tangent = tangent,
                                  .offset = VectorXd::Zero(2),
                                  .velocity = tangent * u,
                                  .acceleration = VectorXd::Zero(2),
                                  .coefficient = 0.3,
                                  .resting = 0.3,
                                  .restitution = 0});
            const RouthImpact alone = strike_rough(i == 0 ? first : second, u.segment(3 * i, 3), MatrixXd(0, 3),
                                                   {.normal = RowVectorXd{{1, 0, 0}},
                                                    .tangent = RowVectorXd{{0, 1, 0}},
                                                    .coefficient = 0.3,
                                                    .resting = 0.3,
                                                    .across = RowVectorXd{{0, 0, 1}}},
                                                   0.5);
            possible = possible && alone;
            if (alone) expected.segment(3 * i, 3) = alone.after;
            loss += alone.loss;
        }
        const FrictionalImpact hit = strike_rough_contacts(here, u, {0, 1}, {0.5, 0.5}, VectorXd());
        REQUIRE(bool(hit) == possible);
        if (!possible) continue;
        CHECK((hit.after - expected).norm() <= 1e-11 * expected.norm());  // that of the integrated impacts
        CHECK(hit.events.size() == 2);
        CHECK(energy(M, u) - energy(M, hit.after) == doctest::Approx(loss).epsilon(1e-9));
    }
}

/// The different rates after an impact along lines, by all choices of modes of all contacts.
std::vector<VectorXd> all_results(const MatrixXd& M, const VectorXd& momentum,
                                  const std::vector<ContactCone>& contacts) {
    const auto k = static_cast<Index>(contacts.size()), n = M.rows();
    const MatrixXd inverse = test::inverse_of(M);
    std::vector<VectorXd> results;
    for (int code = 0; code < 1 << (2 * k); ++code) {
        const auto mode = [&](Index i) { return code >> (2 * i) & 3; };  // open, sticks, slides up, slides down
        // The impulse of each contact that is not open, and with it that along a line where it sticks.
        MatrixXd along(n, 0), held(0, n);
        VectorXd offset(0);
        const auto add = [&](const VectorXd& direction, const RowVectorXd& row, double constant) {
            along.conservativeResize(Eigen::NoChange, along.cols() + 1);
            along.rightCols(1) = direction;
            held.conservativeResize(held.rows() + 1, Eigen::NoChange);
            held.bottomRows(1) = row;
            offset.conservativeResize(offset.size() + 1);
            offset.tail(1)[0] = constant;
        };
        for (Index i = 0; i < k; ++i) {
            const ContactCone& c = contacts[static_cast<std::size_t>(i)];
            const double slope = mode(i) == 2 ? -c.coefficient : mode(i) == 3 ? c.coefficient : 0;
            if (mode(i) == 0) continue;
            add((c.normal + slope * c.tangent.row(0)).transpose(), c.normal, c.offset);
            if (mode(i) == 1) add(c.tangent.row(0).transpose(), c.tangent.row(0), c.tangent_offset[0]);
        }
        const VectorXd free = inverse * momentum;
        VectorXd p(0), after = free;
        if (held.rows() > 0) {
            const std::optional<MatrixXd> solution = test::solved(held * inverse * along, -offset - held * free);
            if (!solution) continue;
            p = *solution;
            after += inverse * along * p;
        }
        bool is_consistent = after.allFinite();
        Index next = 0;
        for (Index i = 0; i < k; ++i) {
            const ContactCone& c = contacts[static_cast<std::size_t>(i)];
            const double gap = c.normal.dot(after) + c.offset,
                         sliding = c.tangent.row(0).dot(after) + c.tangent_offset[0];
            if (mode(i) == 0) {
                is_consistent = is_consistent && gap >= -1e-9;
                continue;
            }
            const double pressed = p[next++];
            is_consistent = is_consistent && pressed >= -1e-9;
            if (mode(i) == 1) is_consistent = is_consistent && std::abs(p[next++]) <= c.resting * pressed + 1e-9;
            if (mode(i) == 2) is_consistent = is_consistent && sliding >= -1e-9;
            if (mode(i) == 3) is_consistent = is_consistent && sliding <= 1e-9;
        }
        if (!is_consistent) continue;
        if (std::none_of(results.begin(), results.end(),
                         [&](const VectorXd& other) { return (other - after).norm() <= 1e-6 * after.norm(); }))
            results.push_back(after);
    }
    return results;
}

TEST_CASE("rough together: along lines the only result is found, and each refusal has its reason") {
    for (const double mu : {0.15, 0.5, 1.5}) {
        std::mt19937 random(11);
        std::map<std::string, int> told;  // the numbers of outcomes
        for (int trial = 0; trial < 400; ++trial) {
            const int n = 5, contacts = 2 + trial % 2;
            const MatrixXd M = random_mass(random, n);
            const VectorXd momentum = random_vector(random, n), before = test::solved(M, momentum).value();
            std::vector<ContactCone> cones;
            Situation here{
                .M = M, .f = VectorXd::Zero(n), .bilateral = Plate::rows(0), .contacts = Plate::rows(0)};
            here.bilateral.rows.resize(0, n);
            here.contacts = {.rows = MatrixXd(contacts, n),
                             .value = VectorXd::Zero(contacts),
                             .offset = VectorXd(contacts),
                             .acceleration = VectorXd::Zero(contacts)};
            std::vector<int> near;
            for (int i = 0; i < contacts; ++i) {
                const RowVectorXd normal = random_vector(random, n).transpose(),
                                  tangent = random_vector(random, n).transpose();
                const VectorXd offsets = 0.3 * random_vector(random, 2);
                cones.push_back({.normal = normal,
                                 .offset = offsets[0],
                                 .tangent = tangent,
                                 .tangent_offset = VectorXd::Constant(1, offsets[1]),
                                 .coefficient = mu,
                                 .resting = mu});
                here.contacts.rows.row(i) = normal;
                here.contacts.offset[i] = offsets[0];
                here.rough.push_back({.contact = i,
                                      .tangent = tangent,
                                      .offset = VectorXd::Constant(1, offsets[1]),
                                      .velocity = tangent * before + VectorXd::Constant(1, offsets[1]),
                                      .acceleration = VectorXd::Zero(1),
                                      .coefficient = mu,
                                      .resting = mu,
                                      .restitution = 0});
                near.push_back(i);
            }
            CAPTURE(mu);
            CAPTURE(trial);
            const std::vector<VectorXd> all = all_results(M, momentum, cones);
            const auto reason = [](const std::string& failure) -> std::string {
                for (const char* one : {"no choice", "several choices", "do not settle", "gain energy"})
                    if (failure.find(one) != std::string::npos) return one;
                return failure.empty() ? "found" : failure;
            };
            // The impulse of 0 at the same instant keeps all contacts together.
            const FrictionalImpact hit = strike_rough_contacts(
                here, before, near, std::vector<double>(static_cast<std::size_t>(contacts), 0.0),
                VectorXd::Zero(n));
            const std::string in_lines = reason(hit.failure);
            ++told["lines: " + in_lines];
            if (in_lines != "gain energy")  // which is found after the impact
                CHECK(in_lines == (all.empty() ? "no choice" : all.size() == 1 ? "found" : "several choices"));
            if (hit) CHECK((hit.after - all[0]).norm() <= 1e-9 * (1 + all[0].norm()));

            // The cones look for a second result once, and may not settle where friction is large.
            const ConeChoice cone = choose_in_cones(M, momentum, MatrixXd(0, n), VectorXd(), cones);
            const std::string in_cones = reason(cone.failure);
            ++told["cones: " + in_cones];
            if (cone) {
                CHECK(std::any_of(all.begin(), all.end(), [&](const VectorXd& one) {
                    return (cone.after - one).norm() <= 1e-9 * (1 + one.norm());
                }));
                told["cones: not the only one"] += all.size() > 1 ? 1 : 0;
            } else if (in_cones == "several choices") {
                CHECK(all.size() > 1);
            } else if (in_cones == "no choice") {
                CHECK(all.empty());
            } else {
                CHECK(in_cones == "do not settle");
                CHECK(mu > 0.15);
            }
        }
        CAPTURE(mu);
        CHECK(told["lines: found"] + told["lines: gain energy"] >= 360);
        CHECK(told["lines: do not settle"] == 0);
        if (mu < 0.2) CHECK(told["cones: found"] == 400);
        if (mu > 1) {
            CHECK(told["lines: no choice"] == 6);
            CHECK(told["lines: several choices"] == 33);
            CHECK(told["cones: not the only one"] > 0);  // so that the choices along lines are needed
            CHECK(told["cones: do not settle"] < 40);
        }
    }
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
        const FrictionalImpact hit = plate.struck(u);
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
            const VectorXd sliding = rough.tangent * hit.after;
            all_slide = all_slide && sliding.norm() > 1e-6;
            whole += event.impulse * here.contacts.rows.row(event.contact).transpose();
            whole -= plate.mu * event.impulse * rough.tangent.transpose() * sliding / sliding.norm();
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
        std::vector<ContactCone> rows;
        rows.push_back({.normal = RowVectorXd{{1, 0, 0}},
                        .offset = 0,
                        .tangent = MatrixXd{{0, 1, 0}, {0, 0, 1}},
                        .tangent_offset = VectorXd::Zero(2),
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
