// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/figure_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/figure_screen.hpp"

namespace alembert {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Element = FigureElement::Kind;
using Kind = FigureShape::Kind;

/// A vertex at a single point, shifted on the screen.
FigureVertex at(int a, double right = 0, double down = 0, bool begins = false) {
    return {.a = a, .along = right, .across = down, .begins = begins};
}
FigureVertex between(int a, int b, double part, double across = 0, double along = 0, bool begins = false) {
    return {.a = a, .b = b, .part = part, .along = along, .across = across, .begins = begins};
}

Vector3d unit_of(const Vector3d& v) {
    return v.norm() > 0 ? Vector3d(v.normalized()) : v;
}

class Strokes {
public:
    Strokes(const Drawing& drawing, const std::vector<Pose>& poses, const std::vector<std::vector<double>>& q)
        : d_(drawing), poses_(poses), q_(q) {
        static_cast<FigureView&>(f_) = figure_view(drawing, poses);
    }

    FigureShapes all() {
        for (const FigureElement& e : d_.elements)
            largest_ = std::max(largest_, e.kind == Element::disc || e.kind == Element::block ? e.size : 0.0);
        for (const int layer : {0, 1, 2, 3})
            for (const FigureElement& e : d_.elements)
                if (layer_of(e.kind) == layer) add(e);
        return std::move(f_);
    }

private:
    static int layer_of(Element kind) {
        switch (kind) {
            case Element::floor:
            case Element::guide:
            case Element::curve:
            case Element::wall:
            case Element::axes:
            case Element::gravity:
            case Element::support:
                return 0;
            case Element::pin:
            case Element::disc:
                return 2;
            case Element::angle:
            case Element::length:
            case Element::force:
            case Element::waiting:
            case Element::torque:
            case Element::impulse:
                return 3;
            default:
                return 1;
        }
    }

    Vector2d screen(const Vector3d& p) const { return {p.dot(f_.right) * f_.scale, -p.dot(f_.up) * f_.scale}; }
    const Pose& first() const { return poses_.front(); }

    FigureShape& put(Kind kind, const std::string& style, std::vector<FigureVertex> vertices) {
        f_.shapes.push_back({.kind = kind, .style = style, .vertices = std::move(vertices)});
        return f_.shapes.back();
    }
    void text(const std::string& style, const FigureVertex& vertex, const std::string& words) {
        if (!words.empty()) put(Kind::text, style, {vertex}).text = words;
    }
    FigureShape& line(const std::string& style, int a, int b) {
        return put(Kind::path, style, {between(a, b, 0, 0, 0, true), between(a, b, 1)});
    }

    /// The side of a point at which a label is farthest from the elements that end there, at the first pose.
    Vector2d free_side(int point) const {
        Vector2d taken(0, 0);
        for (const FigureElement& e : d_.elements) {
            if (e.kind != Element::rod && e.kind != Element::bar && e.kind != Element::spring &&
                e.kind != Element::tie && e.kind != Element::force && e.kind != Element::rope)
                continue;
            for (std::size_t k = 0; k < 2; ++k) {
                if (e.points[k] != point && !(first()[e.points[k]] - first()[point]).isZero(1e-9)) continue;
                const Vector3d way = e.kind == Element::force
                                         ? first()[e.points[1]]
                                         : Vector3d(first()[e.points[1 - k]] - first()[point]);
                const Vector2d on_screen = screen(way);
                if (on_screen.norm() > 0) taken += on_screen.normalized();
                if (e.kind == Element::force) break;
            }
        }
        return taken.norm() > 0.2 ? Vector2d(-taken.normalized()) : Vector2d(0.8, -0.6);
    }

    void hatch(const FigureVertex& from, const FigureVertex& to, double side, int ticks) {
        std::vector<FigureVertex> marks;
        for (int k = 0; k <= ticks; ++k) {
            FigureVertex v = from;
            const double part = static_cast<double>(k) / ticks;
            v.part += part * (to.part - from.part);
            v.along += part * (to.along - from.along);
            v.begins = true;
            FigureVertex end = v;
            end.begins = false;
            end.across += 8 * side;
            end.along -= 7;
            marks.push_back(v);
            marks.push_back(end);
        }
        put(Kind::path, "hatch", marks);
    }

