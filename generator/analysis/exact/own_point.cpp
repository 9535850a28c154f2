// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/own_point.hpp"

#include <cln/rational.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/exact/angle_variables.hpp"
#include "analysis/exact/counted_angle.hpp"
#include "analysis/exact/rational_polynomial.hpp"
#include "analysis/exact/solving_order.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::symbol;

namespace {

using Key = RealState::Key;

std::vector<SolvedUnknown> unknowns_of(const std::vector<SolvingStep>& steps) {
    std::vector<SolvedUnknown> result;
    for (const SolvingStep& step : steps) {
        result.push_back(step);
        if (step.second) result.push_back(*step.second);
    }
    return result;
}

std::optional<Prime> prime_of(const numeric& value) {
    if (!value.is_rational()) return std::nullopt;
    return Prime::from(cln::the<cln::cl_RA>(value.to_cl_N()));
}

/// One point: the steps are taken one after the other.
class Tracing {
public:
    Tracing(const Program& program, const RealState& own, int halves, std::mt19937_64& random)
        : program_(program), own_(own), halves_(halves), random_(random) {}

    /// The free variables of `own`, which are fractions or have fractions as tangents.
    void set_free(const std::vector<SolvedUnknown>& solved) {
        state_ = own_;
        for (const SolvedUnknown& unknown : solved) state_.value.erase(key_of(unknown));
    }

    std::optional<OwnRoot> take(const SolvingStep& step) {
        if (holds_derived(step)) return step.second ? std::nullopt : std::optional(derived(step));
        if (step.second) return take_two(step);
        const symbol X("X");
        const auto f = polynomial(step, {{step, X}});
        if (!f || !f->has(X)) return std::nullopt;
        const bool is_rational = std::none_of(irrational_.begin(), irrational_.end(),
                                              [&](const Irrational& root) { return f->has(root.symbol); });
        if (irrational_.empty() || (is_rational && f->degree(X) == 1)) {
            const auto factor = own_factor(*f, X, own_value(step));
            if (!factor) return std::nullopt;
            if (factor->degree(X) == 1) {
                put(step, GiNaC::ex_to<numeric>(-factor->coeff(X, 0) / factor->coeff(X, 1)));
                return zero_of(*factor, X, {{step, numeric(1)}});
            }
            irrational_.push_back({step, X, *factor});
            return zero_of(*factor, X, {{step, numeric(1)}});
        }
        if (f->degree(X) == 1) return derived(step);
        const symbol T("T");
        std::vector<std::pair<SolvedUnknown, numeric>> theta{{step, numeric(1)}};
        ex other = T;
        for (const Irrational& root : irrational_) {
            theta.emplace_back(root.of, weight());
            other -= theta.back().second * root.symbol;
        }
        const auto factor = eliminated(f->subs(X == other), T, theta);
        const auto alone = eliminated(*f, X, {{step, numeric(1)}});
        if (!factor || !alone) return std::nullopt;
        irrational_.push_back({step, X, *alone});
        return zero_of(*factor, T, theta);
    }

private:
    struct Irrational {
        SolvedUnknown of;
        GiNaC::symbol symbol;
        ex minimal;  ///< its minimal polynomial, in the symbol
    };

    static constexpr int most_degree = 40;

    numeric weight() { return static_cast<int>(2 + random_() % 997); }

    numeric own_value(const SolvedUnknown& unknown) const {
        const numeric& value = own_.value.at(key_of(unknown));
        return unknown.turned ? counted_angle::of(value, halves_) : value;
    }

    void put(const SolvedUnknown& unknown, const numeric& x) {
        if (unknown.turned)
            put_angle(state_, key_of(unknown), counted_angle::angle_at(x, halves_));
        else
            state_.value[key_of(unknown)] = x;
    }

    bool holds_derived(const SolvingStep& step) const {
        return std::any_of(derived_.begin(), derived_.end(), [&](const SolvedUnknown& unknown) {
            return holds(program_, step.node, unknown) ||
                   (step.second && holds(program_, step.second->node, unknown));
        });
    }

    /// A root that is the only one, in an irrational extension: its own polynomial is not needed.
    OwnRoot derived(const SolvingStep& step) {
        derived_.push_back(step);
        return {};
    }

    /// The condition as a polynomial in these unknowns and the irrational roots in it.
    std::optional<ex> polynomial(const SolvedUnknown& condition,
                                 std::vector<std::pair<SolvedUnknown, symbol>> unknowns) {
        for (const Irrational& root : irrational_)
            if (holds(program_, condition.node, root.of)) unknowns.emplace_back(root.of, root.symbol);
        std::vector<PolynomialVariable> variables;
        for (const auto& [unknown, x] : unknowns) variables.push_back({x, unknown.turned});
        const RealState before = state_;
        const auto f = polynomial_through(
            [&](const std::vector<numeric>& x) -> std::optional<numeric> {
                for (std::size_t i = 0; i < x.size(); ++i) put(unknowns[i].first, x[i]);
                const auto value = evaluate(program_, state_, {condition.node});
                if (!value || !(*value)[0].is_rational()) return std::nullopt;
                return (*value)[0];
            },
            variables);
        state_ = before;
        return f;
    }

    numeric theta_of(const std::vector<std::pair<SolvedUnknown, numeric>>& theta) const {
        numeric sum = 0;
        for (const auto& [unknown, by] : theta) sum += by * own_value(unknown);
        return sum;
    }

