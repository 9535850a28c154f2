// SPDX-License-Identifier: MIT
// rattle on systems written by hand, held against dop853 in a coordinate that needs no constraint.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "alembert/ode/hamiltonian_system.hpp"
#include "alembert/ode/integrate.hpp"

namespace runtime_rattle {

using namespace alembert;

namespace {

constexpr double g = 9.81;

/// A bead on the curve r = 1 + c cos θ in a vertical plane, θ from the downward vertical, in (r, θ): M = diag(1,
/// r²), L = (r'² + r²θ'²)/2 + g r cos θ. For c = 0 a pendulum.
struct Bead {
    double c;
    double r(double a) const { return 1 + c * std::cos(a); }
    double slope(double a) const { return -c * std::sin(a); }
    /// I(θ) = r'² + r², as θ alone has it: I θ'' + I_θ θ'²/2 = d(g r cos θ)/dθ.
    double inertia(double a) const { return slope(a) * slope(a) + r(a) * r(a); }
    double inertia_slope(double a) const { return 2 * slope(a) * (-c * std::cos(a)) + 2 * r(a) * slope(a); }
    double energy(const double* y) const {
        return (y[2] * y[2] + y[0] * y[0] * y[3] * y[3]) / 2 - g * y[0] * std::cos(y[1]);
    }

    Rhs by_angle() const {
        return make_rhs(2, [*this](double, const double* y, double* rate) {
            const double pull = g * (slope(y[0]) * std::cos(y[0]) - r(y[0]) * std::sin(y[0]));
            rate[0] = y[1];
            rate[1] = (pull - inertia_slope(y[0]) * y[1] * y[1] / 2) / inertia(y[0]);
        });
    }

    /// In (r, θ, r', θ'); the rates at the ends of steps are those of the angle.
    Rhs constrained() const {
        Rhs rhs = make_rhs(4, [*this, angle = by_angle()](double t, const double* y, double* rate) {
            const double own[2] = {y[1], y[3]};
            double motion[2];
            angle(t, own, motion);
            rate[0] = y[2], rate[1] = y[3], rate[3] = motion[1];
            rate[2] = -c * (std::cos(y[1]) * y[3] * y[3] + std::sin(y[1]) * motion[1]);
        });
        rhs.canonical = std::make_shared<const HamiltonianSystem>(HamiltonianSystem{
            .coordinates = 2,
            .constraints = 1,
            .form =
                [](double, const double* y, double* out) {
                    const double list[] = {1,
                                           0,
                                           y[0] * y[0],
                                           y[2],
                                           y[0] * y[0] * y[3],
                                           y[0] * y[3] * y[3] + g * std::cos(y[1]),
                                           -g * y[0] * std::sin(y[1])};
                    std::copy(std::begin(list), std::end(list), out);
                },
            .held =
                [*this](double, const double* y, double* position, double* velocity, double* rows) {
                    position[0] = y[0] - r(y[1]);
                    rows[0] = 1, rows[1] = -slope(y[1]);
                    velocity[0] = y[2] + rows[1] * y[3];
                }});
        return rhs;
    }

