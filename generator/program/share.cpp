// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/share.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <queue>
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

/// Replaces pairs that occur in several bags by new items, most frequent first, and of equally frequent ones the
/// one that was met first. New items are numbered from `first`.
class Pairing {
public:
    struct Pair {
        int a, b;
        Rational ratio;  ///< a + ratio·b, or a·b with ratio 1
        bool operator<(const Pair& o) const {
            return std::tie(a, b) != std::tie(o.a, o.b) ? std::tie(a, b) < std::tie(o.a, o.b) : ratio < o.ratio;
        }
        bool operator==(const Pair& o) const { return a == o.a && b == o.b && cln::equal(ratio, o.ratio); }
    };

    Pairing(std::vector<Bag> bags, int first) : bags_(std::move(bags)), next_(first) {}

    void run() {
        for (std::size_t k = 0; k < bags_.size(); ++k)
            for (const Pair& pair : pairs_of(bags_[k])) enter(pair, k);
        while (!by_count_.empty()) {
            const auto [count, minus_id] = by_count_.top();
            by_count_.pop();
            const auto id = static_cast<std::size_t>(-minus_id);
            if (met_[id].count != count) continue;  // it has changed since
            const Pair best = met_[id].pair;
            const int item = next_++;
            pairs.push_back(best);
            for (const std::size_t k : users_of(id)) {
                const std::vector<Pair> before = pairs_of(bags_[k]);
                replace(bags_[k], best, item);
                change(k, before, pairs_of(bags_[k]));
            }
            wait(id);
        }
    }

    const std::vector<Bag>& bags() const { return bags_; }
    std::vector<Pair> pairs;

private:
    struct Met {
        Pair pair;
        int count = 0;      ///< of bags that hold it
        int last_use = -1;  ///< in `uses_`
    };
    struct Use {
        std::size_t bag;  ///< held the pair, and may have lost it
        int earlier;      ///< the use before, of the same pair
    };

    /// Each pair once, in order.
    static std::vector<Pair> pairs_of(const Bag& bag) {
        std::vector<Pair> result;
        // The number of pairs grows with the square, and such long sums share little.
        const std::size_t n = bag.items.size() > 24 ? 0 : bag.items.size();
        if (n > 1) result.reserve(n * (n - 1) / 2);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j) result.push_back(make(bag.items[i], bag.items[j]));
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
    }

    static Pair make(const std::pair<int, Rational>& x, const std::pair<int, Rational>& y) {
        return x.first <= y.first ? Pair{x.first, y.first, quotient(y.second, x.second)}
                                  : Pair{y.first, x.first, quotient(x.second, y.second)};
    }

    static Rational quotient(const Rational& x, const Rational& y) {
        return cln::equal(y, 1) ? x : cln::equal(x, y) ? Rational(1) : x / y;
    }

    static std::uint64_t hash_of_pair(const Pair& pair) {
        std::uint64_t h = (static_cast<std::uint64_t>(pair.a) << 32) ^ static_cast<std::uint64_t>(pair.b);
        h = (h ^ cln::equal_hashcode(pair.ratio)) * 0x9e3779b97f4a7c15ULL;
        h = (h ^ (h >> 32)) * 0xbf58476d1ce4e5b9ULL;
        return h ^ (h >> 29);
    }

    int known(const Pair& pair, std::uint64_t hash) const {
        return known_.find(hash, [&](int id) { return met_[static_cast<std::size_t>(id)].pair == pair; });
    }

    void enter(const Pair& pair, std::size_t bag) {
        const std::uint64_t hash = hash_of_pair(pair);
        int id = known(pair, hash);
        if (id < 0) {
            id = static_cast<int>(met_.size());
            known_.insert(hash, id);
            met_.push_back({.pair = pair});
        }
        Met& met = met_[static_cast<std::size_t>(id)];
        uses_.push_back({.bag = bag, .earlier = met.last_use});
        met.last_use = static_cast<int>(uses_.size()) - 1;
        ++met.count;
        wait(static_cast<std::size_t>(id));
    }

    void leave(const Pair& pair) {
        const auto id = static_cast<std::size_t>(known(pair, hash_of_pair(pair)));
        --met_[id].count;
        wait(id);
    }

    /// Bag k has other pairs than before.
    void change(std::size_t k, const std::vector<Pair>& before, const std::vector<Pair>& after) {
        auto old = before.begin();
        for (const Pair& pair : after) {
            for (; old != before.end() && *old < pair; ++old) leave(*old);
            if (old != before.end() && *old == pair)
                ++old;
            else
                enter(pair, k);
        }
        for (; old != before.end(); ++old) leave(*old);
    }

    /// Enters the pair with its count of now. Entries with former counts stay, and are passed over.
    void wait(std::size_t id) {
        if (met_[id].count > 1) by_count_.emplace(met_[id].count, -static_cast<int>(id));
    }

    /// The bags that hold the pair, in order.
    std::vector<std::size_t> users_of(std::size_t id) const {
        std::vector<std::size_t> users;
        for (int use = met_[id].last_use; use >= 0; use = uses_[static_cast<std::size_t>(use)].earlier)
            users.push_back(uses_[static_cast<std::size_t>(use)].bag);
        std::sort(users.begin(), users.end());
        users.erase(std::unique(users.begin(), users.end()), users.end());
        std::erase_if(users, [&](std::size_t k) { return !place_of(bags_[k], met_[id].pair); });
        return users;
    }

    /// The positions of a and b.
    static std::optional<std::pair<std::size_t, std::size_t>> place_of(const Bag& bag, const Pair& pair) {
        for (std::size_t i = 0; i < bag.items.size(); ++i) {
            if (bag.items[i].first != pair.a) continue;
            for (std::size_t j = 0; j < bag.items.size(); ++j)
                if (i != j && bag.items[j].first == pair.b &&
                    cln::equal(quotient(bag.items[j].second, bag.items[i].second), pair.ratio))
                    return std::make_pair(i, j);
        }
        return std::nullopt;
    }

    static void replace(Bag& bag, const Pair& pair, int item) {
        const auto place = place_of(bag, pair);
        if (!place) return;
        const auto [i, j] = *place;
        const Rational weight = bag.items[i].second;
        bag.items.erase(bag.items.begin() + static_cast<std::ptrdiff_t>(std::max(i, j)));
        bag.items.erase(bag.items.begin() + static_cast<std::ptrdiff_t>(std::min(i, j)));
        bag.items.emplace_back(item, weight);
    }

    std::vector<Bag> bags_;
    int next_;
    std::vector<Met> met_;  ///< in the order in which they were met
    KnownItems known_;      ///< their positions
    std::vector<Use> uses_;
    std::priority_queue<std::pair<int, int>> by_count_;  ///< count, minus position
};

