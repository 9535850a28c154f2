// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/linearization.hpp"

#include <algorithm>
#include <cmath>

#include "base/language/say.hpp"
#include "present/report/modes.hpp"
#include "present/report/page.hpp"
#include "present/report/shown_unit.hpp"

namespace alembert {

namespace {

using Matrix = Eigen::MatrixXd;

Json json_of(const Matrix& matrix) {
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        Json row = Json::array();
        for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j) + 0.0);  // avoids −0
        rows.push_back(std::move(row));
    }
    return rows;
}

Json json_of(const Eigen::VectorXd& column) {
    Json values = Json::array();
    for (const double x : column) values.push_back(x + 0.0);
    return values;
}

/// Adds columns of equal width, under their names if these are given.
void add(std::string& page, const char* letter, const Matrix& matrix, const std::vector<std::string>& rows,
         const std::vector<std::string>& columns) {
    const std::size_t title = std::string_view(letter).size();
    std::size_t label = title > 2 ? title - 2 : 0, width = 10;
    for (const std::string& name : rows) label = std::max(label, name.size());
    for (const std::string& name : columns) width = std::max(width, name.size());
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        for (Eigen::Index j = 0; j < matrix.cols(); ++j)
            width = std::max(width, fmt::format("{:.8g}", matrix(i, j) + 0.0).size());
    put(page, "{:<{}}", fmt::format("  {}", letter), label + 4);
    for (const std::string& name : columns) put(page, "  {:>{}}", name, width);
    put(page, "\n");
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        put(page, "    {:<{}}", rows[i], label);
        for (Eigen::Index j = 0; j < matrix.cols(); ++j)
            put(page, "  {:>{}}", fmt::format("{:.8g}", matrix(i, j) + 0.0), width);
        put(page, "\n");
    }
    put(page, "\n");
}

/// A, B and c.
void add_state_space(std::string& page, const Linearization& near) {
    add(page, "A", near.A, near.states, near.states);
    if (!near.inputs.empty()) add(page, "B", near.B, near.states, near.inputs);
    if (near.rest.size() > 0) add(page, "c", near.rest, near.states, {});
}

/// About the rows of a motion: the first and the last.
void add_along(std::string& page, const LinearizedScene& d) {
    say_on(page,
           "Along the motion from t = {:.6g} to t = {:.6g}, at {} rows: x' = A dx{} + c, where dx is the distance "
           "from "
           "the motion, whose own rates are c. --json and -o FILE.csv give all rows\n\n",
           d.times.front(), d.times.back(), d.times.size(), d.matrices.inputs.empty() ? "" : say(" + B du"));
    for (const std::size_t row : {std::size_t{0}, d.times.size() - 1}) {
        const Linearization& near = d.along[row];
        put(page, "t = {:.10g}\n\n", d.times[row]);
        add(page, "x", near.at, near.states, {});
        add_state_space(page, near);
        if (d.times.size() == 1) return;
    }
}

