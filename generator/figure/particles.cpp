// SPDX-License-Identifier: GPL-2.0-or-later
/// Particles, the massless rods on which they turn, and the guides on which they slide.
#include <algorithm>
#include <cmath>

#include "figure/parts.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;
using Kind = FigureElement::Kind;

/// The direction in which a point moves, if it is always the same.
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

}  // namespace

void add_particles(Sketch& s) {
    for (const Sketch::Site& site : s.sites) {
        if (site.mass < 0 || s.m.masses[site.mass].origin.kind != Origin::Kind::particle) continue;
        if (!s.is_finite(site.track)) continue;
        const double mass = s.masses[site.mass];
        const std::string& symbol = s.scene.particles[s.m.masses[site.mass].origin.index].mass.text;
        const bool is_symbol = symbol.size() <= 6 && symbol.find_first_not_of("0123456789.") != std::string::npos;
        const std::string label = is_symbol ? symbol : site.name;
        if (!is_part_of_a_body(s, site.track))
            for (const Sketch::Site* pivot : pivots(s, site))
                s.add({.kind = Kind::rod,
                       .points = {s.spot(pivot->track), s.spot(site.track)},
                       .label = s.name_of_length(pivot->track, site.track),
                       .owner = site.mass});
        const std::optional<Vector3d> way = straight_way(s, site.track);
        const bool slides = s.is_plane && way && std::abs(way->dot(s.down)) < 0.99;
        const int here = s.spot(site.track);
        if (slides) {
            const int along = s.spot(site.track, -1, *way);
            Vector3d start = s.at(0, site.track) - s.at(0, s.place("O"));
            for (const auto& [track, by] : s.displaced)
                if (track == site.track) start += by;
            s.add({.kind = Kind::guide,
                   .points = {s.spot(s.place("O"), -1, start), s.spot(s.place("O"), -1, start + *way), here},
                   .owner = site.mass});
            s.add(
                {.kind = Kind::block, .points = {here, along}, .label = label, .size = mass, .owner = site.mass});
        } else {
            s.add({.kind = Kind::disc, .points = {here}, .label = label, .size = mass, .owner = site.mass});
        }
    }
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
                s.add({.kind = Kind::tie, .points = {s.spot(a), s.spot(b)}, .label = s.m.constraints[k].name});
                return true;
            });
        }
    for (std::size_t k = 0; k < asked.gaps.size(); ++k) {
        const auto value = [&](int state) { return s.at(state, asked.gaps[k])[0]; };
        const std::string& name = s.m.unilateral[k].gap.name;
        bool is_drawn = false;
        for (const Sketch::Site& site : s.sites) {
            for (int axis = 0; axis < 3 && !is_drawn; ++axis) {
                const auto height = [&](int state) { return s.at(state, site.track)[axis]; };
                const auto line = s.shifted(value, height);
                if (!line) continue;
                const int origin = s.place("O");
                const Vector3d out = Vector3d::Unit(axis) * (line->first > 0 ? 1 : -1),
                               foot = Vector3d::Unit(axis) * (-line->second / line->first);
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
