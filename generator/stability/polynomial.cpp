// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/polynomial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "base/language/say.hpp"
#include "model/constant.hpp"
#include "model/formalism/routh.hpp"
#include "model/parameter_values.hpp"
#include "program/lower/lower.hpp"
#include "stability/conditions.hpp"
#include "stability/linear/linearize_symbolic.hpp"
#include "stability/verdict.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t longest_condition = 600;  // in letters

std::string in_letters(const ex& e, const Symbols& symbols) {
    const auto f = fourier(e, symbols, 2000);
    if (!f) return "";
    return text(readable(*f));
}

bool begins_with_minus(const std::string& text) {
    return !text.empty() && text[0] == '-';
}

/// A condition as a person writes it. GiNaC's order, and so the signs of factors, is another one at every run: of
/// two ways to write a sum that which begins without a minus and, of these, that which is earlier in the alphabet
/// is taken, but for one sum which is turned so that the whole is positive, if it can be.
std::string text_of_condition(const ex& positive, const Symbols& symbols) {
    struct Side {
        ex value;
        std::string text, opposite;  ///< `opposite` is empty where it is no way to write it
    };
    std::vector<Side> sides;
    std::string number;
    ex whole = 1;
    const ex factors = GiNaC::is_a<GiNaC::mul>(positive) ? positive : ex(GiNaC::lst{positive});
    for (const ex& factor : factors) {
        if (GiNaC::is_a<GiNaC::numeric>(factor)) {
            whole *= GiNaC::abs(factor);
            if (!factor.is_equal(-1)) number = in_letters(GiNaC::abs(factor), symbols) + "*";
            continue;
        }
        Side side{factor, in_letters(factor, symbols), {}};
        if (side.text.empty()) return "";
        if (GiNaC::is_a<GiNaC::add>(factor.expand())) {
            side.opposite = in_letters(-factor, symbols);
            const auto order = [](const std::string& text) { return std::pair(begins_with_minus(text), text); };
            if (order(side.opposite) < order(side.text)) {
                std::swap(side.text, side.opposite);
                side.value = -factor;
            }
        }
        whole *= side.value;
        sides.push_back(std::move(side));
    }
    bool is_opposite = (whole + positive).expand().is_zero();
    for (Side& side : sides)
        if (is_opposite && !side.opposite.empty() && !begins_with_minus(side.opposite)) {
            std::swap(side.text, side.opposite);
            whole = -whole;
            is_opposite = false;
        }
    std::string shown = number;
    for (const Side& side : sides) {
        const bool is_part = !side.opposite.empty() && factors.nops() > 1;
        shown += (&side == &sides.front() ? "" : "*") + (is_part ? "(" + side.text + ")" : side.text);
    }
    if (const std::string one = in_letters(whole, symbols); !one.empty() && one.size() <= shown.size())
        shown = one;
    return shown + (is_opposite ? " < 0" : " > 0");
}

/// One text for each condition; none at all if one is too long to be read.
std::vector<std::string> texts(const std::vector<ex>& conditions, const Symbols& symbols) {
    std::vector<std::string> result;
    for (const ex& condition : conditions) {
        if (GiNaC::is_a<GiNaC::numeric>(condition)) return {};  // the condition does not depend on parameters
        const std::string shown = text_of_condition(condition, symbols);
        if (shown.empty() || shown.size() > longest_condition) return {};
        result.push_back(shown);
    }
    return result;
}

}  // namespace

Stability stability_of_polynomial(const Scene& scene, const StabilityOptions& options) {
    const PolynomialScene polynomial = polynomial_of(scene);
    const Mechanism& m = polynomial.mechanism;
    Stability result{.title = scene.title};
    Program program = begun(m);
    const std::vector<int> nodes = lower_expressions(program, m, polynomial.coefficients);
    State<Expansion> state;
    for (const RealBall& p : exact_parameters(m, start_of(m, options.at), options.exact_at))
        state.parameters.emplace_back(p);
    RealBallVector coefficients;
    const std::vector<Expansion> value = interpret(program, state);
    for (const int node : nodes) coefficients.push_back(value[node].value());
    if (coefficients.front().may_be_zero())
        throw ModelError(say(
            "the first coefficient of [polynomial] is zero at these parameters; expected the coefficient of the "
            "highest power, which is not zero: leave it out, or change the parameters"));
    result.eigenvalues = roots_of(coefficients);
    result.certain = true;
    const Decision decision = decide_linear(result.eigenvalues, nullptr);
    result.verdict = decision.verdict;
    result.theorem = decision.theorem;
    result.reason = decision.reason;
    result.conditions = texts(hurwitz_conditions(polynomial.coefficients), *m.symbols);
    result.conditions_for = say("asymptotic stability");
    for (const std::vector<ex>& row : routh_array(polynomial.coefficients)) {
        std::string line;
        for (const ex& entry : row) {
            const std::string shown = in_letters(entry, *m.symbols);
            line += (line.empty() ? "" : "   ") + (shown.empty() ? "?" : shown);
        }
        if (line.size() <= longest_condition) result.routh.push_back(line);
    }
    return result;
}

