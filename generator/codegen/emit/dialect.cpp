// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/dialect.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/emit/layout.hpp"
#include "codegen/emit/reserved_words.hpp"
#include "codegen/emit/templates.hpp"

namespace alembert {

namespace {

using Renamed = std::pair<Op, std::string_view>;

constexpr Renamed python_functions[] = {{Op::asin, "arcsin"}, {Op::acos, "arccos"},   {Op::atan, "arctan"},
                                        {Op::pow, "power"},   {Op::atan2, "arctan2"}, {Op::min, "minimum"},
                                        {Op::max, "maximum"}};
// Where C gives no number, these throw in Julia and are complex in MATLAB.
constexpr Renamed julia_functions[] = {{Op::sqrt, "root_or_nan"}, {Op::log, "log_or_nan"},
                                       {Op::asin, "asin_or_nan"}, {Op::acos, "acos_or_nan"},
                                       {Op::pow, "pow_or_nan"},   {Op::atan2, "atan"}};
constexpr Renamed matlab_functions[] = {
    {Op::sqrt, "root_or_nan"}, {Op::log, "log_or_nan"}, {Op::asin, "asin_or_nan"}, {Op::acos, "acos_or_nan"},
    {Op::pow, "pow_or_nan"},   {Op::min, "smaller"},    {Op::max, "larger"}};

constexpr std::string_view pi_of_c = "Real(3.14159265358979323846264338327950288L)";

Dialect in_cpp() {
    return {.language = CodeLanguage::cpp,
            .option = "cpp",
            .name = "C++",
            .extension = "cpp",
            .comment = "//",
            .number = "Real({})",
            .has_decimals = false,
            .pi = pi_of_c,
            .declaring = "const Real {} = {};",
            .assigning = "{} = {};"};
}

Dialect in_c() {
    return {.language = CodeLanguage::c,
            .option = "c",
            .name = "C",
            .extension = "c",
            .comment = "",
            .number = "Real({})",
            .has_decimals = false,
            .pi = pi_of_c,
            .declaring = "const Real {} = {};",
            .assigning = "{} = {};"};
}

Dialect in_javascript() {
    return {.language = CodeLanguage::javascript,
            .option = "js",
            .name = "JavaScript",
            .extension = "mjs",
            .comment = "//",
            .number = "{}",
            .pi = "PI",
            .declaring = "const {} = {};",
            .assigning = "{} = {};"};
}

Dialect in_python() {
    return {
        .language = CodeLanguage::python,
        .option = "python",
        .name = "Python",
        .extension = "py",
        .comment = "#",
        .number = "{}",
        .has_points = true,
        .pi = "xp.pi",
        .declaring = "{} = {}",
        .assigning = "{} = {}",
        .unpacking = "{} = {}",
        .function = "xp.{}({}",
        .functions = python_functions,
        .results = ResultArrays::collected,
        .continuation = Continuation::brackets,
        .shape = template_solver_py,
        .notes = {"Python 3.8 or later with NumPy. All functions are pure: they change no argument and give new",
                  "arrays, so that JAX traces them (jit, vmap, grad): the arrays of the arguments say whose "
                  "functions are called.",
                  "An argument of shape (n, N) stands for N states at once; matrices are written row by row."},
        .tables = {.numbers = "{0} = numpy.array([{1}])\n",
                   .array = "xp.asarray({})",
                   .element = "{}[{}]",
                   .place = "table_place(xp, {}, {})",
                   .argument = "{}",
                   .separator = ", ",
                   .function = "def {0}({1}):\n    xp = namespace_of({1})\n{2}    return {3}\n",
                   .chosen = "xp.where({}, {}, {})",
                   .both = "({}) & ({})",
                   .floor = "xp.floor({})",
                   .no_number = "xp.nan"}};
}

Dialect in_julia() {
    return {
        .language = CodeLanguage::julia,
        .option = "julia",
        .name = "Julia",
        .extension = "jl",
        .comment = "#",
        .number = "{}",
        .pi = "pi",
        .declaring = "{} = {}",
        .assigning = "{} = {}",
        .first = 1,
        .unpacking = "{} = {}",
        .functions = julia_functions,
        .continuation = Continuation::brackets,
        .shape = template_solver_jl,
        .notes =
            {"Julia 1.5 or later; nothing but Base. Functions with ! fill their first arguments; rhs! takes its",
             "arguments as ODEProblem wants them. Numbers may be of any real type, duals too."},
        .tables = {.numbers = "const {0} = Float64[{1}]\n",
                   .array = "{}",
                   .element = "{}[{}]",
                   .place = "table_place({}, {})",
                   .argument = "{}",
                   .separator = ", ",
                   .function = "function {0}({1})\n{2}    return {3}\nend\n",
                   .chosen = "ifelse({}, {}, {})",
                   .both = "({}) & ({})",
                   .floor = "floor({})",
                   .no_number = "NaN"}};
}

Dialect in_matlab() {
    return {
        .language = CodeLanguage::matlab,
        .option = "matlab",
        .name = "MATLAB",
        .extension = "m",
        .comment = "%",
        .number = "{}",
        .pi = "pi",
        .declaring = "{} = {};",
        .assigning = "{} = {};",
        .placed = "{}({})",
        .first = 1,
        .functions = matlab_functions,
        .results = ResultArrays::outputs,
        .continuation = Continuation::dots,
        .longest_name = 55,
        .shape = template_solver_m,
        .notes = {"MATLAB, or Octave 7 or later; no toolbox. The function gives a struct of functions, names and",
                  "values; columns come out, rows or columns may go in."},
        .tables = {.numbers = "function list = {0}()\n    list = [{1}];\nend\n",
                   .array = "{}()",
                   .element = "{}({})",
                   .place = "table_place({}, {})",
                   .argument = "{}",
                   .separator = ", ",
                   .function = "function value = {0}({1})\n{2}    value = {3};\nend\n",
                   .chosen = "choose({}, {}, {})",
                   .both = "({}) && ({})",
                   .floor = "floor({})",
                   .no_number = "NaN"}};
}

Dialect in_rust() {
    return {
        .language = CodeLanguage::rust,
        .option = "rust",
        .name = "Rust",
        .extension = "rs",
        .comment = "//",
        .number = "R::of({})",
        .has_points = true,
        .pi = "R::of(3.141592653589793)",
        .declaring = "let {} = {};",
        .assigning = "{} = {};",
        .unpacking = "let ({}) = ({});",
        .shape = template_solver_rs,
        .notes =
            {"Rust 1.63 or later without std: only core, no allocation, no state. R is f64 or f32, or a type of",
             "your own with the trait Real; sine and its like are those of the library of C."},
        .tables = {.numbers = "static {0}: [f64; {2}] = [{1}];\n",
                   .array = "&{}",
                   .element = "R::of({}[{}])",
                   .place = "table_place({}, {}.to_f64())",
                   .argument = "{}: R",
                   .separator = ", ",
                   .function = "fn {0}<R: Real>({1}) -> R {{\n{2}    {3}\n}}\n",
                   .chosen = "if {} {{ {} }} else {{ {} }}",
                   .both = "({}) && ({})",
                   .floor = "({}).floor()",
                   .no_number = "R::of(f64::NAN)"}};
}

Dialect in_modelica() {
    return {.language = CodeLanguage::modelica,
            .option = "modelica",
            .name = "Modelica",
            .extension = "mo",
            .comment = "//",
            .number = "{}",
            .pi = "3.141592653589793",
            .declaring = "{} := {};",
            .assigning = "{} := {};",
            .first = 1,
            .results = ResultArrays::outputs,
            .shape = template_solver_mo,
            .notes =
                {"A package of Modelica 3 that needs no library: functions of arrays, and the model Motion, which",
                 "starts where the scene does and uses them."},
            .tables = {.numbers = "constant Real {0}[{2}] = {{{1}}};\n",
                       .array = {},
                       .element = "{}[{}]",
                       .place = "table_place({}, {})",
                       .argument = "    input Real {};\n",
                       .separator = "",
                       .function =
                           "function {0}\n{1}    output Real value;\nprotected\n    Real y1, u1, y2, u2, y;\n    "
                           "Integer k1, k2, cell;\nalgorithm\n{2}    value := {3};\nend {0};\n",
                       .chosen = "(if {} then {} else {})",
                       .both = "({}) and ({})",
                       .floor = "floor({})",
                       .no_number = {}}};
}

std::vector<Dialect> all_dialects() {
    std::vector<Dialect> all = {in_cpp(),   in_c(),      in_javascript(), in_python(),
                                in_julia(), in_matlab(), in_rust(),       in_modelica()};
    for (Dialect& row : all) row.words = reserved_in(row.language);
    for (std::size_t k = 0; k < all.size(); ++k)
        if (all[k].language != static_cast<CodeLanguage>(k))
            throw std::logic_error("rows of dialects are out of order");
    return all;
}

const std::vector<Dialect>& rows() {
    static const std::vector<Dialect> all = all_dialects();
    return all;
}

}  // namespace

std::span<const Dialect> dialects() {
    return rows();
}

const Dialect& dialect_of(CodeLanguage language) {
    return rows()[static_cast<std::size_t>(language)];
}

const Dialect* dialect_of(std::string_view option) {
    const auto found =
        std::find_if(rows().begin(), rows().end(), [&](const Dialect& row) { return row.option == option; });
    return found == rows().end() ? nullptr : &*found;
}

std::string Dialect::declared(const std::string& to, const std::string& value) const {
    return formed(declaring, to, value);
}

std::string Dialect::assigned(const std::string& to, const std::string& value) const {
    return formed(assigning, to, value);
}

std::string Dialect::place(const std::string& from, std::size_t k) const {
    return formed(placed, from, k + static_cast<std::size_t>(first));
}

std::string Dialect::call(Op op, const std::string& argument) const {
    const auto other =
        std::find_if(functions.begin(), functions.end(), [&](const Renamed& one) { return one.first == op; });
    return formed(function, other == functions.end() ? std::string_view(name_of(op)) : other->second, argument);
}

std::string Dialect::literal(const std::string& digits) const {
    const std::string text = formed(number, listed(digits));
    return number == "{}" && digits.starts_with('-') ? "(" + text + ")" : text;
}

std::string Dialect::listed(const std::string& digits) const {
    return has_points && digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
}

std::string Dialect::array(const std::string& from) const {
    return is_shaped() && std::find(words.begin(), words.end(), from) != words.end() ? from + "_" : from;
}

std::string Dialect::wrapped(const std::string& text) const {
    if (continuation == Continuation::as_it_is) return alembert::wrapped(text);
    std::string result;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string line = alembert::wrapped(text.substr(at, end - at));
        at = end + 1;
        if (continuation == Continuation::dots) {
            for (std::size_t k = line.find('\n'); k != std::string::npos; k = line.find('\n', k + 5))
                line.insert(k, " ...");
        } else if (line.find('\n') != std::string::npos) {
            const std::size_t value = line.find(" = ") + 3;
            line = line.substr(0, value) + "(" + line.substr(value) + ")";
        }
        result += (result.empty() ? "" : "\n    ") + line;
    }
    return result;
}

}  // namespace alembert
