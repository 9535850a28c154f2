// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// When each value of a program is ready, in cycles, and the order in which terms are best taken.
///
///     const Readiness ready(program, roots);
///     ready[node];                       // with an unlimited number of units
///     ready.order(node);                 // of a sum's or a product's arguments: what is late comes last
///
/// Cycles are those of processor.hpp. A compiler keeps the order of a sum. The order of the textbook form is kept
/// too, because that form is meant to be read.

#include <span>
#include <vector>

#include "program/program.hpp"

namespace alembert {

class Readiness {
public:
    Readiness(const Program& program, std::span<const int> roots);

    int operator[](int node) const { return ready_[node]; }
    /// Positions of the arguments. If it costs no time, a term of a sum that is no product comes first, which
    /// saves an addition.
    std::vector<std::size_t> order(int node) const;
    bool is_ordered() const { return !is_textbook_; }

private:
    struct Term {
        std::size_t position;
        int ready;   ///< for a product, the time at which its factors are ready
        bool fuses;  ///< whether it is a product that is not used elsewhere
    };
    std::vector<Term> terms(int node) const;
    std::vector<Term> arranged(std::vector<Term> list) const;
    int end(const Node& node, const std::vector<Term>& list) const;
    int ready_at(int node) const;

    const Program& program_;
    bool is_textbook_;
    std::vector<int> uses_, ready_;
};

}  // namespace alembert
