// SPDX-License-Identifier: MIT
//
// With M = L Lᵀ and x = Lᵀ q' the metric is Euclidean; Â and Ĝ are the rows in terms of x. Bilateral rows: the
// nearest x with Â x = −b. Contacts: x changes by y with Â y = 0 and the least |y| such that Ĝ y ≥ h. This is a
// least-distance problem, solved by non-negative least squares: min |E u − f|, u ≥ 0, E = [Ĝᵀ; hᵀ], f = (0 … 0 1)ᵀ
// (Lawson & Hanson, Solving Least Squares Problems (1974), ch. 23, algorithms NNLS and LDP). Its remainder
// vanishes if and only if no y exists.
#include "alembert/hybrid/frictionless_impact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "alembert/base/dense.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double dependent = 1e-10;           // for rows of length 1
constexpr double grain_of_sum = 1e-12;        // rounding of a sum, relative to the size of its terms
constexpr double rest = 1e-9;                 // relative to the same size: speeds below it count as zero
constexpr double slow = rest / grain_of_sum;  // in units of that rounding: slower approaches do not bounce
// The most collisions in one instant; in a thin wedge there are π divided by its angle.
constexpr int most_elastic = 1000;
constexpr int most_collisions = 2 * most_elastic;

Orthogonal decomposed(const MatrixXd& matrix) {
    return {matrix, dependent};
}

bool is_definite(const MatrixXd& mass) {
    const VectorXd diagonal = mass.diagonal();
    if (!(diagonal.minCoeff() > 0)) return false;
    const VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
    const VectorXd values = eigenpairs(scale.asDiagonal() * mass * scale.asDiagonal()).values;
    return values.minCoeff() > 1e-13 * values.maxCoeff();
}

/// M + s AᵀA, used if M itself is not definite. The addition affects only directions that the constraints fix
/// anyway: Λ changes by s A (q'⁺ − q'⁻), and the rates stay the same.
struct Stiffened {
    MatrixXd M;
    double stiffening = 0;
};
Stiffened stiffened(const MatrixXd& mass, const MatrixXd& rows) {
    if (is_definite(mass) || !(rows.squaredNorm() > 0)) return {.M = mass};
    const double s = (mass.trace() > 0 ? mass.trace() : 1) / rows.squaredNorm();
    return {.M = mass + s * rows.transpose() * rows, .stiffening = s};
}

MatrixXd columns(const MatrixXd& E, const std::vector<Index>& chosen) {
    MatrixXd result(E.rows(), static_cast<Index>(chosen.size()));
    for (std::size_t i = 0; i < chosen.size(); ++i) result.col(static_cast<Index>(i)) = E.col(chosen[i]);
    return result;
}

/// min |E u − f| with u ≥ 0.
VectorXd non_negative_least_squares(const MatrixXd& E, const VectorXd& f) {
    VectorXd u = VectorXd::Zero(E.cols());
    std::vector<Index> passive;
    for (Index round = 0; round < 10 * (E.cols() + 1); ++round) {
        const VectorXd slope = E.transpose() * (f - E * u);
        Index best = -1;
        for (Index j = 0; j < E.cols(); ++j)
            if (std::find(passive.begin(), passive.end(), j) == passive.end() &&
                slope[j] > grain_of_sum * E.col(j).norm() && (best < 0 || slope[j] > slope[best]))
                best = j;
        if (best < 0) break;
        passive.push_back(best);
        while (!passive.empty()) {
            const VectorXd wish = decomposed(columns(E, passive)).solve(f);
            double part = 1;
            for (std::size_t i = 0; i < passive.size(); ++i)
                if (const double w = wish[static_cast<Index>(i)]; w <= 0)
                    part = std::min(part, u[passive[i]] / (u[passive[i]] - w));
            if (std::isnan(part)) part = 0;  // 0/0: the value was zero and stays zero
            std::vector<Index> kept;
            for (std::size_t i = 0; i < passive.size(); ++i) {
                const double w = wish[static_cast<Index>(i)], moved = u[passive[i]] + part * (w - u[passive[i]]);
                const bool stays = w > 0 || moved > grain_of_sum * std::abs(w);
                u[passive[i]] = stays ? moved : 0;
                if (stays) kept.push_back(passive[i]);
            }
            const bool done = kept.size() == passive.size();
            passive = std::move(kept);
            if (done) break;
        }
    }
    return u;
}