    void add(const FigureElement& e) {
        const std::vector<int>& p = e.points;
        switch (e.kind) {
            case Element::disc:
                return add_disc(e);
            case Element::block:
                put(Kind::path, "body",
                    {between(p[0], p[1], 0, -11, -18, true), between(p[0], p[1], 0, -11, 18),
                     between(p[0], p[1], 0, 11, 18), between(p[0], p[1], 0, 11, -18)})
                    .closed = true;
                return text("name", at(p[0]), mass_label(e));
            case Element::rod:
                line("rod", p[0], p[1]);
                return text("name", between(p[0], p[1], 0.5, label_side(p[0], p[1])), e.label);
            case Element::bar:
                line("bar-edge", p[0], p[1]);
                line("bar", p[0], p[1]);
                return text("name", between(p[0], p[1], 0.5, 1.4 * label_side(p[0], p[1])), e.label);
            case Element::plate: {
                std::vector<FigureVertex> corners;
                for (const int k : p) corners.push_back(at(k, 0, 0, corners.empty()));
                put(Kind::path, "plate", corners).closed = true;
                return;
            }
            case Element::ring:
                put(Kind::ring, "ring", {at(p[0]), at(p[1]), at(p[2])});
                line("spoke", p[0], p[1]);
                put(Kind::circle, "dot", {at(p[0])}).size = 2;
                return;
            case Element::ball: {
                FigureShape& circle = put(Kind::circle, e.label == "cage" ? "cage" : "ring", {at(p[0])});
                circle.size = e.size;
                circle.in_scene = true;
                put(Kind::ring, "great", {at(p[0]), at(p[1]), at(p[2])});
                if (p.size() < 4) return;
                put(Kind::ring, "great", {at(p[0]), at(p[2]), at(p[3])});
                put(Kind::ring, "great", {at(p[0]), at(p[3]), at(p[1])});
                return;
            }
            case Element::box:
                put(Kind::box, "box", {at(p[0]), at(p[1]), at(p[2]), at(p[3])});
                return;
            case Element::pin:
                put(Kind::circle, "pin", {at(p[0])}).size = 3.6;
                return;
            case Element::support:
                return add_support(e);
            case Element::guide:
                return add_guide(e);
            case Element::floor:
                return add_floor(e);
            case Element::wall:
                return add_wall(e);
            case Element::spring:
                return add_spring(e);
            case Element::coil:
                return add_coil(e);
            case Element::damper:
                return add_damper(e);
            case Element::rope:
            case Element::string:
                line("string", p[0], p[1]);
                return;
            case Element::tie:
                line("tie", p[0], p[1]);
                return;
            case Element::curve: {
                std::vector<FigureVertex> way;
                for (const int k : p) way.push_back(at(k, 0, 0, way.empty()));
                put(Kind::path, "curve", way);
                return;
            }
            case Element::force:
            case Element::waiting:
            case Element::impulse:
                return add_arrow(e);
            case Element::torque:
                return add_torque(e);
            case Element::gravity:
                return add_gravity(e);
            case Element::axes:
                return add_axes(e);
            case Element::angle:
                return add_angle(e);
            case Element::length:
                return add_length(e);
            case Element::mark:
                return text("name", at(p[0], 8, -8), e.label);
        }
    }

    std::string mass_label(const FigureElement& e) const { return e.label; }

    void add_disc(const FigureElement& e) {
        const double r = largest_ > 0 ? 4.5 + 5 * std::cbrt(e.size / largest_) : 6;
        put(Kind::circle, "mass", {at(e.points[0])}).size = r;
        const Vector2d side = free_side(e.points[0]) * (r + 12);
        const double longer = 3.5 * std::max(0.0, static_cast<double>(e.label.size()) - 2);
        text("name", at(e.points[0], side[0] + (side[0] < 0 ? -longer : longer), side[1] + 5), mass_label(e));
    }

    /// The side of a label: left of a rod that points down, above one that points right, where nothing else is.
    double label_side(int a, int b) const {
        const Vector2d way = screen(first()[b] - first()[a]);
        const double sign = std::abs(way[0]) >= std::abs(way[1]) ? (way[0] > 0 ? -1 : 1) : (way[1] > 0 ? -1 : 1);
        return 14 * sign;
    }

