// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/linearize.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "alembert/error.hpp"
#include "analysis/assemble.hpp"
#include "analysis/contacts.hpp"
#include "analysis/linearize_symbolic.hpp"
#include "commands/pipeline.hpp"
#include "formalism/elements.hpp"
#include "lower/lower.hpp"
#include "report/readable.hpp"
#include "report/text.hpp"

namespace alembert {

namespace {

using Matrix = Eigen::MatrixXd;

constexpr double closed_gap = 1e-9;  // · max(1, |q|)

Json as_json(const Matrix& matrix) {
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        Json row = Json::array();
        for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j) + 0.0);  // no −0
        rows.push_back(std::move(row));
    }
    return rows;
}

Json as_json(const Linearization& near, const Derived& d, const Start& start) {
    Json result;
    result["formalism"] = d.equations.formalism;
    result["time"] = start.t;
    result["motion"] = near.moving.empty() ? "equilibrium" : "steady";
    result["moving"] = near.moving;
    result["coordinates"] = Json::object();
    result["rates"] = Json::object();
    for (int i = 0; i < d.mechanism.size(); ++i) {
        result["coordinates"][d.mechanism.q[i].get_name()] = start.q[i];
        result["rates"][d.mechanism.q[i].get_name()] = start.qdot[i];
    }
    result["rows"] = near.speeds;
    result["columns"] = near.coordinates;
    result["dependent"] = near.dependent;
    result["states"] = near.states;
    result["inputs"] = near.inputs;
    Json& matrices = result["matrices"];
    matrices["M"] = as_json(near.M);
    matrices["C"] = as_json(near.C);
    matrices["G"] = as_json(near.G);
    matrices["K"] = near.paired ? as_json(near.K) : Json();
    matrices["N"] = near.paired ? as_json(near.N) : Json();
    matrices["P"] = as_json(near.P);
    matrices["A"] = as_json(near.A);
    matrices["B"] = as_json(near.B);
    result["eigenvalues"] = Json::array();
    for (const std::complex<double>& value : near.eigenvalues) result["eigenvalues"].push_back({value.real() + 0.0, value.imag() + 0.0});
    return result;
}

/// Columns of equal width, under their names where these are given.
void print(const char* letter, const Matrix& matrix, const std::vector<std::string>& rows, const std::vector<std::string>& columns) {
    std::size_t label = 0, width = 10;
    for (const std::string& name : rows) label = std::max(label, name.size());
    for (const std::string& name : columns) width = std::max(width, name.size());
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        for (Eigen::Index j = 0; j < matrix.cols(); ++j) width = std::max(width, fmt::format("{:.8g}", matrix(i, j) + 0.0).size());
    fmt::print("{:<{}}", fmt::format("  {}", letter), label + 4);
    for (const std::string& name : columns) fmt::print("  {:>{}}", name, width);
    fmt::print("\n");
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        fmt::print("    {:<{}}", rows[i], label);
        for (Eigen::Index j = 0; j < matrix.cols(); ++j) fmt::print("  {:>{}}", fmt::format("{:.8g}", matrix(i, j) + 0.0), width);
        fmt::print("\n");
    }
    fmt::print("\n");
}

void print_matrices(const Linearization& near) {
    std::vector<std::string> own, rates;  // the speeds' coordinates, the speeds' rates
    for (const std::string& name : near.speeds) {
        own.push_back(name.substr(0, name.find('\'')));
        rates.push_back(name + "'");
    }
    std::vector<std::string> zeros;
    const auto show = [&](const char* letter, const Matrix& m, const std::vector<std::string>& columns) {
        if (m.isZero(0))
            zeros.emplace_back(letter);
        else
            print(letter, m, near.speeds, columns);
    };
    const bool full = near.speeds.size() == near.coordinates.size() && near.paired;
    fmt::print("{} = 0 for small deviations, with\n\n", full           ? "M q'' + (C + G) q' + (K + N) q"
                                                    : near.paired ? "M r'' + (C + G) r' + (K + N) r"
                                                                  : "M w' + (C + G) w + P r");
    show("M", near.M, rates);
    show("C", near.C, near.speeds);
    show("G", near.G, near.speeds);
    if (near.paired) {
        show("K", near.K, own);
        show("N", near.N, own);
    } else {
        show("P", near.P, near.coordinates);
    }
    if (!zeros.empty()) fmt::print("  {} = 0\n\n", fmt::join(zeros, " = "));
    fmt::print("x' = A x{}, with\n\n", near.inputs.empty() ? "" : " + B (inputs)");
    print("A", near.A, near.states, near.states);
    if (!near.inputs.empty()) print("B", near.B, near.states, near.inputs);
}

void print_eigenvalues(const Linearization& near) {
    fmt::print("{:>24}{:>24}{:>16}{:>16}\n", "eigenvalue, real", "imaginary", "period", "damping ratio");
    for (const std::complex<double>& value : near.eigenvalues) {
        if (value.imag() < 0) continue;
        fmt::print("{:>24.16g}{:>24}", value.real() + 0.0, value.imag() == 0 ? "" : fmt::format("+-{:.16g}", value.imag()));
        if (value.imag() != 0) fmt::print("{:>16.8g}{:>16.8g}", 2 * M_PI / value.imag(), -value.real() / std::abs(value) + 0.0);
        fmt::print("\n");
    }
}

/// Matrices in the parameters, by name; in the order of the numbers. Empty where they are not short.
using SymbolRows = std::vector<std::pair<std::string, std::vector<std::vector<std::string>>>>;
constexpr std::size_t widest = 60;  // letters of an element