/// The least |Gᵀ u| such that G Gᵀ u ≥ h, u ≥ 0, complementary; or nothing if there is no such u. The rows of G
/// have length 1 or 0.
struct Push {
    bool exists = false;
    VectorXd u;
};
Push least_push(const MatrixXd& G, const VectorXd& h) {
    Push push{.exists = true, .u = VectorXd::Zero(G.rows())};
    const double scale = h.size() == 0 ? 0 : h.maxCoeff();
    if (!(scale > 0)) return push;
    MatrixXd E(G.cols() + 1, G.rows());
    E << G.transpose(), h.transpose() / scale;
    const VectorXd u = non_negative_least_squares(E, VectorXd::Unit(E.rows(), E.rows() - 1));
    const double left = 1 - h.dot(u) / scale;
    if (!(left > 1e-9)) return {};
    push.u = u * (scale / left);

    // All contacts at their bound share the load: the impulses are those of least norm, if none of these pulls.
    const VectorXd y = G.transpose() * push.u, slack = G * y - h;
    std::vector<Index> touching;
    for (Index k = 0; k < h.size(); ++k)
        if (push.u[k] > 0 || std::abs(slack[k]) <= rest * (std::abs(h[k]) + y.norm())) touching.push_back(k);
    const MatrixXd active = columns(G.transpose(), touching);
    VectorXd bounds(static_cast<Index>(touching.size()));
    for (std::size_t i = 0; i < touching.size(); ++i) bounds[static_cast<Index>(i)] = h[touching[i]];
    const VectorXd exact = decomposed(active.transpose()).solve(bounds);
    const VectorXd shared = decomposed(active).solve(exact);
    if ((active * shared - y).norm() > rest * y.norm() || shared.minCoeff() < -grain_of_sum * shared.norm())
        return push;
    push.u.setZero();
    for (std::size_t i = 0; i < touching.size(); ++i)
        push.u[touching[i]] = std::max(0.0, shared[static_cast<Index>(i)]);
    return push;
}

/// The rows in the metric of M; from those of the contacts, the directions that the bilateral rows forbid have
/// been removed.
struct Setting {
    Cholesky mass;
    Orthogonal bilateral;
    VectorXd bilateral_size;
    MatrixXd A, A_unit, G, G_free;
    VectorXd length;  ///< lengths of the rows of G_free before these were scaled to length 1

    Setting(const MatrixXd& M, const MatrixXd& rows, const MatrixXd& contacts) : mass(M) {
        const auto in_metric = [this](const MatrixXd& list) -> MatrixXd {
            return mass.solve_lower(list.transpose()).transpose();
        };
        A = in_metric(rows);
        G = in_metric(contacts);
        bilateral_size = A.rowwise().norm();
        A_unit = A;
        for (Index i = 0; i < A.rows(); ++i)
            if (bilateral_size[i] > 0) A_unit.row(i) /= bilateral_size[i];
        if (A.rows() > 0) bilateral = decomposed(A_unit);
        G_free = G;
        for (Index k = 0; k < G.rows(); ++k) G_free.row(k) -= bilateral_part(G.row(k).transpose()).transpose();
        length = G_free.rowwise().norm();
        for (Index k = 0; k < G.rows(); ++k) {
            if (length[k] <= dependent * G.row(k).norm()) length[k] = 0;
            if (length[k] > 0)
                G_free.row(k) /= length[k];
            else
                G_free.row(k).setZero();
        }
    }

    /// The part of a vector that lies in the span of the bilateral rows.
    VectorXd bilateral_part(const VectorXd& x) const {
        return A.rows() == 0 ? VectorXd(VectorXd::Zero(x.size())) : VectorXd(bilateral.solve(A_unit * x));
    }

    VectorXd unit_residual(const VectorXd& residual) const {
        VectorXd result = residual;
        for (Index i = 0; i < result.size(); ++i)
            if (bilateral_size[i] > 0) result[i] /= bilateral_size[i];
        return result;
    }
};

FrictionlessImpact failed(const char* why) {
    return {.failure = why, .after = {}, .bilateral = {}, .contact = {}, .stays_closed = {}};
}

bool is_finite(const RateRows& rows) {
    return rows.rows.allFinite() && rows.offset.allFinite();
}

/// The rows with n columns, also where there are none.
RateRows of_width(const RateRows& rows, Index n) {
    return rows.offset.size() > 0 ? rows : RateRows{MatrixXd(0, n), rows.offset};
}

