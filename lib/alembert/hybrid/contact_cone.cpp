// SPDX-License-Identifier: MIT
#include "alembert/hybrid/contact_cone.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "alembert/base/dense.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_sweeps = 100000;
// The change in a sweep, relative to the impulses, after which Newton's method takes over. Where it finds nothing
// consistent, the modes may have been read too early: then the next one.
constexpr std::array settled{1e-10, 1e-12, 1e-14};
constexpr double leeway = 1e-9;  // of inequalities, relative to the sizes of their terms
constexpr double same =
    1e-7;  // velocities that differ by less, relative to the sizes of their terms, are the same
constexpr int most_newton = 30;
constexpr double last_newton = 1e-15;  // its change, relative to the impulses, after which none follows

enum class ConeMode { open, sticks, slides };

/// The velocities v = v₀ + W p of all contacts, where p are their impulses: for each its normal one, then those
/// along the rows of its sliding velocity.
class Cones {
public:
    Cones(const MatrixXd& M, const VectorXd& momentum, const MatrixXd& A, const VectorXd& b,
          const std::vector<ContactCone>& contacts)
        : contacts_(contacts), n_(M.rows()), m_(A.rows()) {
        Index size = 0;
        for (const ContactCone& c : contacts) {
            first_.push_back(size);
            size += 1 + c.tangent.rows();
        }
        rows_.resize(size, n_);
        offset_.resize(size);
        for (std::size_t i = 0; i < contacts.size(); ++i) {
            const ContactCone& c = contacts[i];
            const Index at = first_[i], components = c.tangent.rows();
            rows_.row(at) = c.normal;
            offset_[at] = c.offset;
            if (components == 0) continue;
            rows_.middleRows(at + 1, components) = c.tangent;
            offset_.segment(at + 1, components) = c.tangent_offset;
        }
        MatrixXd K = MatrixXd::Zero(n_ + m_, n_ + m_), right = MatrixXd::Zero(n_ + m_, 1 + size);
        K.topLeftCorner(n_, n_) = M;
        K.topRightCorner(n_, m_) = -A.transpose();
        K.bottomLeftCorner(m_, n_) = A;
        right.block(0, 0, n_, 1) = momentum;
        right.block(n_, 0, m_, 1) = -b;
        right.block(0, 1, n_, size) = rows_.transpose();
        response_ = least_norm(K, right).x;
        W_ = rows_ * response_.block(0, 1, n_, size);
        free_ = rows_ * response_.block(0, 0, n_, 1) + offset_;
    }

    Index size() const { return offset_.size(); }
    Index at(std::size_t i) const { return first_[i]; }
    Index components(std::size_t i) const { return contacts_[i].tangent.rows(); }
    std::size_t count() const { return contacts_.size(); }
    const ContactCone& contact(std::size_t i) const { return contacts_[i]; }
    const MatrixXd& W() const { return W_; }

    VectorXd velocities(const VectorXd& p) const { return free_ + W_ * p; }
    /// x⁺, then Λ.
    VectorXd solution(const VectorXd& p) const { return response_.col(0) + response_.rightCols(size()) * p; }
    VectorXd after(const VectorXd& p) const { return solution(p).head(n_); }

    /// The sizes of the terms of the velocities, relative to which rounding is judged.
    VectorXd sizes(const VectorXd& p) const {
        return rows_.cwiseAbs() * after(p).cwiseAbs() + offset_.cwiseAbs() + (W_.cwiseAbs() * p.cwiseAbs());
    }

    /// Impulses that press all contacts more than any approach would.
    VectorXd large() const {
        VectorXd p = VectorXd::Zero(size());
        for (std::size_t i = 0; i < count(); ++i)
            if (W_(at(i), at(i)) > 0) p[at(i)] = 10 * free_.cwiseAbs().maxCoeff() / W_(at(i), at(i));
        return p;
    }

private:
    const std::vector<ContactCone>& contacts_;
    Index n_, m_;
    std::vector<Index> first_;
    MatrixXd rows_, response_, W_;
    VectorXd offset_, free_;
};

/// Projects the normal impulse of contact i; returns by how much that changes it.
double press(const Cones& cones, std::size_t i, VectorXd& p) {
    const Index at = cones.at(i);
    const double stiffness = cones.W()(at, at);
    if (!(stiffness > 0)) return 0;
    const double pressed = std::max(0.0, p[at] - cones.velocities(p)[at] / stiffness);
    return std::abs(std::exchange(p[at], pressed) - pressed);
}

