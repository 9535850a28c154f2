// SPDX-License-Identifier: GPL-2.0-or-later
// Words that a value in emitted code must not be called, beside those of C and C++ (reserved_words.cpp), which no
// language uses: keywords, functions that cannot be covered, and names that the templates use inside functions.
#include "codegen/emit/reserved_words.hpp"

namespace alembert {

namespace {

// clang-format off
// Python 3.13, keywords and soft keywords.
constexpr std::string_view python[] = {
    "False", "None", "True", "as", "assert", "async", "await", "def", "del", "elif", "except", "finally", "from",
    "global", "in", "is", "lambda", "nonlocal", "pass", "raise", "with", "yield", "match", "type", "print", "numpy",
    "xp", "array_of", "namespace_of", "constants", "defaults", "parameter_values", "initial_state",
    "initial_time", "coordinate_names", "speed_names", "parameter_names", "output_names", "event_names",
    "input_names", "input_values", "columns", "parameter_rows", "parameter_columns"};

// Julia 1.11.
constexpr std::string_view julia[] = {
    "abstract", "baremodule", "begin", "elseif", "end", "function", "global", "in", "isa", "let", "local", "macro",
    "outer", "primitive", "quote", "type", "where", "Inf", "NaN", "eltype", "promote_type", "typeof", "zeros",
    "root_or_nan", "log_or_nan", "asin_or_nan", "acos_or_nan", "pow_or_nan", "defaults", "parameter_values",
    "initial_state", "initial_time", "include", "eval", "Main", "Base", "Core", "columns"};

// MATLAB R2024b and Octave 9.
constexpr std::string_view matlab[] = {
    "classdef", "elseif", "end", "function", "global", "otherwise", "parfor", "persistent", "spmd", "properties",
    "methods", "events", "enumeration", "arguments", "until", "unwind_protect", "unwind_protect_cleanup",
    "end_try_catch", "end_unwind_protect", "endclassdef", "endenumeration", "endevents", "endfor", "endfunction",
    "endif", "endmethods", "endparfor", "endproperties", "endspmd", "endswitch", "endwhile", "endarguments",
    "zeros", "numel", "ans", "nargin", "nargout", "varargin", "varargout", "root_or_nan", "log_or_nan",
    "asin_or_nan", "acos_or_nan", "pow_or_nan", "choose", "smaller", "larger", "defaults", "scene"};

// Rust 1.85, keywords of all editions; a pattern cannot have the name of a constant.
constexpr std::string_view rust[] = {
    "as", "async", "await", "abstract", "become", "box", "crate", "dyn", "fn", "gen", "impl", "in", "let", "loop",
    "macro", "match", "mod", "move", "mut", "priv", "pub", "ref", "self", "Self", "super", "trait", "type",
    "unsafe", "unsized", "use", "where", "yield", "R", "Some", "None", "Ok", "Err", "core", "f32", "f64", "defaults"};

// Modelica 3.6, section 2.3.3, and its built-in types, variables, operators and functions.
constexpr std::string_view modelica[] = {
    "algorithm", "annotation", "block", "connect", "connector", "constant", "constrainedby", "der", "discrete",
    "each", "elseif", "elsewhen", "encapsulated", "end", "enumeration", "equation", "expandable", "extends",
    "external", "flow", "function", "impure", "in", "initial", "inner", "input", "loop", "model", "outer",
    "output", "package", "parameter", "partial", "pure", "record", "redeclare", "replaceable", "stream", "then",
    "type", "when", "within", "time", "Boolean", "Integer", "String", "Clock", "StateSelect", "ExternalObject",
    "Modelica", "Connections", "AssertionLevel", "abs", "div", "mod", "rem", "integer", "delay", "cardinality",
    "homotopy", "semiLinear", "inStream", "actualStream", "spatialDistribution", "getInstanceName", "terminal",
    "smooth", "noEvent", "sample", "pre", "edge", "reinit", "terminate", "ndims", "size", "scalar", "vector",
    "matrix", "identity", "diagonal", "zeros", "ones", "fill", "linspace", "sum", "product", "transpose",
    "outerProduct", "symmetric", "cross", "skew", "cat", "array", "previous", "hold", "subSample", "superSample",
    "shiftSample", "backSample", "noClock", "firstTick", "interval", "activeState", "initialState",
    "ticksInState", "timeInState", "transition", "Motion", "defaults", "parameter_values", "initial_state",
    "initial_time"};
// clang-format on

}  // namespace

std::span<const std::string_view> reserved_in(CodeLanguage language) {
    switch (language) {
        case CodeLanguage::cpp:
        case CodeLanguage::c:
            break;
        case CodeLanguage::javascript:
            return javascript_words();
        case CodeLanguage::python:
            return python;
        case CodeLanguage::julia:
            return julia;
        case CodeLanguage::matlab:
            return matlab;
        case CodeLanguage::rust:
            return rust;
        case CodeLanguage::modelica:
            return modelica;
    }
    return {};
}

}  // namespace alembert
