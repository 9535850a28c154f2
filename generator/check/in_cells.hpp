// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A claim in which signs decide, or in whose equations they do, is judged in every cell of its sides
/// (analysis/exact/cells.hpp): it is proved if it holds in all of them that have states, and refuted by a state in
/// one of them.
///
///     if (InCells sided(now, 2, states); sided.any()) sided.settle();        // writes now.verdicts[2]

#include <map>

#include "analysis/exact/cells.hpp"
#include "check/comparison.hpp"

namespace alembert {

class InCells {
public:
    /// `states` as in settle_closed_claim.
    InCells(Comparison& now, std::size_t claim, ExactStates& states);

    /// Whether there are sides, and states can be found in each cell: where positions obey constraints, or states
    /// are those of rest, nothing steers a state into a cell.
    bool any() const;
    /// False if nothing was decided, and another way may decide it.
    bool settle();
    /// Whether a state was found in one of the cells at which the claim fails.
    bool fails();

private:
    /// What exact arithmetic says of a cell.
    struct Exact {
        bool is_zero = true;
        double failure = 0;  ///< log₂ of the probability that it is zero by chance
    };
    /// What is known of a cell in the end; `empty`: it has no states.
    enum class Known { holds, fails, empty, unknown };

    /// Visits all cells that have states modulo the prime; false if some may have been missed.
    bool visit();
    Known look(Cell cell, const Exact& exact);
    bool is_empty(Cell cell) const;
    bool look_beside();
    std::optional<Counterexample> on_own_branch(const Counterexample& shown);
    std::string words(Cell cell) const;
    std::string side_in_words(std::size_t side, bool is_positive) const;
    std::vector<std::string> where_it_holds() const;
    bool refuse(const std::string& reason);

    Comparison& now_;
    const std::size_t claim_;
    ExactStates& states_;
    Program program_;
    int root_ = 0;
    bool has_roots_ = false;  ///< square roots, whose signs may be others in exact arithmetic
    std::optional<Cells> cells_;
    std::vector<std::optional<GiNaC::ex>> sides_;
    std::map<Cell, Exact> visited_;
    std::map<Cell, SeenInCell> seen_;
    std::map<Cell, Known> known_;
    std::optional<Counterexample> shown_;
};

}  // namespace alembert
