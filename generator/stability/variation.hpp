// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations of motion with their variational equations: x' = f(t, x), Φ' = ∂f/∂x Φ.
///
///     const Variation<Quad> f(*differentiated(program), parameters);
///     std::vector<Quad> y = …;                      // x, then the columns of Φ
///     f(t, y.data(), rate.data(), columns);
///
/// x are the coordinates, then the speeds. With constraints f keeps them, and Φ keeps its columns in the tangent
/// space if they begin there.

#include "program/differentiate.hpp"
#include "program/tape.hpp"

namespace alembert {

template <typename Real>
class Variation {
public:
    Variation(const Program& program, const std::vector<Real>& parameters)
        : n_(program.coordinates.size()),
          rates_(program.nodes_of(Group::rate).size()),
          size_(n_ + program.nodes_of(Group::acceleration).size()),
          tape_(program, wanted(program), parameters),
          out_(wanted(program).size()) {}

    std::size_t size() const { return size_; }

    void operator()(Real t, const Real* y, Real* rate, std::size_t columns) const {
        const std::size_t N = size_;
        tape_(t, y, y + n_, out_.data());
        for (std::size_t i = 0; i < N; ++i) rate[i] = rates_ > 0 ? out_[i] : i < n_ ? y[n_ + i] : out_[i - n_];
        const Real* const J = out_.data() + (rates_ > 0 ? N : N - n_);
        for (std::size_t c = 0; c < columns; ++c)
            for (std::size_t i = 0; i < N; ++i) {
                Real sum = 0;
                for (std::size_t k = 0; k < N; ++k) sum += J[i * N + k] * y[N + c * N + k];
                rate[N + c * N + i] = sum;
            }
    }

    std::vector<Real> rate_at(Real t, const std::vector<Real>& x) const {
        std::vector<Real> rate(size_);
        (*this)(t, x.data(), rate.data(), 0);
        return rate;
    }

private:
    static std::vector<int> wanted(const Program& program) {
        std::vector<int> result;
        for (const Group group : {Group::rate, Group::acceleration, Group::jacobian}) {
            const std::vector<int> nodes = program.nodes_of(group);
            result.insert(result.end(), nodes.begin(), nodes.end());
        }
        return result;
    }

    std::size_t n_, rates_, size_;
    mutable Tape<Real> tape_;
    mutable std::vector<Real> out_;
};

}  // namespace alembert
