// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "codegen/emit/dialect.hpp"

namespace alembert {

namespace {

struct CarriedValue {
    std::size_t made_in, last_part;
    int place = -1;
};

/// The values that later parts need, with places in `carried`. The place of a value that no later part needs goes
/// to the next value, so that `carried` stays small: of the Jacobian of a humanoid it then fits in the nearest
/// cache.
std::map<std::string, CarriedValue> carried_values(const std::vector<CodeStatement>& statements,
                                                   std::size_t length, int& room) {
    std::map<std::string, CarriedValue> values;
    std::vector<std::string> made;
    for (std::size_t i = 0; i < statements.size(); ++i) {
        const std::size_t part = i / length;
        for (const std::string& name : statements[i].uses)
            if (const auto value = values.find(name); value != values.end()) value->second.last_part = part;
        for (const std::string& name : statements[i].names)
            if (values.emplace(name, CarriedValue{part, part}).second) made.push_back(name);
    }
    std::map<std::size_t, std::vector<int>> given_back;  // by the part after which they are free
    std::vector<int> free;
    std::size_t now = 0;
    for (const std::string& name : made) {
        CarriedValue& value = values.at(name);
        if (value.last_part == value.made_in) continue;
        for (; now < value.made_in; ++now)
            if (const auto places = given_back.find(now); places != given_back.end())
                free.insert(free.end(), places->second.rbegin(), places->second.rend());
        if (free.empty()) free.push_back(room++);
        value.place = free.back();
        free.pop_back();
        given_back[value.last_part].push_back(value.place);
    }
    return values;
}

}  // namespace

FunctionParts in_parts(const std::vector<CodeStatement>& statements, std::size_t length, CodeLanguage language) {
    const Dialect& dialect = dialect_of(language);
    const auto carried_at = [&](int place) { return dialect.place("carried", static_cast<std::size_t>(place)); };
    FunctionParts parts;
    const std::map<std::string, CarriedValue> values = carried_values(statements, length, parts.carried);
    for (std::size_t first = 0; first < statements.size(); first += length) {
        FunctionPart& part = parts.list.emplace_back();
        const std::size_t end = std::min(first + length, statements.size());
        for (std::size_t i = first; i < end; ++i) {
            part.names.insert(statements[i].uses.begin(), statements[i].uses.end());
            part.names.insert(statements[i].names.begin(), statements[i].names.end());
        }
        for (const std::string& name : part.names)
            if (const auto value = values.find(name);
                value != values.end() && value->second.made_in < parts.list.size() - 1)
                part.lines.push_back(
                    language == CodeLanguage::cpp
                        ? fmt::format("const Real& {} = {};", name, carried_at(value->second.place))
                        : dialect.declared(name, carried_at(value->second.place)));
        for (std::size_t i = first; i < end; ++i) {
            part.lines.push_back(statements[i].text);
            for (const std::string& name : statements[i].names)
                if (const int place = values.at(name).place; place >= 0)
                    part.lines.push_back(dialect.assigned(carried_at(place), name));
        }
    }
    return parts;
}

}  // namespace alembert
