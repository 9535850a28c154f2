// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/scene_motion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "program/lower/lower.hpp"
#include "scene/body_points.hpp"
#include "scene/text.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

using Given = std::vector<std::pair<GiNaC::symbol, int>>;

Given all_as(Program& program, const std::vector<GiNaC::symbol>& symbols, int which) {
    Given given;
    for (std::size_t k = 0; k < symbols.size(); ++k)
        given.emplace_back(symbols[k], program.number(static_cast<int>(k) == which ? 1 : 0));
    return given;
}

bool is_zero_vector(const SymbolicVector& v) {
    return v[0].is_zero() && v[1].is_zero() && v[2].is_zero();
}

std::vector<std::string> names_in(const Scene& scene, bool frames) {
    std::vector<std::string> names;
    if (frames) {
        names.emplace_back("N");
        for (const Frame& f : scene.frames) names.push_back(f.name.text);
        for (const Body& b : scene.bodies) names.push_back(b.name.text);
        return names;
    }
    names.emplace_back("O");
    for (std::string& name : points_of(scene)) names.push_back(std::move(name));
    return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

SceneMotion::Rates::Rates(SceneMotion& of, const Given& given)
    : program_(&of.p_), lowering_(lowering_into(of.p_, of.m_, given, of.fold_)) {}

SceneMotion::SceneMotion(Program& program, const Scene& scene, const Mechanism& mechanism, bool fold)
    : p_(program),
      scene_(scene),
      m_(mechanism),
      fold_(fold),
      formulas_(scene, mechanism),
      symbolic_(*this, {}),
      resting_(*this, all_as(program, mechanism.qdot, -1)),
      unaccelerated_(*this, all_as(program, mechanism.qddot, -1)) {
    gather_masses();
}

const SceneMotion::Rates& SceneMotion::unit_rate(int k) {
    return units_.try_emplace(k, *this, all_as(p_, m_.qdot, k)).first->second;
}

void check_spot(const Scene& scene, const std::string& name) {
    const std::size_t cut = name.find('@');
    const std::string point = name.substr(0, cut);
    const std::vector<std::string> points = names_in(scene, false), frames = names_in(scene, true);
    if (!has(points, point) && has(frames, point))
        throw ModelError(
            say("{} is a frame, which has directions but no place; name a point with it, as in '{}@{}'",
                in_quotes(point), points.back(), point));
    if (!has(points, point))
        throw ModelError(
            say("there is no point or body {}; expected one of: {}", in_quotes(point), fmt::join(points, ", ")));
    const std::string frame = cut == std::string::npos ? "N" : name.substr(cut + 1);
    if (!has(frames, frame))
        throw ModelError(
            say("there is no frame or body {}; expected one of: {}", in_quotes(frame), fmt::join(frames, ", ")));
}

SceneMotion::Spot SceneMotion::spot(const std::string& name) {
    check_spot(scene_, name);
    const std::size_t cut = name.find('@');
    const std::string point = name.substr(0, cut);
    const std::string frame = cut != std::string::npos             ? name.substr(cut + 1)
                              : has(names_in(scene_, true), point) ? point
                                                                   : places().frame_of(point);
    return {.point = places().point(point), .frame = places().orientation(frame).frame};
}

SceneMotion::Spot SceneMotion::spot_of(const MassElement& mass) {
    const std::string& name = mass.origin.name;
    return {.point = places().point(places().centre_of(name)),
            .frame = mass.rotation ? places().orientation(name).frame : 0};
}

SceneMotion::Origin SceneMotion::origin_of(const MassElement& mass) {
    Origin origin{.spot = spot_of(mass)};
    const std::vector<GiNaC::symbol> moving = m_.moving();
    const auto is_fixed = [&](const Skeleton::Step& step) {
        return step.frame == origin.spot.frame &&
               std::none_of(step.offset.begin(), step.offset.end(),
                            [&](const ex& e) { return m_.z->depends(e, moving); });
    };
    while (mass.rotation && origin.spot.point != 0 && is_fixed(step_of(origin.spot.point))) {
        for (std::size_t k = 0; k < 3; ++k) origin.centre[k] += step_of(origin.spot.point).offset[k];
        origin.spot.point = step_of(origin.spot.point).from;
    }
    return origin;
}

LinearAngular SceneMotion::turning(int frame) {
    LinearAngular result;
    if (frame == 0) return result;
    const Vector3& w = places().attitude(frame).w_NF_F;
    const std::vector<ex> rate = m_.time_derivative({w[0], w[1], w[2]});
    for (std::size_t k = 0; k < 3; ++k) {
        result.linear[k] = symbolic_(w[k]);
        result.angular[k] = symbolic_(rate[k]);
    }
    return result;
}

Matrix<Symbolic> SceneMotion::rotation(int frame) {
    const auto [place, is_new] = rotations_.try_emplace(frame);
    for (std::size_t i = 0; is_new && i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) place->second[i][k] = symbolic_(places().attitude(frame).axes[k][i]);
    return place->second;
}

SymbolicVector SceneMotion::along_N(int frame, const Vector3& components, const Rates& rates) {
    const SymbolicVector v{rates(components[0]), rates(components[1]), rates(components[2])};
    return frame == 0 || is_zero_vector(v) ? v : rotation(frame) * v;
}

std::vector<int> SceneMotion::way(int point) {
    std::vector<int> points;
    for (; point != 0; point = step_of(point).from) points.push_back(point);
    std::reverse(points.begin(), points.end());
    return points;
}

SymbolicVector SceneMotion::position(int point) {
    SymbolicVector r{0, 0, 0};
    for (const int p : way(point)) r = r + step(p);
    return r;
}

const SymbolicVector& SceneMotion::angular(int frame, const Rates& rates) {
    if (const auto found = rates.angular_.find(frame); found != rates.angular_.end()) return found->second;
    SymbolicVector omega{0, 0, 0};
    if (frame != 0) {
        const Skeleton::Turn turn = places().skeleton().frames[static_cast<std::size_t>(frame)];
        if (turn.by_quaternion) {
            omega = along_N(frame, places().attitude(frame).w_NF_F, rates);
        } else {
            omega = angular(turn.parent, rates);
            const Symbolic rate = rates(places().rate(turn.angle));
            if (!rate.is_zero()) omega = omega + rate * along_N(frame, turn.axis, symbolic_);
        }
    }
    return rates.angular_[frame] = omega;
}

const SymbolicVector& SceneMotion::angular_rate(int frame, const Rates& rates) {
    if (const auto found = rates.angular_rate_.find(frame); found != rates.angular_rate_.end())
        return found->second;
    SymbolicVector alpha{0, 0, 0};
    if (frame != 0) {
        const Skeleton::Turn turn = places().skeleton().frames[static_cast<std::size_t>(frame)];
        if (turn.by_quaternion) {
            const Vector3& w = places().attitude(frame).w_NF_F;
            const std::vector<ex> rate = m_.time_derivative({w[0], w[1], w[2]});
            alpha = along_N(frame, {rate[0], rate[1], rate[2]}, rates);
        } else {
            alpha = angular_rate(turn.parent, rates);
            const ex rate = places().rate(turn.angle);
            if (!rate.is_zero()) {
                const SymbolicVector axis = along_N(frame, turn.axis, symbolic_);
                alpha = alpha + rates(places().rate(rate)) * axis +
                        symbolic_(rate) * cross(angular(turn.parent, symbolic_), axis);
            }
        }
    }
    return rates.angular_rate_[frame] = alpha;
}

SymbolicVector SceneMotion::step_rate(int point, const Rates& rates, int order) {
    std::vector<ex> rate(step_of(point).offset.begin(), step_of(point).offset.end());
    for (int k = 0; k < order; ++k) rate = m_.time_derivative(rate);
    return along_N(step_of(point).frame, {rate[0], rate[1], rate[2]}, rates);
}

bool SceneMotion::same(const SymbolicVector& a, const SymbolicVector& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a[k].node(p_) != b[k].node(p_)) return false;
    return true;
}

