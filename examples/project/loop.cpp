// SPDX-License-Identifier: MIT
// Two systems in one program, each in a thread of its own: a controller moves the trolley of a crane by 2 m, and
// the runtime integrates a pendulum, of which nothing is compiled or loaded while the program runs.
#include <alembert/runtime.hpp>
#include <cmath>
#include <cstdio>
#include <thread>

#include "crane.hpp"
#include "pendulum.hpp"

namespace {

/// One step of the classical method of Runge and Kutta.
crane::State stepped(double t, double h, const crane::State& y, const crane::Parameters& par) {
    const auto moved = [&](double by, const crane::State& rate) {
        crane::State at = y;
        for (int i = 0; i < crane::state_size; ++i) crane::numbers(at)[i] += by * crane::numbers(rate)[i];
        return at;
    };
    const crane::State k1 = crane::rhs(t, y, par), k2 = crane::rhs(t + h / 2, moved(h / 2, k1), par),
                       k3 = crane::rhs(t + h / 2, moved(h / 2, k2), par),
                       k4 = crane::rhs(t + h, moved(h, k3), par);
    crane::State next = moved(h / 6, k1);
    for (int i = 0; i < crane::state_size; ++i)
        crane::numbers(next)[i] +=
            h / 6 * (2 * crane::numbers(k2)[i] + 2 * crane::numbers(k3)[i] + crane::numbers(k4)[i]);
    return next;
}

}  // namespace

int main() {
    crane::State y = crane::initial_state;
    std::thread control([&] {
        crane::Parameters par = crane::defaults();
        const double h = 0.005;
        for (int k = 0; k < 6000; ++k) {
            par.F = 80 * (2 - y.x) - 180 * y.x_dot + 450 * y.theta - 100 * y.theta_dot;
            crane::prepare(par);
            y = stepped(k * h, h, y, par);
        }
    });
    double angle = 0;
    std::thread motion([&] {
        const alembert::Module module = alembert::linked(pendulum::tables());
        const double* const start = pendulum::numbers(pendulum::initial_state);
        const alembert::Trajectory swing =
            alembert::integrate(alembert::make_rhs(module), {start, start + pendulum::state_size},
                                {.method = alembert::Method::dop853, .duration = 10, .tolerance = 1e-12});
        angle = swing.state(swing.times.size() - 1)[0];
    });
    control.join();
    motion.join();
    std::printf("the trolley is %.3f m from its goal, the rope %.3f rad from the vertical\n", std::abs(2 - y.x),
                std::abs(y.theta));
    std::printf("the pendulum is at %.6f rad after 10 s\n", angle);
}
