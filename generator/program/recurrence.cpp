// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/recurrence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "alembert/error.hpp"

namespace alembert {

namespace {

using Kind = SeriesNode::Kind;

/// A value that has not been given a node: constants + Σ w x + Σ w a⊗b.
struct Form {
    std::vector<Weight> constants;
    std::vector<SeriesNode::Linear> linear;
    std::vector<SeriesNode::Bilinear> bilinear;
    bool is_constant() const { return linear.empty() && bilinear.empty(); }
    bool is_node() const { return constants.empty() && bilinear.empty() && linear.size() == 1; }
};

/// A factor times a node.
struct Scaled {
    Weight weight;
    int node;
};

class Building {
public:
    Building(const Program& program, bool with_work) {
        result_.program = program;
        if (with_work) power_ = program.nodes_of(Group::power).at(0);
    }

    Recurrences direct() {
        begin(result_.program.right_hand_side());
        for (const int id : p().nodes_of(Group::acceleration)) result_.accelerations.push_back(node_of(form(id)));
        return finished();
    }

    Recurrences implicit() {
        const std::vector<int> mass = p().nodes_of(Group::mass), forcing = p().nodes_of(Group::forcing), gamma = p().nodes_of(Group::gamma);
        const int s = static_cast<int>(forcing.size()), m = static_cast<int>(gamma.size());
        std::vector<int> lower = mass, right = forcing;
        const std::vector<int> rows = p().nodes_of(p().speeds.empty() ? Group::row : Group::speed_row), kept = p().kept_constraints();
        for (int k = 0; const int c : kept) {
            for (int i = 0; i < s; ++i) lower.push_back(rows.at(c * s + i));
            lower.insert(lower.end(), ++k, p().number(0));
        }
        right.insert(right.end(), gamma.begin(), gamma.end());
        std::vector<int> needed = p().nodes_of(Group::rate);
        needed.insert(needed.end(), lower.begin(), lower.end());
        needed.insert(needed.end(), right.begin(), right.end());
        begin(std::move(needed));
        for (const int id : lower) result_.matrix.push_back(entry(form(id)));
        std::vector<Form> forms;
        for (const int id : right) forms.push_back(form(id));
        // Unknowns follow the residuals, which name them.
        const int first = static_cast<int>(nodes().size()) + s + m;
        for (int i = 0; i < s + m; ++i) result_.unknowns.push_back(first + i);
        for (int i = 0; i < s + m; ++i) result_.residuals.push_back(add(residual(forms[i], i)));
        result_.solved_at = first;
        result_.preferred = s;
        for (int i = 0; i < s + m; ++i) add({.kind = Kind::unknown, .index = i});
        result_.accelerations.assign(result_.unknowns.begin(), result_.unknowns.begin() + s);
        // What else needs the solution finds it by the nodes that the Program has for it.
        for (int i = 0; const int id : p().nodes_of(Group::acceleration)) remember(id, result_.unknowns[i++], 1);
        const std::vector<int> multipliers = p().nodes_of(Group::multiplier);
        for (int k = s; const int c : kept) remember(multipliers.at(c), result_.unknowns[k++], -1);
        return finished();
    }

private:
    Program& p() { return result_.program; }
    std::vector<SeriesNode>& nodes() { return result_.nodes; }

    int add(SeriesNode node) {
        nodes().push_back(std::move(node));
        return static_cast<int>(nodes().size()) - 1;
    }

    void remember(int id, int node, const Rational& factor) {
        if (!p()[id].is_constant()) forms_[id] = {.constants = {}, .linear = {{{factor, -1}, node}}, .bilinear = {}};
    }

    /// Counts uses, makes the states.
    void begin(std::vector<int> roots) {
        if (power_ >= 0) roots.push_back(power_);
        for (const int id : p().needed(roots))
            if (!p()[id].is_constant()) {
                const Node& node = p()[id];
                for (std::size_t k = 0; k < node.args.size(); ++k)
                    uses_[node.args[k]] += node.exponents.empty() ? 1 : std::abs(node.exponents[k]);
            }
        for (const int id : roots) ++uses_[id];
        const int n = static_cast<int>(p().coordinates.size());
        const int s = p().speeds.empty() ? n : static_cast<int>(p().speeds.size());
        for (int i = 0; i < n; ++i) given_[{Variable::Kind::coordinate, i}] = add({.kind = Kind::coordinate, .index = i});
        for (int i = 0; i < s; ++i) given_[{Variable::Kind::rate, i}] = add({.kind = Kind::speed, .index = i});
        if (power_ >= 0) add({.kind = Kind::work});
    }

