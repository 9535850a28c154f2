// SPDX-License-Identifier: GPL-2.0-or-later
/// The figure and its animation; coordinates and parameters.
#include <algorithm>
#include <cmath>

#include "base/language/say.hpp"
#include "present/report/figure.hpp"
#include "present/report/figure_shapes.hpp"
#include "present/report/page_parts.hpp"
#include "present/report/shown_unit.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;

/// Poses as whole numbers on a grid of 1/16 of a pixel: to the right and up for a plane figure, along N in space.
Json frames_of(const FigureShapes& shapes, const std::vector<Pose>& poses) {
    const double grid = 16 * shapes.scale;
    Json frames = Json::array();
    for (const Pose& pose : poses) {
        Json one = Json::array();
        for (const Vector3d& p : pose) {
            const auto add = [&](double x) { one.push_back(static_cast<long>(std::llround(x * grid))); };
            if (shapes.is_plane) {
                add(p.dot(shapes.right));
                add(p.dot(shapes.up));
            } else {
                for (int k = 0; k < 3; ++k) add(p[k]);
            }
        }
        frames.push_back(std::move(one));
    }
    return frames;
}

void add_controls(PageParts& page, const FigureShapes& shapes, double duration, bool traces) {
    static constexpr std::array speeds{0.001, 0.01, 0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0};
    const auto* const best = std::min_element(speeds.begin(), speeds.end(), [&](double a, double b) {
        const auto badness = [&](double s) { return std::abs(std::log(duration / s / 8)) - (s == 1 ? 1.2 : 0); };
        return badness(a) < badness(b);
    });
    put(page.body,
        "<div class=\"controls\" role=\"group\" aria-label=\"{0}\">\n"
        "<button type=\"button\" id=\"play\" aria-pressed=\"false\">{1}</button>\n"
        "<label class=\"scrub\"><span>{2}</span> <input type=\"range\" id=\"time\" min=\"0\" max=\"1000\" "
        "value=\"0\"></label>\n<output id=\"clock\">t = 0 s</output>\n<label>{3} <select id=\"speed\">",
        say("Animation"), say("Play"), say("Time"), say("Speed"));
    for (const double s : speeds)
        put(page.body, "<option value=\"{0}\"{1}>{0}×</option>", s, s == *best ? " selected" : "");
    page.body += "</select></label>\n";
    if (traces) put(page.body, "<label><input type=\"checkbox\" id=\"trace\"> {}</label>\n", say("Trace"));
    if (!shapes.is_plane) put(page.body, "<button type=\"button\" id=\"view\">{}</button>\n", say("Turn back"));
    put(page.body, "</div>\n");
    if (!shapes.is_plane)
        put(page.body, "<p class=\"hint\">{}</p>\n",
            say("Turn the view with the mouse, a finger, or the arrow keys."));
}

/// Draws a force that is zero at some poses of the motion there too, along the direction in which it acts next.
void add_waiting_forces(Drawing& drawing, std::vector<Pose>& poses) {
    const std::size_t known = drawing.elements.size();
    for (std::size_t k = 0; k < known; ++k) {
        const FigureElement force = drawing.elements[k];
        if (force.kind != FigureElement::Kind::force) continue;
        const auto at = static_cast<std::size_t>(force.points[1]);
        double largest = 0;
        for (const Pose& pose : poses) largest = std::max(largest, pose[at].norm());
        const auto is_zero = [&](const Pose& pose) { return pose[at].norm() <= 1e-3 * largest; };
        if (!(largest > 0) || std::none_of(poses.begin(), poses.end(), is_zero)) continue;
        Vector3d next(0, 0, 0);
        for (const Pose& pose : poses)  // what acted last stands for a force that acts no more
            if (!is_zero(pose)) next = pose[at].normalized();
        const int direction = static_cast<int>(poses[0].size());
        for (std::size_t frame = poses.size(); frame-- > 0;) {
            if (!is_zero(poses[frame])) next = poses[frame][at].normalized();
            poses[frame].push_back(is_zero(poses[frame]) ? next : Vector3d(0, 0, 0));
        }
        drawing.elements.push_back(
            {.kind = FigureElement::Kind::waiting, .points = {force.points[0], direction}, .label = force.label});
    }
}

}  // namespace

