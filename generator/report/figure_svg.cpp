// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "notation/lettering.hpp"
#include "report/figure_shapes.hpp"
#include "report/letters.hpp"
#include "report/page.hpp"

namespace alembert {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kind = FigureShape::Kind;

constexpr double arrow_length = 46, ring_steps = 48;

/// One pose on the screen. templates/page.js does the same.
class Screen {
public:
    Screen(const FigureShapes& figure, const Pose& pose, const std::vector<double>& q)
        : f_(figure), pose_(pose), q_(q), origin_(figure.centre) {
        if (f_.follows) {
            Vector3d sum = Vector3d::Zero();
            for (const int k : f_.followed) sum += pose[k];
            origin_ += sum / static_cast<double>(f_.followed.size());
        }
    }

    Vector2d direction(const Vector3d& v) const { return {v.dot(f_.right) * f_.scale, -v.dot(f_.up) * f_.scale}; }
    Vector2d place(int point) const {
        if (point < 0) return {f_.width - 30, 24};
        return direction(pose_[point] - origin_) + Vector2d(f_.width / 2, f_.height / 2);
    }

    Vector2d place(const FigureVertex& v, const FigureShape& shape) const {
        const Vector2d a = place(v.a);
        Vector2d way = v.b < 0 ? Vector2d(0, 0) : shape.vector == v.b ? arrow(shape) : Vector2d(place(v.b) - a);
        Vector2d e = way.norm() > 1e-6 && v.b >= 0 ? Vector2d(way.normalized()) : Vector2d(1, 0);
        return a + v.part * way + v.along * e + v.across * Vector2d(-e[1], e[0]);
    }

    /// The arrow of a direction, with fixed length or with a length that shows its size.
    Vector2d arrow(const FigureShape& shape) const {
        const Vector3d& v = pose_[shape.vector];
        const Vector2d on_screen = direction(v);
        const double size = v.norm() * f_.scale;
        if (!(size > 0)) return {0, 0};
        const double length = shape.full > 0 ? 14 + arrow_length * v.norm() / shape.full : arrow_length;
        return on_screen / size * length;
    }

    /// The start of an arc and its sweep, with y downwards.
    std::pair<double, double> arc(const FigureShape& shape) const {
        const Vector2d from = place(shape.vertices[1].a) - place(shape.vertices[0].a),
                       to = place(shape.vertices[2].a) - place(shape.vertices[0].a);
        const double start = std::atan2(from[1], from[0]);
        if (shape.coordinate >= 0)
            return {start, shape.turn * std::fmod(q_[shape.coordinate], 2 * std::numbers::pi)};
        return {start, std::atan2(from[0] * to[1] - from[1] * to[0], from.dot(to))};
    }

