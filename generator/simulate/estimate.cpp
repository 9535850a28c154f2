// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/language/say.hpp"

namespace alembert {

namespace {

constexpr double no_digit = 0.1, suspicious = 1000, saturated = 1e-2, beside = 1e-8, least_jump = 1e-6;
// The better of two runs has an error too: true error / difference is at most 2.5 in 95 % of runs (honesty.sh).
constexpr double margin = 2.5;

struct Separation {
    double time, size;
};

double apart(std::span<const double> a, std::span<const double> b, std::size_t compared) {
    double largest = 0;
    for (std::size_t i = 0; i < compared; ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]) / std::max(1.0, std::abs(b[i])));
    return largest;
}

/// Calls `use(i, y)` with values of each component that counts: those on the rows, and the smallest and the
/// largest at the ends of steps.
template <typename Use>
void for_values(const HybridMotion& motion, std::size_t count, const std::vector<Interval>& reached, Use use) {
    for (const Phase& phase : motion.phases)
        for (std::size_t row = 0; row < phase.motion.rows(); ++row)
            for (std::size_t i = 0; i < count; ++i) use(i, phase.motion.state(row)[i]);
    for (std::size_t i = 0; i < std::min(count, reached.size()); ++i)
        for (const double y : {reached[i].low, reached[i].high}) use(i, y);
}

/// How far components of each kind move, for each component (estimate.hpp).
std::vector<double> extents(const HybridMotion& motion, const Components& compared,
                            const std::vector<Interval>& reached) {
    constexpr double of_all = 1e-12, of_kind = 1e-10, of_one = 1e-16;
    const std::size_t n = compared.coordinates, count = compared.kinds.size();
    const int kinds = 1 + *std::max_element(compared.kinds.begin(), compared.kinds.end());
    const auto& first = motion.phases.front().motion;
    const double duration = motion.final_time() - first.times.front();
    std::vector<double> moved(static_cast<std::size_t>(2 * kinds)), size(moved.size());
    double largest[2] = {0, 0};
    for_values(motion, count, reached, [&](std::size_t i, double y) {
        const auto k = static_cast<std::size_t>(2 * compared.kinds[i] + (i < n ? 0 : 1));
        moved[k] = std::max(moved[k], std::abs(i < n ? y - first.state(0)[i] : y));
        size[k] = std::max(size[k], std::abs(y));
        largest[i < n ? 0 : 1] = std::max(largest[i < n ? 0 : 1], std::abs(y));
    });
    std::vector<double> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(2 * compared.kinds[i]);
        const double steady = i < n ? size[k] : duration > 0 ? size[k] / duration : 0;
        result[i] =
            std::max({moved[i < n ? k : k + 1], of_kind * steady, of_all * largest[i < n ? 0 : 1], of_one});
    }
    return result;
}

/// The largest |y − y(0)| of a coordinate; 0 where it is less than 1e-10 of the largest coordinate.
double largest_move(const HybridMotion& motion, std::size_t coordinates, const std::vector<Interval>& reached) {
    double moved = 0, largest = 0;
    for_values(motion, coordinates, reached, [&](std::size_t i, double y) {
        moved = std::max(moved, std::abs(y - motion.phases.front().motion.state(0)[i]));
        largest = std::max(largest, std::abs(y));
    });
    return moved > 1e-10 * largest ? moved : 0;
}

double apart_of(std::span<const double> a, std::span<const double> b, const std::vector<double>& extent) {
    double largest = 0;
    for (std::size_t i = 0; i < extent.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]) / extent[i]);
    return largest;
}

/// The difference of the end times, |t − t₂| / max(1, |t₂|).
double later(const HybridMotion& a, const HybridMotion& b) {
    return std::abs(a.final_time() - b.final_time()) / std::max(1.0, std::abs(b.final_time()));
}

