// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/lowering.hpp"

#include <fmt/format.h>

#include <set>

#include "algebra/symbolic/functions.hpp"
#include "base/language/say.hpp"
#include "program/interpret.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;

namespace {

const std::map<std::string, Op>& operations() {
    static const std::map<std::string, Op> table = [] {
        std::map<std::string, Op> made;
        for (int op = static_cast<int>(Op::sin); op <= static_cast<int>(Op::unspecified); ++op)
            made[name_of(static_cast<Op>(op))] = static_cast<Op>(op);
        return made;
    }();
    return table;
}

}  // namespace

int Lowering::operator()(const ex& e) {
    if (const auto found = known_.find(e); found != known_.end()) return found->second;
    const int node = lowered(e);
    known_.emplace(e, node);
    return node;
}

int Lowering::define(const ex& symbol, int node) {
    known_[symbol] = node;
    return node;
}

void Lowering::lower_definitions(const std::vector<ex>& roots) {
    std::set<const Intermediates::Entry*> wanted;  // in the order in which they were made
    std::vector<ex> stack = roots;
    while (!stack.empty()) {
        const ex top = stack.back();
        stack.pop_back();
        if (!is_a<GiNaC::symbol>(top)) {
            for (const ex& part : top) stack.push_back(part);
            continue;
        }
        const Intermediates::Entry* entry = m_.z->find(ex_to<GiNaC::symbol>(top));
        if (entry == nullptr || known_.contains(top) || !wanted.insert(entry).second) continue;
        for (const GiNaC::symbol& used : entry->uses) stack.push_back(used);
    }
    // Positions are stored, because the derivative of an input adds entries to the table, which may move it in
    // memory.
    std::vector<std::ptrdiff_t> order;
    for (const Intermediates::Entry* entry : wanted) order.push_back(entry - m_.z->entries().data());
    for (const std::ptrdiff_t k : order) (*this)(m_.z->entries()[static_cast<std::size_t>(k)].symbol);
}

int Lowering::lowered(const ex& e) {
    if (is_a<GiNaC::numeric>(e)) return program_.number(rational(e));
    if (is_a<GiNaC::constant>(e)) return program_.pi();
    if (is_a<GiNaC::symbol>(e)) return symbol(ex_to<GiNaC::symbol>(e));
    if (is_a<GiNaC::add>(e)) {
        std::vector<Program::Term> terms;
        for (const ex& term : e) terms.emplace_back(1, (*this)(term));
        return program_.sum(0, terms);
    }
    if (is_a<GiNaC::mul>(e)) {
        std::vector<Program::Factor> factors;
        Rational coefficient = 1;
        for (const ex& factor : e) {
            if (is_a<GiNaC::numeric>(factor)) {
                coefficient = coefficient * rational(factor);
            } else if (is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::integer)) {
                factors.emplace_back((*this)(factor.op(0)), ex_to<GiNaC::numeric>(factor.op(1)).to_int());
            } else {
                factors.emplace_back((*this)(factor), 1);
            }
        }
        return program_.product(coefficient, factors);
    }
    if (is_a<GiNaC::power>(e)) {
        const int base = (*this)(e.op(0));
        if (e.op(1).info(GiNaC::info_flags::rational)) return program_.power(base, rational(e.op(1)));
        return program_.call(Op::pow, {base, (*this)(e.op(1))});
    }
    if (is_a<GiNaC::function>(e)) {
        std::vector<int> args;
        for (const ex& arg : e) args.push_back((*this)(arg));
        return program_.call(operations().at(function_name(e)), std::move(args));
    }
    throw ModelError(
        say("an expression of kind '{}' cannot be turned into code", ex_to<GiNaC::basic>(e).class_name()));
}

Rational Lowering::rational(const ex& e) {
    const GiNaC::numeric& value = ex_to<GiNaC::numeric>(e);
    if (!value.is_rational())
        throw ModelError(say("a number that is not rational cannot be turned into exact code"));
    return cln::the<cln::cl_RA>(value.to_cl_N());
}

int Lowering::symbol(const GiNaC::symbol& s) {
    if (const Intermediates::Entry* entry = m_.z->find(s)) {
        // A copy, because the derivative of an input adds entries to the table, which may move it in memory.
        const ex definition = entry->definition;
        const std::span<const int> former = program_.set_sources(entry->sources);
        const int node = (*this)(definition);
        program_.set_sources(former);
        return node;
    }
    const SymbolInfo& info = m_.symbols->info(s);
    switch (info.kind) {
        case SymbolInfo::Kind::time:
            return program_.variable({Variable::Kind::time, 0});
        case SymbolInfo::Kind::parameter:
            return parameter(info.index);
        case SymbolInfo::Kind::input:
            return input(info.index, info.order);
        case SymbolInfo::Kind::state:
            return state(info.index, info.order);
        case SymbolInfo::Kind::coordinate: {
            const auto kind = info.order == 0   ? Variable::Kind::coordinate
                              : info.order == 1 ? Variable::Kind::rate
                                                : Variable::Kind::acceleration;
            return program_.variable({kind, info.index});
        }
        case SymbolInfo::Kind::function: {  // the first argument of a call
            const auto position = static_cast<std::size_t>(info.index);
            if (program_.functions.size() <= position) program_.functions.resize(position + 1);
            program_.functions[position] = info.name;
            program_.tables.resize(program_.functions.size());
            program_.tables[position] = m_.tables.at(position);
            return program_.number(info.index);
        }
        default:
            break;
    }
    throw ModelError(say("'{}' has no value", info.text()));
}

int Lowering::parameter(int index) {
    const Mechanism::Parameter& p = m_.parameters[index];
    const auto is_variable = [this](const Mechanism::Parameter& of) {
        return of.independent && (!fold_ || of.from_outside);
    };
    if (!p.independent && fold_) return program_.number(folded(p.value));
    if (!is_variable(p)) return (*this)(p.value);
    int position = 0;
    for (int i = 0; i < index; ++i) position += is_variable(m_.parameters[i]) ? 1 : 0;
    return program_.variable({Variable::Kind::parameter, position});
}

Rational Lowering::folded(const ex& e) {
    Program program;
    const int node = Lowering(program, m_, false)(e);
    State<double> state;
    for (const Mechanism::Parameter& p : m_.parameters)
        if (p.independent) state.parameters.push_back(p.number().to_double());
    return cln::rational(cln::cl_DF(interpret(program, state)[node]));
}

int Lowering::input(int index, int order) {
    ex value = m_.inputs[index].value;
    for (int i = 0; i < order; ++i) value = m_.explicit_time_derivative({value})[0];
    return (*this)(value);
}

/// In rates, the states stand behind q'. Where the speeds are not the rates, whoever lowers defines z.
int Lowering::state(int index, int order) {
    if (order == 0) return program_.variable({Variable::Kind::rate, m_.size() + index});
    const ex& rate = m_.states[static_cast<std::size_t>(index)].rate;
    return (*this)(order == 1 ? rate : m_.time_derivative({rate})[0]);
}

}  // namespace alembert
