// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "algebra/notation/lettering.hpp"
#include "present/report/figure_screen.hpp"
#include "present/report/letters.hpp"
#include "present/report/page.hpp"
#include "present/report/plot.hpp"

namespace alembert {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kind = FigureShape::Kind;

std::string number(double x) {
    std::string text = fmt::format("{:.1f}", x == 0 ? 0.0 : x);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text == "-0" ? "0" : text;
}

std::string path_of(const FigureScreen& screen, const FigureShape& shape) {
    std::string d;
    for (const auto& [begins, p] : screen.outline(shape))
        d += fmt::format("{}{} {}", begins ? "M" : "L", number(p[0]), number(p[1]));
    return d + (shape.closed || is_ring(shape) ? "Z" : "");
}

/// The grey of a face; a facet of a round side has no edges.
std::string shade_of(const FigureShape& face, double brightness) {
    const std::string grey = fmt::format("rgb({0},{0},{0})", std::lround(245 * brightness));
    return face.style == "facet" ? fmt::format("fill:{0};stroke:{0}", grey) : fmt::format("fill:{}", grey);
}

/// A page allows no styles in its elements; there the script shades the faces.
std::string element_of(const FigureScreen& screen, const FigureShape& shape, bool for_page) {
    const char* const visibility = screen.is_hidden(shape) ? " visibility=\"hidden\"" : "";
    if (is_text(shape)) {
        const Vector2d p = screen.middle_of_text(shape) + shape.nudge;
        return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\"{}>{}</text>\n", shape.style, number(p[0]),
                           number(p[1] + 5), visibility, svg_letters(shape.text));
    }
    if (shape.kind == Kind::circle) {
        const Vector2d c = screen.place(shape.vertices[0], shape);
        return fmt::format("<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", shape.style, number(c[0]),
                           number(c[1]), number(screen.radius_of(shape)));
    }
    std::string shade;
    if (shape.kind == Kind::face && !for_page)
        if (const std::optional<double> brightness = screen.brightness(shape))
            shade = fmt::format(" style=\"{}\"", shade_of(shape, *brightness));
    return fmt::format("<path class=\"{}\" d=\"{}\"{}{}/>\n", shape.style, path_of(screen, shape), visibility,
                       shade);
}

/// Black on white, as on paper. The page has the same classes in its own colours.
constexpr const char* paper = R"css(
.figure{background:#fff;color:#000}
.figure path,.figure circle{fill:none;stroke:#000;stroke-width:1.3;stroke-linecap:round;stroke-linejoin:round}
.figure text{font:italic 16px "Latin Modern Math","STIX Two Text",Cambria,"Times New Roman",serif;fill:#000;text-anchor:middle}
.figure .sub{font-size:11px}
.figure .upright{font-style:normal}
.figure .mass,.figure .dot{fill:#000}
.figure .body,.figure .plate{fill:#e8e8e8}
.figure .ring{fill:#e8e8e8;fill-opacity:.55}
.figure .ground-plane{fill:#f6f6f6;stroke:#888;stroke-width:.8}
.figure .bar-edge{stroke-width:9}
.figure .bar{stroke:#e8e8e8;stroke-width:6.6}
.figure .rod{stroke-width:2}
.figure .pin,.figure .ground{fill:#fff}
.figure .hatch,.figure .great,.figure .spoke{stroke-width:.8}
.figure .reference{stroke-width:.7;stroke-dasharray:4 3}
.figure .tie{stroke-dasharray:7 4}
.figure .curve{stroke:#555}
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
    const FigureScreen screen(figure, pose, q);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"figure\" viewBox=\"0 0 {0} {1}\"{2} role=\"img\" "
        "aria-labelledby=\"figure-title figure-description\">\n<title id=\"figure-title\">{3}</title>\n"
        "<desc id=\"figure-description\">{4}</desc>\n",
        number(figure.width), number(figure.height),
        for_page
            ? ""
            : fmt::format(" width=\"{}\" height=\"{}\"", number(1.5 * figure.width), number(1.5 * figure.height)),
        plot_escaped(title), plot_escaped(description));
    if (!for_page)
        svg += fmt::format("<style>{}</style>\n<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", paper,
                           number(figure.width), number(figure.height));
    svg += "<g class=\"shapes\">\n";
    for (const FigureShape& shape : figure.shapes) svg += element_of(screen, shape, for_page);
    return svg + "</g>\n</svg>\n";
}

Json as_json(const FigureShapes& f) {
    const auto vector = [](const Vector3d& v) { return Json{v[0], v[1], v[2]}; };
    Json json{{"width", f.width},           {"height", f.height},       {"scale", f.scale},
              {"centre", vector(f.centre)}, {"right", vector(f.right)}, {"up", vector(f.up)},
              {"toward", vector(f.toward)}, {"plane", f.is_plane},      {"follows", f.follows},
              {"followed", f.followed},     {"shapes", Json::array()}};
    constexpr std::array names{"path", "circle", "ring", "arc", "text", "angle_text", "hull", "face"};
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
        if (shape.inside > 0) one["inside"] = shape.inside;
        if (!shape.nudge.isZero())
            one["nudge"] = Json{std::round(10 * shape.nudge[0]) / 10, std::round(10 * shape.nudge[1]) / 10};
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
