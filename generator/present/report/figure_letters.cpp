// SPDX-License-Identifier: GPL-2.0-or-later
/// Where letters stand: a letter stays at its usual place if that is free, otherwise it moves a little way. One
/// that has no room is left out, and of a coordinate the whole mark: the important ones are placed first.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "present/report/figure_screen.hpp"

namespace alembert {

namespace {

using Eigen::Vector2d;
using Kind = FigureShape::Kind;

constexpr double step = 3;           // between points of a stroke, in units of the screen
constexpr double half_letter = 5.2;  // half the width of one, in the wide letters of DejaVu Serif, italic

struct Box {
    Vector2d low, high;
    Box wider(double by) const { return {low.array() - by, high.array() + by}; }
    double area() const { return (high - low).cwiseMax(0).prod(); }
    Box with(const Box& other) const { return {low.cwiseMax(other.low), high.cwiseMin(other.high)}; }
    bool holds(const Vector2d& p, double room) const {
        return p[0] > low[0] - room && p[0] < high[0] + room && p[1] > low[1] - room && p[1] < high[1] + room;
    }
};

/// Whether a letter, by the first byte and the one after it, is a capital or as wide as one.
bool is_wide(char first, char next) {
    constexpr char greek_capitals = '\xce';  // U+0391 to U+03A9 follow it with up to A9
    return std::isupper(static_cast<unsigned char>(first)) != 0 || first == 'm' || first == 'w' ||
           (first == greek_capitals && static_cast<unsigned char>(next) <= 0xa9);
}

/// The number of letters that are seen of a text in SVG, an index as two thirds of a letter, a capital as more
/// than one.
double letters_in(const std::string& expression) {
    const std::string svg = svg_letters(expression);
    double count = 0;
    bool is_tag = false, is_index = false;
    for (std::size_t k = 0; k < svg.size(); ++k) {
        if (svg[k] == '<') {
            is_tag = true;
            is_index = svg.compare(k, 19, "<tspan class=\"sub\" ") == 0;
        } else if (svg[k] == '>') {
            is_tag = false;
        } else if (!is_tag && (static_cast<unsigned char>(svg[k]) & 0xc0) != 0x80) {
            count += (is_index ? 0.67 : 1) * (is_wide(svg[k], k + 1 < svg.size() ? svg[k + 1] : ' ') ? 1.35 : 1);
        }
    }
    return count;
}

struct LetterInk {
    Vector2d at;
    double room;    ///< half the width of the stroke
    double weight;  ///< how much it disturbs a letter
};

double weight_of(const std::string& style) {
    if (style == "reference" || style == "hatch" || style == "ground-plane" || style == "axis" ||
        style == "great" || style == "curve")
        return 0.4;
    return 1;
}

std::vector<LetterInk> ink_of(const FigureShapes& figure, const FigureScreen& screen) {
    std::vector<LetterInk> ink;
    for (const FigureShape& shape : figure.shapes) {
        if (is_text(shape) || screen.is_hidden(shape)) continue;
        const double weight = weight_of(shape.style);
        if (shape.kind == Kind::circle) {
            const double r = screen.radius_of(shape);
            const Vector2d c = screen.place(shape.vertices[0], shape);
            const int count = std::clamp(static_cast<int>(2 * std::numbers::pi * r / step), 6, 400);
            for (int k = 0; k < count; ++k) {
                const double angle = 2 * std::numbers::pi * k / count;
                ink.push_back({c + r * Vector2d(std::cos(angle), std::sin(angle)), 1, weight});
            }
            if (shape.style == "mass") ink.push_back({c, 0.7 * r, 4});
            continue;
        }
        const double room = shape.style == "bar-edge" ? 4.5 : 0.8;
        const bool is_closed = shape.closed || shape.kind == Kind::ring;
        const std::vector<FigureScreen::Place> line = screen.outline(shape);
        std::size_t first = 0;
        const auto draw = [&](const Vector2d& a, const Vector2d& b) {
            const int count = std::clamp(static_cast<int>((b - a).norm() / step), 1, 1000);
            for (int k = 0; k <= count; ++k)
                ink.push_back({a + static_cast<double>(k) / count * (b - a), room, weight});
        };
        for (std::size_t k = 0; k < line.size(); ++k) {
            if (line[k].begins)
                first = k;
            else
                draw(line[k - 1].at, line[k].at);
            if (is_closed && (k + 1 == line.size() || line[k + 1].begins)) draw(line[k].at, line[first].at);
        }
    }
    std::erase_if(ink, [](const LetterInk& dot) { return !dot.at.allFinite(); });
    return ink;
}

class Letters {
public:
    Letters(FigureShapes& figure, const FigureScreen& screen)
        : f_(figure), screen_(screen), ink_(ink_of(figure, screen)) {}

