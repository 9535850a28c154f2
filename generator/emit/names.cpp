// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/names.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstdint>
#include <string_view>

namespace alembert {

namespace {

constexpr std::array keywords{
    "alignas",     "alignof",   "and",        "and_eq",    "asm",      "auto",         "bitand",
    "bitor",       "bool",      "break",      "case",      "catch",    "char",         "char8_t",
    "char16_t",    "char32_t",  "class",      "compl",     "concept",  "const",        "consteval",
    "constexpr",   "constinit", "const_cast", "continue",  "co_await", "co_return",    "co_yield",
    "decltype",    "default",   "delete",     "do",        "double",   "dynamic_cast", "else",
    "enum",        "explicit",  "export",     "extern",    "false",    "float",        "for",
    "friend",      "goto",      "if",         "inline",    "int",      "long",         "mutable",
    "namespace",   "new",       "noexcept",   "not",       "not_eq",   "nullptr",      "operator",
    "or",          "or_eq",     "private",    "protected", "public",   "register",     "reinterpret_cast",
    "requires",    "return",    "short",      "signed",    "sizeof",   "static",       "static_assert",
    "static_cast", "struct",    "switch",     "template",  "this",     "thread_local", "throw",
    "true",        "try",       "typedef",    "typeid",    "typename", "union",        "unsigned",
    "using",       "virtual",   "void",       "volatile",  "wchar_t",  "while",        "xor",
    "xor_eq",      "typeof",    "linux",      "unix",      "i386",     "final",        "override",
    "import",      "module"};

// What templates/solver.cpp.mustache declares.
// clang-format off
constexpr std::array own{
    "Real", "t", "state", "par", "rate", "mass", "forcing", "carried", "out", "energy", "jacobi", "prepare", "rhs",
    "pair", "sincos", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log", "sqrt",
    "abs", "sign", "pow", "atan2", "min", "max", "pi", "std", "main", "mass_forcing", "outputs_at", "events_at",
    "constraints_at", "multipliers_at", "position", "velocity", "rows", "pivots", "project", "gamma_at", "lambda",
    "table", "solver", "real2", "real4", "real8", "bits2", "bits4", "bits8", "sines", "sine", "cosine", "is_near",
    "sines_near", "sines_far", "sincos_in", "restrict", "fabs"};
// clang-format on

constexpr std::array<std::string_view, 25> greek{
    "alpha", "beta",   "gamma",   "delta", "epsilon", "zeta",    "eta",  "theta", "iota",
    "kappa", "lambda", "mu",      "nu",    "xi",      "omicron", "pi",   "rho",   "sigma",
    "sigma", "tau",    "upsilon", "phi",   "chi",     "psi",     "omega"};

std::string spelled(std::uint32_t code) {
    if (code >= 0x3b1 && code <= 0x3c9) return std::string(greek[code - 0x3b1]);
    if (code >= 0x391 && code <= 0x3a9) {
        std::string name(greek[code - 0x391]);
        name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
        return name;
    }
    if (code == 0x3d5) return "phi";
    if (code == 0x3d1) return "theta";
    if (code == 0x3f5) return "epsilon";
    return fmt::format("u{:x}", code);
}

}  // namespace

std::string ascii_identifier(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if (byte < 0x80) {
            const bool fits = std::isalnum(byte) != 0 || byte == '_';
            result += fits ? static_cast<char>(byte) : '_';
            ++i;
            continue;
        }
        const int length = byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : 2;
        std::uint32_t code = byte & (0xffU >> (length + 1));
        for (int k = 1; k < length && i + k < text.size(); ++k)
            code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3fU);
        result += spelled(code);
        i += length;
    }
    // Names that begin with _ or contain __ are reserved for the implementation.
    for (std::size_t at = result.find("__"); at != std::string::npos; at = result.find("__")) result.erase(at, 1);
    if (result.empty() || result[0] == '_' || std::isdigit(static_cast<unsigned char>(result[0])) != 0)
        result.insert(0, result.empty() || result[0] != '_' ? "x_" : "x");
    return result;
}

Names::Names() {
    taken_.insert(keywords.begin(), keywords.end());
    taken_.insert(own.begin(), own.end());
}

std::string Names::fresh(const std::string& wish) {
    std::string name = ascii_identifier(wish);
    if (taken_.insert(name).second) return name;
    if (name.back() != '_') {
        name += '_';
        if (taken_.insert(name).second) return name;
    }
    return numbered(name);
}

std::string Names::numbered(const std::string& prefix) {
    for (int& k = next_[prefix];; ++k)
        if (const std::string name = prefix + std::to_string(k); taken_.insert(name).second) return name;
}

}  // namespace alembert
