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
/// Nothing is assumed if e vanishes at the initial state or if a square is not recognized. |e| and sign e are kept
/// but for factors that consist of parameters only, because a coordinate may pass zero: |r θ'| is r |θ'|.
/// Simulations keep their roots.

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

class RootSheets {
public:
    explicit RootSheets(const Mechanism& mechanism);

    /// What the square of a length is: a distance in the mechanism, or what somebody writes as a root, where a sum
    /// with coordinates, √((x − a)²), is no length of its own.
    enum class Of { distance, formula };
    /// e with e² = `square`, its lengths positive at the start. `z` has the intermediate symbols in `square` and
    /// gets those of the root.
    std::optional<GiNaC::ex> root(const GiNaC::ex& square, Intermediates& z, Of of = Of::formula);
    /// |e| and sign e, with the factors of numbers and parameters outside; nothing if there are none.
    std::optional<GiNaC::ex> magnitude(const GiNaC::ex& e, Intermediates& z) const;
    std::optional<GiNaC::ex> sign(const GiNaC::ex& e, Intermediates& z) const;

    /// The expressions that are positive on the sheet and could be negative elsewhere, each once. They depend on
    /// coordinates or are differences of parameters.
    const std::vector<GiNaC::ex>& positive() const { return positive_; }
    /// Those of them that roots have needed since this was asked for the last time.
    std::vector<GiNaC::ex> take_needed() { return std::exchange(needed_, {}); }

private:
    /// `constant` is positive at the scene's values.
    struct Split {
        GiNaC::ex constant, rest;
    };
    std::optional<Split> split(const GiNaC::ex& e, const Intermediates& z) const;
    double at_start(const GiNaC::ex& e) const;
    bool is_of_positions(const GiNaC::ex& e) const;
    std::optional<GiNaC::ex> square_root(const GiNaC::ex& square, const Intermediates& z) const;

    std::shared_ptr<Symbols> symbols_;
    GiNaC::exmap start_;  ///< coordinates, rates, t and parameters → numbers
    std::vector<GiNaC::symbol> moving_;
    std::vector<GiNaC::ex> positive_, needed_;
};

struct OnSheets {
    Mechanism mechanism;
    std::shared_ptr<RootSheets> sheets;
};

/// Like `build`, but with roots of squares on the sheet of the initial state, for derivations and proofs.
OnSheets build_on_sheets(const Scene& scene);

}  // namespace alembert
