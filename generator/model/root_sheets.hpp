// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// √(e²) as e or −e, whichever is positive at the initial state: the sheet of roots on which a reader of a
/// textbook stands. A spring along r has the length √(r²), and its force is −k (r − l₀) for r > 0.
///
///     RootSheets sheets(mechanism);           // once its parameters and initial values are known
///     if (const auto e = sheets.root(r*r, *mechanism.z)) …  // r
///     sheets.positive();                      // r
///
/// Assumed is nothing where e vanishes at the initial state, or where a square is not seen as one. |e| is left as
/// it is, unless e holds parameters alone: a coordinate may pass zero there. What runs keeps its roots.

#include <memory>
#include <optional>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

class RootSheets {
public:
    explicit RootSheets(const Mechanism& mechanism);

    /// e with e² = `square`, positive at the start. `z` holds what `square` names, and names the root.
    std::optional<GiNaC::ex> root(const GiNaC::ex& square, Intermediates& z);
    /// |e|, where e holds parameters alone.
    std::optional<GiNaC::ex> magnitude(const GiNaC::ex& e, Intermediates& z) const;

    /// What is positive on the sheet and could be negative elsewhere: it depends on coordinates, or is a
    /// difference of parameters. Each once.
    const std::vector<GiNaC::ex>& positive() const { return positive_; }

private:
    double at_start(const GiNaC::ex& e) const;
    std::optional<GiNaC::ex> square_root(const GiNaC::ex& square, const Intermediates& z) const;

    std::shared_ptr<Symbols> symbols_;
    GiNaC::exmap start_;  ///< coordinates, rates, t and parameters → numbers
    std::vector<GiNaC::symbol> moving_;
    std::vector<GiNaC::ex> positive_;
};

struct OnSheets {
    Mechanism mechanism;
    std::shared_ptr<RootSheets> sheets;
};

/// As `build`, with roots of squares on the sheet of the initial state: for derivations and proofs.
OnSheets build_on_sheets(const Scene& scene);

}  // namespace alembert
