// SPDX-License-Identifier: GPL-2.0-or-later
// Steps along the kernel of the derivative, each corrected by Newton's method. (Allgower & Georg, Introduction to
// Numerical Continuation Methods (2003), ch. 15: manifolds of more than one dimension.)
#include "stability/equilibrium/family.hpp"

#include <algorithm>
#include <cmath>

#include "stability/equilibrium/search.hpp"
#include "stability/linear/dense_long.hpp"

namespace alembert {

namespace {

using Index = Eigen::Index;

constexpr long double whole_turn = 2 * 3.14159265358979323846264338327950288L;
constexpr long double free_below = 1e-10L;  // relative to the largest singular value
constexpr long double beside_root = 1e-3L;  // of a root beside another, in units of the scales
// Times this, a tenth of the scales, a continuum must go on: beside a root of high multiplicity Newton's method
// moves no more.
constexpr long double farther = 100;
constexpr long double direction = 0.1L;  // how far changes of length 1 must differ to be different directions
constexpr int most_ways = 100;
constexpr long double arrived = 1e-6L, least_way = 1e-3L, usual_way = 0.25L, straight = 0.3L, bend = 0.1L;

/// What a first-order change may be without a change of the equations.
struct Tangents {
    LongMatrix q, u;    ///< columns: changes of coordinates and speeds
    LongMatrix scaled;  ///< of essential coordinates and states, in units of the scales; columns are orthonormal
};

/// Columns in which essential coordinates or states change, orthonormal in these.
Tangents tangents_at(const SteadyProblem& problem, const Instant<long double>& at, Rates rates) {
    const SteadySystem here = problem.linearized_at(at, at.u, rates);
    const Index n = problem.residuals().n, columns = here.by.cols();
    LongMatrix by = here.by;
    LongColumn unit = LongColumn::Ones(columns);
    for (Index j = 0; j < columns; ++j) {
        const Index unknown = here.unknowns[static_cast<std::size_t>(j)];
        if (unknown < static_cast<Index>(here.split.q.size())) unit[j] = problem.scales()[here.split.q[unknown]];
        by.col(j) *= unit[j];
    }
    for (Index i = 0; i < by.rows(); ++i)
        if (const long double size = by.row(i).cwiseAbs().maxCoeff(); size > 0) by.row(i) /= size;
    const LongSingularValues svd = singular_values(by);
    Index rank = 0;
    while (rank < svd.values.size() && svd.values[rank] > free_below * svd.values[0]) ++rank;
    LongMatrix local = LongMatrix::Zero(here.tangent.along.cols(), columns - rank);
    for (Index j = 0; j < columns; ++j)
        local.row(here.unknowns[static_cast<std::size_t>(j)]) =
            unit[j] * svd.right.row(j).rightCols(columns - rank);
    const LongMatrix whole = here.tangent.along * local;
    const std::vector<MovingState>& states = problem.states();
    LongMatrix scaled(n + static_cast<Index>(states.size()), whole.cols());
    for (Index i = 0; i < n; ++i)
        scaled.row(i) = whole.row(i) * (problem.essential()[i] ? 1 / problem.scales()[i] : 0);
    for (std::size_t k = 0; k < states.size(); ++k)
        scaled.row(n + static_cast<Index>(k)) =
            whole.row(n + static_cast<Index>(states[k].place)) / states[k].scale;
    const LongSingularValues own = singular_values(scaled);
    Index count = 0;
    while (count < own.values.size() && own.values[count] > 1e-6L) ++count;
    LongMatrix combine = own.right.leftCols(count);
    for (Index k = 0; k < count; ++k) combine.col(k) /= own.values[k];
    return {.q = whole.topRows(n) * combine,
            .u = whole.bottomRows(whole.rows() - n) * combine,
            .scaled = scaled * combine};
}

Instant<long double> moved(const Instant<long double>& at, const Tangents& along, const LongColumn& by) {
    Instant<long double> result = at;
    const LongColumn q = along.q * by, u = along.u * by;
    for (std::size_t i = 0; i < result.q.size(); ++i) result.q[i] += q[static_cast<Index>(i)];
    for (std::size_t i = 0; i < result.u.size(); ++i) result.u[i] += u[static_cast<Index>(i)];
    return result;
}

/// The way from an instant to another by essential coordinates and states, in units of the scales.
LongColumn way(const SteadyProblem& problem, const std::vector<bool>& is_angle, const Instant<long double>& from,
               const Instant<long double>& to) {
    const std::vector<MovingState>& states = problem.states();
    LongColumn result = LongColumn::Zero(static_cast<Index>(from.q.size() + states.size()));
    for (std::size_t i = 0; i < from.q.size(); ++i) {
        if (!problem.essential()[i]) continue;
        const long double d = to.q[i] - from.q[i];
        result[static_cast<Index>(i)] = (is_angle[i] ? std::remainder(d, whole_turn) : d) / problem.scales()[i];
    }
    for (std::size_t k = 0; k < states.size(); ++k)
        result[static_cast<Index>(from.q.size() + k)] =
            (to.u[states[k].place] - from.u[states[k].place]) / states[k].scale;
    return result;
}

/// In units of the speeds themselves where these exceed 1, which tells the two sides of a pole apart.
long double change_of_speeds(const Instant<long double>& from, const Instant<long double>& to) {
    long double largest = 0, size = 1;
    for (std::size_t i = 0; i < from.u.size(); ++i) {
        largest = std::max(largest, std::abs(to.u[i] - from.u[i]));
        size = std::max(size, std::abs(from.u[i]));
    }
    return largest / size;
}

/// Coordinates and states by which the directions differ: those that are written first, where they differ clearly.
std::vector<int> coordinates_of(LongMatrix directions) {
    std::vector<int> result;
    const Index wanted = directions.cols();
    for (const long double clear : {direction, 1e-6L})
        for (Index i = 0; i < directions.rows() && static_cast<Index>(result.size()) < wanted; ++i) {
            const long double length = directions.row(i).norm();
            if (length < clear) continue;
            const LongMatrix chosen = directions.row(i) / length;
            directions -= LongMatrix(directions * chosen.transpose() * chosen);
            result.push_back(static_cast<int>(i));
        }
    std::sort(result.begin(), result.end());
    return result;
}

/// Combination of the tangents by which to go next, where `left` is the straight way and `last` the step before:
/// straight where the tangents allow it, else on in the same direction, for the way may bend.
LongColumn next_step(const LongMatrix& tangents, const LongColumn& left, const LongColumn& last) {
    LongColumn by = tangents.transpose() * left;
    const long double longest = std::max(usual_way, left.norm() / 3);
    const bool is_straight = by.norm() > straight * left.norm();
    if (last.size() == 0) {
        if (!is_straight)
            by = by.norm() > 0 ? LongColumn(usual_way / by.norm() * by) : LongColumn::Unit(by.size(), 0);
    } else if (left.norm() > 2 * last.norm()) {
        const LongColumn on = tangents.transpose() * last;
        if (on.norm() > 0 && (!is_straight || by.dot(on) < 0))
            by = std::min(last.norm(), usual_way) / on.norm() * on;
    }
    return by.norm() > longest ? LongColumn(longest / by.norm() * by) : by;
}

/// The root beside another one where that is moved, if it is about as far.
std::optional<SteadyRoot> root_near(const SteadyProblem& problem, const std::vector<bool>& is_angle,
                                    const Instant<long double>& at, const Tangents& along, const LongColumn& by,
                                    Rates rates) {
    auto found = problem.solve(moved(at, along, by), rates);
    if (!found) return std::nullopt;
    const long double apart = way(problem, is_angle, at, found->at).norm(), wanted = by.norm();
    return apart > wanted / 3 && apart < 3 * wanted ? found : std::nullopt;
}

/// Whether there are roots on the way from a root to one beside it and beyond, which may bend.
bool goes_on(const SteadyProblem& problem, const std::vector<bool>& is_angle, const SteadyRoot& root,
             const SteadyRoot& beside, Rates rates) {
    LongColumn last = way(problem, is_angle, root.at, beside.at);
    Instant<long double> at = beside.at;
    for (long double gone = last.norm(); gone < farther * beside_root; gone += last.norm()) {
        const Tangents here = tangents_at(problem, at, rates);
        if (here.scaled.cols() == 0) return false;
        const LongColumn on = here.scaled.transpose() * last;
        if (!(on.norm() > straight * last.norm())) return false;
        const auto next = root_near(problem, is_angle, at, here, 2 * last.norm() / on.norm() * on, rates);
        if (!next) return false;
        last = way(problem, is_angle, at, next->at);
        at = next->at;
    }
    return true;
}

}  // namespace

std::optional<SteadyFamily> family_of(const SteadyProblem& problem, const std::vector<bool>& is_angle,
                                      const SteadyRoot& root, Rates rates) {
    const Tangents here = tangents_at(problem, root.at, rates);
    const Index k = here.scaled.cols();
    LongMatrix found(here.scaled.rows(), 0), directions = here.scaled;
    Index least = k;
    for (Index j = 0; j < k; ++j)
        for (const long double step : {beside_root, -beside_root}) {
            const auto beside = root_near(problem, is_angle, root.at, here, step * LongColumn::Unit(k, j), rates);
            const auto is_far = [&] {
                return root_near(problem, is_angle, root.at, here, farther * step * LongColumn::Unit(k, j), rates)
                           .has_value() ||
                       goes_on(problem, is_angle, root, *beside, rates);
            };
            if (!beside || !is_far()) continue;
            const LongColumn to = way(problem, is_angle, root.at, beside->at);
            found.conservativeResize(Eigen::NoChange, found.cols() + 1);
            found.col(found.cols() - 1) = to / to.norm();
            const Tangents there = tangents_at(problem, beside->at, rates);
            if (there.scaled.cols() < least) least = there.scaled.cols(), directions = there.scaled;
            break;
        }
    if (found.cols() == 0 || least == 0) return {};
    const LongColumn sizes = singular_values(found).values;
    const Index different = (sizes.array() > direction).count();
    if (different < least) directions = singular_values(found).left.leftCols(different);
    SteadyFamily family{.dimension = static_cast<int>(std::min(different, least)),
                        .free = coordinates_of(directions)};
    for (int& i : family.free)
        if (i >= problem.residuals().n)
            i = problem.residuals().n +
                static_cast<int>(problem.states()[static_cast<std::size_t>(i - problem.residuals().n)].number);
    return family;
}

bool leads_to(const FamilyWays& ways, const SteadyRoot& from, const SteadyRoot& to) {
    const auto& [problem, borders, is_angle, rates] = ways;
    Instant<long double> at = from.at;
    LongColumn last;
    long double shortened = 1;
    bool was_away = false;
    for (int step = 0; step < most_ways; ++step) {
        const LongColumn left = way(problem, is_angle, at, to.at);
        if (left.cwiseAbs().maxCoeff() < arrived) return true;
        const Tangents here = tangents_at(problem, at, rates);
        if (here.scaled.cols() == 0) return false;
        const LongColumn by = shortened * next_step(here.scaled, left, last);
        const Instant<long double> aim = moved(at, here, by);
        const auto next = problem.solve(aim, rates);
        const long double length = std::max(by.norm(), change_of_speeds(at, aim));
        if (!next || !(way(problem, is_angle, aim, next->at).norm() < bend * length) ||
            !(change_of_speeds(aim, next->at) < bend * length) || borders.passed(at, next->at) > 1) {
            shortened /= 2;
            if (by.norm() < least_way) return false;
            continue;
        }
        last = way(problem, is_angle, at, next->at);
        at = next->at;
        shortened = std::min(1.0L, 2 * shortened);
        const long double round = way(problem, is_angle, from.at, at).norm();
        if (was_away && round < last.norm() / 2) return false;  // a circle that does not pass the other root
        was_away = was_away || round > 2 * last.norm();
    }
    return false;
}

namespace {

/// A way along a family of dimension 1, on which one coordinate or state rises or falls.
class WayOut {
public:
    WayOut(const FamilyWays& ways, int free)
        : problem_(ways.problem), borders_(ways.borders), is_angle_(ways.is_angle), rates_(ways.rates) {
        const int n = problem_.residuals().n;
        row_ = free;
        for (std::size_t k = 0; free >= n && k < problem_.states().size(); ++k)
            if (static_cast<int>(problem_.states()[k].number) == free - n) row_ = n + static_cast<int>(k);
    }

