// SPDX-License-Identifier: GPL-2.0-or-later
/// Wedges. A mass that moves along a horizontal line is a wedge if another one moves along an inclined line
/// relative to it: the slope is that line, and what slides on it is a block, or what rolls there a wheel.
#include <algorithm>
#include <cmath>

#include "present/figure/parts.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;
using Kind = FigureElement::Kind;

/// Is the mass a particle, or a body that never turns?
bool is_upright(const Sketch& s, int mass) {
    return std::none_of(s.bodies.begin(), s.bodies.end(), [&](const Sketch::Frame3& body) {
        return body.mass == mass && !s.is_fixed(body.axes[s.normal == 0 ? 1 : 0]);
    });
}

int track_of_mass(const Sketch& s, int mass) {
    return s.free_track[static_cast<std::size_t>(mass)];
}

/// The direction along which one mass moves relative to another, if it is always the same; downhill.
std::optional<Vector3d> relative_way(const Sketch& s, int wedge, int rider) {
    const auto apart = [&](int state) {
        return Vector3d(s.at(state, track_of_mass(s, rider)) - s.at(state, track_of_mass(s, wedge)));
    };
    std::optional<Vector3d> along;
    for (int state = 1; state < Sketch::states; ++state) {
        const Vector3d way = apart(state) - apart(0);
        if (!(way.norm() > 1e-9 * s.scale)) continue;
        if (!along)
            along = way.normalized();
        else if (way.cross(*along).norm() > 1e-9 * way.norm() + 1e-12)
            return {};
    }
    if (along && along->dot(s.down) < 0) *along = -*along;
    return along;
}

class WedgeOf {
public:
    WedgeOf(Sketch& sketch, const std::vector<Slope>& slopes) : s_(sketch), wedge_(slopes[0].wedge) {
        for (const Slope& slope : slopes) sides_.push_back(side(slope));
        across_ = s_.down.cross(Vector3d::Unit(s_.normal));
    }

    void add(bool with_floor) {
        std::vector<Vector3d> corners;
        const bool is_ridge = sides_.size() == 2 && sides_[0].way.dot(across_) * sides_[1].way.dot(across_) < 0;
        if (is_ridge)
            corners = ridge();
        else
            for (const Side& one : sides_) {
                corners = {one.top + (one.low - one.top).dot(s_.down) * s_.down, one.low, one.top};
                if (&one != &sides_.back()) add_plate(corners);
            }
        add_plate(corners);
        Vector3d middle = Vector3d::Zero();
        for (const Vector3d& corner : corners) middle += corner / static_cast<double>(corners.size());
        s_.add({.kind = Kind::mark,
                .points = {s_.spot(track_of_mass(s_, wedge_), -1, middle)},
                .label = label(wedge_),
                .size = 1,
                .owner = wedge_});
        if (with_floor) add_floor(corners[0], corners[1]);
        for (const Side& one : sides_)
            if (one.half > 0) add_block(one);
    }

private:
    struct Side {
        int rider;
        Vector3d top, low;  ///< ends of the slope from the place of the wedge, at the start
        Vector3d way, out;
        double half;  ///< of the length of a block; 0 for a wheel
    };

    Side side(const Slope& slope) const {
        double radius = 0;
        for (const FigureElement& e : s_.elements)
            if (e.owner == slope.rider && e.kind == Kind::ring) radius = e.size;
        Vector3d out = slope.way.cross(Vector3d::Unit(s_.normal));
        if (out.dot(s_.down) > 0) out = -out;
        const Vector3d foot =
            s_.at(0, track_of_mass(s_, slope.rider)) - s_.at(0, track_of_mass(s_, wedge_)) - radius * out;
        // Along the slope: the block at zero, the place of the wedge, which is one of its ends, at `own`.
        const double own = -foot.dot(slope.way),
                     length = std::max({2.5 * std::abs(own), 1.6 * s_.scale, 8 * radius}),
                     half = radius > 0 ? 0 : 0.09 * length, room = std::max(half, radius);
        double top = std::min(own, -1.2 * room), low = top + length;
        if (own > 1e-9 * s_.scale) low = std::max(own, 1.2 * room), top = low - length;
        return {slope.rider, foot + top * slope.way, foot + low * slope.way, slope.way, out, half};
    }

