// SPDX-License-Identifier: MIT
#pragma once

/// Changes of a run that are a few times as large as its rounding. The run is repeated with them, and the
/// difference shows what rounding does to the result.
///
///     Options again = options;
///     again.disturbed.seed = 1;           // another seed gives other changes of the same size
///     const Trajectory motion = integrate(rhs, start, again);
///
/// A right-hand side is evaluated at a rounded time and a rounded state, and is rounded itself. Where it is steep
/// this may change it much: at a pulse of the width w near x = a by a part of a ε/w. So to the end of each
/// step of length h is added
///
///     h (f(t (1 + ξ₀), y_i (1 + ξ_i)) − f(t, y)) + h ξ' f
///
/// t and y being those at the start of the step. Each ξ is ± a random number between ε and 3 ε, and ξ₀ = 0 for
/// power series, which begin at a given time. (The sums y + h … of the methods are compensated.) A component that
/// rests is exact and remains so.
///
/// The time at which a jump of the motion was found is rounded too. If it is off by τ, the motion after the jump
/// is off by τ (f before − f after), which is added with the first step after it (RunPiece::late).

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "alembert/ode/rhs.hpp"

namespace alembert {

/// Random numbers that depend on the seed and the time at which a piece of a run begins.
class Flutter {
public:
    Flutter(std::uint64_t seed, double start)
        : state_(seed * 0x9e3779b97f4a7c15U + std::bit_cast<std::uint64_t>(start)) {}

    /// ± a number between ε and 3 ε.
    double operator()() {
        const std::uint64_t bits = next();
        const double share = static_cast<double>(bits >> 11) * 0x1p-53;
        const double size = (1 + 2 * share) * std::numeric_limits<double>::epsilon();
        return (bits & 1) != 0 ? size : -size;
    }

private:
    /// SplitMix64 (Steele, Lea & Flood, OOPSLA 2014).
    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31);
    }

    std::uint64_t state_;
};

/// A jump of a motion: its time, its number among the jumps of the run, and the rates before and after it.
/// `jumped` are components that jump themselves; it may be empty.
struct Jump {
    double t;
    long number;
    std::span<const double> before, after;
    std::vector<bool> jumped = {};
};

/// What the motion after a jump is off by, because the time of the jump is rounded. Of components that jump, the
/// sizes are added, because the change of their jump is not known. With odd seeds all jumps come too late, with
/// even seeds by turns too late and too early: what two jumps do cannot cancel in both.
inline std::vector<double> late_by_rounding(std::uint64_t seed, const Jump& jump) {
    Flutter flutter(~seed, jump.t);
    const double size = 2 * std::abs(flutter() * jump.t),
                 off = seed % 2 == 0 && jump.number % 2 == 1 ? -size : size;
    const auto& [t, number, before, after, jumped] = jump;
    std::vector<double> late(before.size());
    for (std::size_t i = 0; i < late.size(); ++i)
        late[i] =
            off * (!jumped.empty() && jumped[i] ? std::abs(before[i]) + std::abs(after[i]) : before[i] - after[i]);
    return late;
}

class Disturbance {
public:
    /// `late`: what the first step begins too late by; may be empty.
    Disturbance(std::uint64_t seed, std::vector<double> late, double start)
        : late_(std::move(late)), flutter_(seed, start) {}

    /// The start of a step of length h.
    struct Start {
        double t, h;
        bool rounds_time;  ///< whether the method evaluates at times between the ends of steps
        const double *state, *rate;
    };

    /// Adds the changes to the end of a step.
    void operator()(const Rhs& rhs, const Start& from, double* end) {
        const auto size = static_cast<std::size_t>(rhs.dimension);
        moved_.assign(from.state, from.state + size);
        rate_.resize(size);
        for (std::size_t i = 0; i < size; ++i)
            if (end[i] != from.state[i]) moved_[i] *= 1 + flutter_();
        rhs(from.rounds_time ? from.t * (1 + flutter_()) : from.t, moved_.data(), rate_.data());
        ++evaluations_;
        for (std::size_t i = 0; i < size; ++i) {
            if (end[i] == from.state[i]) continue;
            const double change = from.h * ((rate_[i] - from.rate[i]) + flutter_() * from.rate[i]);
            if (std::isfinite(change)) end[i] += change;
        }
        if (!late_.empty()) be_late(rhs, from, end);
    }

    /// The step was accepted.
    void accept() { late_.clear(); }

    long evaluations() const { return evaluations_; }

private:
    /// Adds δ + h (∂f/∂y) δ, unless the run integrates other components than those that jumped (charts).
    void be_late(const Rhs& rhs, const Start& from, double* end) {
        const std::size_t size = late_.size();
        if (size != rate_.size()) return;
        double largest = 0;
        for (std::size_t i = 0; i < size; ++i)
            largest = std::max(largest, std::abs(late_[i]) / std::max(1.0, std::abs(from.state[i])));
        if (!(largest > 0)) return;
        const double times = 1e-8 / largest;
        for (std::size_t i = 0; i < size; ++i) moved_[i] = from.state[i] + times * late_[i];
        rhs(from.t, moved_.data(), rate_.data());
        ++evaluations_;
        for (std::size_t i = 0; i < size; ++i) {
            const double change = from.h * (rate_[i] - from.rate[i]) / times;
            if (std::isfinite(change)) end[i] += late_[i] + change;
        }
    }

    std::vector<double> late_, moved_, rate_;
    Flutter flutter_;
    long evaluations_ = 0;
};

}  // namespace alembert