    Recurrences finished() {
        for (const int id : p().nodes_of(Group::rate)) result_.coordinate_rates.push_back(node_of(form(id)));
        for (std::size_t i = 0; i < result_.accelerations.size(); ++i)
            given_[{Variable::Kind::acceleration, static_cast<int>(i)}] = result_.accelerations[i];
        if (power_ >= 0) result_.work = node_of(form(power_));
        if (result_.matrix.empty()) result_.solved_at = static_cast<int>(nodes().size());
        return std::move(result_);
    }

    SeriesEntry entry(const Form& f) {
        if (!f.is_constant()) return {.node = node_of(f)};
        if (f.constants.empty()) return {};
        return {.node = -1, .constant = f.constants[0]};
    }

    /// f − Σ_{j≥1} M_j u'_{k−j} of row i.
    SeriesNode residual(const Form& f, int i) {
        SeriesNode node{.kind = Kind::residual, .index = i, .constants = f.constants, .linear = f.linear, .bilinear = f.bilinear};
        for (int j = 0; j < static_cast<int>(result_.unknowns.size()); ++j) {
            const int row = std::max(i, j), column = std::min(i, j);
            const SeriesEntry& e = result_.matrix[row * (row + 1) / 2 + column];
            if (e.node >= 0) node.implied.push_back({{-1, -1}, e.node, result_.unknowns[j]});
        }
        return node;
    }

    int constant_product(int a, int b, int exponent_of_b) {
        std::vector<Program::Factor> factors{{b, exponent_of_b}};
        if (a >= 0) factors.emplace_back(a, 1);
        return p().product(1, factors);
    }

    /// The node may have become a number, or a multiple of another.
    Weight tidy(Rational number, int constant) {
        if (constant >= 0 && p()[constant].is_scaled()) {
            number = number * p()[constant].coefficients[0];
            constant = p()[constant].args[0];
        }
        if (constant >= 0 && p()[constant].is_number()) return {number * p()[constant].number, -1};
        return {number, constant};
    }

    Weight times(const Weight& a, const Weight& b) {
        const int constant = a.constant < 0 ? b.constant : b.constant < 0 ? a.constant : constant_product(a.constant, b.constant, 1);
        return tidy(a.number * b.number, constant);
    }

    Weight over(const Weight& a, const Weight& b) {
        return tidy(a.number / b.number, b.constant < 0 ? a.constant : constant_product(a.constant, b.constant, -1));
    }

    void add_to(Form& sum, const Weight& weight, const Form& f) {
        for (const Weight& c : f.constants) sum.constants.push_back(times(weight, c));
        for (const auto& term : f.linear) {
            const Weight factor = times(weight, term.weight);
            const auto same = std::find_if(sum.linear.begin(), sum.linear.end(), [&](const auto& l) {
                return l.node == term.node && l.weight.constant == factor.constant;
            });
            if (same == sum.linear.end())
                sum.linear.push_back({factor, term.node});
            else if (same->weight.number = same->weight.number + factor.number; cln::zerop(same->weight.number))
                sum.linear.erase(same);
        }
        for (const auto& [w, a, b] : f.bilinear) sum.bilinear.push_back({times(weight, w), a, b});
    }

    Form of(int node, const Weight& weight = {}) { return {.constants = {}, .linear = {{weight, node}}, .bilinear = {}}; }

    /// The node of a form, with its factor outside.
    Scaled scaled(const Form& f) {
        if (f.is_node()) return {f.linear[0].weight, f.linear[0].node};
        if (f.constants.empty() && f.linear.empty() && f.bilinear.size() == 1) {
            const auto [a, b] = std::minmax(f.bilinear[0].a, f.bilinear[0].b);
            const auto [place, is_new] = products_.try_emplace({a, b}, -1);
            if (is_new) place->second = add({.kind = Kind::sum, .bilinear = {{{}, a, b}}});
            return {f.bilinear[0].weight, place->second};
        }
        return {{}, add({.kind = Kind::sum, .constants = f.constants, .linear = f.linear, .bilinear = f.bilinear})};
    }

