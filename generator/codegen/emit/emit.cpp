// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/emit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <kainjow/mustache.hpp>
#include <limits>

#include "alembert/base/error.hpp"
#include "alembert/native/abi.hpp"
#include "alembert/native/fingerprint.hpp"
#include "codegen/emit/comment.hpp"
#include "codegen/emit/dialect.hpp"
#include "codegen/emit/elementary.hpp"
#include "codegen/emit/function_data.hpp"
#include "codegen/emit/head.hpp"
#include "codegen/emit/interface.hpp"
#include "codegen/emit/layout.hpp"
#include "codegen/emit/numbers.hpp"
#include "codegen/emit/solver_functions.hpp"
#include "codegen/emit/table_text.hpp"
#include "codegen/emit/templates.hpp"
#include "program/processor.hpp"

namespace alembert {

namespace {

namespace mustache = kainjow::mustache;

/// The task as a call of a function that has one more result, which is left.
EmittedFunction calling(const FunctionTask& task, const std::string& function, const std::string& left,
                        std::size_t size) {
    EmittedFunction result{.name = task.name, .about = task.about, .arguments = ""};
    for (const FunctionArgument& a : task.arguments)
        result.arguments += (result.arguments.empty() ? "" : ", ") + typed(CodeLanguage::c, a);
    result.passages = {{.title = "Together",
                        .statements = {{.text = fmt::format("Real {}[{}];", left, size)},
                                       {.text = fmt::format("{}(t, state, par, rate, lambda);", function)}}}};
    return result;
}

/// With one empty line where there are several: parts of a template may be left out.
std::string without_gaps(std::string text) {
    for (std::size_t at = text.find("\n\n\n"); at != std::string::npos; at = text.find("\n\n\n", at))
        text.erase(at, 1);
    return text;
}

/// No text of a scene has this sign in a file.
constexpr const char* place_of_fingerprint = "\x1a";

/// Writes at its places a fingerprint of both, in eight hexadecimal digits: enough against mistakes.
void put_fingerprint(std::string& source, std::string& header) {
    Fingerprint print;
    print.add(source);
    print.add(header);
    const std::string digits = print.hex().substr(0, 8);
    for (std::string* const text : {&source, &header}) {
        std::string whole;
        whole.reserve(text->size() + 2000);
        for (const char c : *text)
            if (c == *place_of_fingerprint)
                whole += digits;
            else
                whole += c;
        *text = std::move(whole);
    }
}

class SolverFile {
public:
    SolverFile(const Program& program, const EmitOptions& options)
        : p_(program),
          options_(options),
          words_(program, options.language),
          dialect_(dialect_of(options.language)) {
        // Such functions cannot be called for what they fill, and no compiler is slow with long ones.
        if (dialect_.results != ResultArrays::filled)
            options_.longest_function = std::numeric_limits<std::size_t>::max();
    }

    Source source() {
        const Operations cost = p_.count(p_.right_hand_side());
        add_functions();
        add_derivatives();
        add_named_functions();
        file_.set("functions", functions_);
        describe();
        add_counts();
        const std::set<Op> elementary = elementary_functions(p_);
        set_elementary(file_, elementary);
        file_.set("has_outside", std::any_of(elementary.begin(), elementary.end(), [](Op op) {
                      return op == Op::sqrt || op == Op::log || op == Op::asin || op == Op::acos || op == Op::pow;
                  }));
        file_.set("batch", options_.batch);
        file_.set("types", true);
        add_elementary(file_);
        const std::string tables = table_functions(p_, options_.language);
        file_.set("tables", dialect_.is_shaped()
                                ? tables.substr(tables.find_first_not_of('\n') == std::string::npos
                                                    ? 0
                                                    : tables.find_first_not_of('\n'))
                                : tables);
        file_.set("has_tables", !tables.empty());
        add_start();
        if (dialect_.is_shaped()) name_quantities(file_, p_, words_, options_);
        const std::string name = ascii_identifier(p_.name);
        const auto rendered = [&](std::string_view shape) {
            return mustache::mustache{std::string(shape)}.render(file_);
        };
        if (options_.language == CodeLanguage::c) name_members(file_, p_, words_, options_);
        if (options_.language == CodeLanguage::c)
            return {.file = name + ".c",
                    .text = rendered(template_solver_c),
                    .operations = cost,
                    .formulation = p_.formulation,
                    .header = SourceFile{name + ".h", without_gaps(rendered(template_solver_h))}};
        if (options_.language == CodeLanguage::javascript)
            return {.file = name + ".mjs",
                    .text = rendered(template_solver_js),
                    .operations = cost,
                    .formulation = p_.formulation};
        if (dialect_.is_shaped())
            return {.file = fmt::format("{}.{}", module_, dialect_.extension),
                    .text = without_gaps(rendered(dialect_.shape)),
                    .operations = cost,
                    .formulation = p_.formulation};
        describe_interface(file_, p_, words_, tasks_, options_);
        file_.set("header_head", commented(header_head_of(p_, words_, options_), options_.language));
        file_.set("fingerprint", place_of_fingerprint);
        Source source{.file = name + ".cpp",
                      .text = without_gaps(rendered(template_solver)),
                      .operations = cost,
                      .formulation = p_.formulation,
                      .header = SourceFile{name + ".hpp", without_gaps(rendered(template_solver_hpp))}};
        put_fingerprint(source.text, source.header->text);
        return source;
    }

private:
    /// The task of a function that takes inputs from outside, behind the parameters.
    FunctionTask with_inputs(FunctionTask task) const {
        const auto par = std::find_if(task.arguments.begin(), task.arguments.end(),
                                      [](const FunctionArgument& a) { return a.name == "par"; });
        if (words_.inputs_from_outside() > 0 && par != task.arguments.end())
            task.arguments.insert(par + 1, {"const Real*", "inputs"});
        return task;
    }

