// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/critical.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "alembert/base/dense.hpp"
#include "alembert/base/random.hpp"
#include "base/language/say.hpp"
#include "stability/exact_field.hpp"
#include "stability/field.hpp"
#include "stability/linear/dense_long.hpp"

namespace alembert {

namespace {

using Side = RootOf::Side;
using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;

constexpr int highest_degree = 20;

Eigen::MatrixXcd inverse(const Eigen::MatrixXcd& A) {
    const LongComplexMatrix one = LongComplexMatrix::Identity(A.rows(), A.cols());
    return solve(LongComplexMatrix(A.cast<std::complex<long double>>()), one).cast<Complex>();
}

int count(const std::vector<RootOf>& roots, Side side) {
    return static_cast<int>(
        std::count_if(roots.begin(), roots.end(), [&](const RootOf& r) { return r.side == side; }));
}

Eigen::MatrixXd numbers(const RealBallMatrix& m) {
    Eigen::MatrixXd result(m.rows, m.columns);
    for (int i = 0; i < m.rows; ++i)
        for (int j = 0; j < m.columns; ++j) result(i, j) = m(i, j).number();
    return result;
}

/// Terms of degree two and three of a field, as symmetric forms.
class TaylorForms {
public:
    TaylorForms(const std::vector<Expansion>& F, const Monomials& monomials) {
        for (const Expansion& f : F) {
            terms_.emplace_back();
            for (int k = 0; k < monomials.size(); ++k) {
                const double c = f.coefficient(k).number();
                if (c == 0 || monomials.degree_of(k) < 2) continue;
                std::vector<int> list;
                for (int v = 0; v < monomials.variables(); ++v)
                    list.insert(list.end(), static_cast<std::size_t>(monomials.exponents(k)[v]), v);
                terms_.back().emplace_back(c, list);
            }
        }
    }
    /// The derivative of this order along the vectors.
    ComplexVector operator()(const std::vector<ComplexVector>& along) const {
        ComplexVector result = ComplexVector::Zero(static_cast<Eigen::Index>(terms_.size()));
        for (std::size_t i = 0; i < terms_.size(); ++i)
            for (const auto& [c, list] : terms_[i]) {
                if (list.size() != along.size()) continue;
                std::vector<std::size_t> order(list.size());
                for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
                do {
                    Complex product = c;
                    for (std::size_t k = 0; k < order.size(); ++k) product *= along[order[k]][list[k]];
                    result[static_cast<Eigen::Index>(i)] += product;
                } while (std::next_permutation(order.begin(), order.end()));
            }
        return result;
    }

    /// The sums of the sizes of the terms of this derivative: rounding is a small part of them.
    Eigen::VectorXd bound(const std::vector<Eigen::VectorXd>& along) const {
        std::vector<ComplexVector> sizes;
        for (const Eigen::VectorXd& vector : along) sizes.push_back(vector.cwiseAbs().cast<Complex>());
        TaylorForms positive = *this;
        for (auto& row : positive.terms_)
            for (auto& [c, list] : row) c = std::abs(c);
        return positive(sizes).real();
    }

private:
    std::vector<std::vector<std::pair<double, std::vector<int>>>> terms_;
};

}  // namespace

Decision one_zero_root(const Local& local, const std::vector<RootOf>& roots) {
    if (!local.cyclic_momenta.empty() || count(roots, Side::axis) != 1 ||
        count(roots, Side::left) + 1 != static_cast<int>(roots.size()))
        return {};
    const int n = local.A.rows;
    const auto right = null_space(local.A), left = null_space(transposed(local.A));
    if (!right || !left || right->columns != 1 || left->columns != 1) return {};
    int pinned = 0, outside = 0;
    for (int i = 0; i < n; ++i) {
        if (std::abs((*right)(i, 0).number()) > std::abs((*right)(pinned, 0).number())) pinned = i;
        if (std::abs((*left)(i, 0).number()) > std::abs((*left)(outside, 0).number())) outside = i;
    }
    RealBallMatrix bordered(n + 1, n + 1);
    RealBall scale = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) bordered(i, j) = local.A(i, j);
        scale += (*left)(i, 0) * (*right)(i, 0);
    }
    bordered(outside, n) = 1;
    bordered(n, pinned) = 1;
    const Monomials line(1, highest_degree);
    const Expansion c = Expansion::variable(line, 0, 0);
    std::vector<Expansion> x;
    for (int i = 0; i < n; ++i)
        x.push_back(Expansion(state_value(local, static_cast<std::size_t>(i))) + Expansion((*right)(i, 0)) * c);
    Expansion power = c;
    for (int order = 2; order <= highest_degree; ++order) {
        power = power * c;
        const std::vector<Expansion> F = field(local, x, order);
        RealBallMatrix known(n + 1, 1);
        for (int i = 0; i < n; ++i) known(i, 0) = -F[i].coefficient(order);
        const auto step = solution(bordered, known);
        if (!step) return {};
        const RealBall G = -(*step)(n, 0) * (*left)(outside, 0) / scale;
        if (!G.is_zero()) {
            if (!G.sign()) return {};
            const bool attracts = order % 2 == 1 && G.sign() == -1;
            return {attracts ? StabilityVerdict::asymptotically_stable : StabilityVerdict::unstable,
                    StabilityTheorem::one_zero_root,
                    say("one eigenvalue is zero and the others have negative real parts; along the critical "
                        "direction c' = {:.6g} c^{} + ...",
                        G.number(), order)};
        }
        for (int i = 0; i < n; ++i)
            if (!(*step)(i, 0).is_zero()) x[i] += Expansion((*step)(i, 0)) * power;
    }
    return {};
}

