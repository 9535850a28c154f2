// SPDX-License-Identifier: GPL-2.0-or-later
/// A rope over a pulley. Two masses move along straight lines, and the sum of their ways from the pulley is
/// constant, by the positions or by a constraint: both hang, or one hangs and the other one is on a table or a
/// slope.
#include <algorithm>
#include <cmath>

#include "present/figure/parts.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;
using Kind = FigureElement::Kind;

/// A mass that moves along a line, and where it is drawn at the start.
struct Runner {
    int track;
    Vector3d way;
    Vector3d place;
};

class Ropes {
public:
    Ropes(Sketch& sketch, const Asked& asked) : s_(sketch), asked_(asked) {}

    void add() {
        for (const int track : s_.free_track)
            if (const std::optional<Vector3d> way = straight_way(s_, track)) {
                Vector3d place = s_.at(0, track) - s_.at(0, s_.place("O"));
                for (const auto& [moved, by] : s_.displaced)
                    if (moved == track) place += by;
                runners_.push_back({track, *way, place});
            }
        std::set<int> tied;
        for (const Runner& a : runners_)
            for (const Runner& b : runners_) {
                if (&b <= &a || tied.contains(a.track) || tied.contains(b.track)) continue;
                const auto ways = ways_from_pulley(a, b);
                if (!ways || !add_between(a, b, ways->first, ways->second)) continue;
                tied.insert(a.track);
                tied.insert(b.track);
            }
        const std::vector<FigureElement> elements = s_.elements;
        for (const FigureElement& e : elements)
            for (const Runner& one : runners_)
                if (e.kind == Kind::ring && !tied.contains(one.track)) add_from_drum(e, one);
    }

private:
    double moved(const Runner& one, int state) const {
        return (s_.at(state, one.track) - s_.at(0, one.track)).dot(one.way);
    }

    /// Is the way of one plus `sign` times that of the other constant, in the positions or by a constraint?
    bool add_up(const Runner& a, const Runner& b, double sign) const {
        double most = 0, off = 0;
        for (int state = 1; state < Sketch::states; ++state) {
            most = std::max(most, std::abs(moved(a, state)));
            off = std::max(off, std::abs(moved(a, state) + sign * moved(b, state)));
        }
        if (most > 1e-6 * s_.scale && off <= 1e-9 * s_.scale) return true;
        for (std::size_t k = 0; k < asked_.constraints.size(); ++k)
            if (asked_.constraints[k] >= 0 && !s_.m.constraints[k].joint && !s_.m.constraints[k].norm &&
                s_.shifted([&](int state) { return s_.at(state, asked_.constraints[k])[0]; },
                           [&](int state) { return moved(a, state) + sign * moved(b, state); }))
                return true;
        return false;
    }

    /// The directions in which the rope runs from the pulley to the masses; a mass that hangs is below.
    std::optional<std::pair<Vector3d, Vector3d>> ways_from_pulley(const Runner& a, const Runner& b) const {
        for (const double sign : {1.0, -1.0}) {
            if (!add_up(a, b, sign)) continue;
            Vector3d u = a.way, v = sign * b.way;
            const double low =
                std::abs(u.dot(s_.down)) >= std::abs(v.dot(s_.down)) ? u.dot(s_.down) : v.dot(s_.down);
            if (low < 0) u = -u, v = -v;
            if (std::abs(low) > 0.5) return std::pair(u, v);
        }
        return {};
    }

    bool add_between(const Runner& a, const Runner& b, const Vector3d& u, const Vector3d& v) {
        if (u.cross(v).norm() < 1e-6) return u.dot(v) > 0 && u.dot(s_.down) > 0.99 && add_above(a, b);
        return add_at_corner(a, b, u, v);
    }

    /// Both hang: the pulley is between them, from the ceiling.
    bool add_above(const Runner& a, const Runner& b) {
        const Vector3d apart = b.place - a.place, side = apart - apart.dot(s_.down) * s_.down;
        if (!(side.norm() > 1e-3 * s_.scale)) return false;
        const double r = side.norm() / 2, top = std::min(a.place.dot(s_.down), b.place.dot(s_.down)) -
                                                std::max(3 * r, std::abs(apart.dot(s_.down)));
        const Vector3d middle = a.place + side / 2 + (top - a.place.dot(s_.down)) * s_.down, half = side / 2;
        add_pulley(middle, r);
        add_rope(a, middle - half);
        add_rope(b, middle + half);
        const Vector3d ceiling = middle - 2 * r * s_.down;
        Vector3d left = half;
        if (left.cross(s_.down).dot(Vector3d::Unit(s_.normal)) > 0)
            left = -left;  // who walks has the ground to the right
        s_.add({.kind = Kind::line, .points = {fixed(middle), fixed(ceiling)}});
        s_.add({.kind = Kind::ground, .points = {fixed(ceiling - left), fixed(ceiling + left)}});
        return true;
    }

