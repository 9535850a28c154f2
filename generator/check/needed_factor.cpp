// SPDX-License-Identifier: GPL-2.0-or-later
// R(ρ) (1 + cρ) = a + bρ at ρ = 1, 2, 3 is a linear system for a, b, c; R vanishes at ρ = −a/b.
#include "check/needed_factor.hpp"

#include <algorithm>
#include <array>
#include <functional>

#include "check/missing_terms.hpp"
#include "check/steady_factor.hpp"

namespace alembert {

namespace {

using Values = SteadyFactors::Values;

class Needed {
public:
    Needed(const Claim& claim, const Edits& edits, const ClaimWords& words, const Mechanism& m,
           ClaimArithmetic& arithmetic)
        : claim_(claim), edits_(edits), words_(words), m_(m), arithmetic_(arithmetic) {}

    std::vector<Edit> find() {
        if (arithmetic_.points() < SteadyFactors::states) return {};
        read_names();
        read_movers();
        for (const Summand& s : edits_.summands) {
            if (s.in_angle || edits_.is_whole(s)) continue;
            const std::optional<Values> ratio = needed(s);
            if (!ratio) continue;
            add_factors(s, *ratio);
            if (!s.in_derivative) add_inner_terms(s, *ratio);
        }
        return std::move(found_);
    }

private:
    struct Mover {
        TreePtr base;
        int exponent;
        Values values;
    };

    std::optional<Values> values_of(const Tree& tree) {
        Values result;
        for (std::size_t k = 0; k < SteadyFactors::states; ++k) {
            const auto value = arithmetic_.value(tree, k);
            if (!value || value->is_zero()) return std::nullopt;
            result[k] = *value;
        }
        return result;
    }

    void read_names() {
        std::vector<Values> values;
        for (const TreePtr& tree : steady_sums(claim_, m_)) {
            const auto value = values_of(*tree);
            if (!value) continue;
            trees_.push_back(tree);
            values.push_back(*value);
        }
        known_.emplace(std::move(values));
    }

    /// What moves and may be a factor, with the exponents that are tried.
    void read_movers() {
        const auto add = [&](const TreePtr& base, std::vector<int> exponents) {
            const auto values = values_of(*base);
            if (!values) return;
            for (const int exponent : exponents) {
                Values powers;
                for (std::size_t k = 0; k < powers.size(); ++k) {
                    powers[k] = (*values)[k].power(static_cast<std::uint64_t>(std::abs(exponent)));
                    if (exponent < 0) powers[k] = powers[k].inverse();
                }
                movers_.push_back({base, exponent, powers});
            }
        };
        for (const TreePtr& angle : words_.angles)
            for (const char* function : {"cos", "sin"})
                add(made(Tree::Kind::call, {angle}, function), {1, 2, -1, -2});
        for (const std::string& name : words_.coordinates) {
            add(name_tree(name), {1, -1, 2, -2});
            add(name_tree(name, 1), {1, -1});
        }
    }

    std::optional<Prime> residual(const Summand& s, Prime scale, std::size_t point) {
        arithmetic_.scale(s.whole.get(), scale);
        const auto result = arithmetic_.residual(*claim_.equation.lhs.tree, *claim_.equation.rhs.tree, point);
        arithmetic_.scale(nullptr, 1);
        return result;
    }

    std::optional<Values> needed(const Summand& s) {
        Values result;
        for (std::size_t k = 0; k < result.size(); ++k) {
            std::array<Prime, 4> r;
            for (std::size_t e = 0; e < r.size(); ++e) {
                const auto value = residual(s, Prime(static_cast<std::int64_t>(e + 1)), k);
                if (!value) return std::nullopt;
                r[e] = *value;
            }
            // Differences: (R₂ − R₁) + c (2R₂ − R₁) = b, and so on.
            const Prime d1 = r[1] - r[0], d2 = r[2] - r[1], e1 = 2 * r[1] - r[0], e2 = 3 * r[2] - 2 * r[1];
            Prime c = 0;
            if (d1 != d2) {
                if (e1 == e2) return std::nullopt;
                c = (d2 - d1) * (e1 - e2).inverse();
            }
            const Prime b = d1 + c * e1, a = r[0] * (1 + c) - b;
            if (r[3] * (1 + 4 * c) != a + 4 * b || b.is_zero()) return std::nullopt;
            result[k] = -a * b.inverse();
            if ((1 + c * result[k]).is_zero()) return std::nullopt;
        }
        return result;
    }

