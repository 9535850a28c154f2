// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A node as a scalar type; the program simplifies zeros and constants.
///
///     const Symbolic x(program, node);
///     (x * 2 - x).node(program)

#include <optional>

#include "program/program.hpp"

namespace alembert {

class Symbolic {
public:
    Symbolic(int number = 0) : number_(number) {}
    Symbolic(Program& program, int node) : p_(&program), node_(node) {}

    int node(Program& program) const { return p_ != nullptr ? node_ : program.number(number_); }
    /// The value, if it is a plain number.
    std::optional<Rational> number() const {
        if (p_ == nullptr) return number_;
        if ((*p_)[node_].is_number()) return (*p_)[node_].number;
        return std::nullopt;
    }
    bool is_zero() const { return number() && cln::zerop(*number()); }

    friend Symbolic operator+(const Symbolic& a, const Symbolic& b) { return sum(a, b, 1); }
    friend Symbolic operator-(const Symbolic& a, const Symbolic& b) { return sum(a, b, -1); }
    Symbolic operator-() const { return p_ == nullptr ? of(-number_) : Symbolic(*p_, p_->sum(0, {{-1, node_}})); }
    friend Symbolic operator*(const Symbolic& a, const Symbolic& b) {
        Program* p = either(a, b);
        if (p == nullptr) return of(a.number_ * b.number_);
        if (a.p_ == nullptr) return {*p, p->sum(0, {{a.number_, b.node_}})};
        if (b.p_ == nullptr) return {*p, p->sum(0, {{b.number_, a.node_}})};
        return {*p, p->product(1, {{a.node_, 1}, {b.node_, 1}})};
    }
    friend Symbolic operator/(const Symbolic& a, const Symbolic& b) {
        Program* p = either(a, b);
        if (p == nullptr) return of(a.number_ / b.number_);
        return {*p, p->product(1, {{a.node(*p), 1}, {b.node(*p), -1}})};
    }

private:
    static Symbolic of(const Rational& number) {
        Symbolic result;
        result.number_ = number;
        return result;
    }
    static Program* either(const Symbolic& a, const Symbolic& b) { return a.p_ != nullptr ? a.p_ : b.p_; }
    static Symbolic sum(const Symbolic& a, const Symbolic& b, int sign) {
        Program* p = either(a, b);
        if (p == nullptr) return of(a.number_ + sign * b.number_);
        return {*p, p->sum(0, {{1, a.node(*p)}, {sign, b.node(*p)}})};
    }

    Program* p_ = nullptr;
    int node_ = -1;
    Rational number_ = 0;
};

}  // namespace alembert
