// SPDX-License-Identifier: MIT
#include "alembert/hybrid/switching_scales.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/tolerances.hpp"

namespace alembert {

namespace {

constexpr double known = 1e-9;        // components of a state are known to this part of themselves, and times to
constexpr double known_time = 1e-12;  // this part of the run
constexpr double known_rate = 1e-13;  // a rate is known to this part of its terms, after constraints are solved
constexpr double little = 1e-3;       // part of the run in which a load gives a first size of sliding velocities
constexpr double different = 1e-9;    // rates at both sides, relative to them
constexpr double small_share = 1e-3;  // of errors of the tolerance: far less than these
// A function whose swings do not become less in so many changes, and are so much less than the largest, has come
// to where rounding ends that.
constexpr int most_rounds_at_rest = 8;
constexpr double small_swing = 1e-6;

/// |g| of a function, or of both of a pair.
double length(const FilippovMode& sides, const std::vector<double>& g, int k) {
    return sides.is_pair(k) ? std::hypot(g[k], g[k + 1]) : std::abs(g[k]);
}

/// Σ |∂g/∂y_i| size(y_i): how far g, or what `length` makes of the numbers of FilippovSystem::values, is off where
/// the components of the state are off by these sizes.
template <typename Length, typename Size>
double moved(const FilippovSystem& system, const FilippovMode& sides, double t, std::vector<double> y,
             const Length& length, const Size& size) {
    const std::vector<double> none(y.size()), sigma = system.sigma(sides);
    std::vector<double> here(system.numbers()), there = here;
    system.values(t, y.data(), sigma.data(), none.data(), here.data());
    double sum = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
        const double off = size(y[i]), kept = y[i];
        if (off == 0) continue;
        y[i] += std::max(off, std::sqrt(tolerance::epsilon) * std::abs(kept));
        const double step = y[i] - kept;
        system.values(t, y.data(), sigma.data(), none.data(), there.data());
        for (std::size_t j = 0; j < there.size(); ++j) there[j] -= here[j];
        sum += length(there) * off / step;
        y[i] = kept;
    }
    return sum;
}

/// The same for |g| of a function, or of both of a pair.
template <typename Size>
double moved(const SwitchingScales& at, int k, const Size& size) {
    return moved(
        at.system, at.sides, at.t, at.state,
        [&](const std::vector<double>& off) { return length(at.sides, off, k); }, size);
}

}  // namespace

double SwitchingScales::value(int k) const {
    SlidingField here(system, sides, dimension());
    here.evaluate(t, state.data());
    return here.value(k);
}

double SwitchingScales::still(int k) const {
    return 4 * tolerance::epsilon * length(sides, sizes, k) +
           moved(*this, k, [](double y) { return 4 * tolerance::epsilon * std::abs(y); });
}

double SwitchingScales::stopped(int k) const {
    const double least = std::max(options.tolerance, 1e-13);
    double largest = sizes[k];
    for (int other = 0; sides.is_pair(k) && sides.is_pair(other); ++other)
        largest = std::max(largest, sizes[other]);
    return least * largest + moved(*this, k, [&](double y) { return least * std::max(1.0, std::abs(y)); }) +
           still(k);
}

bool SwitchingScales::is_zero(int k, double g) const {
    if (g == 0) return true;
    double slope = 0;
    for (const int side : {-1, 1}) {
        FilippovMode other = sides;
        other[k] = side;
        SlidingField here(system, other, dimension());
        here.evaluate(t, state.data());
        slope = std::max(slope, std::abs(here.slope(k)));
    }
    return std::abs(g) <= still(k) + known_time * std::abs(t) * slope;
}

bool SwitchingScales::changes_nothing(int k) const {
    SlidingField here(system, sides, dimension());
    here.evaluate(t, state.data());
    here.find_bounds(t, state.data());
    if (here.normal(k) != 1) return false;
    std::vector<double> rates[2];
    for (const int side : {0, 1}) {
        FilippovMode other = sides;
        for (int& one : other.of) one = one == 0 ? 1 : one;
        other[k] = 2 * side - 1;
        SlidingField at(system, other, dimension());
        at.evaluate(t, state.data());
        rates[side] = at.rate();
    }
    for (std::size_t i = 0; i < rates[0].size(); ++i)
        if (!(std::abs(rates[1][i] - rates[0][i]) <= known_rate * std::abs(rates[0][i]))) return false;
    return true;
}

