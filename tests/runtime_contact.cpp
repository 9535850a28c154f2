// SPDX-License-Identifier: MIT
// Contact modes without a scene: against enumeration of all subsets, closed forms, and complementarity itself.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "alembert/hybrid/frictionless_impact.hpp"
#include "alembert/hybrid/hybrid_motion.hpp"
#include "solved.hpp"

namespace runtime_contact {

using namespace alembert;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double g = 9.81;

Situation::Rows no_rows(Index n) {
    return {MatrixXd(0, n), VectorXd(0), VectorXd(0), VectorXd(0)};
}

/// q'' of the first subset of contacts for which gap'' ≥ 0 and the reactions are ≥ 0; nothing if there is none.
std::optional<VectorXd> by_enumeration(const Situation& s) {
    const Index n = s.f.size(), k = s.contacts.rows.rows(), m = s.bilateral.rows.rows();
    for (unsigned subset = 0; subset < 1U << k; ++subset) {
        std::vector<int> which;
        for (int i = 0; i < k; ++i)
            if ((subset >> i & 1U) != 0) which.push_back(i);
        const Situation::Rows rows = stacked(s.bilateral, selected(s.contacts, which));
        const Index c = rows.rows.rows();
        MatrixXd K = MatrixXd::Zero(n + c, n + c);
        K.topLeftCorner(n, n) = s.M;
        K.topRightCorner(n, c) = -rows.rows.transpose();
        K.bottomLeftCorner(c, n) = rows.rows;
        VectorXd right(n + c);
        right << s.f, rows.acceleration;
        const std::optional<MatrixXd> solution = test::solved(K, right);
        if (!solution) continue;
        const VectorXd x = *solution;
        const VectorXd gap = s.contacts.rows * x.head(n) - s.contacts.acceleration;
        if (x.tail(c - m).size() > 0 && x.tail(c - m).minCoeff() < -1e-9) continue;
        if (gap.minCoeff() < -1e-9) continue;
        return x.head(n);
    }
    return std::nullopt;
}

/// A ball over a floor: y, y'. The gap counts once more with every copy of the floor.
struct Ball {
    double e;
    int floors = 1;
    std::vector<ContactMode> modes{};

    Contacts contacts() const {
        Contacts result;
        for (int k = 0; k < floors; ++k)
            result.names.push_back(fmt::format("floor {}", k)), result.restitution.push_back(e);
        result.situation = [this](double, const double* y) {
            return Situation{.M = MatrixXd::Constant(1, 1, 2),
                             .f = VectorXd::Constant(1, -2 * g),
                             .bilateral = no_rows(1),
                             .contacts = {MatrixXd::Ones(floors, 1), VectorXd::Constant(floors, y[0]),
                                          VectorXd::Zero(floors), VectorXd::Zero(floors)}};
        };
        return result;
    }

    ContactModes mode_of() {
        modes.resize(2);
        for (std::size_t lies = 0; lies < 2; ++lies) {
            modes[lies].system.rhs = make_rhs(2, [lies](double, const double* y, double* rate) {
                rate[0] = y[1];
                rate[1] = lies != 0 ? 0 : -g;
            });
            std::vector<Event> list;
            for (int k = 0; k < floors; ++k) list.push_back({.name = "floor"});
            modes[lies].events =
                make_events(std::move(list), [lies, this](double, const double* y, const double*, double* out) {
                    for (int k = 0; k < floors; ++k) out[k] = lies != 0 && k == 0 ? 2 * g : y[0];
                });
        }
        return [this](const std::vector<int>& closed) -> const ContactMode& { return modes[closed.size()]; };
    }
};

}  // namespace