    TreePtr times(const TreePtr& body, const SteadyFactor& factor) const {
        ProductTree product(body, steady_);
        if (std::abs(factor.n) != 1 || factor.d != 1) product.times(std::abs(factor.n), factor.d);
        for (const auto& [which, exponent] : factor.powers) product.times(trees_[which], exponent);
        return product.tree();
    }

    /// How much there is in a factor, beyond a single parameter.
    double effort(const SteadyFactor& factor) const {
        double result = 0;
        for (const auto& [which, exponent] : factor.powers)
            result +=
                trees_[which]->kind == Tree::Kind::name ? 0.3 * std::abs(exponent) : 0.9 * std::abs(exponent);
        if (factor.n < 0) result += 1;
        if (factor.d != 1 || std::abs(factor.n) != 1)
            result += 0.3 + 0.05 * std::max(std::abs(factor.n), factor.d);
        if (factor.d != 1 && std::abs(factor.n) != 1) result += 0.9;
        return result;
    }

    void add_factors(const Summand& s, const Values& ratio) {
        constexpr double of_parameters = 1.9, of_mover = 2.4, largest_effort = 2.6, of_digit = 0.03;
        const auto add = [&](const SteadyFactor& factor, const Mover* mover, double size) {
            if (effort(factor) > largest_effort) return;
            TreePtr body = times(s.body, factor);
            if (mover != nullptr) {
                ProductTree product(body, steady_);
                product.times(mover->base, mover->exponent);
                body = product.tree();
            }
            bool is_length = mover == nullptr && !factor.powers.empty();
            for (const auto& [which, exponent] : factor.powers)
                is_length = is_length && words_.lengths.contains(plain_text_of(*trees_[which]));
            const double digits = of_digit * static_cast<double>(size_of_numbers(body) - 2);
            Edit edit =
                edits_.with_body(s, body, is_length ? "wrong_arm" : "factor", size + effort(factor) + digits);
            if (factor.n < 0) edit = turned(s, body, std::move(edit));
            if (factor.n > 0) name_factor(edit, s, factor, mover);
            found_.push_back(std::move(edit));
        };
        if (const auto factor = known_->of(ratio); factor && !(factor->is_number() && factor->n == factor->d))
            add(*factor, nullptr, of_parameters);
        if (s.in_derivative) return;
        for (const Mover& mover : movers_) {
            Values rest;
            for (std::size_t k = 0; k < rest.size(); ++k) rest[k] = ratio[k] * mover.values[k].inverse();
            if (const auto factor = known_->of(rest))
                add(*factor, &mover, of_mover + 0.15 * (std::abs(mover.exponent) - 1));
        }
    }

    /// What is missing or too much, if it is one of both.
    void name_factor(Edit& edit, const Summand& s, const SteadyFactor& factor, const Mover* mover) const {
        const bool is_one = factor.n == 1 && factor.d == 1;
        if (is_one && mover == nullptr && factor.powers.size() == 1)
            return edits_.name_factor(edit, s.body, trees_[factor.powers[0].first], factor.powers[0].second);
        if (is_one && mover != nullptr && factor.powers.empty())
            return edits_.name_factor(edit, s.body, mover->base, mover->exponent);
        TreePtr above = number_tree(factor.n), below = number_tree(factor.d);
        const auto multiply = [&](const TreePtr& base, int exponent) {
            TreePtr& side = exponent > 0 ? above : below;
            ProductTree product(side, steady_);
            product.times(base, std::abs(exponent));
            side = merged(product.tree(), steady_);
        };
        for (const auto& [which, exponent] : factor.powers) multiply(trees_[which], exponent);
        if (mover != nullptr) multiply(mover->base, mover->exponent);
        const std::string more = plain_text_of(*above), less = plain_text_of(*below);
        if (less == "1") edit.meant = more;
        if (more == "1") edit.written = less;
    }