void add_figure(PageParts& page, const Overview& all) {
    page.section("figure", say("Figure and motion"), Fold::never);
    std::optional<Drawing> drawing = all.drawing.value;
    if (!drawing || !drawing->obstacle.empty()) {
        page.problem(drawing ? drawing->obstacle : all.drawing.problem);
        page.end();
        return;
    }
    const WatchedMotion* const motion = all.motion.value ? &*all.motion.value : nullptr;
    std::vector<Pose> poses;
    std::vector<std::vector<double>> q;
    const bool moves = motion != nullptr && motion->poses.size() > 1;
    if (moves) {
        poses = motion->poses;
        const std::size_t n = all.start.q.size();
        for (const std::size_t row : motion->frames) {
            q.emplace_back();
            for (std::size_t k = 0; k < n; ++k) q.back().push_back(motion->run.rows.at(row, 1 + k));
        }
    } else {
        poses.push_back(pose_at(*drawing, all.start));
        q.push_back(all.start.q);
    }
    add_waiting_forces(*drawing, poses);
    const FigureShapes shapes = shapes_of(*drawing, poses, q);
    put(page.body, "<div class=\"stage{}\"{}>\n", shapes.is_plane ? "" : " space",
        shapes.is_plane ? ""
                        : fmt::format(" tabindex=\"0\" role=\"group\" aria-label=\"{}\"",
                                      say("Figure in space, turned by arrow keys")));
    page.body +=
        as_svg(shapes, poses[0], q[0], say("Figure: {}", all.mechanism.name), description_of(*drawing), true);
    put(page.body, "</div>\n");
    if (moves) {
        add_controls(page, shapes, motion->run.rows.at(motion->run.rows.rows() - 1, 0) - motion->run.rows.at(0, 0),
                     !drawing->traced.empty());
        put(page.body, "<p id=\"happening\" role=\"status\" class=\"happening\"></p>\n");
    } else if (!all.motion.problem.empty()) {
        page.problem(all.motion.problem);
    }
    for (const std::string& note : drawing->notes) put(page.body, "<p class=\"hint\">{}</p>\n", html(note));
    if (moves) add_live(page, all, poses[0].size());
    page.end();

    Json& data = page.data["figure"] = as_json(shapes);
    data["frames"] = frames_of(shapes, poses);
    data["traced"] = drawing->traced;
    Json& angles = data["angles"] = Json::object();
    for (const FigureShape& shape : shapes.shapes) {
        const std::string key = std::to_string(shape.coordinate);
        if (shape.coordinate < 0 || angles.contains(key)) continue;
        Json values = Json::array();
        for (const std::vector<double>& state : q)
            values.push_back(std::round(1e4 * state[shape.coordinate]) / 1e4);
        angles[key] = values;
    }
    Json& times = data["times"] = Json::array();
    if (moves)
        for (const std::size_t row : motion->frames) times.push_back(motion->run.rows.at(row, 0));
    else
        times.push_back(all.start.t);
}

namespace {

std::string symbol(const Mechanism& m, const GiNaC::symbol& s) {
    return inline_math(phrases::symbol(s, m.symbols->info(s)));
}

std::string six_digits(double x) {
    return std::abs(x) < 1e-14 ? "0" : fmt::format("{:.6g}", x);
}

}  // namespace

void add_mechanism(PageParts& page, const Overview& all) {
    const Mechanism& m = all.mechanism;
    page.section("mechanism", say("Coordinates and parameters"));
    std::vector<std::vector<std::string>> rows;
    for (std::size_t k = 0; k < m.q.size(); ++k)
        rows.push_back({symbol(m, m.q[k]), six_digits(ShownUnit(m.shown_units[k]).value(all.start.q[k])),
                        six_digits(ShownUnit(m.shown_units[k]).value(all.start.qdot[k])),
                        html(unit_text(ShownUnit(m.shown_units[k]).text(m.units[k]))),
                        html(k < all.scene.coordinates.size() ? all.scene.coordinates[k].about : "")});
    add_table(page.body, say("Coordinates"),
              {say("symbol"), say("at the start"), say("rate at the start"), say("unit"), say("meaning")}, rows);
    rows.clear();
    for (std::size_t k = 0; k < m.speeds.size(); ++k)
        rows.push_back({symbol(m, m.speeds[k].u), "<code>" + html(all.scene.speeds[k].form.text) + "</code>",
                        html(unit_text(ShownUnit(m.speeds[k].shown).text(m.speeds[k].unit))),
                        html(all.scene.speeds[k].about)});
    if (!rows.empty())
        add_table(page.body, say("Generalized speeds"), {say("symbol"), say("form"), say("unit"), say("meaning")},
                  rows);
    rows.clear();
    for (std::size_t k = 0; k < all.scene.parameters.size(); ++k) {
        const Parameter& given = all.scene.parameters[k];
        rows.push_back({symbol(m, m.parameters[k].symbol),
                        html(given.shown.unit.empty() ? given.value.text : given.shown.value),
                        html(unit_text(ShownUnit(given.shown).text(given.unit))), html(given.about)});
    }
    const std::vector<std::string> of_values{say("symbol"), say("value"), say("unit"), say("meaning")};
    if (!rows.empty()) add_table(page.body, say("Parameters"), of_values, rows);
    rows.clear();
    for (const Input& input : all.scene.inputs)
        rows.push_back(
            {"<span class=\"letters\">" + html_letters(input.name.text) + "</span>",
             "<code>" + html(input.shown.unit.empty() ? input.value.text : input.shown.value) + "</code>",
             html(unit_text(ShownUnit(input.shown).text(input.unit))), html(input.about)});
    if (!rows.empty()) add_table(page.body, say("Given functions of time"), of_values, rows);
    page.end();
}

}  // namespace alembert
