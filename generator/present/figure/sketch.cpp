// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/figure/sketch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/random.hpp"
#include "analysis/state/assemble.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

constexpr double near = 1e-7;  // relative to the scale; rounding is far smaller, and a change of shape far larger

std::vector<double> moved(std::vector<double> values, std::mt19937_64& random, double floor) {
    const UniformReal<> part(0.15, 0.45);
    const UniformReal<> unit(0, 1);
    for (double& v : values) {
        const double size = std::max(std::abs(v), floor), sign = unit(random) < 0.5 ? 1 : -1;
        v += sign * part(random) * size;
    }
    return values;
}

/// The coordinates of each quaternion whose length a constraint keeps at one.
std::vector<std::array<int, 4>> quaternions_of(const Mechanism& m) {
    std::vector<std::array<int, 4>> found;
    for (const Mechanism::Constraint& c : m.constraints) {
        if (!c.norm) continue;
        std::vector<int> four;
        for (std::size_t k = 0; k < c.row.size(); ++k)
            if (!c.row[k].is_zero()) four.push_back(static_cast<int>(k));
        if (four.size() == 4) found.push_back({four[0], four[1], four[2], four[3]});
    }
    return found;
}

void normalize(std::vector<double>& q, const std::array<int, 4>& four) {
    double square = 0;
    for (const int k : four) square += q[static_cast<std::size_t>(k)] * q[static_cast<std::size_t>(k)];
    for (const int k : four) q[static_cast<std::size_t>(k)] /= std::sqrt(square);
}

/// The assembled initial state; if it cannot be assembled, the numbers of the scene.
Start assembled(const Mechanism& m) {
    Start start = start_of(m);
    try {
        Start moved = start;
        assemble(moved, m, lower_constraints(m), {}, false);
        return moved;
    } catch (const std::exception&) {
        return start;
    }
}

}  // namespace

GiNaC::ex exactly(double value) {
    const GiNaC::ex size = exact_number(fmt::format("{:.12g}", std::abs(value)));
    return value < 0 ? -size : size;
}

Sketch::Sketch(const Scene& of, const Mechanism& mechanism)
    : scene(of), m(mechanism), formulas(of, mechanism), start(assembled(mechanism)) {
    State<double> state = start.state();
    std::fill_n(state.qdot.begin(), m.q.size(), 0.0);
    std::mt19937_64 random(1788);
    at_.push_back(state);
    const std::vector<std::array<int, 4>> quaternions = quaternions_of(m);
    for (int k = 1; k <= states; ++k) {
        State<double> other = state;
        other.q = moved(state.q, random, 0.5);
        for (const std::array<int, 4>& four : quaternions) normalize(other.q, four);
        if (k >= at_one_time) other.t += 0.37 * k;
        if (k == states) other.parameters = moved(state.parameters, random, 0.0);
        at_.push_back(other);
    }
    collect_sites();
    collect_masses();
    gravity_ = track(m.gravity);
}

int Sketch::track(const Vector3& value) {
    values_.push_back(value);
    return static_cast<int>(values_.size()) - 1;
}

void Sketch::collect_sites() {
    Places& places = formulas.places();
    const auto add = [&](Site::Of of, const std::string& name, const std::string& from, int mass = -1) {
        sites.push_back({of, name, track(places.position(name)), mass, from});
    };
    const auto mass_named = [&](Origin::Kind kind, const std::string& name) {
        for (std::size_t k = 0; k < m.masses.size(); ++k)
            if (m.masses[k].origin.kind == kind && m.masses[k].origin.name == name) return static_cast<int>(k);
        return -1;
    };
    add(Site::Of::origin, "O", "");
    for (const Point& p : scene.points) add(Site::Of::point, p.name.text, p.position.from.text);
    for (const Particle& p : scene.particles)
        add(Site::Of::mass, p.name.text, p.position.from.text, mass_named(Origin::Kind::particle, p.name.text));
    for (const Body& b : scene.bodies)
        add(Site::Of::mass, b.point().text, b.has_position ? b.position.from.text : "",
            mass_named(Origin::Kind::body, b.name.text));
    for (const Joint& joint : scene.joints)
        for (const Joint::Side* side : {&joint.parent, &joint.child}) {
            const Vector3 arm =
                places.orientation(side->body.text).to_inertial(places.vector(side->point), places.z());
            const Vector3 centre = places.position_of_body(side->body.text);
            sites.push_back({Site::Of::joint, joint.name.text,
                             track({centre[0] + arm[0], centre[1] + arm[1], centre[2] + arm[2]}), -1,
                             side->body.text});
        }
}