LinearAngular SceneMotion::velocity(const Spot& spot, const Rates& rates) {
    LinearAngular result{.angular = angular(spot.frame, rates)};
    const std::vector<int> points = way(spot.point);
    for (std::size_t first = 0, end = 0; first < points.size(); first = end) {
        const SymbolicVector omega = angular(step_of(points[first]).frame, rates);
        while (end < points.size() && same(angular(step_of(points[end]).frame, rates), omega)) ++end;
        const bool is_single = end == first + 1;
        const SymbolicVector arm =
            is_single ? step(points[first]) : position(points[end - 1]) - position(step_of(points[first]).from);
        if (!is_zero_vector(omega)) result.linear = result.linear + cross(omega, arm);
        for (std::size_t k = first; k < end; ++k) result.linear = result.linear + step_rate(points[k], rates, 1);
    }
    return result;
}

LinearAngular SceneMotion::column(const Spot& spot, int k) {
    const LinearAngular moving = velocity(spot, unit_rate(k)), offset = velocity(spot, resting_);
    return {moving.linear - offset.linear, moving.angular - offset.angular};
}

LinearAngular SceneMotion::acceleration(const Spot& spot, bool accelerated) {
    const Rates& rates = accelerated ? symbolic_ : unaccelerated_;
    LinearAngular result{.angular = angular_rate(spot.frame, rates)};
    for (const int point : way(spot.point)) {
        const int frame = step_of(point).frame;
        const SymbolicVector arm = step(point), omega = angular(frame, symbolic_),
                             first = step_rate(point, symbolic_, 1);
        result.linear = result.linear + cross(angular_rate(frame, rates), arm) +
                        cross(omega, cross(omega, arm) + first + first) + step_rate(point, rates, 2);
    }
    return result;
}

