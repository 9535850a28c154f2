// SPDX-License-Identifier: MIT
#include "alembert/hybrid/friction_modes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "alembert/base/dense.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr double slack = 1e-9;   // of inequalities, relative to the sizes of their terms
constexpr double alike = 1e-14;  // the energy of a difference of rates, relative to theirs, that counts as none

enum class RoughMode { open, sticks, slides_up, slides_down, held_up, held_down };

bool is_held(RoughMode mode) {
    return mode == RoughMode::held_up || mode == RoughMode::held_down;
}

double side(RoughMode mode) {
    return mode == RoughMode::slides_up || mode == RoughMode::held_up ? 1 : -1;
}

/// Is the static coefficient what holds this contact at rest?
bool is_static(const FrictionRows& c) {
    return c.tangent.size() > 0 && c.side == 0 && c.resting > c.coefficient;
}

/// The solution of the linear system of one choice of modes, and whether it is consistent. The unknowns are the
/// forces π, τ of each contact, of which x⁺ and Λ are affine functions; where M and A do not determine these, they
/// are unknowns, too.
class RoughTrial {
public:
    RoughTrial(const MatrixXd& M, const VectorXd& momentum, const MatrixXd& A, const VectorXd& b,
               const std::vector<FrictionRows>& contacts)
        : contacts_(contacts), n_(M.rows()), m_(A.rows()), forces_(2 * static_cast<Index>(contacts.size())) {
        const Index own = n_ + m_;
        MatrixXd K = MatrixXd::Zero(own, own), by_force = MatrixXd::Zero(own, forces_);
        VectorXd right(own);
        K.topLeftCorner(n_, n_) = M;
        K.topRightCorner(n_, m_) = -A.transpose();
        K.bottomLeftCorner(m_, n_) = A;
        right << momentum, -b;
        for (std::size_t i = 0; i < contacts.size(); ++i) {
            const Index column = 2 * static_cast<Index>(i);
            by_force.col(column).head(n_) = contacts[i].normal.transpose();
            if (contacts[i].tangent.size() > 0)
                by_force.col(column + 1).head(n_) = contacts[i].tangent.transpose();
        }
        MatrixXd all(own, 1 + forces_);
        all << right, by_force;
        const LeastNorm found = least_norm(K, all);
        if (found.rank == own) {
            first_ = 0;
            base_ = found.x.col(0);
            by_unknown_ = found.x.rightCols(forces_);
            K_ = MatrixXd::Zero(forces_, forces_);
            right_ = VectorXd::Zero(forces_);
        } else {
            first_ = own;
            base_ = VectorXd::Zero(own);
            by_unknown_ = MatrixXd::Identity(own, own + forces_);
            K_ = MatrixXd::Zero(own + forces_, own + forces_);
            K_.topRows(own) << K, -by_force;
            right_ = VectorXd::Zero(own + forces_);
            right_.head(own) = right;
        }
        for (const FrictionRows& c : contacts) {
            normal_.emplace_back(c.normal * by_unknown_.topRows(n_));
            tangent_.emplace_back(c.tangent.size() > 0 ? RowVectorXd(c.tangent * by_unknown_.topRows(n_))
                                                       : RowVectorXd());
        }
    }

    bool solves(const std::vector<RoughMode>& modes) {
        MatrixXd K = K_;
        VectorXd right = right_;
        for (std::size_t i = 0; i < modes.size(); ++i) {
            const FrictionRows& c = contacts_[i];
            const Index row = pressing(i);
            if (modes[i] == RoughMode::open) {
                K(row, row) = K(row + 1, row + 1) = 1;
                continue;
            }
            K.row(row) = normal_[i];
            right[row] = -c.offset - c.normal.dot(base_.head(n_));
            if (c.tangent.size() > 0 && modes[i] == RoughMode::sticks) {
                K.row(row + 1) = tangent_[i];
                right[row + 1] = -c.tangent_offset - c.tangent.dot(base_.head(n_));
            } else {  // τ + μ s π = 0
                K(row + 1, row + 1) = 1;
                K(row + 1, row) =
                    c.tangent.size() > 0 ? (is_held(modes[i]) ? c.resting : c.coefficient) * side(modes[i]) : 0;
            }
        }
        const LeastNorm found = least_norm(K, right);
        const VectorXd z = found.x.col(0);
        const double residual = (K * z - right).cwiseAbs().maxCoeff();
        const bool fits = z.allFinite() && residual <= slack * (right.cwiseAbs().maxCoeff() +
                                                                K.cwiseAbs().maxCoeff() * z.cwiseAbs().maxCoeff());
        has_many_ = fits && found.rank < K.rows();
        x_ = base_ + by_unknown_ * z;
        sizes_ = base_.head(n_).cwiseAbs() + by_unknown_.topRows(n_).cwiseAbs() * z.cwiseAbs();
        force_ = z.tail(forces_);
        return fits && !has_many_;
    }

