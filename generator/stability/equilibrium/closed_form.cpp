// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/equilibrium/closed_form.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/exact_solve.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "algebra/symbolic/functions.hpp"
#include "model/formalism/rest.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int most_coordinates = 4;
constexpr double largest_tree = 3000;
constexpr std::size_t most_terms = 40, most_roots = 64;

/// One possible value of a coordinate, and the conditions for it to be real.
struct RootChoice {
    std::size_t coordinate;
    ex value;
    std::vector<std::string> where = {};
};

class ClosedForm {
public:
    ClosedForm(const Mechanism& m, const std::vector<bool>& essential,
               const std::function<bool(const ex&)>& vanishes)
        : m_(m), essential_(essential), vanishes_(vanishes) {}

    /// False if something cannot be solved.
    bool solve(const std::vector<ex>& equations, const std::vector<RootChoice>& chosen) {
        if (roots.size() > most_roots) return false;
        std::vector<ex> left;
        for (const ex& equation : equations) {
            const auto f = fourier(in_single_angles(equation), *m_.symbols, 500);
            if (!f || f->size() > most_terms) return false;
            if (!is_zero(*f)) left.push_back(expression(readable(*f)).normal().numer());
        }
        if (left.empty()) return finish(chosen);
        for (std::size_t k = 0; k < left.size(); ++k) {
            const auto choices = choices_of(left[k], left.size() > 1);
            if (!choices) continue;
            std::vector<ex> rest = left;
            rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
            for (const RootChoice& choice : *choices) {
                std::vector<ex> then;
                for (const ex& e : rest) then.push_back(e.subs(m_.q[choice.coordinate] == choice.value));
                std::vector<RootChoice> all = chosen;
                for (RootChoice& one : all) one.value = one.value.subs(m_.q[choice.coordinate] == choice.value);
                all.push_back(choice);
                if (!solve(then, all)) return false;
            }
            return true;
        }
        return false;
    }

    std::vector<ClosedRoot> roots;

private:
    bool has_coordinate(const ex& e) const {
        return std::any_of(m_.q.begin(), m_.q.end(), [&](const GiNaC::symbol& q) { return e.has(q); });
    }
    std::string text_of(const ex& e) const {
        const auto f = fourier(e, *m_.symbols, 500);
        return f ? text(readable(*f)) : std::string();
    }

    /// Of the value as it was found and of its lowest terms.
    std::string shortest_text_of(const ex& e) const {
        std::string plain = text_of(e), reduced = text_of(lowest_terms(e));
        return reduced.empty() || reduced.size() >= plain.size() ? plain : reduced;
    }

    /// All roots of all factors; nothing if one of them cannot be solved.
    std::optional<std::vector<RootChoice>> choices_of(const ex& equation, bool others) const {
        const TrigonometricProduct product = product_of(equation, m_);
        std::vector<RootChoice> result;
        for (const ex& base : product.bases) {
            const ex whole = base.subs(product.functions);
            if (!has_coordinate(whole)) {
                if (vanishes_(whole)) return {};
                continue;
            }
            const auto found = roots_of(base, product.functions, others);
            if (!found) return {};
            result.insert(result.end(), found->begin(), found->end());
        }
        if (result.empty() && vanishes_(equation)) return {};
        return result;
    }

    std::optional<std::vector<RootChoice>> roots_of(const ex& base, const GiNaC::exmap& functions,
                                                    bool others) const {
        std::vector<std::pair<ex, ex>> letters;  // the letters that occur
        for (const auto& [letter, call] : functions)
            if (base.has(letter)) letters.emplace_back(letter, call);
        for (const auto& [letter, call] : letters)
            if (!GiNaC::is_exactly_a<GiNaC::function>(call) || (!is(call, "sin") && !is(call, "cos"))) {
                if (has_coordinate(call)) return {};
            }
        if (base.is_equal(letters.empty() ? ex(0) : letters[0].first)) return zeros_of(letters[0].second);
        const ex whole = base.subs(functions);
        std::vector<std::size_t> in_it;
        for (std::size_t i = 0; i < m_.q.size(); ++i)
            if (whole.has(m_.q[i])) in_it.push_back(i);
        if (in_it.size() == 1) return of_one(base, functions, letters, in_it[0]);
        // Linear in a coordinate, with a coefficient that never vanishes: the others follow from the rest.
        if (others)
            for (const std::size_t i : in_it) {
                const auto found = of_first_degree(base, functions, letters, i);
                if (found) return found;
            }
        return {};
    }

    static bool is(const ex& call, const char* name) {
        return GiNaC::is_a<GiNaC::function>(call) && GiNaC::ex_to<GiNaC::function>(call).get_name() == name;
    }

