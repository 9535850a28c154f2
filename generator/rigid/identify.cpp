// SPDX-License-Identifier: GPL-2.0-or-later
#include "rigid/identify.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "alembert/error.hpp"
#include "exact/square_points.hpp"
#include "language/say.hpp"
#include "lower/lower.hpp"
#include "lower/regressor.hpp"
#include "lower/start.hpp"
#include "program/interpret.hpp"
#include "program/reduce_rows.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_symbols = 6;  // parameters in which coefficients are written as polynomials
constexpr int most_tries = 20;           // of random points, a few of which are unusable

/// p ≡ numerator/denominator with both below the bound, by Euclid's algorithm (Wang 1981).
std::optional<Rational> short_fraction(Prime p) {
    constexpr std::int64_t bound = 1'000'000'000;
    if (!p.is_plain()) return std::nullopt;
    std::int64_t r0 = static_cast<std::int64_t>(Prime::modulus), r1 = static_cast<std::int64_t>(p.bits()), t0 = 0,
                 t1 = 1;
    while (r1 > bound) {
        const std::int64_t quotient = r0 / r1;
        r0 = std::exchange(r1, r0 - quotient * r1);
        t0 = std::exchange(t1, t0 - quotient * t1);
    }
    if (t1 == 0 || std::abs(t1) > bound) return std::nullopt;
    return Rational(cln::cl_I(static_cast<long>(t1 < 0 ? -r1 : r1))) / cln::cl_I(static_cast<long>(std::abs(t1)));
}

/// As a fraction if its denominator has three digits at the most, otherwise as decimals.
std::string text_of(const Rational& r) {
    const cln::cl_I above = cln::numerator(r), below = cln::denominator(r);
    if (below > 999) return fmt::format("{:.10g}", cln::double_approx(r));
    const auto digits = [](const cln::cl_I& n) { return std::to_string(cln::cl_I_to_long(n)); };
    return cln::equal(below, 1) ? digits(above) : fmt::format("{}/{}", digits(above), digits(below));
}

/// A coefficient without symbols: decimals where they end, as those of the scene do; 1/3 stays a fraction.
std::string number_text(const Rational& r) {
    cln::cl_I rest = cln::denominator(r);
    for (const int factor : {2, 5})
        while (cln::zerop(cln::mod(rest, factor))) rest = cln::exquo(rest, factor);
    return cln::equal(rest, 1) ? fmt::format("{:.10g}", cln::double_approx(r)) : text_of(r);
}

/// The dependences among the columns of Y, as the reduced row echelon form shows them, with the columns in
/// `order`.
struct Dependence {
    std::vector<std::size_t> pivots;       ///< places in the order
    std::vector<std::vector<Prime>> rows;  ///< one for each pivot
};

class Columns {
public:
    Columns(const Regressor& y, std::vector<std::size_t> order)
        : p_(y.function.program),
          nodes_(p_.nodes_of(Group::function)),
          order_(std::move(order)),
          halves_(std::max(2, halvings(p_, nodes_))) {}

    /// At random states, with these values of parameters; nothing if too many points are unusable.
    std::optional<Dependence> dependence(const std::vector<Prime>& parameters) const {
        const std::size_t width = order_.size(), rows_each = nodes_.size() / width;
        std::vector<std::vector<Prime>> rows;
        const std::size_t wanted = width / rows_each + 4;
        for (std::uint64_t state = 1, tries = 0; state <= wanted; ++state) {
            const auto values = evaluate_mod(p_, point(parameters, state + 1000 * tries), nodes_);
            if (!values) {
                if (++tries > most_tries) return std::nullopt;
                --state;
                continue;
            }
            for (std::size_t i = 0; i < rows_each; ++i) {
                rows.emplace_back();
                for (const std::size_t k : order_)
                    rows.back().push_back(values->value[static_cast<std::size_t>(nodes_[i * width + k])]);
            }
        }
        Dependence result;
        const int rank = reduce_rows(rows, width);
        rows.resize(static_cast<std::size_t>(rank));
        for (const auto& row : rows)
            result.pivots.push_back(static_cast<std::size_t>(
                std::find_if(row.begin(), row.end(), [](Prime x) { return !x.is_zero(); }) - row.begin()));
        result.rows = std::move(rows);
        return result;
    }

