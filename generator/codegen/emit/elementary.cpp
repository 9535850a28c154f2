// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/elementary.hpp"

#include <algorithm>

#include "codegen/emit/templates.hpp"

namespace alembert {

kainjow::mustache::data list_of(const std::vector<std::string>& lines) {
    kainjow::mustache::data list{kainjow::mustache::data::type::list};
    for (const std::string& line : lines) list << line;
    return list;
}

std::set<Op> elementary_functions(const Program& program) {
    std::vector<int> roots;
    for (const Root& root : program.roots) roots.push_back(root.node);
    std::set<Op> functions;
    for (const int id : program.needed(roots)) {
        if (program[id].op == Op::unspecified && program.table_of(program[id]) == nullptr)
            program.refuse_unspecified(program[id]);
        if (program[id].op >= Op::sin) functions.insert(program[id].op);
    }
    return functions;
}

void set_elementary(kainjow::mustache::data& file, const std::set<Op>& functions) {
    for (int k = static_cast<int>(Op::sin); k <= static_cast<int>(Op::max); ++k)
        file.set(name_of(static_cast<Op>(k)), functions.contains(static_cast<Op>(k)));
    file.set("trigonometric", functions.contains(Op::sin) || functions.contains(Op::cos));
    file.set("library", std::any_of(functions.begin(), functions.end(),
                                    [](Op op) { return op != Op::sin && op != Op::cos; }));
}

void add_elementary(kainjow::mustache::data& file) {
    const auto rendered = [&](std::string_view shape) {
        std::string text = kainjow::mustache::mustache{std::string(shape)}.render(file);
        while (text.ends_with('\n')) text.pop_back();
        return text;
    };
    file.set("elementary", rendered(template_elementary));
    const std::string sines = rendered(template_sines);
    file.set("sines", sines.empty() ? "" : "\n" + sines + "\n");
}

}  // namespace alembert
