// SPDX-License-Identifier: MIT
// The time of one right-hand side of an emitted solver, against a floor: rhs.sh says how it is called.
//
//   bench_rhs [--json FILE] FOLDER INFO SOURCE.cpp [INFO SOURCE.cpp …]      INFO: what `emit --json` printed
//
// Thread CPU time of many short slices, the floor's and ours in turn, each after a third of a slice that is not
// timed; the median of each. A slice walks through 64 states with |q| ≤ π; each is perturbed by its own previous
// answer, so that no evaluation can be left out, and none waits for the one before. The floor is n calls of
// glibc's sincos on the same angles in the same loop. Accelerations at a reference state (50 digits:
// FOLDER/reference/chains.json, FOLDER/bench/systems/) give `error`, relative to the largest. A rival (rivals.hpp)
// is timed in the same turns once its accelerations at all 64 states are ours to 1e-9; so is the function of the
// system's name in FOLDER/bench/by_hand.cpp, where there is one.
#include <fmt/format.h>
#include <math.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "alembert/native/compilation.hpp"
#include "alembert/native/module.hpp"
#include "pack.hpp"
#include "rivals.hpp"

using namespace alembert;
using Json = nlohmann::ordered_json;

namespace {

constexpr int states = 64, slices = 400;
constexpr double slice_ns = 1e5, feedback = 1e-9, agreement = 1e-9;
constexpr double time_step = 0.37;  // from one of the 64 states to the next, for what depends on time

double now_ns() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

std::string text_of(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// Median time of one call for each of the walks, which take turns. A walk makes `states` calls.
std::vector<double> timed(const std::vector<std::function<void()>>& walks) {
    std::vector<int> repeats;
    for (const auto& walk : walks) {
        walk();
        const double start = now_ns();
        for (int k = 0; k < 5; ++k) walk();
        repeats.push_back(std::max(1, static_cast<int>(slice_ns / std::max(1.0, (now_ns() - start) / 5))));
    }
    std::vector<std::vector<double>> times(walks.size());
    for (int slice = 0; slice < slices; ++slice)
        for (std::size_t which = 0; which < walks.size(); ++which) {
            for (int k = 0; k < (repeats[which] + 2) / 3; ++k)
                walks[which]();  // not timed: caches, and the clock that wide vectors take
            const double start = now_ns();
            for (int k = 0; k < repeats[which]; ++k) walks[which]();
            times[which].push_back((now_ns() - start) / repeats[which] / states);
        }
    std::vector<double> result;
    for (const std::vector<double>& t : times) result.push_back(median(t));
    return result;
}

/// 64 states: where they start, and the last answer to each.
struct Walkers {
    Walkers(int n, int s, unsigned seed)
        : width(n + s), base(states * width), answer(states * width, 0.0), state(width) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> turn(-M_PI, M_PI), rate(-1, 1);
        for (int k = 0; k < states; ++k)
            for (int i = 0; i < width; ++i) base[k * width + i] = i < n ? turn(random) : rate(random);
    }
    const double* perturbed(int k, int count) {
        for (int i = 0; i < count; ++i) state[i] = base[k * width + i] + feedback * answer[k * width + i];
        return state.data();
    }
    int width;
    std::vector<double> base, answer, state;
};

/// The largest error of an acceleration, relative to the largest acceleration.
double error_of(const alembert_solver_table& table, const Module& module, const Json& reference) {
    const int n = table.coordinates;
    std::vector<double> values(table.parameter_values, table.parameter_values + table.parameters), state,
        rate(2 * n);
    for (const char* key : {"q", "qd"})
        for (const double x : reference.at(key)) state.push_back(x);
    for (int i = 0; i < n; ++i)  // the torques are parameters, or the scene's own numbers
        for (int k = 0; k < table.parameters; ++k)
            if (table.parameter_names[k] == fmt::format("tau{}", i + 1)) values[k] = reference.at("tau")[i];
    const std::vector<double> par = prepared(module, values);
    table.rhs(0, state.data(), par.data(), rate.data());
    double worst = 0, largest = 0;
    for (int i = 0; i < n; ++i) {
        const double expected = reference.at("qdd")[i];
        worst = std::max(worst, std::abs(rate[n + i] - expected));
        largest = std::max(largest, std::abs(expected));
    }
    return worst / largest;
}

using Accelerations = std::function<void(double t, const double* state, double* accelerations)>;
using ByHand = void (*)(double t, const double* state, double* rate);

/// The states and accelerations of a rival are ours? (Those where the accelerations are larger are weaker by
/// rounding.)
void compare(const std::string& rival, const Accelerations& accelerations, const std::string& system,
             const alembert_solver_table& table, const std::vector<double>& par, Walkers& walkers) {
    const int n = table.coordinates;
    std::vector<double> rate(2 * n), theirs(n);
    double worst = 0;
    for (int k = 0; k < states; ++k) {
        const double* state = walkers.perturbed(k, 2 * n);
        table.rhs(k * time_step, state, par.data(), rate.data());
        accelerations(k * time_step, state, theirs.data());
        double difference = 0, largest = 0;
        for (int i = 0; i < n; ++i) {
            difference = std::max(difference, std::abs(theirs[i] - rate[n + i]));
            largest = std::max(largest, std::abs(rate[n + i]));
        }
        worst = std::max(worst, difference / largest);
    }
    if (!(worst < agreement))
        throw std::runtime_error(
            fmt::format("{}: accelerations of {} are not ours: {:.1e} apart, expected less than {:.0e}", rival,
                        system, worst, agreement));
}

Json reference_of(const std::string& folder, const std::string& name) {
    const Json chains = Json::parse(text_of(folder + "/reference/chains.json"));
    if (chains.contains(name)) return chains.at(name);
    const std::string system = folder + "/bench/systems/" + name + ".json";
    return std::filesystem::exists(system) ? Json::parse(text_of(system)).at("ref") : Json(nullptr);
}

Json measured(const Json& info, const std::string& source, const std::string& folder) {
    const std::string name = std::filesystem::path(source).stem().string();
    const Compilation compiled = compile(text_of(source), name, {});
    const Module module = load(compiled.object);
    const alembert_solver_table& table = module.table();
    const int n = table.coordinates, s = table.speeds;
    const std::vector<double> par = prepared(module);

    Walkers ours(n, s, 1), floor(n, s, 1);
    std::vector<std::function<void()>> walks;
    walks.emplace_back([&] {
        for (int k = 0; k < states; ++k) {
            const double* angle = floor.perturbed(k, n);
            for (int i = 0; i < n; ++i) {
                double sine, cosine;
                sincos(angle[i], &sine, &cosine);
                floor.answer[k * floor.width + i] = sine + cosine;
            }
        }
    });
    walks.emplace_back([&] {
        for (int k = 0; k < states; ++k)
            table.rhs(k * time_step, ours.perturbed(k, n + s), par.data(), &ours.answer[k * ours.width]);
    });
    std::optional<PackWalk> packs;  // where it was emitted with --batch
    if (module.pack() != nullptr) packs.emplace(module, states, ours.base, feedback);
    walks.emplace_back([&] {
        if (packs) (*packs)();
    });

    const std::optional<bench::Tree> tree = bench::tree_of(name, folder + "/bench/systems");
    const std::vector<bench::Rival> rivals = tree ? bench::rivals_of(*tree) : std::vector<bench::Rival>();
    std::vector<Walkers> theirs(rivals.size(), Walkers(n, s, 1));
    for (std::size_t r = 0; r < rivals.size(); ++r) {
        const auto accelerations = [&rival = rivals[r], n](double, const double* state, double* a) {
            rival.accelerations(state, state + n, a);
        };
        compare(rivals[r].name, accelerations, name, table, par, theirs[r]);
        walks.emplace_back([&walkers = theirs[r], &accelerations = rivals[r].accelerations, n, s] {
            for (int k = 0; k < states; ++k) {
                const double* state = walkers.perturbed(k, n + s);
                accelerations(state, state + n, &walkers.answer[k * walkers.width + n]);
            }
        });
    }
    const ObjectFile hand(compile(text_of(folder + "/bench/by_hand.cpp"), "by_hand", {}).object);
    const auto by_hand = reinterpret_cast<ByHand>(hand.find(name.c_str()));
    Walkers hands(n, s, 1);
    if (by_hand != nullptr) {
        const auto accelerations = [by_hand, n](double t, const double* state, double* a) {
            std::vector<double> rate(2 * n);
            by_hand(t, state, rate.data());
            std::copy_n(&rate[n], n, a);
        };
        compare("by hand", accelerations, name, table, par, hands);
        walks.emplace_back([&] {
            for (int k = 0; k < states; ++k)
                by_hand(k * time_step, hands.perturbed(k, n + s), &hands.answer[k * hands.width]);
        });
    }
    const std::vector<double> ns = timed(walks);
    const Json reference = reference_of(folder, name);
    Json row;
    row["system"] = name;
    row["floor_ns"] = ns[0];
    row["ours_ns"] = ns[1];
    row["ours_pack_ns"] = packs ? Json(ns[2]) : Json(nullptr);
    row["formulation"] = info.at("formulation");
    row["operations"] = info.at("operations");
    row["error"] = reference.is_null() ? Json(nullptr) : Json(error_of(table, module, reference));
    row["compile_s"] = compiled.from_cache ? Json(nullptr) : Json(compiled.seconds);
    row["rivals"] = Json::object();
    for (std::size_t r = 0; r < rivals.size(); ++r) row["rivals"][rivals[r].name] = ns[3 + r];
    if (by_hand != nullptr) row["rivals"]["by hand"] = ns.back();
    return row;
}

std::string cell(const Json& value, const char* format) {
    return value.is_null() ? "-" : fmt::format(fmt::runtime(format), value.get<double>());
}

void print_rivals(const Json& rows) {
    std::vector<std::string> names;
    for (const Json& row : rows)
        for (const auto& item : row.at("rivals").items())
            if (std::find(names.begin(), names.end(), item.key()) == names.end()) names.push_back(item.key());
    if (names.empty()) return;
    fmt::print("\n{:<16} {:>9}", "floors", "ours");
    for (const std::string& name : names) fmt::print(" {:>9}", name);
    fmt::print("\n");
    for (const Json& row : rows) {
        if (row.at("rivals").empty()) continue;
        const double floor = row.at("floor_ns");
        fmt::print("{:<16} {:>9.2f}", row.at("system").get<std::string>(),
                   row.at("ours_ns").get<double>() / floor);
        for (const std::string& name : names) {
            const auto rival = row.at("rivals").find(name);
            fmt::print(" {:>9}", rival == row.at("rivals").end()
                                     ? "-"
                                     : fmt::format("{:.2f}", rival->get<double>() / floor));
        }
        fmt::print("\n");
    }
}

}  // namespace

