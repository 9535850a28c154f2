// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Formulas with an index that runs, ω_i = θ_i' or s_j = sin θ_j: one statement for each number that the letters
/// of the scene have.
///
///     written = with_running_indices(std::move(written), Letters(scene), remarks);
///     join_copies(lines, written);      // one line again for each formula, the worst of its copies

#include <vector>

#include "check/derivation/letters.hpp"
#include "check/derivation/marked.hpp"

namespace alembert {

/// `remarks` get what each index stands for.
Written with_running_indices(Written written, const Letters& letters, std::vector<std::string>& remarks);

void join_copies(std::vector<MarkedLine>& lines, const Written& written);

}  // namespace alembert