TEST_CASE("contact: the contacts that stay closed are those that enumeration of all subsets finds") {
    const unsigned seed = 7;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto matrix = [&](Index rows, Index columns) -> MatrixXd {
        return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
    };
    int several = 0;
    for (int i = 0; i < 300; ++i) {
        const Index n = 4, k = 1 + i % 4, m = i % 2;
        const MatrixXd root = matrix(n, n);
        const auto rows = [&](Index count) {
            return Situation::Rows{matrix(count, n), VectorXd::Zero(count), VectorXd::Zero(count),
                                   matrix(count, 1)};
        };
        Situation s{.M = root * root.transpose() + MatrixXd::Identity(n, n) / 10,
                    .f = 3 * matrix(n, 1),
                    .bilateral = rows(m),
                    .contacts = rows(k)};
        std::vector<int> all;
        for (int c = 0; c < k; ++c) all.push_back(c);
        const std::optional<VectorXd> expected = by_enumeration(s);
        const LastingContacts found = lasting_contacts(s, all);
        CAPTURE(i);
        REQUIRE(bool(found) == expected.has_value());
        if (!expected) continue;
        // Condition numbers stay below 10⁵.
        CHECK((found.acceleration - *expected).norm() < 1e-9 * (1 + expected->norm()));
        const FrictionlessImpact pressed = press(s.M, s.f, {s.bilateral.rows, -s.bilateral.acceleration},
                                                 {s.contacts.rows, -s.contacts.acceleration});
        const VectorXd rest = s.M * pressed.after - s.f - s.bilateral.rows.transpose() * pressed.bilateral -
                              s.contacts.rows.transpose() * pressed.contact;
        CHECK(rest.norm() < 1e-9 * (1 + s.f.norm() + pressed.contact.norm()));
        for (int c = 0; c < k; ++c) {
            const double gap = s.contacts.rows.row(c).dot(found.acceleration) - s.contacts.acceleration[c];
            const bool is_closed = std::find(found.closed.begin(), found.closed.end(), c) != found.closed.end();
            CHECK(is_closed == (gap < 1e-8));
        }
        several += found.closed.size() > 1 ? 1 : 0;
    }
    CHECK(several > 50);
}

// Height and two slopes of a plate of unit inertias on four legs at the corners (±1, ±1).
TEST_CASE("contact: of four legs no more than three carry a plate, and none pulls") {
    MatrixXd legs(4, 3);
    legs << 1, 1, 1, 1, 1, -1, 1, -1, 1, 1, -1, -1;
    for (const double a : {0.0, 0.3, -4.0})
        for (const double b : {0.0, 2.0, -0.7}) {
            Situation s{.M = MatrixXd::Identity(3, 3),
                        .f = Eigen::Vector3d(-10, a, b),
                        .bilateral = no_rows(3),
                        .contacts = {legs, VectorXd::Zero(4), VectorXd::Zero(4), VectorXd::Zero(4)}};
            const LastingContacts found = lasting_contacts(s, {0, 1, 2, 3});
            REQUIRE(found);
            CHECK(found.acceleration.norm() < 1e-12);
            CHECK(found.resting == std::vector<int>{0, 1, 2, 3});
            CHECK(found.closed.size() == 3);
            const MatrixXd G = selected(s.contacts, found.closed).rows;
            const VectorXd load = test::solved(G.transpose(), -s.f).value();
            CHECK((G.transpose() * load + s.f).norm() < 1e-12);
            CHECK(load.minCoeff() > -1e-12);
            for (const int k : {0, 1, 2, 3})
                if (std::find(found.closed.begin(), found.closed.end(), k) == found.closed.end())
                    CHECK(is_carried(s, found.closed, k));
        }
}

TEST_CASE("contact: contacts that require contradictory accelerations have no mode") {
    const Situation s{.M = MatrixXd::Identity(1, 1),
                      .f = VectorXd::Zero(1),
                      .bilateral = no_rows(1),
                      .contacts = {Eigen::Vector2d(1, -1), VectorXd::Zero(2), VectorXd::Zero(2),
                                   Eigen::Vector2d(1, 0.5)}};  // y'' ≥ 1, −y'' ≥ 1/2
    CHECK_FALSE(lasting_contacts(s, {0, 1}));
    CHECK(lasting_contacts(s, {0}));
    CHECK(lasting_contacts(s, {1}));
}

// t₁ = √(2h/g), then flights of 2 t₁ eᵏ, all over at t₁ (1 + e)/(1 − e); in 2 (1 + e)/(1 − e) t₁ if thrown up with
// g t₁ from the floor.
TEST_CASE(
    "contact: bounces accumulate at the time of the geometric series, whatever the tolerance, e, or number of "
    "floors") {
    for (const double tolerance : {1e-4, 1e-9, 1e-13, 1e-16})
        for (const double e : {0.05, 0.5, 0.9})
            for (const int floors : {1, 2}) {
                CAPTURE(tolerance);
                CAPTURE(e);
                CAPTURE(floors);
                Ball ball{.e = e, .floors = floors};
                const double first = std::sqrt(2 / g), end = first * (1 + e) / (1 - e);
                const HybridMotion motion =
                    follow(ball.contacts(), ball.mode_of(), {1, 0},
                           {.start = -1, .duration = end + 2, .tolerance = tolerance, .sample = 0.25});
                REQUIRE(motion.ending == Ending::completed);
                double t = -1 + first, flight = 2 * first * e;
                for (const ContactEvent& event : motion.contacts) {
                    if (event.kind != ContactEvent::Kind::impact || event.contact != 0) continue;
                    CHECK(std::abs(event.time - t) < 1e-11);
                    t += flight;
                    flight *= e;
                }
                const ContactEvent& rest = motion.contacts.back();
                CHECK(rest.kind == ContactEvent::Kind::rest);
                CHECK(std::abs(rest.time + 1 - end) < 1e-10);
                CHECK(motion.final_time() == -1 + (end + 2));
                CHECK(std::abs(motion.final_state()[0]) <= std::max(tolerance, 1e-13));
                CHECK(motion.phases.back().closed == std::vector<int>{0});
                // Rows of all phases lie on the grid −1 + k/4 but for the first and last of each.
                for (const Phase& phase : motion.phases)
                    for (std::size_t row = 1; row + 1 < phase.motion.rows(); ++row)
                        CHECK(std::abs(std::remainder(phase.motion.times[row] + 1, 0.25)) < 1e-12);
            }
}