    int node_of(const Form& f) {
        const Scaled s = scaled(f);
        if (s.weight.constant < 0 && cln::equal(s.weight.number, 1)) return s.node;
        return add({.kind = Kind::sum, .linear = {{s.weight, s.node}}});
    }

    /// The form of a Program's node; a node of its own where it is used more than once and is more than a multiple.
    Form form(int id) {
        if (const auto known = forms_.find(id); known != forms_.end()) return known->second;
        Form f = made(id);
        if (uses_[id] > 1 && !f.is_node() && !f.is_constant()) {
            const Scaled s = scaled(f);
            f = of(s.node, s.weight);
        }
        return forms_[id] = f;
    }

    Form made(int id) {
        const Node node = p()[id];  // a copy: constants may be added
        if (node.is_constant()) {
            if (p().is_zero(id)) return {};
            return {.constants = {tidy(1, id)}, .linear = {}, .bilinear = {}};
        }
        switch (node.op) {
            case Op::variable: return of(variable(node.variable));
            case Op::sum: {
                Form f;
                if (!cln::zerop(node.number)) f.constants.push_back({node.number, -1});
                for (std::size_t k = 0; k < node.args.size(); ++k) add_to(f, {node.coefficients[k], -1}, form(node.args[k]));
                return f;
            }
            case Op::product:
                if (auto with_roots = product_with_roots(id)) return *std::move(with_roots);
                return product(node);
            default: return function(node);
        }
    }

    int variable(const Variable& v) {
        if (v.kind == Variable::Kind::time) {
            if (time_ < 0) time_ = add({.kind = Kind::time});
            return time_;
        }
        const auto found = given_.find({v.kind, v.index});
        if (found == given_.end()) throw ModelError("method 'taylor': the equations name something that no state gives; take dop853");
        return found->second;
    }

    Form product(const Node& node) {
        Weight weight;
        std::vector<int> factors;
        std::vector<Scaled> divisors;
        for (std::size_t k = 0; k < node.args.size(); ++k) {
            const int id = node.args[k];
            const Node arg = p()[id];
            const bool divides = node.exponents[k] < 0 || (arg.is_reciprocal() && !arg.is_constant());
            const int below = node.exponents[k] < 0 ? id : divides ? arg.args[0] : id;
            for (int e = 0; e < std::abs(node.exponents[k]); ++e) {
                if (arg.is_constant())
                    weight = node.exponents[k] < 0 ? over(weight, tidy(1, id)) : times(weight, tidy(1, id));
                else if (divides)
                    divisors.push_back(divisor(below));
                else {
                    const Scaled factor = scaled(form(id));
                    weight = times(weight, factor.weight);
                    factors.push_back(factor.node);
                }
            }
        }
        return assembled(weight, factors, divisors);
    }

    Form assembled(Weight weight, const std::vector<int>& factors, const std::vector<Scaled>& divisors) {
        Form f;
        if (factors.empty())
            f.constants = {{}};
        else if (factors.size() == 1)
            f = of(factors[0]);
        else {
            int left = factors[0];
            for (std::size_t k = 1; k + 1 < factors.size(); ++k)
                left = scaled({.constants = {}, .linear = {}, .bilinear = {{{}, left, factors[k]}}}).node;
            f.bilinear = {{{}, left, factors.back()}};
        }
        for (const Scaled& divisor : divisors) {
            weight = over(weight, divisor.weight);
            f = of(quotient(f, divisor.node));
        }
        Form result;
        add_to(result, weight, f);
        return result;
    }

    /// Factors of factors and what stands under their roots, each with its exponent in `exponents`.
    void flatten(int id, const Rational& exponent, std::map<int, Rational>& exponents) const {
        const Node& x = result_.program[id];
        if (x.is_constant() || (x.op != Op::sqrt && x.op != Op::product)) {
            exponents.try_emplace(id, 0).first->second = exponents[id] + exponent;
        } else if (x.op == Op::sqrt) {
            flatten(x.args[0], exponent / 2, exponents);
        } else {
            for (std::size_t k = 0; k < x.args.size(); ++k) flatten(x.args[k], exponent * x.exponents[k], exponents);
        }
    }