/// The separations on the rows that both runs have.
std::vector<Separation> separations(const HybridMotion& a, const HybridMotion& b, std::size_t compared) {
    struct Row {
        double time;
        std::span<const double> state;
    };
    const auto rows = [](const HybridMotion& motion) {
        std::vector<Row> list;
        for (const Phase& phase : motion.phases)
            for (std::size_t k = 0; k < phase.motion.rows(); ++k)
                list.push_back({phase.motion.times[k], phase.motion.state(k)});
        return list;
    };
    const std::vector<Row> left = rows(a), right = rows(b);
    std::vector<Separation> result;
    for (std::size_t i = 0, j = 0; i < left.size() && j < right.size();) {
        const double near = 1e-12 * std::max(1.0, std::abs(left[i].time));
        if (std::abs(left[i].time - right[j].time) <= near) {
            result.push_back({left[i].time, apart(left[i].state, right[j].state, compared)});
            ++i, ++j;
        } else {
            ++(left[i].time < right[j].time ? i : j);
        }
    }
    return result;
}

/// The slope of ln size over the second half of the time before saturation; nothing if the size does not gain e³
/// there.
std::optional<double> exponent(std::vector<Separation> list) {
    std::size_t count = 0;
    while (count < list.size() && list[count].size < saturated) ++count;
    list.resize(count);
    std::erase_if(list, [](const Separation& s) { return !(s.size > 0); });
    if (list.size() < 8) return std::nullopt;
    const double middle = (list.front().time + list.back().time) / 2;
    double n = 0, t = 0, l = 0, tt = 0, tl = 0;
    for (const Separation& s : list) {
        if (s.time < middle) continue;
        const double x = s.time - middle, y = std::log(s.size);
        n += 1, t += x, l += y, tt += x * x, tl += x * y;
    }
    const double below = n * tt - t * t;
    if (!(below > 0)) return std::nullopt;
    const double slope = (n * tl - t * l) / below;
    return slope * (list.back().time - middle) > 3 ? std::optional(slope) : std::nullopt;
}

/// An end of a motion.
struct End {
    double time;
    std::span<const double> state;
};

/// The end of a motion, and the states before the jumps that are so close to it that they are the same instant for
/// all that is known of times.
std::vector<End> ends(const HybridMotion& motion, double instant) {
    std::vector<End> result{{motion.final_time(), motion.final_state()}};
    for (std::size_t k = motion.phases.size(); k-- > 1;) {
        const Trajectory& before = motion.phases[k - 1].motion;
        if (!(motion.final_time() - before.times.back() <= instant)) break;
        result.push_back({before.times.back(), before.final_state()});
    }
    return result;
}

/// q' at the end of a motion, if the state has speeds in place of rates.
std::vector<double> rates_at(const End& end, const Components& components) {
    std::vector<double> rates;
    if (components.rates) {
        rates.resize(components.coordinates);
        components.rates(end.time, end.state, rates);
    }
    return rates;
}

/// How far two motions are apart at their ends.
struct Gap {
    double value = HUGE_VAL, scaled = HUGE_VAL;  ///< as in ErrorEstimate
};

/// Compares runs with the first, at their ends.
class Comparing {
public:
    Comparing(const HybridMotion& motion, const Options& given, const Components& components,
              std::vector<double> extent)
        : motion_(motion), components_(components), extent_(std::move(extent)) {
        constexpr double times = 10, finest = 1e-12, fixed = 1e-9;
        const double known = has_fixed_step(given.method) ? fixed : std::max(given.tolerance, finest);
        elapsed_ = motion.final_time() - given.start;
        instant_ = times * known * std::max(std::abs(motion.final_time()), elapsed_);
    }

    /// Adds the difference from a run. Where one of the two ends with an impact, or an impulse, and the other just
    /// before it, the states on the same side are compared.
    void operator()(const HybridMotion& other) {
        const std::vector<End> a = ends(motion_, instant_), b = ends(other, instant_);
        Gap gap = between(a[0], b[0]);
        for (std::size_t k = 1; k < a.size(); ++k) take_nearer(gap, between(a[k], b[0]));
        for (std::size_t k = 1; k < b.size(); ++k) take_nearer(gap, between(a[0], b[k]));
        is_at_jump_ = is_at_jump_ || jumps(a) || jumps(b);
        largest_.value = std::max(largest_.value, gap.value);
        largest_.scaled = std::max(largest_.scaled, gap.scaled);
    }

