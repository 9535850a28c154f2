// SPDX-License-Identifier: MIT
#pragma once

/// Numbers drawn at random, the same with every C++ library. The standard fixes what an engine gives, and leaves
/// to the library what a distribution makes of it.
///
///     std::mt19937_64 random(1);
///     const UniformReal<> away(-1, 1);
///     const double x = away(random);     // −1 ≤ x < 1
///     NormalReal normal;
///     const double y = normal(random);   // mean 0, variance 1

#include <cmath>
#include <random>

namespace alembert {

/// Evenly between two numbers, the second one excluded; takes one number of the engine.
template <typename Real = double>
class UniformReal {
public:
    UniformReal(Real low, Real high) : low_(low), width_(high - low) {}

    Real operator()(std::mt19937_64& random) const {
        const Real unit =
            static_cast<Real>(random()) * Real(0x1p-64);  // 1 where the engine's number is rounded up
        return (unit < 1 ? unit : Real(1) - Real(0x1p-53)) * width_ + low_;
    }

private:
    Real low_, width_;
};

/// With mean 0 and variance 1, two from each point of the unit disc (Marsaglia's polar method; Knuth, The Art of
/// Computer Programming 2, §3.4.1 C).
class NormalReal {
public:
    double operator()(std::mt19937_64& random) {
        if (has_other_) {
            has_other_ = false;
            return other_;
        }
        const UniformReal<> unit(0, 1);
        double x = 0, y = 0, square = 0;
        do {
            x = 2 * unit(random) - 1;
            y = 2 * unit(random) - 1;
            square = x * x + y * y;
        } while (square > 1 || square == 0);
        const double factor = std::sqrt(-2 * std::log(square) / square);
        has_other_ = true;
        other_ = x * factor;
        return y * factor;
    }

private:
    bool has_other_ = false;
    double other_ = 0;
};

}  // namespace alembert