Decision pair_on_axis(const Local& local, const std::vector<RootOf>& roots) {
    const int n = local.A.rows;
    if (!local.cyclic_momenta.empty() || n > 8 || count(roots, Side::axis) != 2 ||
        count(roots, Side::left) + 2 != n)
        return {};
    const auto critical = std::find_if(roots.begin(), roots.end(),
                                       [](const RootOf& r) { return r.side == Side::axis && r.value.imag() > 0; });
    if (critical == roots.end()) return {};
    const double omega = critical->value.imag();
    const Monomials monomials(n, 3);
    std::vector<Expansion> x;
    for (int i = 0; i < n; ++i)
        x.push_back(Expansion::variable(monomials, i, state_value(local, static_cast<std::size_t>(i))));
    const TaylorForms form(field(local, x, 3), monomials);
    const Eigen::MatrixXcd A = numbers(local.A).cast<Complex>(), one = Eigen::MatrixXcd::Identity(n, n);
    const Complex i_omega(0, omega);
    const auto kernel = [&](const Eigen::MatrixXcd& m) {
        const LongComplexMatrix right = right_vectors(m.cast<std::complex<long double>>()).right;
        return ComplexVector(right.col(n - 1).cast<Complex>());
    };
    const ComplexVector q = kernel(A - i_omega * one), q_bar = q.conjugate();
    ComplexVector p = kernel(A.transpose() + i_omega * one);
    p /= std::conj(p.dot(q));  // dot conjugates its first argument: ⟨p, q⟩ = 1
    const Eigen::MatrixXcd twice = 2.0 * i_omega * one - A;
    const Eigen::MatrixXcd A_inverse = inverse(A), twice_inverse = inverse(twice);
    const ComplexVector first = A_inverse * form({q, q_bar}), second = twice_inverse * form({q, q});
    const double l1 =
        (p.dot(form({q, q, q_bar})) - 2.0 * p.dot(form({q, first})) + p.dot(form({q_bar, second}))).real() /
        (2 * omega);
    const Eigen::VectorXd large = q.cwiseAbs(), squares = form.bound({large, large});
    const Eigen::VectorXd size_of_first = A_inverse.cwiseAbs() * squares,
                          size_of_second = twice_inverse.cwiseAbs() * squares;
    const double size =
        p.cwiseAbs().dot(form.bound({large, large, large}) + 2 * form.bound({large, size_of_first}) +
                         form.bound({large, size_of_second})) /
        (2 * omega);
    if (!(std::abs(l1) > 1e-8 * size)) return {};
    return {l1 < 0 ? StabilityVerdict::asymptotically_stable : StabilityVerdict::unstable,
            StabilityTheorem::pair_on_axis,
            say("one pair of eigenvalues +-{:.8g}i is on the imaginary axis and the others have negative real "
                "parts; the first Lyapunov coefficient is {}",
                omega, l1 < 0 ? say("negative") : say("positive"))};
}