    mustache::data shown(const EmittedFunction& function) const {
        mustache::data result = data_of(function, dialect_);
        if (!dialect_.is_shaped()) return result;
        const std::size_t own = words_.par().size(), states = words_.q().size() + words_.u().size();
        add_declarations(result, function,
                         {{"state", states},
                          {"rate", states},
                          {"par", own + words_.constants().size()},
                          {"inputs", static_cast<std::size_t>(words_.inputs_from_outside())}});
        return result;
    }

    /// A function without statements is not written; `has_name` tells the tables whether a function exists.
    void add(const std::vector<EmittedFunction>& list, const std::string& name) {
        for (const EmittedFunction& function : list) functions_ << shown(function);
        file_.set("has_" + name, !list.empty());
    }
    void add(const FunctionTask& plain) {
        const FunctionTask task = with_inputs(plain);
        const std::vector<EmittedFunction> list = written(p_, words_, task, options_);
        add(list, task.name);
        if (!list.empty()) tasks_.push_back(task);
    }

    void add_functions() {
        const std::vector<EmittedFunction> constants = prepare(p_, words_, options_.language);
        add(constants, "prepare");
        if (!constants.empty())
            tasks_.push_back({.name = "prepare",
                              .about = constants.back().about,
                              .arguments = {{"Real*", "par"}},
                              .goals = {},
                              .results = {}});
        const FunctionTask rates = right_hand_side(p_, words_), multipliers = multipliers_at(p_);
        const bool together = options_.shares_multipliers && is_shared(rates, multipliers);
        if (together)
            add_together(rates, multipliers);
        else
            add(rates);
        for (const FunctionTask& task :
             {mass_forcing(p_), energy(p_), outputs_at(p_), events_at(p_), constraints_at(p_)})
            add(task);
        if (!together) add(multipliers);
        add(impulses_at(p_));
        add(project(p_));
        add(gamma_at(p_));
        file_.set("has_projection", has_projection(p_));
        file_.set("about_mass_forcing", mass_forcing(p_).about);
    }

    /// Whether rates are long, and multipliers are found on the way to them.
    bool is_shared(const FunctionTask& rates, const FunctionTask& multipliers) const {
        std::vector<int> nodes;
        for (const FunctionResult& result : rates.results) nodes.push_back(result.node);
        const int alone = p_.count(nodes).total();
        for (const FunctionResult& result : multipliers.results) nodes.push_back(result.node);
        return !multipliers.results.empty() && alone > static_cast<int>(options_.longest_function) &&
               p_.count(nodes).total() <= alone + static_cast<int>(multipliers.results.size());
    }

    /// One function for both results, and two that call it.
    void add_together(const FunctionTask& rates, const FunctionTask& multipliers) {
        FunctionTask both = rates;
        both.name = "rates_and_multipliers";
        both.arguments.push_back(multipliers.arguments.back());
        both.goals.insert(both.goals.end(), multipliers.goals.begin(), multipliers.goals.end());
        both.results.insert(both.results.end(), multipliers.results.begin(), multipliers.results.end());
        std::vector<EmittedFunction> list = written(p_, words_, both, options_);
        list.back().is_part = true;
        for (const EmittedFunction& function : list) functions_ << shown(function);
        add({calling(rates, both.name, multipliers.arguments.back().name, multipliers.results.size())},
            rates.name);
        add({calling(multipliers, both.name, rates.arguments.back().name,
                     rates.results.size() + rates.copies.size())},
            multipliers.name);
    }

