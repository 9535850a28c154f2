// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/flatten.hpp"

#include "program/rewriting.hpp"

namespace alembert {

namespace {

constexpr std::size_t longest_sum = 12;  // terms

}  // namespace

Program flattened(const Program& old) {
    Rewriting rewriting(old);
    std::vector<int> uses(static_cast<std::size_t>(old.size()), 0);
    for (const int id : rewriting.needed)
        for (const int arg : old[id].args) ++uses[arg];
    for (const Root& root : old.roots) ++uses[root.node];
    // The terms of each sum, as nodes of the old program.
    std::vector<std::vector<Program::Term>> terms(static_cast<std::size_t>(old.size()));
    std::vector<Rational> constants(static_cast<std::size_t>(old.size()), 0);
    return rewriting
        .finish([&](int id) {
            const Node& node = old[id];
            if (node.op != Op::sum || node.is_constant() || node.is_scaled()) return rewriting.plain(id);
            constants[id] = node.number;
            for (std::size_t k = 0; k < node.args.size(); ++k) {
                const int arg = node.args[k];
                const bool dissolves =
                    uses[arg] == 1 && !terms[arg].empty() && cln::equal(cln::abs(node.coefficients[k]), 1) &&
                    terms[id].size() + terms[arg].size() + node.args.size() - k - 1 <= longest_sum;
                if (!dissolves) {
                    terms[id].emplace_back(node.coefficients[k], arg);
                    continue;
                }
                constants[id] = constants[id] + node.coefficients[k] * constants[arg];
                for (const auto& [coefficient, inner] : terms[arg])
                    terms[id].emplace_back(node.coefficients[k] * coefficient, inner);
            }
            std::vector<Program::Term> images = terms[id];
            for (Program::Term& term : images) term.second = rewriting.image(term.second);
            return rewriting.made().sum(constants[id], images);
        })
        .canonical();
}

}  // namespace alembert