/// One impact in the metric of M, in the order of the header: constraints, impulses, collisions.
class Blow {
public:
    Blow(const MatrixXd& mass, const Stiffened& stiff, RateRows bilateral, RateRows contacts,
         const VectorXd& restitution)
        : mass_(mass),
          stiffening_(stiff.stiffening),
          bilateral_(std::move(bilateral)),
          contacts_(std::move(contacts)),
          restitution_(restitution),
          s_(stiff.M, bilateral_.rows, contacts_.rows),
          result_{.failure = {},
                  .after = {},
                  .bilateral = VectorXd::Zero(m()),
                  .contact = VectorXd::Zero(k()),
                  .stays_closed = std::vector<bool>(static_cast<std::size_t>(k()))} {}

    FrictionlessImpact run(const VectorXd& before, const VectorXd& impulse) {
        const VectorXd x_before = s_.mass.upper(before), push = s_.mass.solve_lower(impulse);
        VectorXd x = x_before;
        if (!impose(x)) return failed("the constraints contradict each other");
        const VectorXd x_imposed = x;
        VectorXd next = x + push - s_.bilateral_part(push);
        find_grain(std::max(x.norm(), next.norm()));
        for (bool again = true; again;) {
            if (const char* const why = collide(x, next)) return failed(why);
            x = next;
            if (result_.collisions == 0)
                result_.work = impulse.dot(s_.mass.solve_upper(VectorXd(x_imposed + x))) / 2;
            again = false;
            for (Index i = 0; i < k(); ++i)
                again = again || (s_.length[i] > 0 && speed(i, x) < -4 * grain_ * s_.length[i]);
            result_.collisions += k() > 0;
            if (again && result_.collisions == most_collisions)
                return failed("the collisions at one instant do not come to an end");
        }
        result_.after = s_.mass.solve_upper(x);
        if (m() > 0) {  // Λ of least norm from the change of momentum that is still unexplained
            const VectorXd lacking = x - x_before - push - s_.G.transpose() * result_.contact;
            result_.bilateral = s_.unit_residual(decomposed(s_.A_unit.transpose()).solve(lacking)) -
                                stiffening_ * (bilateral_.rows * (result_.after - before));
        }
        for (Index i = 0; i < k(); ++i)
            result_.stays_closed[static_cast<std::size_t>(i)] = std::abs(speed(i, x)) <= rest * size(i);
        return std::move(result_);
    }

private:
    Index m() const { return bilateral_.offset.size(); }
    Index k() const { return contacts_.offset.size(); }
    double speed(Index i, const VectorXd& at) const {
        return s_.length[i] * s_.G_free.row(i).dot(at) + offset_[i];
    }
    /// Of the terms of a contact's speed.
    double size(Index i) const { return s_.G.row(i).norm() * largest_ + std::abs(contacts_.offset[i]); }

    /// Moves x to the nearest rates that obey the constraints; false if there are none.
    bool impose(VectorXd& x) {
        offset_ = contacts_.offset;
        if (m() == 0) return true;
        const VectorXd residual = s_.unit_residual(-bilateral_.offset - s_.A * x),
                       step = s_.bilateral.solve(residual);
        if ((s_.A_unit * step - residual).norm() > rest * (residual.norm() + x.norm())) return false;
        x += step;
        const VectorXd lost = s_.mass.solve_upper(step);
        result_.loss = lost.dot(mass_ * lost) / 2;
        offset_ += s_.G * s_.bilateral.solve(s_.unit_residual(-bilateral_.offset));
        return true;
    }

    void find_grain(double largest) {
        largest_ = largest;
        for (Index i = 0; i < k(); ++i)
            if (s_.length[i] > 0) grain_ = std::max(grain_, grain_of_sum * size(i) / s_.length[i]);
    }

    /// One collision of the contacts that rest or approach at x: `next`, the rates without it, becomes those after
    /// it. Gives the reason if there are none.
    const char* collide(const VectorXd& x, VectorXd& next) {
        std::vector<Index> meeting;
        VectorXd h(k()), approach(k()), e(k());
        for (Index i = 0; i < k(); ++i) {
            const bool rebounds = result_.collisions < most_elastic;
            approach[i] = speed(i, x);
            e[i] = rebounds && approach[i] < -slow * grain_ * s_.length[i] ? restitution_[i] : 0;
            if (approach[i] > grain_ * s_.length[i]) continue;
            h[i] = -speed(i, next) - e[i] * approach[i];
            if (s_.length[i] > 0) {
                h[i] /= s_.length[i];
                meeting.push_back(i);
            } else if (h[i] > rest * size(i)) {
                return "a contact closes at a speed that the constraints prescribe";
            }
        }
        const MatrixXd met = columns(s_.G_free.transpose(), meeting).transpose();
        Push given = least_push(met, h(meeting));
        if (!given.exists) {  // between two walls at rest rounding decides whether a solution exists, so bounds
                              // are relaxed
            for (const Index i : meeting) h[i] -= 2 * grain_;
            given = least_push(met, h(meeting));
        }
        if (!given.exists) return "no rates keep all contacts apart";
        for (std::size_t j = 0; j < meeting.size(); ++j) {
            const Index i = meeting[j];
            const double pi = given.u[static_cast<Index>(j)] / s_.length[i];
            result_.contact[i] += pi;
            result_.loss -= pi * (1 - e[i]) * std::min(0.0, approach[i]) / 2;
            next += s_.G_free.row(i).transpose() * (pi * s_.length[i]);
        }
        return nullptr;
    }

