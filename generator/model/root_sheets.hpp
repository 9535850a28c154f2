// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Replaces √(e²) by e or −e, whichever is positive at the initial state, where e is a length: where it depends on
/// positions only. That is the sheet of the root which a textbook assumes. A spring along r has the length √(r²),
/// and its force is −k (r − l₀) for r > 0. Factors with rates become their absolute value, since a rate may change
/// its sign: √(r² θ'²) is r |θ'| for r > 0.
///
///     RootSheets sheets(mechanism);           // once its parameters and initial values are known
///     if (const auto e = sheets.root(r*r, *mechanism.z)) …  // r
///     sheets.positive();                      // r
///
/// Nothing is assumed if e vanishes at the initial state or if a square is not recognized. |e|, sign e, min and
/// max are kept but for what consists of parameters only, because a coordinate may pass zero: |r θ'| is r |θ'|,
/// and |a - b| is a - b for the values of the scene. What is assumed of parameters is told like lengths, unless it
/// follows from the positive ones being positive. Simulations keep their roots.

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

class RootSheets {
public:
    explicit RootSheets(const Mechanism& mechanism);

    /// Takes these to be positive from now on, wherever the motion starts. If it does not start there, its start
    /// says nothing of formulas: √(e²) is |e| where no sign of e follows from what is supposed.
    void suppose(std::vector<GiNaC::ex> positive);

    /// What the square of a length is: a distance in the mechanism, or what somebody writes as a root, where a sum
    /// with coordinates, √((x − a)²), is no length of its own.
    enum class Of { distance, formula };
    /// e with e² = `square`, its lengths positive at the start. `z` has the intermediate symbols in `square` and
    /// gets those of the root.
    std::optional<GiNaC::ex> root(const GiNaC::ex& square, Intermediates& z, Of of = Of::formula);
    /// |e| and sign e, with the factors of numbers and parameters outside; nothing if there are none.
    std::optional<GiNaC::ex> magnitude(const GiNaC::ex& e, Intermediates& z);
    std::optional<GiNaC::ex> sign(const GiNaC::ex& e, Intermediates& z);
    /// Whether a > b; nothing if their difference does not consist of numbers and parameters.
    std::optional<bool> is_larger(const GiNaC::ex& a, const GiNaC::ex& b, const Intermediates& z);

    /// The expressions that are positive on the sheet and could be negative elsewhere, each once. They depend on
    /// coordinates or are differences of parameters.
    const std::vector<GiNaC::ex>& positive() const { return positive_; }
    /// Those of them that roots have needed since this was asked for the last time.
    std::vector<GiNaC::ex> take_needed() { return std::exchange(needed_, {}); }

private:
    /// `constant` is positive, by what is assumed.
    struct Split {
        GiNaC::ex constant, rest;
    };
    std::optional<Split> split(const GiNaC::ex& e, const Intermediates& z);
    /// Keeps that e is positive, unless it is so for all positive parameters.
    void assume(const GiNaC::ex& e);
    bool is_known_positive(const GiNaC::ex& e) const;
    /// Its sign by what is supposed, or else at the initial state, as a number of that sign.
    double size_of(const GiNaC::ex& e) const;
    double at_start(const GiNaC::ex& e) const;
    bool is_of_positions(const GiNaC::ex& e) const;
    std::optional<GiNaC::ex> square_root(const GiNaC::ex& square, const Intermediates& z) const;

    std::shared_ptr<Symbols> symbols_;
    GiNaC::exmap start_;  ///< coordinates, rates, t and parameters → numbers
    std::vector<GiNaC::symbol> moving_;
    std::vector<GiNaC::symbol> above_zero_;  ///< parameters
    std::vector<GiNaC::ex> supposed_, positive_, needed_;
    bool is_elsewhere_ = false;  ///< whether the start is outside of what is supposed
};

struct OnSheets {
    Mechanism mechanism;
    std::shared_ptr<RootSheets> sheets;
};

/// Like `build`, but with roots of squares on the sheet of the initial state, for derivations and proofs.
OnSheets build_on_sheets(const Scene& scene);

}  // namespace alembert
