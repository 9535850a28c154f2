// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/equilibrium/follow.hpp"

#include <algorithm>
#include <cmath>

namespace alembert {

using Column = VectorOf<long double>;

namespace {

constexpr long double first_step = 0.004L, longest = 0.02L, shortest = 1e-7L;
constexpr long double least_cosine = 0.99L;  // between tangents of neighbours
constexpr int most_points = 4000;
constexpr long double farthest = 1e3L;  // in units of the scales

class Following {
public:
    Following(const Tracer& tracer, const FollowRange& range, const std::vector<bool>& is_angle, EnergyRate energy)
        : tracer_(tracer), range_(range), is_angle_(is_angle), energy_(energy) {}

    /// Along the start's tangent or against it.
    void go(const TracedPoint& start, bool backward) {
        FollowedPoint here = judged(start);
        if (backward) here.point.tangent = -here.point.tangent, here.point.turn = -here.point.turn;
        std::vector<FollowedPoint> all{here};
        long double sigma = first_step;
        for (int count = 0;; ++count) {
            if (count == most_points) {
                result.cut = true;
                break;
            }
            const auto next = next_point(all.back().point, sigma);
            if (!next) {
                result.cut = true;
                break;
            }
            const FollowedPoint there = judged(*next);
            special_points(all, there);
            if (!inside(there.point.p)) {
                finish_at_bound(all, there.point);
                break;
            }
            if (count > 8 && is_back(start, there.point, all[0].point.tangent)) {
                all.push_back(judged(start));
                result.closed = true;
                break;
            }
            all.push_back(there);
            if (tracer_.place(there.point.at, 0).cwiseAbs().maxCoeff() > farthest) break;
        }
        if (backward)
            result.points.insert(result.points.begin(), all.rbegin(), all.rend() - 1);
        else
            result.points = std::move(all);
    }

    Followed result;

private:
    bool inside(double p) const {
        return p >= std::min(range_.from, range_.to) && p <= std::max(range_.from, range_.to);
    }
    FollowedPoint judged(const TracedPoint& point) const {
        return {.point = point, .judgement = judge(tracer_.problem(), energy_, point.at)};
    }

    std::optional<TracedPoint> next_point(const TracedPoint& from, long double& sigma) const {
        for (; sigma > shortest; sigma /= 2) {
            const auto next = tracer_.step(from, sigma);
            if (!next || next->tangent.dot(from.tangent) < least_cosine) continue;
            sigma = std::min(longest, 1.5L * sigma);
            return next;
        }
        return {};
    }

    bool is_back(const TracedPoint& start, const TracedPoint& now, const Column& tangent) const {
        const long double q = distance(tracer_.problem(), is_angle_, start.at, now.at);
        const long double p = std::abs(start.p - now.p) / tracer_.span();
        return std::max(q, p) < now.step && tangent.dot(now.tangent) > 0.9L;
    }

    void finish_at_bound(std::vector<FollowedPoint>& all, const TracedPoint& outside) {
        const TracedPoint& last = all.back().point;
        const double bound = (outside.p > last.p) == (range_.to > range_.from) ? range_.to : range_.from;
        const long double part = (bound - last.p) / (static_cast<long double>(outside.p) - last.p);
        Instant<long double> guess = last.at;
        for (std::size_t i = 0; i < guess.q.size(); ++i) guess.q[i] += part * (outside.at.q[i] - last.at.q[i]);
        if (part < 1e-9L) return;
        if (const auto end = tracer_.at_parameter(guess, bound);
            end && distance(tracer_.problem(), is_angle_, end->at, guess) < 0.1L)
            all.push_back(judged(*end));
    }

