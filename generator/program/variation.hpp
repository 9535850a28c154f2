// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations of motion with their variational equations: x' = f(t, x), Φ' = ∂f/∂x Φ.
///
///     const Variation<Quad> f(*differentiated(program), parameters);
///     std::vector<Quad> y = …;                      // x, then the columns of Φ
///     f(t, y.data(), rate.data(), columns);
///
/// A column c of Φ that is the derivative by a parameter p obeys Φ_c' = ∂f/∂x Φ_c + ∂f/∂p instead.
///
/// The adjoint equations carry a row w = ∂ψ/∂x back from the end T: with s = T − t,
///
///     dx/ds = −f,    dw/ds = w ∂f/∂x,    dg/ds = w ∂f/∂p;    at the start dψ = w δx + g δp
///
/// (Hairer, Nørsett & Wanner, Solving ODEs I, §I.14; Bryson & Ho, Applied Optimal Control (1975), §2.2).
///
/// x are the coordinates, then the speeds. With constraints f keeps them, and Φ keeps its columns in the tangent
/// space if they begin there.

#include <algorithm>

#include "program/differentiate.hpp"
#include "program/tape.hpp"

namespace alembert {

template <typename Real>
class Variation {
public:
    /// `by`: for each of the first columns the position of its parameter, or −1 if it is not one's. The program
    /// then has derivatives with respect to parameters.
    Variation(const Program& program, const std::vector<Real>& parameters, std::vector<int> by = {})
        : by_(std::move(by)),
          parameters_(program.parameters.size()),
          n_(program.coordinates.size()),
          rates_(program.nodes_of(Group::rate).size()),
          size_(n_ + program.nodes_of(Group::acceleration).size()),
          tape_(program, wanted(program, !by_.empty()), parameters),
          out_(tape_.size()) {}

    std::size_t size() const { return size_; }

    void operator()(Real t, const Real* y, Real* rate, std::size_t columns) const {
        const std::size_t N = size_;
        tape_(t, y, y + n_, out_.data());
        for (std::size_t i = 0; i < N; ++i) rate[i] = rates_ > 0 ? out_[i] : i < n_ ? y[n_ + i] : out_[i - n_];
        const Real *const J = jacobian(), *const P = J + N * N;
        for (std::size_t c = 0; c < columns; ++c)
            for (std::size_t i = 0; i < N; ++i) {
                Real sum =
                    c < by_.size() && by_[c] >= 0 ? P[i * parameters_ + static_cast<std::size_t>(by_[c])] : 0;
                for (std::size_t k = 0; k < N; ++k) sum += J[i * N + k] * y[N + c * N + k];
                rate[N + c * N + i] = sum;
            }
    }

    /// The adjoint equations at the time t. `y`: x; then, for each row, w and one entry of g for each of `by`,
    /// which stays 0 where that is no parameter.
    void backwards(Real t, const Real* y, Real* rate, std::size_t rows) const {
        const std::size_t N = size_, width = N + by_.size();
        (*this)(t, y, rate, 0);
        for (std::size_t i = 0; i < N; ++i) rate[i] = -rate[i];
        const Real* const J = jacobian();
        const Real* const P = J + N * N;
        for (std::size_t r = 0; r < rows; ++r) {
            const Real* const w = y + N + r * width;
            Real* const out = rate + N + r * width;
            std::fill(out, out + width, Real(0));
            for (std::size_t i = 0; i < N; ++i) {
                for (std::size_t k = 0; k < N; ++k) out[k] += w[i] * J[i * N + k];
                for (std::size_t c = 0; c < by_.size(); ++c)
                    if (by_[c] >= 0) out[N + c] += w[i] * P[i * parameters_ + static_cast<std::size_t>(by_[c])];
            }
        }
    }

    std::vector<Real> rate_at(Real t, const std::vector<Real>& x) const {
        std::vector<Real> rate(size_);
        (*this)(t, x.data(), rate.data(), 0);
        return rate;
    }

private:
    /// ∂f/∂x row by row, then ∂f/∂p, where the last evaluation left them.
    const Real* jacobian() const { return out_.data() + (rates_ > 0 ? size_ : size_ - n_); }

    static std::vector<int> wanted(const Program& program, bool by_parameters) {
        std::vector<int> result;
        for (const Group group : {Group::rate, Group::acceleration, Group::jacobian, Group::parameter_jacobian}) {
            if (group == Group::parameter_jacobian && !by_parameters) continue;
            const std::vector<int> nodes = program.nodes_of(group);
            result.insert(result.end(), nodes.begin(), nodes.end());
        }
        return result;
    }

    std::vector<int> by_;
    std::size_t parameters_, n_, rates_, size_;
    mutable Tape<Real> tape_;
    mutable std::vector<Real> out_;
};

}  // namespace alembert
