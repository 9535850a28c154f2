// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/partials.hpp"

#include <algorithm>
#include <map>
#include <queue>
#include <tuple>

namespace alembert {

namespace {

/// ∂node/∂argument k, as a node.
class Label {
public:
    explicit Label(Program& program) : p_(program) {}

    int operator()(int id, std::size_t k) {
        const Node node = p_[id];  // a copy, because new nodes move the old ones in memory
        const int x = node.args[k];
        switch (node.op) {
            case Op::sum:
                return p_.number(node.coefficients[k]);
            case Op::product:
                return of_product(node, id, k);
            case Op::sin:
                return p_.call(Op::cos, {x});
            case Op::cos:
                return times(-1, {{p_.call(Op::sin, {x}), 1}});
            case Op::tan:
                return p_.sum(1, {{1, power(id, 2)}});
            case Op::asin:
                return p_.power(p_.sum(1, {{-1, power(x, 2)}}), Rational(-1) / 2);
            case Op::acos:
                return times(-1, {{p_.power(p_.sum(1, {{-1, power(x, 2)}}), Rational(-1) / 2), 1}});
            case Op::atan:
                return p_.power(p_.sum(1, {{1, power(x, 2)}}), -1);
            case Op::sinh:
                return p_.call(Op::cosh, {x});
            case Op::cosh:
                return p_.call(Op::sinh, {x});
            case Op::tanh:
                return p_.sum(1, {{-1, power(id, 2)}});
            case Op::exp:
                return id;
            case Op::log:
                return power(x, -1);
            case Op::sqrt:
                return times(Rational(1) / 2, {{id, -1}});
            case Op::abs:
                return p_.call(Op::sign, {x});
            case Op::pow:
                return of_power(node, id, k);
            case Op::atan2: {  // atan2(y, x)
                const int square = p_.sum(0, {{1, power(node.args[0], 2)}, {1, power(node.args[1], 2)}});
                return times(k == 0 ? 1 : -1, {{node.args[1 - k], 1}, {square, -1}});
            }
            case Op::min:
            case Op::max: {  // (1 ∓ sign(x − other))/2
                const int above = p_.call(Op::sign, {p_.sum(0, {{1, x}, {-1, node.args[1 - k]}})});
                const Rational half = Rational(1) / 2;
                return p_.sum(half, {{node.op == Op::min ? -half : half, above}});
            }
            case Op::unspecified: {
                if (k == 0 || k % 2 == 1) break;  // the function, or an order
                if (const TabulatedFunction* const table = p_.table_of(node)) {
                    const Program::TableCall call = p_.table_call(node);
                    const bool is_side = k > 2 * call.arguments,
                               is_function = call.orders[0] < TabulatedFunction::side_function;
                    if (is_side || (is_function && call.orders[k / 2 - 1] >= table->degree())) break;
                }
                std::vector<int> args(node.args.begin(), node.args.end());
                args[k - 1] = p_.sum(1, {{1, args[k - 1]}});
                return p_.call(Op::unspecified, std::move(args));
            }
            case Op::number:
            case Op::pi:
            case Op::variable:
            case Op::sign:
                break;
        }
        return p_.number(0);
    }

private:
    int times(const Rational& c, const std::vector<Program::Factor>& factors) { return p_.product(c, factors); }
    int power(int base, int exponent) { return p_.product(1, {{base, exponent}}); }

    int of_product(const Node& node, int id, std::size_t k) {
        if (node.is_reciprocal()) return times(-1, {{id, 2}});
        std::vector<Program::Factor> others;
        for (std::size_t i = 0; i < node.args.size(); ++i)
            others.emplace_back(node.args[i], node.exponents[i] - (i == k ? 1 : 0));
        return times(node.exponents[k], others);
    }

    int of_power(const Node& node, int id, std::size_t k) {
        const int base = node.args[0], exponent = node.args[1];
        if (k == 1) return times(1, {{p_.call(Op::log, {base}), 1}, {id, 1}});
        const int less = p_.sum(-1, {{1, exponent}});
        return times(1, {{exponent, 1}, {p_.call(Op::pow, {base, less}), 1}});
    }