void SceneMotion::gather_masses() {
    for (const MassElement& mass : m_.masses) {
        const Symbolic m = symbolic_(mass.mass);
        total_ = total_ + m;
        for (int point = spot_of(mass).point; point != 0; point = step_of(point).from)
            carried_[point].mass = carried_[point].mass + m;
    }
    for (auto item = carried_.rbegin(); item != carried_.rend(); ++item) {  // a point comes after its `from`
        auto& [point, own] = *item;
        own.moment = own.moment + own.mass * step(point);
        own.frames.insert(step_of(point).frame);
        const int from = step_of(point).from;
        if (from == 0) {
            moment_ = moment_ + own.moment;
            continue;
        }
        Carried& above = carried_[from];
        above.moment = above.moment + own.moment;
        above.next.push_back(point);
        above.frames.insert(own.frames.begin(), own.frames.end());
    }
}

SymbolicVector SceneMotion::moment_rate(int point, const Rates& rates) {
    const Carried& own = carried_.at(point);
    const SymbolicVector& omega = angular(step_of(point).frame, rates);
    const bool is_rigid = std::all_of(own.frames.begin(), own.frames.end(),
                                      [&](int frame) { return same(angular(frame, rates), omega); });
    SymbolicVector result = own.mass * step_rate(point, rates, 1);
    if (!is_zero_vector(omega)) result = result + cross(omega, is_rigid ? own.moment : own.mass * step(point));
    for (const int next : own.next)
        result = result + (is_rigid ? shift_rate(next, rates) : moment_rate(next, rates));
    return result;
}

SymbolicVector SceneMotion::shift_rate(int point, const Rates& rates) {
    const Carried& own = carried_.at(point);
    SymbolicVector result = own.mass * step_rate(point, rates, 1);
    for (const int next : own.next) result = result + shift_rate(next, rates);
    return result;
}

SymbolicVector SceneMotion::linear_momentum(const Rates& rates) {
    SymbolicVector result{0, 0, 0};
    for (const auto& [point, own] : carried_)
        if (step_of(point).from == 0) result = result + moment_rate(point, rates);
    return result;
}

Symmetric<Symbolic> SceneMotion::inertia_along_N(const MassElement& mass) {
    return congruent(rotation(spot_of(mass).frame), inertia_along_body(mass));
}

Symmetric<Symbolic> SceneMotion::inertia_along_body(const MassElement& mass) {
    const std::array<ex, 6> inertia = central_inertia(mass, *m_.z);
    Symmetric<Symbolic> I;
    for (std::size_t k = 0; k < 6; ++k) I[k] = symbolic_(inertia[k]);
    return I;
}

LinearAngular SceneMotion::momentum(const Rates& rates) {
    const SymbolicVector centre = mass_centre();
    LinearAngular result;
    for (const MassElement& mass : m_.masses) {
        const Spot spot = spot_of(mass);
        const SymbolicVector mv = symbolic_(mass.mass) * velocity(spot, rates).linear;
        result.linear = result.linear + mv;
        result.angular = result.angular + cross(position(spot.point) - centre, mv);
        if (!mass.rotation) continue;
        const Vector3& w = places().attitude(spot.frame).w_NF_F;
        result.angular = result.angular +
                         rotation(spot.frame) *
                             (inertia_along_body(mass) * SymbolicVector{rates(w[0]), rates(w[1]), rates(w[2])});
    }
    return result;
}

LinearAngular SceneMotion::momentum_column(int k) {
    const LinearAngular moving = momentum(unit_rate(k)), resting = momentum(resting_);
    return {moving.linear - resting.linear, moving.angular - resting.angular};
}

// With Σ m (r − c) × a about the moving mass centre: its velocity is parallel to the momentum and adds nothing.
LinearAngular SceneMotion::momentum_drift() {
    const SymbolicVector centre = mass_centre();
    LinearAngular result;
    for (const MassElement& mass : m_.masses) {
        const Spot spot = spot_of(mass);
        const SymbolicVector ma = symbolic_(mass.mass) * acceleration(spot, false).linear;
        result.linear = result.linear + ma;
        result.angular = result.angular + cross(position(spot.point) - centre, ma);
        if (!mass.rotation) continue;
        const Symmetric<Symbolic> I = inertia_along_N(mass);
        const SymbolicVector w = angular(spot.frame, symbolic_);
        result.angular = result.angular + I * angular_rate(spot.frame, unaccelerated_) + cross(w, I * w);
    }
    return result;
}

}  // namespace alembert