void Sketch::collect_masses() {
    Places& places = formulas.places();
    for (std::size_t k = 0; k < m.masses.size(); ++k) {
        const MassElement& element = m.masses[k];
        mass_tracks_.push_back(scalar(element.mass));
        const auto site =
            std::find_if(sites.begin(), sites.end(), [&](const Site& s) { return s.mass == static_cast<int>(k); });
        free_track.push_back(site->track);
        if (element.origin.kind != Origin::Kind::body) continue;
        const Orientation& o = places.orientation(element.origin.name);
        Frame3 body{.axes = {track(o.axis(0)), track(o.axis(1)), track(o.axis(2))},
                    .centre = free_track.back(),
                    .mass = static_cast<int>(k),
                    .name = element.origin.name};
        if (element.rotation)
            mass_tracks_.push_back(
                track({element.rotation->inertia[0], element.rotation->inertia[1], element.rotation->inertia[2]}));
        else
            mass_tracks_.push_back(track({0, 0, 0}));
        bodies.push_back(body);
    }
}

void Sketch::sample() {
    program_ = begun(m);
    std::vector<GiNaC::ex> list;
    for (const Vector3& value : values_) list.insert(list.end(), value.begin(), value.end());
    nodes_ = lower_expressions(program_, m, list);
    numbers_.clear();
    for (const State<double>& state : at_) {
        const std::vector<double> value = interpret(program_, state);
        Track all;
        for (std::size_t k = 0; k < values_.size(); ++k)
            all.emplace_back(value[nodes_[3 * k]], value[nodes_[3 * k + 1]], value[nodes_[3 * k + 2]]);
        numbers_.push_back(std::move(all));
    }
    std::size_t next = 0;
    masses.clear();
    auto body = bodies.begin();
    for (const MassElement& element : m.masses) {
        masses.push_back(at(0, mass_tracks_[next++])[0]);
        if (element.origin.kind != Origin::Kind::body) continue;
        body->weight = masses.back();
        const Eigen::Vector3d inertia = at(0, mass_tracks_[next++]);
        body->inertia = body->weight > 0 ? Eigen::Vector3d(inertia / body->weight) : Eigen::Vector3d(0, 0, 0);
        ++body;
    }
    down = at(0, gravity_);
    if (down.norm() > 0) down.normalize();
    find_plane();
}

void Sketch::find_plane() {
    std::array<bool, 3> flat{true, true, true};
    scale = 0;
    for (int s = 0; s < states; ++s) {
        const auto hold = [&](int track) {
            if (!is_finite(track)) return;
            for (int k = 0; k < 3; ++k) {
                scale = std::max(scale, std::abs(at(s, track)[k]));
                if (std::abs(at(s, track)[k]) > 1e-9) flat[k] = false;
            }
        };
        for (const Site& site : sites) hold(site.track);
        for (const int track : also) hold(track);
        for (const Frame3& body : bodies)
            for (int k = 0; k < 3; ++k)
                if (std::abs(at(s, body.axes[k])[k] - 1) > 1e-9) flat[k] = false;
    }
    if (scale == 0) scale = 1;
    for (const int k : {2, 1, 0})
        if (flat[k] && std::abs(down[k]) < 1e-9) {
            is_plane = true;
            normal = k;
            return;
        }
}

bool Sketch::is_finite(int track) const {
    for (int s = 0; s < states; ++s)
        if (!at(s, track).allFinite()) return false;
    return true;
}

bool Sketch::is_fixed(int track) const {
    for (int s = 1; s < states; ++s)
        if (!((at(s, track) - at(0, track)).norm() <= near * scale)) return false;
    return true;
}

bool Sketch::is_driven(int track) const {
    for (int s = 1; s < at_one_time; ++s)
        if (!((at(s, track) - at(0, track)).norm() <= near * scale)) return false;
    return !is_fixed(track);
}

bool Sketch::same(int a, int b) const {
    if (a == b) return true;
    for (int s = 0; s < states; ++s)
        if (!((at(s, a) - at(s, b)).norm() <= near * scale)) return false;
    return true;
}

std::optional<double> Sketch::distance(int a, int b) const {
    const double d = (at(0, a) - at(0, b)).norm();
    if (!(d > near * scale)) return {};
    for (int s = 1; s < states; ++s)
        if (!(std::abs((at(s, a) - at(s, b)).norm() - d) <= near * scale)) return {};
    return d;
}

bool Sketch::is_fixed_in(const std::array<int, 3>& axes, int centre, int place) const {
    Eigen::Vector3d first;
    for (int s = 0; s < states; ++s) {
        const Eigen::Vector3d arm = at(s, place) - at(s, centre);
        const Eigen::Vector3d own(arm.dot(at(s, axes[0])), arm.dot(at(s, axes[1])), arm.dot(at(s, axes[2])));
        if (s == 0) first = own;
        if (!((own - first).norm() <= near * scale)) return false;
    }
    return true;
}