Program with_shared_pairs(const Program& old) {
    Rewriting rewriting(old);
    std::vector<Bag> products, sums;
    const auto size = static_cast<std::size_t>(old.size());
    std::vector<int> product_of(size, -1), sum_of(size, -1);  // the positions of their bags
    for (const int id : rewriting.needed) {
        const Node& node = old[id];
        if (node.is_constant() || node.is_reciprocal()) continue;
        Bag bag{id, {}};
        if (node.op == Op::product) {
            for (std::size_t k = 0; k < node.args.size(); ++k)
                for (int e = 0; e < node.exponents[k]; ++e) bag.items.emplace_back(node.args[k], 1);
            product_of[id] = static_cast<int>(products.size());
            products.push_back(std::move(bag));
        } else if (node.op == Op::sum && !node.is_scaled()) {
            for (std::size_t k = 0; k < node.args.size(); ++k)
                bag.items.emplace_back(node.args[k], node.coefficients[k]);
            sum_of[id] = static_cast<int>(sums.size());
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
        if (const int bag = product_of[id]; bag >= 0) {
            std::vector<Program::Factor> list;
            for (const auto& [item, weight] : factors.bags()[static_cast<std::size_t>(bag)].items)
                list.emplace_back(factor(item), 1);
            return rewriting.made().product(1, list);
        }
        if (const int bag = sum_of[id]; bag >= 0) {
            std::vector<Program::Term> list;
            for (const auto& [item, weight] : terms.bags()[static_cast<std::size_t>(bag)].items)
                list.emplace_back(weight, term(item));
            return rewriting.made().sum(old[id].number, list);
        }
        return rewriting.plain(id);
    });
}

/// a·b + a·c → a·(b + c), for products that are used once.
Program with_common_factors(const Program& old) {
    Rewriting rewriting(old);
    std::vector<int> uses(static_cast<std::size_t>(old.size()), 0);
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
    std::vector<int> uses(static_cast<std::size_t>(old.size()), 0);
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
    int least = cost(best);
    for (const auto pass : {with_common_factors, with_pairs_and_constants}) {
        Program next = pass(best).canonical();
        const int operations = cost(next);
        if (operations >= least) continue;
        least = operations;
        best = std::move(next);
    }
    return best;
}

}  // namespace alembert
