// SPDX-License-Identifier: MIT
// The one driver of modes, by a system that is none of the library's own: a thermostat with hysteresis. The heater
// is on until T reaches 21, and off until it has come down to 19:
//
//     T' = 30 − T  or  T' = 10 − T,     T(0) = 20, on
//
// Each half of a cycle takes ln(11/9), the first quarter ln(10/9).
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "alembert/hybrid/automaton.hpp"
#include "alembert/hybrid/held_guard.hpp"

namespace runtime_automaton {

using namespace alembert;

namespace {

class Thermostat {
public:
    Thermostat(Events events, const Options& options) : events_(std::move(events)), options_(options) {}

    MotionState& now() { return now_; }

    Mode enter(Options rest, RunPiece piece) {
        starts.push_back(now_.t);
        budgets.push_back(rest.budget);
        grid_ = *piece.grid;
        std::vector<Event> list = events_.list;
        list.push_back({.name = "switch", .stop = true, .at_once = true, .direction = is_on_ ? 1 : -1});
        return {.system = {.rhs = make_rhs(1, [goal = is_on_ ? 30 : 10](double, const double* T,
                                                                        double* rate) { rate[0] = goal - T[0]; })},
                .guards =
                    make_events(std::move(list),
                                [this, is_on = is_on_](double t, const double* T, const double* rate, double* g) {
                                    if (!events_.list.empty()) events_(t, T, rate, g);
                                    g[events_.list.size()] = T[0] - (is_on ? 21 : 19);
                                }),
                .own = 1,
                .run = &events_,
                .options = std::move(rest),
                .piece = std::move(piece)};
    }

    void collect(Trajectory part) {
        if (whole.times.empty())
            whole = std::move(part);
        else
            append(whole, std::move(part), grid_, sample_interval(options_));
    }

    bool next_mode(const Hit& hit) {
        stopped = hit.stops;
        if (hit.guards.empty() || hit.stops) return false;
        is_on_ = !is_on_;
        whole.ending = Ending::completed;
        return true;
    }

    std::string changes() const { return ", with " + std::to_string(starts.size() - 1) + " switches"; }

    Trajectory whole = {};
    std::vector<double> starts = {};
    std::vector<long> budgets = {};
    bool stopped = false;

private:
    Events events_;
    const Options& options_;
    MotionState now_{.t = 0, .state = {20}};
    bool is_on_ = true;
    double grid_ = 0;
};

const double half = std::log(11. / 9), first = std::log(10. / 9);

}  // namespace

TEST_CASE("automaton: a thermostat switches when its closed form does, with all rows on one grid") {
    const Options options{.duration = 3, .tolerance = 1e-12, .sample = 0.01};
    Thermostat run({}, options);
    run_modes(run, options);
    REQUIRE(run.whole.ending == Ending::completed);
    REQUIRE(run.starts.size() == 2 + static_cast<std::size_t>((3 - first) / half));
    // Each piece leaves at most its tolerance in T, so t / 9 of that in the time of the next change.
    for (std::size_t k = 1; k < run.starts.size(); ++k)
        CHECK(std::abs(run.starts[k] - first - static_cast<double>(k - 1) * half) < 1e-11);
    REQUIRE(run.whole.rows() == 301);
    for (std::size_t row = 0; row < run.whole.rows(); ++row)
        CHECK(std::abs(run.whole.times[row] - 0.01 * static_cast<double>(row)) < 1e-14);
    CHECK(run.whole.times.back() == 3);
    const double since = 3 - run.starts.back();
    const bool is_on = run.starts.size() % 2 == 1;
    const double T = is_on ? 30 - 11 * std::exp(-since) : 10 + 11 * std::exp(-since);
    CHECK(std::abs(run.whole.final_state()[0] - T) < 1e-10);
    CHECK(run.whole.events.empty());  // its guards are nobody's events
}

TEST_CASE("automaton: all modes share one budget, and the message tells of it as a whole") {
    const Options options{.duration = 3, .tolerance = 1e-12, .budget = 500};
    Thermostat run({}, options);
    run_modes(run, options);
    REQUIRE(run.whole.failure);
    CHECK(run.whole.failure->kind == FailureKind::budget_used_up);
    const std::string begin = "500 right-hand sides were not enough to come further than t = ";
    CHECK(run.whole.failure->message.substr(0, begin.size()) == begin);
    CHECK(run.whole.failure->message.find(run.changes() + "; raise the budget") != std::string::npos);
    CHECK(run.starts.size() > 2);
    for (std::size_t k = 1; k < run.budgets.size(); ++k) CHECK(run.budgets[k] < run.budgets[k - 1]);
    CHECK(run.whole.statistics.work <= 500 + 40);  // the search for the last zero is not counted ahead
}

TEST_CASE("automaton: an event of the run stops it, also at the instant of a guard") {
    const Options options{.duration = 3, .tolerance = 1e-12};
    for (const double where : {20.5, 21.0}) {
        Thermostat run(make_events({{.name = "warm", .stop = true}}, [=](double, const double* T, const double*,
                                                                         double* g) { g[0] = T[0] - where; }),
                       options);
        run_modes(run, options);
        CHECK(run.stopped);
        CHECK(run.whole.ending == Ending::stopped_by_event);
        REQUIRE(run.whole.events.size() == 1);
        CHECK(run.whole.events[0].name == "warm");
        CHECK(std::abs(run.whole.times.back() - std::log(10 / (30 - where))) < 1e-11);
    }
}

TEST_CASE("automaton: a held guard keeps its side until rounding is over, and its band is zero") {
    const HeldGuard open{.until = 1};
    CHECK(open(0.5, -1e-20) > 0);
    CHECK(open(1.5, -1e-20) < 0);
    const HeldGuard below{.side = -1, .until = 1};
    CHECK(below(0.5, 1e-20) < 0);
    CHECK(below(0.5, -3) == -3);
    const HeldGuard resting{.bound = 1e-12};
    CHECK(resting(0, -1e-13) > 0);
    CHECK(resting(0, -1e-11) < 0);
    const HeldGuard banded{.band = 1e-12};
    CHECK(banded(0, -1e-13) == 0);
    CHECK(banded(0, 2e-12) == 2e-12);
    CHECK(HeldGuard()(0, 0.25) == 0.25);
}

TEST_CASE("system: a Jacobian and a series are asked for once, and only where the run needs them") {
    const auto decay = [](double rate) {
        return make_rhs(1,
                        [rate](double t, const double* y, double* out) { out[0] = -rate * (y[0] - std::cos(t)); });
    };
    for (const auto& [rate, times] : {std::pair{1.0, 0}, {1e4, 1}}) {
        CAPTURE(rate);
        int jacobians = 0, series = 0;
        const System system{.rhs = decay(rate),
                            .with_jacobian = [&, r = rate] { return ++jacobians, decay(r); },
                            .with_series = [&, r = rate] { return ++series, decay(r); }};
        const Trajectory motion =
            integrate(system, {1}, {.method = Method::dop853, .duration = 3, .when_stiff = Method::radau});
        REQUIRE(!motion.failure);
        CHECK(jacobians == times);
        CHECK(series == 0);
        CHECK(motion.statistics.switched.has_value() == (times > 0));
    }
}

}  // namespace runtime_automaton