/// The same with its tangential impulse, for this normal one.
double rub(const Cones& cones, std::size_t i, double coefficient, VectorXd& p) {
    const Index at = cones.at(i), components = cones.components(i);
    const double stiffness = cones.W().block(at + 1, at + 1, components, components).trace();
    VectorXd along = p.segment(at + 1, components);
    if (stiffness > 0) along -= cones.velocities(p).segment(at + 1, components) / stiffness;
    const double radius = coefficient * p[at];
    if (along.norm() > radius) along *= radius > 0 ? radius / along.norm() : 0;
    const double change = (along - p.segment(at + 1, components)).norm();
    p.segment(at + 1, components) = along;
    return change;
}

/// Projects until a sweep changes the impulses by less than `enough` of the largest; the radii of the cones are
/// `coefficient` of each contact times π. Nothing if that does not settle.
std::optional<VectorXd> projected(const Cones& cones, const std::vector<double>& coefficient, VectorXd p,
                                  double enough) {
    for (std::size_t i = 0; i < cones.count(); ++i) rub(cones, i, coefficient[i], p);
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        double change = 0;
        for (std::size_t i = 0; i < cones.count(); ++i) {
            change = std::max(change, press(cones, i, p));
            change = std::max(change, rub(cones, i, coefficient[i], p));
        }
        if (!p.allFinite()) return std::nullopt;
        if (change <= enough * p.cwiseAbs().maxCoeff()) return p;
    }
    return std::nullopt;
}

std::vector<ConeMode> modes_of(const Cones& cones, const std::vector<double>& coefficient, const VectorXd& p) {
    const VectorXd v = cones.velocities(p), sizes = cones.sizes(p);
    const double largest = p.cwiseAbs().maxCoeff();
    std::vector<ConeMode> modes;
    for (std::size_t i = 0; i < cones.count(); ++i) {
        const Index at = cones.at(i), components = cones.components(i);
        if (p[at] <= leeway * largest) {
            modes.push_back(ConeMode::open);
            continue;
        }
        const double radius = coefficient[i] * p[at];
        const bool moves = components > 0 && v.segment(at + 1, components).norm() >
                                                 leeway * sizes.segment(at + 1, components).maxCoeff();
        const bool is_full = components > 0 && p.segment(at + 1, components).norm() >= (1 - leeway) * radius;
        modes.push_back(moves && is_full ? ConeMode::slides : ConeMode::sticks);
    }
    return modes;
}

/// Solves the equations of the modes by Newton's method from p.
VectorXd polished(const Cones& cones, const std::vector<ConeMode>& modes, VectorXd p) {
    const MatrixXd& W = cones.W();
    for (std::size_t i = 0; i < cones.count(); ++i)
        if (modes[i] == ConeMode::open) p.segment(cones.at(i), 1 + cones.components(i)).setZero();
    for (int step = 0; step < most_newton; ++step) {
        const VectorXd v = cones.velocities(p);
        VectorXd residual = p;
        MatrixXd slope = MatrixXd::Identity(cones.size(), cones.size());
        for (std::size_t i = 0; i < cones.count(); ++i) {
            if (modes[i] == ConeMode::open) continue;
            const Index at = cones.at(i), components = cones.components(i);
            residual[at] = v[at];
            slope.row(at) = W.row(at);
            if (components == 0) continue;
            const auto moving = W.middleRows(at + 1, components);
            const VectorXd sliding = v.segment(at + 1, components);
            if (modes[i] == ConeMode::sticks) {
                residual.segment(at + 1, components) = sliding;
                slope.middleRows(at + 1, components) = moving;
                continue;
            }
            const double speed = sliding.norm(), mu = cones.contact(i).coefficient;
            const VectorXd along = sliding / speed;
            const MatrixXd turning =
                (MatrixXd::Identity(components, components) - along * along.transpose()) / speed;
            residual.segment(at + 1, components) += mu * p[at] * along;
            slope.middleRows(at + 1, components) += mu * p[at] * turning * moving;
            slope.block(at + 1, at, components, 1) += mu * along;
        }
        VectorXd change = least_norm(slope, residual).x.col(0);
        for (std::size_t i = 0; i < cones.count(); ++i)
            if (modes[i] == ConeMode::open) change.segment(cones.at(i), 1 + cones.components(i)).setZero();
        p -= change;
        if (!p.allFinite() || change.norm() <= last_newton * p.norm()) break;
    }
    return p;
}