    /// Two slopes that meet above, down to the same height.
    std::vector<Vector3d> ridge() const {
        const Side &a = sides_[0], &b = sides_[1];
        // a.top + x a.way = b.top + y b.way
        const double det = a.way.cross(b.way).dot(Vector3d::Unit(s_.normal)),
                     x = (b.top - a.top).cross(b.way).dot(Vector3d::Unit(s_.normal)) / det;
        const Vector3d peak = a.top + x * a.way;
        const double depth = std::max((a.low - peak).dot(s_.down), (b.low - peak).dot(s_.down));
        return {peak + depth / a.way.dot(s_.down) * a.way, peak + depth / b.way.dot(s_.down) * b.way, peak};
    }

    void add_plate(const std::vector<Vector3d>& corners) {
        std::vector<int> points;
        for (const Vector3d& corner : corners) points.push_back(s_.spot(track_of_mass(s_, wedge_), -1, corner));
        s_.add({.kind = Kind::plate, .points = points, .owner = wedge_});
    }

    void add_block(const Side& one) {
        const int track = track_of_mass(s_, one.rider);
        std::vector<int> points;
        for (const auto& [along, up] :
             {std::pair(-1.0, 0.0), std::pair(1.0, 0.0), std::pair(1.0, 1.3), std::pair(-1.0, 1.3)})
            points.push_back(s_.spot(track, -1, one.half * (along * one.way + up * one.out)));
        s_.add({.kind = Kind::plate, .points = points, .owner = one.rider});
        s_.add({.kind = Kind::mark,
                .points = {s_.spot(track, -1, 0.65 * one.half * one.out)},
                .label = label(one.rider),
                .size = 1,
                .owner = one.rider});
    }

    void add_floor(const Vector3d& a, const Vector3d& b) {
        const int origin = s_.place("O");
        const Vector3d start = s_.at(0, track_of_mass(s_, wedge_)) - s_.at(0, origin), foot = start + (a + b) / 2,
                       half = (b - a) / 2;
        s_.add({.kind = Kind::floor,
                .points = {s_.spot(origin, -1, foot), s_.spot(origin, -1, foot + half.normalized()),
                           s_.spot(origin, -1, foot - s_.down), s_.spot(track_of_mass(s_, wedge_)),
                           s_.spot(origin, -1, foot + half)},
                .size = 1});
    }

    std::string label(int mass) const {
        const Origin& origin = s_.m.masses[static_cast<std::size_t>(mass)].origin;
        const std::string& symbol = origin.kind == Origin::Kind::particle
                                        ? s_.scene.particles[origin.index].mass.text
                                        : s_.scene.bodies[origin.index].mass.text;
        return symbol.size() <= 6 && symbol.find_first_not_of("0123456789.") != std::string::npos ? symbol
                                                                                                  : origin.name;
    }

    Sketch& s_;
    int wedge_;
    std::vector<Side> sides_;
    Vector3d across_;
};

}  // namespace

std::vector<Slope> find_slopes(Sketch& s, const LooksOfScene& looks) {
    std::vector<Slope> found;
    if (!s.is_plane || !(s.down.norm() > 0) || looks.has_shapes() || !s.displaced.empty()) return found;
    const auto count = static_cast<int>(s.m.masses.size());
    std::set<int> riders;
    for (int wedge = 0; wedge < count; ++wedge) {
        const std::optional<Vector3d> way = straight_way(s, track_of_mass(s, wedge));
        if (!way || std::abs(way->dot(s.down)) > 1e-6 || !is_upright(s, wedge)) continue;
        for (int rider = 0; rider < count; ++rider) {
            if (rider == wedge || riders.contains(rider) || straight_way(s, track_of_mass(s, rider))) continue;
            const std::optional<Vector3d> along = relative_way(s, wedge, rider);
            if (!along || along->dot(s.down) < 0.05 || along->dot(s.down) > 0.99) continue;
            riders.insert(rider);
            found.push_back({.wedge = wedge, .rider = rider, .way = *along});
        }
    }
    for (const Slope& slope : found) {
        s.shown.insert(slope.wedge);
        if (is_upright(s, slope.rider)) s.shown.insert(slope.rider);
    }
    return found;
}

void add_slopes(Sketch& s, const std::vector<Slope>& slopes, const LooksOfScene& looks) {
    std::set<int> wedges;
    for (const Slope& slope : slopes) {
        if (!wedges.insert(slope.wedge).second) continue;
        std::vector<Slope> own;
        std::copy_if(slopes.begin(), slopes.end(), std::back_inserter(own),
                     [&](const Slope& other) { return other.wedge == slope.wedge; });
        WedgeOf(s, own).add(!looks.has(Scenery::Kind::floor));
    }
}

}  // namespace alembert
