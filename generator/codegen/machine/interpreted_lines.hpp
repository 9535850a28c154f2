// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A function as lines (lines.hpp), run line by line where nothing can be made executable: ten to fifty times
/// slower than code, and with its results, bit for bit where the code has no fused multiply-add.
///
///     const InterpretedLines rhs(lines_of(program, words, ready, right_hand_side(program, words)));
///     double* const arrays[] = {state, par, rate};
///     rhs.run(t, arrays);

#include "codegen/machine/lines.hpp"

namespace alembert::machine {

class InterpretedLines {
public:
    /// Lines for one system; throws std::logic_error for those of packs.
    explicit InterpretedLines(Lines lines);

    /// `arrays`: as many as the lines have; those of results must not overlap the others. `t` is for lines that
    /// take it.
    void run(double t, double* const* arrays) const;

private:
    Lines l_;
    std::vector<double> first_;  ///< of all values: those of constants
};

/// Angles, then sines from the place `distance` on, and cosines from twice that.
void sines_in_place(double* angles, int distance, int count);

}  // namespace alembert::machine
