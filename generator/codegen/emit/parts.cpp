// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/parts.hpp"

#include <fmt/format.h>

#include <map>

namespace alembert {

FunctionParts in_parts(const std::vector<CodeStatement>& statements, std::size_t length, CodeLanguage language) {
    const char* const type = language == CodeLanguage::cpp ? "Real& " : language == CodeLanguage::c ? "Real " : "";
    FunctionParts parts;
    std::map<std::string, std::size_t> made_in;  // name → part
    for (std::size_t i = 0; i < statements.size(); ++i) {
        if (i % length == 0) parts.list.emplace_back();
        FunctionPart& part = parts.list.back();
        part.lines.push_back(statements[i].text);
        part.names.insert(statements[i].uses.begin(), statements[i].uses.end());
        part.names.insert(statements[i].names.begin(), statements[i].names.end());
        for (const std::string& name : statements[i].names) made_in[name] = parts.list.size() - 1;
    }
    std::map<std::string, int> places;
    for (std::size_t k = 0; k < parts.list.size(); ++k) {
        std::vector<std::string> loads;
        for (const std::string& name : parts.list[k].names) {
            const auto made = made_in.find(name);
            if (made == made_in.end() || made->second == k) continue;
            const auto [place, is_new] = places.try_emplace(name, parts.carried);
            if (is_new)
                parts.list[made->second].lines.push_back(fmt::format("carried[{}] = {};", parts.carried++, name));
            loads.push_back(fmt::format("const {}{} = carried[{}];", type, name, place->second));
        }
        parts.list[k].lines.insert(parts.list[k].lines.begin(), loads.begin(), loads.end());
    }
    return parts;
}

}  // namespace alembert
