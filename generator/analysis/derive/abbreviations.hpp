// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The scene's definitions serve as abbreviations in the derived equations: gamma for 1/sqrt(1 - (x'^2+y'^2)/c^2).
///
///     const Abbreviations abbreviate(mechanism);
///     abbreviate(m*x''*pow(1 - (x'^2+y'^2)/c^2, -1/2))        // gamma*m*x''
///
/// A definition is found wherever it, or the sum of which it is a power, appears undivided: under a root, in a
/// denominator, as the angle of a sine, or as a factor. In each case it may differ by a factor of parameters. A
/// sum that has been multiplied out is not found.

#include <optional>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

class Abbreviations {
public:
    /// Uses the definitions that change with the state and have the form c·(sum)^r with a factor c of parameters.
    explicit Abbreviations(const Mechanism& mechanism);

    bool any() const { return !list_.empty(); }

    struct Kept {
        GiNaC::symbol name;
        GiNaC::ex value;  ///< with intermediate symbols written out
        GiNaC::ex factor, sum;
        GiNaC::numeric power;  ///< value = factor·sum^power
    };
    const std::vector<Kept>& list() const { return list_; }

    /// `e` with the names in place of the values. `e` must be written out, without intermediate symbols.
    GiNaC::ex operator()(const GiNaC::ex& e) const;

private:
    bool is_steady(const GiNaC::ex& e) const;
    std::optional<GiNaC::ex> named(const GiNaC::ex& sum, const GiNaC::numeric& power) const;

    const Mechanism& m_;
    std::vector<Kept> list_;
};

}  // namespace alembert
