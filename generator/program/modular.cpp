// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/modular.hpp"

#include <cln/integer.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "program/modular_angle.hpp"

namespace alembert {

class ModularEvaluation {
public:
    ModularEvaluation(const Program& program, std::span<const int> roots)
        : program_(program), order_(program.needed(roots)) {
        values.value.resize(program_.size());
        values.degree.resize(program_.size());
    }

    /// Whether the point is usable.
    bool run(const ModularPoint& point) {
        begin(point);
        for (const int id : order_) {
            values.degree[id] = 0;
            const std::optional<Prime> value = of(id);
            if (!value) return false;
            values.value[id] = *value;
        }
        // The random points stand for the angles divided by all their odd denominators.
        for (const int id : order_) values.degree[id] *= denominators_;
        return true;
    }

    /// Prepares `run_again` for these variables, of which there are at most 16.
    void let_change(const std::vector<Variable>& variables) {
        depends_.assign(values.value.size(), 0);
        std::vector<unsigned> reaches(values.value.size(), 0);  // likewise, in whatever way
        for (const int id : order_) {
            const Node& node = program_[id];
            for (const int a : node.args) {
                depends_[id] |= depends_[a];
                reaches[id] |= reaches[a];
            }
            for (std::size_t k = 0; k < variables.size(); ++k)
                if (node.op == Op::variable && node.variable == variables[k]) {
                    depends_[id] |= by_value(k);
                    reaches[id] |= by_turn(k);
                }
            switch (node.op) {
                case Op::sin:
                case Op::cos:
                case Op::tan:
                case Op::exp:
                case Op::sinh:
                case Op::cosh:
                case Op::tanh:
                    depends_[id] |= reaches[id];
                    break;
                default:
                    break;
            }
        }
    }
    static unsigned by_value(std::size_t k) { return 1U << k; }
    static unsigned by_turn(std::size_t k) { return 1U << (k + 16); }

    /// After `run`, at a point that differs in these values and turns alone.
    bool run_again(const ModularPoint& point, unsigned changes) {
        point_ = &point;
        values.rooted.clear();
        std::erase_if(sums_, [&](const auto& sum) { return (depends_[sum.first] & changes) != 0; });
        for (const int id : order_) {
            if ((depends_[id] & changes) == 0) continue;
            values.degree[id] = 0;
            const std::optional<Prime> value = of(id);
            if (!value) return false;
            values.value[id] = *value;
        }
        return true;
    }

    ModularValues values;

private:
    void begin(const ModularPoint& point) {
        point_ = &point;
        pi_ = point.random(300, 0);
        values.conditions = 0;
        values.exact = true;
        values.rooted.clear();
        rooted_rests_.clear();
        sums_.clear();
        known_turns_.clear();
        known_denominators_ = 1;
        denominators_ = 1;
    }

    Prime value(int id) const { return values.value[id]; }

    /// Of a number that is not zero.
    bool is_positive(Prime a) const {
        const bool is_turned =
            std::any_of(point_->turned.begin(), point_->turned.end(), [&](Prime t) { return t == a || t == -a; });
        return a.is_square() != is_turned;
    }

    /// Of a node that is not zero; a positive number before it changes nothing, though it may be no square: 3x.
    bool is_positive(int id) const {
        const Node& node = program_[id];
        if (!node.is_scaled()) return is_positive(value(id));
        return is_positive(value(node.args[0])) == cln::plusp(node.coefficients[0]);
    }

