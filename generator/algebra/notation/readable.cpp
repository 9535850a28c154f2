// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/readable.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra/notation/angles.hpp"
#include "algebra/notation/common_factor.hpp"
#include "algebra/notation/compose.hpp"
#include "algebra/notation/differences.hpp"

namespace alembert {

namespace {

using Kind = AtomNode::Kind;
using Symbol = SymbolInfo::Kind;

bool is_rate(const AtomNode& atom) {
    if (atom.kind != Kind::symbol) return false;
    return atom.info.order == 1 ? atom.info.kind == Symbol::coordinate
                                : atom.info.order == 0 && atom.info.kind == Symbol::speed;
}

bool is_acceleration(const AtomNode& atom) {
    if (atom.kind != Kind::symbol) return false;
    return atom.info.order >= (atom.info.kind == Symbol::speed ? 1 : 2) &&
           (atom.info.kind == Symbol::coordinate || atom.info.kind == Symbol::speed);
}

bool is_opaque(const AtomNode& atom) {
    return !atom.steady && (atom.kind == Kind::base || atom.kind == Kind::function);
}

bool is_outside(const AtomNode& atom) {
    return atom.kind == Kind::symbol && (atom.info.kind == Symbol::input || atom.info.kind == Symbol::other ||
                                         atom.info.kind == Symbol::definition);
}

/// Whether an atom belongs to the key by which terms without accelerations are grouped; the rest of a term is its
/// coefficient.
bool is_key(const AtomNode& atom) {
    return is_rate(atom) || is_acceleration(atom) || is_opaque(atom) || is_outside(atom);
}

enum class Class { acceleration, quadratic, linear, position };

Class classify(const Monomial& monomial) {
    Rational degree = 0;
    for (const Factor& factor : monomial) {
        if (is_acceleration(*factor.atom)) return Class::acceleration;
        if (is_rate(*factor.atom)) degree = degree + factor.exponent;
    }
    return degree > 1 ? Class::quadratic : degree == 1 ? Class::linear : Class::position;
}

/// Replaces a base such as [sin θ]^(−3) by sin θ to the power −3, because sines count as variables here.
Monomial resolve_bases(const Monomial& monomial) {
    Monomial result;
    for (const Factor& factor : monomial) {
        const bool is_base = factor.atom->kind == Kind::base && factor.atom->args[0].size() == 1;
        const Term* only = is_base ? &factor.atom->args[0].terms()[0] : nullptr;
        const bool is_wave =
            only && only->monomial.size() == 1 && circular(only->monomial) && only->coefficient == 1;
        result = result * (is_wave ? Monomial{{only->monomial[0].atom, factor.exponent}} : Monomial{factor});
    }
    return result;
}

Polynomial times(const Monomial& key, const Polynomial& coefficient) {
    std::vector<Term> terms;
    for (const Term& term : coefficient.terms())
        terms.push_back({resolve_bases(key * term.monomial), term.coefficient});
    return Polynomial::collect(std::move(terms));
}

using Lines = std::vector<Polynomial>;  ///< each is one term of the outermost sum

bool has_decimals(const Fourier& f) {
    return std::any_of(f.terms().begin(), f.terms().end(),
                       [](const Term& term) { return is_decimal(term.coefficient); });
}

class Writer {
public:
    explicit Writer(Composer& compose) : compose_(compose) {}

    Lines lines(const Fourier& f) {
        std::vector<Term> accelerated, others;
        for (const Term& term : f.terms())
            (classify(term.monomial) == Class::acceleration ? accelerated : others).push_back(term);
        Lines result;
        add_lines(result, Polynomial::collect(std::move(accelerated)), is_acceleration);
        add_lines(result, Polynomial::collect(std::move(others)), is_key);
        merge_linear_rates(result);
        std::stable_sort(result.begin(), result.end(), before);
        return result;
    }

