// SPDX-License-Identifier: GPL-2.0-or-later
// Boost.odeint: Fehlberg's pair of order 8, Dormand's and Prince's of order 5, and Bulirsch's and Stoer's
// extrapolation.
#include <boost/numeric/odeint.hpp>

#include "peers.hpp"

namespace alembert::peers {

namespace {

namespace ode = boost::numeric::odeint;
using State = std::vector<double>;

struct TooMany {};

template <class Stepper>
Answer solve(const Task& task, Stepper stepper) {
    Answer answer{.failed = false, .state = task.initial, .evaluations = 0, .steps = 0};
    const auto rate = [&](const State& y, State& out, double t) {
        if (++answer.evaluations > task.budget) throw TooMany{};
        task.rhs(t, y.data(), out.data());
    };
    try {
        answer.steps = static_cast<long>(ode::integrate_adaptive(stepper, rate, answer.state, task.start, task.end,
                                                                 (task.end - task.start) * 1e-6));
    } catch (const TooMany&) {
        answer.failed = true;
    } catch (const std::exception&) {
        answer.failed = true;
    }
    return answer;
}

}  // namespace

std::vector<Peer> odeint() {
    return {{"odeint", "rkf78",
             [](const Task& task) {
                 return solve(task, ode::make_controlled(task.tolerance, task.tolerance,
                                                         ode::runge_kutta_fehlberg78<State>()));
             }},
            {"odeint", "dopri5",
             [](const Task& task) {
                 return solve(
                     task, ode::make_controlled(task.tolerance, task.tolerance, ode::runge_kutta_dopri5<State>()));
             }},
            {"odeint", "bulirsch-stoer", [](const Task& task) {
                 return solve(task, ode::bulirsch_stoer<State>(task.tolerance, task.tolerance));
             }}};
}

}  // namespace alembert::peers