    void add_derivatives() {
        const std::vector<int> nodes = p_.nodes_of(Group::jacobian);
        const SparseTask by_state = jacobian(p_), by_parameters = parameter_jacobian(p_);
        for (const SparseTask* part : {&by_state, &by_parameters}) add(part->task);
        add(tangent(p_));
        add(jacobian_tangent(options_.jacobian_tangent));
        file_.set("has_derivatives", !nodes.empty());
        file_.set("has_parameter_derivatives", !p_.nodes_of(Group::parameter_jacobian).empty());
        list("rows", wrapped_list(places(by_state.rows)));
        list("columns", wrapped_list(places(by_state.columns)));
        list("parameter_rows", wrapped_list(places(by_parameters.rows)));
        list("parameter_columns", wrapped_list(places(by_parameters.columns)));
        number("entries", by_state.rows.size());
        number("parameter_entries", by_parameters.rows.size());
        number("derivative_operations", static_cast<std::size_t>(p_.count(nodes).total()));
    }

    void add_named_functions() {
        mustache::data list{mustache::data::type::list};
        for (const NamedFunction& function : options_.functions) {
            const FunctionTask task = with_inputs(named_function(p_, function));
            tasks_.push_back(task);
            for (const EmittedFunction& part : written(p_, words_, task, options_)) functions_ << shown(part);
            mustache::data entry;
            entry.set("name", function.name);
            entry.set("about", comment_text(task.about));
            entry.set("rows", std::to_string(function.rows));
            entry.set("columns", std::to_string(function.columns));
            entry.set("operations", std::to_string(function.operations.total()));
            list << entry;
        }
        file_.set("named_functions", list);
        file_.set("has_named_functions", !options_.functions.empty());
    }

    void describe() {
        module_ = Names(options_.language).fresh(p_.name);
        file_.set("scene", dialect_.is_shaped() ? module_ : ascii_identifier(p_.name));
        file_.set("formulation", p_.formulation);
        file_.set("version", ALEMBERT_VERSION);
        file_.set("head", commented(head_of(p_, words_, options_), options_.language));
        file_.set("has_speeds", !p_.speeds.empty());
        counted_list("speed_names", labels_of(words_.u()));
        counted_list("coordinate_names", labels_of(words_.q()));
        list("parameter_names", quoted(labels_of(words_.par())));
        describe_inputs();
        counted_list("output_names", root_names(p_, {Group::output, Group::speed}));
        counted_list("event_names", root_names(p_, {Group::event}));
        std::vector<double> values;
        for (const Quantity& par : p_.parameters) values.push_back(par.value);
        std::string of_c;  // whose numbers may be floats
        for (const double value : values) of_c += fmt::format("Real({}), ", shortest(value));
        list("parameter_values", options_.language == CodeLanguage::c ? of_c : listed(values));
    }

    /// The array of inputs from outside, whose values in the scene stand among the parameters.
    void describe_inputs() {
        const int count = words_.inputs_from_outside(), first = words_.first_input();
        std::vector<std::string> own, inputs;
        std::vector<double> values;
        for (std::size_t k = 0; k < words_.par().size(); ++k) {
            (words_.is_from_outside(k) ? inputs : own).push_back(words_.par()[k]);
            if (words_.is_from_outside(k)) values.push_back(p_.parameters[k].value);
        }
        file_.set("has_inputs", count > 0);
        number("inputs", inputs.size());
        number("first_input", static_cast<std::size_t>(first));
        number("own_p", own.size());
        counted_list("own_parameter_names", labels_of(own));
        counted_list("input_names", labels_of(inputs));
        list("input_values", listed(values));
        file_.set("par", count > 0 ? fmt::format("par, par + {}", first) : "par");
        file_.set("par_in_packs", count > 0 ? fmt::format("packs(par + at), packs(par + {} * systems + at)", first)
                                            : "packs(par + at)");
        file_.set("par_of_lane", count > 0 ? fmt::format("p, p + {}", first) : "p");
        file_.set("given", count > 0 ? " const ALEMBERT_REAL *inputs," : "");
    }

