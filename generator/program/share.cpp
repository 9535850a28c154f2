// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/share.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "program/rewriting.hpp"

namespace alembert {

namespace {

/// One n-ary operation as a bag of items: (node or pair, weight). A product's weights are all 1, its items
/// repeated.
struct Bag {
    int owner;
    std::vector<std::pair<int, Rational>> items;
};

/// Replaces pairs that occur in several bags by new items, most frequent first. New items are numbered from
/// `first`.
class Pairing {
public:
    struct Pair {
        int a, b;
        Rational ratio;  ///< a + ratio·b, or a·b with ratio 1
        bool operator<(const Pair& o) const {
            return std::tie(a, b) != std::tie(o.a, o.b) ? std::tie(a, b) < std::tie(o.a, o.b) : ratio < o.ratio;
        }
    };

    Pairing(std::vector<Bag> bags, int first) : bags_(std::move(bags)), next_(first) {}

    void run() {
        for (std::size_t k = 0; k < bags_.size(); ++k) enter(k, 1);
        while (!by_count_.empty()) {
            const auto [minus_count, order, best] = *by_count_.begin();
            if (minus_count > -2) break;
            const int item = next_++;
            pairs.push_back(best);
            const std::set<std::size_t> users = users_[best];
            for (const std::size_t k : users) {
                enter(k, -1);
                replace(bags_[k], best, item);
                enter(k, 1);
            }
        }
    }

    const std::vector<Bag>& bags() const { return bags_; }
    std::vector<Pair> pairs;

private:
    static std::set<Pair> pairs_of(const Bag& bag) {
        std::set<Pair> result;
        for (std::size_t i = 0; i < bag.items.size(); ++i)
            for (std::size_t j = i + 1; j < bag.items.size(); ++j) result.insert(make(bag.items[i], bag.items[j]));
        return result;
    }

    static Pair make(const std::pair<int, Rational>& x, const std::pair<int, Rational>& y) {
        return x.first <= y.first ? Pair{x.first, y.first, y.second / x.second}
                                  : Pair{y.first, x.first, x.second / y.second};
    }

    void enter(std::size_t k, int sign) {
        // The number of pairs grows with the square, and such long sums share little.
        if (bags_[k].items.size() > 24) return;
        for (const Pair& pair : pairs_of(bags_[k])) {
            std::set<std::size_t>& users = users_[pair];
            if (const auto known = order_.find(pair); known == order_.end())
                order_.emplace(pair, static_cast<int>(order_.size()));
            by_count_.erase({-static_cast<int>(users.size()), order_[pair], pair});
            if (sign > 0)
                users.insert(k);
            else
                users.erase(k);
            if (users.size() > 1) by_count_.insert({-static_cast<int>(users.size()), order_[pair], pair});
        }
    }

    static void replace(Bag& bag, const Pair& pair, int item) {
        for (std::size_t i = 0; i < bag.items.size(); ++i)
            for (std::size_t j = 0; j < bag.items.size(); ++j) {
                if (i == j || bag.items[i].first != pair.a || bag.items[j].first != pair.b) continue;
                if (!cln::equal(bag.items[j].second / bag.items[i].second, pair.ratio)) continue;
                const Rational weight = bag.items[i].second;
                bag.items.erase(bag.items.begin() + static_cast<std::ptrdiff_t>(std::max(i, j)));
                bag.items.erase(bag.items.begin() + static_cast<std::ptrdiff_t>(std::min(i, j)));
                bag.items.emplace_back(item, weight);
                return;
            }
    }

