// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/names.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstdint>
#include <span>
#include <string_view>

#include "codegen/emit/dialect.hpp"
#include "codegen/emit/reserved_words.hpp"

namespace alembert {

namespace {

// What templates/solver.cpp.mustache declares.
// clang-format off
constexpr std::array own{
    "Real", "t", "state", "par", "rate", "mass", "forcing", "carried", "out", "energy", "jacobi", "prepare", "rhs",
    "pair", "sincos", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log", "sqrt",
    "abs", "sign", "pow", "atan2", "min", "max", "pi", "std", "main", "mass_forcing", "outputs_at", "events_at",
    "constraints_at", "multipliers_at", "position", "velocity", "rows", "pivots", "project", "gamma_at", "lambda",
    "table", "solver", "real2", "real4", "real8", "bits2", "bits4", "bits8", "sines", "sine", "cosine", "is_near",
    "sines_near", "sines_far", "sincos_in", "restrict", "fabs", "values", "direction", "change"};
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

Names::Names(CodeLanguage language) {
    taken_.insert(own.begin(), own.end());
    const Dialect& dialect = dialect_of(language);
    taken_.insert(dialect.words.begin(), dialect.words.end());
    longest_ = dialect.longest_name;
}

bool Names::take(std::string& name) {
    if (is_reserved(name)) name += '_';
    // Functions by points begin with "table_" or "table0_" (table_text.hpp).
    if (name.starts_with("table") && name.size() > 5 &&
        (name[5] == '_' || std::isdigit(static_cast<unsigned char>(name[5])) != 0))
        name.insert(5, 1, 's');
    return taken_.insert(name).second;
}

std::string Names::fresh(const std::string& wish) {
    std::string name = ascii_identifier(wish);
    if (name.size() > longest_) return numbered(name.substr(0, longest_) + "_");
    if (take(name)) return name;
    if (name.back() != '_') {
        name += '_';
        if (take(name)) return name;
    }
    return numbered(name);
}

std::string Names::numbered(const std::string& prefix) {
    for (int& k = next_[prefix];; ++k)
        if (std::string name = prefix + std::to_string(k); take(name)) return name;
}

std::string label_of(const std::string& identifier) {
    const std::string shorter = identifier.substr(0, identifier.size() - 1);
    return identifier.back() == '_' && may_be_macro(shorter) ? shorter : identifier;
}

std::vector<std::string> labels_of(std::vector<std::string> identifiers) {
    for (std::string& name : identifiers) name = label_of(name);
    return identifiers;
}

}  // namespace alembert