    /// A product in which something stands under roots with an exponent beyond 1, as in r^(-3): one recurrence instead of a
    /// quotient for each r. Nothing where there is no such thing.
    std::optional<Form> product_with_roots(int id) {
        std::map<int, Rational> exponents;
        flatten(id, 1, exponents);
        const auto is_whole = [](const Rational& e) { return cln::equal(cln::denominator(e), 1); };
        const auto is_root = [&](const auto& one) {
            return !p()[one.first].is_constant() && cln::equal(cln::denominator(one.second), 2) && cln::abs(one.second) > 1;
        };
        const auto is_plain = [&](const auto& one) { return is_root(one) || (is_whole(one.second) && cln::abs(one.second) <= 16); };
        if (std::none_of(exponents.begin(), exponents.end(), is_root) || !std::all_of(exponents.begin(), exponents.end(), is_plain)) return std::nullopt;
        Weight weight;
        std::vector<int> factors, powers;
        std::vector<Scaled> divisors;
        for (const auto& [base, exponent] : exponents) {
            if (is_root(std::pair(base, exponent))) {
                powers.push_back(power_of(base, exponent));
                continue;
            }
            for (Rational rest = cln::abs(exponent); rest > 0; rest = rest - 1) {
                if (p()[base].is_constant()) {
                    weight = cln::minusp(exponent) ? over(weight, tidy(1, base)) : times(weight, tidy(1, base));
                } else if (cln::minusp(exponent)) {
                    divisors.push_back(divisor(base));
                } else {
                    const Scaled factor = scaled(form(base));
                    weight = times(weight, factor.weight);
                    factors.push_back(factor.node);
                }
            }
        }
        factors.insert(factors.begin(), powers.begin(), powers.end());
        return assembled(weight, factors, divisors);
    }

    int power_of(int base, const Rational& exponent) {
        const auto [place, is_new] = powers_.try_emplace({base, exponent}, -1);
        if (is_new) {
            SeriesNode made{.kind = Kind::power, .a = node_of(form(base))};
            made.exponent = {exponent, -1};
            place->second = add(std::move(made));
        }
        return place->second;
    }

    /// Divided by as often as its reciprocal is used, which its own count of uses does not show.
    Scaled divisor(int id) {
        const auto known = divisors_.find(id);
        return known != divisors_.end() ? known->second : divisors_.emplace(id, scaled(form(id))).first->second;
    }

    int quotient(const Form& numerator, int divisor) {
        SeriesNode node{.kind = Kind::quotient, .constants = numerator.constants, .linear = numerator.linear, .bilinear = numerator.bilinear, .w = divisor};
        if (!numerator.bilinear.empty()) return add(std::move(node));
        const int above = numerator.linear.empty() ? -1 : numerator.linear[0].node;
        const auto [place, is_new] = quotients_.try_emplace({above, divisor}, -1);
        if (is_new) place->second = add(std::move(node));
        return place->second;
    }

    int with(Kind kind, int a, int w = -1, Op op = Op::number) { return add({.kind = kind, .a = a, .w = w, .op = op}); }

    /// 1 + sign·x².
    int one_and_square(int x, int sign) { return add({.kind = Kind::sum, .constants = {{}}, .bilinear = {{{sign, -1}, x, x}}}); }

    /// z' = z'-of-itself: the function's node, then its w.
    int area(int a, int sign, Op op) {
        const int z = with(Kind::area, a, -1, op);
        nodes()[z].w = one_and_square(z, sign);
        return z;
    }

    /// The pair; both belong to the recurrence of each.
    int pair(int a, bool hyperbolic, bool second) {
        const auto [place, is_new] = pairs_.try_emplace({a, hyperbolic}, -1);
        if (is_new) {
            place->second = with(hyperbolic ? Kind::hyperbolic_sine : Kind::sine, a);
            nodes().back().w = place->second + 1;
            with(hyperbolic ? Kind::hyperbolic_cosine : Kind::cosine, a, place->second);
        }
        return place->second + (second ? 1 : 0);
    }

