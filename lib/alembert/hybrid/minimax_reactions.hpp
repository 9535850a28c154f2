// SPDX-License-Identifier: MIT
#pragma once

/// Forces that hold several contacts where the motion does not determine each of them: the ends of a rod that
/// sticks with both on a rough floor. The contacts hold as long as any forces within their bounds do. So those are
/// taken whose largest share of a bound is the least; when that share reaches 1 the contacts give way together
/// (the static theorem of plastic collapse: Prager & Hodge, Theory of Perfectly Plastic Solids, 1951, §8).
///
///     α = given + free z,   min over z of max over contacts of |α_c| / r_c

#include <Eigen/Dense>
#include <vector>

namespace alembert {

struct ReactionBound {
    Eigen::Index first, size;  ///< its components in α: one, or two in a plane
    double bound;              ///< r_c > 0
};

/// α; the given one if nothing is free. given: n; free: n×d, with independent columns. A contact that no column
/// changes does not count.
Eigen::VectorXd minimax_reactions(const Eigen::VectorXd& given, const Eigen::MatrixXd& free,
                                  const std::vector<ReactionBound>& contacts);

}  // namespace alembert