    std::optional<Prime> of(int id) {
        const Node& node = program_[id];
        double& degree = values.degree[id];
        const auto arg = [&](std::size_t k) { return value(node.args[k]); };
        for (const int a : node.args) degree = std::max(degree, values.degree[a]);
        switch (node.op) {
            case Op::number:
                return Prime::from(node.number);
            case Op::pi:
                degree = 1;
                return pi_;
            case Op::variable:
                degree = 1;
                return point_->variable(node.variable);
            case Op::sum:
                return sum(node, degree);
            case Op::product:
                return product(node, degree);
            case Op::sin:
            case Op::cos:
            case Op::tan:
                return circular(node, degree);
            case Op::sqrt:
                return square_root(node.args[0]);
            case Op::abs:
                values.exact = values.exact && arg(0).is_plain();
                return arg(0).is_plain() ? (is_positive(node.args[0]) ? arg(0) : -arg(0))
                                         : std::min(arg(0), -arg(0));
            case Op::sign:
                values.exact = values.exact && arg(0).is_plain();
                return arg(0).is_zero() ? Prime(0) : Prime(is_positive(node.args[0]) ? 1 : -1);
            case Op::exp:
                return exponential(node.args[0], degree);
            case Op::sinh:
            case Op::cosh:
            case Op::tanh:
                return hyperbolic(node, degree);
            case Op::min:
            case Op::max: {
                const Prime difference = arg(0) - arg(1);
                values.exact = values.exact && difference.is_plain();
                if (difference.is_zero()) return arg(0);
                const bool is_first = is_positive(difference) == (node.op == Op::max);
                return is_first ? arg(0) : arg(1);
            }
            case Op::unspecified:
                degree += 1;
                return unspecified(node);
            case Op::log:
                if (const Node& inner = program_[node.args[0]]; inner.op == Op::exp) return value(inner.args[0]);
                break;
            case Op::asin:
            case Op::acos:
            case Op::atan:
            case Op::atan2:
                return inverse(node, degree);
            case Op::pow:
                break;
        }
        return of_other_function(node, degree);
    }

    Prime of_other_function(const Node& node, double& degree) {
        return random_for(node.op, value(node.args[0]), node.args.size() > 1 ? value(node.args[1]).bits() : 0,
                          degree);
    }
    Prime random_for(Op op, Prime a, std::uint64_t b, double& degree) {
        values.exact = false;
        degree += 1;
        return point_->random(static_cast<std::uint64_t>(op), a.bits(), b);
    }

