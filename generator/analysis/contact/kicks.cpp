// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/contact/kicks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "alembert/base/tolerances.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace

KickView::KickView(const Mechanism& m) : program_(begun(m)) {
    std::vector<ex> values;
    for (const Mechanism::Definition& event : m.events) values.push_back(event.value);
    std::vector<ex> wanted = values;
    const std::vector<ex> slopes = m.time_derivative(values);
    const std::vector<ex> bends = m.time_derivative(slopes);  // without q''', if `when` contains rates
    wanted.insert(wanted.end(), slopes.begin(), slopes.end());
    wanted.insert(wanted.end(), bends.begin(), bends.end());
    for (const ex& value : values) {
        const std::vector<ex> gradient = m.z->pull_back({{value, 1}}, m.q);
        wanted.insert(wanted.end(), gradient.begin(), gradient.end());
    }
    for (const Mechanism::Speed& speed : m.speeds) wanted.push_back(speed.form);
    for (const Mechanism::EventAction& event : m.event_actions) {
        wanted.insert(wanted.end(), event.impulse.begin(), event.impulse.end());
        for (const auto* list : {&event.set, &event.rates})
            for (const auto& one : *list) wanted.push_back(one.second);
    }
    const std::vector<int> nodes = lower_expressions(program_, m, wanted);
    auto next = nodes.begin();
    const auto taken = [&next](std::size_t count) {
        const auto first = next;
        next += static_cast<std::ptrdiff_t>(count);
        return std::vector<int>(first, next);
    };
    values_ = taken(m.events.size());
    slopes_ = taken(m.events.size());
    bends_ = taken(m.events.size());
    for (std::size_t k = 0; k < m.events.size(); ++k) gradients_.push_back(taken(m.q.size()));
    speeds_ = taken(m.speeds.size());
    for (const Mechanism::EventAction& event : m.event_actions) {
        impulses_.push_back(taken(event.impulse.size()));
        for (const auto& [list, to] : {std::pair(&event.set, &set_), std::pair(&event.rates, &rates_)}) {
            to->emplace_back();
            for (const auto& one : *list) to->back().push_back({one.first, taken(1)[0]});
        }
    }
    for (const Mechanism::Definition& event : m.events) names_.push_back(event.name);
    for (const GiNaC::symbol& q : m.q) coordinates_.push_back(q.get_name());
}

Eigen::VectorXd KickView::change_of_rates(int event, const State<double>& before) const {
    const std::vector<Given>& list = rates_[static_cast<std::size_t>(event)];
    Eigen::VectorXd result;
    if (list.empty()) return result;
    const std::vector<double> value = interpret(program_, before);
    result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(coordinates_.size()));
    for (const Given& one : list)
        result[one.index] =
            value[static_cast<std::size_t>(one.node)] - before.qdot[static_cast<std::size_t>(one.index)];
    return result;
}

std::optional<std::string> KickView::refusal(int event, const State<double>& before,
                                             const State<double>& after) const {
    constexpr double same = 1e-9;
    const std::vector<double> value = interpret(program_, before);
    double size = 0;
    for (const double rate : after.qdot) size = std::max(size, std::abs(rate));
    for (const Given& one : rates_[static_cast<std::size_t>(event)]) {
        const auto i = static_cast<std::size_t>(one.index);
        const double wanted = value[static_cast<std::size_t>(one.node)];
        if (std::abs(after.qdot[i] - wanted) <= same * std::max(size, std::abs(wanted))) continue;
        return say(
            "event '{0}' sets {1}' = {2:.6g} at t = {3:.6g}, and constraints, contacts or another event make "
            "it {4:.6g}; set rates that these allow, or give an impulse",
            names_[static_cast<std::size_t>(event)], coordinates_[i], wanted, before.t, after.qdot[i]);
    }
    return {};
}

void KickView::set(int event, const State<double>& before, double* after) const {
    const std::vector<Given>& list = set_[static_cast<std::size_t>(event)];
    if (list.empty()) return;
    const std::vector<double> value = interpret(program_, before);
    for (const Given& one : list)
        after[2 * coordinates_.size() + static_cast<std::size_t>(one.index)] =
            value[static_cast<std::size_t>(one.node)];
}

Eigen::VectorXd KickView::impulse(int event, const State<double>& state) const {
    const std::vector<int>& nodes = impulses_[static_cast<std::size_t>(event)];
    if (nodes.empty()) return {};
    const std::vector<double> value = interpret(program_, state);
    Eigen::VectorXd result(static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i) result[static_cast<Eigen::Index>(i)] = value[nodes[i]];
    return result;
}

std::vector<PassedZero> KickView::passed(const State<double>& before, const State<double>& after) const {
    const std::vector<double> a = interpret(program_, before), b = interpret(program_, after);
    std::vector<PassedZero> result;
    for (std::size_t k = 0; k < values_.size(); ++k) {
        const double value = b[values_[k]], slope = b[slopes_[k]], bend = b[bends_[k]];
        double size = size_of_terms(program_, values_[k], b);
        const bool has_jumped = std::abs(value - a[values_[k]]) > tolerance::jump * size;
        const double rounding = 2 * std::abs(value) + 16 * epsilon * size;
        for (std::size_t i = 0; i < after.q.size(); ++i)
            size += std::abs(b[gradients_[k][i]]) * std::max(1.0, std::abs(after.q[i]));
        PassedZero one{.is_zero = std::abs(value) <= 16 * epsilon * size, .slope = a[slopes_[k]], .size = size};
        if (has_jumped) {  // the value itself decides
        } else if (std::abs(slope) > tolerance::jump * std::abs(one.slope)) {
            one.side = slope > 0 ? 1 : -1;
            one.hold = rounding / std::abs(slope);
            if (slope * bend < 0)
                one.hold = std::min(one.hold, std::abs(slope / bend) / 2);  // a quarter of the flight
        } else if (std::abs(bend) > tolerance::jump * size_of_terms(program_, bends_[k], b)) {
            one.side = bend > 0 ? 1 : -1;
            one.hold = std::sqrt(2 * rounding / std::abs(bend));
        } else {
            one.band = tolerance::passed_zero * size;
        }
        result.push_back(one);
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