    /// The parameters on which Y depends.
    std::vector<int> used_parameters() const {
        std::set<int> used;
        for (const int id : p_.needed(nodes_))
            if (p_[id].op == Op::variable && p_[id].variable.kind == Variable::Kind::parameter)
                used.insert(p_[id].variable.index);
        return {used.begin(), used.end()};
    }

private:
    /// One seed, so that constant angles are the same at all states; only what moves is different.
    ModularPoint point(const std::vector<Prime>& parameters, std::uint64_t state) const {
        ModularPoint result{.seed = 20261123, .halves = halves_};
        for (std::size_t k = 0; k < parameters.size(); ++k)
            result.given[{Variable::Kind::parameter, static_cast<int>(k)}] = parameters[k];
        const ModularPoint random{.seed = state};
        const auto give = [&](Variable::Kind kind, int index) {
            result.given[{kind, index}] = random.variable({kind, index});
        };
        give(Variable::Kind::time, 0);
        for (int i = 0; i < static_cast<int>(p_.coordinates.size()); ++i)
            for (const auto kind :
                 {Variable::Kind::coordinate, Variable::Kind::rate, Variable::Kind::acceleration})
                give(kind, i);
        return result;
    }

    const Program& p_;
    std::vector<int> nodes_;
    std::vector<std::size_t> order_;
    int halves_;
};

/// A coefficient of Y's columns: the entry of the echelon form in the row of a pivot and the column of a
/// dependent.
struct DependentEntry {
    std::size_t row, column;
};

std::vector<DependentEntry> entries_of(const Dependence& d) {
    std::vector<DependentEntry> entries;
    for (std::size_t r = 0; r < d.rows.size(); ++r)
        for (std::size_t c = d.pivots[r] + 1; c < d.rows[r].size(); ++c)
            if (!d.rows[r][c].is_zero()) entries.push_back({r, c});
    return entries;
}

/// Exponents of each monomial of degree two at the most.
std::vector<std::vector<int>> monomials_of(std::size_t symbols) {
    std::vector<std::vector<int>> result{std::vector<int>(symbols, 0)};
    for (std::size_t i = 0; i < symbols; ++i) {
        result.push_back(result[0]);
        ++result.back()[i];
        for (std::size_t k = i; k < symbols; ++k) {
            result.push_back(result[0]);
            ++result.back()[i];
            ++result.back()[k];
        }
    }
    return result;
}

std::string monomial_text(const Rational& factor, const std::vector<int>& exponents,
                          const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t k = 0; k < names.size(); ++k)
        if (exponents[k] > 0)
            text +=
                (text.empty() ? "" : "*") + names[k] + (exponents[k] > 1 ? fmt::format("^{}", exponents[k]) : "");
    if (text.empty()) return number_text(factor);
    if (factor == Rational(1)) return text;
    return factor == Rational(-1) ? "-" + text : text_of(factor) + "*" + text;
}