    /// Whether the last system had more than one solution.
    bool has_many() const { return has_many_; }

    /// Whether the conditions of the modes hold, up to rounding (Judged::loosely) or by more than rounding can
    /// spoil.
    enum class Judged { loosely, clearly };
    bool is_consistent(const std::vector<RoughMode>& modes, Judged judged) const {
        const double allowed = judged == Judged::loosely ? slack : -slack;
        const VectorXd after = x_.head(n_);
        const double force = force_.cwiseAbs().maxCoeff();
        for (std::size_t i = 0; i < modes.size(); ++i) {
            const FrictionRows& c = contacts_[i];
            const double pi = normal_force(i), tau = tangential_force(i);
            const double gap = c.normal.dot(after) + c.offset,
                         gap_size = c.normal.cwiseAbs().dot(sizes_) + std::abs(c.offset);
            if (modes[i] == RoughMode::open) {
                if (gap < -allowed * gap_size) return false;
                continue;
            }
            if (pi < -allowed * force) return false;
            if (c.tangent.size() == 0) continue;
            const double sliding = c.tangent.dot(after) + c.tangent_offset,
                         sliding_size = c.tangent.cwiseAbs().dot(sizes_) + std::abs(c.tangent_offset);
            if (modes[i] == RoughMode::sticks) {
                if (std::abs(tau) > c.resting * pi + allowed * force) return false;
            } else if (is_held(modes[i])) {
                if (std::abs(sliding) > slack * sliding_size) return false;
            } else if (c.side == 0 && side(modes[i]) * sliding < -allowed * sliding_size) {
                return false;
            }
        }
        return true;
    }

    FrictionMode result(const std::vector<RoughMode>& modes) const {
        const auto count = static_cast<Index>(modes.size());
        FrictionMode found{.after = x_.head(n_),
                           .normal = VectorXd(count),
                           .tangential = VectorXd(count),
                           .bilateral = x_.tail(m_),
                           .closed = {},
                           .moves = {}};
        for (std::size_t i = 0; i < modes.size(); ++i) {
            found.normal[static_cast<Index>(i)] = std::max(0.0, normal_force(i));
            found.tangential[static_cast<Index>(i)] = tangential_force(i);
            found.closed.push_back(modes[i] != RoughMode::open);
            found.moves.push_back(found.closed.back() ? sign_of_sliding(contacts_[i]) : 0);
        }
        return found;
    }

private:
    /// The row of the condition on π; that on τ is the next one.
    Index pressing(std::size_t i) const { return first_ + 2 * static_cast<Index>(i); }
    double normal_force(std::size_t i) const { return force_[2 * static_cast<Index>(i)]; }
    double tangential_force(std::size_t i) const { return force_[2 * static_cast<Index>(i) + 1]; }
    int sign_of_sliding(const FrictionRows& c) const {
        if (c.tangent.size() == 0) return 0;
        const double sliding = c.tangent.dot(x_.head(n_)) + c.tangent_offset;
        const double size = c.tangent.cwiseAbs().dot(sizes_) + std::abs(c.tangent_offset);
        return std::abs(sliding) <= slack * size ? 0 : sliding > 0 ? 1 : -1;
    }

    const std::vector<FrictionRows>& contacts_;
    Index n_, m_, forces_;
    Index first_ = 0;                            ///< of the conditions of contacts among the rows of K_
    VectorXd base_;                              ///< (x⁺, Λ) without forces
    MatrixXd by_unknown_;                        ///< and their change with the unknowns
    std::vector<RowVectorXd> normal_, tangent_;  ///< g and w in the unknowns
    MatrixXd K_;
    VectorXd right_, x_, force_;
    VectorXd sizes_;  ///< the sum of the sizes of the terms of x⁺
    bool has_many_ = false;
};

