// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/readiness.hpp"

#include <algorithm>

#include "program/processor.hpp"

namespace alembert {

namespace {

using processor::division, processor::function, processor::step;

bool is_product(const Node& node) {
    return node.op == Op::product && !node.is_reciprocal();
}

}  // namespace

Readiness::Readiness(const Program& program, std::span<const int> roots)
    : program_(program),
      is_textbook_(program.is_textbook),
      uses_(static_cast<std::size_t>(program.size()), 0),
      ready_(uses_.size(), 0) {
    const std::vector<int> needed = program.needed(roots);
    for (const int root : roots) ++uses_[root];
    for (const int id : needed)
        for (const int arg : program[id].args) ++uses_[arg];
    for (const int id : needed) ready_[id] = ready_at(id);
}

std::vector<Readiness::Term> Readiness::terms(int id) const {
    const Node& node = program_[id];
    std::vector<Term> list;
    for (std::size_t k = 0; k < node.args.size(); ++k) {
        const int arg = node.args[k];
        if (node.op == Op::sum) {
            const bool scaled = !cln::equal(cln::abs(node.coefficients[k]), 1);
            const bool fuses =
                scaled || (is_product(program_[arg]) && uses_[arg] == 1 && !program_[arg].is_constant());
            list.push_back({k, fuses && !scaled ? ready_[arg] - step : ready_[arg], fuses});
        } else {
            list.push_back({k, ready_[arg], false});
        }
    }
    return arranged(std::move(list));
}

std::vector<Readiness::Term> Readiness::arranged(std::vector<Term> list) const {
    if (is_textbook_) return list;
    std::stable_sort(list.begin(), list.end(), [](const Term& a, const Term& b) { return a.ready < b.ready; });
    return list;
}

/// The time at which the last of the terms is added.
int Readiness::end(const Node& node, const std::vector<Term>& list) const {
    const bool has_number = node.op == Op::sum && !cln::zerop(node.number);
    int at = has_number ? 0 : list[0].ready + (list[0].fuses ? step : 0);
    for (std::size_t k = has_number ? 0 : 1; k < list.size(); ++k) at = std::max(at, list[k].ready) + step;
    return at;
}

std::vector<std::size_t> Readiness::order(int id) const {
    const Node& node = program_[id];
    std::vector<Term> list = terms(id);
    if (node.op == Op::sum && !is_textbook_ && cln::zerop(node.number) && list[0].fuses) {
        const auto plain = std::find_if(list.begin(), list.end(), [](const Term& term) { return !term.fuses; });
        if (plain != list.end()) {
            std::vector<Term> other = list;
            std::rotate(other.begin(), other.begin() + (plain - list.begin()),
                        other.begin() + (plain - list.begin()) + 1);
            if (end(node, other) <= end(node, list)) list = std::move(other);
        }
    }
    std::vector<std::size_t> result;
    for (const Term& term : list) result.push_back(term.position);
    return result;
}

int Readiness::ready_at(int id) const {
    const Node& node = program_[id];
    if (node.is_constant() || node.args.empty()) return 0;
    if (node.is_reciprocal()) return ready_[node.args[0]] + division;
    if (node.op == Op::sum) return end(node, terms(id));
    int at = 0;
    if (node.op == Op::product) {
        bool first = true;
        for (const Term& term : terms(id))
            for (int e = 0; e < node.exponents[term.position]; ++e) {
                at = first ? term.ready : std::max(at, term.ready) + step;
                first = false;
            }
        return at;
    }
    for (const int arg : node.args) at = std::max(at, ready_[arg]);
    return at + function;
}

}  // namespace alembert