/// The entries as polynomials in the parameters of which Y is made; an empty text where an entry is none.
std::vector<std::string> polynomials(const Columns& columns, const Dependence& nominal,
                                     const std::vector<DependentEntry>& entries, const std::vector<Prime>& values,
                                     const std::vector<Quantity>& parameters) {
    std::vector<std::string> texts(entries.size()), names;
    const std::vector<int> used = columns.used_parameters();
    if (used.empty() || used.size() > most_symbols) return texts;
    for (const int k : used) names.push_back(parameters[static_cast<std::size_t>(k)].name);
    const std::vector<std::vector<int>> monomials = monomials_of(used.size());
    std::vector<std::vector<Prime>> equations;
    for (std::uint64_t sample = 1; equations.size() < monomials.size() + 2; ++sample) {
        std::vector<Prime> at = values;
        for (const int k : used)
            at[static_cast<std::size_t>(k)] =
                ModularPoint{.seed = 7 * sample}.variable({Variable::Kind::parameter, k});
        const std::optional<Dependence> d = columns.dependence(at);
        if (!d || d->pivots != nominal.pivots) return texts;
        equations.emplace_back();
        for (const std::vector<int>& exponents : monomials) {
            Prime value = 1;
            for (std::size_t k = 0; k < used.size(); ++k)
                for (int e = 0; e < exponents[k]; ++e) value *= at[static_cast<std::size_t>(used[k])];
            equations.back().push_back(value);
        }
        for (const DependentEntry& e : entries) equations.back().push_back(d->rows[e.row][e.column]);
    }
    if (reduce_rows(equations, monomials.size()) != static_cast<int>(monomials.size())) return texts;
    for (std::size_t e = 0; e < entries.size(); ++e) {
        const std::size_t column = monomials.size() + e;
        std::string text;
        for (std::size_t k = 0; k < equations.size(); ++k) {
            const Prime factor = equations[k][column];
            if (factor.is_zero()) continue;
            const std::optional<Rational> fraction = short_fraction(factor);
            if (k >= monomials.size() || !fraction) {  // no such polynomial
                text.clear();
                break;
            }
            const std::string term = monomial_text(*fraction, monomials[k], names);
            text += text.empty() ? term : term[0] == '-' ? " - " + term.substr(1) : " + " + term;
        }
        texts[e] = text;
    }
    return texts;
}

/// Least squares over random states: the columns by those of the pivots, a row for each pivot.
Eigen::MatrixXd coefficients_in_doubles(const Regressor& y, const std::vector<std::size_t>& order,
                                        const Dependence& d, const State<double>& start) {
    const Program& p = y.function.program;
    const std::vector<int> nodes = p.nodes_of(Group::function);
    const auto width = static_cast<Eigen::Index>(order.size()), each = static_cast<Eigen::Index>(y.function.rows),
               states = 3 * width / each + 4;
    Eigen::MatrixXd W(states * each, width);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> any(-3, 3);
    for (Eigen::Index s = 0; s < states; ++s) {
        State<double> state = start;
        state.qddot.resize(state.q.size());
        for (auto* list : {&state.q, &state.qdot, &state.qddot})
            for (double& x : *list) x = any(random);
        const std::vector<double> value = interpret(p, state);
        for (Eigen::Index i = 0; i < each; ++i)
            for (Eigen::Index k = 0; k < width; ++k)
                W(s * each + i, k) = value[static_cast<std::size_t>(
                    nodes[static_cast<std::size_t>(i * width) + order[static_cast<std::size_t>(k)]])];
    }
    Eigen::MatrixXd kept(W.rows(), static_cast<Eigen::Index>(d.pivots.size()));
    for (std::size_t r = 0; r < d.pivots.size(); ++r)
        kept.col(static_cast<Eigen::Index>(r)) = W.col(static_cast<Eigen::Index>(d.pivots[r]));
    return kept.colPivHouseholderQr().solve(W);
}

/// Second moments, then first moments, then masses, then rotors.
std::vector<std::size_t> order_of(const std::vector<InertialParameter>& columns) {
    std::vector<std::size_t> order(columns.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto kind = [&](std::size_t k) {
        const int which = columns[k].which;
        return which == InertialParameter::rotor ? 3 : which == 0 ? 2 : which < 4 ? 1 : 0;
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return kind(a) < kind(b); });
    return order;
}

/// The exact values of the parameters; random ones where they are not rational.
std::vector<Prime> exact_values(const Mechanism& m) {
    std::vector<Prime> values;
    for (const Mechanism::Parameter& p : m.parameters) {
        if (!p.independent) continue;
        std::optional<Prime> value;
        if (GiNaC::is_a<GiNaC::numeric>(p.value) && p.value.info(GiNaC::info_flags::rational))
            value = Prime::from(cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(p.value).to_cl_N()));
        values.push_back(value.value_or(
            ModularPoint{.seed = 3}.variable({Variable::Kind::parameter, static_cast<int>(values.size())})));
    }
    return values;
}

