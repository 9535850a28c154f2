// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes normal forms as a textbook prints them.
///
///     readable(T)                 (m1+m2)·l1²·θ1′²/2 + m2·l2²·θ2′²/2 + m2·l1·l2·θ1′·θ2′·cos(θ1−θ2)
///     readable_equation(lhs, Q)   (m1+m2)·l1·θ1″ + m2·l2·θ2″·cos(θ1−θ2) + m2·l2·θ2′²·sin(θ1−θ2) + (m1+m2)·g·sin
///     θ1
///                                   = F·cos θ1,    divided by l1
///
/// Terms are sorted: accelerations in the order of the coordinates, squares and products of rates, single rates,
/// positions (gravity before springs). An equation is divided by the common factor of all its coefficients, but
/// never by anything that depends on the state, on time or on inputs. The term of the row's own acceleration is
/// positive; where there is none, the first term.
/// Fractions are cleared; decimals stay decimals.

#include <optional>

#include "algebra/notation/compose.hpp"
#include "algebra/symbolic/fourier.hpp"

namespace alembert {

/// An energy, a generalized force, an output. `effort` limits the search for a short form: the terms of all
/// polynomials that are tried (usual_effort of the composer).
Phrase readable(const Fourier& f, std::size_t effort);
Phrase readable(const Fourier& f);

/// Writes one normal form after the other like `readable`, but what several have in common is composed once.
class ReadableWriter {
public:
    Phrase operator()(const Fourier& f);

private:
    Composer in_fractions_{false}, in_decimals_{true};
};

/// The sign of an expression that is not zero: F < 0, and not −F > 0.
struct ReadableSign {
    Phrase of;
    const char* words;  ///< "> 0" or "< 0"
};
/// That of an expression that is positive; nothing if it has no normal form.
std::optional<ReadableSign> readable_sign(const GiNaC::ex& positive, const Symbols& symbols);

struct ReadableEquation {
    Phrase lhs, rhs;
    std::optional<Phrase> divided_by;  ///< none if nothing was divided out
};

/// `lhs` holds inertia, potential and dissipation, `rhs` the applied forces. `own`: the acceleration of the row's
/// own coordinate or speed, whose coefficient is an inertia and so positive.
ReadableEquation readable_equation(const Fourier& lhs, const Fourier& rhs,
                                   const std::optional<SymbolInfo>& own = {});

}  // namespace alembert