    void place() {
        constexpr auto many = 18;  // letters; they stand near what they name then
        is_crowded_ = std::count_if(f_.shapes.begin(), f_.shapes.end(), is_text) > many;
        std::vector<FigureShape*> repeated;
        for (FigureShape* const shape : by_importance(repeated))
            if (!screen_.is_hidden(*shape)) place(*shape);
        if (is_crowded_) without_room_.insert(repeated.begin(), repeated.end());
        leave_out();
    }

private:
    /// Coordinates, loads, and names: the first of each name before those that repeat it.
    std::vector<FigureShape*> by_importance(std::vector<FigureShape*>& repeated) {
        const std::array styles{"angle-name", "dimension-name", "", "name", "axis-name"};
        std::vector<FigureShape*> order;
        std::set<std::string> known;
        for (const std::string style : styles) {
            if (style == "axis-name" && !is_crowded_) order.insert(order.end(), repeated.begin(), repeated.end());
            for (FigureShape& shape : f_.shapes) {
                const bool is_other = std::find(styles.begin(), styles.end(), shape.style) == styles.end();
                if (!is_text(shape) || (style.empty() ? !is_other : shape.style != style)) continue;
                const bool is_new = style != "name" || known.insert(shape.text).second;
                (is_new ? order : repeated).push_back(&shape);
            }
        }
        return order;
    }

    double covered(const Box& box) const {
        double sum = 0;
        constexpr double gap = 1.5;
        for (const Box& other : taken_)
            sum += box.wider(gap).with(other).area() / std::min(box.area(), other.area());
        return sum;
    }

    double ink_in(const Box& box) const {
        double sum = 0;
        for (const LetterInk& dot : ink_)
            if (box.holds(dot.at, dot.room)) sum += 0.25 * dot.weight;
        return sum;
    }

    double outside(const Box& box) const {
        constexpr double edge = 4;
        const Box picture{Vector2d(edge, edge), Vector2d(f_.width - edge, f_.height - edge)};
        return 1 - box.with(picture).area() / box.area();
    }

    double cost(const Box& box, double way) const {
        return 0.02 * way + 12 * covered(box) + ink_in(box) + 40 * outside(box);
    }

    void place(FigureShape& shape) {
        const Vector2d middle = screen_.middle_of_text(shape);
        if (!middle.allFinite()) return;
        const Vector2d half(half_letter * letters_in(shape.text), 7);
        const auto box_at = [&](const Vector2d& nudge) {
            return Box{middle + nudge - half, middle + nudge + half};
        };
        Vector2d best(0, 0);
        double least = cost(box_at(best), 0);
        constexpr double good = 0.5;  // a letter that is touched by a thin line stays
        static constexpr std::array ways{8.0, 14.0, 20.0, 27.0, 35.0};
        for (const double way : ways) {
            if (least <= good || (shape.style == "axis-name" && way > 15) || (is_crowded_ && way > 20)) break;
            for (int k = 0; k < 16; ++k) {
                const double angle = std::numbers::pi * k / 8;
                const Vector2d nudge = way * Vector2d(std::cos(angle), std::sin(angle));
                const double here = cost(box_at(nudge), way);
                if (here < least - 1e-9) least = here, best = nudge;
            }
        }
        const Box box = box_at(best);
        constexpr double legible = 0.05, in_picture = 0.3;
        const double most_ink = is_crowded_ ? 2 : 3;
        if (covered(box) > legible || ink_in(box) > most_ink || outside(box) > in_picture) {
            without_room_.insert(&shape);
            return;
        }
        shape.nudge = best;
        taken_.push_back(box);
    }

    /// The mark of a coordinate says nothing without its letter.
    void leave_out() {
        if (without_room_.empty()) return;
        std::set<int> marks;
        for (const FigureShape* const shape : without_room_)
            if (shape->style == "angle-name" || shape->style == "dimension-name") marks.insert(shape->element);
        std::vector<FigureShape> kept;
        for (const FigureShape& shape : f_.shapes)
            if (!without_room_.contains(&shape) && !marks.contains(shape.element)) kept.push_back(shape);
        f_.shapes = std::move(kept);
    }

    FigureShapes& f_;
    const FigureScreen& screen_;
    std::vector<LetterInk> ink_;
    std::vector<Box> taken_;
    std::set<const FigureShape*> without_room_;
    bool is_crowded_ = false;
};

}  // namespace

void place_letters(FigureShapes& figure, const Pose& pose, const std::vector<double>& q) {
    const FigureScreen screen(figure, pose, q);
    Letters(figure, screen).place();
}

}  // namespace alembert
