// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/language/greek.hpp"

#include <array>

namespace alembert {

namespace {

// Greek capitals that look Latin have no command of their own.
constexpr std::array<GreekLetter, 56> greek{{
    {"alpha", "α", "\\alpha"},
    {"beta", "β", "\\beta"},
    {"gamma", "γ", "\\gamma"},
    {"delta", "δ", "\\delta"},
    {"epsilon", "ε", "\\varepsilon"},
    {"zeta", "ζ", "\\zeta"},
    {"eta", "η", "\\eta"},
    {"theta", "θ", "\\theta"},
    {"iota", "ι", "\\iota"},
    {"kappa", "κ", "\\kappa"},
    {"lambda", "λ", "\\lambda"},
    {"mu", "μ", "\\mu"},
    {"nu", "ν", "\\nu"},
    {"xi", "ξ", "\\xi"},
    {"omicron", "ο", "o"},
    {"pi", "π", "\\pi"},
    {"rho", "ρ", "\\rho"},
    {"sigma", "σ", "\\sigma"},
    {"tau", "τ", "\\tau"},
    {"upsilon", "υ", "\\upsilon"},
    {"phi", "φ", "\\varphi"},
    {"chi", "χ", "\\chi"},
    {"psi", "ψ", "\\psi"},
    {"omega", "ω", "\\omega"},
    {"Gamma", "Γ", "\\Gamma"},
    {"Delta", "Δ", "\\Delta"},
    {"Theta", "Θ", "\\Theta"},
    {"Lambda", "Λ", "\\Lambda"},
    {"Xi", "Ξ", "\\Xi"},
    {"Pi", "Π", "\\Pi"},
    {"Sigma", "Σ", "\\Sigma"},
    {"Upsilon", "Υ", "\\Upsilon"},
    {"Phi", "Φ", "\\Phi"},
    {"Psi", "Ψ", "\\Psi"},
    {"Omega", "Ω", "\\Omega"},
    {"Alpha", "Α", "\\mathrm{A}"},
    {"Beta", "Β", "\\mathrm{B}"},
    {"Epsilon", "Ε", "\\mathrm{E}"},
    {"Zeta", "Ζ", "\\mathrm{Z}"},
    {"Eta", "Η", "\\mathrm{H}"},
    {"Iota", "Ι", "\\mathrm{I}"},
    {"Kappa", "Κ", "\\mathrm{K}"},
    {"Mu", "Μ", "\\mathrm{M}"},
    {"Nu", "Ν", "\\mathrm{N}"},
    {"Omicron", "Ο", "\\mathrm{O}"},
    {"Rho", "Ρ", "\\mathrm{P}"},
    {"Tau", "Τ", "\\mathrm{T}"},
    {"Chi", "Χ", "\\mathrm{X}"},
    {"varphi", "φ", "\\varphi"},
    {"vartheta", "ϑ", "\\vartheta"},
    {"varepsilon", "ε", "\\varepsilon"},
    {"varrho", "ϱ", "\\varrho"},
    {"varsigma", "ς", "\\varsigma"},
    {"mu", "µ", "\\mu"},
    {"phi", "ϕ", "\\phi"},
    {"epsilon", "ϵ", "\\epsilon"},
}};

}  // namespace

const GreekLetter* greek_named(std::string_view name) {
    for (const GreekLetter& entry : greek)
        if (entry.name == name) return &entry;
    return nullptr;
}

const GreekLetter* greek_of(std::string_view letter) {
    for (const GreekLetter& entry : greek)
        if (entry.letter == letter) return &entry;
    return nullptr;
}

}  // namespace alembert
