// SPDX-License-Identifier: MIT
// Motions with signs in the right-hand side, against closed forms.
#include "alembert/hybrid/filippov_system.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "alembert/base/dense.hpp"
#include "alembert/hybrid/minimax_reactions.hpp"

namespace runtime_switching {

using namespace alembert;

namespace {

constexpr double pi = 3.14159265358979323846;

/// A system with one sign: f(y, σ), g(y), and ġ for given y'.
template <typename F, typename G, typename Slope>
FilippovSystem one_sign(int dimension, F f, G g, Slope slope) {
    FilippovSystem system;
    system.names = {"sign(g)"};
    system.rates = [f](double, const double* y, const double* sigma, double* rate) { f(y, sigma[0], rate); };
    system.values = [g, slope](double, const double* y, const double*, const double* rate, double* out) {
        out[0] = g(y);
        out[1] = slope(y, rate);
    };
    system.smooth = [dimension, f](const std::vector<double>& sigma) {
        return make_rhs(dimension, [f, s = sigma[0]](double, const double* y, double* rate) { f(y, s, rate); });
    };
    return system;
}

/// x'' = −ω² x − a sign x'.
FilippovSystem rubbing(double w, double a) {
    return one_sign(
        2,
        [w, a](const double* y, double s, double* rate) {
            rate[0] = y[1];
            rate[1] = -w * w * y[0] - a * s;
        },
        [](const double* y) { return y[1]; }, [](const double*, const double* rate) { return rate[1]; });
}

}  // namespace

TEST_CASE("switching: amplitudes with dry friction fall by 2 a/w² in each half period, until it sticks") {
    const double w = 2, a = 1;
    for (const Method method : {Method::dopri5, Method::dop853, Method::verner98, Method::radau, Method::abm}) {
        CAPTURE(name(method));
        FilippovSystem system = rubbing(w, a);
        std::vector<ModeChange> changes;
        system.on_change = [&](const ModeChange& change) { changes.push_back(change); };
        const double tolerance = method == Method::abm ? 1e-9 : 1e-11;
        const Trajectory motion =
            integrate(system, {2.3, 0}, {.method = method, .duration = 10, .tolerance = tolerance});
        CHECK(motion.ending == Ending::completed);
        // 2.3 → −1.8 → 1.3 → −0.8 → 0.3 → 0.2 within the zone |x| ≤ a/w² = 0.25: it sticks there.
        CHECK(motion.final_state()[0] == doctest::Approx(0.2).epsilon(1e5 * tolerance));
        CHECK(std::abs(motion.final_state()[1]) < 1e-12);
        REQUIRE(changes.size() >= 5);
        CHECK(changes.back().kind == ModeChange::Kind::sliding);
        CHECK(changes.back().time == doctest::Approx(5 * pi / w).epsilon(1e5 * tolerance));
        CHECK(motion.statistics.evaluations < 200'000);
    }
}

TEST_CASE(
    "switching: a block faster than its belt reaches the belt's speed again at the time of the closed form") {
    // x'' = −x − sign(x' − 1) · 1/2 with the belt's speed 1, from rest at 0: it is accelerated by 1/2 until x'
    // = 1.
    FilippovSystem system = one_sign(
        2,
        [](const double* y, double s, double* rate) {
            rate[0] = y[1];
            rate[1] = -y[0] - s / 2;
        },
        [](const double* y) { return y[1] - 1; }, [](const double*, const double* rate) { return rate[1]; });
    std::vector<ModeChange> changes;
    system.on_change = [&](const ModeChange& change) { changes.push_back(change); };
    const Trajectory motion =
        integrate(system, {-2, 1}, {.method = Method::dop853, .duration = 3, .tolerance = 1e-12});
    // At x = −2 the spring's 2 beats 1/2: it goes faster than the belt: (x + 1/2) = A cos + sin with A = −3/2.
    REQUIRE(!changes.empty());
    CHECK(motion.ending == Ending::completed);
    // It is as fast as the belt again where −A sin t + cos t = 1: tan(t/2) = −A = 3/2.
    const double t = 2 * std::atan(1.5);
    CHECK(changes[0].time == doctest::Approx(t).epsilon(1e-10));
}

TEST_CASE("switching: in the potential |x| the period is 4 sqrt(2 x0)") {
    FilippovSystem system = one_sign(
        2,
        [](const double* y, double s, double* rate) {
            rate[0] = y[1];
            rate[1] = -s;
        },
        [](const double* y) { return y[0]; }, [](const double*, const double* rate) { return rate[0]; });
    const double period = 4 * std::sqrt(2.0);
    const Trajectory motion =
        integrate(system, {1, 0}, {.method = Method::dop853, .duration = 5 * period, .tolerance = 1e-10});
    CHECK(motion.final_state()[0] == doctest::Approx(1).epsilon(1e-12));
    CHECK(std::abs(motion.final_state()[1]) < 1e-11);
}

TEST_CASE("switching: rows fall on the grid, as without signs") {
    const Trajectory motion = integrate(
        rubbing(2, 1), {2.3, 0}, {.method = Method::dopri5, .duration = 10, .tolerance = 1e-9, .sample = 0.5});
    REQUIRE(motion.rows() == 21);
    for (std::size_t row = 0; row < motion.rows(); ++row)
        CHECK(motion.times[row] == doctest::Approx(0.5 * static_cast<double>(row)).epsilon(1e-14));
}

TEST_CASE("switching: a state from which two motions are possible is a failure with that message") {
    FilippovSystem system = one_sign(
        1, [](const double*, double s, double* rate) { rate[0] = s; }, [](const double* y) { return y[0]; },
        [](const double*, const double* rate) { return rate[0]; });
    const Trajectory motion = integrate(system, {0}, {.method = Method::dopri5, .duration = 1});
    REQUIRE(motion.failure);
    CHECK(motion.failure->kind == FailureKind::no_side);
    CHECK(motion.failure->message.find("either side") != std::string::npos);
    const Trajectory beside = integrate(system, {1e-9}, {.method = Method::dopri5, .duration = 1});
    CHECK(beside.final_state()[0] == doctest::Approx(1));
}

TEST_CASE("switching: two blocks that rub at once stick together and one by one") {
    // x₁'' = F₁ − sign x₁', x₂'' = F₂ − sign x₂', from rest: F₁ = 0.5 sticks, F₂ = 2 slips with acceleration 1.
    FilippovSystem system;
    system.names = {"first", "second"};
    const auto f = [](double, const double* y, const double* s, double* rate) {
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = 0.5 - s[0];
        rate[3] = 2 - s[1];
    };
    system.rates = f;
    system.values = [](double, const double* y, const double*, const double* rate, double* out) {
        out[0] = y[2];
        out[1] = y[3];
        out[2] = rate[2];
        out[3] = rate[3];
    };
    system.smooth = [f](const std::vector<double>& s) {
        return make_rhs(4, [f, s](double t, const double* y, double* rate) { f(t, y, s.data(), rate); });
    };
    const Trajectory motion = integrate(system, {0, 0, 0, 0}, {.method = Method::dop853, .duration = 2});
    CHECK(std::abs(motion.final_state()[0]) < 1e-14);
    CHECK(motion.final_state()[1] == doctest::Approx(2));
    CHECK(motion.final_state()[3] == doctest::Approx(2));
}

TEST_CASE("even shares: the largest share is the least that a search by golden section finds") {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    const auto matrix = [&](Eigen::Index rows, Eigen::Index columns) {
        return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); }));
    };
    for (int trial = 0; trial < 50; ++trial) {
        CAPTURE(trial);
        const std::vector<ReactionBound> contacts = {{0, 2, 1.0}, {2, 1, 1.5}, {3, 2, 0.7}, {5, 2, 1.2}};
        const Eigen::VectorXd given = matrix(7, 1);
        const Eigen::MatrixXd free = matrix(7, 2);
        const auto largest = [&](const Eigen::VectorXd& alpha) {
            double share = 0;
            for (const ReactionBound& c : contacts)
                share = std::max(share, alpha.segment(c.first, c.size).norm() / c.bound);
            return share;
        };
        // The least of a convex function between −50 and 50.
        const auto least = [](const auto& function) {
            const double part = (std::sqrt(5.0) - 1) / 2;
            double low = -50, high = 50;
            while (high - low > 1e-9) {
                const double a = high - part * (high - low), b = low + part * (high - low);
                (function(a) < function(b) ? high : low) = function(a) < function(b) ? b : a;
            }
            return function((low + high) / 2);
        };
        const double found = least([&](double z0) {
            return least([&](double z1) { return largest(given + free * Eigen::Vector2d(z0, z1)); });
        });
        const Eigen::VectorXd even = minimax_reactions(given, free, contacts);
        CHECK(largest(even) == doctest::Approx(found).epsilon(1e-7));
        CHECK(largest(even) <= found * (1 + 1e-12));
        // It is reached within what is free.
        const Eigen::VectorXd change = even - given;
        CHECK((free * least_norm(free, change).x - change).norm() < 1e-9 * (1 + even.norm()));
    }
    CHECK(minimax_reactions(Eigen::Vector2d(3, 4), Eigen::MatrixXd(2, 0), {{0, 2, 1.0}}) == Eigen::Vector2d(3, 4));
    // Two equal contacts share a load, whatever they had.
    const Eigen::VectorXd two = minimax_reactions(Eigen::Vector4d(0.3, 0.1, 1.7, -0.1),
                                                  (Eigen::MatrixXd(4, 2) << 1, 0, 0, 1, -1, 0, 0, -1).finished(),
                                                  {{0, 2, 2.0}, {2, 2, 2.0}});
    CHECK((two - Eigen::Vector4d(1, 0, 1, 0)).norm() < 1e-7);
}

}  // namespace runtime_switching
