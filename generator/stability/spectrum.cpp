// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "alembert/base/interrupt.hpp"
#include "program/univariate.hpp"

namespace alembert {

namespace {

using Side = RootOf::Side;
using Rationals = Univariate<Rational>;

struct ComplexQuad {
    Quad re = 0, im = 0;
};
ComplexQuad operator+(ComplexQuad a, ComplexQuad b) {
    return {a.re + b.re, a.im + b.im};
}
ComplexQuad operator-(ComplexQuad a, ComplexQuad b) {
    return {a.re - b.re, a.im - b.im};
}
ComplexQuad operator*(ComplexQuad a, ComplexQuad b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
Quad square(ComplexQuad a) {
    return a.re * a.re + a.im * a.im;
}
Quad size(ComplexQuad a) {
    return sqrt(square(a));
}
ComplexQuad operator/(ComplexQuad a, ComplexQuad b) {
    const Quad n = square(b);
    return {(a.re * b.re + a.im * b.im) / n, (a.im * b.re - a.re * b.im) / n};
}

struct Disc {
    ComplexQuad centre;
    Quad radius = 0;
    int roots = 1;  ///< number of roots in the group of discs that touch this one
};

/// Factors with simple roots, each with its multiplicity (Yun 1976).
std::vector<std::pair<Rationals, int>> square_free(const Rationals& p) {
    using univariate::derivative, univariate::divisor, univariate::quotient;
    std::vector<std::pair<Rationals, int>> result;
    const Rationals slope = derivative(p);
    const Rationals common = divisor(p, slope);
    Rationals b = quotient(p, common), c = quotient(slope, common);
    for (int k = 1; b.size() > 1; ++k) {
        const Rationals d = univariate::difference(c, derivative(b));
        const Rationals a = d.empty() ? b : divisor(b, d);
        if (a.size() > 1) result.emplace_back(a, k);
        b = quotient(b, a);
        c = d.empty() ? d : quotient(d, a);
    }
    return result;
}

/// Highest power first.
RealBallVector certain(const Rationals& p) {
    return {p.rbegin(), p.rend()};
}

/// Aberth's iteration.
std::vector<ComplexQuad> approximate(const std::vector<Quad>& p) {
    const int n = static_cast<int>(p.size()) - 1;
    const auto with_slope = [&](ComplexQuad z) {
        ComplexQuad value{p[0], 0}, slope;
        for (int k = 1; k <= n; ++k) {
            slope = slope * z + value;
            value = value * z + ComplexQuad{p[k], 0};
        }
        return std::pair(value, slope);
    };
    double bound = 0;  // Fujiwara's
    for (int k = 1; k <= n; ++k)
        bound = std::max(bound, std::pow(std::abs(static_cast<double>(p[k] / p[0])), 1.0 / k));
    std::vector<ComplexQuad> z;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * M_PI * i / n + 0.4, r = std::max(bound, 1e-30) * (0.4 + 0.6 * (i + 1) / n);
        z.push_back({static_cast<Quad>(r * std::cos(angle)), static_cast<Quad>(r * std::sin(angle))});
    }
    for (int round = 0; round < 300; ++round) {
        bool moved = false;
        for (int i = 0; i < n; ++i) {
            ask_whether_wanted();
            const auto [value, slope] = with_slope(z[i]);
            if (square(value) == 0) continue;
            if (square(slope) == 0) {
                z[i] = z[i] + ComplexQuad{static_cast<Quad>(bound * 1e-3), static_cast<Quad>(bound * 1.7e-3)};
                continue;
            }
            const ComplexQuad newton = value / slope;
            ComplexQuad repulsion;
            for (int j = 0; j < n; ++j)
                if (const ComplexQuad d = z[i] - z[j]; j != i && square(d) > 0)
                    repulsion = repulsion + ComplexQuad{1, 0} / d;
            const ComplexQuad step = newton / (ComplexQuad{1, 0} - newton * repulsion);
            z[i] = z[i] - step;
            moved = moved || size(step) > static_cast<Quad>(1e-32) * (size(z[i]) + static_cast<Quad>(1e-60));
        }
        if (!moved) break;
    }
    for (ComplexQuad& x : z)  // a real root whose imaginary part is a rounding error
        if (abs(x.im) < static_cast<Quad>(1e-28) * abs(x.re)) x.im = 0;
    return z;
}

std::vector<Disc> discs_of(const RealBallVector& p) {
    const int n = static_cast<int>(p.size()) - 1;
    std::vector<Quad> middle;
    for (const RealBall& c : p) middle.push_back(c.middle());
    std::vector<Disc> result;
    const std::vector<ComplexQuad> z = approximate(middle);
    for (int i = 0; i < n; ++i) {
        ComplexQuad value{middle[0], 0};
        const Quad r = size(z[i]);
        Quad error = static_cast<Quad>(p[0].radius()), largest = abs(middle[0]);
        for (int k = 1; k <= n; ++k) {
            value = value * z[i] + ComplexQuad{middle[k], 0};
            error = error * r + static_cast<Quad>(p[k].radius());
            largest = largest * r + abs(middle[k]);
        }
        error += largest * static_cast<Quad>(8.0 * n * 2e-34);
        Quad product = abs(middle[0]) - static_cast<Quad>(p[0].radius());
        for (int j = 0; j < n; ++j)
            if (j != i) product *= size(z[i] - z[j]);
        const Quad radius = product > 0 ? n * (size(value) + error) / product * static_cast<Quad>(1 + 1e-9)
                                        : static_cast<Quad>(1e300);
        result.push_back({z[i], radius, 1});
    }
    // Discs that touch are a group; each gets a disc around the whole group.
    std::vector<int> group(static_cast<std::size_t>(n));
    std::iota(group.begin(), group.end(), 0);
    for (bool again = true; again;) {
        again = false;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                if (group[i] > group[j] &&
                    size(result[i].centre - result[j].centre) <= result[i].radius + result[j].radius) {
                    const int old = group[i];
                    for (int& g : group)
                        if (g == old) g = group[j];
                    again = true;
                }
    }
    std::vector<Disc> covered = result;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            if (i != j && group[i] == group[j]) {
                covered[i].radius =
                    std::max(covered[i].radius, size(result[i].centre - result[j].centre) + result[j].radius);
                ++covered[i].roots;
            }
    return covered;
}

/// If a disc contains one root of a real polynomial and meets the real axis, the root is real.
bool is_real(const Disc& disc) {
    return disc.roots == 1 && abs(disc.centre.im) <= disc.radius;
}

RootOf root(ComplexQuad centre, Quad radius, int multiplicity, Side side) {
    const double re = static_cast<double>(centre.re), im = static_cast<double>(centre.im);
    return {{re, im}, static_cast<double>(radius) + 2e-16 * std::hypot(re, im), multiplicity, side};
}

Side side_of(const ComplexQuad& centre, Quad radius) {
    return centre.re > radius ? Side::right : centre.re < -radius ? Side::left : Side::unclear;
}

void add_general(std::vector<RootOf>& result, const RealBallVector& p, int multiplicity) {
    for (const Disc& disc : discs_of(p)) {
        ComplexQuad centre = disc.centre;
        if (is_real(disc)) centre.im = 0;
        for (int k = 0; k < multiplicity; ++k)
            result.push_back(
                root(centre, disc.radius, multiplicity * disc.roots, side_of(disc.centre, disc.radius)));
    }
}

/// p(s) = e(s²).
void add_even(std::vector<RootOf>& result, const RealBallVector& p, int multiplicity) {
    RealBallVector e;
    for (std::size_t k = 0; k < p.size(); k += 2) e.push_back(p[k]);
    for (const Disc& disc : discs_of(e)) {
        const ComplexQuad u = disc.centre;
        const Quad size_u = size(u);
        const int times = multiplicity * disc.roots;
        ComplexQuad s;  // √u with a real part that is not negative
        s.re = sqrt((size_u + u.re) / 2 > 0 ? (size_u + u.re) / 2 : Quad(0));
        s.im = sqrt((size_u - u.re) / 2 > 0 ? (size_u - u.re) / 2 : Quad(0));
        if (u.im < 0) s.im = -s.im;
        Quad radius = size_u > disc.radius ? disc.radius / sqrt(size_u - disc.radius) : sqrt(size_u + disc.radius);
        Side side = Side::unclear;
        if (is_real(disc) && u.re < -disc.radius) {
            side = Side::axis;
            s.re = 0;
        } else if (size_u > disc.radius && s.re > radius) {
            side = Side::right;
            if (is_real(disc)) s.im = 0;
        }
        for (int k = 0; k < multiplicity; ++k) {
            result.push_back(root(s, radius, times, side));
            result.push_back(root({-s.re, -s.im}, radius, times, side == Side::right ? Side::left : side));
        }
    }
}

void add_exact(std::vector<RootOf>& result, const Rationals& p) {
    for (const auto& [factor, multiplicity] : square_free(p)) {
        Rationals mirrored = factor;
        for (std::size_t k = 1; k < mirrored.size(); k += 2) mirrored[k] = -mirrored[k];
        const Rationals even = univariate::divisor(factor, mirrored);
        const Rationals rest = univariate::quotient(factor, even);
        if (even.size() > 1) add_even(result, certain(even), multiplicity);
        if (rest.size() > 1) add_general(result, certain(rest), multiplicity);
    }
}

}  // namespace

bool precedes(const RootOf& a, const RootOf& b) {
    const auto place = [](const RootOf& root) {
        const bool is_rounding = std::abs(root.value.real()) <= 1e-15 * std::abs(root.value);
        return std::pair(is_rounding ? 0 : root.value.real(), root.value.imag());
    };
    return place(a) < place(b);
}

std::vector<RootOf> roots_of(RealBallVector p, bool even) {
    std::vector<RootOf> result;
    if (even)
        for (std::size_t k = 0; k < p.size(); ++k)
            if (k % 2 == 1) p[k] = 0;
    int zeros = 0;
    while (p.size() > 1 && p.back().is_zero()) {
        p.pop_back();
        ++zeros;
    }
    for (int k = 0; k < zeros; ++k) result.push_back({{0, 0}, 0, zeros, Side::axis});
    if (p.size() > 1) {
        Rationals exact;
        for (auto c = p.rbegin(); c != p.rend(); ++c)
            if (const auto r = c->rational()) exact.push_back(*r);
        if (exact.size() == p.size())
            add_exact(result, exact);
        else if (even)
            add_even(result, p, 1);
        else
            add_general(result, p, 1);
    }
    std::sort(result.begin(), result.end(), precedes);
    return result;
}

}  // namespace alembert