    /// sin(a·x + rest) = 0, cos(a·x + rest) = 0.
    std::optional<std::vector<RootChoice>> zeros_of(const ex& call) const {
        const ex arg = call.op(0).expand();
        for (std::size_t i = m_.q.size(); i-- > 0;) {
            if (!arg.has(m_.q[i])) continue;
            const ex slope = arg.coeff(m_.q[i], 1), rest = arg.coeff(m_.q[i], 0);
            if (!(arg - slope * m_.q[i] - rest).expand().is_zero() || rest.has(m_.q[i])) return {};
            if (!GiNaC::is_a<GiNaC::numeric>(slope) || !slope.info(GiNaC::info_flags::integer)) continue;
            const int turns = std::abs(GiNaC::ex_to<GiNaC::numeric>(slope).to_int());
            if (turns < 1 || turns > 4) return {};
            std::vector<RootChoice> result;
            const ex first = is(call, "cos") ? GiNaC::Pi / 2 : ex(0);
            for (int k = 0; k < 2 * turns; ++k)
                result.push_back({i, ((first + k * GiNaC::Pi - rest) / slope).expand()});
            return result;
        }
        return {};
    }

    std::optional<std::vector<RootChoice>> of_first_degree(const ex& base, const GiNaC::exmap& functions,
                                                           const std::vector<std::pair<ex, ex>>& letters,
                                                           std::size_t i) const {
        const ex x = m_.q[i];
        for (const auto& [letter, call] : letters)
            if (call.has(x)) return {};
        if (!base.is_polynomial(x) || base.degree(x) != 1) return {};
        const ex slope = base.coeff(x, 1).subs(functions), rest = base.coeff(x, 0).subs(functions);
        if (has_coordinate(slope) || vanishes_(slope)) return {};
        return std::vector<RootChoice>{{i, -rest / slope}};
    }

    /// A factor in which one coordinate occurs.
    std::optional<std::vector<RootChoice>> of_one(const ex& base, const GiNaC::exmap& functions,
                                                  const std::vector<std::pair<ex, ex>>& letters,
                                                  std::size_t i) const {
        const ex x = m_.q[i];
        std::vector<std::pair<ex, ex>> moving;
        for (const auto& one : letters)
            if (one.second.has(x)) moving.push_back(one);
        if (moving.empty()) {
            std::vector<RootChoice> result;
            const auto values = polynomial_roots(base, x, functions);
            if (!values) return {};
            for (const auto& [value, where] : *values) result.push_back({i, value, where});
            return result;
        }
        if (base.has(x)) return {};  // outside of its functions too
        for (const auto& [letter, call] : moving)
            if (!call.op(0).is_equal(moving[0].second.op(0))) return {};
        const ex arg = moving[0].second.op(0);
        const ex slope = arg.coeff(x, 1), shift = arg.coeff(x, 0);
        if (!(arg - slope * x - shift).expand().is_zero() || !(slope - 1).is_zero()) return {};
        if (moving.size() == 2) return of_sine_and_cosine(base, functions, moving, i, shift);
        const auto values = polynomial_roots(base, moving[0].first, functions);
        if (!values) return {};
        std::vector<RootChoice> result;
        for (const auto& [value, where] : *values) {
            std::vector<std::string> conditions = where;
            conditions.push_back(fmt::format("{} <= 1", text_of(absolute(value))));
            if (is(moving[0].second, "cos")) {
                result.push_back({i, GiNaC::acos(value) - shift, conditions});
                result.push_back({i, -GiNaC::acos(value) - shift, conditions});
            } else {
                result.push_back({i, GiNaC::asin(value) - shift, conditions});
                result.push_back({i, GiNaC::Pi - GiNaC::asin(value) - shift, conditions});
            }
        }
        return result;
    }

    /// a sin + b cos + c = 0, a and b not both zero.
    std::optional<std::vector<RootChoice>> of_sine_and_cosine(const ex& base, const GiNaC::exmap& functions,
                                                              const std::vector<std::pair<ex, ex>>& both,
                                                              std::size_t i, const ex& shift) const {
        const bool sine_first = is(both[0].second, "sin");
        const ex s = both[sine_first ? 0 : 1].first, c = both[sine_first ? 1 : 0].first;
        if (!base.is_polynomial(GiNaC::lst{s, c}) || base.degree(s) != 1 || base.degree(c) != 1) return {};
        const ex a = base.coeff(s, 1), rest = base.coeff(s, 0), b = rest.coeff(c, 1), d = rest.coeff(c, 0);
        if (a.has(c)) return {};
        const ex A = a.subs(functions), B = b.subs(functions), D = d.subs(functions);
        if (vanishes_(A) || vanishes_(B)) return {};
        if (D.is_zero())
            return std::vector<RootChoice>{{i, GiNaC::atan2(-B, A) - shift}, {i, GiNaC::atan2(B, -A) - shift}};
        const ex middle = GiNaC::atan2(A, B), aside = GiNaC::acos(-D / GiNaC::sqrt(A * A + B * B));
        const std::string where = fmt::format("{} <= {}", text_of(D * D), text_of(A * A + B * B));
        return std::vector<RootChoice>{{i, middle + aside - shift, {where}}, {i, middle - aside - shift, {where}}};
    }

