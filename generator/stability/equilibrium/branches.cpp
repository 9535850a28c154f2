// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/equilibrium/branches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "alembert/base/error.hpp"
#include "analysis/state/left_out.hpp"
#include "base/language/say.hpp"
#include "stability/equilibrium/follow.hpp"

namespace alembert {

using Column = VectorOf<long double>;

namespace {

constexpr int most_branches = 60;
constexpr int places = 7;                 // values of the parameter at which all equilibria are searched
constexpr long double on_branch = 2e-3L;  // in y: how near a curve is to the points between which it was traced
constexpr long double leave = 0.01L;      // first step away from a crossing
constexpr double one_value = 1e-9;        // of the range: a curve within has one value of the parameter
constexpr long double same_point = 1e-5L, same_crossing = 1e-3L;  // of y

class BranchSearch {
public:
    BranchSearch(Branches& result, const FollowOptions& options)
        : result_(result),
          options_(options),
          names_(names(options)),
          starts_(result.mechanism, names_),
          problem_(result.mechanism, result.equations,
                   start_at(options.from + inside_ * (options.to - options.from))),
          energy_(energy_rate(result.mechanism, problem_, start_at(options.from).parameters)),
          left_out_(result.mechanism) {
        check_name();
        // The sign of a power was proved for the scene's value of the parameter that is varied.
        if (energy_ != EnergyRate::constant) energy_ = EnergyRate::open;
    }

    void go() {
        const auto path = [this](double p) { return at(p); };
        for (int k = 0; k < places; ++k) {
            // not in the order of the parameter, and not at round values, where curves often cross
            const double part = k == 0 ? 0 : k == 1 ? 1 : std::fmod(0.381966 + 0.618034 * k, 1.0);
            const double p = options_.from + part * (options_.to - options_.from);
            if (options_.progress) options_.progress(say("searching"), static_cast<double>(k) / places);
            problem_.set_start(at(p));
            const SteadySearch found = search_steady(problem_, result_.mechanism, start_at(p), {});
            result_.is_angle = found.is_angle;
            if (found.rates == Rates::free) continue;
            const Tracer tracer(problem_, path, options_.to - options_.from);
            for (const SteadyRoot& root : found.roots) {
                left_out_.check(problem_.start_at(start_at(p), root.at));
                if (!root.isolated || is_known(tracer.place(root.at, p))) continue;
                if (const auto start = tracer.at_parameter(root.at, p)) follow_from(tracer, *start);
            }
        }
        const Tracer tracer(problem_, path, options_.to - options_.from);
        for (std::size_t k = 0; k < crossings_.size(); ++k) {
            const auto [point, crossing] = crossings_[k];
            for (const Column& direction : crossing.directions)
                for (const long double sign : {1.0L, -1.0L}) {
                    const Column way = sign * direction;
                    const auto start = tracer.step(point, leave, &way);
                    if (!start || !inside(start->p) || is_known(tracer.place(start->at, start->p))) continue;
                    follow_from(tracer, *start);
                }
        }
        tell_families(tracer);
        std::sort(result_.points.begin(), result_.points.end(),
                  [](const SpecialPoint& a, const SpecialPoint& b) { return a.parameter < b.parameter; });
        result_.essential = problem_.essential();
    }

private:
    static std::vector<std::string> names(const FollowOptions& options) {
        std::vector<std::string> result;
        for (const auto& [name, value] : options.at) {
            if (name == options.name)
                throw ModelError(say("--vary {} and --at {}: it cannot be held and followed", name, name));
            result.push_back(name);
        }
        result.push_back(options.name);
        return result;
    }
    Start start_at(double p) const {
        std::vector<double> values;
        for (const auto& [name, value] : options_.at) values.push_back(value);
        values.push_back(p);
        return starts_.at(values);
    }
    Instant<long double> at(double p) const {
        return instant_of<long double>(problem_.residuals(),
                                       state_of(start_at(p), result_.mechanism, result_.equations));
    }
    bool inside(double p) const {
        return p >= std::min(options_.from, options_.to) && p <= std::max(options_.from, options_.to);
    }

    void check_name() const {
        const Mechanism& m = result_.mechanism;
        for (int i = 0; i < m.size(); ++i) {
            const std::string q = m.q[i].get_name();
            if (options_.name == q || (options_.name == q + "'" && problem_.essential()[i]))
                throw ModelError(
                    say("--vary {}: an equilibrium has this value as an unknown; expected a parameter, "
                        "or the rate of a cyclic coordinate",
                        options_.name));
        }
        if (options_.name == "t")
            throw ModelError(say("--vary t: expected a parameter, or the rate of a cyclic coordinate"));
    }