    /// The lines of an energy: m·(x′² + y′²)/2, with a positive term first.
    Lines energy_lines(const Fourier& f) {
        Lines separate = lines(f);
        Lines result;
        for (Polynomial& line : separate) {
            const auto same = std::find_if(result.begin(), result.end(), [&](const Polynomial& other) {
                return classify(other.terms()[0].monomial) == Class::quadratic &&
                       classify(line.terms()[0].monomial) == Class::quadratic && has_same_coefficient(line, other);
            });
            if (same == result.end())
                result.push_back(std::move(line));
            else
                *same = *same + line;
        }
        const auto positive = std::find_if(result.begin(), result.end(), [&](const Polynomial& line) {
            return compose_(line).kind != Phrase::Kind::negative;
        });
        if (positive != result.end()) std::rotate(result.begin(), positive, positive + 1);
        return result;
    }

    Phrase write(const Lines& lines) {
        std::vector<Phrase> terms;
        for (const Polynomial& line : lines) terms.push_back(compose_(line));
        return phrases::sum(std::move(terms));
    }

private:
    template <typename Predicate>
    void add_lines(Lines& lines, const Polynomial& terms, Predicate is_key) {
        for (const Polynomial& group : partition(terms, is_key)) {
            const Monomial key = part(group.terms()[0].monomial, is_key);
            const auto measure = [&](const Polynomial& form) { return cost(split(times(key, form))); };
            const Polynomial plain = divide(group, key),
                             best = compose_.is_exhausted() ? plain : unfold(plain, measure);
            for (Polynomial& line : split(times(key, best))) lines.push_back(std::move(line));
        }
    }

    int cost(const Lines& lines) {
        int result = std::max(static_cast<int>(lines.size()) - 1, 0);
        for (const Polynomial& line : lines) result += compose_.cost(line);
        return result;
    }

    /// Writes one group as terms of the outermost sum. An acceleration keeps one coefficient; the other groups are
    /// split or factored, whichever is shortest. A part of a sum may vanish in one of its forms, as
    /// sin²α + cos²α − 1 does; it has no terms then.
    Lines split(const Polynomial& group) {
        if (group.is_zero()) return {};
        if (group.size() == 1) return {group};
        const Class kind = classify(group.terms()[0].monomial);
        if (kind == Class::acceleration) return {group};
        const auto is_circular = [](const AtomNode& atom) { return atom.is_circular(); };
        std::vector<Lines> options;
        if (kind == Class::position) {
            const auto offer = [&](Lines option) {
                const auto may_stand = [this](const Polynomial& line) { return may_stand_as_one(line); };
                if (std::all_of(option.begin(), option.end(), may_stand)) options.push_back(std::move(option));
            };
            offer({group});
            offer(partition(group, is_circular));
            options.push_back(by_state(group));
            offer(partition(group, [](const AtomNode& atom) { return atom.steady; }));
            if (Lines powers = powers_of_differences(group); !powers.empty()) options.push_back(std::move(powers));
            if (Lines waves = differences_of_waves(group); !waves.empty()) offer(std::move(waves));
        } else {
            options.push_back(partition(group, is_circular));
            options.push_back({group});
        }
        Lines* best = &options[0];
        int least = cost(*best);
        for (Lines& option : options) {
            const int offered = cost(option);
            if (offered < least) {
                best = &option;
                least = offered;
            }
        }
        return std::move(*best);
    }

    /// A line for each product of state variables; constants that have nothing in common have lines of their own.
    Lines by_state(const Polynomial& group) {
        Lines result;
        for (const Polynomial& line : partition(group, [](const AtomNode& atom) { return !atom.steady; })) {
            if (has_state(line.terms()[0].monomial) || may_stand_as_one(line))
                result.push_back(line);
            else
                for (const Term& term : line.terms()) result.push_back(Polynomial::collect({term}));
        }
        return result;
    }

