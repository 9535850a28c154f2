// SPDX-License-Identifier: GPL-2.0-or-later
/// Springs, dampers, hinges, the letters of coordinates, and loads.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "present/figure/parts.hpp"

#include "base/language/say.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;
using Kind = FigureElement::Kind;

/// Two points whose distance is, up to a constant, the expression along which a spring acts.
std::optional<std::pair<int, int>> ends_of(const Sketch& s, int along) {
    for (std::size_t i = 0; i < s.sites.size(); ++i)
        for (std::size_t j = i + 1; j < s.sites.size(); ++j) {
            const int a = s.sites[i].track, b = s.sites[j].track;
            if (!s.is_finite(a) || !s.is_finite(b) || s.same(a, b)) continue;
            const auto line = s.shifted([&](int state) { return std::abs(s.at(state, along)[0]); },
                                        [&](int state) { return (s.at(state, a) - s.at(state, b)).norm(); });
            if (line && std::abs(line->first - 1) < 1e-6 && std::abs(line->second) < 1e-6 * s.scale)
                return std::pair(a, b);
        }
    return {};
}

/// The coordinate that is equal to a value.
int coordinate_of(const Sketch& s, int along) {
    for (int k = 0; k < s.m.size(); ++k) {
        const auto line = s.shifted([&](int state) { return s.at(state, along)[0]; },
                                    [&](int state) { return s.coordinate(state, k); });
        if (line && std::abs(std::abs(line->first) - 1) < 1e-6) return k;
    }
    return -1;
}

double wrapped(double angle) {
    return std::remainder(angle, 2 * std::numbers::pi);
}

double angle_between(const Vector3d& a, const Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Does coordinate k turn the line from `pivot` to `end` about the pivot by its own value?
bool turns_by(const Sketch& s, int k, int pivot, int end) {
    for (int state = 0; state < Sketch::states; ++state) {
        const Vector3d still = s.with(state, pivot, k, 0), there = s.with(state, end, k, 0);
        if (!((still - s.at(state, pivot)).norm() <= 1e-7 * s.scale)) return false;
        const double angle = angle_between(there - still, s.at(state, end) - s.at(state, pivot));
        if (!(std::abs(angle - std::abs(wrapped(s.coordinate(state, k)))) < 1e-6)) return false;
    }
    return true;
}

/// Does coordinate k shift the point by its own value?
bool shifts_by(const Sketch& s, int k, int place) {
    for (int state = 0; state < Sketch::states; ++state) {
        const double way = (s.at(state, place) - s.with(state, place, k, 0)).norm();
        if (!(std::abs(way - std::abs(s.coordinate(state, k))) <= 1e-7 * std::max(s.scale, way))) return false;
    }
    // A point on a circle of radius one has moved by the chord, not by the angle.
    const double q = s.coordinate(1, k);
    const Vector3d once = s.with(1, place, k, q) - s.with(1, place, k, 0),
                   twice = s.with(1, place, k, 2 * q) - s.with(1, place, k, 0);
    return (twice - 2 * once).norm() <= 1e-7 * s.scale;
}

/// The direction in which the coordinate shifts the point, if it is always the same.
std::optional<Vector3d> direction_of(const Sketch& s, int k, int place) {
    std::optional<Vector3d> along;
    for (int state = 0; state < Sketch::states; ++state) {
        const Vector3d way = s.with(state, place, k, 1) - s.with(state, place, k, 0);
        if (along && (way - *along).norm() > 1e-7) return {};
        along = way;
    }
    return along;
}

/// The number of coordinates that move the point.
int movers(const Sketch& s, int place) {
    int count = 0;
    for (int k = 0; k < s.m.size(); ++k)
        if ((s.with(1, place, k, s.coordinate(1, k) + 0.1) - s.at(1, place)).norm() > 1e-7 * s.scale) ++count;
    return count;
}

/// Adds a rope or a radius between a mass and the point that it reaches when the coordinate is zero.
void add_rope(Sketch& s, int k, const Sketch::Site& end) {
    if (end.mass < 0 || direction_of(s, k, end.track)) return;
    for (const Sketch::Site& site : s.sites) {
        bool is_foot = s.is_finite(site.track);
        for (int state = 0; state < Sketch::states && is_foot; ++state)
            is_foot = (s.with(state, end.track, k, 0) - s.at(state, site.track)).norm() <= 1e-7 * s.scale;
        if (!is_foot) continue;
        const std::vector<int> points{s.spot(site.track), s.spot(end.track)};
        const bool is_spring = std::any_of(s.elements.begin(), s.elements.end(), [&](const FigureElement& e) {
            return (e.kind == Kind::spring || e.kind == Kind::damper) && e.points == points;
        });
        if (!is_spring) s.add({.kind = Kind::rope, .points = points});
        return;
    }
}

/// Tracks of the ends of an element, if they are tracks of the scene.
std::optional<std::pair<int, int>> ends_on(const std::vector<std::pair<int, int>>& known, int a, int b) {
    int from = -1, to = -1;
    for (const auto& [spot, track] : known) {
        if (spot == a) from = track;
        if (spot == b) to = track;
    }
    return from >= 0 && to >= 0 ? std::optional(std::pair(from, to)) : std::nullopt;
}

}  // namespace

