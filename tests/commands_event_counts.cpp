// SPDX-License-Identifier: MIT
// Events that turn many times within a step, or that are nothing but a narrow pulse: all of their zeros are found.
// The zeros are counted independently on a fine grid along the closed form of the motion (for a pendulum, along a
// motion by Runge and Kutta's classical method in 400,000 steps).
#include <cmath>
#include <functional>
#include <random>

#include "contacts.hpp"
#include "tools.hpp"

namespace commands_event_counts {

using namespace alembert::test;

namespace {

using Motion = std::vector<std::array<double, 3>>;  // t, x, x'
constexpr double duration = 8;
constexpr std::size_t fine = 400'000;

struct Guard {
    std::string text;
    std::function<double(double t, double x, double v)> value;
};

struct Random {
    std::mt19937_64 engine;
    double operator()(double low, double high) {  // a number of four digits, so that the scene has the same one
        const double x = std::uniform_real_distribution<>(low, high)(engine);
        return std::stod(fmt::format("{:.4g}", x));
    }
    int of(int count) { return static_cast<int>(engine() % static_cast<std::uint64_t>(count)); }
};

Guard wave(Random& random) {
    const double k = random(1, 200), c = random(-0.9, 0.9);
    switch (random.of(8)) {
        case 0:
            return {fmt::format("sin({}*x)", k), [=](double, double x, double) { return std::sin(k * x); }};
        case 1:
            return {fmt::format("cos({}*x) + ({})", k, c),
                    [=](double, double x, double) { return std::cos(k * x) + c; }};
        case 2:
            return {fmt::format("sin({}*x) + x", k),
                    [=](double, double x, double) { return std::sin(k * x) + x; }};
        case 3:
            return {fmt::format("abs(sin({}*x)) - 0.5", k),
                    [=](double, double x, double) { return std::abs(std::sin(k * x)) - 0.5; }};
        case 4:
            return {fmt::format("sin({}*x')", k), [=](double, double, double v) { return std::sin(k * v); }};
        case 5:
            return {fmt::format("cos({}*sin(3*x))", k),
                    [=](double, double x, double) { return std::cos(k * std::sin(3 * x)); }};
        case 6:
            return {fmt::format("sin({}*t)*cos(x)", k),
                    [=](double t, double x, double) { return std::sin(k * t) * std::cos(x); }};
        default:
            return {fmt::format("sin({}*x*x' + 0.2)", k),
                    [=](double, double x, double v) { return std::sin(k * x * v + 0.2); }};
    }
}

Guard pulse(Random& random) {
    const double a = random(-1, 1), w = std::stod(fmt::format("{:.3g}", std::pow(10, random(-3, -0.5))));
    switch (random.of(3)) {
        case 0:
            return {fmt::format("exp(-((x - ({}))/{})^2) - 0.5", a, w),
                    [=](double, double x, double) { return std::exp(-std::pow((x - a) / w, 2)) - 0.5; }};
        case 1:
            return {fmt::format("1/(1 + (sin(2*x)/{})^2) - 0.3", w),
                    [=](double, double x, double) { return 1 / (1 + std::pow(std::sin(2 * x) / w, 2)) - 0.3; }};
        default:
            return {fmt::format("tanh((x - ({0}))/{1}) - tanh((x - ({0}))/{1} - 3) - 0.5", a, w),
                    [=](double, double x, double) {
                        return std::tanh((x - a) / w) - std::tanh((x - a) / w - 3) - 0.5;
                    }};
    }
}

/// The loads of a random motion as TOML, with the motion.
std::pair<std::string, Motion> motion(Random& random, double x0, double v0) {
    Motion result;
    const auto tabulate = [&](const auto& at) {
        for (std::size_t i = 0; i <= fine; ++i) {
            const double t = duration * static_cast<double>(i) / fine;
            const auto [x, v] = at(t);
            result.push_back({t, x, v});
        }
    };
    switch (random.of(4)) {
        case 0:
            tabulate([&](double t) { return std::pair(x0 + v0 * t, v0); });
            return {"", result};
        case 1: {
            const double K = random(0.3, 9), w = std::sqrt(K);
            tabulate([&](double t) {
                return std::pair(x0 * std::cos(w * t) + v0 / w * std::sin(w * t),
                                 v0 * std::cos(w * t) - w * x0 * std::sin(w * t));
            });
            return {fmt::format("[forces]\nx = \"-{}*x\"\n", K), result};
        }
        case 2: {
            const double a = random(-0.5, 0.5);
            tabulate([&](double t) { return std::pair(x0 + v0 * t + a * t * t / 2, v0 + a * t); });
            return {fmt::format("[forces]\nx = \"{}\"\n", a), result};
        }
        default: {
            const double h = duration / fine;
            double x = x0, v = v0;
            for (std::size_t i = 0; i <= fine; ++i) {  // Runge and Kutta's classical method
                result.push_back({duration * static_cast<double>(i) / fine, x, v});
                const auto f = [](double q) { return -4 * std::sin(q); };
                const double k1 = f(x), k2 = f(x + h / 2 * v), k3 = f(x + h / 2 * v + h * h / 4 * k1),
                             k4 = f(x + h * v + h * h / 2 * k2);
                x += h * v + h * h / 6 * (k1 + k2 + k3);
                v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
            }
            return {"[forces]\nx = \"-4*sin(x)\"\n", result};
        }
    }
}

/// The number of zeros; nothing where one is so near to an end or to a turning point that rounding may decide.
std::optional<std::size_t> count(const Guard& guard, const Motion& motion) {
    std::vector<double> g;
    for (const auto& [t, x, v] : motion) g.push_back(guard.value(t, x, v));
    std::size_t zeros = 0;
    for (std::size_t i = 1; i < g.size(); ++i) {
        if (g[i] * g[i - 1] <= 0) ++zeros;
        if (i + 1 < g.size() && (g[i] - g[i - 1]) * (g[i + 1] - g[i]) <= 0 && std::abs(g[i]) < 1e-5)
            return std::nullopt;
    }
    if (std::abs(g.front()) < 1e-6 || std::abs(g.back()) < 1e-6) return std::nullopt;
    return zeros;
}

/// Simulates `wanted` random scenes, each with the next method.
void check_counts(std::uint64_t seed, int wanted, Guard (*guard_of)(Random&)) {
    const std::vector<std::vector<std::string>> methods = {
        {"--method", "auto"},  {"--method", "taylor"},   {"--method", "dop853"},
        {"--method", "radau"}, {"--method", "verner98"}, {"--method", "rk4", "--step", "0.02"}};
    Random random{std::mt19937_64(seed)};
    for (int done = 0; done < wanted;) {
        const Guard guard = guard_of(random);
        const double x0 = random(-1, 1), v0 = random(0.3, 2) * (random.of(2) == 0 ? 1 : -1);
        const auto [loads, along] = motion(random, x0, v0);
        const std::optional<std::size_t> zeros = count(guard, along);
        if (!zeros) continue;
        const std::string text = fmt::format(
            "[coordinates]\nx = {{ initial = {}, rate = {} }}\n[[particle]]\n"
            "name = \"P\"\nmass = 1\nposition = [\"x\", 0]\n{}[[event]]\n"
            "name = \"e\"\nwhen = \"{}\"\n[simulation]\nduration = {}\n",
            x0, v0, loads, guard.text, duration);
        std::vector<std::string> more = {"--no-estimate"};
        const auto& method = methods[static_cast<std::size_t>(done) % methods.size()];
        more.insert(more.end(), method.begin(), method.end());
        CAPTURE(seed);
        CAPTURE(text);
        CAPTURE(method[1]);
        CHECK(simulated(temporary("counted.toml", text), more)["events"].size() == *zeros);
        ++done;
    }
}

}  // namespace

TEST_CASE("events: all zeros of waves in the state are found, however many a step holds") {
    check_counts(4301, 60, wave);
}

TEST_CASE("events: all zeros of narrow pulses in the state are found, however much wider a step is") {
    check_counts(4302, 42, pulse);
}

// x = A cos t passes π k/20 once on each way from A to −A and back, for each |k| < 20 A/π.
TEST_CASE("events: all zeros of sin(20*x) along an oscillation, by every method") {
    for (const double A : {1.0, 1.7, 3.25})
        for (const double end : {5.5, 20.0}) {
            std::size_t zeros = 0;
            for (int k = -static_cast<int>(20 * A / M_PI); k <= static_cast<int>(20 * A / M_PI); ++k)
                for (double turn = 0; turn <= end; turn += 2 * M_PI)
                    for (const double t :
                         {std::acos(M_PI * k / (20 * A)), 2 * M_PI - std::acos(M_PI * k / (20 * A))})
                        zeros += turn + t < end ? 1 : 0;
            const std::string scene = temporary(
                "oscillation.toml",
                fmt::format("[coordinates]\nx = {}\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", 0]\n"
                            "[forces]\nx = \"-x\"\n[[event]]\nname = \"e\"\nwhen = \"sin(20*x)\"\n[simulation]\n"
                            "duration = {}\n",
                            A, end));
            for (const char* const method :
                 {"auto", "taylor", "dop853", "dopri5", "verner76", "verner98", "rkn86", "rkn1210", "abm", "bdf",
                  "radau", "rk4", "gauss", "verlet", "kahanli8", "euler"}) {
                CAPTURE(A);
                CAPTURE(end);
                CAPTURE(method);
                const std::string name = method;
                std::vector<std::string> options{"--no-estimate", "--method", name};
                if (name == "rk4" || name == "gauss" || name == "verlet" || name == "kahanli8" || name == "euler")
                    options.insert(options.end(),
                                   {"--step", name == "euler" || name == "verlet" ? "1e-4" : "0.05"});
                CHECK(simulated(scene, options)["events"].size() == zeros);
            }
        }
}

