// SPDX-License-Identifier: MIT
#include "alembert/rough_choice.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "alembert/dense.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double slack = 1e-9;   // of inequalities, relative to the sizes of their terms
constexpr double alike = 1e-14;  // the energy of a difference of rates, relative to theirs, that counts as none

enum class RoughMode { open, sticks, slides_up, slides_down };

/// The solution of the linear system of one choice of modes, and whether it is consistent.
class RoughTrial {
public:
    RoughTrial(const MatrixXd& M, const VectorXd& momentum, const MatrixXd& A, const VectorXd& b,
               const std::vector<RoughRows>& contacts)
        : contacts_(contacts), n_(M.rows()), m_(A.rows()) {
        const Index size = n_ + m_ + 2 * static_cast<Index>(contacts.size());
        K_ = MatrixXd::Zero(size, size);
        right_ = VectorXd::Zero(size);
        K_.topLeftCorner(n_, n_) = M;
        K_.block(0, n_, n_, m_) = -A.transpose();
        K_.block(n_, 0, m_, n_) = A;
        right_.head(n_) = momentum;
        right_.segment(n_, m_) = -b;
        for (std::size_t i = 0; i < contacts.size(); ++i) {
            K_.block(0, pressing(i), n_, 1) = -contacts[i].normal.transpose();
            if (contacts[i].slip.size() > 0) K_.block(0, pressing(i) + 1, n_, 1) = -contacts[i].slip.transpose();
        }
    }

    bool solves(const std::vector<RoughMode>& modes) {
        MatrixXd K = K_;
        VectorXd right = right_;
        for (std::size_t i = 0; i < modes.size(); ++i) {
            const RoughRows& c = contacts_[i];
            const Index row = pressing(i);
            if (modes[i] == RoughMode::open) {
                K(row, row) = K(row + 1, row + 1) = 1;
                continue;
            }
            K.block(row, 0, 1, n_) = c.normal;
            right[row] = -c.offset;
            if (c.slip.size() > 0 && modes[i] == RoughMode::sticks) {
                K.block(row + 1, 0, 1, n_) = c.slip;
                right[row + 1] = -c.slip_offset;
            } else {  // τ + μ s π = 0
                K(row + 1, row + 1) = 1;
                K(row + 1, row) = c.slip.size() > 0 ? c.coefficient * side(modes[i]) : 0;
            }
        }
        const LeastNorm found = least_norm(K, right);
        x_ = found.x.col(0);
        const double misfit = (K * x_ - right).cwiseAbs().maxCoeff();
        const bool fits = x_.allFinite() && misfit <= slack * (right.cwiseAbs().maxCoeff() +
                                                               K.cwiseAbs().maxCoeff() * x_.cwiseAbs().maxCoeff());
        has_many_ = fits && found.rank < K.rows();
        return fits && !has_many_;
    }

    /// Whether the last system had more than one solution.
    bool has_many() const { return has_many_; }

    /// Whether the conditions of the modes hold, up to rounding (Judged::loosely) or by more than rounding can
    /// spoil.
    enum class Judged { loosely, clearly };
    bool is_consistent(const std::vector<RoughMode>& modes, Judged judged) const {
        const double allowed = judged == Judged::loosely ? slack : -slack;
        const VectorXd after = x_.head(n_), sizes = after.cwiseAbs();
        const double force = x_.tail(x_.size() - n_ - m_).cwiseAbs().maxCoeff();
        for (std::size_t i = 0; i < modes.size(); ++i) {
            const RoughRows& c = contacts_[i];
            const double pi = x_[pressing(i)], tau = x_[pressing(i) + 1];
            const double gap = c.normal.dot(after) + c.offset,
                         gap_size = c.normal.cwiseAbs().dot(sizes) + std::abs(c.offset);
            if (modes[i] == RoughMode::open) {
                if (gap < -allowed * gap_size) return false;
                continue;
            }
            if (pi < -allowed * force) return false;
            if (c.slip.size() == 0) continue;
            const double slip = c.slip.dot(after) + c.slip_offset,
                         slip_size = c.slip.cwiseAbs().dot(sizes) + std::abs(c.slip_offset);
            if (modes[i] == RoughMode::sticks ? std::abs(tau) > c.resting * pi + allowed * force
                                              : c.side == 0 && side(modes[i]) * slip < -allowed * slip_size)
                return false;
        }
        return true;
    }

    /// Whether contact i sticks within μₛ, whatever the others need for their modes.
    bool is_held(std::size_t i) const {
        const double pi = x_[pressing(i)], tau = x_[pressing(i) + 1];
        return std::abs(tau) <=
               contacts_[i].resting * pi + slack * x_.tail(x_.size() - n_ - m_).cwiseAbs().maxCoeff();
    }

