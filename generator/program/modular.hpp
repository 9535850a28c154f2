// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Evaluates a Program exactly, modulo the prime 2⁶¹ − 1, at a random point.
///
///     const ModularPoint point{.seed = 7};
///     // nothing at an unusable point: try another seed
///     if (const auto at = evaluate_mod(program, point, roots))
///         at->value[roots[0]] == other->value[other_root];
///
/// Two programs at the same point see the same values, whatever their nodes are numbered: every random value is a
/// function of the seed and of what it stands for. If two values are equal for all reals, they are equal here; if
/// they are not, they differ but for a chance of `degree`·2⁻⁶¹ (Schwartz 1980, Zippel 1979).
///
///  - Parameters, coordinates, rates, accelerations, t and π are independent random numbers, or those of `given`.
///  - An angle Σ c·x (x a monomial in the variables, c rational) is a product of powers of random points of the
///    circle, one for each x: (cos x/h, sin x/h) with h a power of two. The circle's group has order 2⁶¹, so odd
///    denominators are no obstacle. A coordinate outside sines and cosines is independent of them. Multiples of
///    π/2ᵏ have their values. `given_angles` sets the point of an x by its value.
///  - √a is the root that is a square itself, |a| is a or −a, whichever is a square, sign a is Legendre's symbol:
///    this keeps √(ab) = √a √b and √(a²) = |a|. Where a is no square the point is unusable.
///  - exp(Σ c·x) is a product of powers likewise; sinh, cosh and tanh come from it. min and max of a pair are one
///    and the other of the pair. All other functions are random functions of their arguments' values. What the
///    last line and √3, √5 … (no squares modulo this prime) leave out are identities such as cos(asin x)² = 1 −
///    x²: a difference found here is certain only where `exact` is set.

#include <cln/integer.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "program/prime.hpp"
#include "program/program.hpp"
#include "program/turn.hpp"

namespace alembert {

struct ModularPoint {
    std::uint64_t seed = 0;
    std::map<std::pair<Variable::Kind, int>, Prime> given{};  ///< instead of random values
    std::map<Prime, PrimeTurn> given_angles{};  ///< monomial's value → the turn by the `halves`-th part of it
    int halves = 2;                             ///< turns are kept of x/2^halves: sin(x/4) needs 2
    int finer = 0;  ///< turns that are not given, of x/2^(halves + finer): halvings() of exact/square_points.hpp

    /// Uniform, the same for the same arguments.
    Prime random(std::uint64_t what, std::uint64_t key, std::uint64_t key2 = 0) const {
        std::uint64_t h = seed;
        for (const std::uint64_t part : {what, key, key2}) {
            h += part + 0x9e3779b97f4a7c15ULL;
            h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ULL;
            h = (h ^ (h >> 27)) * 0x94d049bb133111ebULL;
            h ^= h >> 31;
        }
        return Prime::from_bits(h & ((std::uint64_t{1} << 61) - 1));
    }
    Prime variable(const Variable& v) const {
        if (const auto found = given.find({v.kind, v.index}); found != given.end()) return found->second;
        return random(100 + static_cast<std::uint64_t>(v.kind), static_cast<std::uint64_t>(v.index));
    }
    /// The turn by the 2^parts-th part of a monomial of this value.
    struct Part {
        int parts;
        PrimeTurn turn;
    };
    Part part(Prime monomial) const {
        if (const auto found = given_angles.find(monomial); found != given_angles.end())
            return {halves, found->second};
        return {halves + finer, PrimeTurn::rational(random(200, monomial.bits()))};
    }
    /// By the `halves`-th.
    PrimeTurn angle(Prime monomial) const {
        const Part own = part(monomial);
        return own.turn.power(std::uint64_t{1} << (own.parts - halves));
    }
};

struct ModularValues {
    std::vector<Prime> value;  ///< of each node; zero where no root needs it
    std::vector<double>
        degree;             ///< of each node: zeros of numerator and denominator, in the random values, at most
    double conditions = 0;  ///< squares that the point had to be chosen for: each doubles the chance of a failure
    bool exact = true;      ///< no function was met whose identities the evaluation does not know
};

namespace modular {

/// A polynomial in values: monomial's value → coefficient. 0 stands for π, 1 for a plain number.
using Angle = std::map<Prime, Rational>;

class Evaluation {
public:
    Evaluation(const Program& program, const ModularPoint& point)
        : program_(program), point_(point), pi_(point.random(300, 0)) {}

