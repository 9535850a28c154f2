// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The value of an operation that is a function of one or two arguments, for any Real: what `interpret` and `Tape`
/// have in common.
///
///     function_value<double>(Op::atan2, [&](int k) -> const double& { return args[k]; });
///
/// Functions of Real are found by argument-dependent look-up, or are those of <cmath> and of quad.hpp.

#include <cmath>

#include "program/order.hpp"
#include "program/program.hpp"
#include "program/quad.hpp"

namespace alembert {

/// `arg(k)` is the k-th argument. The other operations (numbers, variables, sums, products) are none of these.
template <typename Real, typename Arg>
inline Real function_value(Op op, const Arg& arg) {
    using alembert::abs, alembert::acos, alembert::asin, alembert::atan, alembert::atan2, alembert::cos,
        alembert::cosh, alembert::exp, alembert::log, alembert::pow, alembert::sin, alembert::sinh, alembert::sqrt,
        alembert::tan, alembert::tanh;
    using std::abs, std::acos, std::asin, std::atan, std::atan2, std::cos, std::cosh, std::exp, std::log, std::pow,
        std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
    switch (op) {
        case Op::pi:
            return acos(Real(-1));
        case Op::sin:
            return sin(arg(0));
        case Op::cos:
            return cos(arg(0));
        case Op::tan:
            return tan(arg(0));
        case Op::asin:
            return asin(arg(0));
        case Op::acos:
            return acos(arg(0));
        case Op::atan:
            return atan(arg(0));
        case Op::sinh:
            return sinh(arg(0));
        case Op::cosh:
            return cosh(arg(0));
        case Op::tanh:
            return tanh(arg(0));
        case Op::exp:
            return exp(arg(0));
        case Op::log:
            return log(arg(0));
        case Op::sqrt:
            return sqrt(arg(0));
        case Op::abs:
            return abs(arg(0));
        case Op::sign:
            return sign_of(arg(0));
        case Op::pow:
            return pow(arg(0), arg(1));
        case Op::atan2:
            return atan2(arg(0), arg(1));
        case Op::min:
            return lesser(arg(0), arg(1));
        case Op::max:
            return greater(arg(0), arg(1));
        case Op::number:
        case Op::variable:
        case Op::sum:
        case Op::product:
        case Op::unspecified:
            break;
    }
    return Real(0);
}

}  // namespace alembert
