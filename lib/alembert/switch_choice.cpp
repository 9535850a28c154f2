// SPDX-License-Identifier: MIT
#include "alembert/switch_choice.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/switch_sides.hpp"

namespace alembert {

namespace {

class SideJudge {
public:
    SideJudge(const Switching& system, double t, const std::vector<double>& state)
        : system_(system), t_(t), state_(state) {}

    /// How consistent a choice is. In a consistent one every g moves to its chosen side and every α lies between
    /// −1 and 1.
    SideChoice judged(const std::vector<int>& sides, const std::vector<int>& open) const {
        SwitchSides at(system_, sides, static_cast<int>(state_.size()));
        at.evaluate(t_, state_.data());
        at.find_bounds(t_, state_.data());
        SideChoice choice{.sides = sides, .margin = HUGE_VAL, .jumps = false};
        for (const int k : open) {
            std::vector<int> one = sides, other = sides;
            one[k] = 1;
            other[k] = -1;
            const double up = slope_of(one, k), down = slope_of(other, k);
            const double size = std::abs(up) + std::abs(down);
            const bool jump = std::abs(up - down) > 1e-9 * size;
            choice.jumps = choice.jumps || jump;
            double margin;
            if (sides[k] != 0)
                margin = size > 0 ? sides[k] * at.slope(k) / size : 0;
            else if (!jump || up > down)
                margin = -HUGE_VAL;  // there is nothing to slide along, or the motion is repelled from it
            else
                margin = 1 - std::abs(at.sigma()[k]) / at.bound(k);
            if (sides[k] != 0 && jump && up < down && can_stick(sides, k)) margin = -HUGE_VAL;
            choice.margin = std::min(choice.margin, std::isfinite(margin) ? margin : -HUGE_VAL);
        }
        return choice;
    }

private:
    /// Friction with a static coefficient above the kinetic one begins to slide only where that is overcome.
    bool can_stick(std::vector<int> sides, int k) const {
        if (!system_.bounds) return false;
        sides[k] = 0;
        SwitchSides at(system_, sides, static_cast<int>(state_.size()));
        at.evaluate(t_, state_.data());
        at.find_bounds(t_, state_.data());
        return at.bound(k) > 1 && std::abs(at.sigma()[k]) <= at.bound(k);
    }

    double slope_of(const std::vector<int>& sides, int k) const {
        SwitchSides at(system_, sides, static_cast<int>(state_.size()));
        at.evaluate(t_, state_.data());
        return at.slope(k);
    }

    const Switching& system_;
    double t_;
    const std::vector<double>& state_;
};

}  // namespace

std::vector<SideChoice> side_choices(const Switching& system, std::vector<int> sides, const std::vector<int>& open,
                                     double t, const std::vector<double>& state) {
    const SideJudge judge(system, t, state);
    std::vector<SideChoice> found;
    std::size_t count = 1;
    for (std::size_t i = 0; i < open.size(); ++i) count *= 3;
    for (std::size_t code = 0; code < count; ++code) {
        std::size_t rest = code;
        for (const int k : open) {
            sides[k] = static_cast<int>(rest % 3) - 1;
            rest /= 3;
        }
        found.push_back(judge.judged(sides, open));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const SideChoice& a, const SideChoice& b) { return a.margin > b.margin; });
    return found;
}

std::vector<double> consistent_signs(const Switching& system, std::vector<int> sides, double t, const double* y,
                                     int dimension) {
    for (bool again = true; again;) {
        again = false;
        SwitchSides at(system, sides, dimension);
        at.evaluate(t, y);
        at.find_bounds(t, y);
        for (std::size_t i = 0; i < at.sliding().size() && !again; ++i) {
            const int k = at.sliding()[i];
            const double alpha = at.sigma()[static_cast<std::size_t>(k)];
            if (at.steepness(i) < 0 && std::abs(alpha) <= at.bound(k) * (1 + 1e-9)) continue;
            sides[static_cast<std::size_t>(k)] =
                at.steepness(i) < 0 ? (alpha > 0 ? 1 : -1) : (at.slope(k) < 0 ? -1 : 1);
            again = true;
        }
        if (!again) return at.sigma();
    }
    return {};
}

}  // namespace alembert
