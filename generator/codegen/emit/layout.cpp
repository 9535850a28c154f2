// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/layout.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string_view>

namespace alembert {

namespace {

std::string wrapped_line(const std::string& line) {
    std::string result;
    std::size_t start = 0;
    while (line.size() - start > line_width) {
        std::size_t cut = std::string::npos;
        int depth = 0;
        for (std::size_t at = start; at < line.size() && at - start < line_width; ++at) {
            depth += line[at] == '[' ? 1 : line[at] == ']' ? -1 : 0;
            if (line[at] == ' ' && depth == 0 && at > start && at + 1 < line.size() &&
                (std::string_view("+-*/").find(line[at + 1]) != std::string_view::npos || line[at - 1] == ','))
                cut = at;
        }
        if (cut == std::string::npos) break;
        result += line.substr(start, cut - start) + "\n        ";
        start = cut + 1;
    }
    return result + line.substr(start);
}

}  // namespace

std::string wrapped(const std::string& text) {
    std::istringstream lines(text);
    std::string result;
    for (std::string line; std::getline(lines, line);)
        result += (result.empty() ? "" : "\n    ") + wrapped_line(line);
    return result;
}

std::string wrapped_list(const std::vector<std::string>& items) {
    std::string result, line;
    for (const std::string& item : items) {
        if (line.size() + item.size() > line_width) {
            result += line + "\n    ";
            line.clear();
        }
        line += item + ", ";
    }
    return result + line;
}

std::string quoted(const std::vector<std::string>& names) {
    std::string result;
    for (const std::string& name : names) result += fmt::format("\"{}\", ", name);
    return result;
}

std::string described(const NamedFunction& function) {
    const std::string shape = function.columns == 1
                                  ? counted(function.rows, "value")
                                  : fmt::format("{} x {}, row by row", function.rows, function.columns);
    return fmt::format("{}; {}", shape, counted(function.operations.total(), "operation"));
}

std::string counted(long count, const std::string& noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace alembert