    Edit turned(const Summand& s, const TreePtr& body, Edit edit) const {
        const TreePtr by = s.negative ? body : made(Tree::Kind::negate, {body});
        Edit result = edits_.with_part_of(s, s.whole.get(), by, edit.kind, 0);
        result.size = edit.size;
        result.should_be = plain_text_of(*(s.negative ? body : made(Tree::Kind::negate, {body})));
        return result;
    }

    /// psi' in place of (psi' + phi'*cos(theta)): a factor of the term that lacks a term of its own.
    void add_inner_terms(const Summand& s, const Values& ratio) {
        constexpr double of_inner_term = 2.75, largest_effort = 0.7;
        std::vector<TreePtr> factors{s.body};
        if (s.body->kind == Tree::Kind::product) factors = s.body->args;
        for (const TreePtr& factor : factors) {
            if (factor->kind != Tree::Kind::name && factor->kind != Tree::Kind::sum) continue;
            if (factor == s.body && !s.alone) continue;  // a term of the same sum
            if (factor == s.body && !s.in_derivative && factor->kind == Tree::Kind::sum) continue;
            const auto values = values_of(*factor);
            if (!values || ratio[0].is_zero()) continue;
            Values missing;
            for (std::size_t k = 0; k < missing.size(); ++k) missing[k] = (*values)[k] * (ratio[k] - 1);
            const auto add = [&](const TreePtr& term, const SteadyFactor& by) {
                const double own = effort(by) - (by.n < 0 ? 0.95 : 0);
                if (own > largest_effort) return;
                const TreePtr more = times(term, by);
                found_.push_back(edits_.with_inner_term(
                    s, factor, by.n < 0 ? made(Tree::Kind::negate, {more}) : more, of_inner_term + 1.8 * own));
            };
            if (const auto by = known_->of(missing); by && !by->is_number()) add(number_tree(1), *by);
            for (const Mover& a : movers_) {
                if (a.exponent < 1) continue;
                try_term(missing, a.values, a, nullptr, add);
                if (a.base->kind != Tree::Kind::name || a.exponent != 1) continue;
                for (const Mover& b : movers_) {
                    if (b.exponent != 1 || b.base->kind != Tree::Kind::call) continue;
                    Values product;
                    for (std::size_t k = 0; k < product.size(); ++k) product[k] = a.values[k] * b.values[k];
                    try_term(missing, product, a, &b, add);
                }
            }
        }
    }

    template <typename Add>
    void try_term(const Values& missing, const Values& values, const Mover& a, const Mover* b, const Add& add) {
        Values rest;
        for (std::size_t k = 0; k < rest.size(); ++k) rest[k] = missing[k] * values[k].inverse();
        const auto by = known_->of(rest);
        if (!by) return;
        TreePtr term = a.exponent == 1 ? a.base : made(Tree::Kind::power, {a.base, number_tree(a.exponent)});
        if (b != nullptr) term = made(Tree::Kind::product, {term, b->base});
        add(term, *by);
    }

    const Claim& claim_;
    const Edits& edits_;
    const ClaimWords& words_;
    const Mechanism& m_;
    ClaimArithmetic& arithmetic_;
    std::function<bool(const Tree&)> steady_ = [this](const Tree& tree) { return words_.is_steady(tree); };
    std::vector<TreePtr> trees_;
    std::optional<SteadyFactors> known_;
    std::vector<Mover> movers_;
    std::vector<Edit> found_;
};

}  // namespace

std::vector<Edit> needed_factors(const Claim& claim, const Edits& edits, const ClaimWords& words,
                                 const Mechanism& mechanism, ClaimArithmetic& arithmetic) {
    return Needed(claim, edits, words, mechanism, arithmetic).find();
}

}  // namespace alembert
