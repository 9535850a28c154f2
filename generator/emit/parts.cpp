// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/parts.hpp"

#include <fmt/format.h>

#include <cctype>
#include <map>

namespace alembert {

namespace {

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_in_name(char c) { return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// All names, numbers and members (.x) left out.
std::set<std::string> names_in(const std::string& line) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < line.size();) {
        if (!is_in_name(line[i])) {
            ++i;
            continue;
        }
        const std::size_t start = i;
        while (i < line.size() && (is_in_name(line[i]) || (line[i] == '.' && !begins_name(line[start])))) ++i;
        if (begins_name(line[start]) && (start == 0 || line[start - 1] != '.')) names.insert(line.substr(start, i - start));
    }
    return names;
}

constexpr std::string_view head = "const Real ", pair = "const auto [", group = "const auto ";

/// Names that a line declares: those of a pair in its brackets, or before " = ", outside brackets.
std::vector<std::string> declared_in(const std::string& line) {
    std::vector<std::string> names;
    if (line.starts_with(pair)) {
        const std::set<std::string> both = names_in(line.substr(pair.size(), line.find(']') - pair.size()));
        return {both.begin(), both.end()};
    }
    if (!line.starts_with(head)) return names;
    std::size_t start = head.size();
    int depth = 0;
    for (std::size_t i = start; i < line.size(); ++i) {
        if (line[i] == '(' || line[i] == '[') ++depth;
        if (line[i] == ')' || line[i] == ']') --depth;
        if (depth > 0) continue;
        if (line[i] == ',') start = i + 2;
        if (line.compare(i, 3, " = ") == 0) names.push_back(line.substr(start, i - start));
    }
    return names;
}

}  // namespace

FunctionParts in_parts(const std::vector<std::string>& statements, std::size_t length) {
    FunctionParts parts;
    std::map<std::string, std::size_t> made_in;  // name → part
    for (std::size_t i = 0; i < statements.size(); ++i) {
        const bool is_open = i > 0 && statements[i - 1].starts_with(group) && !statements[i - 1].starts_with(pair);
        if (parts.list.empty() || (parts.list.back().lines.size() >= length && !is_open)) parts.list.emplace_back();
        FunctionPart& part = parts.list.back();
        part.lines.push_back(statements[i]);
        part.names.merge(names_in(statements[i]));
        for (const std::string& name : declared_in(statements[i])) made_in[name] = parts.list.size() - 1;
    }
    std::map<std::string, int> places;
    for (std::size_t k = 0; k < parts.list.size(); ++k) {
        std::vector<std::string> loads;
        for (const std::string& name : parts.list[k].names) {
            const auto made = made_in.find(name);
            if (made == made_in.end() || made->second == k) continue;
            const auto [place, is_new] = places.try_emplace(name, parts.carried);
            if (is_new) parts.list[made->second].lines.push_back(fmt::format("carried[{}] = {};", parts.carried++, name));
            loads.push_back(fmt::format("const Real& {} = carried[{}];", name, place->second));
        }
        parts.list[k].lines.insert(parts.list[k].lines.begin(), loads.begin(), loads.end());
    }
    return parts;
}

}  // namespace alembert
