// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/critical.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "alembert/dense.hpp"
#include "language/say.hpp"
#include "linear/dense_long.hpp"
#include "stability/field.hpp"

namespace alembert {

namespace {

using Side = RootOf::Side;
using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;

constexpr int highest_degree = 9;

bool applies(const Local& local) {
    return local.mechanism.constraints.empty() && local.residuals.rates_are_speeds && local.cyclic_momenta.empty();
}

int count(const std::vector<RootOf>& roots, Side side) {
    return static_cast<int>(
        std::count_if(roots.begin(), roots.end(), [&](const RootOf& r) { return r.side == side; }));
}

Eigen::MatrixXd numbers(const CertainMatrix& m) {
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

private:
    std::vector<std::vector<std::pair<double, std::vector<int>>>> terms_;
};

}  // namespace

Decision one_zero_root(const Local& local, const std::vector<RootOf>& roots) {
    if (!applies(local) || count(roots, Side::axis) != 1 ||
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
    CertainMatrix bordered(n + 1, n + 1);
    Certain scale = 0;
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
        const std::vector<Expansion> F = field(local, x);
        CertainMatrix known(n + 1, 1);
        for (int i = 0; i < n; ++i) known(i, 0) = -F[i].coefficient(order);
        const auto step = solution(bordered, known);
        if (!step) return {};
        const Certain G = -(*step)(n, 0) * (*left)(outside, 0) / scale;
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
    if (!applies(local) || n > 8 || count(roots, Side::axis) != 2 || count(roots, Side::left) + 2 != n) return {};
    const auto critical = std::find_if(roots.begin(), roots.end(),
                                       [](const RootOf& r) { return r.side == Side::axis && r.value.imag() > 0; });
    if (critical == roots.end()) return {};
    const double omega = critical->value.imag();
    const Monomials monomials(n, 3);
    std::vector<Expansion> x;
    for (int i = 0; i < n; ++i)
        x.push_back(Expansion::variable(monomials, i, state_value(local, static_cast<std::size_t>(i))));
    const TaylorForms form(field(local, x), monomials);
    const Eigen::MatrixXcd A = numbers(local.A).cast<Complex>(), one = Eigen::MatrixXcd::Identity(n, n);
    const Complex i_omega(0, omega);
    const auto kernel = [&](const Eigen::MatrixXcd& m) {
        const LongComplexMatrix right = right_vectors(m.cast<std::complex<long double>>()).right;
        return ComplexVector(right.col(n - 1).cast<Complex>());
    };
    const ComplexVector q = kernel(A - i_omega * one), q_bar = q.conjugate();
    ComplexVector p = kernel(A.transpose() + i_omega * one);
    p /= std::conj(p.dot(q));  // dot conjugates its first argument: ⟨p, q⟩ = 1
    const auto solved = [](const Eigen::MatrixXcd& m, const ComplexVector& right) {
        using Long = std::complex<long double>;
        const LongComplexMatrix A = m.cast<Long>(), b = right.cast<Long>(), x = solve(A, b);
        return ComplexVector(x.cast<Complex>());
    };
    const ComplexVector first = solved(A, form({q, q_bar})),
                        second = solved(2.0 * i_omega * one - A, form({q, q}));
    const Complex parts[] = {p.dot(form({q, q, q_bar})), -2.0 * p.dot(form({q, first})),
                             p.dot(form({q_bar, second}))};
    double l1 = 0, size = 0;
    for (const Complex& part : parts) {
        l1 += part.real() / (2 * omega);
        size += std::abs(part) / (2 * omega);
    }
    if (!(std::abs(l1) > 1e-8 * size)) return {};
    return {l1 < 0 ? StabilityVerdict::asymptotically_stable : StabilityVerdict::unstable,
            StabilityTheorem::pair_on_axis,
            say("one pair of eigenvalues +-{:.8g}i is on the imaginary axis and the others have negative real "
                "parts; the first Lyapunov coefficient is {}",
                omega, l1 < 0 ? say("negative") : say("positive"))};
}

Decision family_of_motions(const Local& local, const std::vector<RootOf>& roots) {
    const int n = local.A.rows;
    int zeros = 0;
    for (const RootOf& r : roots) {
        const bool zero = std::abs(r.value) + r.radius < 1e-9 && r.side != Side::left && r.side != Side::right;
        if (!zero && r.side != Side::left) return {};
        zeros += zero ? 1 : 0;
    }
    if (zeros == 0 || n == 0) return {};
    const LongSingularValues svd = singular_values(LongMatrix(numbers(local.A).cast<long double>()));
    const long double largest = svd.values[0];
    if (zeros < n && svd.values[n - zeros - 1] < 1e-8L * largest) return {};
    if (svd.values[n - zeros] > 1e-12L * std::max(1.0L, largest)) return {};
    const int p = static_cast<int>(local.split.u.size());
    if (!local.cyclic_momenta.empty()) return {};
    const Eigen::MatrixXd V = svd.right.cast<double>();
    const std::size_t ne = local.essential.size();
    const auto moved = [&](CertainPoint at, const Eigen::VectorXd& by) {
        const auto shift = [](Certain& x, double d) { x = Certain::about(x.middle() + static_cast<Quad>(d), 0); };
        for (std::size_t k = 0; k < ne; ++k)
            shift(at.q[local.split.q[local.essential[k]]], by[static_cast<Eigen::Index>(k)]);
        for (int j = 0; j < p; ++j) shift(at.u[local.split.u[j]], by[static_cast<Eigen::Index>(ne) + j]);
        for (int round = 0; round < 30; ++round) {
            const CertainTangent t = local.tangent_at(at);
            double largest_step = 0;
            const auto follow = [&](Certain& x, const Certain& d) {
                largest_step = std::max(largest_step, std::abs(d.number()));
                x = Certain::about(x.middle() + d.middle(), 0);
            };
            for (std::size_t k = 0; k < local.split.q_dependent.size(); ++k)
                follow(at.q[local.split.q_dependent[k]], t.to_position[k]);
            for (std::size_t k = 0; k < local.split.u_dependent.size(); ++k)
                follow(at.u[local.split.u_dependent[k]], t.to_velocity[k]);
            if (largest_step < 1e-29) break;
        }
        return at;
    };
    const auto rate = [&](const CertainTangent& t) {
        Eigen::VectorXd F(n);
        for (std::size_t k = 0; k < ne; ++k)
            F[static_cast<Eigen::Index>(k)] = t.coordinate_rates[local.split.q[local.essential[k]]].number();
        for (int j = 0; j < p; ++j) F[static_cast<Eigen::Index>(ne) + j] = t.speed_rates[j].number();
        return F;
    };
    const Eigen::MatrixXd across = V.leftCols(n - zeros);
    for (int k = 0; k < zeros; ++k)
        for (const double step : {0.05, -0.03}) {
            CertainPoint at = moved(local.point, step * V.col(n - zeros + k));
            double residual = 1;
            for (int round = 0; round < 60 && residual > 1e-24; ++round) {
                const Eigen::VectorXd F = rate(local.tangent_at(at));
                residual = F.norm();
                if (zeros == n) break;
                const Eigen::VectorXd y = least_norm(numbers(local.A) * across, -F).x;
                at = moved(at, across * y);
            }
            if (!(residual < 1e-22)) return {};
        }
    return {
        StabilityVerdict::stable, StabilityTheorem::malkin,
        say("{} of the eigenvalues {} zero, as many as the steady motions near this one have parameters (found "
            "by Newton's method along each), and all others have negative real parts: disturbed motions tend "
            "to steady motions near this one",
            zeros, zeros == 1 ? "is" : "are")};
}

}  // namespace alembert
