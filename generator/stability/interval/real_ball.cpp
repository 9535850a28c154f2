// SPDX-License-Identifier: GPL-2.0-or-later
// Intervals by their middle and radius: Rump, Acta Numerica 19 (2010) 287, §6. A middle is rounded to 113 bits.
// The possible error is added to the radius, which is deliberately a little too large.
#include "stability/interval/real_ball.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>

#include <cmath>

#include "alembert/base/interrupt.hpp"

namespace alembert {

namespace {

// Relative rounding error; errors of elementary functions are a few times larger.
constexpr double unit = 2e-34;
constexpr double too_small = 1e-290;      // added to radii, which lose accuracy below this
constexpr std::uintptr_t longest = 4000;  // bits of a fraction
constexpr unsigned most_trials = 20000;   // divisors tried for square factors

double size(Quad x) {
    const double value = static_cast<double>(abs(x));
    return value * (1 + 1e-15);
}
RealBall rounded(Quad middle, double radius, double roundings = 1) {
    return RealBall::about(middle, radius * (1 + 1e-12) + roundings * unit * size(middle) + too_small);
}

/// n = s²·rest; no square factor was found in the rest.
std::pair<cln::cl_I, cln::cl_I> square_part(cln::cl_I n) {
    cln::cl_I s = 1, rest = 1, root;
    for (unsigned k = 2; k < most_trials && cln::cl_I(k) * k <= n; ++k) {
        int times = 0;
        while (cln::zerop(cln::mod(n, k))) {
            n = cln::exquo(n, k);
            ++times;
        }
        s = s * cln::expt_pos(cln::cl_I(k), times / 2 + 1);
        s = cln::exquo(s, k);
        if (times % 2 == 1) rest = rest * k;
    }
    if (cln::sqrtp(n, &root)) return {s * root, rest};
    return {s, rest * n};
}

}  // namespace

RealBall RealBall::about(Quad middle, double radius) {
    RealBall result;
    result.form_ = Form::interval;
    result.middle_ = is_finite(middle) ? middle : 0;
    result.radius_ = is_finite(middle) && radius >= 0 ? radius : 1e300;
    return result;
}

RealBall RealBall::root(const Rational& a, const Rational& b, const cln::cl_I& d) {
    RealBall result(a);
    if (!cln::zerop(b) && d == 1) result.a_ = a + b;
    if (!cln::zerop(b) && d != 1) {
        result.b_ = b;
        result.d_ = d;
    }
    return result.kept();
}

RealBall RealBall::pi_multiple(const Rational& a, const Rational& b) {
    RealBall result(a);
    result.b_ = b;
    if (!cln::zerop(b)) result.form_ = Form::pi;
    return result.kept();
}

RealBall RealBall::kept() const {
    const auto bits = [](const Rational& r) {
        return cln::integer_length(cln::numerator(r)) + cln::integer_length(cln::denominator(r));
    };
    return bits(a_) + bits(b_) + cln::integer_length(d_) > longest ? about(middle(), radius()) : *this;
}

std::optional<Rational> RealBall::rational() const {
    if (form_ == Form::root && cln::zerop(b_)) return a_;
    return {};
}

std::optional<Rational> RealBall::multiple_of_pi() const {
    if (form_ == Form::pi && cln::zerop(a_)) return b_;
    if (rational() && cln::zerop(a_)) return Rational(0);
    return {};
}

Quad RealBall::middle() const {
    if (form_ == Form::interval) return middle_;
    Quad result = quad_of(a_);
    if (!cln::zerop(b_)) result += quad_of(b_) * (form_ == Form::pi ? acos(Quad(-1)) : sqrt(quad_of(d_)));
    return result;
}

double RealBall::radius() const {
    if (form_ == Form::interval) return radius_;
    const double irrational =
        cln::zerop(b_) ? 0 : size(quad_of(b_)) * (form_ == Form::pi ? 4 : size(sqrt(quad_of(d_))));
    return 4 * unit * (size(quad_of(a_)) + irrational) + too_small;
}

std::optional<int> RealBall::sign() const {
    if (form_ == Form::root && cln::zerop(b_)) return cln::zerop(a_) ? 0 : cln::minusp(a_) ? -1 : 1;
    if (form_ == Form::root) {  // a + b√d has the sign of the larger part
        const int of_a = cln::zerop(a_) ? 0 : cln::minusp(a_) ? -1 : 1, of_b = cln::minusp(b_) ? -1 : 1;
        if (of_a == 0 || of_a == of_b) return of_b;
        return a_ * a_ > b_ * b_ * d_ ? of_a : of_b;
    }
    const Quad x = middle();
    const Quad r = static_cast<Quad>(radius());
    if (x - r > 0) return 1;
    if (x + r < 0) return -1;
    return {};
}

RealBall operator-(const RealBall& a) {
    RealBall result = a;
    result.a_ = -a.a_;
    result.b_ = -a.b_;
    result.middle_ = -a.middle_;
    return result;
}

RealBall operator+(const RealBall& a, const RealBall& b) {
    using Form = RealBall::Form;
    if (a.rational() && cln::zerop(a.a_)) return b;
    if (b.rational() && cln::zerop(b.a_)) return a;
    if (a.is_exact() && b.is_exact()) {
        if (a.rational() || b.rational() || (a.form_ == b.form_ && (a.form_ == Form::pi || a.d_ == b.d_))) {
            const RealBall& other = a.rational() ? b : a;
            return other.form_ == Form::pi ? RealBall::pi_multiple(a.a_ + b.a_, a.b_ + b.b_)
                                           : RealBall::root(a.a_ + b.a_, a.b_ + b.b_, other.d_);
        }
    }
    return rounded(a.middle() + b.middle(), a.radius() + b.radius());
}

RealBall operator*(const RealBall& a, const RealBall& b) {
    ask_whether_wanted();
    using Form = RealBall::Form;
    if (a.is_zero() || b.is_zero()) return 0;
    if (a.rational() && a.a_ == 1) return b;
    if (b.rational() && b.a_ == 1) return a;
    if (a.is_exact() && b.is_exact()) {
        if (a.rational() || b.rational()) {
            const Rational factor = a.rational() ? a.a_ : b.a_;
            const RealBall& other = a.rational() ? b : a;
            return other.form_ == Form::pi ? RealBall::pi_multiple(factor * other.a_, factor * other.b_)
                                           : RealBall::root(factor * other.a_, factor * other.b_, other.d_);
        }
        if (a.form_ == Form::root && b.form_ == Form::root) {
            if (a.d_ == b.d_)
                return RealBall::root(a.a_ * b.a_ + a.b_ * b.b_ * a.d_, a.a_ * b.b_ + a.b_ * b.a_, a.d_);
            if (cln::zerop(a.a_) && cln::zerop(b.a_)) {
                const auto [s, d] = square_part(a.d_ * b.d_);
                return RealBall::root(0, a.b_ * b.b_ * s, d);
            }
        }
    }
    const Quad x = a.middle(), y = b.middle();
    const double r = a.radius(), s = b.radius();
    return rounded(x * y, size(x) * s + size(y) * r + r * s);
}

RealBall inverse(const RealBall& a) {
    if (a.form_ == RealBall::Form::root && a.sign() != 0) {
        const Rational norm = a.a_ * a.a_ - a.b_ * a.b_ * a.d_;
        return RealBall::root(a.a_ / norm, -a.b_ / norm, a.d_);
    }
    if (a.may_be_zero()) return RealBall::unknown();
    const Quad x = a.middle();
    const double r = a.radius(), least = size(x) * (1 - 1e-12) - r;
    return rounded(1 / x, r / (size(x) * least) * (1 + 1e-10));
}

RealBall operator/(const RealBall& a, const RealBall& b) {
    return a * inverse(b);
}

namespace {

/// sin(b·π), if that is a root of a rational number.
std::optional<RealBall> sine_of_turn(const Rational& multiple) {
    Rational b = multiple - 2 * cln::floor1(multiple / 2);  // 0 ≤ b < 2
    const bool negative = b >= 1;
    if (negative) b = b - 1;
    if (b > Rational(1) / 2) b = 1 - b;
    std::optional<RealBall> value;
    if (cln::zerop(b)) value = 0;
    if (b == Rational(1) / 6) value = Rational(1) / 2;
    if (b == Rational(1) / 4) value = RealBall::root(0, Rational(1) / 2, 2);
    if (b == Rational(1) / 3) value = RealBall::root(0, Rational(1) / 2, 3);
    if (b == Rational(1) / 2) value = 1;
    if (value && negative) value = -*value;
    return value;
}

/// The b for which sin(b·π) is the given exact value.
std::optional<Rational> turn_of_sine(const RealBall& x) {
    for (const Rational& b : {Rational(0), Rational(1) / 6, Rational(1) / 4, Rational(1) / 3, Rational(1) / 2})
        for (const int s : {1, -1})
            if (x.is_exact() && (x - RealBall(s) * *sine_of_turn(b)).is_zero()) return s * b;
    return {};
}

double upper(const RealBall& x) {
    return size(x.middle()) + x.radius();
}

}  // namespace

RealBall sin(const RealBall& x) {
    if (const auto b = x.multiple_of_pi())
        if (const auto value = sine_of_turn(*b)) return *value;
    return rounded(sin(x.middle()), std::fmin(x.radius() + unit, 2), 2);
}

RealBall cos(const RealBall& x) {
    if (const auto b = x.multiple_of_pi())
        if (const auto value = sine_of_turn(*b + Rational(1) / 2)) return *value;
    return rounded(cos(x.middle()), std::fmin(x.radius() + unit, 2), 2);
}

RealBall tan(const RealBall& x) {
    return sin(x) / cos(x);
}

RealBall asin(const RealBall& x) {
    if (const auto b = turn_of_sine(x)) return RealBall::pi_multiple(0, *b);
    const double largest = upper(x);
    if (!(largest < 1)) return RealBall::about(0, 1e300);
    return rounded(asin(x.middle()), x.radius() / std::sqrt((1 - largest) * (1 + largest)) + unit, 4);
}

RealBall acos(const RealBall& x) {
    return RealBall::pi_multiple(0, Rational(1) / 2) - asin(x);
}

RealBall atan(const RealBall& x) {
    if (x.is_zero()) return 0;
    if (x.is_exact()) {
        const RealBall sine = x / sqrt(1 + x * x);
        if (const auto b = turn_of_sine(sine)) return RealBall::pi_multiple(0, *b);
    }
    return rounded(atan(x.middle()), x.radius() + unit, 4);
}

RealBall atan2(const RealBall& y, const RealBall& x) {
    const RealBall pi = RealBall::pi_multiple(0, 1), half = RealBall::pi_multiple(0, Rational(1) / 2);
    const std::optional<int> of_x = x.sign(), of_y = y.sign();
    if (of_x == 1) return atan(y / x);
    if (of_x == -1 && of_y) return atan(y / x) + (*of_y < 0 ? -pi : pi);
    if (of_y && *of_y != 0) return RealBall(*of_y) * half - atan(x / y);
    return of_x == 0 && of_y == 0 ? RealBall(0) : RealBall::about(0, 4);
}

RealBall exp(const RealBall& x) {
    if (x.is_zero()) return 1;
    const Quad top = exp(x.middle() + static_cast<Quad>(x.radius()));
    return rounded(exp(x.middle()), size(top) * x.radius(), 4 + upper(x));
}

RealBall log(const RealBall& x) {
    if (const auto r = x.rational(); r && *r == 1) return 0;
    const double least = static_cast<double>(x.middle()) * (1 - 1e-12) - x.radius();
    if (!(least > 0)) return RealBall::about(0, 1e300);
    return rounded(log(x.middle()), x.radius() / least + unit, 4);
}

RealBall sinh(const RealBall& x) {
    return x.is_zero() ? RealBall(0) : (exp(x) - exp(-x)) / 2;
}
RealBall cosh(const RealBall& x) {
    return x.is_zero() ? RealBall(1) : (exp(x) + exp(-x)) / 2;
}
RealBall tanh(const RealBall& x) {
    return sinh(x) / cosh(x);
}

RealBall sqrt(const RealBall& x) {
    if (x.is_zero()) return 0;
    if (x.sign() != 1) return RealBall::about(0, 1e300);
    if (const auto r = x.rational()) {
        const auto [s, d] = square_part(cln::numerator(*r) * cln::denominator(*r));
        return RealBall::root(0, Rational(s) / cln::denominator(*r), d);
    }
    const Quad root = sqrt(x.middle());
    const double least = std::sqrt(static_cast<double>(x.middle()) * (1 - 1e-12) - x.radius());
    return rounded(root, x.radius() / least, 2);
}

RealBall pow(const RealBall& x, const RealBall& exponent) {
    if (const auto r = exponent.rational()) {
        const Rational twice = *r * 2;
        if (cln::denominator(twice) == 1 && cln::abs(twice) < 200) {
            const int n = static_cast<int>(cln::cl_I_to_L(cln::numerator(twice)));
            const RealBall base = n % 2 == 0 ? x : sqrt(x);
            RealBall result = 1;
            for (int k = 0; k < std::abs(n % 2 == 0 ? n / 2 : n); ++k) result *= base;
            return n < 0 ? 1 / result : result;
        }
    }
    return exp(exponent * log(x));
}

}  // namespace alembert
