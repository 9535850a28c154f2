// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A hand derivation, line by line with a verdict: which line is the first wrong one, what the slip is, and
/// whether the rest is right given that line.
///
///     const Marked marked = mark(scene, read_derivation(text, "homework.tex"));
///     marked.lines[*marked.first_mistake].likely->kind

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "check/verdict.hpp"
#include "check/written/read.hpp"
#include "scene/scene.hpp"

namespace alembert {

enum class LineStatus {
    right,
    right_near,              ///< to first order near the state that the derivation linearizes about
    right_up_to_constant,    ///< a potential or an energy
    right_up_to_derivative,  ///< a Lagrangian, up to d/dt of a function of coordinates and time
    definition,              ///< of a symbol that the derivation introduces
    mistake,                 ///< false, and not explained by a line before it
    follows,                 ///< false, but what the derivation's own wrong line gives
    unfounded,               ///< true, but not what the derivation's own lines give
    undecided,               ///< neither proved nor refuted
    not_understood,
    not_about_scene,
};

/// Right in one of its senses.
bool is_right(LineStatus status);

/// Of the parts of a line the worse one is told: a mistake before what is undecided.
bool is_worse(LineStatus status, LineStatus than);

/// "right_up_to_constant": as JSON has it.
const char* name_of(LineStatus status);

/// One equality: `a = b = c` are two.
struct MarkedLine {
    LineStatus status = LineStatus::undecided;
    std::size_t statement = 0;           ///< in Written::statements
    std::size_t offset = 0, length = 0;  ///< of its two sides in the document
    int line = 0, column = 0;            ///< from 1
    std::string source{};                ///< as written
    std::string claim{};                 ///< in the scene's language; empty if it was not understood
    CheckedClaim checked{};              ///< the verdict on the system itself
    std::string term{};                  ///< the wrong term, in the scene's language; empty if it is not known
    std::size_t term_offset = 0, term_length = 0;  ///< of the wrong term in the document; length 0 if not known
    std::string right{};        ///< the right line, in the scene's language; empty if it is not known
    std::string right_latex{};  ///< the same in LaTeX
    std::optional<std::size_t> follows_from{};  ///< the wrong line, in Marked::lines, that explains this one
    std::string reason{};                       ///< in words, if there is something to explain
};

struct Marked {
    Written written{};
    std::vector<MarkedLine> lines{};  ///< in reading order
    std::optional<std::size_t> first_mistake{};
    std::vector<std::string> missing{};  ///< rows of the equations of motion that no right line gives: "theta1"
    bool complete = false;               ///< whether nothing is missing
    std::map<std::string, std::string> letters{};  ///< as written → in the scene: "\\ell" → "l"
    std::vector<std::string> remarks{};  ///< what was assumed about letters and what could not be told apart
};

struct MarkOptions {
    std::string by = {};  ///< a formalism; if empty, the one that a teacher would choose
    std::map<std::string, std::string> letters =
        {};  ///< as written → in the scene, over [letters] and what is found
};

class DerivedSystem;

/// Throws SceneError for letters that name nothing, and what `derived` throws.
Marked mark(Scene scene, Written written, const MarkOptions& options = {});
/// The same for one of several derivations about a system.
Marked mark(DerivedSystem& system, Written written, const MarkOptions& options = {});

}  // namespace alembert