void add_springs(Sketch& s, const Asked& asked, const LooksOfScene& looks) {
    const auto add = [&](const std::vector<Link>& links, const std::vector<int>& along, Kind kind,
                         const char* what) {
        // What acts along an expression is where the scene draws it, if it draws any.
        const bool is_drawn = looks.has(kind == Kind::spring ? Scenery::Kind::spring : Scenery::Kind::damper);
        for (std::size_t k = 0; k < links.size(); ++k) {
            const std::string label = links[k].constant.text.size() <= 8 ? links[k].constant.text : "";
            if (!links[k].between && (along[k] == -2 || is_drawn)) continue;
            if (links[k].between) {
                const auto& [a, b] = *links[k].between;
                s.add(
                    {.kind = kind, .points = {s.spot(s.place(a.text)), s.spot(s.place(b.text))}, .label = label});
            } else if (const auto ends = ends_of(s, along[k])) {
                s.add({.kind = kind, .points = {s.spot(ends->first), s.spot(ends->second)}, .label = label});
            } else if (const int q = coordinate_of(s, along[k]); q >= 0 && kind == Kind::spring) {
                s.add({.kind = Kind::coil, .points = {}, .label = label, .coordinate = q});
            } else {
                s.notes.push_back(
                    say("The {} along {} is not shown: no two points of the scene are that far apart.",
                        translated(what), links[k].along.text));
            }
        }
    };
    add(s.scene.springs, asked.spring_along, Kind::spring, to_say("spring"));
    add(s.scene.dampers, asked.damper_along, Kind::damper, to_say("damper"));
}

void add_hinges(Sketch& s) {
    std::vector<std::pair<int, int>> uses;  // a canonical track, and the number of elements that end there
    const std::vector<FigureElement> elements = s.elements;
    for (const Sketch::Site& site : s.sites) {
        if (&s.canonical(site.track) != &site || !s.is_finite(site.track)) continue;
        const int here = s.spot(site.track);
        int ends = 0;
        bool is_disc = false;
        for (const FigureElement& e : elements) {
            const bool has = std::find(e.points.begin(), e.points.end(), here) != e.points.end();
            if (has &&
                (e.kind == Kind::rod || e.kind == Kind::bar || e.kind == Kind::plate || e.kind == Kind::tie ||
                 e.kind == Kind::string || e.kind == Kind::spring || e.kind == Kind::damper))
                ++ends;
            if (has && (e.kind == Kind::disc || e.kind == Kind::block || e.kind == Kind::wall)) is_disc = true;
        }
        if (ends == 0 || is_disc) continue;
        if (s.is_fixed(site.track))
            s.add({.kind = Kind::support, .points = {here}, .label = site.name});
        else if (ends > 1 || s.is_driven(site.track) || site.of == Sketch::Site::Of::joint)
            s.add({.kind = Kind::pin, .points = {here}, .label = site.name});
    }
}