/// The modes that a contact may have, those without sliding first; with those at the static bound if `held`.
std::vector<RoughMode> modes_of(const FrictionRows& contact, bool held) {
    if (contact.tangent.size() == 0) return {RoughMode::sticks, RoughMode::open};
    if (contact.side != 0)
        return {contact.side > 0 ? RoughMode::slides_up : RoughMode::slides_down, RoughMode::open};
    std::vector<RoughMode> modes{RoughMode::sticks, RoughMode::slides_up, RoughMode::slides_down, RoughMode::open};
    if (held && is_static(contact)) modes.insert(modes.end(), {RoughMode::held_up, RoughMode::held_down});
    return modes;
}

/// All choices of modes, without or only those with contacts at their static bounds.
void try_choices(RoughTrial& trial, const std::vector<FrictionRows>& contacts, bool held,
                 const std::function<void(bool solved, const std::vector<RoughMode>&)>& visit) {
    std::vector<std::vector<RoughMode>> kinds;
    std::size_t count = 1;
    for (const FrictionRows& contact : contacts) {
        kinds.push_back(modes_of(contact, held));
        count *= kinds.back().size();
    }
    for (std::size_t code = 0; code < count; ++code) {
        std::vector<RoughMode> modes;
        std::size_t rest = code;
        for (const auto& list : kinds) {
            modes.push_back(list[rest % list.size()]);
            rest /= list.size();
        }
        if (held && std::none_of(modes.begin(), modes.end(), is_held)) continue;
        visit(trial.solves(modes), modes);
    }
}

/// Does a contact slide from rest in `one` that sticks in `other`, where all that stick in `one` stick, too?
bool slides_too_early(const FrictionMode& one, const FrictionMode& other,
                      const std::vector<FrictionRows>& contacts) {
    bool any = false;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (!is_static(contacts[i])) continue;
        const bool sticks = other.closed[i] && other.moves[i] == 0;
        if (one.closed[i] && one.moves[i] == 0 && !sticks) return false;
        any = any || (one.moves[i] != 0 && sticks);
    }
    return any;
}

}  // namespace

FrictionModes consistent_friction_modes(const MatrixXd& M, const VectorXd& momentum, const MatrixXd& A,
                                        const VectorXd& b, const std::vector<FrictionRows>& contacts) {
    FrictionModes all;
    if (contacts.size() > most_contacts_with_friction) return all;
    all.is_complete = true;
    RoughTrial trial(M, momentum, A, b, contacts);
    struct Found {
        FrictionMode choice;
        bool clear;  ///< whether rounding could not spoil it
    };
    std::vector<Found> consistent;
    const auto visit = [&](bool solved, const std::vector<RoughMode>& modes) {
        all.is_complete = all.is_complete && !trial.has_many();
        if (solved && trial.is_consistent(modes, RoughTrial::Judged::loosely))
            consistent.push_back({trial.result(modes), trial.is_consistent(modes, RoughTrial::Judged::clearly)});
    };
    try_choices(trial, contacts, false, visit);
    if (!all.is_complete && std::any_of(contacts.begin(), contacts.end(), is_static))
        try_choices(trial, contacts, true, visit);

    const auto energy = [&](const VectorXd& rates) { return rates.dot(M * rates); };
    const double before = std::abs(momentum.dot(least_norm(M, momentum).x.col(0)));
    std::vector<bool> clear;
    for (const Found& found : consistent) {
        if (std::any_of(consistent.begin(), consistent.end(), [&](const Found& other) {
                return slides_too_early(found.choice, other.choice, contacts);
            }))
            continue;
        const VectorXd& after = found.choice.after;
        const auto same = std::find_if(all.different.begin(), all.different.end(), [&](const FrictionMode& other) {
            return energy(after - other.after) <= alike * (before + energy(after) + energy(other.after));
        });
        if (same != all.different.end()) {
            const auto at = static_cast<std::size_t>(same - all.different.begin());
            clear[at] = clear[at] || found.clear;
        } else {
            all.different.push_back(found.choice);
            clear.push_back(found.clear);
        }
    }
    // Beside a choice that is clear, one that rounding may have made consistent is none. Where none is clear, the
    // state is at the limit between choices within its rounding, and each of them is a right one.
    if (all.different.size() > 1 && std::count(clear.begin(), clear.end(), true) < 2) {
        const auto first = std::find(clear.begin(), clear.end(), true);
        all.different = {
            all.different[first == clear.end() ? 0 : static_cast<std::size_t>(first - clear.begin())]};
    }
    return all;
}

}  // namespace alembert
