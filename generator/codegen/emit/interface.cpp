// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/interface.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alembert/native/abi.hpp"
#include "codegen/emit/comment.hpp"
#include "codegen/emit/layout.hpp"
#include "codegen/emit/numbers.hpp"
#include "codegen/emit/reserved_words.hpp"
#include "codegen/emit/solver_functions.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

namespace {

namespace mustache = kainjow::mustache;

/// The table that has the function, from which it is called: so there is one instance of each, which is inline
/// there.
std::string call_of(const std::string& name, bool has_inputs, std::size_t& named) {
    if (has_inputs && name != "prepare") return name;  // those of the tables take inputs among the parameters
    for (const char* const of_table : {"prepare", "rhs", "mass_forcing", "energy", "outputs_at", "events_at",
                                       "constraints_at", "multipliers_at"})
        if (name == of_table) return "table." + name;
    if (name == "project" || name == "gamma_at") return "projection." + name;
    if (name == "jacobian" || name == "parameter_jacobian") return "derivatives." + name;
    if (name == "tangent" || name == "impulses_at") return name;
    return fmt::format("named_functions[{}].call", named++);
}

mustache::data export_of(const FunctionTask& task, bool has_inputs, std::size_t& named) {
    std::string arguments, names;
    for (const FunctionArgument& a : task.arguments) {
        arguments += (arguments.empty() ? "" : ", ") + typed(CodeLanguage::c, a, "double");
        names += (names.empty() ? "" : ", ") + a.name;
    }
    mustache::data result;
    result.set("name", task.name);
    result.set("call", call_of(task.name, has_inputs, named));
    result.set("about", comment_text(task.about));
    result.set("arguments", arguments);
    result.set("names", names);
    return result;
}

/// A member of a struct: its name, its value as given, and what it is.
struct Member {
    std::string name;
    double value = 0;
    std::string about = {}, given = {};
};

std::string comment(const char* before, const std::string& text) {
    return text.empty() ? "" : before + comment_text(text);
}

mustache::data members_of(const std::vector<Member>& members) {
    mustache::data list{mustache::data::type::list};
    for (const Member& member : members) {
        mustache::data one;
        one.set("name", member.name);
        one.set("value", shortest(member.value));
        one.set("about", comment("  ///< ", member.about));
        one.set("given", comment(", ", member.given));
        list << one;
    }
    return list;
}

class Interface {
public:
    Interface(mustache::data& file, const Program& program, const Vocabulary& words, const EmitOptions& options)
        : file_(file), p_(program), words_(words), options_(options) {}

    void functions(const std::vector<FunctionTask>& tasks) {
        mustache::data exports{mustache::data::type::list};
        std::vector<std::string> visible{"parameter_values", "coordinate_names", "speed_names", "parameter_names",
                                         "output_names",     "event_names",      "table"};
        std::size_t named = 0;
        for (const FunctionTask& task : tasks) {
            exports << export_of(task, words_.inputs_from_outside() > 0, named);
            visible.push_back(task.name);
        }
        if (options_.batch)
            for (const char* const name : {"pack", "systems", "packs", "for_each_pack", "pack_table"})
                visible.emplace_back(name);
        file_.set("exports", exports);
        mustache::data names{mustache::data::type::list};
        for (const std::string& name : visible) names << name;
        file_.set("visible", names);
    }

    /// What a module exports (lib/alembert/native/module.cpp).
    void entries() {
        mustache::data list{mustache::data::type::list};
        const auto add = [&](const char* type, const char* name, const char* member) {
            mustache::data one;
            one.set("type", type);
            one.set("name", name);
            one.set("member", member);
            list << one;
        };
        const char* const pointer = "const void*";
        add(pointer, module_entries.solver, "solver");
        if (options_.batch) add(pointer, module_entries.pack, "pack");
        if (has_projection(p_)) add(pointer, module_entries.projection, "projection");
        if (p_.nodes_of(Group::velocity).size() < constraints_of(p_))
            add("int", module_entries.independent_constraints, "independent_constraints");
        if (!p_.nodes_of(Group::jacobian).empty()) add(pointer, module_entries.derivatives, "derivatives");
        if (!options_.functions.empty()) add(pointer, module_entries.functions, "functions");
        file_.set("module_entries", list);
    }