namespace {

/// A line that may turn about its first end; tracks, and the same points as spots.
struct TurningLine {
    int pivot, end;
    int pivot_spot, end_spot;
};

/// Rods and bars between points, then the first axes of bodies.
std::vector<TurningLine> turning_lines(Sketch& s) {
    std::vector<TurningLine> lines;
    std::vector<std::pair<int, int>> known;
    for (const Sketch::Site& site : s.sites)
        if (s.is_finite(site.track)) known.emplace_back(s.spot(site.track), site.track);
    for (const FigureElement& e : s.elements)
        if (e.kind == Kind::rod || e.kind == Kind::bar || e.kind == Kind::spring || e.kind == Kind::rope)
            if (const auto ends = ends_on(known, e.points[0], e.points[1])) {
                lines.push_back({ends->first, ends->second, e.points[0], e.points[1]});
                lines.push_back({ends->second, ends->first, e.points[1], e.points[0]});
            }
    // Bodies turn with their centres about the points that they carry.
    for (const Sketch::Frame3& body : s.bodies)
        for (const Sketch::Site& site : s.sites)
            if (&s.canonical(site.track) == &site && !s.same(site.track, body.centre) &&
                s.is_fixed_in(body.axes, body.centre, site.track))
                lines.push_back({site.track, body.centre, s.spot(site.track), s.spot(body.centre)});
    return lines;
}

/// The angle by which coordinate k turns a line.
std::optional<FigureElement> angle_of_line(Sketch& s, int k, const std::vector<TurningLine>& lines) {
    const auto turning = std::find_if(
        lines.begin(), lines.end(), [&](const TurningLine& line) { return turns_by(s, k, line.pivot, line.end); });
    if (turning == lines.end()) return {};
    return FigureElement{.kind = Kind::angle,
                         .points = {turning->pivot_spot, s.spot(turning->end, k), turning->end_spot},
                         .label = s.m.q[k].get_name(),
                         .coordinate = k};
}

/// The length by which coordinate k shifts a point. Masses are preferred to points, and points that fewer
/// coordinates move to those that more coordinates move.
std::optional<FigureElement> length_of_shift(Sketch& s, int k) {
    const Sketch::Site* moved = nullptr;
    const auto rank = [&](const Sketch::Site& site) {
        return (site.mass >= 0 ? 0 : 1000) + movers(s, site.track);
    };
    for (const Sketch::Site& site : s.sites) {
        if (!s.is_finite(site.track) || !shifts_by(s, k, site.track)) continue;
        add_rope(s, k, site);
        if (moved == nullptr || rank(site) < rank(*moved)) moved = &site;
    }
    if (moved == nullptr) return {};
    int end = moved->track;
    for (const auto& [mass, middle] : s.middles)
        if (mass == end && shifts_by(s, k, middle)) end = middle;
    FigureElement length{.kind = Kind::length,
                         .points = {s.spot(end, k), s.spot(end)},
                         .label = s.m.q[k].get_name(),
                         .coordinate = k};
    if (const auto way = direction_of(s, k, end)) length.points.push_back(s.spot(end, -1, *way));
    return length;
}

/// Does coordinate k turn an axis of a body by its own value?
bool turns_axis(const Sketch& s, int k, int axis) {
    for (int state = 0; state < Sketch::states; ++state)
        if (!(std::abs(angle_between(s.at(state, axis), s.with(state, axis, k, 0)) -
                       std::abs(wrapped(s.coordinate(state, k)))) < 1e-6))
            return false;
    return true;
}

/// The angle by which coordinate k turns an axis of a body.
std::optional<FigureElement> angle_of_axis(Sketch& s, int k) {
    for (const Sketch::Frame3& body : s.bodies)
        for (int axis = 0; axis < 3; ++axis) {
            if (s.is_plane && axis == s.normal) continue;
            if (!turns_axis(s, k, body.axes[axis])) continue;
            Vector3 end = s.m.masses[body.mass].position;
            const Vector3 direction = s.formulas.places().orientation(body.name).axis(axis);
            const double size = 0.3 * s.scale;
            for (int i = 0; i < 3; ++i) end[i] += direction[i] * exactly(size);
            const int track = s.track(end);
            return FigureElement{.kind = Kind::angle,
                                 .points = {s.spot(body.centre, k), s.spot(track, k), s.spot(track)},
                                 .label = s.m.q[k].get_name(),
                                 .size = 1,
                                 .coordinate = k};
        }
    return {};
}

/// Springs that turn are drawn where the angle of their coordinate is.
void place_coils(Sketch& s) {
    for (FigureElement& e : s.elements) {
        if (e.kind != Kind::coil) continue;
        const auto angle = std::find_if(s.elements.begin(), s.elements.end(), [&](const FigureElement& other) {
            return other.kind == Kind::angle && other.coordinate == e.coordinate;
        });
        if (angle != s.elements.end()) e.points = {angle->points[0]};
    }
    std::erase_if(s.elements, [](const FigureElement& e) { return e.kind == Kind::coil && e.points.empty(); });
}

}  // namespace