    std::vector<double> start(double angle, double speed) const {
        return {r(angle), angle, slope(angle) * speed, speed};
    }
};

/// Two angles: a double pendulum of unit masses and lengths, M(q), no constraint.
Rhs double_pendulum() {
    const auto form = [](double, const double* y, double* out) {
        const double c = std::cos(y[0] - y[1]), s = std::sin(y[0] - y[1]);
        const double list[] = {2,
                               c,
                               1,
                               2 * y[2] + c * y[3],
                               c * y[2] + y[3],
                               -s * y[2] * y[3] - 2 * g * std::sin(y[0]),
                               s * y[2] * y[3] - g * std::sin(y[1])};
        std::copy(std::begin(list), std::end(list), out);
    };
    Rhs rhs = make_rhs(4, [](double, const double* y, double* rate) {
        const double c = std::cos(y[0] - y[1]), s = std::sin(y[0] - y[1]);
        const double f = -s * y[3] * y[3] - 2 * g * std::sin(y[0]), h = s * y[2] * y[2] - g * std::sin(y[1]);
        rate[0] = y[2], rate[1] = y[3];
        rate[2] = (f - c * h) / (2 - c * c), rate[3] = (2 * h - c * f) / (2 - c * c);
    });
    rhs.canonical = std::make_shared<const HamiltonianSystem>(
        HamiltonianSystem{.coordinates = 2, .constraints = 0, .form = form, .held = {}});
    return rhs;
}

double error_of(const Bead& bead, Method method, int steps, double duration) {
    const Trajectory exact = integrate(bead.by_angle(), {1.0, 0.5}, {.duration = duration, .tolerance = 1e-15});
    const Trajectory motion =
        integrate(bead.constrained(), bead.start(1, 0.5),
                  {.method = method, .duration = duration, .step = duration / steps, .sample = duration});
    REQUIRE(motion.ending == Ending::completed);
    return std::max(std::abs(motion.final_state()[1] - exact.final_state()[0]),
                    std::abs(motion.final_state()[3] - exact.final_state()[1]));
}

double order_of(const Bead& bead, Method method, int steps, double duration) {
    const double coarse = error_of(bead, method, steps, duration),
                 fine = error_of(bead, method, 2 * steps, duration);
    MESSAGE(name(method) << ", c = " << bead.c << ", " << steps << " steps: errors " << coarse << " " << fine
                         << ", order " << std::log2(coarse / fine));
    return std::log2(coarse / fine);
}

}  // namespace

TEST_CASE(
    "rattle: the error against the angle alone falls with the order, for constant and for changing mass "
    "matrices") {
    for (const double c : {0.0, 0.3}) {
        CHECK(std::abs(order_of({c}, Method::rattle, 400, 2) - 2) < 0.1);
        CHECK(std::abs(order_of({c}, Method::rattle8, 20, 2) - 8) < 0.3);
    }
    const auto error = [](Method method, int steps) {
        const std::vector<double> start = {1.0, -0.5, 0.3, 0.7};
        const Trajectory exact = integrate(double_pendulum(), start, {.duration = 2, .tolerance = 1e-15});
        const Trajectory motion = integrate(double_pendulum(), start,
                                            {.method = method, .duration = 2, .step = 2. / steps, .sample = 2});
        double worst = 0;
        for (std::size_t i = 0; i < 4; ++i)
            worst = std::max(worst, std::abs(motion.final_state()[i] - exact.final_state()[i]));
        return worst;
    };
    CHECK(std::abs(std::log2(error(Method::rattle, 1000) / error(Method::rattle, 2000)) - 2) < 0.1);
}

TEST_CASE("rattle: constraints hold at every row, also between steps, and the energy comes back") {
    const Bead bead{0.3};
    for (const Method method : {Method::rattle, Method::rattle8}) {
        const double step = method == Method::rattle ? 0.01 : 0.1;
        double first = 0, last = 0;
        const std::vector<double> start = bead.start(1, 0.5);
        const double energy = bead.energy(start.data());
        const Trajectory motion =
            integrate(bead.constrained(), start,
                      {.method = method,
                       .duration = 1000,
                       .step = step,
                       .sample = 0.37,
                       .on_step = [&](double t, std::span<const double> y, std::span<const double>) {
                           double& worst = t < 100 ? first : last;
                           if (t < 100 || t > 900)
                               worst = std::max(worst, std::abs(bead.energy(y.data()) - energy));
                       }});
        REQUIRE(motion.ending == Ending::completed);
        for (std::size_t row = 0; row < motion.rows(); ++row) {
            const auto y = motion.state(row);
            CHECK(std::abs(y[0] - bead.r(y[1])) < 1e-14);
            CHECK(std::abs(y[2] - bead.slope(y[1]) * y[3]) < 1e-13);
        }
        MESSAGE(name(method) << ": energy errors " << first << " and " << last);
        CHECK(first < (method == Method::rattle ? 1e-2 : 1e-6));
        CHECK(last < 1.05 * first + 1e-12);  // bounded; rounding alone walks
    }
}

TEST_CASE("rattle: the way back with all rates turned round ends at the start") {
    const Bead bead{0.3};
    const Options options{.method = Method::rattle, .duration = 20, .step = 0.02, .sample = 20};
    const std::vector<double> start = bead.start(1, 0.5);
    Trajectory motion = integrate(bead.constrained(), start, options);
    std::vector<double> end(motion.final_state().begin(), motion.final_state().end());
    CHECK(std::abs(end[1] - start[1]) > 0.1);
    end[2] = -end[2], end[3] = -end[3];
    motion = integrate(bead.constrained(), end, options);
    CHECK(std::abs(motion.final_state()[1] - start[1]) < 1e-11);
    CHECK(std::abs(motion.final_state()[3] + start[3]) < 1e-11);
}

// In the phase plane of θ and p = I(θ) θ' each step preserves area. The error of central differences is some 1e-9;
// that of a step which projects, and is of order 2 too, some h³ = 1e-3.
TEST_CASE("rattle: a step preserves area in the angle and its momentum") {
    const Bead bead{0.3};
    for (const Method method : {Method::rattle, Method::rattle8}) {
        const auto map = [&](double angle, double p) {
            const Trajectory step = integrate(bead.constrained(), bead.start(angle, p / bead.inertia(angle)),
                                              {.method = method, .duration = 0.1, .step = 0.1, .sample = 0.1});
            REQUIRE(step.ending == Ending::completed);
            const double a = step.final_state()[1];
            return std::pair(a, bead.inertia(a) * step.final_state()[3]);
        };
        const double d = 1e-4;
        const auto [a, b] = map(1 + d, 0.5);
        const auto [a_, b_] = map(1 - d, 0.5);
        const auto [e, f] = map(1, 0.5 + d);
        const auto [e_, f_] = map(1, 0.5 - d);
        const double area = ((a - a_) * (f - f_) - (b - b_) * (e - e_)) / (4 * d * d);
        INFO(name(method) << ": " << area);
        CHECK(std::abs(area - 1) < 1e-8);
    }
}

TEST_CASE("rattle: a right-hand side without momenta is refused") {
    CHECK_THROWS_AS(
        integrate(Bead{0}.by_angle(), {1.0, 0.5}, {.method = Method::rattle, .duration = 1, .step = 0.1}),
        std::invalid_argument);
}

}  // namespace runtime_rattle
