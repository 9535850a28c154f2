// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/casadi.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "codegen/emit/comment.hpp"
#include "codegen/emit/solver_functions.hpp"
#include "codegen/emit/templates.hpp"
#include "codegen/emit/vocabulary.hpp"
#include "program/tangent.hpp"

namespace alembert {

namespace {

namespace mustache = kainjow::mustache;

/// An argument or a result of a function for CasADi.
struct CasadiMatrix {
    std::string name;
    std::size_t rows, columns = 1;
};

/// Compressed columns of a matrix without structural zeros: its size, the beginning of each column, and the row of
/// each entry.
std::string pattern_of(const CasadiMatrix& matrix) {
    std::string text = fmt::format("{}, {}", matrix.rows, matrix.columns);
    for (std::size_t column = 0; column <= matrix.columns; ++column)
        text += fmt::format(", {}", column * matrix.rows);
    for (std::size_t k = 0; k < matrix.rows * matrix.columns; ++k) text += fmt::format(", {}", k % matrix.rows);
    return text;
}

mustache::data list_of_matrices(const std::vector<CasadiMatrix>& matrices) {
    mustache::data list{mustache::data::type::list};
    for (const CasadiMatrix& matrix : matrices) {
        mustache::data entry;
        entry.set("name", matrix.name);
        entry.set("pattern", pattern_of(matrix));
        list << entry;
    }
    return list;
}

mustache::data function_of(const std::string& symbol, const char* kind, const std::vector<CasadiMatrix>& arguments,
                           const std::vector<CasadiMatrix>& results) {
    mustache::data f;
    f.set("symbol", symbol);
    f.set(kind, true);
    f.set("arguments", list_of_matrices(arguments));
    f.set("results", list_of_matrices(results));
    f.set("n_in", std::to_string(arguments.size()));
    f.set("n_out", std::to_string(results.size()));
    return f;
}

std::vector<CasadiMatrix> with_prefix(const std::string& prefix, std::vector<CasadiMatrix> matrices) {
    for (CasadiMatrix& matrix : matrices) matrix.name = prefix + matrix.name;
    return matrices;
}

std::vector<CasadiMatrix> together(std::vector<CasadiMatrix> first, const std::vector<CasadiMatrix>& second,
                                   const std::vector<CasadiMatrix>& third) {
    first.insert(first.end(), second.begin(), second.end());
    first.insert(first.end(), third.begin(), third.end());
    return first;
}

bool depends_on_time(const Program& p) {
    const std::vector<int> nodes = p.right_hand_side();
    const unsigned time = 1U << static_cast<unsigned>(Variable::Kind::time);
    return std::any_of(nodes.begin(), nodes.end(), [&](int node) { return (p[node].depends & time) != 0; });
}

}  // namespace

std::vector<int> casadi_second_derivatives(Program& program) {
    std::vector<int> entries;
    for (const SparseTask& part : {jacobian(program), parameter_jacobian(program)})
        for (const FunctionResult& result : part.task.results) entries.push_back(result.node);
    const std::vector<int> nodes = along_direction(program, entries);
    for (const int node : nodes) program.roots.push_back({Group::function, "D", node});
    return nodes;
}

SourceFile casadi_functions(const Program& p, const EmitOptions& options) {
    if (options.language != CodeLanguage::c)
        throw ModelError(say("functions for CasADi are in C; expected --language c with --casadi"));
    const Vocabulary words(p);
    const std::string scene = ascii_identifier(p.name);
    const std::size_t n = words.q().size(), size = n + words.u().size();
    const std::vector<CasadiMatrix> point = {{"t", 1}, {"x", size}, {"p", words.par().size()}},
                                    rate = {{"rate", size}};
    mustache::data functions{mustache::data::type::list};
    functions << function_of("casadi_" + scene + "_rhs", "is_rhs", point, rate);
    const bool has_derivatives = !jacobian(p).task.results.empty();
    if (has_derivatives) {
        const std::vector<CasadiMatrix> known = with_prefix("out_", rate);
        functions << function_of("fwd1_casadi_" + scene + "_rhs", "is_forward",
                                 together(point, known, with_prefix("fwd_", point)), with_prefix("fwd_", rate));
        functions << function_of("adj1_casadi_" + scene + "_rhs", "is_adjoint",
                                 together(point, known, with_prefix("adj_", rate)), with_prefix("adj_", point));
    }
    if (has_derivatives && !options.jacobian_tangent.empty()) {
        const std::vector<CasadiMatrix> given =
                                            together(point, with_prefix("out_", rate), with_prefix("adj_", rate)),
                                        adjoint = with_prefix("adj_", point);
        functions << function_of("fwd1_adj1_casadi_" + scene + "_rhs", "is_second",
                                 together(given, with_prefix("out_", adjoint), with_prefix("fwd_", given)),
                                 with_prefix("fwd_", adjoint));
    }
    for (const NamedFunction& function : options.functions) {
        const auto rows = static_cast<std::size_t>(function.rows),
                   columns = static_cast<std::size_t>(function.columns);
        mustache::data f = function_of("casadi_" + scene + "_" + function.name, "is_named",
                                       together({{"t", 1}, {"x", size}, {"a", n}}, {point[2]}, {}),
                                       {{function.name, rows, columns}});
        f.set("function", scene + "_" + function.name);
        f.set("rows", std::to_string(rows));
        f.set("columns", std::to_string(columns));
        functions << f;
    }
    mustache::data file;
    file.set("scene", scene);
    file.set("version", ALEMBERT_VERSION);
    file.set("command", comment_text(options.command));
    file.set("functions", functions);
    file.set("has_named", !options.functions.empty());
    file.set("has_time_derivative", has_derivatives && depends_on_time(p));
    file.set("has_parameter_jacobian", !parameter_jacobian(p).task.results.empty());
    return {scene + "_casadi.c", mustache::mustache{std::string(template_casadi)}.render(file)};
}

}  // namespace alembert