    Program& p_;
};

class Graph {
public:
    Graph(Program& program, std::span<const int> outputs, std::span<const int> inputs)
        : p_(program), outputs_(outputs), inputs_(inputs) {
        const int size = program.size();
        is_input_.assign(static_cast<std::size_t>(size), 0);
        for (const int id : inputs) is_input_[static_cast<std::size_t>(id)] = 1;
        const std::vector<char> active = active_nodes();
        before_.resize(static_cast<std::size_t>(size) + outputs.size());
        after_.resize(before_.size());
        Label label(program);
        for (int id = 0; id < size; ++id) {
            if (!active[static_cast<std::size_t>(id)] || is_input(id)) continue;
            inner_.push_back(id);
            const std::span<const int> args = program[id].args;
            for (std::size_t k = 0; k < args.size(); ++k)
                if (active[static_cast<std::size_t>(args[k])]) add(args[k], id, label(id, k));
        }
        for (std::size_t k = 0; k < outputs.size(); ++k)
            if (active[static_cast<std::size_t>(outputs[k])])
                add(outputs[k], size + static_cast<int>(k), program.number(1));
        first_output_ = size;
    }

    bool eliminate(EliminationOrder order, long budget, std::span<const int> stages) {
        left_ = budget;
        if (order == EliminationOrder::least_fill) return eliminate_least_fill(stages);
        if (order == EliminationOrder::reverse) std::reverse(inner_.begin(), inner_.end());
        return std::all_of(inner_.begin(), inner_.end(), [&](int v) { return eliminate(v); });
    }

    std::vector<Partial> result() {
        std::vector<Partial> list;
        for (std::size_t k = 0; k < outputs_.size(); ++k)
            for (std::size_t j = 0; j < inputs_.size(); ++j) {
                Edges& edges = before_[static_cast<std::size_t>(first_output_) + k];
                const auto found = place(edges, inputs_[j]);
                if (found == edges.end() || found->from != inputs_[j]) continue;
                const int node = value(*found);
                if (!p_.is_zero(node)) list.push_back({static_cast<int>(k), static_cast<int>(j), node});
            }
        return list;
    }

private:
    /// The sum of the nodes on an edge; it becomes one node as soon as it is read.
    struct Edge {
        int from, node;
        std::vector<int> others = {};
    };
    using Edges = std::vector<Edge>;  ///< in the order of their origins

    static Edges::iterator place(Edges& edges, int from) {
        return std::lower_bound(edges.begin(), edges.end(), from,
                                [](const Edge& edge, int id) { return edge.from < id; });
    }

    bool is_input(int id) const { return is_input_[static_cast<std::size_t>(id)] != 0; }

    /// The nodes on paths from an input to an output.
    std::vector<char> active_nodes() const {
        std::vector<char> wanted(is_input_.size(), 0), active(is_input_.size(), 0);
        for (const int id : outputs_) wanted[static_cast<std::size_t>(id)] = 1;
        for (int id = p_.size() - 1; id >= 0; --id)
            if (wanted[static_cast<std::size_t>(id)] && !is_input(id))
                for (const int arg : p_[id].args) wanted[static_cast<std::size_t>(arg)] = 1;
        for (int id = 0; id < p_.size(); ++id) {
            const auto k = static_cast<std::size_t>(id);
            if (!wanted[k]) continue;
            active[k] = is_input(id) ? 1 : 0;
            for (const int arg : p_[id].args) active[k] |= active[static_cast<std::size_t>(arg)];
        }
        return active;
    }

    void add(int from, int to, int label) {
        if (p_.is_zero(label)) return;
        join(from, to, label);
    }

    void join(int from, int to, int label) {
        Edges& edges = before_[static_cast<std::size_t>(to)];
        const auto edge = place(edges, from);
        if (edge != edges.end() && edge->from == from) {
            edge->others.push_back(label);
            return;
        }
        edges.insert(edge, Edge{.from = from, .node = label});
        std::vector<int>& after = after_[static_cast<std::size_t>(from)];
        after.insert(std::lower_bound(after.begin(), after.end(), to), to);
    }

    int value(Edge& edge) {
        if (edge.others.empty()) return edge.node;
        std::vector<Program::Term> terms{{1, edge.node}};
        for (const int node : edge.others) terms.emplace_back(1, node);
        edge.others.clear();
        return edge.node = p_.sum(0, terms);
    }