void add_matrices(std::string& page, const Linearization& near) {
    std::vector<std::string> own, rates;  // the coordinates and rates that belong to speeds
    for (const std::string& name : near.speeds) {
        own.push_back(name.substr(0, name.find('\'')));
        rates.push_back(name + "'");
    }
    std::vector<std::string> zeros;
    const auto show = [&](const char* letter, const Matrix& m, const std::vector<std::string>& columns) {
        if (m.isZero(0))
            zeros.emplace_back(letter);
        else
            add(page, letter, m, near.speeds, columns);
    };
    const bool full = near.speeds.size() == near.coordinates.size() && near.paired;
    say_on(page, "{} = 0 for small deviations, with\n\n",
           full          ? "M q'' + (C + G) q' + (K + N) q"
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
    if (!zeros.empty()) put(page, "  {} = 0\n\n", fmt::join(zeros, " = "));
    if (near.rest.size() == 0)
        say_on(page, "x' = A x{}, with\n\n", near.inputs.empty() ? "" : say(" + B (inputs)"));
    else
        say_on(page, "x' = A dx{} + c, where dx is the distance from the state, with\n\n",
               near.inputs.empty() ? "" : say(" + B du"));
    add_state_space(page, near);
    if (near.outputs.empty()) return;
    say_on(page, "the outputs change by output_state x{}, with\n\n",
           near.inputs.empty() ? "" : say(" + output_input (inputs)"));
    add(page, "output_state", near.output_state, near.outputs, near.states);
    if (!near.inputs.empty()) add(page, "output_input", near.output_input, near.outputs, near.inputs);
}

void add_eigenvalues(std::string& page, const Linearization& near) {
    put(page, "{:>24}{:>24}{:>16}{:>16}\n", say("eigenvalue, real"), say("imaginary"), say("period"),
        say("damping ratio"));
    for (const std::complex<double>& value : near.eigenvalues) {
        if (value.imag() < 0) continue;
        put(page, "{:>24.16g}{:>24}", value.real() + 0.0,
            value.imag() == 0 ? "" : fmt::format("+-{:.16g}", value.imag()));
        if (value.imag() != 0)
            put(page, "{:>16.8g}{:>16.8g}", 2 * M_PI / value.imag(), -value.real() / std::abs(value) + 0.0);
        put(page, "\n");
    }
}

void add(std::string& page, const decltype(LinearizedScene::symbols)& symbols) {
    if (symbols.empty()) return;
    say_on(page, "In the parameters:\n\n");
    std::vector<std::string> zeros;
    for (const auto& [name, rows] : symbols) {
        std::size_t width = 1;
        bool zero = true;
        for (const auto& row : rows)
            for (const std::string& element : row)
                width = std::max(width, element.size()), zero = zero && element == "0";
        if (zero) {
            zeros.push_back(name);
            continue;
        }
        for (std::size_t i = 0; i < rows.size(); ++i) {
            put(page, "  {:<4}", i == 0 ? name : "");
            for (const std::string& element : rows[i]) put(page, "  {:>{}}", element, width);
            put(page, "\n");
        }
        put(page, "\n");
    }
    if (!zeros.empty()) put(page, "  {} = 0\n\n", fmt::join(zeros, " = "));
}

/// A row of a motion.
Json json_of(double time, const Linearization& near) {
    return {{"time", time},
            {"x", json_of(near.at)},
            {"c", json_of(near.rest)},
            {"A", json_of(near.A)},
            {"B", json_of(near.B)},
            {"output_state", json_of(near.output_state)},
            {"output_input", json_of(near.output_input)}};
}

}  // namespace

std::string as_csv(const LinearizedScene& d) {
    const Linearization& first = d.along.front();
    std::string table = "t";
    for (const std::string& state : first.states) table += "," + state;
    for (const std::string& state : first.states) table += fmt::format(",c({})", state);
    const auto name = [&](const char* letter, const std::vector<std::string>& rows,
                          const std::vector<std::string>& columns) {
        for (const std::string& row : rows)
            for (const std::string& column : columns) table += fmt::format(",{}({};{})", letter, row, column);
    };
    name("A", first.states, first.states);
    name("B", first.states, first.inputs);
    table += "\n";
    for (std::size_t row = 0; row < d.times.size(); ++row) {
        const Linearization& near = d.along[row];
        table += fmt::format("{:.17g}", d.times[row]);
        for (const Eigen::VectorXd* column : {&near.at, &near.rest})
            for (const double x : *column) table += fmt::format(",{:.17g}", x + 0.0);
        for (const Matrix* matrix : {&near.A, &near.B})
            for (Eigen::Index i = 0; i < matrix->rows(); ++i)
                for (Eigen::Index j = 0; j < matrix->cols(); ++j)
                    table += fmt::format(",{:.17g}", (*matrix)(i, j) + 0.0);
        table += "\n";
    }
    return table;
}