    /// Whether a group may stay one factored term: k·(r−l0), m·g·l·(1−cos θ), (x1−x2)², k·cos θ·(sin θ−sin φ)
    /// may, but not k·(2·x1−x2), a·(sin θ+sin ψ) or (r·ω²·cos θ−g)·sin θ.
    bool may_stand_as_one(const Polynomial& group) {
        if (group.size() == 1) return true;
        if (has_own_denominators(group)) return false;
        const Factorization factors = compose_.factorizer()(group);
        const auto is_circular = [](const AtomNode& atom) { return atom.is_circular(); };
        const bool is_lone = factors.sums.size() == 1 && factors.sums[0].second == 1;
        if (is_lone && factors.monomial.empty()) return false;
        for (const auto& [sum, exponent] : factors.sums) {
            if (is_difference_of_waves(sum)) continue;
            bool has_wave = false;
            bool has_number = false;
            for (const Term& term : sum.terms()) {
                if (exponent == 1 && has_state(term.monomial) && cln::abs(term.coefficient) != 1) return false;
                has_wave = has_wave || !part(term.monomial, is_circular).empty();
                has_number = has_number || term.monomial.empty();
            }
            if (has_wave && (!has_number || !part(factors.monomial, is_circular).empty())) return false;
        }
        return true;
    }

    /// c·x1′ − c·x2′ = c·(x1′−x2′)
    void merge_linear_rates(Lines& lines) {
        Polynomial all;
        Lines rest;
        int count = 0;
        for (const Polynomial& line : lines) {
            const Monomial& monomial = line.terms()[0].monomial;
            const bool plain = classify(monomial) == Class::linear && circular(monomial) == nullptr;
            if (plain) {
                all = all + line;
                ++count;
            } else {
                rest.push_back(line);
            }
        }
        if (count < 2 || !may_stand_as_one(all)) return;
        Lines separate;
        for (const Polynomial& line : lines)
            if (classify(line.terms()[0].monomial) == Class::linear && !circular(line.terms()[0].monomial))
                separate.push_back(line);
        if (cost({all}) > cost(separate)) return;
        rest.push_back(all);
        lines = std::move(rest);
    }

    bool has_same_coefficient(const Polynomial& a, const Polynomial& b) {
        const Factorization x = compose_.factorizer()(a);
        const Factorization y = compose_.factorizer()(b);
        const auto steady = [](const Factorization& factors) {
            return part(factors.monomial, [](const AtomNode& atom) { return atom.steady; });
        };
        const auto steady_sums = [](const Factorization& factors) {
            Polynomial result = Rational(1);
            for (const auto& [sum, exponent] : factors.sums)
                if (std::none_of(sum.terms().begin(), sum.terms().end(),
                                 [](const Term& term) { return has_state(term.monomial); }))
                    result = result * power(sum, exponent);
            return result;
        };
        const bool is_trivial = steady(x).empty() && steady_sums(x).is_one();
        return !is_trivial && x.unit == y.unit && compare(steady(x), steady(y)) == 0 &&
               steady_sums(x) == steady_sums(y);
    }

    static bool before(const Polynomial& a, const Polynomial& b) {
        const auto key = [](const Polynomial& line) {
            const Monomial& monomial = line.terms()[0].monomial;
            const Class kind = classify(monomial);
            int level = 0;
            if (kind == Class::acceleration)
                level = part(monomial, is_acceleration)[0].atom->info.index;
            else if (kind == Class::quadratic)
                level = part(monomial, is_rate).size() == 1 ? 0 : 1;
            else if (kind == Class::position)
                level = position_level(line);
            return std::pair(kind, level);
        };
        if (key(a) != key(b)) return key(a) < key(b);
        const Monomial& x = a.terms()[0].monomial;
        const Monomial& y = b.terms()[0].monomial;
        if (const int order = compare(part(x, is_rate), part(y, is_rate)); order != 0) return order < 0;
        const auto is_state = [](const AtomNode& atom) { return !atom.steady; };
        if (const int order = compare(part(x, is_state), part(y, is_state)); order != 0) return order < 0;
        return compare(a, b) < 0;
    }