    /// An angle whose sine, cosine or tangent is known; nothing where the other one of sine and cosine is no
    /// number of the field.
    std::optional<Prime> inverse(const Node& node, double& degree) {
        const Prime a = value(node.args[0]), b = node.args.size() > 1 ? value(node.args[1]) : Prime(1);
        const bool is_of_two = node.op == Op::atan || node.op == Op::atan2;
        const Prime square = is_of_two ? a * a + b * b : Prime(1) - a * a;
        if (!square.is_square() || (is_of_two && square.is_zero())) return std::nullopt;
        values.conditions += 1;
        const Prime root = square.root();
        const Prime over = is_of_two ? root.inverse() : Prime(1);
        // asin, atan, and atan2 in its first argument are odd, and acos is π/2 − asin.
        const Prime size = std::min(a, -a);
        const Op op = node.op == Op::acos ? Op::asin : node.op;
        const Prime of_size = random_for(op, size, node.args.size() > 1 ? b.bits() : 0, degree);
        const Prime of_a = size == a ? of_size : -of_size;
        const Prime angle = node.op == Op::acos ? pi_ * Prime(2).inverse() - of_a : of_a;
        known_turns_.emplace(angle, node.op == Op::asin   ? PrimeTurn{root, a}
                                    : node.op == Op::acos ? PrimeTurn{a, root}
                                                          : PrimeTurn{b * over, a * over});
        return angle;
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

    std::optional<Prime> product(const Node& node, double& degree) {
        degree = 0;
        Prime product = 1;
        for (std::size_t k = 0; k < node.args.size(); ++k) {
            const int e = node.exponents[k];
            const Prime factor = value(node.args[k]);
            if (e < 0 && factor.is_zero()) return std::nullopt;
            product *= (e < 0 ? factor.inverse() : factor).power(static_cast<std::uint64_t>(std::abs(e)));
            degree += std::abs(e) * values.degree[node.args[k]];
        }
        return product;
    }

    std::optional<Prime> circular(const Node& node, double& degree) {
        const std::optional<PrimeTurn> turn = turned(node.args[0], degree);
        if (!turn) return std::nullopt;
        if (node.op == Op::sin) return turn->sin;
        if (node.op == Op::cos) return turn->cos;
        if (turn->cos.is_zero()) return std::nullopt;
        return turn->sin * turn->cos.inverse();
    }

    std::optional<Prime> hyperbolic(const Node& node, double& degree) {
        const std::optional<Prime> up = exponential(node.args[0], degree);
        if (!up) return std::nullopt;
        degree *= 2;
        const Prime down = up->inverse(), half = Prime(2).inverse();
        if (node.op == Op::sinh) return (*up - down) * half;
        if (node.op == Op::cosh) return (*up + down) * half;
        if ((*up + down).is_zero()) return std::nullopt;
        return (*up - down) * (*up + down).inverse();
    }

    /// No identity relates its values at different arguments and its derivatives.
    Prime unspecified(const Node& node) const {
        std::uint64_t key = 0;
        for (const int a : node.args)
            for (const Prime part : {value(a), value(a) * Prime::i()})
                key = point_->random(500, part.bits(), key).bits();
        return point_->random(501, key);
    }

    /// Without denominators the degree of a sum is the largest one of its terms, with denominators the sum of all.
    double degree_of_sum(const Node& node) {
        double largest = 0, together = 0;
        bool fractions = false;
        for (const int a : node.args) {
            largest = std::max(largest, values.degree[a]);
            together += values.degree[a];
            fractions = fractions || has_denominator(a);
        }
        return fractions ? together : largest;
    }

    bool has_denominator(int id) {
        if (fraction_.empty()) {
            fraction_.resize(program_.size());
            for (const int i : order_) {
                const Node& node = program_[i];
                bool any = node.is_reciprocal() || node.op == Op::tan || node.op == Op::tanh;
                for (const int a : node.args) any = any || fraction_[a] != 0;
                fraction_[i] = any ? 1 : 0;
            }
        }
        return fraction_[id] != 0;
    }

    /// Roots of whole numbers that share no factor are independent, so that each may be any root of its number.
    /// Nothing if it shares a part of its large factors with another one.
    std::optional<Prime> root_of_number(const Rational& number) {
        const std::optional<Prime::PartialRoot> found = Prime::partial_root_of(number);
        if (!found) return std::nullopt;
        Prime result = found->known;
        cln::cl_I rest = found->rest, whole;
        for (const cln::cl_I& other : rooted_rests_) {
            while (cln::zerop(cln::mod(rest, other))) {
                rest = cln::exquo(rest, other);
                result *= Prime::from(other)->any_root();
            }
            if (cln::gcd(other, rest) != 1) return std::nullopt;
        }
        if (cln::sqrtp(rest, &whole)) return result * *Prime::from(whole);
        rooted_rests_.push_back(rest);
        return result * Prime::from(rest)->any_root();
    }

    std::optional<Prime> square_root(int arg) {
        const Node& node = program_[arg];
        if (node.is_number()) {
            if (cln::zerop(node.number)) return Prime(0);
            if (!cln::plusp(node.number)) return std::nullopt;
            if (const auto root = root_of_number(node.number)) return root;
            values.exact = false;
            return point_->random(static_cast<std::uint64_t>(Op::sqrt), value(arg).bits());
        }
        // √(3a + 3b) = √3 √(a + b), even if 3 is no square
        const Rational content = node.op == Op::sum ? content_of(node) : Rational(1);
        const auto outer = Prime::root_of(content);
        const auto factor = Prime::from(outer ? content : Rational(1));
        if (!factor || factor->is_zero()) return std::nullopt;
        const Prime a = value(arg) * factor->inverse();
        if (!a.is_square()) return std::nullopt;
        values.conditions += 1;
        values.exact = values.exact && a.is_plain();
        const bool is_negative = std::find(point_->negative_roots.begin(), point_->negative_roots.end(), a) !=
                                 point_->negative_roots.end();
        if (std::find(values.rooted.begin(), values.rooted.end(), a) == values.rooted.end())
            values.rooted.push_back(a);
        const Prime root = is_negative ? -a.root() : a.root();
        return outer ? *outer * root : root;
    }

    /// The positive number by whose division the coefficients of a sum become whole without a common factor.
    static Rational content_of(const Node& node) {
        cln::cl_I above = cln::numerator(node.number), below = cln::denominator(node.number);
        for (const Rational& c : node.coefficients) {
            above = cln::gcd(above, cln::numerator(c));
            below = cln::lcm(below, cln::denominator(c));
        }
        return cln::abs(above) / below;
    }

    // Angles

    ModularAngle angle_or_leaf(int id) {
        if (auto result = angle_at(program_, values.value, pi_, id, sums_)) return *result;
        values.exact = false;
        return angle_of_value(value(id));
    }

    Prime leaf(Prime monomial) const { return monomial.is_zero() ? pi_ : monomial; }

    std::optional<PrimeTurn> turned(int id, double& degree) {
        PrimeTurn result;
        degree = 0;
        const ModularAngle sum = angle_or_leaf(id);
        for (const auto& [monomial, c] : sum) {
            if (cln::zerop(c)) continue;
            if (monomial.is_zero()) {
                const std::optional<PrimeTurn> part = turned_by_pi(c);
                if (!part) return std::nullopt;
                result = result * *part;
                continue;
            }
            if (const auto known = known_turns_.find(monomial);
                known != known_turns_.end() && cln::denominator(c) == 1) {
                const bool is_back = cln::minusp(c);
                const PrimeTurn turn = is_back ? PrimeTurn{known->second.cos, -known->second.sin} : known->second;
                result = result * turn.power(uint64_of(cln::abs(cln::numerator(c))));
                degree += 4 * std::abs(cln::double_approx(c));
                continue;
            }
            if (monomial == Prime(1) && is_long_angle(c)) {
                const std::optional<PrimeTurn> part = turned_by_number(c, degree);
                if (!part) return std::nullopt;
                result = result * *part;
                continue;
            }
            cln::cl_I numerator = cln::numerator(c), odd = cln::denominator(c);
            const auto [parts, turn] = point_->part(leaf(monomial));
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

    /// A turn that is random for each such number, up to its sign and factors of two: what holds for all angles
    /// holds for these, though not what only holds because one is a sum of others.
    std::optional<PrimeTurn> turned_by_number(const Rational& c, double& degree) {
        Rational base = cln::abs(c);
        cln::cl_I multiple = cln::minusp(c) ? -1 : 1;
        const Rational small = Rational(1) / 20;
        for (; base > small; multiple = 2 * multiple) base = base / 2;
        const std::optional<Prime> key = Prime::from(base);
        if (!key) return std::nullopt;
        degree += 2 * std::abs(cln::double_approx(multiple));
        return PrimeTurn::rational(point_->random(204, key->bits())).power(*PrimeTurn::exponent(multiple));
    }

    /// A multiple of π that is in the group, or else a random turn.
    std::optional<PrimeTurn> turned_by_pi(const Rational& c) {
        if (const auto turn = PrimeTurn::by_pi(c)) return turn;
        values.exact = false;
        const std::optional<Prime> key = Prime::from(c);
        if (!key) return std::nullopt;
        return PrimeTurn::rational(point_->random(201, key->bits()));
    }

    void note_denominator(const cln::cl_I& odd) {
        known_denominators_ = cln::lcm(known_denominators_, odd);
        denominators_ = cln::double_approx(known_denominators_);
    }

    /// exp(x) = e^2520 with a random square e for each monomial, so that fractions such as thirds are whole
    /// powers.
    std::optional<Prime> exponential(int id, double& degree) {
        constexpr int parts = 2520;
        Prime result = 1;
        degree = 0;
        const ModularAngle sum = angle_or_leaf(id);
        for (const auto& [monomial, c] : sum) {
            const Rational exponent = c * parts;
            if (cln::denominator(exponent) != 1) {
                values.exact = false;
                degree += 1;
                const std::optional<Prime> key = Prime::from(c);
                if (!key) return std::nullopt;
                const Prime e = point_->random(202, leaf(monomial).bits(), key->bits());
                result *= e * e;
                continue;
            }
            const cln::cl_I whole = cln::numerator(exponent);
            const cln::cl_I residue = cln::mod(whole, cln::cl_I(Prime::modulus - 1));
            const Prime e = point_->random(203, leaf(monomial).bits());
            if (e.is_zero()) return std::nullopt;
            result *= (e * e).power(uint64_of(residue));
            degree += 2 * std::abs(cln::double_approx(exponent));
        }
        return result;
    }

    const Program& program_;
    const std::vector<int> order_;
    const ModularPoint* point_ = nullptr;
    Prime pi_;
    std::vector<cln::cl_I> rooted_rests_;  ///< large numbers of which roots were taken
    std::vector<char> fraction_;
    std::vector<unsigned> depends_;  ///< for each node, on which changes its value depends
    std::map<int, ModularAngle> sums_;
    std::map<Prime, PrimeTurn> known_turns_;  ///< of angles by asin, acos, atan and atan2
    cln::cl_I known_denominators_ = 1;
    double denominators_ = 1;
};

std::optional<ModularValues> evaluate_mod(const Program& program, const ModularPoint& point,
                                          std::span<const int> roots) {
    ModularEvaluation evaluation(program, roots);
    if (!evaluation.run(point)) return std::nullopt;
    return std::move(evaluation.values);
}

ModularFunction::ModularFunction(const Program& program, std::vector<int> roots, std::vector<Variable> changing)
    : roots_(std::move(roots)), evaluation_(std::make_unique<ModularEvaluation>(program, roots_)) {
    evaluation_->let_change(changing);
    for (const Variable& variable : changing) changing_.push_back({.variable = variable});
}

ModularFunction::~ModularFunction() = default;

/// The bits of what is other than at the point before.
unsigned ModularFunction::changes(const ModularPoint& point) {
    unsigned result = 0;
    for (std::size_t k = 0; k < changing_.size(); ++k) {
        Former& former = changing_[k];
        const Prime value = point.variable(former.variable);
        const auto found = point.given_angles.find(value);
        const auto turn = found == point.given_angles.end() ? std::nullopt : std::optional(found->second);
        const auto same = [](const PrimeTurn& a, const PrimeTurn& b) { return a.cos == b.cos && a.sin == b.sin; };
        const bool is_same_turn = turn && former.turn ? same(*turn, *former.turn) : !turn && !former.turn;
        if (value != former.value) result |= ModularEvaluation::by_value(k);
        if (value != former.value || !is_same_turn) result |= ModularEvaluation::by_turn(k);
        former.value = value;
        former.turn = turn;
    }
    return result;
}

std::optional<std::vector<Prime>> ModularFunction::operator()(const ModularPoint& point) {
    const unsigned changed = changes(point);
    const bool was_known = std::exchange(is_known_, true);
    if (!(was_known ? evaluation_->run_again(point, changed) : evaluation_->run(point))) {
        is_known_ = was_known;
        for (Former& former : changing_) former.value.reset();  // all that changes is made again
        return std::nullopt;
    }
    std::vector<Prime> result;
    for (const int root : roots_) result.push_back(evaluation_->values.value[root]);
    return result;
}

}  // namespace alembert
