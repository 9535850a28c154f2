// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Evaluates a Program exactly, modulo the prime 2⁶¹ − 1, at a random point.
///
///     const ModularPoint point{.seed = 7};
///     // nothing at an unusable point: try another seed
///     if (const auto at = evaluate_mod(program, point, roots))
///         at->value[roots[0]] == other->value[other_root];
///
/// Two programs at the same point have the same values, however their nodes are numbered, because every random
/// value is a function of the seed and of the variable for which it stands. If two expressions are equal for all
/// reals, their values are equal here; if they are not, their values differ except with a probability of
/// `degree`·2⁻⁶¹ (Schwartz 1980, Zippel 1979).
///
///  - Parameters, coordinates, rates, accelerations, t and π are independent random numbers, or those of `given`.
///  - An angle Σ c·x (x a monomial in the variables, c rational) is a product of powers of random points of the
///    circle, one for each x: (cos x/h, sin x/h) with h a power of two. The group of the circle has order 2⁶¹, so
///    that odd denominators are no obstacle. A coordinate outside sines and cosines is independent of them.
///    Multiples of π/2ᵏ have their exact values. `given_angles` sets the point of an x, identified by its value.
///  - √a is the root that is a square itself, |a| is a or −a, whichever is a square, sign a is Legendre's symbol:
///    this keeps √(ab) = √a √b and √(a²) = |a|. If a is no square, the point is unusable. Of a and −a in `turned`
///    the other one counts as positive; of a number in `negative_roots` the other root is taken.
///  - exp(Σ c·x) is a product of powers in the same way; sinh, cosh and tanh follow from it. max(a, b) is a if a −
///  b
///    counts as positive, and b otherwise. A function of [functions] and each of its derivatives are independent
///    random functions of the arguments' values, as they may be any. asin, acos, atan and atan2 are angles with
///    the sine, cosine or tangent that is given, at points where their other one is a number. All other functions
///    are random functions too. These, and √3, √5 … (which are no squares modulo this prime), do not obey
///    identities such as cos(asin x)² = 1 − x². Therefore a difference found here is certain only if `exact` is
///    set.

#include <cstdint>
#include <map>
#include <memory>
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
    std::map<Prime, PrimeTurn> given_angles{};  ///< monomial's value → the turn by 1/2^halves of it
    std::vector<Prime>
        turned{};  ///< whose signs, and those of their negatives, are opposite to Legendre's symbols
    std::vector<Prime> negative_roots{};  ///< numbers whose square root is the other one of the two
    int halves = 2;                       ///< turns are stored for x/2^halves; sin(x/4) needs 2
    int finer = 0;  ///< turns that are not given are stored for x/2^(halves + finer); see halvings() of
                    ///< analysis/exact/quadratic_residue_points.hpp

    /// A uniform random number, the same for the same arguments.
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
    /// The turn by 1/2^parts of a monomial with this value.
    struct Part {
        int parts;
        PrimeTurn turn;
    };
    Part part(Prime monomial) const {
        if (const auto found = given_angles.find(monomial); found != given_angles.end())
            return {halves, found->second};
        return {halves + finer, PrimeTurn::rational(random(200, monomial.bits()))};
    }
    /// The turn by 1/2^halves of it.
    PrimeTurn angle(Prime monomial) const {
        const Part own = part(monomial);
        return own.turn.power(std::uint64_t{1} << (own.parts - halves));
    }
};

struct ModularValues {
    std::vector<Prime> value;    ///< the value of each node; zero if no root needs it
    std::vector<double> degree;  ///< for each node, a bound on the number of zeros of numerator and denominator in
                                 ///< the random values
    /// How many values had to be squares for this point; each doubles the probability of an error.
    double conditions = 0;
    std::vector<Prime> rooted{};  ///< the numbers of which square roots were taken, each once
    bool exact = true;            ///< false if a function occurred whose identities the evaluation does not obey
};

/// The values that `roots` need. Nothing if the point is unusable: a denominator is zero, an argument of a root is
/// no square, or an angle is divided by more than 2^halves.
std::optional<ModularValues> evaluate_mod(const Program& program, const ModularPoint& point,
                                          std::span<const int> roots);

class ModularEvaluation;

/// The same values of a few roots at many points, which differ in the values or in the turns of `changing`
/// variables alone: what does not depend on these is made once. The program must outlive it.
class ModularFunction {
public:
    ModularFunction(const Program& program, std::vector<int> roots, std::vector<Variable> changing);
    ~ModularFunction();
    ModularFunction(const ModularFunction&) = delete;
    ModularFunction& operator=(const ModularFunction&) = delete;
    /// The values of the roots, in their order; nothing if the point is unusable.
    std::optional<std::vector<Prime>> operator()(const ModularPoint& point);

private:
    unsigned changes(const ModularPoint& point);

    /// What a changing variable was at the point before.
    struct Former {
        Variable variable;
        std::optional<Prime> value = {};
        std::optional<PrimeTurn> turn = {};
    };
    std::vector<int> roots_;
    std::unique_ptr<ModularEvaluation> evaluation_;
    std::vector<Former> changing_;
    bool is_known_ = false;  ///< whether all that does not change has its value
};

}  // namespace alembert
