// SPDX-License-Identifier: GPL-2.0-or-later
/// The ground in a figure in space: the plane that the lowest point of a body touches. A contact's gap or a
/// constraint is the height of that point over it; or the height never changes, because the scene has put it into
/// the positions.
#include <algorithm>
#include <cmath>
#include <limits>

#include "present/figure/parts.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;
using Kind = FigureElement::Kind;

bool is_round(Kind kind) {
    return kind == Kind::ring || kind == Kind::hoop || kind == Kind::ball || kind == Kind::ellipsoid;
}

/// A body or a point that may stand on a ground.
struct Standing {
    std::vector<FigureElement> elements;  ///< of the body
    int track;                            ///< of its middle, or the point
    std::string body;

    bool is_round() const {
        return !elements.empty() && std::all_of(elements.begin(), elements.end(),
                                                [](const FigureElement& e) { return alembert::is_round(e.kind); });
    }
};

class Grounds {
public:
    Grounds(Sketch& sketch, Asked& asked) : s_(sketch), asked_(asked) {}

    void add() {
        collect();
        s_.sample();  // the corners of bodies are newer than the sample
        for (int& gap : asked_.gaps)
            if (add_for(gap, true)) gap = -1;
        for (std::size_t k = 0; k < asked_.constraints.size(); ++k)
            if (asked_.constraints[k] >= 0 && !s_.m.constraints[k].joint && !s_.m.constraints[k].norm)
                add_for(asked_.constraints[k], false);
        for (const Standing& one : standing_) add_if_level(one);
    }

private:
    void collect() {
        for (const Sketch::Frame3& body : s_.bodies) {
            Standing one{.elements = {}, .track = body.centre, .body = body.name};
            for (const FigureElement& e : s_.elements)
                if (e.owner == body.mass) one.elements.push_back(e);
            if (!one.elements.empty()) standing_.push_back(std::move(one));
        }
        for (const Sketch::Site& site : s_.sites)
            if (s_.is_finite(site.track)) standing_.push_back({.elements = {}, .track = site.track, .body = ""});
    }

    Vector3d at(int state, int spot) const { return s_.at(state, s_.track_of(spot)); }

    double lowest(const FigureElement& e, int state, const Vector3d& up) const {
        const Vector3d middle = at(state, e.points[0]);
        const auto arm = [&](std::size_t k) { return Vector3d(at(state, e.points[k]) - middle); };
        double square = 0, low = middle.dot(up);
        switch (e.kind) {
            case Kind::ball:
                return low - arm(1).norm();
            case Kind::ring:
            case Kind::hoop:
            case Kind::ellipsoid:
                for (std::size_t k = 1; k < e.points.size(); ++k) square += std::pow(arm(k).dot(up), 2);
                return low - std::sqrt(square);
            default:
                for (const int spot : e.points) low = std::min(low, at(state, spot).dot(up));
                return low;
        }
    }

    double lowest(const Standing& one, int state, const Vector3d& up) const {
        if (one.elements.empty()) return s_.at(state, one.track).dot(up);
        double low = std::numeric_limits<double>::infinity();
        for (const FigureElement& e : one.elements) low = std::min(low, lowest(e, state, up));
        return low;
    }

    /// Directions out of a ground, against gravity first.
    std::vector<Vector3d> ways_up() const {
        std::vector<Vector3d> ways;
        for (int k = 0; k < 3; ++k)
            if (std::abs(s_.down[k]) > 0.7) ways.push_back(Vector3d::Unit(k) * (s_.down[k] > 0 ? -1 : 1));
        for (const int k : {2, 1, 0})
            for (const double sign : {1.0, -1.0}) {
                const Vector3d way = sign * Vector3d::Unit(k);
                if (ways.empty() || (ways[0] - way).norm() > 0.5) ways.push_back(way);
            }
        return ways;
    }

    /// The ground over which the value is the height of something.
    bool add_for(int value, bool is_gap) {
        for (const Vector3d& up : ways_up()) {
            if (!is_gap && !(up.dot(s_.down) < -0.7)) continue;
            for (const Standing& one : standing_) {
                const auto line = s_.shifted([&](int state) { return s_.at(state, value)[0]; },
                                             [&](int state) { return lowest(one, state, up); });
                if (!line || std::abs(std::abs(line->first) - 1) > 1e-6 || (is_gap && line->first < 0)) continue;
                add_ground(one, up, -line->second / line->first);
                return true;
            }
        }
        return false;
    }