    static int position_level(const Polynomial& line) {
        const auto any = [&](auto is_in) {
            return std::any_of(line.terms().begin(), line.terms().end(),
                               [&](const Term& term) { return !part(term.monomial, is_in).empty(); });
        };
        if (any(is_opaque)) return 2;
        if (any(is_outside)) return 3;
        if (any([](const AtomNode& atom) { return atom.is_circular() && !atom.steady; })) return 0;
        if (any([](const AtomNode& atom) {
                return atom.kind == Kind::symbol && atom.info.kind == Symbol::coordinate;
            }))
            return 1;
        return any([](const AtomNode& atom) { return !atom.steady; }) ? 4 : 5;
    }

    Composer& compose_;
};

/// The number that makes the coefficients coprime integers, or 1 where they would not stay small.
Rational common_number(const Lines& lhs, const Lines& rhs) {
    Rational common = 0;
    std::vector<Rational> all;
    for (const Lines* side : {&lhs, &rhs})
        for (const Polynomial& line : *side)
            for (const Term& term : line.terms()) {
                common = common_divisor(common, term.coefficient);
                all.push_back(term.coefficient);
            }
    if (cln::zerop(common)) return 1;
    const bool small =
        std::all_of(all.begin(), all.end(), [&](const Rational& c) { return cln::abs(c) <= 1000 * common; });
    return small ? common : Rational(1);
}

}  // namespace

Phrase readable(const Fourier& f) {
    return readable(f, Composer::usual_effort);
}

Phrase readable(const Fourier& f, std::size_t effort) {
    Composer compose(has_decimals(f), effort);
    Writer writer(compose);
    return writer.write(writer.energy_lines(f));
}

Phrase ReadableWriter::operator()(const Fourier& f) {
    Composer& compose = has_decimals(f) ? in_decimals_ : in_fractions_;
    compose.begin();
    Writer writer(compose);
    return writer.write(writer.energy_lines(f));
}

std::optional<ReadableSign> readable_sign(const GiNaC::ex& positive, const Symbols& symbols) {
    const auto f = fourier(positive, symbols);
    if (!f) return std::nullopt;
    if (Phrase of = readable(*f); of.kind != Phrase::Kind::negative) return ReadableSign{std::move(of), "> 0"};
    const auto opposite = fourier(-positive, symbols);
    if (!opposite) return std::nullopt;
    return ReadableSign{readable(*opposite), "< 0"};
}

ReadableEquation readable_equation(const Fourier& lhs, const Fourier& rhs, const std::optional<SymbolInfo>& own) {
    const bool decimals = has_decimals(lhs) || has_decimals(rhs);
    Composer compose(decimals);
    Writer writer(compose);
    Factorizer& factorizer = compose.factorizer();
    const CommonFactor common = common_factor(lhs, rhs, factorizer);
    Fourier first_side = divide(lhs, common, factorizer), second_side = divide(rhs, common, factorizer);
    const Polynomial positive = divide_by_positive(first_side, second_side, factorizer);
    Lines left = writer.lines(first_side), right = writer.lines(second_side);
    Rational scale = decimals ? Rational(1) : common_number(left, right);
    const Lines& shown = left.empty() ? right : left;
    const auto is_own = [&](const Polynomial& line) {
        const Monomial acceleration = part(line.terms()[0].monomial, is_acceleration);
        return own && !acceleration.empty() && acceleration[0].atom->info.rank == own->rank;
    };
    const auto leading = std::find_if(shown.begin(), shown.end(), is_own);
    if (!shown.empty() && compose(leading != shown.end() ? *leading : shown[0]).kind == Phrase::Kind::negative)
        scale = -scale;
    for (Lines* side : {&left, &right})
        for (Polynomial& line : *side) line = (1 / scale) * line;
    ReadableEquation result{writer.write(left), writer.write(right), {}};
    const Polynomial divisor = scale * polynomial(common) * positive;
    if (!divisor.is_one()) result.divided_by = compose(divisor);
    return result;
}

}  // namespace alembert
