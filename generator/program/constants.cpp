// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/constants.hpp"

#include <map>

#include "program/rewriting.hpp"

namespace alembert {

namespace {

bool is_constant_sum(const Node& node) {
    return node.op == Op::sum && node.is_constant();
}

struct Flat {
    Rational number = 0;
    std::map<int, Rational> terms = {};  ///< node → coefficient
};

void add(Flat& flat, const Program& p, int id, const Rational& factor) {
    const Node& node = p[id];
    if (!is_constant_sum(node)) {
        flat.terms[id] = flat.terms[id] + factor;
        return;
    }
    flat.number = flat.number + factor * node.number;
    for (std::size_t k = 0; k < node.args.size(); ++k) add(flat, p, node.args[k], factor * node.coefficients[k]);
}

}  // namespace

Program with_simple_constants(const Program& program) {
    Rewriting rewriting(program);
    return rewriting.finish([&](int id) {
        const Node& node = program[id];
        if (!is_constant_sum(node) || node.args.size() < 2) return rewriting.plain(id);
        Flat flat;
        add(flat, program, id, 1);
        std::erase_if(flat.terms, [](const auto& term) { return cln::zerop(term.second); });
        if (flat.terms.size() > node.args.size()) return rewriting.plain(id);
        std::vector<Program::Term> terms;
        for (const auto& [arg, coefficient] : flat.terms) terms.emplace_back(coefficient, rewriting.image(arg));
        return rewriting.made().sum(flat.number, terms);
    });
}

}  // namespace alembert