    const Gap& largest() const { return largest_; }
    /// Whether a run ended at a jump.
    bool is_at_jump() const { return is_at_jump_; }

private:
    bool jumps(const std::vector<End>& at) const {
        return std::any_of(at.begin(), at.end(), [&](const End& one) {
            return apart(one.state, at[0].state, components_.kinds.size()) > least_jump;
        });
    }
    static void take_nearer(Gap& gap, const Gap& other) {
        if (other.value < gap.value) gap = other;
    }

    Gap between(const End& a, const End& b) const {
        const std::vector<double> rates_a = rates_at(a, components_), rates_b = rates_at(b, components_);
        const double later = std::abs(a.time - b.time);
        return {
            .value = std::max({apart(a.state, b.state, components_.kinds.size()),
                               apart(rates_a, rates_b, rates_a.size()), later / std::max(1.0, std::abs(b.time))}),
            .scaled = std::max(apart_of(a.state, b.state, extent_), elapsed_ > 0 ? later / elapsed_ : 0)};
    }

    const HybridMotion& motion_;
    const Components& components_;
    std::vector<double> extent_;
    double elapsed_ = 0, instant_ = 0;
    Gap largest_{0, 0};
    bool is_at_jump_ = false;
};

/// The relative error of a number that is rounded in each step if nothing amplifies it: a random walk, after a few
/// steps with several roundings each.
double rounding_of_steps(const HybridMotion& motion) {
    const double steps = static_cast<double>(motion.statistics.steps);
    return (8 + std::sqrt(steps)) * std::numeric_limits<double>::epsilon();
}

/// What rounding adds to ErrorEstimate::value.
double rounding_of(const HybridMotion& motion, const Components& components) {
    double size = 1;
    const auto& first = motion.phases.front().motion;
    for (std::size_t i = 0; i < components.kinds.size(); ++i) {
        const double end = std::max(1.0, std::abs(motion.final_state()[i]));
        size = std::max(size, std::abs(first.state(0)[i]) / end);
    }
    return size * rounding_of_steps(motion);
}

/// What rounding adds to ErrorEstimate::scaled: more digits are lost the less a component moves beside its size.
double rounding_of(const HybridMotion& motion, const std::vector<double>& extent) {
    const auto first = motion.phases.front().motion.state(0), last = motion.final_state();
    double size = 0;
    for (std::size_t i = 0; i < extent.size(); ++i)
        size = std::max(size, std::max(std::abs(first[i]), std::abs(last[i])) / extent[i]);
    return size * rounding_of_steps(motion);
}

/// Whether the difference from a run with a tenth of the tolerance or half the step is so small, or so large, that
/// it may be due to rounding.
bool may_be_rounding(double difference, const Options& given) {
    constexpr double least = 0.3, most = 10;  // usual differences, in units of the tolerance
    if (has_fixed_step(given.method)) return difference < 1e-9;
    return !(difference > least * given.tolerance && difference < most * given.tolerance);
}

/// The runs with which the first is compared.
class Rerunning {
public:
    Rerunning(const HybridMotion& motion, const Rerun& run, const Options& given,
              const std::vector<double>& initial)
        : motion_(motion), run_(run), given_(given), initial_(initial) {}

