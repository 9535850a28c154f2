// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/function.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/layout.hpp"
#include "emit/parts.hpp"
#include "emit/writer.hpp"
#include "program/processor.hpp"

namespace alembert {

namespace {

/// Several in a line; arrays apart.
std::vector<std::string> unpacked(const std::vector<ArrayInput>& items) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t k = 0; k < items.size(); ++k) {
        const std::string item = fmt::format("{} = {}", items[k].name, items[k].source());
        if (!line.empty() &&
            (items[k].array != items[k - 1].array || line.size() + item.size() > line_width - 15)) {
            lines.push_back(line);
            line.clear();
        }
        line += (line.empty() ? "&" : ", &") + item;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

/// Arguments that the function does not use stay without a name.
std::string signature(const std::vector<FunctionArgument>& arguments, const std::set<std::string>& used) {
    std::string result;
    for (const FunctionArgument& a : arguments)
        result +=
            fmt::format("{}{}{}", result.empty() ? "" : ", ", a.type, used.contains(a.name) ? " " + a.name : "");
    return result;
}

std::set<std::string> used_in(const std::vector<Passage>& passages, const std::vector<ArrayInput>& items) {
    constexpr const char* arrays[] = {"state", "rate", "par"};
    std::set<std::string> used;
    for (const Passage& passage : passages)
        for (const CodeStatement& statement : passage.statements)
            used.insert(statement.uses.begin(), statement.uses.end());
    for (const ArrayInput& item : items) used.insert(arrays[static_cast<int>(item.array)]);
    return used;
}

std::vector<EmittedFunction> in_pieces(const FunctionTask& task, const std::vector<ArrayInput>& items,
                                       const std::vector<Passage>& passages, std::size_t longest) {
    std::vector<CodeStatement> statements;
    for (const Passage& passage : passages)
        statements.insert(statements.end(), passage.statements.begin(), passage.statements.end());
    const FunctionParts parts = in_parts(statements, std::min(processor::part_length, longest));
    std::string given, of_parts;
    std::set<std::string> all;
    for (const FunctionArgument& a : task.arguments) {
        given += a.name + ", ";
        of_parts += fmt::format("[[maybe_unused]] {} {}, ", a.type, a.name);
        all.insert(a.name);
    }
    std::vector<EmittedFunction> result;
    Passage calls{"Parts", {{.text = fmt::format("Real carried[{}];", std::max(parts.carried, 1))}}};
    for (const FunctionPart& part : parts.list) {
        std::vector<ArrayInput> used;
        for (const ArrayInput& item : items)
            if (part.names.contains(item.name)) used.push_back(item);
        Passage lines{.title = "Part"};
        for (const std::string& line : part.lines) lines.statements.push_back({.text = line});
        const std::string own = fmt::format("{}_{}", task.name, result.size());
        result.push_back(
            {own, "A part.", of_parts + "[[maybe_unused]] Real* carried", unpacked(used), {lines}, true});
        calls.statements.push_back({.text = fmt::format("{}({}carried);", own, given)});
    }
    result.push_back({.name = task.name,
                      .about = task.about,
                      .arguments = signature(task.arguments, all),
                      .passages = {calls}});
    return result;
}

}  // namespace

std::vector<EmittedFunction> written(const Program& program, const Vocabulary& words, const FunctionTask& task,
                                     const EmitOptions& options) {
    if (task.results.empty() && task.copies.empty()) return {};
    Writer writer(program, words.names(), words.leaves(), options.batch);
    std::vector<Passage> passages = writer.write(task.goals);
    Passage last{.title = "Result", .statements = task.copies};
    for (const FunctionResult& result : task.results)
        last.statements.push_back(writer.assigned(result.array, result.place, result.node));
    passages.push_back(std::move(last));
    const std::vector<ArrayInput> items = words.inputs(writer.uses(), !task.copies.empty());
    std::size_t count = 0;
    for (const Passage& passage : passages) count += passage.statements.size();
    if (count > options.longest_function) return in_pieces(task, items, passages, options.longest_function);
    return {{.name = task.name,
             .about = task.about,
             .arguments = signature(task.arguments, used_in(passages, items)),
             .unpacked = unpacked(items),
             .passages = passages}};
}

std::vector<EmittedFunction> prepare(const Program& program, const Vocabulary& words) {
    if (words.constants().empty()) return {};
    Writer writer(program, words.names(), words.variables());
    std::vector<Goal> goals;
    for (const int id : words.constants()) goals.push_back({"Constants", words.constant(id), id, true});
    std::vector<Passage> passages = writer.write(goals);
    Passage last{.title = "Result"};
    for (std::size_t k = 0; k < words.constants().size(); ++k)
        last.statements.push_back(
            writer.assigned("par", fmt::format("par[{}]", words.par().size() + k), words.constants()[k]));
    passages.push_back(std::move(last));
    std::map<int, int> uses;
    for (const auto& [id, count] : writer.uses())
        if (program[id].op == Op::variable) uses[id] = count;
    return {{.name = "prepare",
             .about = "What depends on parameters alone, after the parameters.",
             .arguments = "Real* par",
             .unpacked = unpacked(words.inputs(uses, false)),
             .passages = passages}};
}

}  // namespace alembert