    std::optional<ModularValues> run(std::span<const int> roots) {
        result_.value.resize(program_.size());
        result_.degree.resize(program_.size());
        for (const int id : program_.needed(roots)) {
            const std::optional<Prime> value = of(id);
            if (!value) return std::nullopt;
            result_.value[id] = *value;
        }
        // Odd denominators of angles: the random points stand for the angles over all of them.
        for (double& degree : result_.degree) degree *= denominators_;
        return std::move(result_);
    }

private:
    static constexpr std::size_t most_terms = 400;

    Prime value(int id) const { return result_.value[id]; }

    std::optional<Prime> of(int id) {
        const Node& node = program_[id];
        double& degree = result_.degree[id];
        const auto arg = [&](std::size_t k) { return value(node.args[k]); };
        for (const int a : node.args) degree = std::max(degree, result_.degree[a]);
        switch (node.op) {
            case Op::number:
                return Prime::from(node.number);
            case Op::pi:
                degree = 1;
                return pi_;
            case Op::variable:
                degree = 1;
                return point_.variable(node.variable);
            case Op::sum:
                return sum(node, degree);
            case Op::product: {
                degree = 0;
                Prime product = 1;
                for (std::size_t k = 0; k < node.args.size(); ++k) {
                    const int e = node.exponents[k];
                    if (e < 0 && arg(k).is_zero()) return std::nullopt;
                    product *= (e < 0 ? arg(k).inverse() : arg(k)).power(static_cast<std::uint64_t>(std::abs(e)));
                    degree += std::abs(e) * result_.degree[node.args[k]];
                }
                return product;
            }
            case Op::sin:
            case Op::cos:
            case Op::tan: {
                const std::optional<PrimeTurn> turn = turned(node.args[0], degree);
                if (!turn) return std::nullopt;
                if (node.op == Op::sin) return turn->sin;
                if (node.op == Op::cos) return turn->cos;
                if (turn->cos.is_zero()) return std::nullopt;
                return turn->sin * turn->cos.inverse();
            }
            case Op::sqrt:
                return square_root(node.args[0]);
            case Op::abs:
                result_.exact = result_.exact && arg(0).is_plain();
                return arg(0).is_plain() ? (arg(0).is_square() ? arg(0) : -arg(0)) : std::min(arg(0), -arg(0));
            case Op::sign:
                result_.exact = result_.exact && arg(0).is_plain();
                return arg(0).is_zero() ? Prime(0) : Prime(arg(0).is_square() ? 1 : -1);
            case Op::exp:
                return exponential(node.args[0], degree);
            case Op::sinh:
            case Op::cosh:
            case Op::tanh: {
                const std::optional<Prime> up = exponential(node.args[0], degree);
                if (!up) return std::nullopt;
                degree *= 2;
                const Prime down = up->inverse(), half = Prime(2).inverse();
                if (node.op == Op::sinh) return (*up - down) * half;
                if (node.op == Op::cosh) return (*up + down) * half;
                if ((*up + down).is_zero()) return std::nullopt;
                return (*up - down) * (*up + down).inverse();
            }
            case Op::min:
            case Op::max: {
                const Prime low = std::min(arg(0), arg(1)), high = std::max(arg(0), arg(1));
                const bool first = (point_.random(400, low.bits(), high.bits()).bits() & 1U) != 0;
                return first == (node.op == Op::min) ? low : high;
            }
            case Op::log:
                if (const Node& inner = program_[node.args[0]]; inner.op == Op::exp) return value(inner.args[0]);
                break;
            case Op::asin:
            case Op::acos:
            case Op::atan:
            case Op::pow:
            case Op::atan2:
                break;
        }
        result_.exact = false;
        degree += 1;
        return point_.random(static_cast<std::uint64_t>(node.op), arg(0).bits(),
                             node.args.size() > 1 ? arg(1).bits() : 0);
    }

