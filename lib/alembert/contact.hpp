// SPDX-License-Identifier: MIT
#pragma once

/// Unilateral contacts at one instant: which of the closed ones last.
///
///     const Situation here = …;                                   // a block on the ground: contacts 0 and 1
///     const Lasting mode = lasting_contacts(here, {0, 1});
///     mode.closed;          // {0, 1}: constraints of the motion that follows
///     mode.acceleration;    // its q''
///
/// With M q'' = f + Aᵀλ + Gᵀπ, A q'' = γ and gap'' = G q'' − δ, contacts that are closed and do not move apart
/// obey
///
///     gap'' ≥ 0,   π ≥ 0,   π·gap'' = 0      (Moreau; Glocker, Set-Valued Force Laws (2001), ch. 5)
///
/// which is the law of impact without restitution for accelerations in place of rates (`press` of impact.hpp). For
/// a definite M the q'' is the only one, and it exists unless the gaps contradict each other.

#include <Eigen/Dense>
#include <string>
#include <vector>

namespace alembert {

/// Everything about contacts that the state at one instant determines.
struct Situation {
    struct Rows {
        Eigen::MatrixXd rows;          ///< of q'
        Eigen::VectorXd value;         ///< f(q,t), the gap; 0 for nonholonomic rows
        Eigen::VectorXd drift;         ///< value' = rows·q' + drift
        Eigen::VectorXd acceleration;  ///< value'' = rows·q'' − acceleration
    };
    Eigen::MatrixXd M;
    Eigen::VectorXd f;
    Rows bilateral, contacts;
    /// Dry friction at a contact, with the sliding velocity v = slip·q' + drift.
    struct Rough {
        int contact;
        Eigen::RowVectorXd slip;
        double drift, coefficient, resting;
    };
    std::vector<Rough> rough = {};
};

struct Lasting {
    std::string failure;           ///< empty, or why no choice is consistent; then the rest is empty
    Eigen::VectorXd acceleration;  ///< q''
    std::vector<int> closed;       ///< contacts whose rows are independent of each other and of the bilateral ones
    std::vector<int> resting;      ///< these, and those that lie on because the others do
    explicit operator bool() const { return failure.empty(); }
};

/// `candidates`: closed contacts with gap' = 0, ascending. Redundant contacts (the fourth leg of a table) share
/// the load in any way; here as few as possible carry it, each without pulling (Carathéodory).
Lasting lasting_contacts(const Situation& here, const std::vector<int>& candidates);

/// Does contact k have no acceleration of its own where the bilateral rows and the contacts in `closed` hold?
bool is_carried(const Situation& here, const std::vector<int>& closed, int k);

/// gap' of all contacts.
Eigen::VectorXd gap_rates(const Situation& here, const Eigen::VectorXd& rates);
/// Rates of gaps that count as zero: 1e-9 of the sum of the sizes of their terms, and 1e-13 for each rate in it.
Eigen::VectorXd negligible_rates(const Situation& here, const Eigen::VectorXd& rates);
/// Gaps that count as closed: `tolerance` · max(1, |q|) in each coordinate.
Eigen::VectorXd negligible_gaps(const Situation& here, const Eigen::VectorXd& q, double tolerance);

/// Rows, values, drifts and accelerations of these contacts alone.
Situation::Rows selected(const Situation::Rows& rows, const std::vector<int>& which);
/// First `a`, then `b`.
Situation::Rows stacked(const Situation::Rows& a, const Situation::Rows& b);

}  // namespace alembert