    RoughChoice result(const std::vector<RoughMode>& modes) const {
        const auto count = static_cast<Index>(modes.size());
        RoughChoice found{.after = x_.head(n_),
                          .normal = VectorXd(count),
                          .tangential = VectorXd(count),
                          .bilateral = x_.segment(n_, m_),
                          .closed = {},
                          .moves = {}};
        for (std::size_t i = 0; i < modes.size(); ++i) {
            found.normal[static_cast<Index>(i)] = std::max(0.0, x_[pressing(i)]);
            found.tangential[static_cast<Index>(i)] = x_[pressing(i) + 1];
            found.closed.push_back(modes[i] != RoughMode::open);
            const RoughRows& c = contacts_[i];
            found.moves.push_back(
                modes[i] != RoughMode::open && c.slip.size() > 0 &&
                std::abs(c.slip.dot(found.after) + c.slip_offset) >
                    slack * (c.slip.cwiseAbs().dot(found.after.cwiseAbs()) + std::abs(c.slip_offset)));
        }
        return found;
    }

private:
    Index pressing(std::size_t i) const { return n_ + m_ + 2 * static_cast<Index>(i); }
    static double side(RoughMode mode) { return mode == RoughMode::slides_up ? 1 : -1; }

    const std::vector<RoughRows>& contacts_;
    Index n_, m_;
    MatrixXd K_;
    VectorXd right_, x_;
    bool has_many_ = false;
};

/// Whether a contact slides from rest that would stick by its larger static coefficient.
bool slides_too_early(RoughTrial& trial, const std::vector<RoughRows>& contacts, std::vector<RoughMode> modes) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const bool slides = modes[i] == RoughMode::slides_up || modes[i] == RoughMode::slides_down;
        if (!slides || contacts[i].side != 0 || !(contacts[i].resting > contacts[i].coefficient)) continue;
        const RoughMode former = std::exchange(modes[i], RoughMode::sticks);
        if (trial.solves(modes) && trial.is_held(i)) return true;
        modes[i] = former;
    }
    return false;
}

/// The modes that a contact may have, those without sliding first.
std::vector<RoughMode> modes_of(const RoughRows& contact) {
    if (contact.slip.size() == 0) return {RoughMode::sticks, RoughMode::open};
    if (contact.side != 0)
        return {contact.side > 0 ? RoughMode::slides_up : RoughMode::slides_down, RoughMode::open};
    return {RoughMode::sticks, RoughMode::slides_up, RoughMode::slides_down, RoughMode::open};
}

/// Solves all choices of modes until `visit` returns false.
void try_choices(RoughTrial& trial, const std::vector<RoughRows>& contacts,
                 const std::function<bool(bool solved, const std::vector<RoughMode>&)>& visit) {
    std::vector<std::vector<RoughMode>> kinds;
    std::size_t count = 1;
    for (const RoughRows& contact : contacts) {
        kinds.push_back(modes_of(contact));
        count *= kinds.back().size();
    }
    for (std::size_t code = 0; code < count; ++code) {
        std::vector<RoughMode> modes;
        std::size_t rest = code;
        for (const auto& list : kinds) {
            modes.push_back(list[rest % list.size()]);
            rest /= list.size();
        }
        if (!visit(trial.solves(modes), modes)) return;
    }
}

}  // namespace

RoughChoices every_rough_choice(const MatrixXd& M, const VectorXd& momentum, const MatrixXd& A, const VectorXd& b,
                                const std::vector<RoughRows>& contacts) {
    RoughChoices all;
    if (contacts.size() > most_rough_contacts) return all;
    all.is_complete = true;
    RoughTrial trial(M, momentum, A, b, contacts);
    const auto energy = [&](const VectorXd& rates) { return rates.dot(M * rates); };
    const double before = std::abs(momentum.dot(least_norm(M, momentum).x.col(0)));
    std::vector<char> clear;  // of each choice, whether rounding could not spoil it
    try_choices(trial, contacts, [&](bool solved, const std::vector<RoughMode>& modes) {
        all.is_complete = all.is_complete && !trial.has_many();
        if (!solved || !trial.is_consistent(modes, RoughTrial::Judged::loosely)) return true;
        const char is_clear = trial.is_consistent(modes, RoughTrial::Judged::clearly) ? 1 : 0;
        RoughChoice found = trial.result(modes);
        if (slides_too_early(trial, contacts, modes)) return true;
        const auto same = std::find_if(all.different.begin(), all.different.end(), [&](const RoughChoice& other) {
            return energy(found.after - other.after) <=
                   alike * (before + energy(found.after) + energy(other.after));
        });
        if (same != all.different.end()) {
            clear[static_cast<std::size_t>(same - all.different.begin())] |= is_clear;
        } else {
            all.different.push_back(std::move(found));
            clear.push_back(is_clear);
        }
        return true;
    });
    // Beside a choice that is clear, one that rounding may have made consistent is none.
    if (all.different.size() > 1 && std::count(clear.begin(), clear.end(), 1) < 2) {
        const auto first = std::max_element(clear.begin(), clear.end());
        all.different = {all.different[static_cast<std::size_t>(first - clear.begin())]};
    }
    return all;
}

}  // namespace alembert
