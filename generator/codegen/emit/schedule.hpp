// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The best order of statements: those for which the results wait longest come first.
///
///     for (const int id : scheduled(program, ready, roots, is_done)) …       // nodes, arguments first
///
/// A processor looks a few hundred instructions ahead. If a chain of divisions starts after a thousand independent
/// products, the processor finds it too late; if it starts at once, it runs in parallel with them. The method is
/// list scheduling (Hu 1961) on two units, by the longest path to the end.

#include <functional>
#include <span>
#include <vector>

#include "program/program.hpp"
#include "program/readiness.hpp"

namespace alembert {

/// The nodes that the roots need, without those that are computed before; `ready` tells when these are ready.
std::vector<int> scheduled(const Program& program, const Readiness& ready, std::span<const int> roots,
                           const std::function<bool(int)>& is_done);

}  // namespace alembert