    /// The factor of the polynomial in T, from which the irrational roots are eliminated, that vanishes at θ.
    std::optional<ex> eliminated(ex f, const symbol& T,
                                 const std::vector<std::pair<SolvedUnknown, numeric>>& theta) {
        for (const Irrational& root : irrational_) {
            f = f.expand();
            if (!f.has(root.symbol)) continue;
            if (f.degree(T) * root.minimal.degree(root.symbol) > most_degree) return std::nullopt;
            const bool is_last =
                std::none_of(irrational_.begin(), irrational_.end(),
                             [&](const Irrational& other) { return &other != &root && f.has(other.symbol); });
            f = is_last ? alembert::eliminated(root.minimal, f, root.symbol, T)
                        : GiNaC::resultant(root.minimal, f, root.symbol);
        }
        return own_factor(f.expand(), T, theta_of(theta));
    }

    std::optional<OwnRoot> take_two(const SolvingStep& step) {
        const symbol X("X"), Y("Y"), T("T");
        const auto f = polynomial(step, {{step, X}, {*step.second, Y}});
        const auto g = polynomial(*step.second, {{step, X}, {*step.second, Y}});
        if (!f || !g) return std::nullopt;
        std::vector<std::pair<SolvedUnknown, numeric>> theta{{step, numeric(1)}, {*step.second, weight()}};
        ex other = T - theta[1].second * Y;
        for (const Irrational& root : irrational_) {
            theta.emplace_back(root.of, weight());
            other -= theta.back().second * root.symbol;
        }
        const auto pair_of = [&](const ex& x, const ex& y, const symbol& out, const symbol& by,
                                 const std::vector<std::pair<SolvedUnknown, numeric>>& of) -> std::optional<ex> {
            const ex a = f->subs(GiNaC::lst{X == x, Y == y}).expand(),
                     b = g->subs(GiNaC::lst{X == x, Y == y}).expand();
            if (!a.has(by) || !b.has(by)) return std::nullopt;
            return eliminated(
                irrational_.empty() ? alembert::eliminated(a, b, by, out) : GiNaC::resultant(a, b, by), out, of);
        };
        const auto factor = pair_of(other, Y, T, Y, theta);
        if (!factor) return std::nullopt;
        if (irrational_.empty() && factor->degree(T) == 1) {
            const auto x = pair_of(X, Y, X, Y, {{step, numeric(1)}});
            const auto y = pair_of(X, Y, Y, X, {{*step.second, numeric(1)}});
            if (!x || !y || x->degree(X) != 1 || y->degree(Y) != 1) return std::nullopt;
            put(step, GiNaC::ex_to<numeric>(-x->coeff(X, 0) / x->coeff(X, 1)));
            put(*step.second, GiNaC::ex_to<numeric>(-y->coeff(Y, 0) / y->coeff(Y, 1)));
        } else {
            derived_.push_back(step);  // what follows from them is beyond the resultants that are tried
            derived_.push_back(*step.second);
        }
        return zero_of(*factor, T, theta);
    }

    static std::optional<OwnRoot> zero_of(const ex& factor, const symbol& x,
                                          const std::vector<std::pair<SolvedUnknown, numeric>>& theta) {
        OwnRoot root;
        for (int k = 0; k <= factor.degree(x); ++k) {
            const auto c = prime_of(GiNaC::ex_to<numeric>(factor.coeff(x, k)));
            if (!c) return std::nullopt;
            root.factor.push_back(*c);
        }
        for (const auto& [unknown, by] : theta) root.theta.emplace_back(unknown, *prime_of(by));
        return root;
    }

    const Program& program_;
    const RealState& own_;
    int halves_;
    std::mt19937_64& random_;
    RealState state_;                     ///< fractions only
    std::vector<Irrational> irrational_;  ///< the roots found so far that are no fractions
    std::vector<SolvedUnknown> derived_;  ///< those that follow from them
};

}  // namespace

std::optional<OwnPoint> OwnPoints::at(std::uint64_t seed) const {
    constexpr double reach = 1.0 / 128;
    if (branch_.places.empty()) return std::nullopt;
    const FiftyDigits digits;
    std::mt19937_64 random(seed * 0x9e3779b97f4a7c15ULL + 1);
    const State<double>& place = branch_.places[seed % branch_.places.size()];
    const std::vector<SolvedUnknown> solved = unknowns_of(steps_);
    std::vector<int> conditions;
    std::vector<Key> keys;
    for (const SolvedUnknown& unknown : solved) {
        conditions.push_back(unknown.node);
        keys.push_back(key_of(unknown));
    }
    std::set<Key> angles, plain;
    find_variables(program_, conditions, angles, plain);
    OwnPoint point;
    const auto beside = [&](double value) {
        // one of 2³⁰ fractions within the reach, with the denominator 2⁴⁰
        const double away = std::ldexp(static_cast<double>(random() >> 34), -30) * 2 - 1;
        const double fine = std::ldexp(value + reach * (1 + std::abs(value)) * away, 40);
        return numeric(cln::cl_N(cln::rational(cln::cl_DF(std::round(fine))))) /
               GiNaC::pow(numeric(2), numeric(40));
    };
    const auto state =
        state_beside(program_, conditions, place, keys, reach, [&](RealState& to, const Key& key, double value) {
            const bool is_angle = angles.contains(key) && !plain.contains(key);
            const numeric x = beside(is_angle ? counted_angle::of(value, halves_).to_double() : value);
            if (is_angle)
                put_angle(to, key, counted_angle::angle_at(x, halves_));
            else
                to.value[key] = x;
            (is_angle ? point.angles : point.values)[key] = *prime_of(x);
        });
    if (!state) return std::nullopt;
    Tracing tracing(program_, *state, halves_, random);
    tracing.set_free(solved);
    for (const SolvingStep& step : steps_) {
        auto root = tracing.take(step);
        if (!root) return std::nullopt;
        point.roots.push_back(std::move(*root));
    }
    return point;
}

}  // namespace alembert