    bool rolls(const Standing& one) const {
        for (const RollingRule& rule : s_.scene.rolling)
            if (rule.body.text == one.body) return rule.on.text == "N";
        return s_.down.norm() > 0 || std::any_of(s_.m.constraints.begin(), s_.m.constraints.end(),
                                                 [](const auto& c) { return !c.position && !c.joint; });
    }

    /// A round body whose lowest point has always the same height, wherever it goes.
    void add_if_level(const Standing& one) {
        if (!one.is_round() || s_.is_fixed(one.track) || !rolls(one)) return;
        for (const Vector3d& up : ways_up()) {
            if (s_.down.norm() > 0 && !(up.dot(s_.down) < -0.7)) return;
            const double height = lowest(one, 0, up);
            bool is_level = true;
            double way = 0;
            for (int state = 1; state < Sketch::states && is_level; ++state) {
                is_level = std::abs(lowest(one, state, up) - height) <= 1e-7 * s_.scale;
                const Vector3d moved = s_.at(state, one.track) - s_.at(0, one.track);
                way = std::max(way, (moved - moved.dot(up) * up).norm());
            }
            if (!is_level || !(way > 1e-6 * s_.scale)) continue;
            add_ground(one, up, height);
            return;
        }
    }

    double reach(const Standing& one, const Vector3d& up, double height) const {
        double far = 0;
        for (const FigureElement& e : one.elements)
            for (const int spot : e.points) far = std::max(far, (at(0, spot) - s_.at(0, one.track)).norm());
        return far > 0 ? 1.5 * far : 0.4 * std::abs(s_.at(0, one.track).dot(up) - height);
    }

    void add_ground(const Standing& one, const Vector3d& up, double height) {
        const int middle = s_.spot(one.track);
        const double margin = reach(one, up, height);
        for (const auto& [known, index] : added_) {
            if ((known - height * up).norm() > 1e-6 * s_.scale || std::abs(known.dot(up) - height) > 1e-6)
                continue;
            FigureElement& ground = s_.elements[index];
            ground.points.push_back(middle);
            ground.size = std::max(ground.size, margin);
            return;
        }
        // The track is new, so that the corners are of this ground alone.
        const int origin = s_.track(s_.formulas.places().position("O"));
        const Vector3d foot = s_.at(0, one.track) - (s_.at(0, one.track).dot(up) - height) * up;
        const double size = margin > 0 ? margin : 0.3 * s_.scale;
        int first = 0;
        up.cwiseAbs().maxCoeff(&first);
        const Vector3d u = Vector3d::Unit((first + 1) % 3), v = Vector3d::Unit((first + 2) % 3);
        FigureElement ground{.kind = Kind::ground_plane, .points = {}, .size = size};
        for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
            ground.points.push_back(s_.spot(origin, -1, foot + size * (x * u + y * v)));
        ground.points.push_back(middle);
        added_.emplace_back(height * up, s_.elements.size());
        s_.add(std::move(ground));
    }

    Sketch& s_;
    Asked& asked_;
    std::vector<Standing> standing_;
    std::vector<std::pair<Vector3d, std::size_t>> added_;
};

}  // namespace

void add_grounds(Sketch& s, Asked& asked) {
    if (s.is_plane) return;
    Grounds(s, asked).add();
}

void stretch_grounds(Drawing& drawing, std::vector<Pose>& poses) {
    if (poses.empty()) return;
    for (const FigureElement& e : drawing.elements) {
        if (e.kind != Kind::ground_plane) continue;
        const auto index = [&](std::size_t k) { return static_cast<std::size_t>(e.points[k]); };
        const Vector3d corner = poses[0][index(0)], u = (poses[0][index(1)] - corner).normalized(),
                       v = (poses[0][index(3)] - corner).normalized();
        Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
        for (const Pose& pose : poses)
            for (std::size_t k = 4; k < e.points.size(); ++k) {
                const Vector3d arm = pose[index(k)] - corner;
                const Eigen::Vector2d place(arm.dot(u), arm.dot(v));
                low = low.cwiseMin(place);
                high = high.cwiseMax(place);
            }
        if (!low.allFinite() || !high.allFinite()) continue;
        low.array() -= e.size;
        high.array() += e.size;
        const std::array corners{low, Eigen::Vector2d(high[0], low[1]), high, Eigen::Vector2d(low[0], high[1])};
        for (std::size_t k = 0; k < 4; ++k) {
            const Vector3d change = corner + corners[k][0] * u + corners[k][1] * v - poses[0][index(k)];
            drawing.spots[index(k)].shift += change;
            for (Pose& pose : poses) pose[index(k)] += change;
        }
    }
}

}  // namespace alembert
