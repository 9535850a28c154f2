// SPDX-License-Identifier: GPL-2.0-or-later
// x = k π/2 + r with k rounded by adding a large number, |r| ≤ π/4, and the polynomials of
// alembert/native/simd_math.hpp; k mod 4 says which goes where (Cody & Waite, Software Manual for the Elementary
// Functions (1980), ch. 8).
#include "codegen/machine/pack_sines.hpp"

#include <cmath>

#include "alembert/native/simd_math.hpp"

namespace alembert::machine {

namespace {

using Kind = Line::Kind;

int unary(const LineMaker& make, Kind kind, int a, int bits = 0) {
    return make.add({.kind = kind, .of = {a, -1, -1}, .place = bits});
}

int binary(const LineMaker& make, Kind kind, int a, int b) {
    return make.add({.kind = kind, .of = {a, b, -1}});
}

/// c + a b, or c − a b
int fused(const LineMaker& make, int a, int b, int c, bool minus = false) {
    return make.add({.kind = Kind::fused, .of = {a, b, c}, .minus_product = minus});
}

int polynomial(const LineMaker& make, const double (&c)[6], int z, int zz) {
    const auto line = [&](int k) {
        return fused(make, make.number(std::abs(c[k + 1])), z, make.number(c[k]), c[k + 1] < 0);
    };
    const int low = line(0), middle = line(2), high = line(4);
    return fused(make, zz, fused(make, zz, high, middle), low);
}

}  // namespace

std::array<int, 2> sine_and_cosine_inside(const LineMaker& make, int x) {
    const int shift = make.number(rounding_shift),
              shifted = fused(make, x, make.number(quarters_per_radian), shift),
              turns = binary(make, Kind::subtract, shifted, shift), one = make.number(1);
    int r = x;
    for (const double part : quarter_turn) r = fused(make, turns, make.number(part), r, true);
    const int z = binary(make, Kind::multiply, r, r), zz = binary(make, Kind::multiply, z, z);
    const int P = polynomial(make, sine_coefficients, z, zz), Q = polynomial(make, cosine_coefficients, z, zz);
    const int s = binary(make, Kind::multiply, r, fused(make, z, P, one, true)),
              c = fused(make, zz, Q, fused(make, make.number(0.5), z, one, true));
    // The lowest bit of the number of quarter turns says whether sine and cosine change places, the next one the
    // sign.
    const int bit = unary(make, Kind::shift_left, shifted, 63),
              odd = make.lanes == 4 ? bit : unary(make, Kind::shift_right, bit, 63);
    const auto placed = [&](int even, int other, int quarters) {
        const int value = make.add({.kind = Kind::select, .of = {even, other, odd}});
        return binary(make, Kind::turn_sign, value, unary(make, Kind::shift_left, quarters, 62));
    };
    return {placed(s, c, shifted), placed(c, s, binary(make, Kind::add, shifted, one))};
}

}  // namespace alembert::machine