    void add_support(const FigureElement& e) {
        const int p = e.points[0];
        // The label is on the side away from the elements that are attached there.
        double below = 0;
        for (const FigureElement& other : d_.elements)
            if (other.kind == Element::rod || other.kind == Element::bar || other.kind == Element::tie ||
                other.kind == Element::string || other.kind == Element::spring)
                for (std::size_t k = 0; k < 2; ++k)
                    if (other.points[k] == p) below += screen(first()[other.points[1 - k]] - first()[p])[1];
        const double side = below > 1e-9 * f_.scale ? -1 : 1;
        put(Kind::path, "ground", {at(p, 0, 0, true), at(p, -9, 14 * side), at(p, 9, 14 * side)}).closed = true;
        put(Kind::path, "ground", {at(p, -19, 14 * side, true), at(p, 19, 14 * side)});
        FigureVertex from = at(p, -17, 14 * side), to = at(p, 19, 14 * side);
        hatch(from, to, side, 5);
        put(Kind::circle, "pin", {at(p)}).size = 3.6;
    }

    /// Signed lengths along a line that the points of all poses reach.
    std::pair<double, double> reach(int origin, int end, int point) const {
        double low = 0, high = 0;
        for (const Pose& pose : poses_) {
            const double x = (pose[point] - pose[origin]).dot(unit_of(pose[end] - pose[origin]));
            low = std::min(low, x);
            high = std::max(high, x);
        }
        return {low, high};
    }

    void add_guide(const FigureElement& e) {
        const auto [low, high] = reach(e.points[0], e.points[1], e.points[2]);
        const Vector2d way = screen(first()[e.points[1]] - first()[e.points[0]]);
        const Vector2d normal(-way[1], way[0]);
        const double side = normal[1] >= 0 ? 1 : -1;  // below
        const FigureVertex from = between(e.points[0], e.points[1], low, 12 * side, -34, true),
                           to = between(e.points[0], e.points[1], high, 12 * side, 34);
        put(Kind::path, "ground", {from, to});
        hatch(from, to, side, std::clamp(static_cast<int>(((high - low) * f_.scale + 68) / 12), 4, 48));
    }

    void add_floor(const FigureElement& e) {
        const std::vector<int>& p = e.points;
        const auto [low, high] = reach(p[0], p[1], p[3]);
        const Vector2d way = screen(first()[p[1]] - first()[p[0]]), out = screen(first()[p[2]] - first()[p[0]]);
        const double side = -way[1] * out[0] + way[0] * out[1] > 0 ? -1 : 1;
        const FigureVertex from = between(p[0], p[1], low, 0, -70, true), to = between(p[0], p[1], high, 0, 70);
        put(Kind::path, "ground", {from, to});
        hatch(from, to, side, std::clamp(static_cast<int>(((high - low) * f_.scale + 140) / 12), 4, 60));
    }

    void add_wall(const FigureElement& e) {
        const Vector2d away = screen(first()[e.points[1]] - first()[e.points[0]]);
        const double side = away[0] >= 0 ? -1 : 1;
        std::vector<FigureVertex> wall{at(e.points[0], 0, -26, true), at(e.points[0], 0, 26)};
        for (int k = 0; k <= 4; ++k) {
            wall.push_back(at(e.points[0], 0, -26.0 + 13 * k, true));
            wall.push_back(at(e.points[0], 8 * side, -19.0 + 13 * k));
        }
        put(Kind::path, "hatch", wall);
    }

    void add_spring(const FigureElement& e) {
        const int a = e.points[0], b = e.points[1];
        std::vector<FigureVertex> zigzag{between(a, b, 0, 0, 0, true), between(a, b, 0.16)};
        constexpr int teeth = 10;
        for (int k = 0; k < teeth; ++k)
            zigzag.push_back(between(a, b, 0.16 + 0.68 * (k + 0.5) / teeth, k % 2 == 0 ? 7 : -7));
        zigzag.push_back(between(a, b, 0.84));
        zigzag.push_back(between(a, b, 1));
        put(Kind::path, "spring", zigzag);
        text("name", between(a, b, 0.5, 1.7 * label_side(a, b)), e.label);
    }

    void add_coil(const FigureElement& e) {
        std::vector<FigureVertex> spiral;
        constexpr int steps = 40;
        for (int k = 0; k <= steps; ++k) {
            const double angle = 4.5 * std::numbers::pi * k / steps, r = 5 + 10.0 * k / steps;
            spiral.push_back(at(e.points[0], r * std::cos(angle), r * std::sin(angle), k == 0));
        }
        put(Kind::path, "spring", spiral);
        text("name", at(e.points[0], -24, 4), e.label);
    }