    /// The pulley touches both lines from within the corner where they meet.
    bool add_at_corner(const Runner& a, const Runner& b, const Vector3d& u, const Vector3d& v) {
        const Vector3d normal = Vector3d::Unit(s_.normal);
        const double det = u.cross(v).dot(normal), x = (b.place - a.place).cross(v).dot(normal) / det;
        const Vector3d corner = a.place + x * u;
        const double far_a = (a.place - corner).dot(u), far_b = (b.place - corner).dot(v);
        if (!(far_a > 1e-3 * s_.scale && far_b > 1e-3 * s_.scale)) return false;
        const double angle = std::acos(std::clamp(u.dot(v), -1.0, 1.0)) / 2, touch = 0.12 * std::max(far_a, far_b),
                     r = touch * std::tan(angle);
        if (!(touch < far_a && touch < far_b)) return false;
        add_pulley(corner + touch / std::cos(angle) * (u + v).normalized(), r);
        add_rope(a, corner + touch * u);
        add_rope(b, corner + touch * v);
        return true;
    }

    /// Does the drum turn by the way of the mass over its radius, in the positions or by a constraint?
    bool turns_with(const FigureElement& drum, const Runner& one) const {
        const auto body = std::find_if(s_.bodies.begin(), s_.bodies.end(),
                                       [&](const Sketch::Frame3& b) { return b.mass == drum.owner; });
        if (body == s_.bodies.end()) return false;
        constexpr double step = 1e-4;
        for (int k = 0; k < s_.m.size(); ++k) {
            const auto rate = [&](int track) {
                return (s_.with(1, track, k, s_.coordinate(1, k) + step) - s_.at(1, track)).norm() / step;
            };
            const double way = drum.size * rate(body->axes[s_.normal == 0 ? 1 : 0]);  // of the rim
            if (!(way > 1e-6 * drum.size)) continue;
            if (std::abs(rate(one.track) - way) <= 1e-5 * way) return true;
            for (std::size_t c = 0; c < asked_.constraints.size(); ++c)
                for (const double sign : {1.0, -1.0})
                    if (asked_.constraints[c] >= 0 &&
                        s_.shifted(
                            [&](int state) { return s_.at(state, asked_.constraints[c])[0]; },
                            [&](int state) { return moved(one, state) + sign * way * s_.coordinate(state, k); }))
                        return true;
        }
        return false;
    }

    /// A rope from the rim of a drum at rest to a mass that hangs straight below that place of the rim.
    void add_from_drum(const FigureElement& drum, const Runner& one) {
        const int middle = s_.track_of(drum.points[0]);
        if (!s_.is_fixed(middle) || std::abs(one.way.dot(s_.down)) < 0.99) return;
        const Vector3d arm = one.place - (s_.at(0, middle) - s_.at(0, s_.place("O"))),
                       across = arm - arm.dot(s_.down) * s_.down;
        if (std::abs(across.norm() - drum.size) > 1e-6 * drum.size || !(arm.dot(s_.down) > 0)) return;
        if (!turns_with(drum, one)) return;
        add_rope(one, one.place - arm.dot(s_.down) * s_.down);
    }

    int fixed(const Vector3d& place) { return s_.spot(s_.place("O"), -1, place); }

    void add_rope(const Runner& one, const Vector3d& rim) {
        s_.add({.kind = Kind::rope, .points = {fixed(rim), s_.spot(one.track)}});
    }

    void add_pulley(const Vector3d& middle, double r) {
        const Vector3d x = Vector3d::Unit(s_.normal == 0 ? 1 : 0), y = Vector3d::Unit(s_.normal == 2 ? 1 : 2);
        s_.add({.kind = Kind::pulley,
                .points = {fixed(middle), fixed(middle + r * x), fixed(middle + r * y)},
                .size = r});
    }

    Sketch& s_;
    const Asked& asked_;
    std::vector<Runner> runners_;
};

}  // namespace

void add_ropes(Sketch& s, const Asked& asked) {
    if (s.is_plane && s.down.norm() > 0 && s.free_track.size() < 20) Ropes(s, asked).add();
}

}  // namespace alembert