    const MatrixXd& mass_;
    const double stiffening_;
    const RateRows bilateral_, contacts_;
    const VectorXd& restitution_;
    const Setting s_;
    /// The bilateral part of G x is the same for all x once the constraints are imposed; where b = 0 it is zero
    /// without rounding. With it c gives the speeds from G_free.
    VectorXd offset_;
    double largest_ = 0;  ///< |x|
    double grain_ = 0;    ///< how large rounding may be, in the unit of |x|
    FrictionlessImpact result_;
};

}  // namespace

FrictionlessImpact strike(const MatrixXd& mass, const VectorXd& before, const VectorXd& impulse,
                          const RateRows& bilateral, const RateRows& contacts, const VectorXd& restitution) {
    const Index n = before.size();
    assert(mass.rows() == n && mass.cols() == n && impulse.size() == n);
    assert(bilateral.rows.rows() == bilateral.offset.size() && contacts.rows.rows() == contacts.offset.size());
    assert(restitution.size() == contacts.offset.size());
    if (!mass.allFinite() || !before.allFinite() || !impulse.allFinite() || !is_finite(bilateral) ||
        !is_finite(contacts) || !restitution.allFinite())
        return failed("a value is not finite");
    const RateRows rows = of_width(bilateral, n);
    const Stiffened stiff = stiffened(mass, rows.rows);
    if (!is_definite(stiff.M)) return failed("the mass matrix is singular");
    return Blow(mass, stiff, rows, of_width(contacts, n), restitution).run(before, impulse);
}

FrictionlessImpact press(const MatrixXd& mass, const VectorXd& force, const RateRows& bilateral,
                         const RateRows& contacts) {
    const Index k = contacts.offset.size();
    const VectorXd none = VectorXd::Zero(force.size());
    FrictionlessImpact result =
        strike(mass, none, force, bilateral, {MatrixXd(0, force.size()), VectorXd(0)}, VectorXd(0));
    if (!result || k == 0) return result;
    const auto [M, stiffening] = stiffened(mass, bilateral.rows);
    const Setting s(M, bilateral.rows, contacts.rows);
    const VectorXd x = s.mass.upper(result.after), pushed = s.mass.solve_lower(force);
    const VectorXd size = s.G.rowwise().norm() * std::max(x.norm(), pushed.norm()) + contacts.offset.cwiseAbs();
    VectorXd h = -(contacts.rows * result.after + contacts.offset);
    for (Index i = 0; i < k; ++i) {
        if (s.length[i] > 0)
            h[i] /= s.length[i];
        else if (h[i] > rest * size[i])
            return failed("the constraints prescribe that a contact closes");
        else
            h[i] = 0;
    }
    Push given = least_push(s.G_free, h);
    if (!given.exists)
        given = least_push(s.G_free, h - grain_of_sum * size.cwiseQuotient(s.length.cwiseMax(dependent)));
    if (!given.exists) return failed("no accelerations keep all contacts apart");
    result.contact = given.u.cwiseQuotient(s.length.cwiseMax(dependent));
    const VectorXd y = s.G_free.transpose() * given.u, lacking = y - s.G.transpose() * result.contact;
    const VectorXd gained = s.mass.solve_upper(y);
    result.after += gained;
    if (bilateral.offset.size() > 0)
        result.bilateral += s.unit_residual(decomposed(s.A_unit.transpose()).solve(lacking)) -
                            stiffening * (bilateral.rows * gained);
    result.stays_closed.resize(static_cast<std::size_t>(k));
    const VectorXd left = contacts.rows * result.after + contacts.offset;
    for (Index i = 0; i < k; ++i)
        result.stays_closed[static_cast<std::size_t>(i)] = std::abs(left[i]) <= rest * size[i];
    return result;
}

}  // namespace alembert