    void add_damper(const FigureElement& e) {
        const int a = e.points[0], b = e.points[1];
        // The damper is drawn beside a spring between the same points.
        const double off = std::any_of(d_.elements.begin(), d_.elements.end(),
                                       [&](const FigureElement& other) {
                                           return other.kind == Element::spring && other.points == e.points;
                                       })
                               ? 22
                               : 0;
        put(Kind::path, "damper",
            {between(a, b, 0, 0, 0, true), between(a, b, 0, off), between(a, b, 0.38, off),  //
             between(a, b, 0.62, off - 7, 0, true), between(a, b, 0.38, off - 7), between(a, b, 0.38, off + 7),
             between(a, b, 0.62, off + 7),  //
             between(a, b, 0.52, off - 6, 0, true), between(a, b, 0.52, off + 6),
             between(a, b, 0.52, off, 0, true), between(a, b, 1, off), between(a, b, 1, 0)});
        text("name", between(a, b, 0.5, off > 0 ? off + 17 : 1.7 * label_side(a, b)), e.label);
    }

    /// The head of an arrow whose tip is at `part` = 1 and `along` = 0.
    static std::vector<FigureVertex> head(int a, int b) {
        return {between(a, b, 1, -4.5, -11, true), between(a, b, 1), between(a, b, 1, 4.5, -11)};
    }

    double largest_size(int direction) const {
        double size = 0;
        for (const Pose& pose : poses_) size = std::max(size, pose[direction].norm());
        return poses_.size() > 1 && std::isfinite(size) ? size : 0;
    }

    void add_arrow(const FigureElement& e) {
        const int a = e.points[0], d = e.points[1];
        const std::string style = e.kind == Element::force     ? "force"
                                  : e.kind == Element::waiting ? "waiting"
                                                               : "impulse";
        std::vector<FigureVertex> arrow{between(a, d, 0, 0, 0, true), between(a, d, 1)};
        const std::vector<FigureVertex> tip = head(a, d);
        arrow.insert(arrow.end(), tip.begin(), tip.end());
        for (FigureShape* shape : {&put(Kind::path, style, arrow)}) {
            shape->vector = d;
            shape->full = e.kind == Element::force ? largest_size(d) : 0;
        }
        if (e.label.empty()) return;
        FigureShape& name = put(Kind::text, style + "-name", {between(a, d, 1, 12, 6)});
        name.text = e.label;
        name.vector = d;
        name.full = e.kind == Element::force ? largest_size(d) : 0;
    }

    void add_torque(const FigureElement& e) {
        std::vector<FigureVertex> bow;
        constexpr int steps = 24;
        constexpr double r = 24;
        for (int k = 0; k <= steps; ++k) {
            const double angle = -0.3 - 1.5 * std::numbers::pi * k / steps;
            bow.push_back(at(e.points[0], r * std::cos(angle), r * std::sin(angle), k == 0));
        }
        const double end = -0.3 - 1.5 * std::numbers::pi;
        const Vector2d tip(r * std::cos(end), r * std::sin(end)), along(std::sin(end), -std::cos(end)),
            out(std::cos(end), std::sin(end));
        for (const double side : {-4.5, 4.5}) {
            const Vector2d barb = tip - 10 * along + side * out;
            bow.push_back(at(e.points[0], barb[0], barb[1], true));
            bow.push_back(at(e.points[0], tip[0], tip[1]));
        }
        put(Kind::path, "force", bow);
        text("force-name", at(e.points[0], 30, -16), e.label);
    }

    void add_gravity(const FigureElement& e) {
        std::vector<FigureVertex> arrow{between(-1, e.points[0], 0, 0, 0, true), between(-1, e.points[0], 1)};
        const std::vector<FigureVertex> tip = head(-1, e.points[0]);
        arrow.insert(arrow.end(), tip.begin(), tip.end());
        put(Kind::path, "gravity", arrow).vector = e.points[0];
        FigureShape& name = put(Kind::text, "gravity-name", {between(-1, e.points[0], 0.5, 11)});
        name.text = e.label;
        name.vector = e.points[0];
    }

    void add_axes(const FigureElement& e) {
        const std::vector<int>& p = e.points;
        for (int k = 0; k < 3; ++k) {
            if (f_.is_plane && k == d_.normal) continue;
            const double length = 40;
            put(Kind::path, "axis",
                {between(p[0], p[k + 1], 0, 0, 0, true), between(p[0], p[k + 1], 0, 0, length),
                 between(p[0], p[k + 1], 0, -3, length - 7, true), between(p[0], p[k + 1], 0, 0, length),
                 between(p[0], p[k + 1], 0, 3, length - 7)})
                .inside = 2;
            FigureShape& name =
                put(Kind::text, "axis-name", {between(p[0], p[k + 1], 0, 0, length + 9), at(p[0])});
            name.text = std::string(1, static_cast<char>('x' + k));
            name.inside = 9;
        }
    }