TEST_CASE("contact: a run that ends during the last bounces does not report the rest to come") {
    Ball ball{.e = 0.5};
    const double end = 3 * std::sqrt(2 / g);
    for (const double left : {1e-3, 1e-6}) {
        const HybridMotion motion =
            follow(ball.contacts(), ball.mode_of(), {1, 0}, {.duration = end - left, .tolerance = 1e-6});
        CHECK(motion.final_time() == end - left);
        for (const ContactEvent& event : motion.contacts) CHECK(event.time <= end - left);
        CHECK(std::abs(motion.final_state()[0]) <= g * left * left + 1e-6);
    }
}

// Each impact is placed to 4 ε t, and the speed errs by g times that; n of them shift the n-th impact by n²/2
// flights of it.
TEST_CASE("contact: a thousand impacts without loss keep height and rhythm to what rounding of the time allows") {
    Ball ball{.e = 1};
    const double first = std::sqrt(2 / g), epsilon = 2.2e-16;
    const HybridMotion motion =
        follow(ball.contacts(), ball.mode_of(), {1, 0}, {.duration = 2000 * first, .tolerance = 1e-12});
    REQUIRE(motion.contacts.size() == 1000);
    for (std::size_t k = 0; k < 1000; ++k) {
        const double n = static_cast<double>(k) + 1, t = (2 * n - 1) * first;
        CHECK(std::abs(motion.contacts[k].time - t) < 4 * epsilon * t * n * n);
        CHECK(std::abs(motion.contacts[k].time - t) < 1e-8);
    }
    CHECK(std::abs(motion.final_state()[0] - 1) < 1e-9);
}

// y'' = −3 + t on a floor: it lies until t = 3, then rises by (t − 3)³/6; e = 0 closes at once.
TEST_CASE("contact: a resting contact opens when its reaction vanishes, and rounding does not close it again") {
    std::array<ContactMode, 2> modes;
    for (std::size_t lies = 0; lies < 2; ++lies) {
        modes[lies].system.rhs = make_rhs(2, [lies](double t, const double* y, double* rate) {
            rate[0] = y[1];
            rate[1] = lies != 0 ? 0 : t - 3;
        });
        modes[lies].events = make_events(
            {{.name = "floor"}},
            [lies](double t, const double* y, const double*, double* out) { out[0] = lies != 0 ? 3 - t : y[0]; });
    }
    const Contacts contacts{.names = {"floor"}, .restitution = {0}, .situation = [](double t, const double* y) {
                                return Situation{.M = MatrixXd::Identity(1, 1),
                                                 .f = VectorXd::Constant(1, t - 3),
                                                 .bilateral = no_rows(1),
                                                 .contacts = {MatrixXd::Ones(1, 1), VectorXd::Constant(1, y[0]),
                                                              VectorXd::Zero(1), VectorXd::Zero(1)}};
                            }};
    const HybridMotion motion = follow(
        contacts, [&](const std::vector<int>& closed) -> const ContactMode& { return modes[closed.size()]; },
        {0.5, 0}, {.duration = 6, .tolerance = 1e-12});
    REQUIRE(motion.contacts.size() == 3);  // y = 1/2 − 3 t²/2 + t³/6 = 0
    double t = 0.6;
    for (int i = 0; i < 50; ++i) t -= (0.5 - 1.5 * t * t + t * t * t / 6) / (-3 * t + t * t / 2);
    CHECK(std::abs(motion.contacts[0].time - t) < 1e-11);
    CHECK(motion.contacts[1].kind == ContactEvent::Kind::rest);
    CHECK(motion.contacts[2].kind == ContactEvent::Kind::release);
    CHECK(std::abs(motion.contacts[2].time - 3) < 1e-12);
    CHECK(std::abs(motion.final_state()[0] - 4.5) < 1e-10);
}

}  // namespace runtime_contact