    /// A run with a tenth of the tolerance or half the step; if that does not reach the same end, with ten times
    /// the tolerance or twice the step. Nothing if neither does. `options` is set to the options of the run. Its
    /// first step differs too, because it does not always depend on the tolerance.
    std::optional<HybridMotion> other(Options& options) const {
        options = given_;
        options.budget = std::min(given_.budget, 4 * motion_.statistics.work + 10'000);
        const bool fixed = has_fixed_step(options.method);
        for (const double factor : {0.1, 10.0}) {
            const double length = factor < 1 ? 0.5 : 2;
            if (fixed)
                options.step = std::min(given_.step, given_.duration) * length;
            else
                options.tolerance = std::max(given_.tolerance * factor, 1e-15);
            options.disturbed.first_step = length;
            if (!fixed && options.tolerance == given_.tolerance) continue;
            for (const std::uint64_t seed : {2, 0}) {
                options.disturbed.seed = seed;
                if (auto second = at_same_end(options)) return second;
            }
        }
        return std::nullopt;
    }

    /// A run that differs in its rounding alone, which is several times as large.
    std::optional<HybridMotion> disturbed() const {
        Options options = given_;
        options.budget = std::min(given_.budget, 4 * motion_.statistics.work + 10'000);
        options.disturbed.seed = 5;
        return at_same_end(options);
    }

    /// A run with steps of at most half the mean length, for motions whose steps do not depend on the tolerance.
    std::optional<HybridMotion> with_short_steps(Options options) const {
        const double elapsed = motion_.final_time() - given_.start;
        options.longest_step = elapsed / (2 * static_cast<double>(motion_.statistics.steps));
        options.disturbed.first_step = 0.5;
        options.disturbed.seed = 3;
        if (!(options.longest_step > 0)) return std::nullopt;
        return at_same_end(options);
    }

private:
    std::optional<HybridMotion> at_same_end(const Options& options) const {
        HybridMotion second = run_(options, initial_);
        const bool stopped =
            // Each ends at its own time.
            motion_.ending == Ending::stopped_by_event && second.ending == motion_.ending;
        if (second.ending == Ending::failed || !(later(second, motion_) <= (stopped ? no_digit : 1e-6)))
            return std::nullopt;
        return second;
    }

    const HybridMotion& motion_;
    const Rerun& run_;
    const Options& given_;
    const std::vector<double>& initial_;
};

}  // namespace

ErrorEstimate error_estimate(const HybridMotion& motion, const Rerun& run, const Options& given,
                             const std::vector<double>& initial, const Components& components) {
    constexpr long few_steps = 16;
    const std::size_t compared = components.kinds.size();
    const bool fixed = has_fixed_step(given.method);
    const Rerunning reruns(motion, run, given, initial);
    Options options;
    ErrorEstimate estimate;
    const auto reached = [&] { return components.reached ? components.reached() : std::vector<Interval>(); };
    const std::vector<Interval> by_first = reached();
    const std::optional<HybridMotion> second = reruns.other(options);
    if (!second) {
        estimate.by = say("no second run came to the same end");
        return estimate;
    }
    estimate.by = fixed ? say("a second run with step {:g}", options.step)
                        : say("a second run at tolerance {:g}", options.tolerance);
    std::vector<double> extent = extents(motion, components, by_first);
    const std::vector<double> other = extents(*second, components, reached());
    for (std::size_t i = 0; i < extent.size(); ++i) extent[i] = std::min(extent[i], other[i]);
    Comparing compare(motion, given, components, extent);
    compare(*second);
    if (!fixed && second->statistics.steps <= motion.statistics.steps)
        if (const auto third = reruns.with_short_steps(options)) compare(*third);
    if (may_be_rounding(compare.largest().value, given))
        if (const auto third = reruns.disturbed()) compare(*third);
    estimate.value = margin * compare.largest().value + rounding_of(motion, components);
    estimate.scaled = margin * compare.largest().scaled + rounding_of(motion, extent);
    estimate.at_jump = compare.is_at_jump();
    estimate.moved = largest_move(motion, components.coordinates, by_first);
    if (fixed && motion.statistics.steps < few_steps) {
        options.step /= 2;
        const HybridMotion finer = run(options, initial);
        if (finer.ending != Ending::failed)
            estimate.scaled =
                std::max(*estimate.scaled, margin * apart_of(motion.final_state(), finer.final_state(), extent) +
                                               rounding_of(motion, extent));
    }
    if (*estimate.value < (fixed ? 1e-6 : suspicious * given.tolerance)) return estimate;

    std::vector<double> moved = initial;
    for (std::size_t i = 0; i < compared; ++i) moved[i] += beside * (i % 2 == 0 ? 1 : -0.5);
    Options third = given;
    third.budget = 2 * motion.statistics.work + 10'000;
    const HybridMotion neighbour = run(third, moved);
    estimate.lyapunov = exponent(separations(neighbour, motion, compared));
    if (!estimate.lyapunov) return estimate;
    for (const Separation& s : separations(motion, *second, compared))
        if (s.size > no_digit) {
            estimate.horizon = s.time;
            break;
        }
    if (!estimate.horizon)
        estimate.horizon = motion.final_time() + std::log(no_digit / *estimate.value) / *estimate.lyapunov;
    return estimate;
}

}  // namespace alembert