    using Value = std::pair<ex, std::vector<std::string>>;
    std::optional<std::vector<Value>> polynomial_roots(const ex& base, const ex& x,
                                                       const GiNaC::exmap& functions) const {
        if (!base.is_polynomial(x)) return {};
        const int degree = base.degree(x);
        if (degree < 1 || degree > 2) return {};
        const auto coefficient = [&](int k) { return base.coeff(x, k).subs(functions); };
        const ex a = coefficient(degree), b = coefficient(degree - 1);
        if (vanishes_(a)) return {};
        if (degree == 1) return std::vector<Value>{{lowest_terms(-b / a), {}}};
        const ex c = coefficient(0), inside = (b * b - 4 * a * c).expand();
        std::vector<std::string> where;
        if (!GiNaC::is_a<GiNaC::numeric>(inside)) where.push_back(fmt::format("{} >= 0", text_of(inside)));
        if (GiNaC::is_a<GiNaC::numeric>(inside) && inside < 0) return std::vector<Value>{};
        const ex root = b.is_zero() ? GiNaC::sqrt(lowest_terms(-c / a)) : GiNaC::sqrt(inside) / (2 * a);
        if (b.is_zero()) where = {fmt::format("{} >= 0", text_of(lowest_terms(-c / a)))};
        return std::vector<Value>{{-b / (2 * a) + root, where}, {-b / (2 * a) - root, where}};
    }

    bool finish(const std::vector<RootChoice>& chosen) {
        ClosedRoot root{
            .value = std::vector<ex>(m_.q.size(), 0), .text = std::vector<std::string>(m_.q.size()), .where = {}};
        std::vector<bool> has(m_.q.size(), false);
        for (const RootChoice& one : chosen) {
            has[one.coordinate] = true;
            root.value[one.coordinate] = one.value;
            root.text[one.coordinate] = shortest_text_of(one.value);
            if (root.text[one.coordinate].empty() || has_coordinate(one.value)) return false;
            for (const std::string& condition : one.where)
                if (std::find(root.where.begin(), root.where.end(), condition) == root.where.end())
                    root.where.push_back(condition);
        }
        for (std::size_t i = 0; i < has.size(); ++i)
            if (essential_[i] && !has[i]) return false;  // a continuum
        roots.push_back(std::move(root));
        return true;
    }

    const Mechanism& m_;
    const std::vector<bool>& essential_;
    const std::function<bool(const ex&)>& vanishes_;
};

}  // namespace

std::optional<std::vector<ClosedRoot>> closed_form(const Mechanism& m, const Equations& e,
                                                   const std::vector<bool>& essential,
                                                   const std::function<bool(const ex&)>& vanishes) try {
    if (!m.constraints.empty() || !e.speeds_are_rates() || m.size() > most_coordinates) return {};
    GiNaC::exmap still;
    for (int i = 0; i < m.size(); ++i) {
        if (essential[i])
            still[m.qdot[i]] = 0;
        else
            still[m.q[i]] = 0;
    }
    for (const Mechanism::Input& input : m.inputs) {
        const ex value = m.z->expand(input.value);  // an input that changes with time has no amplitude here
        still[input.derivative[0]] = value.has(m.t) && vanishes(value) ? ex(0) : value.subs(m.t == 0);
        still[input.derivative[1]] = still[input.derivative[2]] = 0;
    }
    std::vector<ex> equations;
    for (int i = 0; i < m.size(); ++i) {
        if (m.z->tree_size(e.forcing(i)) > largest_tree) return {};
        equations.push_back(m.z->expand(e.forcing(i)).subs(still).subs(still));
    }
    ClosedForm closed(m, essential, vanishes);
    if (!closed.solve(equations, {})) return {};
    return std::move(closed.roots);
} catch (const std::exception&) {  // a pole, or a function without a value; then the numeric search decides
    return {};
}

}  // namespace alembert
