// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/function.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

#include "codegen/emit/dialect.hpp"
#include "codegen/emit/layout.hpp"
#include "codegen/emit/parts.hpp"
#include "codegen/emit/writer.hpp"
#include "program/processor.hpp"

namespace alembert {

std::string typed(CodeLanguage language, const FunctionArgument& argument, const std::string& real) {
    if (language == CodeLanguage::rust)
        return argument.name + (argument.type == "const Real&"             ? ": R"
                                : argument.type.starts_with("const Real*") ? ": &[R]"
                                                                           : ": &mut [R]");
    if (language >= CodeLanguage::javascript) return argument.name;
    std::string type = language == CodeLanguage::c && argument.type == "const Real&" ? "Real" : argument.type;
    constexpr std::string_view name = "Real";
    return type.replace(type.find(name), name.size(), real) + " " + argument.name;
}

namespace {

bool is_output(const FunctionArgument& argument) {
    return argument.type.starts_with("Real*");
}

/// Several declarations in a line; different arrays on separate lines. `par` is what the array of parameters is
/// called.
std::vector<std::string> unpacked(const std::vector<ArrayInput>& items, CodeLanguage language,
                                  const std::string& par = "par") {
    const Dialect& dialect = dialect_of(language);
    const std::string alias = language == CodeLanguage::cpp ? "&" : "";
    std::vector<std::string> lines, names, places;
    std::string line;
    const auto end_line = [&] {
        if (dialect.is_shaped() && !dialect.unpacking.empty())
            line = fmt::format(fmt::runtime(dialect.unpacking), fmt::join(names, ", "), fmt::join(places, ", "));
        lines.push_back(line);
        line.clear(), names.clear(), places.clear();
    };
    for (std::size_t k = 0; k < items.size(); ++k) {
        const std::string place =
            dialect.place(items[k].array == ArrayInput::Array::par ? par : items[k].name_of_array(),
                          static_cast<std::size_t>(items[k].place));
        const std::string item = dialect.is_shaped() ? dialect.assigned(items[k].name, place)
                                                     : fmt::format("{} = {}", items[k].name, place);
        if (!line.empty() && (items[k].array != items[k - 1].array || line.size() + item.size() > line_width - 15))
            end_line();
        line += (line.empty() ? "" : dialect.is_shaped() ? " " : ", ") + alias + item;
        names.push_back(items[k].name), places.push_back(place);
    }
    if (!line.empty()) end_line();
    return lines;
}

/// The arguments in the order of the language: those of Julia begin with what is filled, and end with the time.
std::vector<FunctionArgument> ordered(std::vector<FunctionArgument> arguments, CodeLanguage language) {
    if (language != CodeLanguage::julia) return arguments;
    const auto rank = [](const FunctionArgument& a) { return is_output(a) ? 0 : a.name == "t" ? 2 : 1; };
    std::stable_sort(arguments.begin(), arguments.end(),
                     [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    return arguments;
}

/// "t, state, par, rate"
std::string passed(const std::vector<FunctionArgument>& arguments, CodeLanguage language) {
    std::string text;
    for (const FunctionArgument& a : ordered(arguments, language)) text += (text.empty() ? "" : ", ") + a.name;
    return text;
}

/// In C++ alone, arguments that the function does not use get no name.
std::string signature(const std::vector<FunctionArgument>& arguments, const std::set<std::string>& used,
                      CodeLanguage language) {
    std::string result;
    for (const FunctionArgument& a : ordered(arguments, language)) {
        if (is_output(a) && dialect_of(language).results != ResultArrays::filled) continue;
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

/// What an array of results is called: as it is, but for reserved words and for an output of the function's name.
std::string name_in(const Dialect& dialect, const std::string& function, const std::string& array) {
    if (dialect.results == ResultArrays::filled) return array;
    return array == function ? "values" : dialect.array(array);
}

/// The arrays of results, with their sizes.
std::vector<GivenArray> given_arrays(const FunctionTask& task, const Dialect& dialect) {
    std::vector<GivenArray> list;
    for (const FunctionArgument& a : task.arguments) {
        if (!is_output(a)) continue;
        GivenArray array{.name = name_in(dialect, task.name, a.name), .size = 0, .is_filled = true};
        std::set<std::size_t> places;
        for (const RateCopy& copy : task.copies)
            if (a.name == "rate") places.insert(static_cast<std::size_t>(copy.to));
        for (const FunctionResult& result : task.results)
            if (result.array == a.name) places.insert(result.places.begin(), result.places.end());
        array.size = std::max(places.empty() ? 0 : *places.rbegin() + 1, a.name == "out" ? task.size : 0);
        array.is_filled = places.size() == array.size;
        list.push_back(array);
    }
    return list;
}

/// The statements that write the results, each place by itself, or that make arrays of them.
std::vector<CodeStatement> shaped_results(Writer& writer, const Vocabulary& words, const FunctionTask& task,
                                          const Dialect& dialect) {
    std::vector<CodeStatement> statements;
    std::map<std::string, std::map<std::size_t, CodeStatement>> values;
    for (const RateCopy& copy : task.copies) {
        const std::string& speed = words.u()[static_cast<std::size_t>(copy.from) - words.q().size()];
        values["rate"][static_cast<std::size_t>(copy.to)] = {.uses = {"rate", speed}, .text = speed};
    }
    for (const FunctionResult& result : task.results) {
        const CodeStatement value = writer.evaluated(result.node);
        for (const std::size_t place : result.places) values[result.array][place] = value;
    }
    for (const FunctionArgument& a : task.arguments) {
        if (!is_output(a)) continue;
        const std::string name = name_in(dialect, task.name, a.name);
        if (dialect.results != ResultArrays::collected) {
            for (const auto& [place, value] : values[a.name]) {
                CodeStatement& one = statements.emplace_back(value);
                one.uses.insert(a.name);
                one.text = dialect.assigned(dialect.place(name, place), value.text);
            }
            continue;
        }
        const std::vector<GivenArray> arrays = given_arrays(task, dialect);
        const auto array =
            std::find_if(arrays.begin(), arrays.end(), [&](const GivenArray& one) { return one.name == name; });
        CodeStatement& made = statements.emplace_back();
        std::string text = "array_of(xp";
        for (std::size_t k = 0; k < array->size; ++k) {
            const CodeStatement& value = values[a.name][k];
            made.uses.insert(value.uses.begin(), value.uses.end());
            text += ", " + (value.text.empty() ? dialect.literal("0") : value.text);
        }
        made.text = dialect.assigned(name, text + ")");
    }
    return statements;
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

/// What a function takes that it does not fill.
std::vector<FunctionArgument> taken_arrays(const FunctionTask& task) {
    std::vector<FunctionArgument> list = task.arguments;
    std::erase_if(list, is_output);
    return list;
}

/// All names that a function declares, in their order.
std::vector<std::string> names_in(const std::vector<ArrayInput>& items, const std::vector<Passage>& passages) {
    std::vector<std::string> names;
    for (const ArrayInput& item : items) names.push_back(item.name);
    for (const Passage& passage : passages)
        for (const CodeStatement& statement : passage.statements)
            names.insert(names.end(), statement.names.begin(), statement.names.end());
    return names;
}

/// All statements, each result as soon as it is known, so that it need not be carried to the last part. Rates come
/// last, since a caller may have one array for state and rate.
std::vector<CodeStatement> with_early_results(const std::vector<Passage>& passages) {
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
        (results[k].uses.contains("rate") || !last ? late : after[*last]).push_back(results[k]);
    }
    std::vector<CodeStatement> list;
    for (std::size_t k = 0; k < statements.size(); ++k) {
        list.push_back(std::move(statements[k]));
        list.insert(list.end(), after[k].begin(), after[k].end());
    }
    list.insert(list.end(), late.begin(), late.end());
    return list;
}

/// That of numbers which hold what follows from all that is given, duals too.
std::string type_in_julia(const std::vector<FunctionArgument>& arguments) {
    std::string types = "typeof(t)";
    for (const FunctionArgument& a : arguments)
        if (a.type == "const Real*") types += fmt::format(", eltype({})", a.name);
    return fmt::format("promote_type({})", types);
}

std::vector<EmittedFunction> in_pieces(const FunctionTask& task, const std::vector<ArrayInput>& items,
                                       const std::vector<Passage>& passages, const EmitOptions& options) {
    const CodeLanguage language = options.language;
    const std::string unused = language == CodeLanguage::cpp ? "[[maybe_unused]] " : "";
    const FunctionParts parts = in_parts(with_early_results(passages),
                                         std::min(processor::part_length, options.longest_function), language);
    std::vector<FunctionArgument> of_part = task.arguments;
    // Nothing else points there.
    of_part.push_back({language == CodeLanguage::c ? "Real* restrict" : "Real* __restrict", "carried"});
    std::string of_parts;
    std::set<std::string> all;
    for (const FunctionArgument& a : ordered(of_part, language)) {
        of_parts += fmt::format("{}{}{}", of_parts.empty() ? "" : ", ", unused, typed(language, a));
        all.insert(a.name);
    }
    const std::string given = language == CodeLanguage::rust ? passed(task.arguments, language) + ", &mut carried"
                                                             : passed(of_part, language);
    std::vector<EmittedFunction> result;
    const char* const room = language == CodeLanguage::javascript ? "const carried = new Float64Array({});"
                             : language == CodeLanguage::rust     ? "let mut carried = [R::of(0.0); {}];"
                             : language == CodeLanguage::julia    ? "carried = zeros({1}, {0})"
                                                                  : "Real carried[{}];";
    const char* const call = language == CodeLanguage::julia ? "{}!({})" : "{}({});";
    Passage calls{
        "Parts",
        {{.text = fmt::format(fmt::runtime(room), std::max(parts.carried, 1), type_in_julia(task.arguments))}}};
    for (const FunctionPart& part : parts.list) {
        std::vector<ArrayInput> used;
        for (const ArrayInput& item : items)
            if (part.names.contains(item.name)) used.push_back(item);
        Passage lines{.title = "Part"};
        for (const std::string& line : part.lines) lines.statements.push_back({.text = line});
        const std::string own = fmt::format("{}_{}", task.name, result.size());
        EmittedFunction piece{.name = own,
                              .about = "A part.",
                              .arguments = of_parts,
                              .unpacked = unpacked(used, language),
                              .passages = {lines},
                              .is_part = true};
        if (language == CodeLanguage::c) {  // C names all arguments, whether used or not
            for (const FunctionArgument& a : task.arguments) piece.ignored.push_back(a.name);
            piece.ignored.emplace_back("carried");
        }
        result.push_back(std::move(piece));
        calls.statements.push_back({.text = fmt::format(fmt::runtime(call), own, given)});
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
    const Dialect& dialect = dialect_of(options.language);
    Passage last{.title = "Result"};
    if (dialect.is_shaped()) last.statements = shaped_results(writer, words, task, dialect);
    for (const RateCopy& copy : task.copies) {
        if (dialect.is_shaped()) break;
        const std::string& speed = words.u()[static_cast<std::size_t>(copy.from) - words.q().size()];
        last.statements.push_back(
            {.uses = {"rate", speed}, .text = fmt::format("rate[{}] = {};", copy.to, speed)});
    }
    for (const FunctionResult& result : task.results)
        if (!dialect.is_shaped())
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
             .passages = passages,
             .takes = taken_arrays(task),
             .gives = given_arrays(task, dialect),
             .names = names_in(items, passages)}};
}

std::vector<EmittedFunction> prepare(const Program& program, const Vocabulary& words, CodeLanguage language) {
    if (words.constants().empty()) return {};
    Writer writer(program, words.names(), words.variables(), false, language);
    std::vector<Goal> goals;
    for (const int id : words.constants()) goals.push_back({"Constants", words.constant(id), id, true});
    std::vector<Passage> passages = writer.write(goals);
    Passage last{.title = "Result"};
    const Dialect& dialect = dialect_of(language);
    const std::size_t first = words.par().size(), count = words.constants().size();
    CodeStatement all{.text = "array_of(xp"};
    for (std::size_t k = 0; k < count; ++k)
        if (dialect.results != ResultArrays::collected)
            last.statements.push_back(
                writer.assigned("par", dialect.place("par", first + k), words.constants()[k]));
        else
            all.text += ", " + writer.value(words.constants()[k]);
    if (dialect.results == ResultArrays::collected)
        last.statements.push_back({.text = dialect.assigned("constants", all.text + ")")});
    passages.push_back(std::move(last));
    NodeMap<int> uses;
    for (const auto& [id, uses_of] : writer.uses())
        if (program[id].op == Op::variable) uses[id] = uses_of;
    const std::vector<ArrayInput> items = words.inputs(uses, false);
    return {{.name = "prepare",
             .about = "What depends on parameters alone, after the parameters.",
             .arguments = typed(language, {"Real*", "par"}),
             .unpacked = unpacked(items, language, dialect.results == ResultArrays::filled ? "par" : "values"),
             .passages = passages,
             .gives = {{.name = "par", .size = first + count, .is_filled = false}},
             .names = names_in(items, passages)}};
}

}  // namespace alembert
