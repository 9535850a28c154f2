// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/plot_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace alembert {

namespace {

// Numbers outside this range are written with a power of ten.
constexpr double most_plain = 1e5, least_plain = 1e-4;

std::string superscript(int number) {
    static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = number < 0 ? "⁻" : "";
    for (const char c : std::to_string(std::abs(number))) text += digits[c - '0'];
    return text;
}

/// The number with a typographic minus sign.
std::string fixed(double value, int decimals) {
    const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
    const bool is_zero = digits.find_first_not_of("0.") == std::string::npos;
    return (value < 0 && !is_zero ? "−" : "") + digits;
}

int decimals_for(double step) {
    int decimals = 0;
    for (double scaled = step; decimals < 17 && std::abs(scaled - std::round(scaled)) > 1e-6 * scaled; ++decimals)
        scaled = step * std::pow(10.0, decimals + 1);
    return decimals;
}

constexpr double slack = 1e-9;  // relative to a step; a number this little beyond an end counts as at the end

/// The step, 1, 2 or 5 times a power of ten: the least of which at most `most` multiples are in the range.
double step_for(double low, double high, int most) {
    const double unit = std::pow(10.0, std::floor(std::log10((high - low) / most)) - 1);
    for (double decade = unit;; decade *= 10)
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double step = factor * decade;
            if (std::floor(high / step + slack) - std::ceil(low / step - slack) < most) return step;
        }
}

std::vector<PlotTick> powers_of_ten(const PlotScale& s, int most) {
    const int first = static_cast<int>(std::lround(std::log10(s.low))),
              last = static_cast<int>(std::lround(std::log10(s.high)));
    const int stride = (last - first) / std::max(most, 2) + 1;
    std::vector<PlotTick> result;
    for (int d = first; d <= last; d += stride) result.push_back({std::pow(10.0, d), "10" + superscript(d)});
    return result;
}

}  // namespace

double PlotScale::at(double value) const {
    const double part = decades ? (std::log10(value) - std::log10(low)) / (std::log10(high) - std::log10(low))
                                : (value - low) / (high - low);
    return begin + part * (end - begin);
}

std::vector<PlotTick> PlotScale::ticks(int most) const {
    if (decades) return powers_of_ten(*this, most);
    const double step = step_for(low, high, std::max(most, 2));
    std::vector<PlotTick> result;
    for (double k = std::ceil(low / step - slack); k <= high / step + slack; ++k)
        result.push_back({k * step, plot_number(k * step, step)});
    return result;
}

PlotScale linear_scale(double least, double most, double begin, double end, double margin) {
    if (!std::isfinite(least) || !std::isfinite(most)) least = 0, most = 1;
    const double size = std::max(std::abs(least), std::abs(most));
    if (most - least <= 1e-14 * size || most == least) {  // the difference is only rounding
        const double half = size > 0 ? 0.1 * size : 1;
        least -= half;
        most += half;
    }
    const double extra = margin * (most - least);
    return {.low = least - extra, .high = most + extra, .begin = begin, .end = end};
}

PlotScale decade_scale(double least, double most, double begin, double end) {
    const double first = std::floor(std::log10(least)), last = std::ceil(std::log10(most));
    return {.low = std::pow(10.0, first),
            .high = std::pow(10.0, std::max(last, first + 1)),
            .begin = begin,
            .end = end,
            .decades = true};
}

std::string plot_number(double value, double step) {
    if (std::abs(value) < 1e-9 * step) return "0";
    if (std::abs(value) < most_plain && step >= least_plain) return fixed(value, decimals_for(step));
    const int power = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
    const double unit = std::pow(10.0, power);
    const std::string factor = fixed(value / unit, decimals_for(step / unit));
    if (factor == "1" || factor == "−1") return (value < 0 ? "−10" : "10") + superscript(power);
    return factor + "·10" + superscript(power);
}

}  // namespace alembert