bool is_consistent(const Cones& cones, const std::vector<ConeMode>& modes, const VectorXd& p) {
    if (!p.allFinite()) return false;
    const VectorXd v = cones.velocities(p), sizes = cones.sizes(p);
    const double largest = p.cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < cones.count(); ++i) {
        const Index at = cones.at(i), components = cones.components(i);
        if (v[at] < -leeway * sizes[at] || p[at] < -leeway * largest) return false;
        if (modes[i] != ConeMode::open && v[at] > leeway * sizes[at]) return false;
        if (modes[i] == ConeMode::open || components == 0) continue;
        const auto sliding = v.segment(at + 1, components), along = p.segment(at + 1, components);
        const double size = sizes.segment(at + 1, components).maxCoeff();
        if (modes[i] == ConeMode::sticks) {
            if (sliding.norm() > leeway * size ||
                along.norm() > cones.contact(i).resting * p[at] + leeway * largest)
                return false;
        } else if ((along + cones.contact(i).coefficient * p[at] * sliding / sliding.norm()).norm() >
                   leeway * largest) {
            return false;
        }
    }
    return true;
}

struct Solution {
    enum class Kind { found, inconsistent, unsettled } kind;
    VectorXd p = {};
};

/// What slides under the static coefficient has the kinetic one; what then sticks stays so.
Solution solved(const Cones& cones, const VectorXd& first) {
    std::vector<double> coefficient;
    for (std::size_t i = 0; i < cones.count(); ++i) coefficient.push_back(cones.contact(i).resting);
    VectorXd p = first;
    for (std::size_t step = 0; step < settled.size();) {
        const std::optional<VectorXd> next = projected(cones, coefficient, p, settled[step]);
        if (!next) return {.kind = Solution::Kind::unsettled};
        p = *next;
        const std::vector<ConeMode> modes = modes_of(cones, coefficient, p);
        bool changed = false;
        for (std::size_t i = 0; i < cones.count(); ++i)
            if (modes[i] == ConeMode::slides && coefficient[i] != cones.contact(i).coefficient) {
                coefficient[i] = cones.contact(i).coefficient;
                changed = true;
            }
        if (changed) {
            p = first;
            step = 0;
            continue;
        }
        const VectorXd exact = polished(cones, modes, p);
        if (is_consistent(cones, modes, exact)) return {.kind = Solution::Kind::found, .p = exact};
        ++step;
    }
    return {.kind = Solution::Kind::inconsistent};
}

/// The power of two that is nearest to the largest mass. Impulses in units of it are as large as velocities.
double unit_of(const MatrixXd& M) {
    const double largest = M.diagonal().maxCoeff();
    return largest > 0 && std::isfinite(largest) ? std::ldexp(1.0, std::ilogb(largest)) : 1;
}

/// Whether the contacts, and with them all rates, have the same velocities after either impulses.
bool are_same(const Cones& cones, const VectorXd& p, const VectorXd& other) {
    const VectorXd difference = (cones.velocities(other) - cones.velocities(p)).cwiseAbs();
    return (difference.array() <= same * cones.sizes(p).array()).all();
}

}  // namespace

ConeChoice choose_in_cones(const MatrixXd& M, const VectorXd& momentum, const MatrixXd& A, const VectorXd& b,
                           const std::vector<ContactCone>& contacts) {
    const double unit = unit_of(M);
    const Cones cones(M / unit, momentum / unit, A, b, contacts);
    const Solution found = solved(cones, VectorXd::Zero(cones.size()));
    const auto failed = [](const char* why) {
        return ConeChoice{.failure = why, .after = {}, .normal = {}, .tangential = {}, .bilateral = {}};
    };
    if (found.kind == Solution::Kind::unsettled)
        return failed(
            "the impulses of their impact together do not settle, so that it is not known which result it has; "
            "smaller coefficients of friction, or contacts that strike one after the other, may have one");
    if (found.kind == Solution::Kind::inconsistent) return failed(no_choice_is_consistent);
    const VectorXd& p = found.p;
    const Solution other = solved(cones, cones.large());
    if (other.kind == Solution::Kind::found && !are_same(cones, p, other.p))
        return failed(several_choices_are_consistent);
    ConeChoice result{.failure = {},
                      .after = cones.after(p),
                      .normal = VectorXd(static_cast<Index>(contacts.size())),
                      .tangential = {},
                      .bilateral = unit * cones.solution(p).tail(A.rows())};
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        result.normal[static_cast<Index>(i)] = unit * std::max(0.0, p[cones.at(i)]);
        result.tangential.push_back(unit * p.segment(cones.at(i) + 1, cones.components(i)));
    }
    return result;
}

}  // namespace alembert