    bool eliminate(int v) {
        auto& before = before_[static_cast<std::size_t>(v)];
        auto& after = after_[static_cast<std::size_t>(v)];
        left_ -= static_cast<long>(before.size() * after.size());
        if (left_ < 0) return false;
        for (const int i : after) {
            Edges& of_i = before_[static_cast<std::size_t>(i)];
            const auto edge = place(of_i, v);
            const int out = value(*edge);
            of_i.erase(edge);
            if (p_.is_zero(out)) continue;
            for (Edge& first : before)
                if (const int in = value(first); !p_.is_zero(in))
                    join(first.from, i, p_.product(1, {{out, 1}, {in, 1}}));
        }
        for (const Edge& edge : before) {
            std::vector<int>& others = after_[static_cast<std::size_t>(edge.from)];
            others.erase(std::lower_bound(others.begin(), others.end(), v));
        }
        before.clear();
        after.clear();
        return true;
    }

    bool eliminate_least_fill(std::span<const int> stages) {
        using Entry = std::tuple<int, std::size_t, int>;  // stage, pairs, vertex
        const auto stage = [&](int v) {
            return static_cast<std::size_t>(v) < stages.size() ? stages[static_cast<std::size_t>(v)] : 0;
        };
        const auto pairs = [&](int v) {
            return before_[static_cast<std::size_t>(v)].size() * after_[static_cast<std::size_t>(v)].size();
        };
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        std::vector<std::size_t> known(before_.size(), 0);
        std::vector<char> is_left(before_.size(), 0);
        const auto enter = [&](int v) {
            queue.emplace(stage(v), known[static_cast<std::size_t>(v)] = pairs(v), v);
        };
        for (const int v : inner_) is_left[static_cast<std::size_t>(v)] = 1, enter(v);
        while (!queue.empty()) {
            const auto [turn, count, v] = queue.top();
            queue.pop();
            if (!is_left[static_cast<std::size_t>(v)] || count != known[static_cast<std::size_t>(v)]) continue;
            std::vector<int> neighbours(after_[static_cast<std::size_t>(v)].begin(),
                                        after_[static_cast<std::size_t>(v)].end());
            for (const Edge& edge : before_[static_cast<std::size_t>(v)]) neighbours.push_back(edge.from);
            is_left[static_cast<std::size_t>(v)] = 0;
            if (!eliminate(v)) return false;
            for (const int w : neighbours)
                if (is_left[static_cast<std::size_t>(w)] && pairs(w) != known[static_cast<std::size_t>(w)])
                    enter(w);
        }
        return true;
    }

    Program& p_;
    std::span<const int> outputs_, inputs_;
    std::vector<char> is_input_;
    std::vector<Edges> before_;            ///< for each vertex, the edges that end there
    std::vector<std::vector<int>> after_;  ///< likewise, the ends of those that begin there, in order
    std::vector<int> inner_;
    int first_output_ = 0;
    long left_ = 0;
};

}  // namespace

std::optional<std::vector<Partial>> partials(Program& program, std::span<const int> outputs,
                                             std::span<const int> inputs, EliminationOrder order, long budget,
                                             std::span<const int> stages) {
    Graph graph(program, outputs, inputs);
    if (!graph.eliminate(order, budget, stages)) return std::nullopt;
    return graph.result();
}

std::vector<int> tangents(Program& program, std::span<const int> outputs, const std::map<int, int>& direction) {
    std::map<int, int> tangent = direction;  // of the nodes that the direction changes
    Label label(program);
    for (const int id : program.needed({outputs.begin(), outputs.end()})) {
        if (direction.contains(id)) continue;
        const std::span<const int> args = program[id].args;
        std::vector<Program::Term> terms;
        for (std::size_t k = 0; k < args.size(); ++k)
            if (const auto found = tangent.find(args[k]); found != tangent.end())
                terms.emplace_back(1, program.product(1, {{label(id, k), 1}, {found->second, 1}}));
        if (!terms.empty()) tangent[id] = program.sum(0, terms);
    }
    std::vector<int> result;
    for (const int id : outputs) {
        const auto found = tangent.find(id);
        result.push_back(found == tangent.end() ? program.number(0) : found->second);
    }
    return result;
}

}  // namespace alembert
