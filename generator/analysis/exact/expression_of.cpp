// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/expression_of.hpp"

#include <map>

#include "algebra/symbolic/functions.hpp"
#include "algebra/symbolic/unspecified.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

class Raising {
public:
    Raising(const Program& program, const Mechanism& mechanism, const std::vector<GiNaC::symbol>& unknown)
        : p_(program), m_(mechanism), unknown_(unknown) {}

    std::optional<ex> operator()(int id) {
        if (const auto found = known_.find(id); found != known_.end()) return found->second;
        return known_[id] = raised(p_[id]);
    }

private:
    static ex number(const Rational& r) { return GiNaC::numeric(cln::cl_N(r)); }

    std::optional<ex> raised(const Node& node) {
        std::vector<ex> args;
        for (const int arg : node.args) {
            const std::optional<ex> value = (*this)(arg);
            if (!value) return {};
            args.push_back(*value);
        }
        switch (node.op) {
            case Op::number:
                return number(node.number);
            case Op::pi:
                return ex(GiNaC::Pi);
            case Op::variable:
                return symbol(node.variable);
            case Op::sum: {
                GiNaC::exvector terms{number(node.number)};
                for (std::size_t k = 0; k < args.size(); ++k)
                    terms.push_back(number(node.coefficients[k]) * args[k]);
                return ex(GiNaC::add(terms));
            }
            case Op::product: {
                GiNaC::exvector factors;
                for (std::size_t k = 0; k < args.size(); ++k) factors.push_back(pow(args[k], node.exponents[k]));
                return ex(GiNaC::mul(factors));
            }
            case Op::pow:
                return ex(pow(args[0], args[1]));
            case Op::unspecified: {
                const auto position = GiNaC::ex_to<GiNaC::numeric>(args[0]).to_int();
                UnspecifiedCall call{m_.symbols->functions().at(static_cast<std::size_t>(position)), {}, {}};
                for (std::size_t k = 1; k < args.size(); k += 2) {
                    call.orders.push_back(GiNaC::ex_to<GiNaC::numeric>(args[k]).to_int());
                    call.arguments.push_back(args[k + 1]);
                }
                return unspecified_value(call);
            }
            default:
                return apply_function(name_of(node.op), args);
        }
    }

    std::optional<ex> symbol(const Variable& v) const {
        const auto i = static_cast<std::size_t>(v.index);
        switch (v.kind) {
            case Variable::Kind::time:
                return m_.t;
            case Variable::Kind::coordinate:
                return m_.q[i];
            case Variable::Kind::rate:
                return i < m_.q.size() ? m_.qdot[i] : m_.states[i - m_.q.size()].derivative[0];
            case Variable::Kind::acceleration:
                return m_.qddot[i];
            case Variable::Kind::unknown:
                return unknown_[i];
            case Variable::Kind::parameter:
                break;
        }
        std::size_t position = 0;
        for (const Mechanism::Parameter& p : m_.parameters) {
            if (!p.independent) continue;
            if (position++ == i) return p.symbol;
        }
        return {};
    }

    const Program& p_;
    const Mechanism& m_;
    const std::vector<GiNaC::symbol>& unknown_;
    std::map<int, std::optional<ex>> known_;
};

}  // namespace

std::optional<ex> expression_of(const Program& program, int node, const Mechanism& mechanism,
                                const std::vector<GiNaC::symbol>& unknown, double largest) {
    if (program[node].size > largest) return {};
    return Raising(program, mechanism, unknown)(node);
}

}  // namespace alembert
