// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "codegen/emit/layout.hpp"
#include "codegen/emit/parts.hpp"
#include "codegen/emit/writer.hpp"
#include "program/processor.hpp"

namespace alembert {

std::string typed(CodeLanguage language, const FunctionArgument& argument, const std::string& real) {
    if (language == CodeLanguage::javascript) return argument.name;
    std::string type = language == CodeLanguage::c && argument.type == "const Real&" ? "Real" : argument.type;
    constexpr std::string_view name = "Real";
    return type.replace(type.find(name), name.size(), real) + " " + argument.name;
}

namespace {

/// Several declarations in a line; different arrays on separate lines.
std::vector<std::string> unpacked(const std::vector<ArrayInput>& items, CodeLanguage language) {
    const std::string alias = language == CodeLanguage::cpp ? "&" : "";
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t k = 0; k < items.size(); ++k) {
        const std::string item = fmt::format("{} = {}", items[k].name, items[k].source());
        if (!line.empty() &&
            (items[k].array != items[k - 1].array || line.size() + item.size() > line_width - 15)) {
            lines.push_back(line);
            line.clear();
        }
        line += (line.empty() ? "" : ", ") + alias + item;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

/// In C++ alone, arguments that the function does not use get no name.
std::string signature(const std::vector<FunctionArgument>& arguments, const std::set<std::string>& used,
                      CodeLanguage language) {
    std::string result;
    for (const FunctionArgument& a : arguments) {
        const bool is_named = used.contains(a.name) || language != CodeLanguage::cpp;
        result += (result.empty() ? "" : ", ") + (is_named ? typed(language, a) : a.type);
    }
    return result;
}

/// The arguments that C must name although the function does not use them.
std::vector<std::string> ignored(const std::vector<FunctionArgument>& arguments, const std::set<std::string>& used,
                                 CodeLanguage language) {
    std::vector<std::string> names;
    for (const FunctionArgument& a : arguments)
        if (!used.contains(a.name) && language == CodeLanguage::c) names.push_back(a.name);
    return names;
}

/// "mass[1] = mass[2]"
std::string place_of(const FunctionResult& result) {
    std::string text;
    for (const std::size_t place : result.places)
        text += fmt::format("{}{}[{}]", text.empty() ? "" : " = ", result.array, place);
    return text;
}

std::set<std::string> used_in(const std::vector<Passage>& passages, const std::vector<ArrayInput>& items) {
    std::set<std::string> used;
    for (const Passage& passage : passages)
        for (const CodeStatement& statement : passage.statements)
            used.insert(statement.uses.begin(), statement.uses.end());
    for (const ArrayInput& item : items) used.insert(item.name_of_array());
    return used;
}

/// Leaves out angles that were named and are not read: sines of a sum may come from those of its terms.
void leave_out_unread(std::vector<Passage>& passages) {
    const std::set<std::string> read = used_in(passages, {});
    for (Passage& passage : passages)
        std::erase_if(passage.statements, [&](const CodeStatement& statement) {
            return !statement.names.empty() &&
                   std::none_of(statement.names.begin(), statement.names.end(),
                                [&](const std::string& name) { return read.contains(name); });
        });
}

/// All statements, each result as soon as it is known, so that it need not be carried to the last part. Rates come
/// last, since a caller may have one array for state and rate.
std::vector<CodeStatement> with_early_results(const FunctionTask& task, const std::vector<Passage>& passages) {
    std::vector<CodeStatement> statements, late;
    for (std::size_t k = 0; k + 1 < passages.size(); ++k)
        statements.insert(statements.end(), passages[k].statements.begin(), passages[k].statements.end());
    std::map<std::string, std::size_t> made_at;
    for (std::size_t k = 0; k < statements.size(); ++k)
        for (const std::string& name : statements[k].names) made_at.emplace(name, k);
    std::vector<std::vector<CodeStatement>> after(statements.size());
    const std::vector<CodeStatement>& results = passages.back().statements;
    for (std::size_t k = 0; k < results.size(); ++k) {
        std::optional<std::size_t> last;
        for (const std::string& name : results[k].uses)
            if (const auto made = made_at.find(name); made != made_at.end())
                last = std::max(last.value_or(0), made->second);
        const bool is_rate = k < task.copies.size() || task.results[k - task.copies.size()].array == "rate";
        (is_rate || !last ? late : after[*last]).push_back(results[k]);
    }
    std::vector<CodeStatement> list;
    for (std::size_t k = 0; k < statements.size(); ++k) {
        list.push_back(std::move(statements[k]));
        list.insert(list.end(), after[k].begin(), after[k].end());
    }
    list.insert(list.end(), late.begin(), late.end());
    return list;
}

std::vector<EmittedFunction> in_pieces(const FunctionTask& task, const std::vector<ArrayInput>& items,
                                       const std::vector<Passage>& passages, const EmitOptions& options) {
    const CodeLanguage language = options.language;
    const std::string unused = language == CodeLanguage::cpp ? "[[maybe_unused]] " : "";
    const FunctionParts parts = in_parts(with_early_results(task, passages),
                                         std::min(processor::part_length, options.longest_function), language);
    std::string given, of_parts;
    std::set<std::string> all;
    for (const FunctionArgument& a : task.arguments) {
        given += a.name + ", ";
        of_parts += fmt::format("{}{}, ", unused, typed(language, a));
        all.insert(a.name);
    }
    std::vector<EmittedFunction> result;
    const char* const room =
        language == CodeLanguage::javascript ? "const carried = new Float64Array({});" : "Real carried[{}];";
    const char* const own_room =
        language == CodeLanguage::c ? "Real* restrict" : "Real* __restrict";  // nothing else points there
    Passage calls{"Parts", {{.text = fmt::format(fmt::runtime(room), std::max(parts.carried, 1))}}};
    for (const FunctionPart& part : parts.list) {
        std::vector<ArrayInput> used;
        for (const ArrayInput& item : items)
            if (part.names.contains(item.name)) used.push_back(item);
        Passage lines{.title = "Part"};
        for (const std::string& line : part.lines) lines.statements.push_back({.text = line});
        const std::string own = fmt::format("{}_{}", task.name, result.size());
        EmittedFunction piece{.name = own,
                              .about = "A part.",
                              .arguments = of_parts + unused + typed(language, {own_room, "carried"}),
                              .unpacked = unpacked(used, language),
                              .passages = {lines},
                              .is_part = true};
        if (language == CodeLanguage::c) {  // C names all arguments, whether used or not
            for (const FunctionArgument& a : task.arguments) piece.ignored.push_back(a.name);
            piece.ignored.emplace_back("carried");
        }
        result.push_back(std::move(piece));
        calls.statements.push_back({.text = fmt::format("{}({}carried);", own, given)});
    }
    result.push_back({.name = task.name,
                      .about = task.about,
                      .arguments = signature(task.arguments, all, language),
                      .passages = {calls}});
    return result;
}

}  // namespace

std::vector<EmittedFunction> written(const Program& program, const Vocabulary& words, const FunctionTask& task,
                                     const EmitOptions& options) {
    if (task.results.empty() && task.copies.empty()) return {};
    Writer writer(program, words.names(), words.leaves(), options.batch, options.language,
                  options.longest_function);
    std::vector<Passage> passages = writer.write(task.goals);
    Passage last{.title = "Result"};
    for (const RateCopy& copy : task.copies) {
        const std::string& speed = words.u()[static_cast<std::size_t>(copy.from) - words.q().size()];
        last.statements.push_back(
            {.uses = {"rate", speed}, .text = fmt::format("rate[{}] = {};", copy.to, speed)});
    }
    for (const FunctionResult& result : task.results)
        last.statements.push_back(writer.assigned(result.array, place_of(result), result.node));
    passages.push_back(std::move(last));
    leave_out_unread(passages);
    std::vector<ArrayInput> items = words.inputs(writer.uses(), !task.copies.empty());
    if (options.language != CodeLanguage::cpp) {  // C compilers warn about names that are not used
        const std::set<std::string> read = used_in(passages, {});
        std::erase_if(items, [&](const ArrayInput& item) { return !read.contains(item.name); });
    }
    std::size_t count = 0;
    for (const Passage& passage : passages) count += passage.statements.size();
    if (count > options.longest_function) return in_pieces(task, items, passages, options);
    const std::set<std::string> used = used_in(passages, items);
    return {{.name = task.name,
             .about = task.about,
             .arguments = signature(task.arguments, used, options.language),
             .unpacked = unpacked(items, options.language),
             .ignored = ignored(task.arguments, used, options.language),
             .passages = passages}};
}

std::vector<EmittedFunction> prepare(const Program& program, const Vocabulary& words, CodeLanguage language) {
    if (words.constants().empty()) return {};
    Writer writer(program, words.names(), words.variables(), false, language);
    std::vector<Goal> goals;
    for (const int id : words.constants()) goals.push_back({"Constants", words.constant(id), id, true});
    std::vector<Passage> passages = writer.write(goals);
    Passage last{.title = "Result"};
    for (std::size_t k = 0; k < words.constants().size(); ++k)
        last.statements.push_back(
            writer.assigned("par", fmt::format("par[{}]", words.par().size() + k), words.constants()[k]));
    passages.push_back(std::move(last));
    NodeMap<int> uses;
    for (const auto& [id, count] : writer.uses())
        if (program[id].op == Op::variable) uses[id] = count;
    return {{.name = "prepare",
             .about = "What depends on parameters alone, after the parameters.",
             .arguments = typed(language, {"Real*", "par"}),
             .unpacked = unpacked(words.inputs(uses, false), language),
             .passages = passages}};
}

}  // namespace alembert
