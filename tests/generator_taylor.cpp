// SPDX-License-Identifier: MIT
// Coefficients of power series, by emitted files and by machine code in memory, against routes that share nothing
// with their recurrences: closed forms by Cauchy's integral over a circle in the complex plane, the interpreter
// along the polynomial, and the same file in 34 digits.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <functional>
#include <numbers>

#include "alembert/base/error.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/ode/series.hpp"
#include "alembert/ode/taylor.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/emit/taylor.hpp"
#include "codegen/machine/can_run.hpp"
#include "codegen/machine/memory_series.hpp"
#include "codegen/machine/memory_series_packs.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/lower/choose.hpp"
#include "program/quad.hpp"
#include "program/recurrence.hpp"
#include "scenes.hpp"

namespace generator_taylor {

using namespace alembert;

namespace {

using Complex = std::complex<long double>;

/// f's coefficients about t by the trapezoidal rule on a circle (its error: the coefficients 200 orders higher).
std::vector<long double> coefficients(const std::function<Complex(Complex)>& f, long double t, long double radius,
                                      int count) {
    constexpr int points = 200;
    std::vector<long double> result;
    for (int k = 0; k < count; ++k) {
        Complex sum = 0;
        for (int j = 0; j < points; ++j) {
            const long double angle = 2 * std::numbers::pi_v<long double> * j / points;
            sum += f(Complex(t) + std::polar(radius, angle)) * std::polar(1.0L, -angle * k);
        }
        result.push_back(sum.real() / points / std::pow(radius, k));
    }
    return result;
}

/// The coefficients at a state: out[k · width + i].
using Coefficients = std::function<std::vector<double>(double t, const std::vector<double>& state, int order)>;

std::vector<double> series_of(const SeriesModule& module, double t, const std::vector<double>& state, int order) {
    const Series series = make_series(module);
    std::vector<double> out(static_cast<std::size_t>((order + 1) * series.width)),
        work(static_cast<std::size_t>(series.workspace));
    series(t, state.data(), order, out.data(), work.data());
    return out;
}

/// Those in the given lane; the other lanes have states and times nearby.
std::vector<double> series_of(const PackSeries& packs, const std::vector<double>& parameters, double t,
                              const std::vector<double>& state, int order, int lane) {
    std::vector<double> own = parameters;
    own.resize(static_cast<std::size_t>(packs.parameters + packs.constants));
    packs.prepare(own.data());
    Lanes times;
    std::vector<Lanes> y(state.size()), par(own.size()),
        out(static_cast<std::size_t>((order + 1) * packs.places.width)), work(packs.workspace());
    for (int other = 0; other < lanes; ++other) {
        times[other] = t + 0.1 * (other - lane);
        for (std::size_t i = 0; i < y.size(); ++i) y[i][other] = state[i] * (1 + 0.01 * (other - lane));
        for (std::size_t i = 0; i < par.size(); ++i) par[i][other] = own[i];
    }
    packs.expand(times, y.data(), par.data(), order, out.data(), work.data());
    std::vector<double> result;
    for (const Lanes& pack : out) result.push_back(pack[lane]);
    return result;
}

struct Emitted {
    Mechanism mechanism;
    Program program;
    SeriesModule module;
    SeriesModule in_memory;                   ///< null where the processor has no such code
    std::shared_ptr<const PackSeries> packs;  ///< likewise
    std::vector<Coefficients> all() const {
        std::vector<Coefficients> result;
        for (const SeriesModule& one : {module, in_memory})
            if (one)
                result.emplace_back([one](double t, const std::vector<double>& state, int order) {
                    return series_of(one, t, state, order);
                });
        if (packs)
            result.emplace_back([this](double t, const std::vector<double>& state, int order) {
                return series_of(*packs, {module->parameter_values, module->parameter_values + module->parameters},
                                 t, state, order, 5);
            });
        return result;
    }
};

Emitted emitted(const Scene& scene, bool quad) {
    Mechanism m = prepared(scene).mechanism;
    Equations e = formalism(m.constraints.empty() ? m.speeds.empty() ? "lagrange" : "kane" : "routh").derive(m);
    Program program = choose(m, e).program;
    std::vector<std::string> flags{"-O1"};
    if (quad) flags.emplace_back("-DALEMBERT_QUAD");
    const Compilation compiled = compile(emit_taylor(program).text, program.name + "_taylor",
                                         {.compiler = {}, .extra_flags = flags, .fast_math = false, .cache = {}});
    const std::optional<MemorySeries> memory = memory_series(program);
    REQUIRE(memory.has_value() == machine::can_run());
    std::shared_ptr<const PackSeries> packs = memory_series_packs(program);
    REQUIRE((packs != nullptr) == machine::can_run());
    return {std::move(m), std::move(program), load_series(compiled.object),
            memory ? memory->module : SeriesModule(), std::move(packs)};
}

/// x'' = f(t): the coefficients of x are those of f, integrated twice.
void check_function(const std::string& text, const std::function<Complex(Complex)>& f, long double radius) {
    INFO(text);
    const Scene scene = parse_scene(
        "title = \"f\"\n[coordinates]\nx = 0\n[energy]\nkinetic = \"x'^2/2\"\n[forces]\nx = \"" + text + "\"\n",
        "f.toml");
    const Emitted one = emitted(scene, false);
    constexpr double t = 0.7;
    constexpr int order = 24;
    const std::vector<long double> expected = coefficients(f, t, radius, order - 1);
    long double largest = 0;
    for (int j = 0; j < 200; ++j)
        largest = std::max(
            largest, std::abs(f(Complex(t) + std::polar(radius, 2 * std::numbers::pi_v<long double> * j / 200))));
    for (const Coefficients& series : one.all()) {
        const std::vector<double> out = series(t, {0, 0}, order);
        for (int k = 0; k + 2 <= order; ++k) {
            CAPTURE(k);
            // Cauchy's bound for a coefficient is largest/radius^k; recurrences of a few steps at each order keep
            // 1e-13 of it.
            const long double found = static_cast<long double>(out[2 * (k + 2)]) * (k + 1) * (k + 2);
            CHECK(std::abs(found - expected[k]) * std::pow(radius, k) < 1e-13 * largest);
        }
    }
}

/// An inner function for which no recurrence is trivial.
Complex g(Complex t) {
    return 0.3L + 0.2L * std::sin(t) + 0.1L * t;
}
const std::string g_text = "(0.3 + 0.2*sin(t) + 0.1*t)";

// P'(t + h) = f(t + h, P(t + h)) for the polynomial P of the emitted file: a wrong coefficient of any order k is
// off by k c_k h^(k−1) there, with h as long as a step at tolerance 1e-14, where all terms are seen. The right
// side comes from the interpreter. Allowed: rounding of 1e-12 of the largest rate, and the terms left out, (p + 1)
// c h^p < (p + 1) 1e-14/h.
void check_polynomial(const Emitted& one, const Coefficients& series) {
    const Program& p = one.program;
    Start start = start_of(one.mechanism);
    assemble(start, one.mechanism, lower_constraints(one.mechanism), {});
    const Equations equations =
        formalism(one.mechanism.constraints.empty() ? one.mechanism.speeds.empty() ? "lagrange" : "kane" : "routh")
            .derive(one.mechanism);
    State<double> state = state_of(start, one.mechanism, equations);
    std::vector<double> y = state.q;
    y.insert(y.end(), state.qdot.begin(), state.qdot.end());
    constexpr int order = 18;
    const std::vector<double> out = series(state.t, y, order);
    const std::size_t width = y.size(), n = state.q.size();
    double h = 1;
    for (const int k : {order - 1, order})  // if every other coefficient is 0, the last one may be 0
        for (std::size_t i = 0; i < width; ++i)
            h = std::min(h, std::pow(1e-14 / (std::abs(out[static_cast<std::size_t>(k) * width + i]) /
                                                  std::max(1.0, std::abs(y[i])) +
                                              1e-30),
                                     1.0 / k));
    std::vector<double> value(width), slope(width);
    for (std::size_t i = 0; i < width; ++i)
        for (int k = order; k >= 0; --k) {
            value[i] = value[i] * h + out[static_cast<std::size_t>(k) * width + i];
            if (k > 0) slope[i] = slope[i] * h + k * out[static_cast<std::size_t>(k) * width + i];
        }
    State<double> there = state;
    there.t = state.t + h;
    there.q.assign(value.begin(), value.begin() + static_cast<std::ptrdiff_t>(n));
    there.qdot.assign(value.begin() + static_cast<std::ptrdiff_t>(n), value.end());
    const std::vector<double> nodes = interpret(p, there);
    std::vector<double> rate;
    if (p.speeds.empty()) rate = there.qdot;
    for (const int id : p.nodes_of(Group::rate)) rate.push_back(nodes[static_cast<std::size_t>(id)]);
    for (const int id : p.nodes_of(Group::acceleration)) rate.push_back(nodes[static_cast<std::size_t>(id)]);
    REQUIRE(rate.size() == width);
    double largest = 0, worst = 0, left_out = 0;
    for (std::size_t i = 0; i < width; ++i) {
        largest = std::max(largest, std::abs(rate[i]));
        left_out = std::max(left_out, (order + 1) * 1e-14 / h * std::max(1.0, std::abs(y[i])));
        worst = std::max(worst, std::abs(rate[i] - slope[i]));
    }
    CAPTURE(h);
    CHECK(worst < 1e-12 * largest + left_out);
    CHECK(h > 1e-6);
}

void check_polynomial(const Scene& scene) {
    const Emitted one = emitted(scene, false);
    for (const Coefficients& series : one.all()) check_polynomial(one, series);
}

}  // namespace

TEST_CASE("taylor: the coefficients of every function are Cauchy's integrals") {
    check_function(
        "sin" + g_text, [](Complex t) { return std::sin(g(t)); }, 1);
    check_function(
        "cos" + g_text, [](Complex t) { return std::cos(g(t)); }, 1);
    check_function(
        "tan" + g_text, [](Complex t) { return std::tan(g(t)); }, 0.7L);
    check_function(
        "asin" + g_text, [](Complex t) { return std::asin(g(t)); }, 0.7L);
    check_function(
        "acos" + g_text, [](Complex t) { return std::acos(g(t)); }, 0.7L);
    check_function(
        "atan" + g_text, [](Complex t) { return std::atan(g(t)); }, 0.7L);
    check_function(
        "sinh" + g_text, [](Complex t) { return std::sinh(g(t)); }, 1);
    check_function(
        "cosh" + g_text, [](Complex t) { return std::cosh(g(t)); }, 1);
    check_function(
        "tanh" + g_text, [](Complex t) { return std::tanh(g(t)); }, 0.7L);
    check_function(
        "exp" + g_text, [](Complex t) { return std::exp(g(t)); }, 1);
    check_function(
        "log" + g_text, [](Complex t) { return std::log(g(t)); }, 0.7L);
    check_function(
        "sqrt" + g_text, [](Complex t) { return std::sqrt(g(t)); }, 0.7L);
    check_function(
        "atan2(" + g_text + ", cos(t))",
        [](Complex t) {
            const Complex y = g(t), x = std::cos(t);
            return -Complex(0, 1) * std::log((x + Complex(0, 1) * y) / std::sqrt(x * x + y * y));
        },
        0.4L);
}

TEST_CASE("taylor: powers, quotients and products of roots are Cauchy's integrals") {
    check_function(
        "1/" + g_text, [](Complex t) { return 1.0L / g(t); }, 0.7L);
    check_function(
        "t*exp(-t)/" + g_text + "^3", [](Complex t) { return t * std::exp(-t) / (g(t) * g(t) * g(t)); }, 0.7L);
    check_function(
        g_text + "^2.7", [](Complex t) { return std::pow(g(t), 2.7L); }, 0.7L);
    check_function(
        g_text + "^t", [](Complex t) { return std::pow(g(t), t); }, 0.7L);
    check_function(
        "1.7^sin(t)", [](Complex t) { return std::pow(Complex(1.7L), std::sin(t)); }, 1);
    check_function(
        "t/sqrt" + g_text + "^3", [](Complex t) { return t / std::pow(g(t), 1.5L); }, 0.7L);
    check_function(
        "sqrt" + g_text + "*" + g_text, [](Complex t) { return std::pow(g(t), 1.5L); }, 0.7L);
    check_function(
        "exp(t)/(sqrt" + g_text + "*" + g_text + "^2)",
        [](Complex t) { return std::exp(t) / std::pow(g(t), 2.5L); }, 0.7L);
    check_function(
        "3*t^2/sqrt(2*" + g_text + ")", [](Complex t) { return 3.0L * t * t / std::sqrt(2.0L * g(t)); }, 0.7L);
}

TEST_CASE("taylor: functions with a kink are refused by name") {
    for (const std::string function : {"abs(x)", "sign(x)", "min(x, t)", "max(x, t)"}) {
        const Mechanism m = build(parse_scene(
            "[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\n[forces]\nx = \"-" + function + "\"\n",
            "k.toml"));
        const Program program = choose(m, formalism("lagrange").derive(m)).program;
        const std::optional<std::string> obstacle = obstacle_to_recurrences(program);
        REQUIRE(obstacle);
        CHECK_THROWS_WITH_AS(recurrences(program), obstacle->c_str(), ModelError);
        try {
            emit_taylor(program);
            FAIL(function);
        } catch (const ModelError& e) {
            const std::string message = e.what();
            INFO(message);
            CHECK(message.find(function.substr(0, 3)) != std::string::npos);
            CHECK(message.find("dop853") != std::string::npos);
        }
    }
}

TEST_CASE(
    "taylor: the derivative of the polynomial is the interpreter's rate at its value, for scenes of every kind") {
    for (const std::string name :
         {"benchmark/pleiades", "benchmark/outer_solar_system", "benchmark/kepler", "benchmark/flyball_governor",
          "textbook/double_pendulum", "textbook/cartesian_pendulum", "textbook/rolling_disc", "textbook/four_bar",
          "textbook/free_body_quaternion", "textbook/chaplygin_sleigh_in_speeds", "textbook/elastic_pendulum"}) {
        INFO(name);
        check_polynomial(read_scene(test::source_path("scenes/" + name + ".toml")));
    }
}

// The products of sines and those of cosines want their lanes in different orders, so that each has copies of the
// other: the recurrence of a sine needs the cosines of lower orders only, which a copy must not take before they
// are known.
TEST_CASE("taylor: sines and cosines whose lanes are in different orders get each other's coefficients") {
    constexpr int n = 4;
    std::string kinetic, forces, text = "[coordinates]\n";
    for (int i = 0; i < n; ++i) {
        text += fmt::format(
            "a{0} = {{ initial = 0.{0}, rate = 0.{1} }}\nb{0} = {{ initial = 0.{1}, rate = 0.2 }}\n", i, 9 - i);
        kinetic += fmt::format("{}a{}'^2/2 + b{}'^2/2", i > 0 ? " + " : "", i, i);
        forces += fmt::format("a{0} = \"cos(a{0})*b{0}\"\nb{0} = \"sin(a{1})*b{2} + a{0}\"\n", i, n - 1 - i,
                              (i + 1) % n);
    }
    check_polynomial(
        parse_scene(text + "[energy]\nkinetic = \"" + kinetic + "\"\n[forces]\n" + forces, "orders.toml"));
}

TEST_CASE("taylor: the file in doubles and the same file in 34 digits have the same coefficients") {
    for (const std::string name :
         {"benchmark/pleiades", "benchmark/kepler", "textbook/double_pendulum", "textbook/cartesian_pendulum"}) {
        INFO(name);
        const Emitted one = emitted(read_scene(test::source_path("scenes/" + name + ".toml")), true);
        const Start start = start_of(one.mechanism);
        std::vector<double> y = start.q;
        y.insert(y.end(), start.qdot.begin(), start.qdot.end());
        constexpr int order = 30;
        const alembert_series_table& table = *one.module;
        std::vector<Quad> par(static_cast<std::size_t>(table.parameters + table.constants)),
            state(y.begin(), y.end()), exact((order + 1) * y.size()),
            work(static_cast<std::size_t>(table.workspace_quad));
        std::copy_n(table.parameter_values, table.parameters, par.begin());
        table.prepare_quad(par.data());
        table.series_quad(Quad(start.t), state.data(), par.data(), order, exact.data(), work.data());
        const std::size_t width = y.size();
        for (const Coefficients& series : one.all()) {
            const std::vector<double> out = series(start.t, y, order);
            for (int k = 1; k <= order; ++k) {
                double largest = 0, worst = 0;
                for (std::size_t i = 0; i < width; ++i) {
                    const auto at = static_cast<std::size_t>(k) * width + i;
                    largest = std::max(largest, static_cast<double>(abs(exact[at])));
                    worst = std::max(worst, static_cast<double>(abs(exact[at] - Quad(out[at]))));
                }
                CAPTURE(k);
                CHECK(worst <= 1e-13 * k * largest);
            }
        }
    }
}

TEST_CASE("taylor: no bit of a series in a pack depends on its lane or on the other lanes") {
    for (const char* name : {"benchmark/pleiades", "textbook/double_pendulum", "textbook/rolling_disc"}) {
        INFO(name);
        const Emitted one = emitted(read_scene(test::source_path(fmt::format("scenes/{}.toml", name))), false);
        if (!one.packs) return;
        const Start start = start_of(one.mechanism);
        std::vector<double> y = start.q;
        y.insert(y.end(), start.qdot.begin(), start.qdot.end());
        y.resize(static_cast<std::size_t>(one.packs->places.width));
        const std::vector<double> first = series_of(*one.packs, start.parameters, start.t, y, 20, 0);
        REQUIRE(std::all_of(first.begin(), first.end(), [](double x) { return std::isfinite(x); }));
        for (int lane = 1; lane < lanes; ++lane)
            CHECK(series_of(*one.packs, start.parameters, start.t, y, 20, lane) == first);
    }
}

TEST_CASE("taylor: a series in memory goes over to the compiled one, at whatever parameters it is asked for") {
    if (!machine::can_run()) return;
    const Emitted one = emitted(read_scene(test::source_path("scenes/textbook/double_pendulum.toml")), false);
    const MemorySeries own = *memory_series(one.program);
    const std::vector<double> scene(one.module->parameter_values,
                                    one.module->parameter_values + one.module->parameters);
    std::vector<double> other = scene;
    for (double& value : other) value *= 1.25;
    constexpr int order = 12;
    const auto at = [&](const SeriesModule& module, const std::vector<double>& parameters) {
        const Series series = make_series(module, parameters);
        std::vector<double> out(static_cast<std::size_t>((order + 1) * series.width)),
            work(static_cast<std::size_t>(series.workspace));
        const double state[] = {0.3, -0.7, 1.1, 0.2};
        series(0, state, order, out.data(), work.data());
        return out;
    };
    CHECK(at(own.module, scene) != at(own.module, other));
    own.go_over(one.module);
    for (const std::vector<double>& parameters : {scene, other, scene})
        CHECK(at(own.module, parameters) == at(one.module, parameters));
}

TEST_CASE(
    "taylor: the order is Jorba and Zou's where products take all the time, higher where they do not, and never "
    "lower") {
    CHECK(taylor_order(1e-10, 0, 1) >= 13);
    CHECK(taylor_order(1e-10, 0, 1) <= 14);
    CHECK(taylor_order(1e-16, 0, 1) <= 21);
    CHECK(taylor_order(1e-10, 0.1, 0) >= 22);
    for (double tolerance = 1e-3; tolerance > 1e-18; tolerance /= 10) {
        CHECK(taylor_order(tolerance, 0.1, 0.005) >= std::ceil(1 - std::log(tolerance) / 2));
        CHECK(taylor_order(tolerance, 0.1, 0) <= most_order);
    }
}

TEST_CASE(
    "taylor: the order that halving finds is the one at which the effort ceases to fall from order to order") {
    for (int decade = 20; decade <= 140; decade += 3)
        for (const double order_cost : {0.0, 0.003, 0.02, 0.1, 0.4, 2.0, 30.0})
            for (const double product_cost : {0.0, 0.0004, 0.005, 0.06, 1.0, 20.0}) {
                const double tolerance = std::pow(10.0, -0.1 * decade);
                const auto effort = [&](int p) {
                    return (1 + order_cost * p + product_cost * p * p) *
                           std::pow(taylor_share * tolerance, -1.0 / p);
                };
                int best = std::clamp(static_cast<int>(std::ceil(1 - std::log(tolerance) / 2)), 4, most_order);
                while (best < most_order && effort(best + 1) < effort(best)) ++best;
                CAPTURE(tolerance);
                CAPTURE(order_cost);
                CAPTURE(product_cost);
                CHECK(taylor_order(tolerance, order_cost, product_cost) == best);
            }
}

}  // namespace generator_taylor