// cos(4 x) rises through zero where 4 x = 3π/2 + 2π k; each kick leaves 0.99 of the speed.
TEST_CASE("kicks: a free particle is kicked at each of eight zeros that one step holds, in sweep as in simulate") {
    const std::string scene = temporary("kicked.toml", R"toml(
[coordinates]
x = { initial = -0.026, rate = 1.32 }
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[[event]]
name = "e"
when = "cos(4*x)"
direction = "up"
impulses = { x = "-0.01*x'" }
[simulation]
duration = 10
)toml");
    double t = 0, x = -0.026, v = 1.32;
    int kicks = 0;
    for (double next = 3 * M_PI / 8; t + (next - x) / v < 10; next += M_PI / 2, ++kicks) {
        t += (next - x) / v;
        x = next;
        v *= 0.99;
    }
    const double end = x + v * (10 - t);
    REQUIRE(kicks == 8);
    for (const char* method : {"auto", "taylor", "dop853", "radau", "verner98"}) {
        const Json motion = simulated(scene, {"--method", method});
        CHECK(motion["events"].size() == 8);
        CHECK(std::abs(motion["final"]["coordinates"]["x"].get<double>() - end) < 1e-12 * end);
        const auto swept = run({"sweep", scene, "--vary", "x=-0.026:0:2", "--method", method});
        REQUIRE(swept.exit == 0);
        const std::string row = swept.out.substr(swept.out.find('\n') + 1);
        CHECK(std::abs(std::stod(row.substr(row.find(',', row.find(',') + 1) + 1)) - end) < 1e-12 * end);
    }
}

// The spike is 0.002 wide and is reached at t = 5 − 0.001 √(ln 2).
TEST_CASE("events: sweep ends motions at a spike that is narrower than a thousandth of a step") {
    const std::string scene = temporary("spike.toml", R"toml(
[coordinates]
x = { initial = 0, rate = 1 }
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[[event]]
name = "e"
when = "exp(-((x - 5)/0.001)^2) - 0.5"
stop = true
[simulation]
duration = 10
)toml");
    for (const char* method : {"auto", "taylor", "dop853", "radau"}) {
        const auto swept = run({"sweep", scene, "--vary", "x=0:0.5:3", "--method", method});
        REQUIRE(swept.exit == 0);
        std::istringstream rows(swept.out);
        std::string line;
        std::getline(rows, line);
        for (const double start : {0.0, 0.25, 0.5}) {
            std::getline(rows, line);
            const double end = std::stod(line.substr(line.find(',') + 1));
            CHECK(std::abs(end - (5 - start - 0.001 * std::sqrt(std::log(2.0)))) < 1e-11);
        }
    }
}

}  // namespace commands_event_counts
