// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Words with formulas, as text, LaTeX or MathML.
///
///     const Notation n = notation_of("latex");
///     n.page({{"Kinetic energy:", {{n.left(statement), n.phrase(statement.value)}}}});

#include "model/formalism/steps.hpp"

namespace alembert {

/// Characters that enclose a formula among words until both are written in the form that the page needs. (The
/// reader of scenes refuses control characters.)
inline constexpr char formula_begins = '\x01', formula_ends = '\x02';

/// Words, then the formulas that they announce.
struct Block {
    enum class Kind {
        step,        ///< of the derivation
        definition,  ///< intermediate symbols of equations that are beyond the readable size
        equation,    ///< of motion, with what belongs to it: definitions, rates, constraints, gaps
        remark,      ///< what can be said besides: reactions, friction, factors
    };
    std::string words;
    std::vector<std::pair<std::string, std::string>> equalities;
    Kind kind = Kind::step;
    std::vector<std::size_t> operations = {};  ///< of each of these; may be left out
    bool with_symbols = false;  ///< whether they are, or hold, intermediate symbols, which only stand in this page
};

/// The functions with which a format writes formulas, left-hand sides of statements, and blocks.
struct Notation {
    std::string (*phrase)(const Phrase&);
    std::string (*inline_phrase)(const Phrase&);  ///< for use among words
    std::string (*left)(const Statement&);
    std::string (*page)(const std::vector<Block>&);
};

/// `format`: text, latex or mathml; text for any other.
Notation notation_of(const std::string& format);

/// Words in which the formulas of steps ("d/dt dT/dq' - dT/dq = Q") have become LaTeX between `formula_begins` and
/// `formula_ends`.
std::string typeset(const std::string& given);

}  // namespace alembert