    struct Reached {
        bool is_end = false;
        bool goes_on = false;   ///< round a whole turn, or back to values of what is free that it has had
        long double value = 0;  ///< of what is free, at the end or where the way was lost
    };

    /// How far the way leads to a side, or until `arrives` is true on it: it gets each state, and how far the next
    /// one may be.
    template <typename Arrives>
    Reached follow(const SteadyRoot& root, long double side, const Arrives& arrives) const {
        constexpr long double shortest = 1e-13L, turns = 1e-3L;
        Instant<long double> at = root.at;
        const auto lost = [&] { return Reached{.value = value(at)}; };
        LongColumn last;
        long double step = usual_way / 4;
        for (int tries = 0; tries < 3 * most_ways; ++tries) {
            const Tangents here = tangents_at(problem_, at, rates_);
            if (here.scaled.cols() == 0 && !borders_.empty())
                return {.is_end = true, .value = value(at)};  // at a knot beyond which forces act
            if (here.scaled.cols() != 1) return lost();
            LongColumn by = LongColumn::Unit(1, 0);
            if (here.scaled(row_, 0) * side < 0) by = -by;
            const LongColumn along = here.scaled * by;
            if (!(along[row_] * side > turns) || (last.size() > 0 && along.dot(last) < 0))
                return {.goes_on = true, .value = value(at)};
            const Instant<long double> aim = moved(at, here, step * by);
            const auto next = problem_.solve(aim, rates_);
            if (!next || !(way(problem_, is_angle_, aim, next->at).norm() < bend * step) ||
                borders_.passed(at, next->at) > 1) {
                step /= 2;
                if (step >= shortest) continue;
                const Border border = beyond_border(at, here, by, side);
                if (!border.is_there) return lost();  // a pole, of which digits are lost
                if (!border.next) return {.is_end = true, .value = value(at)};
                last = way(problem_, is_angle_, at, border.next->at);
                last /= last.norm();
                at = border.next->at;
                step = usual_way / 64;
                continue;
            }
            last = along;
            at = next->at;
            step = std::min(2 * step, usual_way);
            if (arrives(at, 2 * step)) return lost();
            if (is_whole_turn(root.at, at)) return {.goes_on = true, .value = value(at)};
        }
        return lost();
    }

private:
    struct Border {
        bool is_there = false;
        std::optional<SteadyRoot> next = {};  ///< a member beyond it
    };
    /// A border that is so near that no step is short enough, and a member beyond it, where the way goes on with a
    /// corner. Beyond an end Newton's method comes back to the border.
    Border beyond_border(const Instant<long double>& at, const Tangents& here, const LongColumn& by,
                         long double side) const {
        constexpr long double beyond = 1e-6L, far = 1e3L, progress = 1e-5L;
        const Instant<long double> aim = moved(at, here, beyond * by);
        Border border{.is_there = borders_.passed(moved(at, here, -beyond * by), aim) > 0};
        if (!border.is_there) return border;
        const auto try_from = [&](const Instant<long double>& guess) {
            const auto next = problem_.solve(guess, rates_);
            if (!next || border.next || way(problem_, is_angle_, at, next->at).norm() > far * beyond) return;
            const long double gone = way(problem_, is_angle_, at, next->at)[row_] * side;
            if (gone > progress * beyond && tangents_at(problem_, next->at, rates_).scaled.cols() == 1)
                border.next = next;
        };
        try_from(aim);
        const Tangents there = tangents_at(problem_, aim, rates_);  // at a right angle the first leads back
        if (there.scaled.cols() == 1)
            try_from(
                moved(at, there, LongColumn::Constant(1, there.scaled(row_, 0) * side < 0 ? -beyond : beyond)));
        return border;
    }

