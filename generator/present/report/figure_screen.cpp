// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/figure_screen.hpp"

#include <cmath>
#include <numbers>

namespace alembert {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kind = FigureShape::Kind;

constexpr double arrow_length = 46, ring_steps = 48, arc_steps = 20;

/// The direction of the letter of an angle: inside the arc, or beyond its end if the arc is short.
double letter_angle(double start, double sweep) {
    constexpr double roomy = 0.5, behind = 0.32, none = 1e-6;  // the sign of less is rounding
    return std::abs(sweep) >= roomy ? start + sweep / 2 : start + sweep + (sweep < -none ? -behind : behind);
}

}  // namespace

bool is_text(const FigureShape& shape) {
    return shape.kind == Kind::text || shape.kind == Kind::angle_text;
}

bool is_ring(const FigureShape& shape) {
    return shape.kind == Kind::ring || shape.kind == Kind::hull;
}

FigureScreen::FigureScreen(const FigureShapes& figure, const Pose& pose, const std::vector<double>& q)
    : f_(figure), pose_(pose), q_(q), origin_(figure.centre) {
    if (!f_.follows) return;
    Vector3d sum = Vector3d::Zero();
    for (const int k : f_.followed) sum += pose[k];
    origin_ += sum / static_cast<double>(f_.followed.size());
}

Vector2d FigureScreen::direction(const Vector3d& v) const {
    return {v.dot(f_.right) * f_.scale, -v.dot(f_.up) * f_.scale};
}

Vector2d FigureScreen::place(int point) const {
    if (point < 0) return {f_.width - 30, 24};
    return direction(pose_[point] - origin_) + Vector2d(f_.width / 2, f_.height / 2);
}

Vector2d FigureScreen::place(const FigureVertex& v, const FigureShape& shape) const {
    const Vector2d a = place(v.a);
    Vector2d way = v.b < 0 ? Vector2d(0, 0) : shape.vector == v.b ? arrow(shape) : Vector2d(place(v.b) - a);
    Vector2d e = way.norm() > 1e-6 && v.b >= 0 ? Vector2d(way.normalized()) : Vector2d(1, 0);
    return a + v.part * way + v.along * e + v.across * Vector2d(-e[1], e[0]);
}

/// The arrow of a direction, with fixed length or with a length that shows its size.
Vector2d FigureScreen::arrow(const FigureShape& shape) const {
    const Vector3d& v = pose_[shape.vector];
    const Vector2d on_screen = direction(v);
    const double size = v.norm() * f_.scale;
    if (!(size > 0)) return {0, 0};
    const double length = shape.full > 0 ? 14 + arrow_length * v.norm() / shape.full : arrow_length;
    return on_screen / size * length;
}

/// The start of an arc and its sweep, with y downwards.
std::pair<double, double> FigureScreen::arc(const FigureShape& shape) const {
    const Vector2d from = place(shape.vertices[1].a) - place(shape.vertices[0].a),
                   to = place(shape.vertices[2].a) - place(shape.vertices[0].a);
    const double start = std::atan2(from[1], from[0]);
    if (shape.coordinate >= 0) return {start, shape.turn * std::fmod(q_[shape.coordinate], 2 * std::numbers::pi)};
    return {start, std::atan2(from[0] * to[1] - from[1] * to[0], from.dot(to))};
}

double FigureScreen::radius_of(const FigureShape& circle) const {
    return circle.in_scene ? circle.size * f_.scale : circle.size;
}

std::optional<double> FigureScreen::brightness(const FigureShape& face) const {
    const auto at = [&](std::size_t k) { return pose_[static_cast<std::size_t>(face.vertices[k].a)]; };
    Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0));
    if (!(normal.norm() > 0)) return {};
    normal.normalize();
    if (!(normal.dot(f_.toward) > 0)) return {};
    const Vector3d light = (0.75 * f_.toward + 0.6 * f_.up - 0.28 * f_.right).normalized();
    return 0.55 + 0.45 * std::max(0.0, normal.dot(light));
}

bool FigureScreen::is_hidden(const FigureShape& shape) const {
    if (shape.kind == Kind::face && !brightness(shape)) return true;
    if (shape.vector >= 0 && !(pose_[shape.vector].norm() > 0)) return true;
    if (shape.inside > 0)
        for (const FigureVertex& v : shape.vertices) {
            const Vector2d p = place(v, shape);
            if (!(p[0] > shape.inside && p[0] < f_.width - shape.inside && p[1] > shape.inside &&
                  p[1] < f_.height - shape.inside))
                return true;
        }
    if (shape.from < 0) return false;
    const double length = (place(shape.from) - place(shape.to)).norm();
    return length < shape.least || (shape.most > 0 && length >= shape.most);
}

Vector2d FigureScreen::middle_of_text(const FigureShape& shape) const {
    if (shape.kind == Kind::text) return place(shape.vertices[0], shape);
    const auto [start, sweep] = arc(shape);
    const double angle = letter_angle(start, sweep);
    return place(shape.vertices[0].a) + (shape.size + 11) * Vector2d(std::cos(angle), std::sin(angle));
}

std::vector<FigureScreen::Place> FigureScreen::outline(const FigureShape& shape) const {
    std::vector<Place> line;
    const auto to = [&](bool begins, const Vector2d& p) { line.push_back({begins || line.empty(), p}); };
    switch (shape.kind) {
        case Kind::path:
        case Kind::face:
            for (const FigureVertex& v : shape.vertices) to(v.begins, place(v, shape));
            return line;
        case Kind::ring: {
            const Vector2d c = place(shape.vertices[0].a), u = place(shape.vertices[1].a) - c,
                           v = place(shape.vertices[2].a) - c;
            for (int k = 0; k < ring_steps; ++k) {
                const double angle = 2 * std::numbers::pi * k / ring_steps;
                to(false, c + std::cos(angle) * u + std::sin(angle) * v);
            }
            return line;
        }
        case Kind::hull: {
            // The half axes are seen as p_k. With M = Σ p_k p_kᵀ = L Lᵀ the outline is L u for all unit vectors u.
            const Vector2d c = place(shape.vertices[0].a);
            Eigen::Matrix2d M = Eigen::Matrix2d::Identity() * 1e-12;
            for (std::size_t k = 1; k < shape.vertices.size(); ++k) {
                const Vector2d p = place(shape.vertices[k].a) - c;
                M += p * p.transpose();
            }
            const double a = std::sqrt(M(0, 0)), b = M(0, 1) / a, d = std::sqrt(std::max(M(1, 1) - b * b, 0.0));
            for (int k = 0; k < ring_steps; ++k) {
                const double angle = 2 * std::numbers::pi * k / ring_steps, x = std::cos(angle);
                to(false, c + Vector2d(a * x, b * x + d * std::sin(angle)));
            }
            return line;
        }
        case Kind::arc: {
            const Vector2d c = place(shape.vertices[0].a);
            const auto [start, sweep] = arc(shape);
            for (int k = 0; k <= arc_steps; ++k) {
                const double angle = start + sweep * k / arc_steps;
                to(false, c + shape.size * Vector2d(std::cos(angle), std::sin(angle)));
            }
            return line;
        }
        default:
            return line;
    }
}

}  // namespace alembert
