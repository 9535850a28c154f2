// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/interval/disc.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/language/say.hpp"

namespace alembert {

namespace {

constexpr int most_unknowns = 60;
constexpr double wider = 1e3;  // the box of rates and multipliers, on which the equations depend linearly

/// Rows of the balance, over coordinates (essential, then dependent), dependent speeds, their rates, multipliers.
class Balance {
public:
    Balance(const Residuals& r, const Split& split, const std::vector<int>& essential,
            const std::vector<int>& silent)
        : r_(r), split_(split) {
        for (const int k : essential) coordinates_.push_back(split.q[k]);
        at_rest_ = coordinates_;
        std::erase_if(at_rest_, [&](int i) {  // whose rates are unknowns
            return std::count(split.u_dependent.begin(), split.u_dependent.end(), i) > 0;
        });
        coordinates_.insert(coordinates_.end(), split.q_dependent.begin(), split.q_dependent.end());
        for (int i = 0; i < r.s; ++i) {
            const bool is_silent =
                std::any_of(silent.begin(), silent.end(), [&](int k) { return split.u[k] == i; });
            if (!is_silent) forces_.push_back(i);
        }
    }

    int unknowns() const { return static_cast<int>(coordinates_.size()) + 3 * r_.kept; }
    int equations() const { return r_.holonomic + 2 * r_.kept + static_cast<int>(forces_.size()); }

    /// Those that give the rates of dependent speeds and the multipliers, in which they are linear.
    std::vector<int> rows_of_reactions() const {
        std::vector<int> rows;
        for (int k = 0; k < r_.kept; ++k) rows.push_back(r_.holonomic + r_.kept + k);
        for (std::size_t k = 0; k < forces_.size(); ++k)
            if (std::count(split_.u_dependent.begin(), split_.u_dependent.end(), forces_[k]) > 0)
                rows.push_back(r_.holonomic + 2 * r_.kept + static_cast<int>(k));
        return rows;
    }

    RealBallVector at(const RealBallPoint& point) const {
        RealBallVector z;
        for (const int i : coordinates_) z.push_back(point.q[i]);
        for (const int i : split_.u_dependent) z.push_back(point.u[i]);
        z.resize(static_cast<std::size_t>(unknowns()));
        return z;
    }

