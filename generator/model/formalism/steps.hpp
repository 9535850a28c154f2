// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The steps that a formalism shows: words, then statements and equalities, in the notation of the page.
///
///     StepWriter write(mechanism);
///     Section section{.words = "Hamilton's function, with p = dL/dq':"};
///     write.equality(section, write.letter("H"), H);

#include <optional>
#include <string>
#include <vector>

#include "algebra/notation/readable.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "model/formalism/equations.hpp"

namespace alembert {

/// `letter` (of `of`) = value: "T of particle M1", "dL/dtheta1'", "Q of theta1"; in `motion` a position, a
/// velocity, a speed's square or an angular velocity of a body, "x_M1", "x_M1'", "v_M1^2"; in `partial_rate` the
/// rate of a partial derivative, "d/dt dT/d(theta1')".
struct Statement {
    enum class Kind { energy, partial, partial_rate, force, work, definition, motion };
    Kind kind = Kind::energy;
    std::string letter;        ///< T, V, L, Q, δW; x, x', v^2, omega
    std::string of;            ///< a body, a load; may be empty
    std::optional<Phrase> by;  ///< the variable of a partial derivative, the coordinate of a force
    Phrase value;
};

struct Section {
    std::string words;
    std::vector<Statement> statements = {};
    std::vector<std::pair<Phrase, Phrase>> equalities = {};
};

struct OwnSteps {
    std::vector<Section> sections = {};
    std::string title = {};  ///< the title of `equations`
    /// Shown in place of the second-order equations; if empty, those are shown.
    std::vector<ReadableEquation> equations = {};
};

/// Writes values in normal form; values beyond the readable size are left out.
class StepWriter {
public:
    explicit StepWriter(const Mechanism& mechanism) : m_(mechanism) {}

    Phrase symbol_of(const GiNaC::symbol& symbol) const;
    /// A letter of the book that is no symbol of the scene: H, R.
    static Phrase letter(const std::string& name);
    /// The rate p' of a momentum p.
    Phrase rate(const GiNaC::symbol& momentum) const;
    /// The normal form; nothing if the expression exceeds the readable size, or on the way to it `most` times
    /// that.
    std::optional<Fourier> normal(const GiNaC::ex& e, std::size_t most = 20) const;

    /// left = value
    void equality(Section& section, const Phrase& left, const GiNaC::ex& value) const;
    /// letter(of) = value, zero included: a generalized force of a coordinate or speed
    void force(Section& section, const std::string& letter, const GiNaC::symbol& of, const GiNaC::ex& value) const;
    /// Writes d`of`/d`by` = value, if the value is not zero.
    void partial(Section& section, const std::string& of, const GiNaC::symbol& by, const GiNaC::ex& value) const;

private:
    const Mechanism& m_;
};

}  // namespace alembert
