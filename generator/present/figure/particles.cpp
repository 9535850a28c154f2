// SPDX-License-Identifier: GPL-2.0-or-later
/// Particles, the massless rods on which they turn, and the guides on which they slide.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "present/figure/parts.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;
using Kind = FigureElement::Kind;

}  // namespace

std::optional<Vector3d> straight_way(const Sketch& s, int track) {
    std::optional<Vector3d> along;
    for (int state = 1; state < Sketch::states; ++state) {
        const Vector3d way = s.at(state, track) - s.at(0, track);
        if (!(way.norm() > 1e-9 * s.scale)) continue;
        if (!along)
            along = way.normalized();
        else if (way.cross(*along).norm() > 1e-9 * way.norm() + 1e-12)
            return {};
    }
    return along;
}

void add_slider(Sketch& s, int track, int mass, const std::string& label, const Vector3d& way) {
    const int here = s.spot(track), along = s.spot(track, -1, way);
    Vector3d start = s.at(0, track) - s.at(0, s.place("O"));
    for (const auto& [moved, by] : s.displaced)
        if (moved == track) start += by;
    s.add({.kind = Kind::guide,
           .points = {s.spot(s.place("O"), -1, start), s.spot(s.place("O"), -1, start + way), here},
           .owner = mass});
    s.add({.kind = Kind::block,
           .points = {here, along},
           .label = label,
           .size = s.masses[static_cast<std::size_t>(mass)],
           .owner = mass});
}

