// SPDX-License-Identifier: GPL-2.0-or-later
// The order of drawing is found from its end. The last variable is one that occurs in the fewest roots, and it
// decides whether these exist; the one before is chosen in the same way from the other roots. So no root contains
// a variable that is drawn after the one that decides it.
#include "analysis/exact/quadratic_residue_points.hpp"

#include <algorithm>

#include "program/modular_angle.hpp"

namespace alembert {

namespace {

/// The highest power of two in the denominators of a value's terms.
int denominators_power(const Program& program, int id, std::map<int, int>& known) {
    if (const auto found = known.find(id); found != known.end()) return found->second;
    const Node& node = program[id];
    const auto power = [](const Rational& c) {
        const cln::cl_I below = cln::denominator(c);
        return static_cast<int>(cln::ord2(below));
    };
    const auto power_of_number = [&] { return is_long_angle(node.number) ? 0 : power(node.number); };
    int result = 0;
    if (node.op == Op::number) {
        result = power_of_number();
    } else if (node.op == Op::sum) {
        result = power_of_number();
        for (std::size_t k = 0; k < node.args.size(); ++k)
            if (program[node.args[k]].op != Op::pi)
                result = std::max(result,
                                  power(node.coefficients[k]) + denominators_power(program, node.args[k], known));
    } else if (node.op == Op::product && !node.is_reciprocal()) {
        for (std::size_t k = 0; k < node.args.size(); ++k)
            result += node.exponents[k] * denominators_power(program, node.args[k], known);
    }
    return known[id] = result;
}

}  // namespace

int halvings(const Program& program, std::span<const int> roots) {
    std::map<int, int> known;
    int result = 0;
    for (const int id : program.needed(roots))
        if (const Op op = program[id].op; op == Op::sin || op == Op::cos || op == Op::tan)
            result = std::max(result, denominators_power(program, program[id].args[0], known));
    return result;
}

QuadraticResiduePoints::QuadraticResiduePoints(const std::vector<Part>& parts, const std::set<Key>& solved) {
    struct Root {
        std::size_t part;
        int node;
        std::set<Key> holds;
    };
    std::vector<Root> roots;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const Program& program = *parts[k].program;
        for (const int id : program.needed(parts[k].roots)) {
            if (program[id].op != Op::sqrt) continue;
            Root root{k, id, {}};
            bool is_free = true;
            for (const int below : program.needed(std::vector<int>{id}))
                if (const Node& node = program[below]; node.op == Op::variable) {
                    const Key key{node.variable.kind, node.variable.index};
                    is_free = is_free && !solved.contains(key);
                    root.holds.insert(key);
                }
            if (is_free && !root.holds.empty()) roots.push_back(std::move(root));
        }
    }
    while (!roots.empty()) {
        // Programs may share a root, so roots are counted by the variables in them.
        std::map<Key, std::set<std::set<Key>>> held;
        for (const Root& root : roots)
            for (const Key& key : root.holds) held[key].insert(root.holds);
        const Key last = std::min_element(held.begin(), held.end(), [](const auto& a, const auto& b) {
                             return a.second.size() < b.second.size();
                         })->first;
        Draw draw{last, {}};
        for (std::size_t k = 0; k < parts.size(); ++k) {
            Part part{parts[k].program, {}};
            for (const Root& root : roots)
                if (root.part == k && root.holds.contains(last)) part.roots.push_back(root.node);
            if (!part.roots.empty()) draw.decides.push_back(std::move(part));
        }
        std::erase_if(roots, [&](const Root& root) { return root.holds.contains(last); });
        draws_.push_back(std::move(draw));
    }
    std::reverse(draws_.begin(), draws_.end());
}

std::optional<ModularPoint> QuadraticResiduePoints::at(ModularPoint point) const {
    constexpr std::uint64_t most_draws = 4096;
    for (const Draw& draw : draws_) {
        const auto exist = [&](const Part& part) {
            return evaluate_mod(*part.program, point, part.roots).has_value();
        };
        const bool is_given = point.given.contains(draw.key);
        std::uint64_t count = 0;
        while (!std::all_of(draw.decides.begin(), draw.decides.end(), exist)) {
            if (is_given || ++count == most_draws) return std::nullopt;
            point.given[draw.key] = point.random(500 + static_cast<std::uint64_t>(draw.key.first),
                                                 static_cast<std::uint64_t>(draw.key.second), count);
        }
    }
    return point;
}

}  // namespace alembert
