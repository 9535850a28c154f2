// SPDX-License-Identifier: MIT
#include "alembert/hybrid/continuous_sides.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/tolerances.hpp"

namespace alembert {

namespace {

constexpr double shortest = 1e-12, longest = 1e-3;  // of the run: the first time of the trial, and the last one
constexpr double same = 1e-13;                      // of rates, relative to them, after constraints are solved
constexpr double above_rounding = 16;               // times what rounding leaves of a function
constexpr double well_followed = 0.1;               // error of a step of the trial, relative to what it has moved

using State = std::vector<double>;

class TrialMotion {
public:
    TrialMotion(const SwitchingScales& moment, const std::vector<int>& open) : at_(moment), open_(open) {}

    /// Whether the rates are the same for all sides, with the rounding of one evaluation allowed for. A cell of a
    /// table of two arguments has two sides that act together.
    bool is_continuous() const {
        FilippovMode sides = at_.sides;
        for (const int k : open_) sides[k] = 1;
        const State first = rates(sides, at_.t, at_.state);
        const State allowed = rounding(sides, first);
        const auto agrees = [&] {
            const State other = rates(sides, at_.t, at_.state);
            for (std::size_t i = 0; i < first.size(); ++i)
                if (!(std::abs(other[i] - first[i]) <= allowed[i] + same * std::abs(first[i]))) return false;
            return true;
        };
        for (std::size_t i = 0; i < open_.size(); ++i)
            for (std::size_t j = i; j < open_.size(); ++j) {
                sides[open_[i]] = sides[open_[j]] = -1;
                if (!agrees()) return false;
                sides[open_[i]] = sides[open_[j]] = 1;
            }
        for (const int k : open_) sides[k] = -1;
        return agrees();
    }

    std::optional<FilippovMode> sides() const {
        const double run = at_.options.duration,
                     first = std::max(shortest * run, 64 * tolerance::epsilon * std::abs(at_.t));
        FilippovMode result = at_.sides;
        for (const int k : open_) result[k] = 0;
        State y = at_.state;
        double t = at_.t, step = first;
        for (; t - at_.t < longest * run; step = t - at_.t) {
            const State whole = after(t, y, step), half = after(t + step / 2, after(t, y, step / 2), step / 2);
            for (std::size_t i = 0; i < y.size(); ++i)
                if (!(std::abs(whole[i] - half[i]) <=
                      well_followed * std::abs(half[i] - at_.state[i]) + known(half[i])))
                    return std::nullopt;
            t += step;
            y = half;
            bool are_decided = true;
            const FilippovMode now = sides_at(t, y);
            for (const int k : open_) {
                if (result[k] == 0 && has_left(k, now, t, y)) result[k] = now[k];
                are_decided = are_decided && result[k] != 0;
            }
            if (are_decided) break;
        }
        return result;
    }

private:
    static double known(double x) { return 64 * tolerance::epsilon * std::max(1.0, std::abs(x)); }

    State rates(const FilippovMode& sides, double t, const State& y) const {
        SlidingField there(at_.system, sides, at_.dimension());
        there.evaluate(t, y.data());
        return there.rate();
    }

    State rounding(const FilippovMode& sides, const State& rate) const {
        const double little = std::sqrt(tolerance::epsilon);
        State result(rate.size()), y = at_.state;
        for (double& x : y) {
            const double kept = x;
            x += little * std::max(1.0, std::abs(kept));
            const State moved = rates(sides, at_.t, y);
            for (std::size_t i = 0; i < rate.size(); ++i)
                result[i] += above_rounding * little * std::abs(moved[i] - rate[i]);
            x = kept;
        }
        return result;
    }

    /// The sides of the open functions at a state; one may contain the signs of those before it.
    FilippovMode sides_at(double t, const State& y) const {
        FilippovMode sides = at_.sides;
        for (const int k : open_) sides[k] = 1;
        for (const int k : open_) {
            SlidingField there(at_.system, sides, at_.dimension());
            there.evaluate(t, y.data());
            if (there.value(k) < 0) sides[k] = -1;
        }
        return sides;
    }

    bool has_left(int k, const FilippovMode& sides, double t, const State& y) const {
        const SwitchingScales there{at_.system, sides, t, y, at_.options, at_.sizes};
        return std::abs(there.value(k)) > above_rounding * there.still(k);
    }

    State slope(double t, const State& y) const { return rates(sides_at(t, y), t, y); }

    /// A step of the classical Runge-Kutta method.
    State after(double t, const State& y, double h) const {
        const auto moved = [&](const State& k, double by) {
            State result = y;
            for (std::size_t i = 0; i < y.size(); ++i) result[i] += by * k[i];
            return result;
        };
        const State k1 = slope(t, y), k2 = slope(t + h / 2, moved(k1, h / 2)),
                    k3 = slope(t + h / 2, moved(k2, h / 2)), k4 = slope(t + h, moved(k3, h));
        State result = y;
        for (std::size_t i = 0; i < y.size(); ++i) result[i] += h / 6 * (k1[i] + 2 * (k2[i] + k3[i]) + k4[i]);
        return result;
    }

    const SwitchingScales& at_;
    const std::vector<int>& open_;
};

bool is_of_friction(const SwitchingScales& moment, const std::vector<int>& open) {
    SlidingField here(moment.system, moment.sides, moment.dimension());
    here.evaluate(moment.t, moment.state.data());
    here.find_bounds(moment.t, moment.state.data());
    return std::any_of(open.begin(), open.end(),
                       [&](int k) { return moment.sides.is_pair(k) || here.normal(k) != 1; });
}

}  // namespace

bool rates_are_continuous(const SwitchingScales& moment, const std::vector<int>& open) {
    return !open.empty() && !is_of_friction(moment, open) && TrialMotion(moment, open).is_continuous();
}

std::optional<FilippovMode> continuous_sides(const SwitchingScales& moment, const std::vector<int>& open) {
    if (!rates_are_continuous(moment, open)) return std::nullopt;
    return TrialMotion(moment, open).sides();
}

}  // namespace alembert
