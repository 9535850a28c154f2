// SPDX-License-Identifier: GPL-2.0-or-later
// r lies in span{g_j E_i} as functions if and only if the vector of its values at N > dim states lies in the span
// of theirs, except with a probability of degree/p at each draw of the states (Schwartz, J. ACM 27 (1980) 701).
#include "check/static_combination.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/exact/quadratic_residue_points.hpp"
#include "program/reduce_rows.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double wanted = -60;
constexpr std::size_t most_columns = 320, spare_states = 6;

class StaticSpan {
public:
    StaticSpan(const Claims& claims, const Equations& law, const ex& residual) : m_(claims.mechanism()) {
        std::vector<ex> list{residual};
        for (int i = 0; i < law.size(); ++i) {
            GiNaC::exvector terms{law.forcing(i)};
            for (std::size_t k = 0; k < law.A.size(); ++k) terms.push_back(law.A[k][i] * law.lambda[k]);
            list.push_back(m_.z->name(GiNaC::add(std::move(terms))));
        }
        list.insert(list.end(), law.gamma.begin(), law.gamma.end());
        for (const auto* constraints : {&m_.constraints, &m_.redundant})
            for (const Mechanism::Constraint& c : *constraints) {
                list.push_back(c.offset);
                if (c.position) list.push_back(*c.position);
            }
        equations_ = claims.lower(p_, list);
        claim_ = equations_.front();
        equations_.erase(equations_.begin());
        std::erase_if(equations_, [&](int node) { return p_.is_zero(node); });
        for (const Mechanism::Parameter& p : m_.parameters)
            if (p.independent) is_zero_.push_back(p.number().is_zero());
        find_factors();
    }

    std::optional<double> find() const {
        if (equations_.empty() || !std::all_of(equations_.begin(), equations_.end(),
                                               [&](int equation) { return holds_state(equation); }))
            return std::nullopt;
        for (const int degree : {0, 1, 2}) {
            double failure = 0;
            for (std::uint64_t draw = 1; failure > wanted; ++draw) {
                const std::optional<double> chance = in_span(draw, degree);
                if (!chance) break;
                if (*chance > -1) return std::nullopt;
                failure += *chance;
            }
            if (failure <= wanted) return failure;
        }
        return std::nullopt;
    }

private:
    bool holds_state(int node) const {
        const std::vector<int> nodes = p_.needed(std::array{node});
        return std::any_of(nodes.begin(), nodes.end(), [&](int id) {
            return p_[id].op == Op::variable && p_[id].variable.kind != Variable::Kind::parameter &&
                   p_[id].variable.kind != Variable::Kind::time;
        });
    }

    /// Finds the factors of the coefficients, and the divisors in the claim.
    void find_factors() {
        std::vector<int> all = equations_;
        all.push_back(claim_);
        for (const int id : p_.needed(all)) {
            const Op op = p_[id].op;
            if (op == Op::variable && p_[id].variable.kind == Variable::Kind::parameter) {
                factors_.push_back(id);
                if (!is_zero_[static_cast<std::size_t>(p_[id].variable.index)]) parameters_.push_back(id);
            }
            const bool is_coordinate = op == Op::variable && p_[id].variable.kind == Variable::Kind::coordinate;
            if ((is_coordinate && is_plain(id, all)) || op == Op::sin || op == Op::cos || op == Op::tan ||
                op == Op::sqrt)
                factors_.push_back(id);
        }
        for (const int id : p_.needed(std::array{claim_})) {
            const Node node = p_[id];
            if (node.op == Op::tan) denominators_.push_back(p_.call(Op::cos, node.args));
            for (std::size_t k = 0; node.op == Op::product && k < node.args.size(); ++k)
                if (node.exponents[k] < 0)
                    denominators_.insert(denominators_.end(), static_cast<std::size_t>(-node.exponents[k]),
                                         node.args[k]);
        }
    }

    /// Does the coordinate stand outside sines and cosines?
    bool is_plain(int coordinate, const std::vector<int>& roots) const {
        const std::vector<int> nodes = p_.needed(roots);
        return std::find(roots.begin(), roots.end(), coordinate) != roots.end() ||
               std::any_of(nodes.begin(), nodes.end(), [&](int id) {
                   const Node& node = p_[id];
                   return (node.op == Op::product || is_sum_outside_angles(id, nodes)) &&
                          std::find(node.args.begin(), node.args.end(), coordinate) != node.args.end();
               });
    }