    const FigureShapes& figure() const { return f_; }
    const Pose& pose() const { return pose_; }

private:
    const FigureShapes& f_;
    const Pose& pose_;
    const std::vector<double>& q_;
    Vector3d origin_;
};

std::string number(double x) {
    std::string text = fmt::format("{:.1f}", x == 0 ? 0.0 : x);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text == "-0" ? "0" : text;
}

std::string to(bool begins, const Vector2d& p) {
    return fmt::format("{}{} {}", begins ? "M" : "L", number(p[0]), number(p[1]));
}

std::string path_of(const Screen& screen, const FigureShape& shape) {
    std::string d;
    switch (shape.kind) {
        case Kind::path:
            for (const FigureVertex& v : shape.vertices) d += to(v.begins || d.empty(), screen.place(v, shape));
            return d + (shape.closed ? "Z" : "");
        case Kind::ring: {
            const Vector2d c = screen.place(shape.vertices[0].a), u = screen.place(shape.vertices[1].a) - c,
                           v = screen.place(shape.vertices[2].a) - c;
            for (int k = 0; k < ring_steps; ++k) {
                const double angle = 2 * std::numbers::pi * k / ring_steps;
                d += to(k == 0, c + std::cos(angle) * u + std::sin(angle) * v);
            }
            return d + "Z";
        }
        case Kind::arc: {
            const Vector2d c = screen.place(shape.vertices[0].a);
            const auto [start, sweep] = screen.arc(shape);
            constexpr int steps = 20;
            for (int k = 0; k <= steps; ++k) {
                const double angle = start + sweep * k / steps;
                d += to(k == 0, c + shape.size * Vector2d(std::cos(angle), std::sin(angle)));
            }
            return d;
        }
        case Kind::box: {
            const auto at = [&](int k) { return screen.pose()[shape.vertices[k].a]; };
            const Vector3d c = at(0);
            const std::array<Vector3d, 3> half{at(1) - c, at(2) - c, at(3) - c};
            const Vector2d middle = screen.place(shape.vertices[0].a);
            for (int k = 0; k < 3; ++k)
                for (const double side : {-1.0, 1.0}) {
                    if (side * half[k].dot(screen.figure().toward) <= 0) continue;
                    const Vector3d u = half[(k + 1) % 3], v = half[(k + 2) % 3];
                    const Vector2d face = middle + screen.direction(side * half[k]);
                    const Vector2d a = screen.direction(u), b = screen.direction(v);
                    d += to(true, face + a + b) + to(false, face + a - b) + to(false, face - a - b) +
                         to(false, face - a + b) + "Z";
                }
            return d;
        }
        default:
            return d;
    }
}

bool is_text(const FigureShape& shape) {
    return shape.kind == Kind::text || shape.kind == Kind::angle_text;
}

bool is_hidden(const Screen& screen, const FigureShape& shape) {
    if (shape.vector >= 0 && !(screen.pose()[shape.vector].norm() > 0)) return true;
    if (shape.from < 0) return false;
    const double length = (screen.place(shape.from) - screen.place(shape.to)).norm();
    return length < shape.least || (shape.most > 0 && length >= shape.most);
}

/// The direction of the letter of an angle: inside the arc, or beyond its end if the arc is short.
double letter_angle(double start, double sweep) {
    constexpr double roomy = 0.5, behind = 0.32;
    return std::abs(sweep) >= roomy ? start + sweep / 2 : start + sweep + (sweep < 0 ? -behind : behind);
}

std::string element_of(const Screen& screen, const FigureShape& shape) {
    const char* const visibility = is_hidden(screen, shape) ? " visibility=\"hidden\"" : "";
    if (is_text(shape)) {
        Vector2d p;
        if (shape.kind == Kind::text) {
            p = screen.place(shape.vertices[0], shape);
        } else {
            const auto [start, sweep] = screen.arc(shape);
            p = screen.place(shape.vertices[0].a) +
                (shape.size + 11) *
                    Vector2d(std::cos(letter_angle(start, sweep)), std::sin(letter_angle(start, sweep)));
        }
        return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\"{}>{}</text>\n", shape.style, number(p[0]),
                           number(p[1] + 5), visibility, svg_letters(shape.text));
    }
    if (shape.kind == Kind::circle) {
        const Vector2d c = screen.place(shape.vertices[0], shape);
        const double r = shape.in_scene ? shape.size * screen.figure().scale : shape.size;
        return fmt::format("<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", shape.style, number(c[0]),
                           number(c[1]), number(r));
    }
    return fmt::format("<path class=\"{}\" d=\"{}\"{}/>\n", shape.style, path_of(screen, shape), visibility);
}

