// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/faster_code.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>

namespace alembert {

namespace {

double clock_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr int usual_order = 20;  ///< of a power series

using Calls = std::function<void(int count)>;

/// The least time of a call in several runs of each.
bool takes_less(const Calls& one, const Calls& other) {
    constexpr int rounds = 7;
    constexpr double long_enough = 1e-5;
    int count = 1;
    const auto seconds_of = [&](const Calls& calls) {
        const double begin = clock_seconds();
        calls(count);
        return clock_seconds() - begin;
    };
    while (seconds_of(other) < long_enough && count < 1 << 20) count *= 2;
    double least = HUGE_VAL, least_other = HUGE_VAL;
    for (int round = 0; round < rounds; ++round) {
        least = std::min(least, seconds_of(one));
        least_other = std::min(least_other, seconds_of(other));
    }
    return least < least_other;
}

std::vector<double> with_room(std::span<const double> state, int size) {
    std::vector<double> result(state.begin(), state.end());
    result.resize(static_cast<std::size_t>(size));
    return result;
}

}  // namespace

bool is_faster(const Module& one, const Module& other, const TimedPlace& place) {
    const auto calls_of = [&](const Module& module) -> Calls {
        const alembert_solver_table& table = module.table();
        const int width = table.coordinates + table.speeds;
        return [&table, t = place.t, par = prepared(module, place.parameters), y = with_room(place.state, width),
                rate = std::vector<double>(static_cast<std::size_t>(width))](int count) mutable {
            for (int k = 0; k < count; ++k) {
                table.rhs(t, y.data(), par.data(), rate.data());
                y[0] += 1e-300 * rate[0];  // so that each waits for the one before, as in a run
            }
        };
    };
    return takes_less(calls_of(one), calls_of(other));
}

bool is_faster(const SeriesModule& one, const SeriesModule& other, const TimedPlace& place) {
    constexpr std::size_t line = 64;
    const auto calls_of = [&](const SeriesModule& module) -> Calls {
        const Series series = make_series(module, place.parameters);
        const auto width = static_cast<std::size_t>(series.width);
        const auto room =
            std::make_shared<std::vector<double>>(static_cast<std::size_t>(series.workspace) + line / 8);
        void* begin = room->data();
        std::size_t bytes = room->size() * sizeof(double);
        double* const work = static_cast<double*>(std::align(line, bytes - line, begin, bytes));
        return [series, room, work, t = place.t, y = with_room(place.state, series.width),
                out = std::vector<double>((usual_order + 1) * width)](int count) mutable {
            for (int k = 0; k < count; ++k) {
                series(t, y.data(), usual_order, out.data(), work);
                y[0] += 1e-300 * out[0];
            }
        };
    };
    return takes_less(calls_of(one), calls_of(other));
}

}  // namespace alembert
