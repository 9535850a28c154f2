// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Random and well-spread points in place of a grid.
///
///     const Grid points = sampled({{"theta1", 0, 3}, {"l1", 1, 2}}, 1000, Sampling::latin, 42);
///
/// All values lie in [from, to). The same seed gives the same points on every machine: the numbers come from the
/// Mersenne twister with 64 bits, their upper 53 bits as a fraction.
///
///  - uniform: independent of each other;
///  - latin: each of N equal parts of each range has one point (McKay, Beckman & Conover, Technometrics 21 (1979)
///  239);
///  - sobol: Sobol's sequence with the direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30 (2008) 2635), up
///  to 21
///    ranges and 2³² points. 2ⁿ points from the beginning lie one in each of 2ⁿ equal parts of each range. A seed
///    other than 0 shifts the binary digits of all points in the same way, which keeps this.
///
/// A point is computed when it is asked for, so that their number costs no memory. The parts of a Latin hypercube
/// are in an order that is shuffled in memory for up to a million points, and beyond is a permutation with a key:
/// a Feistel network of four rounds on as many binary digits as the count has, applied again while its result is
/// no part (Black & Rogaway, CT-RSA 2002, LNCS 2271, 114, "cycle-walking").

#include <cstdint>
#include <string>

#include "scene/grid.hpp"

namespace alembert {

enum class Sampling { uniform, latin, sobol };

/// Throws ModelError for a word that is none of these.
Sampling sampling_of(const std::string& word);

/// The counts of the axes are not used. Throws ModelError for a sobol sequence over more than 21 ranges
/// or of more than 2³² points.
Grid sampled(std::vector<Axis> axes, std::size_t count, Sampling sampling, std::uint64_t seed);

}  // namespace alembert
