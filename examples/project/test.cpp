// SPDX-License-Identifier: MIT
// The systems as this program has them: parameters in SI units, whatever the scene gives them in; a torque that is
// set; the energy; and the tables of the runtime, which are those of the same functions.
#include <alembert/runtime.hpp>
#include <cmath>
#include <cstdio>

#include "crane.hpp"
#include "pendulum.hpp"

namespace {

int failures = 0;

void check(bool holds, const char* what) {
    if (holds) return;
    std::printf("does not hold: %s\n", what);
    ++failures;
}

bool is_near(double a, double b) {
    return std::abs(a - b) <= 1e-13 * (1 + std::abs(b));
}

}  // namespace

int main() {
    const double degree = std::acos(-1) / 180;
    pendulum::Parameters par;
    check(is_near(par.l, 0.25), "l is 0.25 m");
    check(is_near(par.tilt, 5 * degree), "tilt is 5 degrees in radians");
    check(is_near(pendulum::initial_state.theta, 60 * degree), "theta begins at 60 degrees");
    par.tilt = 0;
    par.tau = 0.1;
    pendulum::prepare(par);
    const pendulum::State y = pendulum::initial_state, rate = pendulum::rhs(0, y, par);
    check(is_near(rate.theta, y.theta_dot), "the rate of theta");
    check(is_near(rate.theta_dot, -9.81 / 0.25 * std::sin(y.theta) + 0.1 / (0.2 * 0.25 * 0.25)),
          "the acceleration");
    const pendulum::Energy energy = pendulum::energy(0, y, rate, par);
    check(is_near(energy.potential, -0.2 * 9.81 * 0.25 * std::cos(y.theta)), "the potential energy");
    check(energy.kinetic == 0, "the kinetic energy at rest");

    const alembert::Module one = alembert::linked(pendulum::tables()), two = alembert::linked(crane::tables());
    check(one.table().coordinates == 1 && two.table().coordinates == 2, "two systems, each with its own table");
    pendulum::State again;
    one.table().rhs(0, pendulum::numbers(y), pendulum::numbers(par), pendulum::numbers(again));
    check(again.theta_dot == rate.theta_dot, "the table has the same function");
    return failures == 0 ? 0 : 1;
}
