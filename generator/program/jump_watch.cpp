// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/jump_watch.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "program/motion_system.hpp"

namespace alembert {

namespace {

bool is_reciprocal_of_odd(const Program& p, int id) {
    const Node& node = p[id];
    if (!node.is_reciprocal() || node.is_constant()) return false;
    const Node& below = p[node.args[0]];
    if (below.op != Op::product) return true;
    return std::any_of(below.exponents.begin(), below.exponents.end(), [](int e) { return e % 2 != 0; });
}

}  // namespace

JumpWatch::JumpWatch(const Program& p, const std::vector<double>& parameters)
    : size_(p.coordinates.size() + speeds_of(p)), coordinates_(p.coordinates.size()) {
    std::vector<int> wanted;
    const auto add = [&](int node, Op of) {
        if (std::find(wanted.begin(), wanted.end(), node) != wanted.end()) return;
        wanted.push_back(node);
        names_.emplace_back(name_of(of));
    };
    for (const int id : p.needed(p.right_hand_side())) {
        const Node& node = p[id];
        if (node.is_constant()) continue;
        if (node.op == Op::atan2) add(node.args[0], node.op);
        if (node.op != Op::atan && node.op != Op::tanh && node.op != Op::exp) continue;
        for (const int inner : p.needed(std::vector<int>{node.args[0]}))
            if (is_reciprocal_of_odd(p, inner)) add(p[inner].args[0], node.op);
    }
    borders_ = wanted.size();
    if (borders_ == 0) return;
    const std::vector<int> rates = p.right_hand_side();
    wanted.insert(wanted.end(), rates.begin(), rates.end());
    tape_.emplace(p, std::move(wanted), parameters);
}

void JumpWatch::operator()(double t, const double* state) {
    if (!tape_) return;
    now_.resize(tape_->size());
    (*tape_)(t, state, state + coordinates_, now_.data());
    for (std::size_t k = 0; k < borders_ && !last_.empty(); ++k)
        if (before_[k] * now_[k] < 0) look(t, state, k);
    before_ = now_;
    last_.assign(state, state + size_);
    last_time_ = t;
}

void JumpWatch::look(double t, const double* state, std::size_t border) {
    constexpr double rounding = 1e-10;            // of a rate's size
    constexpr double nearer = 1e-8, near = 1e-5;  // of the step
    std::vector<double> at(size_), value(tape_->size());
    const auto evaluate = [&](double part) -> const std::vector<double>& {
        for (std::size_t i = 0; i < size_; ++i) at[i] = last_[i] + part * (state[i] - last_[i]);
        (*tape_)(last_time_ + part * (t - last_time_), at.data(), at.data() + coordinates_, value.data());
        return value;
    };
    double low = 0, high = 1;
    for (int round = 0; round < 60; ++round) {
        const double middle = (low + high) / 2;
        (evaluate(middle)[border] * before_[border] > 0 ? low : high) = middle;
    }
    const std::vector<double> one = evaluate(low - nearer), other = evaluate(high + nearer),
                              before = evaluate(low - near), after = evaluate(high + near);
    for (std::size_t k = borders_; k < one.size(); ++k) {
        const double size =
            std::max({std::abs(one[k]), std::abs(other[k]), std::abs(before_[k]), std::abs(now_[k])});
        // What a rate without a jump changes between the two places falls with their distance.
        const double change = other[k] - one[k], wider = after[k] - before[k];
        const double jump = change - (wider - change) * nearer / (near - nearer);
        if (std::abs(jump) <= rounding * size) continue;
        const double when = last_time_ + low * (t - last_time_);
        throw IntegrationError(
            say("at t = {:.6g} a rate jumps from {:.6g} to {:.6g}, where {} jumps in it, and derivatives along "
                "the "
                "motion with it; write a function that is smooth there, or end the motion before",
                when, one[k], other[k], names_[border]),
            when, {state, state + size_});
    }
}

}  // namespace alembert
