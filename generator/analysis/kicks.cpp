// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/kicks.hpp"

#include <cmath>
#include <limits>

#include "analysis/assemble.hpp"
#include "lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double negligible = 1e-9;

}  // namespace

KickView::KickView(const Mechanism& m) : program_(begun(m)) {
    std::vector<ex> values;
    for (const Part& event : m.events) values.push_back(event.value);
    std::vector<ex> wanted = values;
    const std::vector<ex> slopes = m.time_derivative(values);
    wanted.insert(wanted.end(), slopes.begin(), slopes.end());
    for (const Mechanism::Speed& speed : m.speeds) wanted.push_back(speed.form);
    for (const Mechanism::Occasion& event : m.occasions) wanted.insert(wanted.end(), event.impulse.begin(), event.impulse.end());
    const std::vector<int> nodes = lower_expressions(program_, m, wanted);
    auto next = nodes.begin();
    const auto taken = [&next](std::size_t count) {
        const auto first = next;
        next += static_cast<std::ptrdiff_t>(count);
        return std::vector<int>(first, next);
    };
    values_ = taken(m.events.size());
    slopes_ = taken(m.events.size());
    speeds_ = taken(m.speeds.size());
    for (const Mechanism::Occasion& event : m.occasions) impulses_.push_back(taken(event.impulse.size()));
}

Eigen::VectorXd KickView::impulse(int event, const State<double>& state) const {
    const std::vector<int>& nodes = impulses_[static_cast<std::size_t>(event)];
    const std::vector<double> value = interpret(program_, state);
    Eigen::VectorXd result(static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i) result[static_cast<Eigen::Index>(i)] = value[nodes[i]];
    return result;
}

std::vector<double> KickView::passed(const State<double>& before, const State<double>& after) const {
    const std::vector<double> a = interpret(program_, before), b = interpret(program_, after);
    std::vector<double> result;
    for (std::size_t k = 0; k < values_.size(); ++k) {
        const int g = values_[k], slope = slopes_[k];
        if (std::abs(b[g] - a[g]) > negligible * size_of_terms(program_, g, b))
            result.push_back(b[g]);
        else if (std::abs(b[slope]) <= negligible * std::abs(a[slope]))
            result.push_back(0);
        else
            result.push_back(std::copysign(std::numeric_limits<double>::min(), b[slope]));
    }
    return result;
}

std::vector<double> KickView::speeds(const State<double>& state) const {
    const std::vector<double> value = interpret(program_, state);
    std::vector<double> result;
    for (const int node : speeds_) result.push_back(value[node]);
    return result;
}

}  // namespace alembert