/// Initial values as the scene or --at has them.
std::vector<GiNaC::ex> starts(const Mechanism& m, const Request& request, const std::string& prime) {
    std::vector<GiNaC::ex> values = prime.empty() ? m.q_start : m.qdot_start;
    for (const std::string& item : request.at)
        for (int i = 0; i < m.size(); ++i)
            if (const std::string name = m.q[i].get_name() + prime; item.starts_with(name + "=")) values[i] = exact_number(item.substr(name.size() + 1));
    return values;
}

SymbolRows in_symbols(const Linearization& near, const Derived& d, const Request& request) {
    const Mechanism& m = d.mechanism;
    if (!near.paired || static_cast<int>(near.speeds.size()) != m.size()) return {};
    const auto found = symbolic_matrices(m, d.equations, starts(m, request, ""), starts(m, request, "'"));
    if (!found) return {};
    std::vector<int> order;
    for (const std::string& speed : near.speeds)
        for (int i = 0; i < m.size(); ++i)
            if (m.q[i].get_name() + "'" == speed) order.push_back(i);
    if (static_cast<int>(order.size()) != m.size()) return {};
    SymbolRows result;
    for (const auto& [name, matrix] : {std::pair("M", &found->M), std::pair("C", &found->C), std::pair("G", &found->G), std::pair("K", &found->K), std::pair("N", &found->N)}) {
        result.push_back({name, {}});
        for (const int i : order) {
            result.back().second.emplace_back();
            for (const int j : order) {
                const auto f = fourier((*matrix)(i, j), *m.symbols);
                if (!f) return {};
                result.back().second.back().push_back(text(readable(*f)));
                if (result.back().second.back().back().size() > widest) return {};
            }
        }
    }
    return result;
}

void print(const SymbolRows& symbols) {
    if (symbols.empty()) return;
    fmt::print("In the parameters:\n\n");
    std::vector<std::string> zeros;
    for (const auto& [name, rows] : symbols) {
        std::size_t width = 1;
        bool zero = true;
        for (const auto& row : rows)
            for (const std::string& element : row) width = std::max(width, element.size()), zero = zero && element == "0";
        if (zero) {
            zeros.push_back(name);
            continue;
        }
        for (std::size_t i = 0; i < rows.size(); ++i) {
            fmt::print("  {:<4}", i == 0 ? name : "");
            for (const std::string& element : rows[i]) fmt::print("  {:>{}}", element, width);
            fmt::print("\n");
        }
        fmt::print("\n");
    }
    if (!zeros.empty()) fmt::print("  {} = 0\n\n", fmt::join(zeros, " = "));
}

/// A sledge that runs straight has constant speeds along and across its axes, but not along x and y: where rates are not steady,
/// Kane's speeds may be.
Linearization linearized(Derived& d, const Request& request, const Start& start) {
    try {
        return linearize(d.mechanism, d.equations, start);
    } catch (const ModelError&) {
        const std::vector<Mechanism::Constraint>& all = d.mechanism.constraints;
        const bool nonholonomic = std::any_of(all.begin(), all.end(), [](const auto& c) { return !c.holonomic; });
        if (!nonholonomic || !request.by.empty() || !d.mechanism.speeds.empty() || !masses_are_known(d.mechanism)) throw;
        std::optional<Linearization> found;
        try {
            Derived other = derived_again(d, d.mechanism, "kane");
            found = linearize(other.mechanism, other.equations, start);
            d.equations = std::move(other.equations);
        } catch (const std::runtime_error&) {
        }
        if (!found) throw;
        return *std::move(found);
    }
}

}  // namespace

int linearize(const Request& request) {
    Derived d = derived(request);
    const Overrides overrides = overrides_of(request);
    Start start = start_of(d.mechanism, overrides);
    const std::vector<std::string> moved = assemble(start, d.mechanism, lower_constraints(d.mechanism), overrides);
    if (!d.mechanism.unilateral.empty()) {
        need_rates(d);
        const ContactView view(d.mechanism);
        const State<double> state = start.state();
        check_gaps(d.scene, d.mechanism, view, state, closed_gap);
        const std::vector<int> closed = contacts_at_rest(view, state, closed_gap).closed;
        if (!closed.empty()) d = derived_again(d, with_closed(d.mechanism, closed), "routh");
    }
    const Linearization near = linearized(d, request, start);
    const SymbolRows symbols = in_symbols(near, d, request);
    if (request.json) {
        Json result = as_json(near, d, start);
        for (const auto& [name, rows] : symbols) result["symbolic"][name] = rows;
        std::cout << as_text(result);
        return 0;
    }
    if (!d.scene.title.empty()) fmt::print("{}\n\n", d.scene.title);
    if (near.moving.empty())
        fmt::print("About the equilibrium\n");
    else
        fmt::print("About the steady motion in which {} {}\n", fmt::join(near.moving, ", "), near.moving.size() == 1 ? "moves" : "move");
    for (int i = 0; i < d.mechanism.size(); ++i) {
        const auto shown = [](double x, bool guess) { return guess && std::abs(x) < 1e-14 ? 0.0 : x + 0.0; };
        const double rate = shown(start.qdot[i], d.mechanism.qdot_is_guess[i]);
        fmt::print("  {} = {:.10g}", d.mechanism.q[i].get_name(), shown(start.q[i], d.mechanism.q_is_guess[i]));
        if (rate != 0) fmt::print(", {}' = {:.10g}", d.mechanism.q[i].get_name(), rate);
        fmt::print("\n");
    }
    if (!near.dependent.empty()) fmt::print("eliminated: {}\n", fmt::join(near.dependent, ", "));
    if (!near.left_out.empty()) fmt::print("left out, as nothing else depends on {}: {}\n", near.left_out.size() == 1 ? "it" : "them", fmt::join(near.left_out, ", "));
    fmt::print("\n");
    print_matrices(near);
    print(symbols);
    print_eigenvalues(near);
    return 0;
}

}  // namespace alembert