    std::optional<Prime> sum(const Node& node, double& degree) {
        std::optional<Prime> total = Prime::from(node.number);
        if (!total) return std::nullopt;
        for (std::size_t k = 0; k < node.args.size(); ++k) {
            const std::optional<Prime> c = Prime::from(node.coefficients[k]);
            if (!c) return std::nullopt;
            *total += *c * value(node.args[k]);
        }
        degree = degree_of_sum(node);
        return total;
    }

    /// Polynomials: the largest degree. With denominators: all together.
    double degree_of_sum(const Node& node) {
        double largest = 0, together = 0;
        bool fractions = false;
        for (const int a : node.args) {
            largest = std::max(largest, result_.degree[a]);
            together += result_.degree[a];
            fractions = fractions || has_denominator(a);
        }
        return fractions ? together : largest;
    }

    bool has_denominator(int id) {
        if (fraction_.empty()) {
            fraction_.resize(program_.size());
            for (int i = 0; i < program_.size(); ++i) {
                const Node& node = program_[i];
                bool any = node.is_reciprocal() || node.op == Op::tan || node.op == Op::tanh;
                for (const int a : node.args) any = any || fraction_[a] != 0;
                fraction_[i] = any ? 1 : 0;
            }
        }
        return fraction_[id] != 0;
    }

    std::optional<Prime> square_root(int arg) {
        const Node& node = program_[arg];
        if (node.is_number()) {
            if (cln::zerop(node.number)) return Prime(0);
            if (!cln::plusp(node.number)) return std::nullopt;
            if (const auto root = Prime::root_of(node.number)) return root;
            result_.exact = false;
            return point_.random(static_cast<std::uint64_t>(Op::sqrt), value(arg).bits());
        }
        // √(3a + 3b) = √3 √(a + b), though 3 may be no square
        const Rational content = node.op == Op::sum ? content_of(node) : Rational(1);
        const auto outer = Prime::root_of(content);
        const auto factor = Prime::from(outer ? content : Rational(1));
        if (!factor || factor->is_zero()) return std::nullopt;
        const Prime a = value(arg) * factor->inverse();
        if (!a.is_square()) return std::nullopt;
        result_.conditions += 1;
        result_.exact = result_.exact && a.is_plain();
        return outer ? *outer * a.root() : a.root();
    }

    /// The positive number by which the coefficients of a sum are whole without a common factor.
    static Rational content_of(const Node& node) {
        cln::cl_I above = cln::numerator(node.number), below = cln::denominator(node.number);
        for (const Rational& c : node.coefficients) {
            above = cln::gcd(above, cln::numerator(c));
            below = cln::lcm(below, cln::denominator(c));
        }
        return cln::abs(above) / below;
    }

    // Angles

    /// The node as a polynomial in the values of its leaves; nothing where it has too many terms.
    std::optional<Angle> angle(int id) {
        const Node& node = program_[id];
        if (node.is_number()) return Angle{{1, node.number}};
        if (node.op == Op::pi) return Angle{{0, 1}};
        Angle result;
        const auto add = [&](Prime monomial, const Rational& c) {
            Rational& to = result.emplace(monomial, 0).first->second;
            to = to + c;
        };
        if (node.op == Op::sum) {
            add(1, node.number);
            for (std::size_t k = 0; k < node.args.size(); ++k) {
                const auto part = angle(node.args[k]);
                if (!part) return std::nullopt;
                for (const auto& [monomial, c] : *part) add(monomial, c * node.coefficients[k]);
            }
        } else if (node.op == Op::product && !node.is_reciprocal()) {
            result = {{1, 1}};
            for (std::size_t k = 0; k < node.args.size(); ++k) {
                const auto part = angle(node.args[k]);
                if (!part) return std::nullopt;
                for (int e = 0; e < node.exponents[k]; ++e) {
                    const Angle before = std::exchange(result, {});
                    if (before.size() * part->size() > most_terms) return std::nullopt;
                    for (const auto& [m1, c1] : before)
                        for (const auto& [m2, c2] : *part) add(leaf(m1) * leaf(m2), c1 * c2);
                }
            }
            return result;
        } else {
            return Angle{{value(id), 1}};
        }
        return result.size() > most_terms ? std::nullopt : std::optional(result);
    }