    std::vector<Bag> bags_;
    int next_;
    std::map<Pair, std::set<std::size_t>> users_;
    std::map<Pair, int> order_;
    std::set<std::tuple<int, int, Pair>> by_count_;
};

Program with_shared_pairs(const Program& old) {
    Rewriting rewriting(old);
    std::vector<Bag> products, sums;
    std::map<int, std::size_t> product_of, sum_of;
    for (const int id : rewriting.needed) {
        const Node& node = old[id];
        if (node.is_constant() || node.is_reciprocal()) continue;
        Bag bag{id, {}};
        if (node.op == Op::product) {
            for (std::size_t k = 0; k < node.args.size(); ++k)
                for (int e = 0; e < node.exponents[k]; ++e) bag.items.emplace_back(node.args[k], 1);
            product_of[id] = products.size();
            products.push_back(std::move(bag));
        } else if (node.op == Op::sum && !node.is_scaled()) {
            for (std::size_t k = 0; k < node.args.size(); ++k)
                bag.items.emplace_back(node.args[k], node.coefficients[k]);
            sum_of[id] = sums.size();
            sums.push_back(std::move(bag));
        }
    }
    Pairing factors(std::move(products), old.size()), terms(std::move(sums), old.size());
    factors.run();
    terms.run();

    const std::function<int(int)> factor = [&](int item) -> int {
        if (item < old.size()) return rewriting.image(item);
        const Pairing::Pair& pair = factors.pairs[item - old.size()];
        return rewriting.made().product(1, {{factor(pair.a), 1}, {factor(pair.b), 1}});
    };
    const std::function<int(int)> term = [&](int item) -> int {
        if (item < old.size()) return rewriting.image(item);
        const Pairing::Pair& pair = terms.pairs[item - old.size()];
        return rewriting.made().sum(0, {{1, term(pair.a)}, {pair.ratio, term(pair.b)}});
    };
    return rewriting.finish([&](int id) {
        if (const auto found = product_of.find(id); found != product_of.end()) {
            std::vector<Program::Factor> list;
            for (const auto& [item, weight] : factors.bags()[found->second].items)
                list.emplace_back(factor(item), 1);
            return rewriting.made().product(1, list);
        }
        if (const auto found = sum_of.find(id); found != sum_of.end()) {
            std::vector<Program::Term> list;
            for (const auto& [item, weight] : terms.bags()[found->second].items)
                list.emplace_back(weight, term(item));
            return rewriting.made().sum(old[id].number, list);
        }
        return rewriting.plain(id);
    });
}

/// a·b + a·c → a·(b + c), for products that are used once.
Program with_common_factors(const Program& old) {
    Rewriting rewriting(old);
    std::map<int, int> uses;
    for (const int id : rewriting.needed)
        for (const int arg : old[id].args) ++uses[arg];
    for (const Root& root : old.roots) ++uses[root.node];

    const auto factors_of = [&](int id) {
        std::map<int, int> factors;
        const Node& node = old[id];
        if (node.op == Op::product && uses[id] == 1 && !node.is_reciprocal())
            for (std::size_t k = 0; k < node.args.size(); ++k) factors[node.args[k]] += node.exponents[k];
        else
            factors[id] = 1;
        return factors;
    };
    return rewriting.finish([&](int id) {
        const Node& node = old[id];
        if (node.op != Op::sum || node.is_scaled() || node.is_constant() || node.args.size() > 64)
            return rewriting.plain(id);
        struct Piece {
            Rational coefficient;
            std::map<int, int> factors;
        };
        std::vector<Piece> pieces;
        for (std::size_t k = 0; k < node.args.size(); ++k)
            pieces.push_back({node.coefficients[k], factors_of(node.args[k])});
        Program& made = rewriting.made();
        const std::function<int(std::vector<Piece>, const Rational&)> build =
            [&](std::vector<Piece> list, const Rational& constant) -> int {
            std::map<int, int> occurs;
            for (const Piece& piece : list)
                for (const auto& [factor, exponent] : piece.factors) ++occurs[factor];
            int best = -1;
            for (const auto& [factor, count] : occurs)
                if (count > 1 && (best < 0 || count > occurs[best])) best = factor;
            std::vector<Program::Term> terms;
            if (best >= 0) {
                std::vector<Piece> inside, outside;
                Rational inner_constant = 0;
                for (Piece& piece : list) {
                    const auto found = piece.factors.find(best);
                    if (found == piece.factors.end()) {
                        outside.push_back(std::move(piece));
                        continue;
                    }
                    if (--found->second == 0) piece.factors.erase(found);
                    if (piece.factors.empty())
                        inner_constant = inner_constant + piece.coefficient;
                    else
                        inside.push_back(std::move(piece));
                }
                const int inner = build(std::move(inside), inner_constant);
                terms.emplace_back(1, made.product(1, {{rewriting.image(best), 1}, {inner, 1}}));
                if (outside.empty()) return made.sum(constant, terms);
                terms.emplace_back(1, build(std::move(outside), constant));
                return made.sum(0, terms);
            }
            for (const Piece& piece : list) {
                std::vector<Program::Factor> factors;
                for (const auto& [factor, exponent] : piece.factors)
                    factors.emplace_back(rewriting.image(factor), exponent);
                terms.emplace_back(piece.coefficient, made.product(1, factors));
            }
            return made.sum(constant, terms);
        };
        return build(std::move(pieces), node.number);
    });
}

/// k·(k′·a) → (k·k′)·a, where k and k′ depend on parameters only and k′·a is not needed elsewhere.
Program with_gathered_constants(const Program& old) {
    Rewriting rewriting(old);
    std::map<int, int> uses;
    for (const int id : old.needed(old.right_hand_side()))
        for (const int arg : old[id].args) ++uses[arg];
    for (const int id : old.right_hand_side()) ++uses[id];

    const auto has_constant = [&](const Node& node) {
        return std::any_of(node.args.begin(), node.args.end(), [&](int arg) { return old[arg].is_constant(); });
    };
    return rewriting.finish([&](int id) {
        const Node& node = old[id];
        if (node.op != Op::product || node.is_constant() || node.is_reciprocal() || !has_constant(node))
            return rewriting.plain(id);
        std::vector<Program::Factor> factors;
        for (std::size_t k = 0; k < node.args.size(); ++k) {
            const int arg = node.args[k];
            const Node& inner = old[arg];
            if (node.exponents[k] != 1 || uses[arg] != 1 || inner.op != Op::product || inner.is_reciprocal() ||
                !has_constant(inner)) {
                factors.emplace_back(rewriting.image(arg), node.exponents[k]);
                continue;
            }
            for (std::size_t i = 0; i < inner.args.size(); ++i)
                factors.emplace_back(rewriting.image(inner.args[i]), inner.exponents[i]);
        }
        return rewriting.made().product(1, factors);
    });
}

Program with_pairs_and_constants(const Program& old) {
    return with_gathered_constants(with_shared_pairs(old));
}

int cost(const Program& program) {
    return program.count(program.right_hand_side()).total();
}

}  // namespace

Program shared(Program best) {
    for (const auto pass : {with_common_factors, with_pairs_and_constants}) {
        Program next = pass(best).canonical();
        if (cost(next) < cost(best)) best = std::move(next);
    }
    return best;
}

}  // namespace alembert
