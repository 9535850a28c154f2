// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the languages of emitted code write each in its own way: one row for each (dialect.cpp), beside its
/// template.
///
///     const Dialect& rust = dialect_of(CodeLanguage::rust);
///     rust.declared("z1", "m * sin_theta");   // "let z1 = m * sin_theta;"
///     rust.place("state", 0);                 // "state[0]", which in Julia is "state[1]"
///     dialect_of("julia")->extension;         // "jl"
///
/// Expressions are the same in all of them but for numbers, names of functions and places in arrays.

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "codegen/emit/statement.hpp"
#include "program/program.hpp"

namespace alembert {

/// How a function gives its arrays: it fills those of its caller, it assigns to outputs that the language makes,
/// or it collects new ones from their values, changing none.
enum class ResultArrays { filled, outputs, collected };

/// How a statement goes on in the next line: as it is, in brackets around its value, or after three dots.
enum class Continuation { as_it_is, brackets, dots };

/// Functions by points where a value is chosen, not branched to (chosen_tables.cpp).
struct DialectTables {
    std::string_view numbers;    ///< a list: its name, its numbers, how many they are
    std::string_view array;      ///< the list inside a function; none where its name serves
    std::string_view element;    ///< one of its numbers
    std::string_view place;      ///< the piece, counted from 0, of a list in which a number lies
    std::string_view argument;   ///< of a function
    std::string_view separator;  ///< between two
    std::string_view function;   ///< its name, its arguments, its statements, its value
    std::string_view chosen;     ///< of a condition and two values
    std::string_view both;       ///< conditions
    std::string_view floor;
    std::string_view no_number;
};

/// A shape of this table with texts in its places.
template <typename... Texts>
std::string formed(std::string_view shape, const Texts&... texts) {
    return fmt::format(fmt::runtime(shape), texts...);
}

struct Dialect {
    CodeLanguage language;
    std::string_view option, name, extension;  ///< "js", "JavaScript", "mjs"
    std::string_view comment;                  ///< begins a line of comment; C has its own shape
    std::string_view number;                   ///< "Real({})"
    bool has_decimals = true;  ///< whether decimals are written as such, not as quotients of whole numbers
    bool has_points = false;   ///< whether whole numbers are written with a point
    std::string_view pi;
    std::string_view declaring, assigning;  ///< "const {} = {};", "{} = {};"
    std::string_view placed = "{}[{}]";
    int first = 0;                        ///< the number of the first place of an array
    std::string_view unpacking = {};      ///< several names from as many places; none: one after the other
    std::string_view function = "{}({}";  ///< a call, up to its closing bracket
    std::span<const std::pair<Op, std::string_view>> functions = {};  ///< those of another name
    ResultArrays results = ResultArrays::filled;
    Continuation continuation = Continuation::as_it_is;
    std::size_t longest_name = std::string::npos;
    std::span<const std::string_view> words = {};  ///< reserved, beside those of reserved_words.hpp
    std::string_view shape = {};                   ///< the template; none where emit.cpp has it
    std::vector<std::string> notes = {};           ///< lines for the head of a file
    DialectTables tables = {};

    std::string declared(const std::string& name, const std::string& value) const;
    std::string assigned(const std::string& to, const std::string& value) const;
    std::string place(const std::string& array, std::size_t k) const;
    /// "sin(x", without the closing bracket.
    std::string call(Op op, const std::string& argument) const;
    /// A number with these digits, in code, and in a list of numbers.
    std::string literal(const std::string& digits) const;
    std::string listed(const std::string& digits) const;
    /// The name, with a `_` behind it where it is reserved: "lambda_".
    std::string array(const std::string& name) const;
    /// A line that is too long goes on in further ones.
    std::string wrapped(const std::string& text) const;
    bool is_shaped() const { return !shape.empty(); }
};

const Dialect& dialect_of(CodeLanguage language);
/// None if there is no such --language.
const Dialect* dialect_of(std::string_view option);
std::span<const Dialect> dialects();

}  // namespace alembert