/// The scene's values of parameters of bodies and their mass centres.
std::vector<double> values_of(const Regressor& y, const Mechanism& mechanism, const State<double>& state,
                              std::vector<Identification::Body>& bodies) {
    Mechanism m = mechanism;
    m.z = y.z;
    std::vector<GiNaC::ex> list = y.values;
    for (const auto& [name, centre] : y.centres) list.insert(list.end(), centre.begin(), centre.end());
    Program program;
    const std::vector<int> nodes = lower_expressions(program, m, list);
    const std::vector<double> at = interpret(program, state);
    std::vector<double> values;
    for (const int node : nodes) values.push_back(at[static_cast<std::size_t>(node)]);
    for (std::size_t k = 0, next = y.values.size(); k < y.centres.size(); ++k, next += 3)
        bodies.push_back({y.centres[k].first, {values[next], values[next + 1], values[next + 2]}});
    values.resize(y.values.size());
    return values;
}

void refuse_unsuitable(const Mechanism& m) {
    if (m.q.empty()) throw ModelError(say("the scene has no coordinates, so that no motion shows its masses"));
    if (!m.constraints.empty())
        throw ModelError(say(
            "constraint '{}' bears loads that are not measured, and the combinations of masses that then show are "
            "not told; expected a tree of joints without constraints, with floating bodies by angles in place of "
            "quaternions",
            m.constraints[0].name));
}

}  // namespace

Identification identify(Scene scene) {
    Identification result{prepared(std::move(scene))};
    const Mechanism& m = result.mechanism;
    refuse_unsuitable(m);
    const Regressor y = regressor(result.scene, m, false);
    const std::vector<std::size_t> order = order_of(y.columns);
    const Columns columns(y, order);
    const std::vector<Prime> exact = exact_values(m);
    const std::optional<Dependence> found = columns.dependence(exact);
    if (!found)
        throw ModelError(
            say("the regressor has square roots or angles that have no exact values at random states"));
    const State<double> start = start_of(m).state();
    const std::vector<double> values = values_of(y, m, start, result.bodies);
    for (const InertialParameter& column : y.columns) result.parameters.push_back(column.name());
    const std::vector<DependentEntry> entries = entries_of(*found);
    const std::vector<std::string> texts =
        polynomials(columns, *found, entries, exact, y.function.program.parameters);
    const Eigen::MatrixXd numbers = coefficients_in_doubles(y, order, *found, start);

    std::vector<char> shows(order.size(), 0);
    for (const std::size_t pivot : found->pivots) {
        const std::size_t column = order[pivot];
        shows[column] = 1;
        result.base.push_back({.terms = {{result.parameters[column], "1", 1}}, .value = values[column]});
    }
    for (std::size_t e = 0; e < entries.size(); ++e) {
        const std::size_t column = order[entries[e].column];
        shows[column] = 1;
        const double number =
            numbers(static_cast<Eigen::Index>(entries[e].row), static_cast<Eigen::Index>(entries[e].column));
        std::string text = texts[e];
        const std::optional<Rational> fraction = short_fraction(found->rows[entries[e].row][entries[e].column]);
        if (text.empty()) {
            constexpr double agreement = 1e-6;  // of least squares
            const bool is_short =
                fraction && std::abs(cln::double_approx(*fraction) - number) < agreement * (1 + std::abs(number));
            text = is_short ? number_text(*fraction) : fmt::format("{:.10g}", number);
        }
        BaseParameter& base = result.base[entries[e].row];
        base.terms.push_back({result.parameters[column], text, number});
        base.value += number * values[column];
    }
    for (std::size_t k = 0; k < shows.size(); ++k)
        if (shows[k] == 0) result.without_influence.push_back(result.parameters[k]);
    return result;
}

}  // namespace alembert