double SwitchingScales::idle(int k) const {
    std::vector<double> usual = state;  // N v is not moved by errors of N and v where both are zero
    for (double& y : usual) y = std::max(1.0, std::abs(y));
    return small_share * std::max(stopped(k), SwitchingScales{system, sides, t, usual, options, sizes}.stopped(k));
}

double SwitchingScales::speed(int pair) const {
    double largest = system.speed;
    for (int k = 0; sides.is_pair(k); ++k) largest = std::max(largest, sizes[k]);
    if (system.speed > 0) return largest;
    FilippovMode held = sides;
    held[pair] = held[pair + 1] = 0;
    const std::vector<double> sigma = system.sigma(held);  // α = 0
    std::vector<double> rate(state.size()), g(system.numbers());
    system.rates(t, state.data(), sigma.data(), rate.data());
    system.values(t, state.data(), sigma.data(), rate.data(), g.data());
    const std::size_t slope = sides.size() + static_cast<std::size_t>(pair);
    return std::max(largest, little * options.duration * std::hypot(g[slope], g[slope + 1]));
}

double SwitchingScales::uncertain_normal(const SlidingField& now, int k) const {
    SlidingField other(system, sides, dimension());
    std::vector<double> y = state;
    const auto change = [&](double time) {
        other.evaluate(time, y.data());
        other.find_bounds(time, y.data());
        return std::abs(other.normal(k) - now.normal(k));
    };
    double sum = 0;
    for (double& x : y) {  // of a component that is zero an implicit method leaves rounding
        const double kept = x, off = std::max(known * std::abs(kept), small_share * options.tolerance);
        x += std::max(off, std::sqrt(tolerance::epsilon) * std::abs(kept));
        if (x != kept) sum += off / (x - kept) * change(t);
        x = kept;
    }
    const double longest = std::max(std::abs(t), options.duration),
                 later = t + std::sqrt(tolerance::epsilon) * longest;
    return sum + known_time * longest / (later - t) * change(later);
}

bool SwitchingScales::brakes(int k) const {
    double slopes[2];
    for (const int side : {0, 1}) {
        FilippovMode other = sides;
        other[k] = 2 * side - 1;
        SlidingField at(system, other, dimension());
        at.evaluate(t, state.data());
        slopes[side] = at.slope(k);
    }
    return std::abs(slopes[1] - slopes[0]) > different * (std::abs(slopes[0]) + std::abs(slopes[1]));
}

std::vector<int> ChatterWatch::at_rest(const SwitchingScales& moment, const std::vector<int>& open, double since) {
    SlidingField here(moment.system, moment.sides, moment.dimension());
    here.evaluate(moment.t, moment.state.data());
    std::vector<int> found;
    for (int k = 0; k < moment.system.count(); ++k) {
        const bool is_open = std::find(open.begin(), open.end(), k) != open.end();
        if (moment.sides[k] == 0 || moment.sides.is_pair(k) || is_open) continue;
        const double size = std::abs(here.value(k));
        Swing& swing = of_[static_cast<std::size_t>(k)];
        swing.most = std::max(swing.most, size);
        swing.rounds = size < 0.99 * swing.least ? 0 : swing.rounds + 1;
        swing.least = std::min(swing.least, size);
        const double nothing = std::max(moment.options.tolerance, 256 * tolerance::epsilon) * swing.most;
        const bool is_over =
            size <= nothing || (size <= small_swing * swing.most && swing.rounds >= most_rounds_at_rest);
        if (is_over && std::abs(here.slope(k)) * since <= size + nothing) found.push_back(k);
    }
    return found;
}

bool stands_still(const FilippovSystem& system, const FilippovMode& sides, int k, double t,
                  const std::vector<double>& state) {
    if (!system.is_positional(k)) return false;
    const std::size_t rate = sides.size() + static_cast<std::size_t>(k);
    const std::vector<double> none(state.size()), sigma = system.sigma(sides);
    std::vector<double> g(system.numbers());
    system.values(t, state.data(), sigma.data(), none.data(), g.data());
    return std::abs(g[rate]) <= moved(
                                    system, sides, t, state,
                                    [&](const std::vector<double>& off) { return std::abs(off[rate]); },
                                    [](double y) { return known_rate * std::abs(y); });
}

}  // namespace alembert