namespace {

bool is_part_of_a_body(const Sketch& s, int track) {
    return std::any_of(s.bodies.begin(), s.bodies.end(), [&](const Sketch::Frame3& body) {
        return !s.same(track, body.centre) && s.is_fixed_in(body.axes, body.centre, track);
    });
}

/// The points about which the particle turns at a constant distance, one for each group of points that move
/// together.
std::vector<const Sketch::Site*> pivots(const Sketch& s, const Sketch::Site& particle) {
    std::vector<const Sketch::Site*> found;
    for (const Sketch::Site& site : s.sites) {
        // A rod between two particles belongs to the later one.
        const bool is_later =
            &site >= &particle && site.mass >= 0 && s.m.masses[site.mass].origin.kind == Origin::Kind::particle;
        if (is_later || &site == &particle) continue;
        if (&s.canonical(site.track) != &site || !s.is_finite(site.track)) continue;
        const std::optional<double> here = s.distance(site.track, particle.track);
        if (!here) continue;
        const auto turns = [&] {
            for (int state = 1; state < Sketch::states; ++state)
                if (((s.at(state, particle.track) - s.at(state, site.track)) -
                     (s.at(0, particle.track) - s.at(0, site.track)))
                        .norm() > 1e-7 * s.scale)
                    return true;
            return false;
        };
        if (!turns()) continue;
        const auto rival = std::find_if(found.begin(), found.end(), [&](const Sketch::Site* other) {
            return s.distance(other->track, site.track).has_value();
        });
        if (rival == found.end())
            found.push_back(&site);
        else if ((*rival)->name != particle.from &&
                 (site.name == particle.from || *here < *s.distance((*rival)->track, particle.track)))
            *rival = &site;
    }
    return found;
}

/// The only coordinate that moves the point; -1 if there is none, or more.
int only_mover(const Sketch& s, int track) {
    int found = -1;
    for (int k = 0; k < s.m.size(); ++k) {
        const double q = s.coordinate(1, k);
        if (!((s.with(1, track, k, q + 0.3) - s.at(1, track)).norm() > 1e-7 * s.scale)) continue;
        if (found >= 0) return -1;
        found = k;
    }
    return found;
}

bool is_particle(const Sketch& s, const Sketch::Site& site) {
    return site.mass >= 0 && s.m.masses[site.mass].origin.kind == Origin::Kind::particle &&
           s.is_finite(site.track);
}

/// Is a full turn of coordinate k a full turn of the point?
bool comes_back(const Sketch& s, int track, int k) {
    for (int state = 0; state < Sketch::states; ++state) {
        const double q = s.coordinate(state, k);
        const Vector3d there = s.with(state, track, k, q + 2 * std::numbers::pi);
        if (!((there - s.at(state, track)).norm() <= 1e-7 * s.scale)) return false;
    }
    return true;
}

/// Does the point turn on a circle, whose centre is the middle between opposite points?
bool is_on_circle(const Sketch& s, int track, int k) {
    if (!comes_back(s, track, k)) return false;
    double radius = -1;
    for (int state = 0; state < Sketch::states; ++state) {
        const double q = s.coordinate(state, k);
        const Vector3d opposite = s.with(state, track, k, q + std::numbers::pi),
                       aside = s.with(state, track, k, q + 1), centre = (opposite + s.at(state, track)) / 2;
        const double here = (s.at(state, track) - centre).norm();
        if (radius < 0) radius = here;
        if (!(here > 1e-6 * s.scale && std::abs(here - radius) <= 1e-7 * s.scale &&
              std::abs((aside - centre).norm() - radius) <= 1e-7 * s.scale))
            return false;
    }
    return true;
}

constexpr double longest_formula = 2000;

/// A particle's place, with coordinate k set to a number.
std::optional<Vector3> place_at(const Sketch& s, int mass, int k, const GiNaC::ex& value) {
    Vector3 place;
    for (int i = 0; i < 3; ++i) {
        const GiNaC::ex& component = s.m.masses[mass].position[i];
        if (s.m.z->tree_size(component) > longest_formula) return {};
        place[i] = s.m.z->expand(component).subs(s.m.q[k] == value);
    }
    return place;
}

/// The way on which a particle with one coordinate is led, as far as it lies near the start.
void add_curve(Sketch& s, const Sketch::Site& site) {
    const int k = only_mover(s, site.track);
    if (k < 0) return;
    double low = 0, high = 2 * std::numbers::pi;
    const bool is_closed = comes_back(s, site.track, k);
    if (!is_closed) {
        high = std::max(1.3 * std::abs(s.start.q[k]), 0.5 * std::abs(s.start.qdot[k]));
        if (high == 0) high = 1;
        low = -high;
    }
    constexpr int parts = 48;
    std::vector<int> points;
    for (int i = 0; i <= parts; ++i) {
        const double q = low + (high - low) * i / parts;
        const auto place = is_closed && i == parts ? std::nullopt : place_at(s, site.mass, k, exactly(q));
        if (place)
            points.push_back(s.spot(s.track(*place)));
        else if (is_closed && i == parts && !points.empty())
            points.push_back(points.front());
        else
            return;
    }
    s.add({.kind = Kind::curve, .points = points, .owner = site.mass});
}

/// Is the particle one of a row that springs hold together and nothing else: no wall, no weight?
bool floats(const Sketch& s, int track) {
    const bool is_in_row =
        std::any_of(s.displaced.begin(), s.displaced.end(), [&](const auto& one) { return one.first == track; });
    return is_in_row && s.down.norm() == 0 &&
           std::none_of(s.elements.begin(), s.elements.end(),
                        [](const FigureElement& e) { return e.kind == Kind::wall; });
}

/// The floor on which a shape slides whose centre moves on a line.
void add_floor_below(Sketch& s, LooksOfScene& looks, const Sketch::Site& site, const Vector3d& way) {
    Vector3d below = way.cross(Vector3d::Unit(s.normal));
    const Vector3d down = s.down.norm() > 0 ? s.down : Vector3d(-Vector3d::Unit(s.normal == 2 ? 1 : 2));
    if (below.dot(down) < 0) below = -below;
    const int origin = s.place("O");
    const double ahead = looks.reach(site.name, way), behind = looks.reach(site.name, -way);
    Vector3d foot =
        s.at(0, site.track) - s.at(0, origin) + looks.reach(site.name, below) * below + (ahead - behind) / 2 * way;
    for (const auto& [track, by] : s.displaced)
        if (track == site.track) foot += by;
    s.add({.kind = Kind::floor,
           .points = {s.spot(origin, -1, foot), s.spot(origin, -1, foot + way), s.spot(origin, -1, foot - below),
                      s.spot(site.track), s.spot(origin, -1, foot + (ahead + behind) / 2 * way)},
           .size = 1});
}

}  // namespace

