// SPDX-License-Identifier: MIT
// The time of one right-hand side of an emitted solver, against a floor: rhs.sh says how it is called.
//
//   bench_rhs [--json FILE] REFERENCES INFO SOURCE.cpp [INFO SOURCE.cpp …]      INFO: what `emit --json` printed
//
// Thread CPU time of many short slices, the floor's and ours in turn; the median of each. A slice walks through 64 states
// with |q| ≤ π; each is perturbed by its own previous answer, so that no evaluation can be left out, and none waits for
// the one before. The floor is n calls of glibc's sincos on the same angles in the same loop.
// Accelerations at a reference state (tests/reference/chains.json, 50 digits) give `error`, relative to the largest.
#include <fmt/format.h>
#include <math.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "alembert/compile.hpp"
#include "alembert/module.hpp"
#include "pack.hpp"

using namespace alembert;
using Json = nlohmann::ordered_json;

namespace {

constexpr int states = 64, slices = 400;
constexpr double slice_ns = 1e5, feedback = 1e-9;

double now_ns() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

std::string text_of(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// Median time of one call for each of the walks, which take turns. A walk makes `states` calls.
template <typename... Walk>
std::vector<double> timed(Walk&&... walk) {
    const auto repeats_of = [](auto& w) {
        w();
        const double start = now_ns();
        for (int k = 0; k < 20; ++k) w();
        return std::max(1, static_cast<int>(slice_ns / ((now_ns() - start) / 20)));
    };
    const std::vector<int> repeats{repeats_of(walk)...};
    std::vector<std::vector<double>> times(sizeof...(walk));
    for (int slice = 0; slice < slices; ++slice) {
        std::size_t which = 0;
        const auto once = [&](auto& w) {
            const double start = now_ns();
            for (int k = 0; k < repeats[which]; ++k) w();
            times[which].push_back((now_ns() - start) / repeats[which] / states);
            ++which;
        };
        (once(walk), ...);
    }
    std::vector<double> result;
    for (const std::vector<double>& t : times) result.push_back(median(t));
    return result;
}

/// 64 states: where they start, and the last answer to each.
struct Walkers {
    Walkers(int n, int s, unsigned seed) : width(n + s), base(states * width), answer(states * width, 0.0), state(width) {
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
    std::vector<double> values(table.parameter_values, table.parameter_values + table.parameters), state, rate(2 * n);
    for (const char* key : {"q", "qd"})
        for (const double x : reference.at(key)) state.push_back(x);
    for (int i = 0; i < n; ++i) values[table.parameters - n + i] = reference.at("tau")[i];
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

Json measured(const Json& info, const std::string& source, const Json& references) {
    const std::string name = std::filesystem::path(source).stem().string();
    const Compiled compiled = compile(text_of(source), name, {});
    const Module module = load(compiled.object);
    const alembert_solver_table& table = module.table();
    const int n = table.coordinates, s = table.speeds;
    const std::vector<double> par = prepared(module);

    Walkers ours(n, s, 1), floor(n, s, 1);
    const auto walk_ours = [&] {
        for (int k = 0; k < states; ++k) table.rhs(0, ours.perturbed(k, n + s), par.data(), &ours.answer[k * ours.width]);
    };
    const auto walk_floor = [&] {
        for (int k = 0; k < states; ++k) {
            const double* angle = floor.perturbed(k, n);
            for (int i = 0; i < n; ++i) {
                double sine, cosine;
                sincos(angle[i], &sine, &cosine);
                floor.answer[k * floor.width + i] = sine + cosine;
            }
        }
    };
    PackWalk walk_packs(module, states, ours.base, feedback);
    const std::vector<double> ns = timed(walk_floor, walk_ours, walk_packs);
    Json row;
    row["system"] = name;
    row["floor_ns"] = ns[0];
    row["ours_ns"] = ns[1];
    row["ours_pack_ns"] = ns[2];
    row["formulation"] = info.at("formulation");
    row["operations"] = info.at("operations");
    row["error"] = references.contains(name) ? Json(error_of(table, module, references.at(name))) : Json(nullptr);
    row["compile_s"] = compiled.from_cache ? Json(nullptr) : Json(compiled.seconds);
    row["rivals"] = Json::object();
    return row;
}

std::string cell(const Json& value, const char* format) {
    return value.is_null() ? "-" : fmt::format(fmt::runtime(format), value.get<double>());
}

}  // namespace

int main(int argc, char** argv) try {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    std::string file;
    if (arguments.size() > 1 && arguments[0] == "--json") {
        file = arguments[1];
        arguments.erase(arguments.begin(), arguments.begin() + 2);
    }
    const Json references = Json::parse(text_of(arguments.at(0)));
    Json rows = Json::array();
    fmt::print("{:<16} {:>9} {:>9} {:>7} {:>9} {:>7} {:>10} {:>9} {:>10}   {}\n", "system", "floor ns", "ours ns", "floors",
               "pack ns", "floors", "operations", "error", "compile s", "formulation");
    for (std::size_t k = 1; k + 1 < arguments.size(); k += 2) {
        const Json row = measured(Json::parse(text_of(arguments[k])), arguments[k + 1], references);
        const double floor = row["floor_ns"], ours = row["ours_ns"];
        const Json& pack = row["ours_pack_ns"];
        fmt::print("{:<16} {:>9.1f} {:>9.1f} {:>7.2f} {:>9} {:>7} {:>10} {:>9} {:>10}   {}\n", row["system"].get<std::string>(), floor,
                   ours, ours / floor, cell(pack, "{:.1f}"), pack.is_null() ? "-" : fmt::format("{:.2f}", pack.get<double>() / floor),
                   row["operations"].get<int>(), cell(row["error"], "{:.1e}"), cell(row["compile_s"], "{:.2f}"),
                   row["formulation"].get<std::string>());
        rows.push_back(row);
    }
    if (!file.empty()) std::ofstream(file) << rows.dump(2) << "\n";
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