    void add_angle(const FigureElement& e) {
        const std::vector<int>& p = e.points;
        const double arm = screen(first()[p[2]] - first()[p[0]]).norm();
        const double radius = std::min(34.0 + 7 * (angles_++ % 3), std::max(0.7 * arm, 14.0));
        put(Kind::path, "reference", {between(p[0], p[1], 0, 0, 0, true), between(p[0], p[1], 0, 0, radius + 18)});
        if (e.size > 0)
            put(Kind::path, "reference",
                {between(p[0], p[2], 0, 0, 0, true), between(p[0], p[2], 0, 0, radius + 18)});
        double turn = 1;
        for (std::size_t k = 0; k < poses_.size(); ++k) {
            const Vector2d from = screen(poses_[k][p[1]] - poses_[k][p[0]]),
                           to = screen(poses_[k][p[2]] - poses_[k][p[0]]);
            const double side = from[0] * to[1] - from[1] * to[0];
            const double size = std::remainder(q_[k][e.coordinate], 2 * std::numbers::pi);
            if (std::abs(side) < 1e-6 * from.norm() * to.norm() || std::abs(size) < 1e-6) continue;
            turn = (side > 0) == (size > 0) ? 1 : -1;
            break;
        }
        for (const Kind kind : {Kind::arc, Kind::angle_text}) {
            FigureShape& arc =
                put(kind, kind == Kind::arc ? "angle" : "angle-name", {at(p[0]), at(p[1]), at(p[2])});
            arc.size = radius;
            arc.turn = turn;
            arc.coordinate = f_.is_plane ? e.coordinate : -1;
            arc.text = kind == Kind::arc ? "" : e.label;
        }
    }

    /// Adds a dimension line beside a length, or an arrow of fixed length if that is too short.
    void add_length(const FigureElement& e) {
        const int a = e.points[0], b = e.points[1];
        const double off = 26 + 9 * (lengths_++ % 3);
        constexpr double shortest = 16;
        const std::size_t first_shape = f_.shapes.size();
        put(Kind::path, "reference",
            {between(a, b, 0, 0, 0, true), between(a, b, 0, off + 4), between(a, b, 1, 0, 0, true),
             between(a, b, 1, off + 4)});
        put(Kind::path, "dimension",
            {between(a, b, 0, off, 0, true), between(a, b, 1, off), between(a, b, 1, off - 3, -7, true),
             between(a, b, 1, off), between(a, b, 1, off + 3, -7), between(a, b, 0, off - 3, 7, true),
             between(a, b, 0, off), between(a, b, 0, off + 3, 7)});
        text("dimension-name", between(a, b, 0.5, off + 11), e.label);
        for (std::size_t k = first_shape; k < f_.shapes.size(); ++k) {
            f_.shapes[k].least = shortest;
            f_.shapes[k].from = a;
            f_.shapes[k].to = b;
        }
        if (f_.follows)  // a dimension line may reach out of a picture that moves with the masses
            for (std::size_t k = first_shape; k < f_.shapes.size(); ++k) f_.shapes[k].inside = 7;
        if (e.points.size() < 3) return;
        const std::size_t arrow = f_.shapes.size();
        const int c = e.points[2];
        put(Kind::path, "dimension",
            {between(b, c, 0, off, 0, true), between(b, c, 0, off, 24), between(b, c, 0, off - 3, 17, true),
             between(b, c, 0, off, 24), between(b, c, 0, off + 3, 17), between(b, c, 0, off - 5, 0, true),
             between(b, c, 0, off + 5, 0)});
        text("dimension-name", between(b, c, 0, off, 34), e.label);
        for (std::size_t k = arrow; k < f_.shapes.size(); ++k) {
            f_.shapes[k].most = shortest;
            f_.shapes[k].from = a;
            f_.shapes[k].to = b;
        }
    }

    const Drawing& d_;
    const std::vector<Pose>& poses_;
    const std::vector<std::vector<double>>& q_;
    FigureShapes f_;
    double largest_ = 0;
    int angles_ = 0, lengths_ = 0;
};

}  // namespace

FigureShapes shapes_of(const Drawing& drawing, const std::vector<Pose>& poses,
                       const std::vector<std::vector<double>>& q) {
    FigureShapes shapes = Strokes(drawing, poses, q).all();
    place_letters(shapes, poses.front(), q.front());
    return shapes;
}

}  // namespace alembert
