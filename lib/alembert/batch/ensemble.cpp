// SPDX-License-Identifier: MIT
#include "alembert/batch/ensemble.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include "alembert/base/argument.hpp"
#include "alembert/batch/pack_driver.hpp"
#include "alembert/batch/pack_explicit_rk.hpp"
#include "alembert/batch/pack_taylor.hpp"
#include "alembert/ode/method_table.hpp"
#include "alembert/ode/projection.hpp"
#include "alembert/ode/running_extrema.hpp"

namespace alembert {
namespace {

using Packed = void (*)(const Ensemble&, const Options&, const MemberSource&, int width);

/// How many quadratures there are, and the components of the state with them.
struct Size {
    explicit Size(const Ensemble& e)
        : extra(e.work == Work::integrated ? 1 : 0),
          dimension(e.module.table().coordinates + e.module.table().speeds + extra) {}
    int extra, dimension;
};

template <const auto& tableau>
void run_packed(const Ensemble& e, const Options& options, const MemberSource& source, int width) {
    const Size size(e);
    PackDriver(e, options, source, PackExplicitRK<tableau>(e.module, size.dimension, size.extra)).go(width);
}

void run_packed_series(const Ensemble& e, const Options& options, const MemberSource& source, int width) {
    const Size size(e);
    PackDriver(e, options, source,
               PackTaylor(e.module, *e.series_packs, size.dimension, size.extra, options.tolerance))
        .go(width);
}

/// The function that runs members side by side by a method; null if the method cannot.
template <class Row>
constexpr Packed packed_by(const Row&) {
    if constexpr (requires { Row::tableau; })
        return run_packed<Row::tableau>;
    else
        return std::is_same_v<typename Row::Formula, Taylor> ? run_packed_series : nullptr;
}

constexpr std::array packed_by_method = for_each_method([](const auto& row) { return packed_by(row); });

Packed packed_method(const Ensemble& e, const Options& options) {
    if (needs_series(options.method) && (!e.series_packs || options.step != 0)) return nullptr;
    return packed_by_method[static_cast<std::size_t>(options.method)];
}

void need(bool good, const std::string& message) {
    if (!good) throw std::invalid_argument(message);
}

/// The system with the parameters of a member.
Rhs rhs_of(const Ensemble& e, const std::vector<double>& parameters) {
    Rhs rhs = make_rhs(e.module, parameters, e.work);
    if (e.series) rhs.series = make_series(e.series, parameters);
    return rhs;
}

/// The state with room for the quadratures.
std::vector<double> with_quadratures(const Ensemble& e, std::vector<double> state) {
    state.resize(state.size() + static_cast<std::size_t>(Size(e).extra));
    return state;
}

void check_events(const Ensemble& e) {
    const alembert_solver_table& table = e.module.table();
    need(e.stops.empty() || e.stops.size() == static_cast<std::size_t>(table.events),
         fmt::format("{} flags for {} events", e.stops.size(), table.events));
    need(e.directions.empty() || e.directions.size() == e.stops.size(),
         fmt::format("{} directions for {} events", e.directions.size(), e.stops.size()));
    argument::need_whole_nonnegative("threads", e.threads);
}

void check(const Ensemble& e, const Options& options) {
    check_events(e);
    const alembert_solver_table& table = e.module.table();
    const std::size_t count = e.count(), width = static_cast<std::size_t>(table.coordinates + table.speeds),
                      p = static_cast<std::size_t>(table.parameters);
    need(width > 0 && e.states.size() == count * width,
         fmt::format("{} numbers are no states of {} components", e.states.size(), width));
    need(e.parameters.empty() || e.parameters.size() == p || e.parameters.size() == count * p,
         fmt::format("{} numbers are no sets of {} parameters for {} members", e.parameters.size(), p, count));
    need(e.starts.empty() || e.starts.size() == count,
         fmt::format("{} starts for {} members", e.starts.size(), count));
    need(e.durations.empty() || e.durations.size() == count,
         fmt::format("{} durations for {} members", e.durations.size(), count));
    need(e.quick_times.empty() || e.quick_times.size() == count,
         fmt::format("{} lists of quick times for {} members", e.quick_times.size(), count));
    if (count == 0) return;
    for (const double start : e.starts) argument::need_finite("start", start);
    for (std::size_t k = 0; k < e.states.size(); ++k)
        if (!std::isfinite(e.states[k])) argument::need_finite(fmt::format("states[{}]", k), e.states[k]);
    Options longest = options;
    for (const double duration : e.durations) {
        argument::need_nonnegative("duration", duration);
        longest.duration = std::max(longest.duration, duration);
    }
    check_options(rhs_of(e, {}),
                  with_quadratures(e, {e.states.begin(), e.states.begin() + static_cast<std::ptrdiff_t>(width)}),
                  longest);
}

/// A state within a step.
struct Passing {
    double t;
    std::vector<double> state, rate;
};

/// The states at the ends of the pieces of a step of a series, but the last.
std::vector<Passing> passed(const Rhs& rhs, const StepView& step) {
    std::vector<Passing> list;
    for (int piece = 1; piece < RunningExtrema::pieces_of_series; ++piece) {
        const double theta = static_cast<double>(piece) / RunningExtrema::pieces_of_series;
        const auto size = static_cast<std::size_t>(rhs.dimension);
        Passing one{step.start + theta * (step.end - step.start), std::vector<double>(size),
                    std::vector<double>(size)};
        step.interpolate(theta, one.state.data());
        rhs(one.t, one.state.data(), one.rate.data());
        list.push_back(std::move(one));
    }
    return list;
}

/// The threads that integrate the members of a feed.
class Crew {
public:
    Crew(const Ensemble& ensemble, const EnsembleFeed& feed, const Options& options)
        : e_(ensemble), feed_(feed), options_(options) {
        const bool stops = std::any_of(e_.stops.begin(), e_.stops.end(), [](bool stop) { return stop; });
        if (!e_.by && e_.module.pack() != nullptr && e_.module.pack()->lanes == lanes &&
            e_.module.independent_constraints() == 0 && !stops)
            packed_ = packed_method(e_, options);
        const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
        threads_ = std::clamp<std::size_t>(e_.threads > 0 ? static_cast<std::size_t>(e_.threads) : cores, 1,
                                           std::max<std::size_t>(1, feed.most));
    }