namespace {

/// Are there steady motions in all directions of the null space V of A? Proved in exact arithmetic: let some
/// speeds J be zero. If, whatever the rest of the state is, the rates of the essential coordinates are zero then,
/// and z′ of the forces along the p speeds, the others are p − z′ equations for the rest of the state, and steady
/// motions have (essential coordinates) − |J| + z′ parameters: the equations are independent if that many
/// eigenvalues are zero.
bool has_family(const Local& local, const Eigen::MatrixXd& V) {
    const std::size_t ne = local.essential.size();
    std::vector<std::size_t> still;
    for (std::size_t j = 0; j < local.split.u.size(); ++j)
        if (local.point.u[local.split.u[j]].is_zero() &&
            V.row(static_cast<Eigen::Index>(ne + j)).cwiseAbs().maxCoeff() < 1e-9)
            still.push_back(j);
    const std::vector<bool> balanced = ExactField(local.residuals, local.split).balanced_without(still);
    for (const int r : local.essential)
        if (!balanced[static_cast<std::size_t>(r)]) return false;
    const auto forces =
        std::count(balanced.begin() + static_cast<std::ptrdiff_t>(local.split.q.size()), balanced.end(), true);
    return static_cast<Eigen::Index>(ne) - static_cast<Eigen::Index>(still.size()) + forces == V.cols();
}

/// The same in numbers: Newton's method finds steady motions a small distance along some random null vectors,
/// which are combinations of the last columns of V, and a larger one, since a force such as x³¹ is nothing nearby.
/// Where nothing at all acts nearby, as in a dead zone, that is a family however short it is.
bool finds_family(const Local& local, const Eigen::MatrixXd& V, int zeros) {
    const int n = local.A.rows, p = static_cast<int>(local.split.u.size());
    const std::size_t ne = local.essential.size();
    const auto moved = [&](RealBallPoint at, const Eigen::VectorXd& by) {
        const auto shift = [](RealBall& x, double d) {
            x = RealBall::about(x.middle() + static_cast<Quad>(d), 0);
        };
        for (std::size_t k = 0; k < ne; ++k)
            shift(at.q[local.split.q[local.essential[k]]], by[static_cast<Eigen::Index>(k)]);
        for (int j = 0; j < p; ++j) shift(at.u[local.split.u[j]], by[static_cast<Eigen::Index>(ne) + j]);
        for (int round = 0; round < 30; ++round) {
            const RealBallTangent t = local.tangent_at(at);
            double largest_step = 0;
            const auto follow = [&](RealBall& x, const RealBall& d) {
                largest_step = std::max(largest_step, std::abs(d.number()));
                x = RealBall::about(x.middle() + d.middle(), 0);
            };
            for (std::size_t k = 0; k < local.split.q_dependent.size(); ++k)
                follow(at.q[local.split.q_dependent[k]], t.to_position[k]);
            for (std::size_t k = 0; k < local.split.u_dependent.size(); ++k)
                follow(at.u[local.split.u_dependent[k]], t.to_velocity[k]);
            if (largest_step < 1e-29) break;
        }
        return at;
    };
    const auto rate = [&](const RealBallTangent& t) {
        Eigen::VectorXd F(n);
        for (std::size_t k = 0; k < ne; ++k)
            F[static_cast<Eigen::Index>(k)] = t.coordinate_rates[local.split.q[local.essential[k]]].number();
        for (int j = 0; j < p; ++j) F[static_cast<Eigen::Index>(ne) + j] = t.speed_rates[j].number();
        return F;
    };
    const Eigen::MatrixXd across = V.leftCols(n - zeros);
    std::mt19937_64 random(15);
    NormalReal normal;
    bool acts_nearby = false;
    for (int k = 0; k < (zeros == 1 ? 1 : 2 * zeros); ++k)
        for (const double step : {0.05, -0.03, 0.5, -0.4}) {
            const bool is_near = std::abs(step) < 0.1;
            if (!is_near && !acts_nearby) continue;
            Eigen::VectorXd direction(zeros);
            for (double& one : direction) one = normal(random);
            RealBallPoint at = moved(local.point, step * V.rightCols(zeros) * direction.normalized());
            double residual = 1;
            for (int round = 0; round < 60 && residual > 1e-31; ++round) {
                const Eigen::VectorXd F = rate(local.tangent_at(at));
                residual = F.norm();
                acts_nearby = acts_nearby || (is_near && residual != 0);
                if (zeros == n) break;
                const Eigen::VectorXd y = least_norm(numbers(local.A) * across, -F).x;
                at = moved(at, across * y);
            }
            if (!(residual < 1e-30)) return false;
        }
    return true;
}

}  // namespace

Decision family_of_motions(const Local& local, const std::vector<RootOf>& roots, FamilyProof by) {
    const int n = local.A.rows;
    int zeros = 0;
    for (const RootOf& r : roots) {
        const bool zero = std::abs(r.value) + r.radius < 1e-9 && r.side != Side::left && r.side != Side::right;
        if (!zero && r.side != Side::left) return {};
        zeros += zero ? 1 : 0;
    }
    if (zeros == 0 || n == 0 || !local.cyclic_momenta.empty()) return {};
    const LongSingularValues svd = singular_values(LongMatrix(numbers(local.A).cast<long double>()));
    const long double largest = svd.values[0];
    if (zeros < n && svd.values[n - zeros - 1] < 1e-8L * largest) return {};
    if (svd.values[n - zeros] > 1e-12L * std::max(1.0L, largest)) return {};
    const Eigen::MatrixXd V = svd.right.cast<double>();
    const bool proved = by == FamilyProof::exact;
    if (!(proved ? has_family(local, V.rightCols(zeros)) : finds_family(local, V, zeros))) return {};
    return {StabilityVerdict::stable, StabilityTheorem::malkin,
            say("{} of the eigenvalues {} zero, as many as the steady motions near this one have parameters{}, "
                "and all others have negative real parts: disturbed motions tend to steady motions near this "
                "one",
                zeros, zeros == 1 ? "is" : "are",
                proved ? "" : say(" (found by Newton's method in several directions)")),
            proved ? std::vector<Assumption>()
                   : std::vector{Assumption{
                         Assumption::Kind::family,
                         say("the steady motions beside this one were found by Newton's method in several "
                             "directions; that there are as many as these zeros is not proved"),
                         false}}};
}

}  // namespace alembert
