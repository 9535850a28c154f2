// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Evaluates a Program node by node. It is the reference for the tests, and evaluates without a compiler for
/// `eval`.
///
///     const State<double> state{.parameters = par, .t = 0, .q = q, .qdot = u};
///     const std::vector<double> values = interpret<double>(program, state);
///     values[program.nodes_of(Group::energy)[0]];
///
/// Works for every Real with the usual functions found by argument-dependent look-up (double, long double).

#include <cln/float.h>
#include <cln/integer.h>
#include <cln/real.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "program/function_value.hpp"
#include "program/program.hpp"
#include "program/table_value.hpp"

namespace alembert {

template <typename Real>
struct State {
    std::vector<Real> parameters;
    Real t = 0;
    std::vector<Real> q, qdot, qddot;
    std::vector<Real> unknown = {};
};

/// Converts a rational number to Real: the quotient of numerator and denominator in Real's own arithmetic.
template <typename Real>
Real real_of(const Rational& r) {
    return static_cast<Real>(cln::double_approx(r));
}

template <>
inline long double real_of<long double>(const Rational& r) {
    if (r == Rational(1)) return 1;  // most coefficients are 1 or −1
    if (r == Rational(-1)) return -1;
    constexpr unsigned exact = 53;  // bits that a double holds
    const cln::cl_I above = cln::numerator(r), below = cln::denominator(r);
    if (cln::integer_length(above) < exact && cln::integer_length(below) < exact)
        return static_cast<long double>(cln::double_approx(above)) /
               static_cast<long double>(cln::double_approx(below));
    const cln::cl_F value = cln::cl_float(r, cln::float_format(40));
    const double high = cln::double_approx(value);
    const Rational rest = r - cln::rational(cln::cl_DF(high));
    const double middle = cln::double_approx(rest);
    long double low = 0;
    if constexpr (std::numeric_limits<long double>::digits > 2 * exact)
        low = static_cast<long double>(cln::double_approx(rest - cln::rational(cln::cl_DF(middle))));
    return static_cast<long double>(high) + (static_cast<long double>(middle) + low);
}

/// sum += factor·x, without an intermediate value where Real has one of its own.
template <typename Real>
void add_multiple(Real& sum, const Rational& factor, const Real& x) {
    sum += real_of<Real>(factor) * x;
}

/// Computes the nodes `ids`, in ascending order, into `value`, which has room for all nodes and holds the
/// arguments that are not among them. Divisions by zero and similar operations give infinities and NaN, never a
/// trap.
template <typename Real, typename Ids>
void interpret_into(std::vector<Real>& value, const Program& program, const State<Real>& state, const Ids& ids) {
    for (const int id : ids) {
        const Node& node = program[id];
        const auto arg = [&](std::size_t k) -> const Real& { return value[node.args[k]]; };
        switch (node.op) {
            case Op::number:
                value[id] = real_of<Real>(node.number);
                break;
            case Op::variable: {
                const auto i = static_cast<std::size_t>(node.variable.index);
                switch (node.variable.kind) {
                    case Variable::Kind::parameter:
                        value[id] = state.parameters.at(i);
                        break;
                    case Variable::Kind::time:
                        value[id] = state.t;
                        break;
                    case Variable::Kind::coordinate:
                        value[id] = state.q.at(i);
                        break;
                    case Variable::Kind::rate:
                        value[id] = state.qdot.at(i);
                        break;
                    case Variable::Kind::acceleration:
                        value[id] = i < state.qddot.size() ? state.qddot[i] : Real(0);
                        break;
                    case Variable::Kind::unknown:
                        value[id] = state.unknown.at(i);
                        break;
                }
                break;
            }
            case Op::sum: {
                Real sum = real_of<Real>(node.number);
                for (std::size_t k = 0; k < node.args.size(); ++k) add_multiple(sum, node.coefficients[k], arg(k));
                value[id] = std::move(sum);
                break;
            }
            case Op::product: {
                Real numerator = 1, denominator = 1;
                bool has_factor = false, has_divisor = false;
                for (std::size_t k = 0; k < node.args.size(); ++k) {
                    const bool above = node.exponents[k] > 0;
                    Real& side = above ? numerator : denominator;
                    bool& begun = above ? has_factor : has_divisor;
                    for (int e = 0; e < std::abs(node.exponents[k]); ++e) {
                        if (begun)
                            side *= arg(k);
                        else
                            side = arg(k);
                        begun = true;
                    }
                }
                value[id] = has_divisor ? numerator / denominator : std::move(numerator);
                break;
            }
            case Op::unspecified: {
                const Program::TableCall call = program.table_call(node);
                value[id] = table_value<Real>(*program.table_of(node), call,
                                              [&](int of) -> const Real& { return value[of]; });
                break;
            }
            default:
                value[id] = function_value<Real>(node.op, arg);
        }
    }
}

/// The values of the nodes `ids`, which are in ascending order and hold all arguments of each (Program::needed);
/// the others stay empty.
template <typename Real, typename Ids>
std::vector<Real> interpret_nodes(const Program& program, const State<Real>& state, const Ids& ids) {
    std::vector<Real> value(program.size());
    interpret_into(value, program, state, ids);
    return value;
}

/// The values of all nodes, including those that are not needed.
template <typename Real>
std::vector<Real> interpret(const Program& program, const State<Real>& state) {
    std::vector<int> every(static_cast<std::size_t>(program.size()));
    std::iota(every.begin(), every.end(), 0);
    return interpret_nodes(program, state, every);
}

}  // namespace alembert