    /// The residuals, as series in the unknowns where there are monomials.
    std::vector<Expansion> values(const RealBallPoint& point, const RealBallVector& z,
                                  const Monomials* monomials) const {
        const auto entry = [&](int k) {
            return monomials != nullptr ? Expansion::variable(*monomials, k, z[k]) : Expansion(z[k]);
        };
        State<Expansion> state = state_of(point);
        for (const int i : at_rest_) state.qdot[i] = Expansion(0);
        int next = 0;
        for (const int i : coordinates_) state.q[i] = entry(next++);
        for (const int i : split_.u_dependent) state.qdot[i] = entry(next++);
        const std::vector<Expansion> value = interpret(r_.program, state);
        std::vector<Expansion> rates(r_.s), multipliers, result;
        for (const int i : split_.u_dependent) rates[i] = entry(next++);
        for (int k = 0; k < r_.kept; ++k) multipliers.push_back(entry(next++));
        for (const int node : r_.position) result.push_back(value[node]);
        for (const int node : r_.velocity) result.push_back(value[node]);
        const auto row = [&](int k, int i) { return value[r_.row[k * r_.s + i]]; };
        for (int k = 0; k < r_.kept; ++k) {
            Expansion sum = Expansion(-1) * value[r_.gamma[k]];
            for (const int i : split_.u_dependent) sum += row(k, i) * rates[i];
            result.push_back(std::move(sum));
        }
        for (const int i : forces_) {
            Expansion sum = value[r_.forcing[i]];
            for (int k = 0; k < r_.kept; ++k) sum += row(k, i) * multipliers[k];
            for (const int j : split_.u_dependent) {
                const int low = std::min(i, j), high = std::max(i, j);
                sum = sum - value[r_.mass[high * (high + 1) / 2 + low]] * rates[j];
            }
            result.push_back(std::move(sum));
        }
        return result;
    }

private:
    const Residuals& r_;
    const Split& split_;
    std::vector<int> coordinates_, at_rest_, forces_;
};

RealBallMatrix slopes(const std::vector<Expansion>& values, int unknowns) {
    RealBallMatrix result(static_cast<int>(values.size()), unknowns);
    for (int i = 0; i < result.rows; ++i)
        for (int k = 0; k < unknowns; ++k) result(i, k) = values[i].coefficient(k + 1);
    return result;
}

RealBallVector middles(RealBallVector list) {
    for (RealBall& x : list) x = RealBall::about(x.middle(), 0);
    return list;
}

}  // namespace

const char* name_of(StateKnown known) {
    switch (known) {
        case StateKnown::exactly:
            return "exact";
        case StateKnown::proved:
            return "proved";
        case StateKnown::open:
            return "open";
        case StateKnown::in_numbers:
            return "in numbers";
    }
    return "";
}

Assumption state_in_numbers() {
    return {Assumption::Kind::state,
            say("the state was found in numbers; that the mechanism can stay there, or move steadily, is not "
                "proved"),
            false};
}

Assumption signs_in_numbers() {
    return {Assumption::Kind::numbers,
            say("the signs that decide were computed in floating point, without bounds"), false};
}

StateKnown disc_around(const Residuals& residuals, const Split& split, const std::vector<int>& essential,
                       const std::vector<int>& silent, const RealBallPoint& point, double radius) try {
    const Balance balance(residuals, split, essential, silent);
    const int n = balance.unknowns(), places = n - 2 * residuals.kept;
    if (!residuals.rates_are_speeds || n != balance.equations() || n > most_unknowns)
        return StateKnown::in_numbers;
    const Monomials linear(n, 1);
    RealBallVector middle = middles(balance.at(point));
    std::vector<int> reactions(n - places);
    std::iota(reactions.begin(), reactions.end(), places);
    const auto newton =
        [&](const std::vector<int>& rows,
            const std::vector<int>& columns) -> std::optional<std::pair<RealBallMatrix, RealBallVector>> {
        const std::vector<Expansion> here = balance.values(point, middle, &linear);
        RealBallMatrix by = slopes(here, n).part(rows, columns), left(by.rows, 1);
        by.entries = middles(std::move(by.entries));
        for (int i = 0; i < by.rows; ++i) left(i, 0) = here[rows[i]].value();
        auto inverse = solution(std::move(by), RealBallMatrix::identity(left.rows));
        if (!inverse) return std::nullopt;
        inverse->entries = middles(std::move(inverse->entries));
        RealBallVector step = (*inverse * left).entries;
        return std::pair(*std::move(inverse), std::move(step));
    };
    const auto first = newton(balance.rows_of_reactions(), reactions);
    if (!first) return StateKnown::open;
    for (int k = places; k < n; ++k)
        middle[k] = RealBall::about(middle[k].middle() - first->second[k - places].middle(), 0);
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    const auto whole = newton(all, all);
    if (!whole) return StateKnown::open;
    const auto& [inverse, step] = *whole;
    std::vector<double> half(n);
    RealBallVector box = middle, change;
    for (int k = 0; k < n; ++k) {
        const double size = std::max(1.0, std::abs(middle[k].number()));
        half[k] = radius * size * (k < places ? 1 : wider);
        if (k >= places) half[k] += 4 * (std::abs(step[k].number()) + step[k].radius());
        box[k] = RealBall::about(middle[k].middle(), half[k]);
        change.push_back(RealBall::about(0, half[k]));
    }
    RealBallMatrix rest = inverse * slopes(balance.values(point, box, &linear), n);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) rest(i, k) = RealBall(i == k ? 1 : 0) - rest(i, k);
    for (int i = 0; i < n; ++i) {
        RealBall image = -step[i];
        for (int k = 0; k < n; ++k) image += rest(i, k) * change[k];
        if (!(std::abs(image.number()) + image.radius() < half[i])) return StateKnown::open;
    }
    return StateKnown::proved;
} catch (const NotAnalytic&) {
    return StateKnown::in_numbers;
}

}  // namespace alembert
