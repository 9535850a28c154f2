// SPDX-License-Identifier: GPL-2.0-or-later
// Each of Braille's letters U+2800 to U+28FF has two dots across and four up; bit k of its number stands for dot k
// + 1.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/language/say.hpp"
#include "present/report/motion_plot.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr int letters_up = 4, beside_braille = 11, narrowest = 20, widest = 72;
constexpr std::size_t most_charts = 4;

/// A rectangle of dots; (0, 0) is below on the left.
class Dots {
public:
    Dots(int columns, int rows)
        : columns_(columns), rows_(rows), letters_(static_cast<std::size_t>(columns * rows)) {}

    int across() const { return 2 * columns_; }
    int up() const { return 4 * rows_; }

    void set(int x, int y) {
        if (x < 0 || x >= across() || y < 0 || y >= up()) return;
        constexpr std::array<std::array<char32_t, 4>, 2> bits{
            {{0x40, 0x04, 0x02, 0x01}, {0x80, 0x20, 0x10, 0x08}}};
        const int row = rows_ - 1 - y / 4;
        letters_[static_cast<std::size_t>(row * columns_ + x / 2)] |=
            bits[static_cast<std::size_t>(x % 2)][static_cast<std::size_t>(y % 4)];
    }

    std::string row(int k) const {
        std::string text;
        for (int x = 0; x < columns_; ++x)
            text += encode(U'\u2800' + letters_[static_cast<std::size_t>(k * columns_ + x)]);
        return text;
    }

private:
    int columns_, rows_;
    std::vector<char32_t> letters_;
};

/// The chart of one quantity: its name, its least and its largest value beside the dots.
std::string chart(const PlottedLine& line, int columns) {
    double low = INFINITY, high = -INFINITY;
    for (const auto& [t, y] : line.points) {
        low = std::min(low, y);
        high = std::max(high, y);
    }
    if (!std::isfinite(low) || !std::isfinite(high)) return {};
    const double middle = (low + high) / 2;
    const double size = std::max({high - low, 1e-6 * std::max(std::abs(low), std::abs(high)), 1e-300});
    const double begin = line.points.front().first, end = line.points.back().first;
    Dots dots(columns, letters_up);
    const auto x_of = [&](double t) {
        return end > begin ? (t - begin) / (end - begin) * (dots.across() - 1) : 0;
    };
    const auto y_of = [&](double y) { return ((y - middle) / size + 0.5) * (dots.up() - 1); };
    for (std::size_t k = 0; k < line.points.size(); ++k) {
        const auto& [t, y] = line.points[k];
        const auto& [t1, y1] = line.points[std::min(k + 1, line.points.size() - 1)];
        if (!std::isfinite(y) || !std::isfinite(y1)) continue;
        const double dx = x_of(t1) - x_of(t), dy = y_of(y1) - y_of(y);
        const int steps = std::max(1, static_cast<int>(std::ceil(std::max(std::abs(dx), std::abs(dy)))));
        for (int i = 0; i <= steps; ++i)
            dots.set(static_cast<int>(std::lround(x_of(t) + dx * i / steps)),
                     static_cast<int>(std::lround(y_of(y) + dy * i / steps)));
    }
    std::string text = "\n" + line.name + (line.unit.empty() ? "" : say(" in {}", line.unit)) + "\n";
    for (int k = 0; k < letters_up; ++k) {
        const std::string value = k == 0                ? fmt::format("{:.4g}", high)
                                  : k == letters_up - 1 ? fmt::format("{:.4g}", low)
                                                        : "";
        text += fmt::format("{:>{}} │{}\n", value, beside_braille - 2, dots.row(k));
    }
    return text;
}

}  // namespace

std::string braille_plot(const Run& run, const std::vector<std::string>& names, int columns) {
    if (run.rows.rows() < 2) return {};
    std::vector<PlottedLine> lines = lines_of(run, names.empty() ? run.coordinates : names);
    const std::size_t left_out = lines.size() > most_charts && names.empty() ? lines.size() - most_charts : 0;
    lines.resize(lines.size() - left_out);
    const int width = std::clamp(columns - beside_braille, narrowest, widest);
    std::string text;
    for (const PlottedLine& line : lines)
        if (!line.points.empty()) text += chart(line, width);
    if (text.empty()) return {};
    const std::string end = fmt::format("{:.6g} s", run.motion.final_time());
    text += fmt::format("{:>{}} {:<{}}{}\n", "t", beside_braille - 2, fmt::format("{:.6g}", run.rows.at(0, 0)),
                        std::max(1, width + 1 - static_cast<int>(end.size())), end);
    if (left_out > 0) text += say("… and {} more coordinates; --show names those to draw\n", left_out);
    return text;
}

}  // namespace alembert
