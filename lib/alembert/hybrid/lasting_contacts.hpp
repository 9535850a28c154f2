// SPDX-License-Identifier: MIT
#pragma once

/// Unilateral contacts at one instant: which of the closed contacts stay closed.
///
///     const Situation here = …;                                   // a block on the ground: contacts 0 and 1
///     const LastingContacts mode = lasting_contacts(here, {0, 1});
///     mode.closed;          // {0, 1}: constraints of the motion that follows
///     mode.acceleration;    // its q''
///
/// With M q'' = f + Aᵀλ + Gᵀπ, A q'' = γ and gap'' = G q'' − δ, contacts that are closed and do not move apart
/// obey
///
///     gap'' ≥ 0,   π ≥ 0,   π·gap'' = 0      (Moreau; Glocker, Set-Valued Force Laws (2001), ch. 5)
///
/// This is the law of impact without restitution, with accelerations in place of rates (`press` of
/// frictionless_impact.hpp). If M is definite, q'' is unique, and it exists unless the conditions on the gaps
/// contradict each other.

#include <Eigen/Dense>
#include <string>
#include <vector>

namespace alembert {

/// Everything about contacts that the state at one instant determines.
struct Situation {
    struct Rows {
        Eigen::MatrixXd rows;          ///< the coefficients of q'
        Eigen::VectorXd value;         ///< f(q,t), the gap; 0 for nonholonomic rows
        Eigen::VectorXd offset;        ///< value' = rows·q' + offset
        Eigen::VectorXd acceleration;  ///< value'' = rows·q'' − acceleration
    };
    Eigen::MatrixXd M;
    Eigen::VectorXd f;
    Rows bilateral, contacts;
    /// Dry friction at a contact whose sliding velocity is v = tangent q' + offset, of one component, or of two in
    /// a plane.
    struct Rough {
        int contact;
        Eigen::MatrixXd tangent;
        Eigen::VectorXd offset, velocity;
        Eigen::VectorXd acceleration;  ///< v' = tangent q'' − acceleration
        double coefficient, resting, restitution;
        double still = 0;  ///< the |v| that rounding may leave of none
    };
    std::vector<Rough> rough = {};
};

struct LastingContacts {
    std::string
        failure;  ///< if not empty, the reason why no choice is consistent; the other members are then empty
    /// If several choices are consistent and differ in q'', the modes of each: `stick`, `slip +`, `slip -`, `slip`
    /// (in a plane), `closed` or `open` for each candidate. `failure` says so, too.
    std::vector<std::vector<std::string>> several = {};
    Eigen::VectorXd acceleration = {};  ///< q''
    std::vector<int> closed =
        {};  ///< contacts that stay closed, their rows independent of each other and of the bilateral ones
    std::vector<int> resting = {};  ///< these, and the contacts that stay closed because the others do
    explicit operator bool() const { return failure.empty(); }
};

/// `candidates` are the closed contacts with gap' = 0, ascending. How redundant contacts (the four legs of a
/// table) share the load is not determined; here as few as possible carry it, and none of them pulls
/// (Carathéodory). Where a candidate has friction along a line, friction takes part (friction_modes.hpp), unless
/// no mode is consistent with it; where several are, with different q'', none is chosen.
LastingContacts lasting_contacts(const Situation& here, const std::vector<int>& candidates);

/// Why there is no choice, as a message that begins with "no contact mode is consistent at t = …" or "more than
/// one contact mode is consistent at t = …". `names` are those of all contacts.
std::string refusal_of(const LastingContacts& lasting, double t, const std::vector<int>& candidates,
                       const std::vector<std::string>& names);

/// Do the bilateral rows and the contacts in `closed` determine the acceleration of contact k completely?
bool is_carried(const Situation& here, const std::vector<int>& closed, int k);

/// The rates gap' of all contacts.
Eigen::VectorXd gap_rates(const Situation& here, const Eigen::VectorXd& rates);
/// The rates of gaps below which they count as zero: 1e-9 of the sum of the sizes of their terms, and 1e-13 for
/// each rate in them.
Eigen::VectorXd negligible_rates(const Situation& here, const Eigen::VectorXd& rates);
/// The sizes of gaps below which they count as closed: what errors of `tolerance` · max(1, |q|) in each coordinate
/// make.
Eigen::VectorXd negligible_gaps(const Situation& here, const Eigen::VectorXd& q, double tolerance);

/// The rows, values, offsets and accelerations of these contacts only.
Situation::Rows selected(const Situation::Rows& rows, const std::vector<int>& which);
/// The rows of `a`, then those of `b`.
Situation::Rows stacked(const Situation::Rows& a, const Situation::Rows& b);

}  // namespace alembert