    Form function(const Node& node) {
        const auto arg = [&](std::size_t k) { return node_of(form(node.args[k])); };
        switch (node.op) {
            case Op::sin: case Op::cos: return of(pair(arg(0), false, node.op == Op::cos));
            case Op::sinh: case Op::cosh: return of(pair(arg(0), true, node.op == Op::cosh));
            case Op::tan: return of(area(arg(0), 1, Op::tan));
            case Op::tanh: return of(area(arg(0), -1, Op::tanh));
            case Op::exp: return of(with(Kind::exponential, arg(0)));
            case Op::log: { const int a = arg(0); return of(with(Kind::ratio, a, a, Op::log)); }
            case Op::atan: { const int a = arg(0); return of(with(Kind::ratio, a, one_and_square(a, 1), Op::atan)); }
            case Op::asin: return of(arc(arg(0)));
            case Op::acos: {
                Form f = of(arc(arg(0)), {-1, -1});
                f.constants = {{Rational(1) / 2, p().pi()}};
                return f;
            }
            case Op::sqrt: return of(with(Kind::root, arg(0)));
            case Op::pow: return power(node);
            case Op::atan2: {
                const int y = arg(0), x = arg(1);
                const int w = add({.kind = Kind::sum, .bilinear = {{{}, x, x}, {{}, y, y}}});
                return of(add({.kind = Kind::turn, .a = y, .b = x, .w = w}));
            }
            default:
                throw ModelError(fmt::format("method 'taylor' needs functions that have a power series everywhere, and {}(...) has a "
                                             "kink; take dop853", name_of(node.op)));
        }
    }

    int arc(int a) { return with(Kind::ratio, a, with(Kind::root, one_and_square(a, -1)), Op::asin); }

    Form power(const Node& node) {
        if (p()[node.args[1]].is_constant()) {
            SeriesNode made{.kind = Kind::power, .a = node_of(form(node.args[0]))};
            made.exponent = tidy(1, node.args[1]);
            return of(add(std::move(made)));
        }
        Form exponent;  // a^b = exp(b log a)
        if (p()[node.args[0]].is_constant()) {
            add_to(exponent, tidy(1, p().call(Op::log, {node.args[0]})), form(node.args[1]));
        } else {
            const int a = node_of(form(node.args[0]));
            exponent.bilinear = {{{}, with(Kind::ratio, a, a, Op::log), node_of(form(node.args[1]))}};
        }
        return of(with(Kind::exponential, node_of(exponent)));
    }

    struct Less {
        bool operator()(const Variable& a, const Variable& b) const { return std::pair(a.kind, a.index) < std::pair(b.kind, b.index); }
    };

    Recurrences result_;
    int power_ = -1, time_ = -1;
    std::map<int, int> uses_;
    std::map<int, Form> forms_;
    std::map<int, Scaled> divisors_;
    std::map<Variable, int, Less> given_;
    std::map<std::pair<int, int>, int> products_, quotients_;
    std::map<std::pair<int, bool>, int> pairs_;
    struct Smaller {
        bool operator()(const std::pair<int, Rational>& a, const std::pair<int, Rational>& b) const {
            return a.first != b.first ? a.first < b.first : a.second < b.second;
        }
    };
    std::map<std::pair<int, Rational>, int, Smaller> powers_;
};

double of(const std::vector<SeriesNode::Bilinear>& list) {
    double count = 0;
    for (const auto& [weight, a, b] : list) count += a == b ? 0.5 : 1;
    return count;
}

}  // namespace

double Recurrences::products() const {
    double count = 0;
    for (const SeriesNode& node : nodes) {
        count += of(node.bilinear) + of(node.implied);
        switch (node.kind) {
            case Kind::root: count += 0.5; break;
            case Kind::power: count += 2; break;
            case Kind::turn: count += 3; break;
            case Kind::quotient: case Kind::sine: case Kind::cosine: case Kind::hyperbolic_sine: case Kind::hyperbolic_cosine:
            case Kind::exponential: case Kind::area: case Kind::ratio: count += 1; break;
            default: break;
        }
    }
    return count;
}

Recurrences recurrences(const Program& program, bool with_work) {
    Recurrences direct = Building(program, with_work).direct();
    if (program.nodes_of(Group::mass).empty() || program.nodes_of(Group::forcing).empty()) return direct;
    Recurrences implicit = Building(program, with_work).implicit();
    return implicit.products() < direct.products() ? implicit : direct;
}

}  // namespace alembert