    bool is_sum_outside_angles(int id, const std::vector<int>& nodes) const {
        if (p_[id].op != Op::sum) return false;
        return std::none_of(nodes.begin(), nodes.end(), [&](int other) {
            const Op op = p_[other].op;
            return (op == Op::sin || op == Op::cos || op == Op::tan) && p_[other].args[0] == id;
        });
    }

    ModularPoint state(std::uint64_t seed, int finer) const {
        ModularPoint point{.seed = seed, .finer = finer};
        for (int i = 0; i < m_.size(); ++i)
            for (const Variable::Kind kind : {Variable::Kind::rate, Variable::Kind::acceleration})
                point.given[{kind, i}] = 0;
        return point;
    }

    /// All products of at most `degree` of them, the empty one first.
    static std::vector<std::vector<int>> products(const std::vector<int>& of, int degree) {
        std::vector<std::vector<int>> result{{}};
        for (std::size_t a = 0; degree > 0 && a < of.size(); ++a) {
            result.push_back({of[a]});
            for (std::size_t b = a; degree > 1 && b < of.size(); ++b) result.push_back({of[a], of[b]});
        }
        return result;
    }

    static Prime product(const ModularValues& at, const std::vector<int>& factors) {
        Prime result = 1;
        for (const int factor : factors) result *= at.value[factor];
        return result;
    }

    /// log₂ of the probability of an error; nothing if no multiple of the claim is in the span of the equations
    /// times products of at most `degree` factors.
    std::optional<double> in_span(std::uint64_t draw, int degree) const {
        const auto right = products(factors_, degree), left = products(parameters_, 2);
        const std::size_t columns = right.size() * equations_.size();
        if (columns > most_columns) return std::nullopt;
        std::vector<int> roots = equations_;
        roots.push_back(claim_);
        roots.insert(roots.end(), factors_.begin(), factors_.end());
        roots.insert(roots.end(), denominators_.begin(), denominators_.end());
        const int finer = std::max(0, halvings(p_, roots) - ModularPoint{}.halves);
        const QuadraticResiduePoints usable({{&p_, roots}}, {});
        std::vector<std::vector<Prime>> rows;
        double conditions = 0, highest = 1;
        for (std::uint64_t seed = 1; rows.size() < columns + spare_states; ++seed) {
            if (seed > 4 * (columns + spare_states)) return std::nullopt;
            const auto point = usable.at(state(draw * 100000 + seed, finer));
            const auto at = point ? evaluate_mod(p_, *point, roots) : std::nullopt;
            if (!at) continue;
            if (!at->exact) return std::nullopt;
            std::vector<Prime> row;
            for (const auto& factors : right)
                for (const int equation : equations_) row.push_back(at->value[equation] * product(*at, factors));
            for (const auto& factors : left)
                row.push_back(at->value[claim_] * product(*at, denominators_) * product(*at, factors));
            if (rows.size() <= columns) conditions += at->conditions;
            for (const int root : roots) highest = std::max(highest, at->degree[root]);
            rows.push_back(std::move(row));
        }
        const auto rank = static_cast<std::size_t>(reduce_rows(rows, columns));
        bool found = false;
        for (std::size_t k = columns; k < rows[0].size() && !found; ++k)
            found = std::all_of(rows.begin() + static_cast<std::ptrdiff_t>(rank), rows.end(),
                                [k](const std::vector<Prime>& row) { return row[k].is_zero(); });
        if (!found) return std::nullopt;
        const double factors = 3 + static_cast<double>(denominators_.size());
        return std::log2(static_cast<double>(columns + 1) * factors * highest) + conditions - 61;
    }

    const Mechanism& m_;
    Program p_;
    int claim_ = 0;
    std::vector<bool> is_zero_;  ///< for each independent parameter, in the scene
    std::vector<int> equations_, factors_;
    std::vector<int> parameters_,
        denominators_;  ///< by which the claim may be multiplied, of those that are not zero
};

}  // namespace

std::optional<double> static_combination(const Claims& claims, const Equations& law, const ex& residual) {
    return StaticSpan(claims, law, residual).find();
}

}  // namespace alembert