    /// The point at which a function vanishes between two points. The second was reached by `step` from the first.
    std::optional<TracedPoint> located(const TracedPoint& a, const TracedPoint& b,
                                       const std::function<long double(const TracedPoint&)>& f) const {
        long double low = 0, high = b.step, f_low = f(a), f_high = f(b);
        std::optional<TracedPoint> best;
        long double least = HUGE_VALL;  // of |f| so far: a step may end on the other curve
        int side = 0;
        for (int k = 0; k < 90 && high - low > 1e-17L; ++k) {
            long double middle = (low * f_high - high * f_low) / (f_high - f_low);  // false position, Illinois
            if (k % 3 == 2 || !(middle > low && middle < high)) middle = (low + high) / 2;
            auto point = tracer_.step(a, middle);
            for (const long double part : {2.0L / 3, 1.0L / 3, 0.45L, 0.58L, 0.9L, 0.1L}) {
                if (point) break;  // otherwise it is the point at which curves cross, or too near to it
                middle = low + part * (high - low);
                point = tracer_.step(a, middle);
            }
            if (!point) break;
            const long double value = f(*point);
            if (!std::isfinite(value)) break;
            if (std::abs(value) < least) best = point, least = std::abs(value);
            if (value == 0) break;
            if ((value > 0) == (f_low > 0)) {
                low = middle, f_low = value;
                if (side == 1) f_high /= 2;
                side = 1;
            } else {
                high = middle, f_high = value;
                if (side == -1) f_low /= 2;
                side = -1;
            }
        }
        return best;
    }

    void add(std::vector<FollowedPoint>& all, const TracedPoint& point, PointKind kind) const {
        if (!inside(point.p)) return;
        FollowedPoint one = judged(point);
        one.kind = kind;
        one.judgement.stable = Stable::undecided;
        one.point.turn = all.back().point.turn;
        all.push_back(one);
    }

    void special_points(std::vector<FollowedPoint>& all, const FollowedPoint& there) {
        const FollowedPoint here = all.back();
        const TracedPoint &a = here.point, &b = there.point;
        const Eigen::Index n = a.tangent.size() - 1;
        const long double turn_a = a.split.q == b.split.q ? a.turn : tracer_.turn_by(a, b.split);
        if (std::isfinite(turn_a) && std::isfinite(b.turn) && (turn_a > 0) != (b.turn > 0)) {
            const auto turn = [&](const TracedPoint& point) { return tracer_.turn_by(point, b.split); };
            if (const auto found = located(a, b, turn)) {
                const BranchCrossing crossing = crossing_at(tracer_, *found);
                if (inside(found->p)) result.crossings.emplace_back(*found, crossing);
                add(all, *found, crossing.kind);
            }
            return;
        }
        if ((a.tangent[n] > 0) != (b.tangent[n] > 0)) {
            const auto found = located(a, b, [&](const TracedPoint& point) { return point.tangent[n]; });
            if (found) add(all, *found, PointKind::fold);
            return;
        }
        const auto growing = [](const StabilityHint& is) {
            return std::count_if(is.eigenvalues.begin(), is.eigenvalues.end(),
                                 [](const auto& value) { return value.real() > 0; });
        };
        if (std::abs(growing(here.judgement) - growing(there.judgement)) == 2) add_hopf(all, here, there);
    }

    /// The largest real part of eigenvalues that are not real.
    static long double real_part(const StabilityHint& is) {
        long double result = -HUGE_VALL, size = 0;
        for (const auto& value : is.exact) size = std::max(size, std::abs(value));
        for (const auto& value : is.exact)
            if (std::abs(value.imag()) > 1e-6L * size) result = std::max(result, value.real());
        return result;
    }

    void add_hopf(std::vector<FollowedPoint>& all, const FollowedPoint& here, const FollowedPoint& there) const {
        const bool grows = there.judgement.stable == Stable::no && here.judgement.stable != Stable::no;
        const FollowedPoint& quiet = grows ? here : there;
        long double size = 0;
        for (const auto& value : quiet.judgement.exact) size = std::max(size, std::abs(value));
        const long double before = real_part(quiet.judgement);
        if (!std::isfinite(before) || !std::isfinite(real_part((grows ? there : here).judgement))) return;
        const bool on_axis = before > -1e-10L * size;  // pairs of eigenvalues meet on the axis and leave it
        const long double level = on_axis ? 1e-8L * size : 0;
        const auto found = located(here.point, there.point, [&](const TracedPoint& point) {
            return real_part(judge(tracer_.problem(), energy_, point.at)) - level;
        });
        if (found) add(all, *found, on_axis ? PointKind::hamiltonian_hopf : PointKind::hopf);
    }

    const Tracer& tracer_;
    FollowRange range_;
    const std::vector<bool>& is_angle_;
    EnergyRate energy_;
};

}  // namespace

Followed follow(const Tracer& tracer, const TracedPoint& start, const FollowRange& range,
                const std::vector<bool>& is_angle, EnergyRate energy) {
    Following following(tracer, range, is_angle, energy);
    following.go(start, false);
    if (!following.result.closed) following.go(start, true);
    return std::move(following.result);
}

}  // namespace alembert
