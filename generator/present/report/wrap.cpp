// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/wrap.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "present/report/ink.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr int indent_of_rest = 4, narrowest = 20;

/// A space at which a line may be broken.
struct BreakPoint {
    std::size_t at = 0;
    int column = 0, depth = 0;
    bool before_operator = false;
};

bool is_operator(std::string_view rest) {
    return rest.size() > 1 && std::string_view("+-=<>").find(rest[0]) != std::string_view::npos &&
           (rest[1] == ' ' || rest[1] == '=');
}

struct MeasuredLine {
    std::vector<BreakPoint> breaks = {};
    int width = 0, indent = 0;
};

MeasuredLine measured(std::string_view line) {
    MeasuredLine result;
    int depth = 0;
    result.indent = static_cast<int>(std::min(line.find_first_not_of(' '), line.size()));
    for (std::size_t i = 0; i < line.size();) {
        const std::size_t begin = i;
        if (line[i] == ink_mark) {
            i += 2;
            continue;
        }
        const char32_t c = decode(line, i);
        if (c == U'(' || c == U'[') ++depth;
        if (c == U')' || c == U']') --depth;
        if (c == U' ' && result.width > result.indent)
            result.breaks.push_back({begin, result.width, depth, is_operator(line.substr(begin + 1))});
        result.width += c == invalid_character ? 1 : width(c);
    }
    return result;
}

/// The last break that fits, among those least deep in parentheses and before an operator; if possible not in the
/// first half of the line.
std::optional<std::size_t> best(const MeasuredLine& line, int width) {
    const int half = line.indent + (width - line.indent) / 2;
    const BreakPoint* chosen = nullptr;
    const auto rank = [half](const BreakPoint& b) {
        return std::tuple(b.column >= half, -b.depth, b.before_operator, b.column);
    };
    for (const BreakPoint& one : line.breaks)
        if (one.column <= width && (chosen == nullptr || rank(one) > rank(*chosen))) chosen = &one;
    return chosen == nullptr ? std::nullopt : std::optional(chosen->at);
}

/// Whether the line is a row of a table, in which at least two gaps separate words. Such rows are not changed.
bool is_row(std::string_view line) {
    int gaps = 0;
    for (std::size_t at = line.find_first_not_of(' '); at < line.size();) {
        const std::size_t space = std::min(line.find(' ', at), line.size());
        const std::size_t next = std::min(line.find_first_not_of(' ', space), line.size());
        if (next - space >= 3 && next < line.size()) ++gaps;
        at = next;
    }
    return gaps >= 2;
}

std::string wrapped_line(std::string line, int width) {
    if (is_row(line)) return line;
    std::string result;
    bool is_first = true;
    for (;;) {
        const MeasuredLine now = measured(line);
        const auto at = now.width <= width ? std::nullopt : best(now, width);
        if (!at) return result + line;
        std::size_t next = *at;
        while (next < line.size() && line[next] == ' ') ++next;
        result += line.substr(0, *at) + "\n";
        const int indent = now.indent + (is_first ? indent_of_rest : 0);
        line = std::string(static_cast<std::size_t>(indent), ' ') + line.substr(next);
        is_first = false;
    }
}

}  // namespace

std::string wrapped(std::string_view text, int width) {
    width = std::max(width, narrowest);
    std::string result;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        result += wrapped_line(std::string(text.substr(0, end)), width);
        if (end < text.size()) result += '\n';
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return result;
}

}  // namespace alembert