namespace {

/// Conditions of more terms than these nobody reads, and their determinants take minutes.
constexpr double most_terms = 1e6;

/// A bound on the number of terms of the largest Hurwitz determinant, in which n − 1 coefficients are multiplied.
double terms_of_determinant(const SymbolicPolynomial& p) {
    std::size_t most = 1;
    for (const ex& coefficient : p) {
        const ex sum = coefficient.expand();
        if (GiNaC::is_a<GiNaC::add>(sum)) most = std::max(most, sum.nops());
    }
    return std::pow(static_cast<double>(most), static_cast<double>(p.size()) - 2);
}

/// Conditions in letters for the coefficients of the polynomial, each of which is told in the parameters; for
/// where those in the parameters are too long to be read.
void tell_by_coefficients(Stability& result, const SymbolicPolynomial& p, const Symbols& known) {
    Symbols symbols = known;
    std::string letter = "a";
    const auto is_taken = [&](const GiNaC::symbol& s) { return s.get_name().starts_with(letter); };
    while (std::any_of(known.all().begin(), known.all().end(), is_taken)) letter += '_';
    SymbolicPolynomial letters;
    std::vector<std::string> coefficients;
    for (std::size_t k = 0; k < p.size(); ++k) {
        const std::string shown = in_letters(p[k], symbols);
        if (shown.empty() || shown.size() > longest_condition) return;
        const std::string name = fmt::format("{}{}", letter, k);
        letters.push_back(p[k].normal().is_zero() ? ex(0) : ex(symbols.declare(name, SymbolInfo::Kind::other)));
        coefficients.push_back(name + " = " + shown);
    }
    result.conditions = texts(hurwitz_conditions(letters, {letters.front()}), symbols);
    if (!result.conditions.empty()) result.coefficients = std::move(coefficients);
}

/// By the equations if these are in the rates, else by Routh's.
std::optional<SymbolicPencil> pencil_of(const Mechanism& m, const Equations& equations, const std::vector<ex>& q0,
                                        const std::vector<ex>& u0, const std::vector<ex>& z0) {
    if (equations.speeds_are_rates()) return symbolic_pencil(m, equations, q0, u0, z0);
    if (obstacle_to_routh(m)) return {};
    const Equations in_rates = routh(m);
    Mechanism own = m;
    own.z = in_rates.z;
    return symbolic_pencil(own, in_rates, q0, u0, z0);
}

/// Negates the polynomial if its first coefficient is negative at the values of the parameters. False if its sign
/// there is not found.
bool make_first_positive(SymbolicPolynomial& p, const Local& local) {
    std::vector<double> parameters;
    for (const RealBall& p : local.point.parameters) parameters.push_back(p.number());
    const double first = ParameterValues(local.mechanism, parameters).number(p.front());
    if (!std::isfinite(first) || first == 0) return false;
    if (first < 0)
        for (ex& coefficient : p) coefficient = -coefficient;
    return true;
}

}  // namespace

void add_conditions(Stability& result, const Local& local, const ExactOverrides& exact_at) {
    const Mechanism& m = local.mechanism;
    std::vector<ex> q0 = m.q_start, u0 = m.qdot_start, z0;
    for (const Mechanism::State& z : m.states) z0.push_back(z.start);
    for (const auto& [name, number] : exact_at)
        for (int i = 0; i < m.size(); ++i) {
            if (name == m.q[i].get_name()) q0[i] = constant_value(number);
            if (name == m.q[i].get_name() + "'") u0[i] = constant_value(number);
        }
    for (const auto& [name, number] : exact_at)
        for (std::size_t k = 0; k < z0.size(); ++k)
            if (name == m.states[k].derivative[0].get_name()) z0[k] = constant_value(number);
    // Is the state in use that of the scene? With constraints it is if the scene's obeys them.
    if (m.constraints.empty())
        for (int i = 0; i < m.size(); ++i)
            if (m.q_is_guess[i] || m.qdot_is_guess[i]) return;
    const auto found = pencil_of(m, local.equations, q0, u0, z0);
    // A state that is steady for these values of the parameters alone has no conditions in the parameters.
    if (!found || !found->stays) return;
    const int zeros =
        static_cast<int>(local.split.q.size() - local.essential.size() + local.cyclic_momenta.size());
    const auto degree = static_cast<std::size_t>(local.split.q.size() + local.split.u.size());
    SymbolicPolynomial p = characteristic(found->S2, found->S1, found->S0, zeros);
    if (p.size() < 2 || p.size() - 1 + static_cast<std::size_t>(zeros) != degree) return;
    bool are_neutral = false;  // zero roots of the steady motions beside this one
    while (result.theorem == StabilityTheorem::malkin && p.size() > 2 && p.back().normal().is_zero()) {
        p.pop_back();
        are_neutral = true;
    }
    if (!make_first_positive(p, local)) return;
    std::vector<ex> positive;
    for (const MassElement& body : m.masses)
        if (GiNaC::is_a<GiNaC::symbol>(body.mass)) positive.push_back(body.mass);
    positive.push_back(p.front());
    bool odd_vanish = true;
    for (std::size_t k = 1; k < p.size(); k += 2) odd_vanish = odd_vanish && p[k].normal().is_zero();
    if (terms_of_determinant(p) <= most_terms)
        result.conditions = texts(
            odd_vanish ? real_frequency_conditions(p, positive) : hurwitz_conditions(p, positive), *m.symbols);
    if (result.conditions.empty() && !odd_vanish) tell_by_coefficients(result, p, *m.symbols);
    if (result.conditions.empty()) return;
    const bool is_first = result.theorem == StabilityTheorem::first_approximation ||
                          result.theorem == StabilityTheorem::hurwitz ||
                          result.theorem == StabilityTheorem::kelvin_chetaev;
    result.conditions_for = odd_vanish    ? say("distinct frequencies in the first approximation")
                            : are_neutral ? say("negative real parts of all other eigenvalues")
                            : is_first    ? say("asymptotic stability")
                                          : say("asymptotic stability in the first approximation");
}

}  // namespace alembert
