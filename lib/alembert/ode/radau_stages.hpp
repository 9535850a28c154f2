// SPDX-License-Identifier: MIT
#pragma once

/// The stages of a step of Radau's methods (radau.hpp), and the sums over them that are made for each component:
/// what the decoupled systems have on their right, and what their solutions change. The number of stages is known
/// where a sum is compiled, and two components stand side by side.
///
///     RadauStages stages(6);                    // components
///     stages.take(radau_table(5));              // five stages, all zero
///     rhs(t + c[k] * h, state, stages.rate(k)); // for each of them
///     stages.find_sides(1 / h);                 // side(0): of the real system; side(2p + 1), side(2p + 2):
///                                               // real and imaginary parts of the complex system p
///     stages.correct();                         // Z += V · solutions
///
/// With F_k = f(t + c_k h, y + Z_k) the sides are V⁻¹(F − A⁻¹Z/h).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "alembert/native/registers.hpp"
#include "alembert/ode/radau_table.hpp"

namespace alembert {

class RadauStages {
    static constexpr int width = 2, most = 7;
    using Lane = RegisterOf<width>::Lane;
    struct alignas(width * sizeof(double)) Pair {
        double of[width] = {};
    };
    using Numbers = std::array<double, static_cast<std::size_t>(most* most)>;

public:
    explicit RadauStages(int size)
        : n_(size),
          blocks_((size + width - 1) / width),
          memory_(static_cast<std::size_t>(blocks_ * most * lists)) {}

    void take(const RadauTable& table) {
        s_ = table.stages;
        c_ = table.c.data();
        const auto copy = [&](const Eigen::MatrixXd& from, Numbers& to) {
            for (int k = 0; k < s_; ++k)
                for (int j = 0; j < s_; ++j) to[static_cast<std::size_t>(k * s_ + j)] = from(k, j);
        };
        copy(table.inverse, inverse_);
        copy(table.to_polynomial, to_polynomial_);
        copy(table.decoupling, back_);
        copy(table.coupling, forth_);
        std::copy_n(table.e.data(), s_, error_.begin());
    }

    double* change(int k) { return numbers(z_, k); }
    double* rate(int k) { return numbers(f_, k); }
    double* side(int m) { return numbers(side_, m); }
    double* solution(int m) { return numbers(solution_, m); }

    void find_sides(double per_step) {
        with_stages([&]<int s>() {
            for (int b = 0; b < blocks_; ++b) {
                Lane z[s], rest[s];
                for (int k = 0; k < s; ++k) z[k] = lane(z_, k, b);
                for (int k = 0; k < s; ++k) {
                    Lane sum;
                    weighted<s>(inverse_, k, z, sum);
                    rest[k] = lane(f_, k, b) - sum * per_step;
                }
                for (int m = 0; m < s; ++m) weighted<s>(back_, m, rest, lane(side_, m, b));
            }
        });
    }

    /// By what the change of each component is multiplied for the norm; 0 for those that do not count.
    double* scale() { return numbers(scale_, 0); }

    /// Adds what the solutions change to all stages and returns the largest change; infinite if one is not finite.
    double correct() {
        Lane largest{}, zero{};
        with_stages([&]<int s>() {
            for (int b = 0; b < blocks_; ++b) {
                const Lane unit = lane(scale_, 0, b);
                Lane solution[s];
                for (int m = 0; m < s; ++m) solution[m] = lane(solution_, m, b);
                for (int k = 0; k < s; ++k) {
                    Lane delta;
                    weighted<s>(forth_, k, solution, delta);
                    lane(z_, k, b) += delta;
                    Lane size = delta * unit;
                    zero += size * 0;
                    size = size > -size ? size : -size;
                    largest = size > largest ? size : largest;
                }
            }
        });
        return zero[0] + zero[1] == 0 ? std::max(largest[0], largest[1]) : HUGE_VAL;
    }

    /// Σ_k e_k Z_k, which with γ₀ h f(t, y) is the estimate before it is filtered.
    void find_error(double* out) {
        for (int i = 0; i < n_; ++i) {
            double sum = 0;
            for (int k = 0; k < s_; ++k) sum += error_[index(k)] * change(k)[i];
            out[i] = sum;
        }
    }

    /// All stages from the polynomial of the last step, which had `s` stages, at 1 + c_k ratio; or zero.
    void forecast(double ratio) {
        if (kept_stages_ == 0) {
            std::fill_n(&lane(z_, 0, 0), most * blocks_, Lane{});
            return;
        }
        for (int b = 0; b < blocks_; ++b) {
            Lane end;
            polynomial(last_, kept_stages_, b, 1, end);
            for (int k = 0; k < s_; ++k) {
                Lane ahead;
                polynomial(last_, kept_stages_, b, 1 + c_[k] * ratio, ahead);
                lane(z_, k, b) = ahead - end;
            }
        }
    }

    /// The polynomial of this step, θ (p₀ + p₁θ + …).
    void find_polynomial() {
        with_stages([&]<int s>() {
            for (int b = 0; b < blocks_; ++b) {
                Lane z[s];
                for (int k = 0; k < s; ++k) z[k] = lane(z_, k, b);
                for (int k = 0; k < s; ++k) weighted<s>(to_polynomial_, k, z, lane(kept_, k, b));
            }
        });
    }

    /// Its change of component i until θ.
    double between(int i, double theta) const {
        double sum = 0;
        for (int k = s_; k-- > 0;) sum = theta * (numbers(kept_, k)[i] + sum);
        return sum;
    }

    /// The polynomial of this step becomes that of the last.
    void advance() {
        std::swap(kept_, last_);
        kept_stages_ = s_;
    }

private:
    static constexpr int lists = 7;
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }

    std::size_t place(int list, int k, int b) const { return index((list * most + k) * blocks_ + b); }
    Lane& lane(int list, int k, int b) { return reinterpret_cast<Lane&>(memory_[place(list, k, b)]); }
    const Lane& lane(int list, int k, int b) const {
        return reinterpret_cast<const Lane&>(memory_[place(list, k, b)]);
    }
    double* numbers(int list, int k) { return memory_[place(list, k, 0)].of; }
    const double* numbers(int list, int k) const { return memory_[place(list, k, 0)].of; }

    /// Calls function<3>, function<5> or function<7>.
    template <class Function>
    void with_stages(Function function) {
        if (s_ == 3)
            function.template operator()<3>();
        else if (s_ == 5)
            function.template operator()<5>();
        else
            function.template operator()<7>();
    }

    /// Σ_j row_j x_j with a row of an s × s matrix.
    template <int s>
    [[gnu::always_inline]] static void weighted(const Numbers& matrix, int row, const Lane* x, Lane& out) {
        const double* const weights = matrix.data() + row * s;
        Lane sum = weights[0] * x[0];
#pragma GCC unroll 7
        for (int j = 1; j < s; ++j) sum += weights[j] * x[j];
        out = sum;
    }

    void polynomial(int list, int degree, int b, double theta, Lane& out) const {
        Lane sum{};
        for (int k = degree; k-- > 0;) sum = theta * (lane(list, k, b) + sum);
        out = sum;
    }

    int n_, blocks_, s_ = 0, kept_stages_ = 0;
    const double* c_ = nullptr;
    int kept_ = 4, last_ = 5;  ///< places of the lists in memory; these two are exchanged after a step
    static constexpr int z_ = 0, f_ = 1, side_ = 2, solution_ = 3, scale_ = 6;
    Numbers inverse_{}, to_polynomial_{}, back_{}, forth_{};
    std::array<double, most> error_{};
    std::vector<Pair> memory_;
};

}  // namespace alembert