Json as_json(const LinearizedScene& d) {
    const Linearization& near = d.matrices;
    const Start& start = d.start;
    Json result;
    result["formalism"] = d.equations.formalism;
    result["time"] = start.t;
    result["motion"] = d.about == About::any ? "any" : near.moving.empty() ? "equilibrium" : "steady";
    result["moving"] = near.moving;
    for (const auto& [name, value] : d.reached) result["reached"][name] = std::stod(value);
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
    matrices["M"] = json_of(near.M);
    matrices["C"] = json_of(near.C);
    matrices["G"] = json_of(near.G);
    matrices["K"] = near.paired ? json_of(near.K) : Json();
    matrices["N"] = near.paired ? json_of(near.N) : Json();
    matrices["P"] = json_of(near.P);
    matrices["A"] = json_of(near.A);
    matrices["B"] = json_of(near.B);
    matrices["output_state"] = json_of(near.output_state);
    matrices["output_input"] = json_of(near.output_input);
    result["outputs"] = near.outputs;
    if (d.about == About::any) {
        result["form"] = "x' = A dx + B du + c";
        result["x0"] = json_of(near.at);
        result["c"] = json_of(near.rest);
    }
    for (std::size_t row = 0; row < d.times.size(); ++row)
        result["along"].push_back(json_of(d.times[row], d.along[row]));
    result["eigenvalues"] = Json::array();
    for (const std::complex<double>& value : near.eigenvalues)
        result["eigenvalues"].push_back({value.real() + 0.0, value.imag() + 0.0});
    result["modes"] = as_json(modes_of(near.A, near.eigenvalues), near.states);
    for (const auto& [name, rows] : d.symbols) result["symbolic"][name] = rows;
    return result;
}

namespace {

/// The unit in which the scene gives a coordinate or a state.
ShownUnit unit_of(const Mechanism& m, const std::string& name) {
    for (int i = 0; i < m.size(); ++i)
        if (m.q[i].get_name() == name) return ShownUnit(m.shown_units[static_cast<std::size_t>(i)]);
    for (const Mechanism::State& z : m.states)
        if (z.derivative[0].get_name() == name) return ShownUnit(z.shown);
    return ShownUnit(Shown{});
}

}  // namespace

std::string words_of_reached(const LinearizedScene& d) {
    std::string state;
    for (const auto& [name, value] : d.reached) {
        const ShownUnit unit = unit_of(d.mechanism, name);
        state += fmt::format("{}{} = {:.6g}", state.empty() ? "" : ", ", unit.label(name),
                             unit.value(std::stod(value)));
    }
    return state.empty()
               ? state
               : say("The start is no equilibrium and no steady motion; this is about the one that Newton's "
                     "method reaches from it: {}\n",
                     state);
}

std::string as_text(const LinearizedScene& d, bool with_modes) {
    const Linearization& near = d.matrices;
    const Start& start = d.start;
    std::string page;
    if (!d.scene.title.empty()) put(page, "{}\n\n", d.scene.title);
    if (!d.times.empty()) {
        add_along(page, d);
        return page;
    }
    page += words_of_reached(d);
    if (d.about == About::any)
        say_on(page, "About the state at t = {:.6g}\n", start.t);
    else if (near.moving.empty())
        say_on(page, "About the equilibrium\n");
    else
        say_on(page, "About the steady motion in which {} {}\n", fmt::join(near.moving, ", "),
               near.moving.size() == 1 ? say("moves") : say("move"));
    for (int i = 0; i < d.mechanism.size(); ++i) {
        const auto shown = [](double x, bool guess) { return guess && std::abs(x) < 1e-14 ? 0.0 : x + 0.0; };
        const double rate = shown(start.qdot[i], d.mechanism.qdot_is_guess[i]);
        put(page, "  {} = {:.10g}", d.mechanism.q[i].get_name(), shown(start.q[i], d.mechanism.q_is_guess[i]));
        if (rate != 0) put(page, ", {}' = {:.10g}", d.mechanism.q[i].get_name(), rate);
        put(page, "\n");
    }
    for (std::size_t k = 0; k < d.mechanism.states.size(); ++k)
        put(page, "  {} = {:.10g}\n", d.mechanism.states[k].derivative[0].get_name(), start.states[k] + 0.0);
    if (!near.dependent.empty()) say_on(page, "eliminated: {}\n", fmt::join(near.dependent, ", "));
    if (!near.left_out.empty())
        say_on(page, "left out, as nothing else depends on {}: {}\n",
               near.left_out.size() == 1 ? say("it") : say("them"), fmt::join(near.left_out, ", "));
    put(page, "\n");
    add_matrices(page, near);
    add(page, d.symbols);
    add_eigenvalues(page, near);
    if (with_modes) page += "\n" + as_text(modes_of(near.A, near.eigenvalues), near.states);
    return page;
}

}  // namespace alembert