/// Black on white, as on paper. The page has the same classes in its own colours.
constexpr const char* paper = R"css(
.figure{background:#fff;color:#000}
.figure path,.figure circle{fill:none;stroke:#000;stroke-width:1.3;stroke-linecap:round;stroke-linejoin:round}
.figure text{font:italic 16px "Latin Modern Math","STIX Two Text",Cambria,"Times New Roman",serif;fill:#000;text-anchor:middle}
.figure .sub{font-size:11px}
.figure .upright{font-style:normal}
.figure .mass,.figure .dot{fill:#000}
.figure .body,.figure .plate,.figure .box{fill:#e8e8e8}
.figure .ring{fill:#e8e8e8;fill-opacity:.55}
.figure .bar-edge{stroke-width:9}
.figure .bar{stroke:#e8e8e8;stroke-width:6.6}
.figure .rod{stroke-width:2}
.figure .pin,.figure .ground{fill:#fff}
.figure .hatch,.figure .great,.figure .spoke{stroke-width:.8}
.figure .reference{stroke-width:.7;stroke-dasharray:4 3}
.figure .tie{stroke-dasharray:7 4}
.figure .angle,.figure .dimension,.figure .axis{stroke-width:.8}
.figure .axis,.figure .gravity{stroke:#555}
.figure .axis-name,.figure .gravity-name{fill:#555;font-size:14px}
.figure .force,.figure .impulse{stroke-width:2}
)css";

}  // namespace

std::string svg_letters(const std::string& expression) {
    return letters_of(expression, [](const std::string& index, bool is_last) {
        return fmt::format("<tspan class=\"sub\" dy=\"4\">{}</tspan>{}", index,
                           is_last ? "" : "<tspan dy=\"-4\">\u200a</tspan>");
    });
}

std::string as_svg(const FigureShapes& figure, const Pose& pose, const std::vector<double>& q,
                   const std::string& title, const std::string& description, bool for_page) {
    const Screen screen(figure, pose, q);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"figure\" viewBox=\"0 0 {0} {1}\"{2} role=\"img\" "
        "aria-labelledby=\"figure-title figure-description\">\n<title id=\"figure-title\">{3}</title>\n"
        "<desc id=\"figure-description\">{4}</desc>\n",
        number(figure.width), number(figure.height),
        for_page
            ? ""
            : fmt::format(" width=\"{}\" height=\"{}\"", number(1.5 * figure.width), number(1.5 * figure.height)),
        xml_escaped(title), xml_escaped(description));
    if (!for_page)
        svg += fmt::format("<style>{}</style>\n<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", paper,
                           number(figure.width), number(figure.height));
    svg += "<g class=\"shapes\">\n";
    for (const FigureShape& shape : figure.shapes) svg += element_of(screen, shape);
    return svg + "</g>\n</svg>\n";
}

Json as_json(const FigureShapes& f) {
    const auto vector = [](const Vector3d& v) { return Json{v[0], v[1], v[2]}; };
    Json json{{"width", f.width},           {"height", f.height},       {"scale", f.scale},
              {"centre", vector(f.centre)}, {"right", vector(f.right)}, {"up", vector(f.up)},
              {"toward", vector(f.toward)}, {"plane", f.is_plane},      {"follows", f.follows},
              {"followed", f.followed},     {"shapes", Json::array()}};
    constexpr std::array names{"path", "circle", "ring", "arc", "box", "text", "angle_text"};
    for (const FigureShape& shape : f.shapes) {
        Json one{{"kind", names[static_cast<std::size_t>(shape.kind)]}};
        one["v"] = Json::array();
        for (const FigureVertex& v : shape.vertices)
            one["v"].push_back(Json{v.a, v.b, std::round(1e4 * v.part) / 1e4, std::round(10 * v.along) / 10,
                                    std::round(10 * v.across) / 10, v.begins ? 1 : 0});
        if (shape.closed) one["closed"] = true;
        if (shape.size != 0) one["size"] = shape.size;
        if (shape.in_scene) one["in_scene"] = true;
        if (shape.vector >= 0) one["vector"] = shape.vector;
        if (shape.full > 0) one["full"] = shape.full;
        if (shape.from >= 0) {
            one["from"] = shape.from;
            one["to"] = shape.to;
            one["least"] = shape.least;
            one["most"] = shape.most;
        }
        if (shape.coordinate >= 0) one["coordinate"] = shape.coordinate;
        if (shape.kind == Kind::arc || shape.kind == Kind::angle_text) one["turn"] = shape.turn;
        json["shapes"].push_back(std::move(one));
    }
    return json;
}

}  // namespace alembert