    Feeding go() {
        std::vector<std::thread> others;
        for (std::size_t k = 1; k < threads_; ++k) others.emplace_back([this] { work(false); });
        work(true);
        for (std::thread& thread : others) thread.join();
        if (error_) std::rethrow_exception(error_);
        return {.packed = packed_ != nullptr, .threads = static_cast<int>(threads_)};
    }

private:
    /// The work of one thread. An exception in one thread ends the work of all.
    void work(bool tells) {
        try {
            const MemberSource source{.next = [this] { return next(); },
                                      .done =
                                          [this](const Member& m, const Outcome& o, const std::vector<double>& y) {
                                              feed_.done(m, o, std::span(y).first(m.state.size()));
                                          },
                                      .again = [this](const Member& m) { alone(m); },
                                      .breathe = [this, tells] { tell(tells); }};
            if (packed_ != nullptr) {
                const std::size_t fair = feed_.most / threads_ + (feed_.most % threads_ != 0 ? 1 : 0);
                packed_(e_, options_, source, static_cast<int>(std::min<std::size_t>(fair, lanes)));
            } else {
                while (const std::optional<Member> member = next()) {
                    alone(*member);
                    tell(tells);
                }
            }
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!error_) error_ = std::current_exception();
            stopped_ = true;
        }
    }

    void tell(bool tells) const {
        if (tells && feed_.breathe) feed_.breathe();
    }

    std::optional<Member> next() {
        if (stopped_) return std::nullopt;
        std::optional<Member> member = feed_.next();
        if (member) check(*member);
        return member;
    }

    void check(const Member& member) {
        argument::need_finite("start", member.start);
        argument::need_nonnegative("duration", member.duration);
        if (e_.by || member.duration <= longest_.load(std::memory_order_relaxed)) return;
        Options options = options_;
        options.duration = member.duration;
        check_options(rhs_of(e_, {}), with_quadratures(e_, member.state), options);
        longest_ = member.duration;
    }