    Prime leaf(Prime monomial) const { return monomial.is_zero() ? pi_ : monomial; }

    Angle angle_or_leaf(int id) {
        if (auto result = angle(id)) return *result;
        result_.exact = false;
        return Angle{{value(id), 1}};
    }

    std::optional<PrimeTurn> turned(int id, double& degree) {
        PrimeTurn result;
        degree = 0;
        const Angle sum = angle_or_leaf(id);
        for (const auto& [monomial, c] : sum) {
            if (cln::zerop(c)) continue;
            if (monomial.is_zero()) {
                const std::optional<PrimeTurn> part = turned_by_pi(c);
                if (!part) return std::nullopt;
                result = result * *part;
                continue;
            }
            cln::cl_I numerator = cln::numerator(c), odd = cln::denominator(c);
            const auto [parts, turn] = point_.part(leaf(monomial));
            int halves = parts;
            for (; cln::evenp(odd) && halves > 0; --halves) odd = cln::exquo(odd, cln::cl_I(2));
            if (cln::evenp(odd)) return std::nullopt;
            note_denominator(odd);
            numerator = numerator << halves;
            degree += 2 * std::abs(cln::double_approx(c)) * std::pow(2.0, parts);
            if (odd != 1 && !turn.is_plain()) return std::nullopt;
            result = result * turn.power(*PrimeTurn::exponent(numerator / odd));
        }
        return result;
    }

    /// A multiple of π that the group has, or a random turn of its own.
    std::optional<PrimeTurn> turned_by_pi(const Rational& c) {
        if (const auto turn = PrimeTurn::by_pi(c)) return turn;
        result_.exact = false;
        const std::optional<Prime> key = Prime::from(c);
        if (!key) return std::nullopt;
        return PrimeTurn::rational(point_.random(201, key->bits()));
    }

    void note_denominator(const cln::cl_I& odd) {
        known_denominators_ = cln::lcm(known_denominators_, odd);
        denominators_ = cln::double_approx(known_denominators_);
    }

    /// exp(x) = e^2520 with a random square e for each monomial, so that thirds and the like are whole powers.
    std::optional<Prime> exponential(int id, double& degree) {
        constexpr int parts = 2520;
        Prime result = 1;
        degree = 0;
        const Angle sum = angle_or_leaf(id);
        for (const auto& [monomial, c] : sum) {
            const Rational exponent = c * parts;
            if (cln::denominator(exponent) != 1) {
                result_.exact = false;
                degree += 1;
                const std::optional<Prime> key = Prime::from(c);
                if (!key) return std::nullopt;
                const Prime e = point_.random(202, leaf(monomial).bits(), key->bits());
                result *= e * e;
                continue;
            }
            const cln::cl_I whole = cln::numerator(exponent);
            const cln::cl_I residue = cln::mod(whole, cln::cl_I(static_cast<unsigned long>(Prime::modulus - 1)));
            const Prime e = point_.random(203, leaf(monomial).bits());
            if (e.is_zero()) return std::nullopt;
            result *= (e * e).power(cln::cl_I_to_UQ(residue));
            degree += 2 * std::abs(cln::double_approx(exponent));
        }
        return result;
    }

    const Program& program_;
    const ModularPoint& point_;
    Prime pi_;
    ModularValues result_;
    std::vector<char> fraction_;
    cln::cl_I known_denominators_ = 1;
    double denominators_ = 1;
};

}  // namespace modular

/// All that `roots` need. Nothing where the point is unusable: a denominator is zero, what stands under a root is
/// no square, an angle is divided by more than 2^halves.
inline std::optional<ModularValues> evaluate_mod(const Program& program, const ModularPoint& point,
                                                 std::span<const int> roots) {
    return modular::Evaluation(program, point).run(roots);
}

}  // namespace alembert