void find_centres(Sketch& s) {
    std::vector<int> centres;
    for (const Sketch::Site& site : s.sites) {
        if (!is_particle(s, site) || !pivots(s, site).empty() || is_part_of_a_body(s, site.track)) continue;
        const int k = only_mover(s, site.track);
        if (k < 0 || !is_on_circle(s, site.track, k)) continue;
        const auto here = place_at(s, site.mass, k, 0), there = place_at(s, site.mass, k, GiNaC::Pi);
        if (!here || !there) continue;
        Vector3 centre;
        for (int i = 0; i < 3; ++i) centre[i] = ((*here)[i] + (*there)[i]) / 2;
        centres.push_back(s.track(centre));
    }
    if (centres.empty()) return;
    for (const int centre : centres) s.add_site(centre);
    s.sample();
}

void add_particles(Sketch& s, LooksOfScene& looks) {
    for (const Sketch::Site& site : s.sites) {
        if (!is_particle(s, site) || s.shown.contains(site.mass)) continue;
        const double mass = s.masses[site.mass];
        const std::string& symbol = s.scene.particles[s.m.masses[site.mass].origin.index].mass.text;
        const bool is_symbol = symbol.size() <= 6 && symbol.find_first_not_of("0123456789.") != std::string::npos;
        const std::string label = is_symbol ? symbol : site.name;
        const bool is_free = !is_part_of_a_body(s, site.track);
        const std::vector<const Sketch::Site*> about =
            is_free ? pivots(s, site) : std::vector<const Sketch::Site*>();
        for (const Sketch::Site* pivot : about) {
            if (looks.has_circle(pivot->track, site.track)) continue;
            s.add({.kind = Kind::rod,
                   .points = {s.spot(pivot->track), s.spot(site.track)},
                   .label = s.name_of_length(pivot->track, site.track),
                   .owner = site.mass});
        }
        const std::optional<Vector3d> way = straight_way(s, site.track);
        if (is_free && about.empty() && !way && s.displaced.empty()) add_curve(s, site);
        const bool slides = s.is_plane && way && std::abs(way->dot(s.down)) < 0.99;
        if (looks.has_shape(site.name)) {
            const int middle = looks.add_shape(site.name, site.mass);
            if (slides && !looks.has(Scenery::Kind::floor)) add_floor_below(s, looks, site, *way);
            s.add({.kind = Kind::mark, .points = {middle}, .label = label, .size = 1, .owner = site.mass});
        } else if (slides && !floats(s, site.track)) {
            add_slider(s, site.track, site.mass, label, *way);
        } else {
            s.add({.kind = Kind::disc,
                   .points = {s.spot(site.track)},
                   .label = label,
                   .size = mass,
                   .owner = site.mass});
        }
    }
}

bool add_round_ground(Sketch& s, int middle, int wheel, std::optional<double> changed) {
    if (!s.is_plane || !s.is_fixed(middle)) return false;
    const int rim = s.spot(wheel);
    const auto ring = std::find_if(s.elements.begin(), s.elements.end(), [&](const FigureElement& e) {
        return (e.kind == Kind::ring || e.kind == Kind::ball) && e.points[0] == rim;
    });
    if (ring == s.elements.end()) return false;
    const auto apart = [&](int state) { return (s.at(state, wheel) - s.at(state, middle)).norm(); };
    const auto is_parameter = [&](double side) {
        for (std::size_t k = 0; k < s.start.parameters.size(); ++k) {
            const auto is_it = [&](int state, double r) {
                return std::abs(s.parameter(state, k) - apart(state) - side * r) <= 1e-6 * apart(state);
            };
            if (is_it(0, ring->size) && (!changed || is_it(Sketch::states, *changed))) return true;
        }
        return false;
    };
    for (const double side : {-1.0, 1.0}) {
        const double radius = apart(0) + side * ring->size;
        if (!(radius > 0) || !is_parameter(side)) continue;
        const Vector3d x = Vector3d::Unit(s.normal == 0 ? 1 : 0), y = Vector3d::Unit(s.normal == 2 ? 1 : 2),
                       centre = s.at(0, middle) - s.at(0, s.place("O"));
        std::vector<int> points;
        constexpr int parts = 72;
        for (int i = 0; i <= parts; ++i) {
            const double angle = 2 * std::numbers::pi * i / parts;
            points.push_back(
                s.spot(s.place("O"), -1, centre + radius * (std::cos(angle) * x + std::sin(angle) * y)));
        }
        s.add({.kind = Kind::curve, .points = points});
        return true;
    }
    return false;
}