    /// Integrates one member with the ordinary integrator.
    void alone(const Member& member) {
        if (e_.by) {
            std::vector<double> state = member.state;
            const Outcome outcome = e_.by(member, state);
            feed_.done(member, outcome, state);
            return;
        }
        const alembert_solver_table& table = e_.module.table();
        const bool works = e_.work == Work::integrated;
        System system{.rhs = rhs_of(e_, member.parameters), .quick_times = quick_times_of(member)};
        const std::vector<double> par = prepared(e_.module, member.parameters);
        system.quick_places = {e_.place_code, par};
        const std::vector<double> state = with_quadratures(e_, member.state);
        EnergyError energy_error(table.coordinates, table.speeds, works);
        Options options = options_;
        options.start = member.start;
        options.duration = member.duration;
        options.sample = member.duration;  // no rows but the end
        RunningExtrema along(table.coordinates, table.coordinates + table.speeds);
        std::vector<Passing> passing;
        EndedEvents ended(e_.stops.size());
        RunPiece piece;
        if (e_.along && needs_series(options.method))
            piece.on_step_view = [&](const StepView& step) {
                passing = passed(system.rhs, step);
                return false;
            };
        options.on_step = [&](double t, std::span<const double> y, std::span<const double> rate) {
            energy_error(table, par, t, y, rate);
            ended(table, par.data(), t, y.data(), rate.data());
            if (!e_.along) return;
            for (const Passing& one : passing)
                if (one.t < t) along(one.t, one.state.data(), one.rate.data());
            passing.clear();
            along(t, y.data(), rate.data());
        };
        std::optional<Projection> projection;
        if (e_.module.independent_constraints() > 0) {
            projection.emplace(e_.module, member.parameters).begin(options.start, state.data());
            system.project = projection->after_steps();
            system.rhs = projection->guarded(std::move(system.rhs), member.parameters);
        }
        Events events;
        if (!e_.stops.empty()) {
            events = make_events(e_.module, member.parameters, e_.stops, e_.directions);
            events.bounds = bounds_of(e_.event_code, par);
        }
        const Trajectory motion = integrate(system, state, options, events, piece);
        const std::span<const double> end = motion.final_state();
        feed_.done(member,
                   {.time = motion.times.back(),
                    .steps = motion.statistics.steps,
                    .rejected = motion.statistics.rejected,
                    .evaluations = motion.statistics.evaluations,
                    .energy_drift = energy_error.energy(),
                    .work_balance = energy_error.balance(),
                    .stopped = motion.ending == Ending::stopped_by_event,
                    .failure = motion.failure ? motion.failure->message : std::string(),
                    .along = e_.along ? along.values() : std::vector<double>(),
                    .ended = ended.found()},
                   end.first(member.state.size()));
    }

    const Ensemble& e_;
    const EnsembleFeed& feed_;
    const Options& options_;
    Packed packed_ = nullptr;
    std::size_t threads_ = 1;
    std::atomic<double> longest_ = -1;  ///< duration for which the options were found to make sense
    std::atomic<bool> stopped_ = false;
    std::mutex mutex_;
    std::exception_ptr error_;
};

Member member_of(const Ensemble& e, const Options& options, std::size_t k) {
    const alembert_solver_table& table = e.module.table();
    const auto part = [](const std::vector<double>& all, std::size_t which, int size) {
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(which * static_cast<std::size_t>(size));
        return std::vector<double>(begin, begin + size);
    };
    const bool own = e.parameters.size() != static_cast<std::size_t>(table.parameters);
    return {.index = k,
            .state = part(e.states, k, table.coordinates + table.speeds),
            .parameters =
                e.parameters.empty() ? std::vector<double>() : part(e.parameters, own ? k : 0, table.parameters),
            .start = e.starts.empty() ? options.start : e.starts[k],
            .duration = e.durations.empty() ? options.duration : e.durations[k],
            .quick_times = e.quick_times.empty() ? nullptr : &e.quick_times[k]};
}

}  // namespace

std::size_t Ensemble::count() const {
    const alembert_solver_table& table = module.table();
    return states.size() / static_cast<std::size_t>(std::max(1, table.coordinates + table.speeds));
}

Feeding integrate(const Ensemble& ensemble, const EnsembleFeed& feed, const Options& options) {
    check_events(ensemble);
    return Crew(ensemble, feed, options).go();
}

Outcomes integrate(const Ensemble& ensemble, const Options& options) {
    check(ensemble, options);
    const alembert_solver_table& table = ensemble.module.table();
    Outcomes outcomes{.dimension = table.coordinates + table.speeds,
                      .states = {},
                      .members = {},
                      .method = std::string(name(options.method))};
    const std::size_t count = ensemble.count();
    outcomes.states.resize(ensemble.states.size());
    outcomes.members.resize(count);
    if (count == 0) return outcomes;
    std::atomic<std::size_t> next = 0, ended = 0;
    EnsembleFeed feed{.next = [&]() -> std::optional<Member> {
                          const std::size_t k = next.fetch_add(1);
                          return k < count ? std::optional(member_of(ensemble, options, k)) : std::nullopt;
                      },
                      .done =
                          [&](const Member& member, const Outcome& outcome, std::span<const double> state) {
                              std::copy_n(state.begin(), outcomes.dimension,
                                          outcomes.states.begin() +
                                              static_cast<std::ptrdiff_t>(member.index) * outcomes.dimension);
                              outcomes.members[member.index] = outcome;
                              ended.fetch_add(1, std::memory_order_relaxed);
                          },
                      .breathe = {},
                      .most = count};
    if (ensemble.progress)
        feed.breathe = [&] {
            ensemble.progress(static_cast<double>(ended.load(std::memory_order_relaxed)) /
                              static_cast<double>(count));
        };
    const Feeding used = integrate(ensemble, feed, options);
    outcomes.packed = used.packed;
    outcomes.threads = used.threads;
    return outcomes;
}

}  // namespace alembert
