// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The cycles that a function takes, to compare two ways of writing it.
///
///     cycles_of(other) < cycles_of(lines)
///
/// Each line begins as soon as its values are ready and a unit is free, among the next hundred lines. Two units
/// take a line a cycle each, and one divider is busy for several cycles with a root or a quotient. (Fog,
/// Instruction tables: from Haswell and Zen on, four roots or quotients in one register keep the divider busy for
/// at most twice as long as one, and two no longer than one.)

#include "codegen/machine/lines.hpp"

namespace alembert::machine {

/// From the values of a line to its own.
int latency_of(const Line& line);

/// For which the divider takes nothing else, where a root or a quotient is that of so many numbers.
int divider_cycles(const Line& line, int numbers);

int cycles_of(const Lines& lines);

/// The same lines, each as late as it may begin if the function is to take no longer: what waits for the divider
/// begins early and one after the other, and what follows is done while the divider is busy with the next.
std::vector<Line> as_late_as_possible(const Lines& lines);

/// For each value the line that computes it, or −1.
std::vector<int> origins_of(const Lines& lines);

}  // namespace alembert::machine