    void structs() {
        state();
        parameters();
        values("output_members", {Group::output, Group::speed});
        values("event_members", {Group::event});
        const auto count = [&](Group group) {
            return std::to_string(std::max<std::size_t>(p_.nodes_of(group).size(), 1));
        };
        file_.set("position_count", count(Group::position));
        file_.set("pivot_count", count(Group::pivot));
    }

private:
    /// "[rad] slope"; with `given`, "[rad] 40 deg, slope".
    std::string about(const Quantity& quantity, bool with_given) const {
        std::string text = in_brackets(quantity.unit);
        const SceneNote note = note_of(quantity.name);
        const auto add = [&](const std::string& part, const char* before) {
            if (!part.empty()) text += (text.empty() ? "" : before) + part;
        };
        if (with_given) add(note.given, " ");
        add(note.about, with_given && !note.given.empty() ? ", " : " ");
        return text;
    }

    SceneNote note_of(const std::string& name) const {
        const auto note = options_.notes.find(name);
        return note == options_.notes.end() ? SceneNote{} : note->second;
    }

    void state() {
        const std::vector<double>& initial = options_.initial.empty() ? options_.state : options_.initial;
        std::vector<Member> members;
        const auto add = [&](const std::string& name, const std::string& text, const std::string& given) {
            const std::size_t k = members.size();
            members.push_back({name, k < initial.size() ? initial[k] : 0, text, given});
        };
        const auto add_own = [&](const std::string& name, const Quantity& quantity) {
            add(name, about(quantity, false), note_of(quantity.name).given);
        };
        for (std::size_t i = 0; i < words_.q().size(); ++i) add_own(words_.q()[i], p_.coordinates[i]);
        for (std::size_t k = 0; k < words_.u().size(); ++k)
            if (p_.speeds.empty())
                add(words_.u()[k], in_brackets(per_second(p_.coordinates[k].unit)), "");
            else
                add_own(words_.u()[k], p_.speeds[k]);
        set_members("state_members", members);
        file_.set("has_initial", !initial.empty());
        file_.set("initial_time", shortest(options_.t));
    }

    static std::string in_brackets(const std::string& unit) { return unit.empty() ? "" : "[" + unit + "]"; }

    void parameters() {
        std::vector<Member> members, inputs;
        for (std::size_t k = 0; k < words_.par().size(); ++k)
            (words_.is_from_outside(k) ? inputs : members)
                .push_back({words_.par()[k], p_.parameters[k].value, about(p_.parameters[k], true)});
        set_members("parameter_members", members);
        set_members("input_members", inputs);
        file_.set("has_no_par", members.empty() && inputs.empty() && words_.constants().empty());
        Names names = words_.names();
        file_.set("constants_member", names.fresh("prepared"));
        file_.set("inputs_member", names.fresh("unread"));
    }

    void values(const char* key, std::initializer_list<Group> groups) {
        Names names;
        std::vector<Member> members;
        for (const std::string& name : root_names(p_, groups)) members.push_back({names.fresh(name)});
        set_members(key, members);
    }

    void set_members(const std::string& key, const std::vector<Member>& members) {
        file_.set(key, members_of(members));
        file_.set("has_" + key, !members.empty());
    }

    mustache::data& file_;
    const Program& p_;
    const Vocabulary& words_;
    const EmitOptions& options_;
};

}  // namespace

std::string namespace_of(const Program& program) {
    std::string name = Names().fresh(program.name);
    // The runtime is in the namespace alembert, and a module exports alembert_solver and others.
    if (is_global_in_c(name) || name.starts_with("alembert")) name += '_';
    return name;
}

void name_members(mustache::data& file, const Program& program, const Vocabulary& words,
                  const EmitOptions& options) {
    Interface(file, program, words, options).structs();
}

void describe_interface(mustache::data& file, const Program& program, const Vocabulary& words,
                        const std::vector<FunctionTask>& functions, const EmitOptions& options) {
    Interface interface(file, program, words, options);
    interface.functions(functions);
    interface.entries();
    interface.structs();
    file.set("space", namespace_of(program));
}

}  // namespace alembert