int main(int argc, char** argv) try {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    std::string file;
    if (arguments.size() > 1 && arguments[0] == "--json") {
        file = arguments[1];
        arguments.erase(arguments.begin(), arguments.begin() + 2);
    }
    const std::string folder = arguments.at(0);
    Json rows = Json::array();
    fmt::print("{:<16} {:>9} {:>9} {:>7} {:>9} {:>7} {:>10} {:>9} {:>10}   {}\n", "system", "floor ns", "ours ns",
               "floors", "pack ns", "floors", "operations", "error", "compile s", "formulation");
    for (std::size_t k = 1; k + 1 < arguments.size(); k += 2) {
        const Json row = measured(Json::parse(text_of(arguments[k])), arguments[k + 1], folder);
        const double floor = row["floor_ns"], ours = row["ours_ns"];
        const Json& pack = row["ours_pack_ns"];
        fmt::print("{:<16} {:>9.1f} {:>9.1f} {:>7.2f} {:>9} {:>7} {:>10} {:>9} {:>10}   {}\n",
                   row["system"].get<std::string>(), floor, ours, ours / floor, cell(pack, "{:.1f}"),
                   pack.is_null() ? "-" : fmt::format("{:.2f}", pack.get<double>() / floor),
                   row["operations"].get<int>(), cell(row["error"], "{:.1e}"), cell(row["compile_s"], "{:.2f}"),
                   row["formulation"].get<std::string>());
        rows.push_back(row);
    }
    print_rivals(rows);
    if (!file.empty()) std::ofstream(file) << rows.dump(2) << "\n";
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
