// SPDX-License-Identifier: MIT
#include "alembert/ode/quick_places.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "alembert/base/tolerances.hpp"
#include "alembert/ode/five_points.hpp"

namespace alembert {
namespace {

using Op = EventInstruction::Op;

constexpr int most_divisions = 40;        ///< of halvings of a step
constexpr std::size_t most_places = 400;  ///< of a step, for one function
constexpr double a_part = 0.3;        ///< of what is seen of a function; it is resolved where it changes by less
constexpr double hardly_any = 1e-20;  ///< below that a function is taken for zero
constexpr double beside = 3e-5;       ///< of a step: the slope is that between two points at this distance
constexpr double most_kept = 0.9;     ///< of a step that has passed over something, so that few tries are enough
const FiveNumbers first_places = {0, 0.23, 0.51, 0.77, 1};  ///< not equidistant, as no motion's period is

/// Whether a function with these values changes little: by less than half of itself, or by a small part of what it
/// can change.
bool is_little(const Interval& values, Op op) {
    const double change = values.high - values.low;
    if (values.size() <= hardly_any) return true;
    if ((op == Op::tanh || op == Op::atan) && change <= a_part) return true;
    return values.has_sign() && change <= std::min(std::abs(values.low), std::abs(values.high)) / 2;
}

Interval values_of(const std::vector<EventInstruction>& function, const std::vector<double>& parameters,
                   const Interval& time, const std::function<Bounds(int)>& state) {
    return bounds_of(function, parameters.data(), {.time = {time, {}, {}}, .state = state, .rate = {}}).value;
}

/// Pieces with larger changes come first.
constexpr auto changes_less = [](const auto& a, const auto& b) {
    return a.values.high - a.values.low < b.values.high - b.values.low;
};

}  // namespace

PlaceWatch::PlaceWatch(const QuickPlaces& places, const Rhs& rhs, double allowed)
    : places_(places), rhs_(rhs), allowed_(allowed) {
    if (!places.code) return;
    for (const std::vector<EventInstruction>& function : places.code->events)
        if (!function.empty()) functions_.push_back(&function);
    if (functions_.empty()) return;
    const auto size = static_cast<std::size_t>(rhs.dimension);
    for (std::vector<double>* const one : {&rate_, &before_, &here_, &after_}) one->resize(size);
}

bool PlaceWatch::is_mild(const StepView& step) const {
    return std::all_of(functions_.begin(), functions_.end(), [&](Function f) { return is_mild(step, f); });
}

bool PlaceWatch::is_mild(const StepView& step, Function function) const {
    constexpr double margin = 0.25;
    const double h = step.end - step.start;
    const auto state = [&](int k) {
        return Bounds{cubic_range(step.start_state[k], h * step.start_rate[k], step.end_state[k],
                                  h * step.end_rate[k], 1, margin),
                      {},
                      {}};
    };
    const Interval values = values_of(*function, places_.parameters, {step.start, step.end}, std::cref(state));
    return is_little(values, function->back().op);
}

double PlaceWatch::clear_part(const StepView& step) {
    samples_.clear();
    for (const Function function : functions_) {
        if (is_mild(step, function)) continue;
        if (const std::optional<double> part = look(step, function)) return *part;
    }
    return 1;
}

/// Divides the step until the samples show what the function does.
std::optional<double> PlaceWatch::look(const StepView& step, Function function) {
    samples_.clear();
    pieces_.clear();
    Piece whole;
    for (std::size_t i = 0; i < 5; ++i) whole.samples[i] = sample_at(step, function, first_places[i]);
    seen_ = {samples_[0].value, samples_[0].value};
    for (const Sample& sample : samples_) seen_ = hull(seen_, {sample.value, sample.value});
    add(step, function, whole);
    while (!pieces_.empty() && samples_.size() < most_places) {
        std::pop_heap(pieces_.begin(), pieces_.end(), changes_less);
        const Piece piece = pieces_.back();
        pieces_.pop_back();
        if (const std::optional<double> part = compare(step, piece)) return part;
        if (piece.values.high - piece.values.low <= a_part * (seen_.high - seen_.low) ||
            piece.depth == most_divisions)
            continue;
        for (std::size_t half = 0; half < 4; half += 2) {
            Piece part{.samples = {}, .values = {}, .depth = piece.depth + 1};
            for (std::size_t i = 0; i < 3; ++i) part.samples[2 * i] = piece.samples[half + i];
            for (std::size_t i = 0; i < 3; i += 2) {
                const double a = samples_[part.samples[i]].theta, b = samples_[part.samples[i + 2]].theta;
                part.samples[i + 1] =
                    sample_at(step, function, a + (0.47 + 0.035 * static_cast<double>(i)) * (b - a));
            }
            add(step, function, part);
        }
    }
    // Intervals are too wide to tell, as those of a polynomial in sines over turns: they are not over half the
    // step.
    const bool is_open = !pieces_.empty() && pieces_.front().values.high - pieces_.front().values.low >
                                                 a_part * (seen_.high - seen_.low);
    if (is_open) return 0.5;
    return std::nullopt;
}

/// The samples of a piece that have not been compared yet. Those at the ends of the step are known to the method.
std::optional<double> PlaceWatch::compare(const StepView& step, const Piece& piece) {
    for (const std::size_t number : piece.samples) {
        Sample& sample = samples_[number];
        if (sample.is_compared || sample.theta == 0 || sample.theta == 1) continue;
        if (!keeps(step, sample)) {
            double before = 0;
            for (const Sample& other : samples_)
                if (other.theta < sample.theta) before = std::max(before, other.theta);
            return before > 0 ? std::min(before, most_kept) : sample.theta / 2;
        }
        sample.is_compared = true;
    }
    return std::nullopt;
}

std::size_t PlaceWatch::sample_at(const StepView& step, Function function, double theta) {
    Sample& sample = samples_.emplace_back();
    sample.theta = theta;
    sample.state.resize(rate_.size());
    step.interpolate(theta, sample.state.data());
    sample.value = value(step, function, sample);
    if (!std::isnan(sample.value)) seen_ = hull(seen_, {sample.value, sample.value});
    return samples_.size() - 1;
}

void PlaceWatch::add(const StepView& step, Function function, Piece piece) {
    piece.values = enclosure(step, function, piece);
    if (is_little(piece.values, function->back().op)) return;
    pieces_.push_back(piece);
    std::push_heap(pieces_.begin(), pieces_.end(), changes_less);
}

double PlaceWatch::value(const StepView& step, Function function, const Sample& sample) const {
    const double t = step.start + sample.theta * (step.end - step.start);
    const auto state = [&](int k) {
        const double y = sample.state[static_cast<std::size_t>(k)];
        return Bounds{{y, y}, {}, {}};
    };
    const Interval values = values_of(*function, places_.parameters, {t, t}, std::cref(state));
    return (values.low + values.high) / 2;
}

Interval PlaceWatch::enclosure(const StepView& step, Function function, const Piece& piece) const {
    constexpr double margin = 0.05;
    const auto sample = [&](std::size_t i) -> const Sample& { return samples_[piece.samples[i]]; };
    const FivePoints points({sample(0).theta, sample(1).theta, sample(2).theta, sample(3).theta, sample(4).theta});
    const auto state = [&](int k) {
        const auto y = [&](std::size_t i) { return sample(i).state[static_cast<std::size_t>(k)]; };
        const auto slope = [&](std::size_t i) {
            double sum = 0;
            for (std::size_t j = 0; j < 5; ++j) sum += points.slope_factors(static_cast<int>(i))[j] * y(j);
            return sum;
        };
        Interval all = {y(0), y(0)};
        for (std::size_t i = 0; i < 4; ++i)
            all = hull(all, cubic_range(y(i), slope(i), y(i + 1), slope(i + 1),
                                        sample(i + 1).theta - sample(i).theta, margin));
        return Bounds{all, {}, {}};
    };
    const double h = step.end - step.start;
    return values_of(*function, places_.parameters,
                     widened(step.start + sample(0).theta * h, step.start + sample(4).theta * h),
                     std::cref(state));
}

/// Whether the slope of the step is the rate there.
bool PlaceWatch::keeps(const StepView& step, const Sample& sample) {
    const double h = step.end - step.start, first = std::clamp(sample.theta - beside, 0.0, 1 - 2 * beside);
    step.interpolate(first, before_.data());
    step.interpolate(first + beside, here_.data());
    step.interpolate(first + 2 * beside, after_.data());
    rhs_(step.start + sample.theta * h, sample.state.data(), rate_.data());
    ++evaluations_;
    const double aside = (sample.theta - first - beside) / beside;  // 0 but next to the ends of the step
    for (int i = 0; i < rhs_.dimension - rhs_.extra; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double slope =
            ((after_[k] - before_[k]) / 2 + aside * (after_[k] - 2 * here_[k] + before_[k])) / beside;
        const double size = std::max(1.0, std::abs(sample.state[k]));
        const double rounded =
            8 * tolerance::epsilon / beside * std::abs(sample.state[k]) + 1e-8 * h * std::abs(rate_[k]);
        if (!(std::abs(slope - h * rate_[k]) <= allowed_ * size + rounded)) return false;
    }
    return true;
}

}  // namespace alembert
