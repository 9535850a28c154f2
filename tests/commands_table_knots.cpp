// SPDX-License-Identifier: MIT
// Knots of `[tables]` in runs: narrow pulses over the state, over functions of the time and with a period, by
// closed forms; what a long table hides is told; and names of tables in emitted code.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "json.hpp"
#include "program.hpp"
#include "shell.hpp"

namespace commands_table_knots {

using namespace alembert::test;

namespace {

/// A particle of 1 kg on x with this load.
std::string on_line(const std::string& start, const std::string& tables, const std::string& load,
                    const std::string& more = "") {
    return fmt::format(
        "[coordinates]\nx = {{ {} }}\n[tables]\n{}\n[[particle]]\nname = \"p\"\nmass = 1\nposition = [\"x\", 0]\n"
        "[forces]\nx = \"{}\"\n{}",
        start, tables, load, more);
}

/// Points of a triangle of this area over [from, from + 2 width], with zero from `first` to `last`.
std::string triangle(double first, double from, double width, double area, double last) {
    return fmt::format("[[{}, 0], [{}, 0], [{}, {}], [{}, 0], [{}, 0]]", first, from, from + width, area / width,
                       from + 2 * width, last);
}

double rate(const Json& motion) {
    return number(motion["final"], "rates", "x");
}

}  // namespace

// The work of the pulse is its area: v² = 1 + 2.
TEST_CASE("table knots: a pulse over the state is passed in no step, however narrow it is") {
    for (const double width : {1e-2, 5e-4, 1e-6})
        for (const double from : {2.0, 5.3, 9.1}) {
            const std::string scene =
                temporary("narrow.toml",
                          on_line("initial = 1, rate = 1",
                                  fmt::format("f = {{ arguments = [\"x\"], outside = \"hold\", points = {} }}",
                                              triangle(0, from, width, 1, 100)),
                                  "f(x)"));
            for (const std::vector<std::string>& how : {std::vector<std::string>{},
                                                        {"--method", "dopri5"},
                                                        {"--method", "radau"},
                                                        {"--method", "verner98"},
                                                        {"--method", "taylor"},
                                                        {"--code", "compiled"}}) {
                CAPTURE(width);
                CAPTURE(from);
                CAPTURE(how.empty() ? "" : how[1]);
                std::vector<std::string> more{"--duration", "10", "--no-estimate"};
                more.insert(more.end(), how.begin(), how.end());
                CHECK(std::abs(rate(simulated(scene, more)) - std::sqrt(3.0)) < 1e-7);
            }
        }
}

TEST_CASE("table knots: fixed steps see a pulse, and say where they are too long for it") {
    for (const double width : {1e-2, 5e-4, 1e-6})
        for (const char* const step : {"0.1", "0.001"}) {
            const std::string scene = temporary(
                "fixed.toml", on_line("initial = 1, rate = 1",
                                      fmt::format("f = {{ arguments = [\"x\"], outside = \"hold\", points = {} }}",
                                                  triangle(0, 5.3, width, 1, 100)),
                                      "f(x)"));
            CAPTURE(width);
            CAPTURE(step);
            const Run result =
                run({"simulate", scene, "--duration", "10", "--method", "rk4", "--step", step, "--json"});
            if (result.exit == 4) continue;
            INFO(result.err);
            REQUIRE(result.exit == 0);
            const Json motion = Json::parse(result.out);
            const bool is_right = std::abs(rate(motion) - std::sqrt(3.0)) < 1e-2;
            CHECK((is_right || motion["error_estimate"]["trustworthy"] == false));
            if (width == 1e-2 && std::string(step) == "0.001")
                CHECK(std::abs(rate(motion) - std::sqrt(3.0)) < 1e-6);
        }
}

TEST_CASE("table knots: pulses over a function of the time, in two arguments and in each period") {
    // u(t²/5): with s = t²/5 the impulse is ∫ f ds / s', with s' = 2 t/5 = 2/√(5/s)… = 2 √(s/5) at the pulse.
    const double s = 5.0, slope = 2 * std::sqrt(s / 5);
    const std::string of_square = temporary(
        "square.toml", on_line("initial = 0",
                               fmt::format("u = {{ arguments = [\"s\"], outside = \"hold\", points = {} }}",
                                           triangle(0, s - 1e-5, 1e-5, 1, 10)),
                               "u(t^2/5)"));
    // To the pulse's own width.
    CHECK(std::abs(rate(simulated(of_square, {"--duration", "7"})) - 1 / slope) < 1e-6);
    // Over (t, x), the same for all x.
    std::string grid;
    for (const double t : {0.0, 5.0, 5.0002, 5.0004, 10.0})
        for (const double x : {-9.0, 9.0})
            grid += fmt::format("{}[{}, {}, {}]", grid.empty() ? "" : ", ", t, x, t == 5.0002 ? 5000 : 0);
    const std::string of_two = temporary(
        "two.toml",
        on_line("initial = 0.5",
                fmt::format("u = {{ arguments = [\"t\", \"x\"], outside = \"hold\", points = [{}] }}", grid),
                "u(t, x)"));
    CHECK(std::abs(rate(simulated(of_two, {"--duration", "8"})) - 1) < 1e-9);
    // One pulse a period of x, forwards and backwards: v² = 1 + 2·7/10 from x = 0.2 to the end.
    for (const double way : {1.0, -1.0}) {
        const std::string turning =
            temporary("turning.toml", on_line(fmt::format("initial = 0.2, rate = {}", way),
                                              "f = { arguments = [\"x\"], period = 1, points = [[0, 0], [0.5, 0], "
                                              "[0.5001, 1000], [0.5002, 0]] }",
                                              fmt::format("{}*f(x)", way),
                                              "[[event]]\nname = \"end\"\nstop = true\nwhen = \"abs(x) - 7\"\n"));
        const Json motion = simulated(turning, {"--duration", "20"});
        CAPTURE(way);
        CHECK(std::abs(std::abs(rate(motion)) - std::sqrt(1 + 2 * 0.1 * 7)) < 1e-8);
    }
}

// ẍ = 0.2 − 0.5 sign v: 1 to rest in 1/0.3 s, and rest.
TEST_CASE("table knots: a motion stays where the slope of a table jumps against it") {
    for (const char* const points :
         {"[[-2, 1], [0, 0], [2, 1]]", "[[-2, 1], [-1, 0.5], [0, 0], [1, 0.5], [2, 1]]"}) {
        const std::string scene =
            temporary("rest.toml", on_line("initial = 0, rate = 1",
                                           fmt::format("g = {{ arguments = [\"v\"], points = {} }}", points),
                                           "0.2 - diff(g(x'), x')"));
        const Json motion = simulated(scene, {"--duration", "5"});
        CHECK(std::abs(rate(motion)) < 1e-12);
        CHECK(std::abs(number(motion["final"], "coordinates", "x") - 1 / 0.6) < 1e-9);
        CHECK(motion["error_estimate"]["trustworthy"] == true);
    }
}

TEST_CASE("table knots: a feature of a long table that a step passes at once makes the run untrustworthy") {
    std::string points;
    for (int k = 0; k <= 100; ++k) points += fmt::format("[{}, {}], ", k * 0.05, k % 2 == 0 ? 0 : 1e-4);
    points += "[5.3, 0], [5.3005, 2000], [5.301, 0], [100, 0]";
    const std::string scene = temporary(
        "long.toml",
        on_line("initial = 1, rate = 1", "f = { arguments = [\"x\"], points = [" + points + "] }", "f(x)"));
    const Json motion = simulated(scene, {"--duration", "10"});
    const bool is_right = std::abs(rate(motion) - std::sqrt(3.0)) < 1e-2;
    CHECK((is_right || motion["error_estimate"]["trustworthy"] == false));
    // Over the time, with steps of a fixed length: told; with a method that chooses them: right.
    std::string over_time;
    for (int k = 0; k <= 100; ++k) over_time += fmt::format("[{}, {}], ", k * 0.05, k % 2 == 0 ? 0 : 1e-4);
    over_time += "[5.33, 0], [5.3305, 2000], [5.331, 0], [100, 0]";
    const std::string pulse = temporary(
        "pulse.toml", on_line("initial = 1", "f = { arguments = [\"t\"], points = [" + over_time + "] }", "f(t)"));
    CHECK(std::abs(rate(simulated(pulse, {"--duration", "10"})) - (1 + 50 * 0.05 * 1e-4)) < 1e-8);
    const Json fixed = simulated(pulse, {"--duration", "10", "--method", "rk4", "--step", "0.1"});
    CHECK(std::abs(rate(fixed) - 1) > 0.1);
    REQUIRE(fixed["error_estimate"]["trustworthy"] == false);
    CHECK(fixed["error_estimate"]["reasons"].dump().find("passes a feature of the table 'f' near 5.33") !=
          std::string::npos);
}

// u rises by 1.2 a second there: ∫ exp(−((u − a)/w)²)/w dt = √π/1.2.
TEST_CASE("table knots: a quick function of a long table over the time is not passed over") {
    std::string points;
    for (int k = 0; k <= 100; ++k)
        points += fmt::format("{}[{}, {}]", k > 0 ? ", " : "", k / 10.0, k / 10.0 + 0.02 * (k % 2));
    const std::string scene =
        temporary("bell.toml", on_line("initial = 0", "u = { arguments = [\"t\"], points = [" + points + "] }",
                                       "exp(-((u(t) - 2.015)/1e-5)^2)/1e-5"));
    CHECK(std::abs(rate(simulated(scene, {"--duration", "10"})) - std::sqrt(std::numbers::pi) / 1.2) < 1e-8);
}

TEST_CASE("table knots: a knot is told as one") {
    const std::string scene =
        temporary("told.toml", on_line("initial = -1, rate = 1",
                                       "f = { arguments = [\"x\"], points = [[-9, 0], [0, 0], [9, 1]] }", "f(x)"));
    const Json motion = simulated(scene, {"--duration", "2"});
    REQUIRE(motion["switches"].size() == 1);
    CHECK(motion["switches"][0]["event"] == "knot");
    const Run text = run({"simulate", scene, "--duration", "2"});
    CHECK(text.out.find("f(x) passes a knot") != std::string::npos);
}

TEST_CASE("table knots: tables whose names are alike in code keep their own numbers") {
    struct Names {
        const char *tables, *load;
        double value;  // of the load at x = 0.5
    };
    const std::string square = "interpolation = \"cubic\", points = [[-5, 25], [0, 0], [1, 3], [5, 25]]";
    for (const Names& one :
         {Names{"f = {{ arguments = [\"x\"], {} }}\nf_1 = {{ arguments = [\"x\"], points = [[-5, 100], [0, 100], "
                "[1, "
                "300], [5, 100]] }}",
                "diff(f(x), x) + f_1(x)", 200},
          Names{
              "f = {{ arguments = [\"x\"], {} }}\nf_c = {{ arguments = [\"x\"], points = [[-5, 100], [5, 100]] }}",
              "diff(f(x), x) + f_c(x)", 100},
          Names{
              "phi = {{ arguments = [\"x\"], {} }}\n\"φ\" = {{ arguments = [\"x\"], points = [[-5, 7], [5, 7]] }}",
              "diff(phi(x), x) + φ(x)", 7}}) {
        const std::string tables = fmt::format(fmt::runtime(one.tables), square);
        const std::string scene = temporary(
            "alike.toml",
            on_line("initial = 0.5", tables, one.load, "[outputs]\nslope = \"" + std::string(one.load) + "\"\n"));
        INFO(tables);
        const Json here = json_of({"eval", scene});
        const double a = number(here, "accelerations", "x");
        CHECK(std::abs(a - one.value) > 0.5);  // the slope of the first table counts
        const Json memory = simulated(scene, {"--duration", "0.05", "--tolerance", "1e-12"}),
                   compiled =
                       simulated(scene, {"--duration", "0.05", "--tolerance", "1e-12", "--code", "compiled"});
        CHECK(std::abs(rate(memory) - rate(compiled)) < 1e-10 * std::abs(rate(memory)));
        const std::string folder = temporary_folder("alike");
        const Run c = run_shell(
            "cd \"$2\" && \"$ALEMBERT\" emit \"$1\" --language c -o . >/dev/null && printf '%s' '"
            "#include \"alike.h\"\n#include <stdio.h>\nint main(void) { double par[alike_par + 1], y[] = {0.5, "
            "0}, "
            "r[2]; alike_defaults(par); alike_rhs(0, y, par, r); printf(\"%.17g\", r[1]); return 0; }' > c.c && "
            "cc -std=c99 -O1 c.c alike.c -lm -o c && ./c",
            {scene, folder});
        INFO(c.err);
        REQUIRE(c.exit == 0);
        CHECK(std::abs(std::stod(c.out) - a) < 1e-12 * std::abs(a));
        const Run js = run_shell(
            "cd \"$2\" && \"$ALEMBERT\" emit \"$1\" --language js -o . >/dev/null && node -e "
            "\"import('./alike.mjs').then(m => { const r = [0, 0]; m.rhs(0, [0.5, 0], m.defaults(), r); "
            "console.log(r[1]) })\"",
            {scene, folder});
        INFO(js.err);
        REQUIRE(js.exit == 0);
        CHECK(std::abs(std::stod(js.out) - a) < 1e-12 * std::abs(a));
    }
}

TEST_CASE("table knots: a program of its own ends where a table or a root does") {
    for (const char* const load : {"0.001*f(x)", "0.001*f(t)", "0.001*sqrt(3.05 - x)"}) {
        const std::string scene =
            temporary("ends.toml", on_line("initial = 0, rate = 1",
                                           "f = { arguments = [\"x\"], points = [[-1, 0], [2, 1], [3.05, 1]] }",
                                           load, "[simulation]\nduration = 10\n"));
        for (const char* const language : {"cpp", "c"}) {
            const Run made = run_shell(
                "cd \"$2\" && \"$ALEMBERT\" emit \"$1\" --standalone --language \"$3\" -o . >/dev/null 2>&1 && "
                "if [ \"$3\" = c ]; then cc -O1 ends_main.c ends.c -lm -o ends; "
                "else c++ -std=c++20 -O1 ends_main.cpp -o ends; fi && timeout 60 ./ends >/dev/null",
                {scene, temporary_folder("ends"), language});
            INFO(load, " ", language, " ", made.err);
            CHECK(made.exit == 4);
            CHECK(made.err.find("the accelerations are no numbers") != std::string::npos);
        }
    }
}

TEST_CASE("table knots: a mass that is used up or falls below zero ends the run, and is named") {
    const auto failed = [](const std::string& text) {
        const Run result = run({"simulate", temporary("mass.toml", text), "--duration", "20"});
        CHECK(result.exit == 4);
        return result.err;
    };
    const std::string rocket =
        "[coordinates]\nh = 0\n[[particle]]\nname = \"rocket\"\nposition = [0, \"h\"]\nleaves = [0, -2500]\n";
    const std::string used = failed(rocket + "mass = \"100 - 8*t\"\n");
    CHECK(used.find("the mass of particle rocket is") != std::string::npos);
    const std::string state = failed("[states]\nM = { rate = -8, initial = 10 }\n" + rocket + "mass = \"M\"\n");
    CHECK(state.find("the mass of particle rocket is") != std::string::npos);
    // Carried by something heavy, it falls on without any singularity.
    const std::string carried = failed(
        rocket + "mass = \"10 - 4*t\"\n[[particle]]\nname = \"cart\"\nmass = 1000\nposition = [0, \"h\"]\n");
    CHECK(carried.find("the mass of particle rocket is -") != std::string::npos);
    CHECK(carried.find("expected zero or more") != std::string::npos);
}

TEST_CASE("table knots: rounding is measured against the terms, and only where tables are") {
    const std::string light =
        "[parameters]\nm = 1e-12\nk = 3e-12\n[coordinates]\nx = 0\n[tables]\nu = { arguments = [\"t\"], outside = "
        "\"hold\", points = [[0, 0], [5, 1]] }\n[[particle]]\nname = \"p\"\nmass = \"m\"\nposition = [\"x\", 0]\n"
        "[[spring]]\nalong = \"x\"\nstiffness = \"k\"\n[outputs]\no = \"u(t)\"\n";
    const Json claims = json_of({"check", temporary("light.toml", light + R"toml(
[[claim]]
equation = "m*x'' = -k*x + 1e-11*u(t)"
[[claim]]
equation = "1e-12*x'' = 3e-12*x"
[[claim]]
equation = "1e-12*x'' = -3.0000001e-12*x"
)toml")},
                                {}, 1)["claims"];
    for (const Json& claim : claims) CHECK(claim["verdict"] == "refuted");
    const std::string heavy = on_line(
        "initial = 0.5",
        "f = { arguments = [\"x\"], points = [[0, 100000.1], [2, 400000.4]], outside = \"line\" }", "f(x)",
        "[[claim]]\nequation = \"f(1) = 250000.25\"\n[[claim]]\nequation = \"x'' = 100000.1 + 150000.15*x\"\n"
        "[[claim]]\nequation = \"f(1) = 250000.2501\"\n");
    const Json of_heavy = Json::parse(run({"check", temporary("heavy.toml", heavy), "--json"}).out)["claims"];
    CHECK(of_heavy[0]["verdict"] == "undecided");
    CHECK(of_heavy[1]["verdict"] == "undecided");
    CHECK(of_heavy[2]["verdict"] == "refuted");
}

TEST_CASE("knots: derivatives along a motion go through corners of a table, at which accelerations jump") {
    const auto scene = [](const std::string& interpolation, const std::string& argument,
                          const std::string& place) {
        return temporary("corner.toml",
                         fmt::format(R"toml(
[parameters]
a = 1
[tables]
f = {{ arguments = ["x"], interpolation = "{}", outside = "line", points = [[-2, 1], [-1, 0], [0, 2], [1, 0], [2, 3]] }}
[coordinates]
x = {{ initial = 0.5, rate = 1 }}
[energy]
kinetic = "x'^2/2"
potential = "2*x^2{}"
[forces]
x = "a{}"
[simulation]
duration = 2
)toml",
                                     interpolation, place == "energy" ? " + f(" + argument + ")" : "",
                                     place == "energy" ? "" : " + f(" + argument + ")"));
    };
    const auto refused = [&](const std::string& file, std::vector<std::string> more) {
        std::vector<std::string> words{more[0], file};
        words.insert(words.end(), more.begin() + 1, more.end());
        const auto result = run(words);
        CHECK(result.exit == (result.err.find("corner") != std::string::npos ? 3 : 0));
        return result.exit == 3;
    };
    const std::vector<std::string> sensitivity{"simulate", "--sensitivity", "a"},
        exponents{"stability", "--exponents", "1", "--duration", "20"};
    for (const auto& ask : {sensitivity, exponents}) {
        CHECK_FALSE(refused(scene("linear", "x", "energy"), ask));
        CHECK_FALSE(refused(scene("linear", "x", "forces"), ask));
        CHECK_FALSE(refused(scene("cubic", "x", "energy"), ask));
        CHECK_FALSE(refused(scene("pchip", "x", "energy"), ask));
    }
    const auto end_at = [&](double a) {
        const auto result = run({"simulate", scene("linear", "x", "energy"), "--at", fmt::format("a={:.9f}", a),
                                 "--json", "--tolerance", "1e-12"});
        return number(Json::parse(result.out)["final"], "coordinates", "x");
    };
    const Json by_a = Json::parse(
        run({"simulate", scene("linear", "x", "energy"), "--sensitivity", "a", "--json", "--tolerance", "1e-11"})
            .out);
    CHECK(by_a["sensitivity"]["values"][0][0].get<double>() ==
          doctest::Approx((end_at(1 + 1e-5) - end_at(1 - 1e-5)) / 2e-5).epsilon(1e-6));
}

TEST_CASE("knots: a table in a reaction alone leaves the choice of the method to the program") {
    const auto result = run({"simulate", temporary("reaction.toml", R"toml(
[tables]
f = { arguments = ["x"], points = [[-1, -1], [0.2, -1], [0.3, 1], [1, 1]] }
[coordinates]
x = { initial = 0, rate = 1 }
y = 0
[energy]
kinetic = "x'^2/2 + y'^2/2"
potential = "2.7^2*x^2/2"
[forces]
y = "f(x)"
[[constraint]]
name = "w"
holonomic = "y"
[simulation]
duration = 6
)toml")});
    CHECK_MESSAGE(result.exit == 0, result.err);
}

TEST_CASE("tables: steps of sweeps end at knots, those of a fixed length too") {
    const std::string scene = temporary(
        "bump.toml",
        on_line(
            "initial = 0, rate = 5",
            "a = { arguments = [\"x\"], outside = \"hold\", points = [[-10,0],[0.45,0],[0.7,8],[0.95,0],[10,0]] "
            "}\nb = { arguments = [\"x'\"], points = [[-9,-3],[0,0],[1,2],[2,1],[9,4]] }",
            "-3*x - a(x) - b(x')", "[simulation]\nduration = 2\n"));
    for (const std::vector<std::string>& steps :
         {std::vector<std::string>{"--method", "rk4", "--step", "0.05"}, {"--tolerance", "1e-10"}}) {
        std::vector<std::string> one{"simulate", scene, "--json"},
            all{"sweep", scene, "--vary", "t=0:0:1", "-o", "/dev/stdout"};
        one.insert(one.end(), steps.begin(), steps.end());
        all.insert(all.end(), steps.begin(), steps.end());
        const double x = number(Json::parse(run(one).out)["final"], "coordinates", "x");
        const std::string table = run(all).out;
        CAPTURE(table);
        CHECK(table.find(fmt::format("{:.17g}", x)) != std::string::npos);
    }
}

}  // namespace commands_table_knots