void add_coordinates(Sketch& s) {
    if (!s.middles.empty()) s.sample();  // they are newer than the sample
    const std::vector<TurningLine> lines = turning_lines(s);
    std::vector<FigureElement> found;
    for (int k = 0; k < s.m.size(); ++k) {
        std::optional<FigureElement> mark = angle_of_line(s, k, lines);
        if (!mark) mark = length_of_shift(s, k);
        if (!mark) mark = angle_of_axis(s, k);
        if (mark) found.push_back(std::move(*mark));
    }
    const auto lengths =
        std::count_if(found.begin(), found.end(), [](const FigureElement& e) { return e.kind == Kind::length; });
    constexpr int readable = 6;  // the most dimension lines side by side
    for (FigureElement& e : found)
        if (lengths <= readable || e.kind != Kind::length) s.add(std::move(e));
    if (lengths > readable) s.notes.emplace_back(say("Coordinates that are lengths are too many to be shown."));
    place_coils(s);
}

namespace {

/// "F" of ["F", 0]; the only component that is not zero, if it is short.
std::string name_of(const Vector& vector) {
    std::string text;
    for (const Expression& e : vector.component) {
        if (e.text.empty() || e.text == "0") continue;
        if (!text.empty()) return "";
        text = e.text;
    }
    if (text.starts_with("-")) text.erase(0, 1);
    return text.size() <= 8 ? text : "";
}

}  // namespace

void add_loads(Sketch& s, const Asked& asked) {
    for (std::size_t k = 0; k < s.scene.forces.size(); ++k) {
        const Force& f = s.scene.forces[k];
        s.add({.kind = Kind::force,
               .points = {s.spot(s.place(f.at.text)), s.spot(asked.forces[k])},
               .label = name_of(f.vector)});
    }
    for (std::size_t k = 0; k < s.scene.impulses.size(); ++k) {
        const Impulse& f = s.scene.impulses[k];
        s.add({.kind = Kind::impulse,
               .points = {s.spot(s.place(f.at.text)), s.spot(asked.impulses[k])},
               .label = name_of(f.vector)});
    }
    for (std::size_t k = 0; k < s.scene.torques.size(); ++k) {
        const Torque& t = s.scene.torques[k];
        const Sketch::Site* const site = s.site(t.on.text);
        int at = site != nullptr && site->mass >= 0 ? site->track : -1;
        for (const Sketch::Site& other : s.sites) {  // a torque on a frame acts on the point that turns with it
            if (at >= 0) break;
            if (other.mass >= 0) at = other.track;
        }
        if (at >= 0)
            s.add({.kind = Kind::torque,
                   .points = {s.spot(at), s.spot(asked.torques[k])},
                   .label = name_of(t.vector)});
    }
}

}  // namespace alembert