    /// What the templates of JavaScript and the further languages need beside the others.
    void add_start() {
        std::string library;
        const auto add = [&](const std::string& name) { library += (library.empty() ? "" : ", ") + name; };
        for (const Op op : elementary_functions(p_))
            if (op != Op::unspecified) add(name_of(op));
        if (uses_pi()) add("PI");
        std::vector<std::string> of_one;
        for (const Op op : elementary_functions(p_))
            if (op <= Op::abs || op == Op::sqrt) of_one.emplace_back(name_of(op));
        file_.set("one_argument", list_of(of_one));
        file_.set("has_math", !library.empty());
        file_.set("math", library);
        file_.set("initial_time", dialect_.listed(shortest(options_.t)));
        list("initial_state", listed(options_.state));
        file_.set("example_time", options_.state.empty() ? dialect_.listed("0") : "");
        number("states", words_.q().size() + words_.u().size());
        number("initial_states", options_.state.size());
        number("constants", words_.constants().size());
        number("length", words_.par().size() + words_.constants().size());
    }

    bool uses_pi() const {
        std::vector<int> roots;
        for (const Root& root : p_.roots) roots.push_back(root.node);
        const std::vector<int> needed = p_.needed(roots);
        return std::any_of(needed.begin(), needed.end(), [&](int node) { return p_[node].op == Op::pi; });
    }

    void add_counts() {
        const auto count = [&](Group group) { return p_.nodes_of(group).size(); };
        number("abi", abi_version);
        number("n", words_.q().size());
        number("s", words_.u().size());
        number("p", words_.par().size());
        number("k", words_.constants().size());
        number("outputs", count(Group::output) + count(Group::speed));
        number("events", count(Group::event));
        number("constraints", constraints_of(p_));
        number("independent", count(Group::velocity));
        file_.set("has_redundant", count(Group::velocity) < constraints_of(p_));
        std::vector<int> dynamics = p_.nodes_of(Group::mass);
        const std::vector<int> forcing = p_.nodes_of(Group::forcing);
        const bool has_matrix = !dynamics.empty();
        dynamics.insert(dynamics.end(), forcing.begin(), forcing.end());
        const bool one_by_one = p_.count(dynamics).total() > processor::most_in_packs;
        file_.set("one_by_one", one_by_one);
        file_.set("together", has_matrix && !one_by_one);
    }

    /// Places in arrays, counted from that which is first in the language.
    std::vector<std::string> places(const std::vector<int>& numbers) const {
        std::vector<std::string> result;
        for (const int number : numbers) result.push_back(std::to_string(number + dialect_.first));
        return result;
    }

    /// "a, b, "; in languages other than C and C++ "a, b".
    void list(const std::string& key, std::string items) {
        if (options_.language >= CodeLanguage::javascript)
            while (!items.empty() && (items.back() == ' ' || items.back() == ',')) items.pop_back();
        if (dialect_.language == CodeLanguage::matlab) {
            std::replace(items.begin(), items.end(), '"', '\'');
            for (std::size_t at = items.find('\n'); at != std::string::npos; at = items.find('\n', at + 5))
                items.insert(at, " ...");
        }
        file_.set(key, items);
        file_.set("any_" + key, !items.empty());
    }
    /// "1, 2.5, ": in Rust "1.0, 2.5".
    std::string listed(const std::vector<double>& values) const {
        std::vector<std::string> items;
        for (const double value : values) items.push_back(dialect_.listed(shortest(value)));
        if (dialect_.is_shaped()) return wrapped_list(items);
        return items.empty() ? "" : fmt::format("{}, ", fmt::join(items, ", "));
    }
    void number(const char* key, std::size_t value) { file_.set(key, std::to_string(value)); }
    /// How many items a list has, for languages that declare it.
    void counted_list(const std::string& key, const std::vector<std::string>& names) {
        list(key, quoted(names));
        file_.set("count_of_" + key, std::to_string(names.size()));
    }

    const Program& p_;
    EmitOptions options_;
    Vocabulary words_;
    const Dialect& dialect_;
    std::string module_;  ///< what the module, package or function of the whole file is called
    mustache::data file_;
    mustache::data functions_{mustache::data::type::list};
    std::vector<FunctionTask> tasks_;  ///< that have a function of their own in the file
};

}  // namespace

Source emit(const Program& program, const EmitOptions& options) {
    if (program.singular)
        throw ModelError("the mass matrix is singular at every state: there are no accelerations to emit");
    if (options.batch && options.language != CodeLanguage::cpp)
        throw ModelError("functions over eight systems at once are written in C++ alone");
    if (options.shares_multipliers && options.language != CodeLanguage::c)
        throw ModelError("rates and multipliers are written together in C alone");
    return SolverFile(program, options).source();
}

}  // namespace alembert
