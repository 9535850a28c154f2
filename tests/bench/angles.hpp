// SPDX-License-Identifier: MIT
#pragma once

/// Angles on which sines.cpp tries the sines and cosines of emitted code.
///
///     const std::vector<double> first = hard_angles();         // each once
///     // and as many as wanted; the same chunk has the same angles always
///     fill_angles(chunk, angles);
///
/// Of a chunk, a fifth each: log-uniform from 1e-310 to 1e8; uniform to 1e8; within two turns; next to multiples
/// of π/2, where one of the two values is small and the reduction must keep its digits; and what is rare: next to
/// odd multiples of π/4 (the ends of the reduced interval), denormals, both sides of 1e8 and log-uniform from
/// there to 1.8e308. Either sign. Multiples of a part of a turn are rounded, then moved by up to two units in the
/// last place.

#include <cln/cln.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace alembert::bench {

inline constexpr double farthest = 1e8;  ///< to here the emitted code reduces angles itself
inline constexpr double infinity = std::numeric_limits<double>::infinity();

namespace detail {

inline double moved(double x, int units) {
    for (; units > 0; --units) x = std::nextafter(x, infinity);
    for (; units < 0; ++units) x = std::nextafter(x, -infinity);
    return x;
}

/// The doubles of up to 1e8 that are nearest to multiples of `part` for their size: m 2^e ≈ k part, where m/k runs
/// through the convergents of part/2^e and through the fractions between them.
inline void add_nearest(const cln::cl_R& part, std::vector<double>& angles) {
    const cln::cl_I end = cln::cl_I(1) << 53;
    for (int exponent = -55; exponent <= -26; ++exponent) {
        cln::cl_R rest = part / cln::expt(cln::cl_RA(2), exponent);
        cln::cl_I before = 1, m = cln::floor1(rest);
        while (m < end) {
            rest = 1 / (rest - cln::floor1(rest));
            const cln::cl_I a = cln::floor1(rest);
            for (cln::cl_I j = 0; j <= a && j < 40 && before + j * m < end; j = j + 1)
                angles.push_back(std::ldexp(static_cast<double>(cln::cl_I_to_long(before + j * m)), exponent));
            const cln::cl_I next = before + a * m;
            before = m;
            m = next;
        }
        angles.push_back(std::ldexp(static_cast<double>(cln::cl_I_to_long(before)), exponent));
    }
}

}  // namespace detail

/// Zeros, denormals, ends of ranges, infinities, NaN, doubles nearest to multiples of π/2 and π/4 and their
/// neighbours.
inline std::vector<double> hard_angles() {
    using limits = std::numeric_limits<double>;
    std::vector<double> positive{0,
                                 limits::denorm_min(),
                                 2 * limits::denorm_min(),
                                 1e-310,
                                 limits::min(),
                                 farthest,
                                 1e22,
                                 limits::max(),
                                 infinity,
                                 limits::quiet_NaN(),
                                 0x1.6ac5b262ca1ffp+849,  // of all doubles the nearest to a multiple of π/2
                                 45.553093477052,
                                 14461176.67027838};
    for (int exponent = -1074; exponent < 1024; ++exponent) positive.push_back(std::ldexp(1.0, exponent));
    const cln::cl_R pi = cln::pi(cln::float_format(120));
    detail::add_nearest(pi / 2, positive);
    detail::add_nearest(pi / 4, positive);
    std::vector<double> angles;
    for (const double x : positive)
        for (const int units : {-1, 0, 1})
            for (const int sign : {1, -1}) angles.push_back(sign * detail::moved(x, units));
    return angles;
}

inline void fill_angles(long chunk, std::span<double> angles) {
    std::mt19937_64 random(static_cast<unsigned long>(chunk) + 1);
    std::uniform_real_distribution<double> small(-310, 8), wide(0, farthest), near(0, 4 * M_PI), large(8, 308.25),
        half_turns(0, 7.8), denormal(0, 2.2250738585072014e-308);
    std::uniform_int_distribution<int> one_in(0, 1), units(-2, 2), kind(0, 4), rare(0, 3);
    const auto multiple = [&] {
        return std::floor(one_in(random) ? std::pow(10, half_turns(random)) : wide(random) / M_PI_2);
    };
    for (double& x : angles) {
        switch (kind(random)) {
            case 0:
                x = std::pow(10, small(random));
                break;
            case 1:
                x = wide(random);
                break;
            case 2:
                x = near(random);
                break;
            case 3:
                x = detail::moved(static_cast<double>(multiple() * (3.14159265358979323846264338327950288L / 2)),
                                  units(random));
                break;
            default:
                switch (rare(random)) {
                    case 0:
                        x = detail::moved(static_cast<double>((2 * std::floor(multiple() / 2) + 1) *
                                                              (3.14159265358979323846264338327950288L / 4)),
                                          units(random));
                        break;
                    case 1:
                        x = denormal(random);
                        break;
                    case 2:
                        x = farthest + (wide(random) - farthest / 2) * 1e-6;
                        break;
                    default:
                        x = std::min(std::pow(10, large(random)), std::numeric_limits<double>::max());
                }
        }
        if (one_in(random)) x = -x;
    }
}

}  // namespace alembert::bench
