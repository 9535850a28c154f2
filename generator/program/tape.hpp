// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A Program as a list of instructions over any Real, for repeated evaluation without a compiler.
///
///     Tape<Quad> rhs(program, program.nodes_of(Group::acceleration), parameters);
///     rhs(t, q, u, out);                                   // out: a value for each of the nodes wanted
///
/// Values that depend on parameters only are computed once; constants are exact rationals until they are converted
/// to Real. A tape gives the same results as `interpret`, with all decisions taken beforehand. It is three to five
/// times as fast, and with Quad the arithmetic itself takes nearly all of the time. Real is double, long double or
/// Quad. One object serves one thread.

#include <span>
#include <utility>

#include "program/interpret.hpp"
#include "program/quad.hpp"

namespace alembert {

#ifdef __SIZEOF_FLOAT128__
template <>
inline Quad real_of<Quad>(const Rational& r) {
    return quad_of(r);
}
#endif

template <typename Real>
class Tape {
public:
    Tape(const Program& program, std::vector<int> wanted, const std::vector<Real>& parameters)
        : wanted_(std::move(wanted)), value_(static_cast<std::size_t>(program.size())) {
        for (const int id : program.needed(wanted_)) {
            const Node& node = program[id];
            if (node.op == Op::variable && node.variable.kind == Variable::Kind::parameter) {
                at(id) = parameters[static_cast<std::size_t>(node.variable.index)];
                continue;
            }
            Instruction step{.op = node.op,
                             .kind = node.variable.kind,
                             .index = node.variable.index,
                             .to = id,
                             .first = terms_.size(),
                             .count = 0,
                             .number = real_of<Real>(node.number)};
            if (node.op == Op::unspecified) {
                step.index = static_cast<int>(tables_.size());
                tables_.push_back({program.table_call(node), program.shared_table_of(node)});
            }
            for (std::size_t k = 0; k < node.args.size(); ++k) {
                const bool is_sum = node.op == Op::sum;
                terms_.push_back({node.args[k], is_sum ? real_of<Real>(node.coefficients[k]) : Real(0),
                                  is_sum                   ? unity(node.coefficients[k])
                                  : node.op == Op::product ? node.exponents[k]
                                                           : 0});
            }
            step.count = node.args.size();
            if (node.is_constant())
                carry_out(step, Real(0), nullptr, nullptr), terms_.resize(step.first);
            else
                steps_.push_back(step);
        }
    }

    std::size_t size() const { return wanted_.size(); }

    /// Accelerations are 0 if they are not given.
    void operator()(Real t, const Real* q, const Real* u, Real* out, const Real* udot = nullptr) {
        udot_ = udot;
        for (const Instruction& step : steps_) carry_out(step, t, q, u);
        for (std::size_t i = 0; i < wanted_.size(); ++i) out[i] = at(wanted_[i]);
    }

private:
    struct Instruction {
        Op op;
        Variable::Kind kind;
        int index, to;
        std::size_t first, count;
        Real number;
    };
    struct Term {
        int arg;
        Real coefficient;
        int exponent;  ///< for a sum: the coefficient if it is 1 or −1, else 0
    };

    static int unity(const Rational& r) { return r == 1 ? 1 : r == -1 ? -1 : 0; }
    Real& at(int id) { return value_[static_cast<std::size_t>(id)]; }

    void carry_out(const Instruction& step, Real t, const Real* q, const Real* u) {
        const Term* const term = terms_.data() + step.first;
        Real& to = at(step.to);
        const auto arg = [&](int k) -> const Real& { return at(term[k].arg); };
        switch (step.op) {
            case Op::number:
                to = step.number;
                break;
            case Op::variable:
                to = step.kind == Variable::Kind::time                               ? t
                     : step.kind == Variable::Kind::coordinate                       ? q[step.index]
                     : step.kind == Variable::Kind::rate                             ? u[step.index]
                     : step.kind == Variable::Kind::acceleration && udot_ != nullptr ? udot_[step.index]
                                                                                     : Real(0);
                break;
            case Op::sum: {
                Real sum = step.number;
                for (std::size_t k = 0; k < step.count; ++k) {
                    const Real& x = at(term[k].arg);
                    sum += term[k].exponent == 1 ? x : term[k].exponent == -1 ? -x : term[k].coefficient * x;
                }
                to = sum;
                break;
            }
            case Op::product: {
                Real above = 1, below = 1;
                bool divides = false;
                for (std::size_t k = 0; k < step.count; ++k) {
                    const int exponent = term[k].exponent;
                    for (int e = 0; e < exponent; ++e)
                        above = k == 0 && e == 0 ? arg(0) : Real(above * at(term[k].arg));
                    for (int e = 0; e < -exponent; ++e) below *= at(term[k].arg), divides = true;
                }
                to = divides ? Real(above / below) : above;
                break;
            }
            case Op::unspecified: {
                const auto& [call, table] = tables_[static_cast<std::size_t>(step.index)];
                to = table_value<Real>(*table, call, [this](int id) -> const Real& { return at(id); });
                break;
            }
            default:
                to = function_value<Real>(step.op, arg);
        }
    }

    std::vector<int> wanted_;
    std::vector<Real> value_;
    std::vector<Instruction> steps_;
    std::vector<Term> terms_;
    std::vector<std::pair<Program::TableCall, std::shared_ptr<const TabulatedFunction>>> tables_;
    const Real* udot_ = nullptr;
};

}  // namespace alembert
