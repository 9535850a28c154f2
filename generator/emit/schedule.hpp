// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The order in which statements are best written: what the end waits for longest comes first.
///
///     for (const int id : scheduled(program, ready, roots, is_done)) …       // nodes, arguments first
///
/// A processor looks a few hundred instructions ahead. A chain of divisions that starts after a thousand
/// independent products is found too late; started at once, it runs beside them. List scheduling (Hu 1961) on two
/// units, by the longest way to the end.

#include <functional>
#include <span>
#include <vector>

#include "program/program.hpp"
#include "program/readiness.hpp"

namespace alembert {

/// The nodes that the roots need, without those that are done before (these are ready when `ready` says).
std::vector<int> scheduled(const Program& program, const Readiness& ready, std::span<const int> roots,
                           const std::function<bool(int)>& is_done);

}  // namespace alembert