std::optional<std::pair<double, double>> Sketch::shifted(const std::function<double(int)>& f,
                                                         const std::function<double(int)>& g) const {
    const double change = g(1) - g(0);
    if (!(std::abs(change) > near)) return {};
    const double ratio = (f(1) - f(0)) / change, constant = f(0) - ratio * g(0);
    if (!std::isfinite(ratio) || std::abs(ratio) < near) return {};
    for (int s = 2; s < states; ++s)
        if (!(std::abs(f(s) - ratio * g(s) - constant) <= near * std::max({1.0, scale, std::abs(constant)})))
            return {};
    return std::pair(ratio, constant);
}

std::string Sketch::name_of_length(int a, int b) const {
    const auto length = [&](int s) { return (at(s, a) - at(s, b)).norm(); };
    for (const double part : {1.0, 2.0})
        for (std::size_t k = 0; k < program_.parameters.size(); ++k) {
            const double here = start.parameters[k], there = at_[states].parameters[k];
            if (std::abs(length(0) - part * here) <= near * scale && here != there &&
                std::abs(length(states) - part * there) <= near * scale)
                return (part == 1 ? "" : "2*") + program_.parameters[k].name;
        }
    return "";
}

Eigen::Vector3d Sketch::with(int state, int track, int k, double value) const {
    State<double> other = at_[state];
    other.q[k] = value;
    const std::vector<double> values = interpret(program_, other);
    return {values[nodes_[3 * track]], values[nodes_[3 * track + 1]], values[nodes_[3 * track + 2]]};
}

const Sketch::Site& Sketch::canonical(int track) const {
    for (const Site& site : sites)
        if (same(site.track, track)) return site;
    throw std::logic_error("a track without a site");
}

const Sketch::Site* Sketch::site(const std::string& name) const {
    for (const Site& site : sites)
        if (site.of != Site::Of::joint && site.name == name) return &site;
    return nullptr;
}

int Sketch::spot(int track, int zeroed, const Eigen::Vector3d& own_shift) {
    Eigen::Vector3d shift = own_shift;
    for (const auto& [moved, by] : displaced)
        if (moved == track) shift += by;
    for (std::size_t k = 0; k < spots_.size(); ++k)
        if (spot_tracks_[k] == track && spots_[k].zeroed == zeroed && spots_[k].shift == shift)
            return static_cast<int>(k);
    spot_tracks_.push_back(track);
    spots_.push_back({.zeroed = zeroed, .shift = shift});
    return static_cast<int>(spots_.size()) - 1;
}

Drawing Sketch::finished() {
    Drawing drawing{.elements = elements, .notes = notes, .is_plane = is_plane, .normal = normal, .down = down};
    for (std::size_t k = 0; k < m.masses.size(); ++k) {
        drawing.traced.push_back(spot(free_track[k]));
        drawing.traced_names.push_back(m.masses[k].origin.name);
    }
    drawing.program = begun(m);
    if (!m.states.empty()) {  // which stand behind the rates, as in the program of the motion
        for (int i = 0; i < m.size(); ++i)
            drawing.program.speeds.push_back({.name = m.q[i].get_name() + "'", .unit = {}, .rate_of = i});
        for (const auto& state : m.states)
            drawing.program.speeds.push_back({.name = state.derivative[0].get_name(), .unit = state.unit});
    }
    std::vector<GiNaC::ex> list;
    for (const int track : spot_tracks_) list.insert(list.end(), values_[track].begin(), values_[track].end());
    const std::vector<int> nodes = lower_expressions(drawing.program, m, list);
    for (std::size_t k = 0; k < spots_.size(); ++k) spots_[k].root = static_cast<int>(3 * k);
    for (const int node : nodes) drawing.program.roots.push_back({Group::output, "", node});
    drawing.program = drawing.program.canonical();
    drawing.spots = spots_;
    return drawing;
}

Pose pose_at(const Drawing& drawing, const State<double>& state) {
    std::vector<std::vector<double>> values(state.q.size() + 1);
    const auto value_at = [&](int zeroed) -> const std::vector<double>& {
        std::vector<double>& value = values[zeroed + 1];
        if (value.empty()) {
            State<double> here = state;
            if (zeroed >= 0) here.q[zeroed] = 0;
            value = interpret(drawing.program, here);
        }
        return value;
    };
    Pose pose;
    for (const Drawing::Spot& spot : drawing.spots) {
        const std::vector<double>& value = value_at(spot.zeroed);
        const auto part = [&](int k) { return value[drawing.program.roots[spot.root + k].node]; };
        pose.push_back(Eigen::Vector3d(part(0), part(1), part(2)) + spot.shift);
    }
    return pose;
}

}  // namespace alembert