    long double value(const Instant<long double>& at) const {
        const auto row = static_cast<std::size_t>(row_);
        return row < at.q.size() ? at.q[row] : at.u[problem_.states()[row - at.q.size()].place];
    }
    bool is_whole_turn(const Instant<long double>& from, const Instant<long double>& to) const {
        const auto row = static_cast<std::size_t>(row_);
        return row < is_angle_.size() && is_angle_[row] && std::abs(value(to) - value(from)) > whole_turn;
    }

    const SteadyProblem& problem_;
    const Borders& borders_;
    const std::vector<bool>& is_angle_;
    Rates rates_;
    int row_;
};

}  // namespace

void find_ends(const FamilyWays& ways, SteadyFamily& family, const SteadyRoot& root) {
    if (family.dimension != 1) return;
    const WayOut out(ways, family.free[0]);
    const auto never = [](const Instant<long double>&, long double) { return false; };
    for (const long double side : {-1.0L, 1.0L}) {
        const WayOut::Reached reached = out.follow(root, side, never);
        if (reached.is_end)
            (side < 0 ? family.from : family.to) = reached.value;
        else if (!reached.goes_on)
            (side < 0 ? family.seen_from : family.seen_to) = reached.value;
    }
}

bool leads_round(const FamilyWays& ways, const SteadyFamily& family, const SteadyRoot& from,
                 const SteadyRoot& to) {
    const auto free = static_cast<std::size_t>(family.free[0]);
    const bool is_angle = free < ways.is_angle.size() && ways.is_angle[free];
    if (family.dimension != 1 || (!is_angle && ways.borders.empty())) return false;
    const WayOut out(ways, family.free[0]);
    bool arrived = false;
    const auto arrives = [&](const Instant<long double>& at, long double reach) {
        SteadyRoot here = from;
        here.at = at;
        arrived = way(ways.problem, ways.is_angle, at, to.at).norm() < reach && leads_to(ways, here, to);
        return arrived;
    };
    for (const long double side : {-1.0L, 1.0L})
        if (!arrived) out.follow(from, side, arrives);
    return arrived;
}

}  // namespace alembert
