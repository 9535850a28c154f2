// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/along.hpp"

#include <algorithm>

#include "alembert/base/argument.hpp"
#include "alembert/base/error.hpp"
#include "alembert/ode/integrate.hpp"
#include "base/language/say.hpp"
#include "program/jump_watch.hpp"
#include "program/lower/lower.hpp"
#include "program/switches.hpp"

namespace alembert {

namespace {

constexpr double strictest =
    1e-10;  // of the motion, unless another tolerance is given: constraints are kept by it

/// The equations of motion, evaluated by the interpreter.
class Motion {
public:
    Motion(const Derived& d, const Start& start) : program_(lowered(d).program), state_(start.state()) {
        if (program_.singular)
            throw IntegrationError(failure_at(d, state_of(start, d.mechanism, d.equations))
                                       .value_or(say("the mass matrix is singular")),
                                   start.t, start.q);
        rates_ = program_.nodes_of(Group::rate);
        accelerations_ = program_.nodes_of(Group::acceleration);
        std::vector<int> wanted = rates_;
        wanted.insert(wanted.end(), accelerations_.begin(), accelerations_.end());
        needed_ = program_.needed(wanted);
    }

    int size() const { return static_cast<int>(state_.q.size() + accelerations_.size()); }
    const Program& program() const { return program_; }

    void operator()(double t, const double* y, double* rate) {
        const std::vector<double> value = at(t, y);
        for (const double x : rates_of(value)) *rate++ = x;
        for (const int node : accelerations_) *rate++ = value[static_cast<std::size_t>(node)];
    }

    /// q' at a state.
    std::vector<double> rates(double t, const double* y) { return rates_of(at(t, y)); }

private:
    std::vector<double> at(double t, const double* y) {
        const auto n = static_cast<std::ptrdiff_t>(state_.q.size());
        state_.t = t;
        state_.q.assign(y, y + n);
        state_.qdot.assign(y + n, y + n + static_cast<std::ptrdiff_t>(accelerations_.size()));
        return interpret_nodes(program_, state_, needed_);
    }
    std::vector<double> rates_of(const std::vector<double>& value) const {
        if (program_.speeds.empty()) return state_.qdot;
        std::vector<double> result;
        for (const int node : rates_) result.push_back(value[static_cast<std::size_t>(node)]);
        return result;
    }

    Program program_;
    State<double> state_;
    std::vector<int> rates_, accelerations_, needed_;
};

void check_smooth(const Mechanism& m) {
    if (m.has_modes())
        throw ModelError(
            say("the first approximation is taken along smooth motions; this scene has contacts, dry friction or "
                "events that change the motion, at which deviations jump"));
}

}  // namespace

std::vector<Start> states_along(const Derived& d, const Start& start, const AlongOptions& wishes) {
    if (wishes.duration) argument::need_nonnegative("duration", *wishes.duration);
    if (wishes.tolerance) argument::need_positive("tolerance", *wishes.tolerance);
    if (wishes.sample) argument::need_positive("sample", *wishes.sample);
    check_smooth(d.mechanism);
    Motion motion(d, start);
    if (jumps_along_motion(motion.program()))
        throw ModelError(say(
            "the first approximation is taken along smooth motions; here accelerations jump where the argument "
            "of a 'sign' is zero or a table has a corner, and deviations with them; write a smooth function in "
            "its place, or take interpolation = \"cubic\""));
    JumpWatch watch(motion.program(), start.parameters);
    std::vector<double> initial = start.q;
    const State<double> first = state_of(start, d.mechanism, d.equations);
    initial.insert(initial.end(), first.qdot.begin(), first.qdot.end());
    const double duration = wishes.duration.value_or(start.duration);
    const Trajectory found = integrate(
        make_rhs(motion.size(), [&](double t, const double* y, double* rate) { motion(t, y, rate); }), initial,
        {.start = start.t,
         .duration = duration,
         .tolerance = wishes.tolerance.value_or(std::min(start.tolerance, strictest)),
         .sample = wishes.sample.value_or(start.sample),
         .when_stiff = Method::radau,
         .on_step = [&](double t, std::span<const double> y, std::span<const double>) {
             watch(t, y.data());
             if (wishes.progress && duration > 0) wishes.progress(say("integrating"), (t - start.t) / duration);
         }});
    if (found.failure) throw_failure(*found.failure);
    std::vector<Start> states;
    const bool own_speeds = !d.equations.speeds_are_rates() && !start.speeds.empty();
    for (std::size_t row = 0; row < found.times.size(); ++row) {
        const auto y = found.state(row);
        Start& one = states.emplace_back(start);
        one.t = found.times[row];
        one.q.assign(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(start.q.size()));
        one.qdot = motion.rates(one.t, y.data());
        if (own_speeds) one.speeds.assign(y.begin() + static_cast<std::ptrdiff_t>(start.q.size()), y.end());
    }
    return states;
}

}  // namespace alembert
