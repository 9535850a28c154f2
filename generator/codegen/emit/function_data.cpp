// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/function_data.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "codegen/emit/comment.hpp"
#include "codegen/emit/elementary.hpp"
#include "codegen/emit/layout.hpp"
#include "codegen/emit/numbers.hpp"

namespace alembert {

namespace mustache = kainjow::mustache;

namespace {

/// "M10 = 0, M11 = A", over several lines.
std::vector<std::string> note_lines(const std::vector<std::string>& notes) {
    std::vector<std::string> lines;
    for (const std::string& note : notes) {
        if (lines.empty() || lines.back().size() + note.size() > line_width) lines.emplace_back();
        lines.back() += (lines.back().empty() ? "" : ", ") + comment_text(note);
    }
    return lines;
}

/// "rate", "mass, forcing": the arrays that a function makes.
std::string made_by(const EmittedFunction& function) {
    std::string text;
    for (const GivenArray& array : function.gives) text += (text.empty() ? "" : ", ") + array.name;
    return text;
}

}  // namespace

mustache::data data_of(const EmittedFunction& function, const Dialect& dialect) {
    mustache::data sections{mustache::data::type::list};
    for (const Passage& passage : function.passages) {
        if (passage.statements.empty() && passage.notes.empty()) continue;
        std::vector<std::string> lines;
        for (const CodeStatement& statement : passage.statements) lines.push_back(dialect.wrapped(statement.text));
        mustache::data section;
        section.set("title", comment_text(passage.title));
        section.set("notes", list_of(note_lines(passage.notes)));
        section.set("lines", list_of(lines));
        sections << section;
    }
    mustache::data result;
    result.set("name", function.name);
    result.set("is_part", function.is_part);
    result.set("is_prepare", function.name == "prepare");
    result.set("about", comment_text(function.about));
    result.set("arguments", function.arguments);
    result.set("unpack", list_of(function.unpacked));
    result.set("ignored", list_of(function.ignored));
    result.set("sections", sections);
    return result;
}

void add_declarations(mustache::data& result, const EmittedFunction& function,
                      const std::map<std::string, std::size_t>& sizes) {
    mustache::data takes{mustache::data::type::list}, gives{mustache::data::type::list};
    for (const FunctionArgument& argument : function.takes) {
        mustache::data one;
        one.set("name", argument.name);
        one.set("is_array", argument.type != "const Real&");
        const auto size = sizes.find(argument.name);
        one.set("size", std::to_string(size == sizes.end() ? 0 : size->second));
        takes << one;
    }
    for (const GivenArray& array : function.gives) {
        mustache::data one;
        one.set("name", array.name);
        one.set("size", std::to_string(array.size));
        one.set("is_filled", array.is_filled);
        gives << one;
    }
    const std::string made = made_by(function);
    result.set("takes", takes);
    result.set("gives", gives);
    result.set("made", made);
    result.set("made_together", function.gives.size() > 1 ? "[" + made + "]" : made);
    std::vector<std::string> names;
    for (const std::string& name : function.names) {
        if (names.empty() || names.back().size() + name.size() > line_width) names.emplace_back();
        names.back() += (names.back().empty() ? "" : ", ") + name;
    }
    result.set("names", list_of(names));
    result.set("has_names", !names.empty());
}

void name_quantities(mustache::data& file, const Program& p, const Vocabulary& words, const EmitOptions& options) {
    const auto named = [](const std::vector<std::pair<std::string, std::string>>& items) {
        mustache::data list{mustache::data::type::list};
        for (std::size_t k = 0; k < items.size(); ++k) {
            mustache::data one;
            one.set("name", items[k].first);
            one.set("value", items[k].second);
            one.set("has_start", !items[k].second.empty());
            one.set("place", std::to_string(k + 1));
            one.set("comma", k + 1 < items.size() ? ", " : "");
            list << one;
        }
        return list;
    };
    std::vector<std::pair<std::string, std::string>> states, inputs;
    for (const auto* const names : {&words.q(), &words.u()})
        for (const std::string& name : *names)
            states.emplace_back(name, options.state.empty() ? "" : shortest(options.state[states.size()]));
    mustache::data parameters{mustache::data::type::list};
    for (std::size_t k = 0; k < words.par().size(); ++k) {
        mustache::data one;
        one.set("name", words.par()[k]);
        one.set("value", shortest(p.parameters[k].value));
        one.set("is_input", words.is_from_outside(k));
        one.set("comma", k + 1 < words.par().size() ? ", " : "");
        parameters << one;
        if (words.is_from_outside(k)) inputs.emplace_back(words.par()[k], "");
    }
    file.set("parameters", parameters);
    file.set("named_states", named(states));
    file.set("named_inputs", named(inputs));
    file.set("output_comment", fmt::format("{}", fmt::join(root_names(p, {Group::output, Group::speed}), ", ")));
}

}  // namespace alembert