    void follow_from(const Tracer& tracer, const TracedPoint& start) {
        if (result_.branches.size() >= most_branches) {
            result_.cut = true;
            return;
        }
        if (options_.progress) options_.progress(say("following"), 0.5);
        Followed followed = follow(tracer, start, {options_.from, options_.to}, result_.is_angle, energy_);
        result_.cut = result_.cut || followed.cut;
        crossings_.insert(crossings_.end(), followed.crossings.begin(), followed.crossings.end());
        Branch branch{.points = {}, .closed = followed.closed};
        for (const FollowedPoint& one : followed.points) {
            BranchPoint point{.parameter = one.point.p,
                              .q = {one.point.at.q.begin(), one.point.at.q.end()},
                              .stable = one.judgement.stable,
                              .kind = one.kind};
            if (one.kind && !is_told(tracer, one))
                result_.points.push_back(
                    {*one.kind, point.parameter, wrapped(one.point.at), result_.branches.size()});
            branch.points.push_back(std::move(point));
        }
        branch.family_at = one_parameter_of(branch);
        result_.branches.push_back(std::move(branch));
        std::vector<Column> curve;
        for (const FollowedPoint& one : followed.points) curve.push_back(tracer.place(one.point.at, one.point.p));
        curves_.push_back(std::move(curve));
    }

    std::optional<double> one_parameter_of(const Branch& branch) const {
        const auto [low, high] = std::minmax_element(
            branch.points.begin(), branch.points.end(),
            [](const BranchPoint& a, const BranchPoint& b) { return a.parameter < b.parameter; });
        const double range = options_.to - options_.from;
        if (branch.points.size() < 2 || high->parameter - low->parameter > one_value * range) return std::nullopt;
        const double middle = (low->parameter + high->parameter) / 2;
        return std::abs(middle) < one_value * range ? 0 : middle;
    }

    /// Without gravity each state of a pendulum is one of rest: there a branch meets a family, and is not forked.
    void tell_families(const Tracer& tracer) {
        for (SpecialPoint& point : result_.points)
            for (std::size_t k = 0; k < result_.branches.size(); ++k) {
                const std::optional<double> value = result_.branches[k].family_at;
                const double range = options_.to - options_.from;
                if (!value || std::abs(point.parameter - *value) > same_crossing * range) continue;
                Instant<long double> there = at(point.parameter);
                there.q.assign(point.q.begin(), point.q.end());
                if (!is_on(curves_[k], tracer.place(there, *value))) continue;
                point.kind = PointKind::family;
                point.parameter = *value;
            }
    }

    std::vector<double> wrapped(Instant<long double> at) const {
        wrap_angles(at, result_.is_angle);
        return {at.q.begin(), at.q.end()};
    }

    /// Folds are found to many digits; where curves cross, each of them finds the point to few.
    static long double same_of(PointKind kind) {
        const bool is_crossing =
            kind == PointKind::pitchfork || kind == PointKind::transcritical || kind == PointKind::touching;
        return is_crossing ? same_crossing : same_point;
    }

    /// Crossing curves find the same point, which is reported once.
    bool is_told(const Tracer& tracer, const FollowedPoint& one) {
        const Column y = tracer.place(one.point.at, one.point.p);
        for (const auto& [kind, other] : told_)
            if (kind == *one.kind && difference(y, other).cwiseAbs().maxCoeff() < same_of(kind)) return true;
        told_.emplace_back(*one.kind, y);
        return false;
    }

    Column difference(const Column& a, const Column& b) const {
        constexpr long double turn = 6.28318530717958647692528676655900577L;
        Column d = a - b;
        for (std::size_t i = 0; i < result_.is_angle.size(); ++i)
            if (const auto k = static_cast<Eigen::Index>(i); result_.is_angle[i])
                d[k] = std::remainder(d[k], turn);
        return d;
    }

    /// Is the point on a curve that was followed?
    bool is_known(const Column& y) const {
        return std::any_of(curves_.begin(), curves_.end(),
                           [&](const std::vector<Column>& curve) { return is_on(curve, y); });
    }

    bool is_on(const std::vector<Column>& curve, const Column& y) const {
        for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
            const Column along = difference(curve[k + 1], curve[k]), to = difference(y, curve[k]);
            const long double square = along.squaredNorm();
            const long double part = square > 0 ? std::clamp(to.dot(along) / square, 0.0L, 1.0L) : 0;
            if ((to - part * along).norm() < on_branch) return true;
        }
        return false;
    }

    static constexpr double inside_ = 0.4142;  // no round value, at which equations may be singular

    Branches& result_;
    const FollowOptions& options_;
    std::vector<std::string> names_;
    Starts starts_;
    SteadyProblem problem_;
    EnergyRate energy_;
    LeftOut left_out_;
    std::vector<std::vector<Column>> curves_;
    std::vector<std::pair<TracedPoint, BranchCrossing>> crossings_;
    std::vector<std::pair<PointKind, Column>> told_;
};

}  // namespace

Branches branches(Scene scene, const FollowOptions& options) {
    if (!(std::isfinite(options.from) && std::isfinite(options.to)) || options.from == options.to)
        throw ModelError(
            say("--vary {}={}:{}: expected two different numbers", options.name, options.from, options.to));
    Branches result{derived(std::move(scene), {.by = options.by, .at = options.at, .with_states = true})};
    result.parameter = options.name;
    result.from = options.from;
    result.to = options.to;
    FollowOptions upwards = options;
    if (upwards.from > upwards.to) std::swap(upwards.from, upwards.to);
    BranchSearch(result, upwards).go();
    return result;
}

}  // namespace alembert