void add_constraints(Sketch& s, const Asked& asked) {
    const auto square = [&](int a, int b) {
        return [&s, a, b](int state) { return (s.at(state, a) - s.at(state, b)).squaredNorm(); };
    };
    const auto length = [&](int a, int b) {
        return [&s, a, b](int state) { return (s.at(state, a) - s.at(state, b)).norm(); };
    };
    const auto pairs = [&](const auto& use) {
        for (std::size_t i = 0; i < s.sites.size(); ++i)
            for (std::size_t j = i + 1; j < s.sites.size(); ++j) {
                const Sketch::Site &a = s.sites[i], &b = s.sites[j];
                if (&s.canonical(a.track) != &a || &s.canonical(b.track) != &b) continue;
                if (s.is_finite(a.track) && s.is_finite(b.track) && use(a.track, b.track)) return;
            }
    };
    if (s.sites.size() < 60)
        for (std::size_t k = 0; k < asked.constraints.size(); ++k) {
            const int track = asked.constraints[k];
            if (track < 0 || s.m.constraints[k].joint || s.m.constraints[k].norm) continue;
            const auto value = [&](int state) { return s.at(state, track)[0]; };
            pairs([&](int a, int b) {
                if (!s.shifted(value, square(a, b)) && !s.shifted(value, length(a, b))) return false;
                if (add_round_ground(s, a, b) || add_round_ground(s, b, a)) return true;
                s.add({.kind = Kind::tie, .points = {s.spot(a), s.spot(b)}, .label = s.m.constraints[k].name});
                return true;
            });
        }
    for (std::size_t k = 0; k < asked.gaps.size(); ++k) {
        if (asked.gaps[k] < 0) continue;
        const auto value = [&](int state) { return s.at(state, asked.gaps[k])[0]; };
        const std::string& name = s.m.unilateral[k].gap.name;
        bool is_drawn = false;
        for (const Sketch::Site& site : s.sites) {
            for (int axis = 0; axis < 3 && !is_drawn; ++axis) {
                const auto height = [&](int state) { return s.at(state, site.track)[axis]; };
                const auto line = s.shifted(value, height);
                if (!line) continue;
                const int origin = s.place("O");
                const Vector3d out = Vector3d::Unit(axis) * (line->first > 0 ? 1 : -1);
                Vector3d foot = Vector3d::Unit(axis) * (-line->second / line->first);
                const int here = s.spot(site.track);  // the centre of a ball is above the floor
                for (const FigureElement& e : s.elements)
                    if ((e.kind == Kind::ring || e.kind == Kind::ball) && e.points[0] == here)
                        foot -= e.size * out;
                const int other = s.is_plane ? 3 - axis - s.normal : (axis + 1) % 3;
                s.add({.kind = Kind::floor,
                       .points = {s.spot(origin, -1, foot), s.spot(origin, -1, foot + Vector3d::Unit(other)),
                                  s.spot(origin, -1, foot + out), s.spot(site.track)},
                       .label = name});
                is_drawn = true;
            }
        }
        if (!is_drawn)
            pairs([&](int a, int b) {
                if (!s.shifted(value, length(a, b)) && !s.shifted(value, square(a, b))) return false;
                s.add({.kind = Kind::string, .points = {s.spot(a), s.spot(b)}, .label = name});
                return true;
            });
    }
}

}  // namespace alembert
