// SPDX-License-Identifier: MIT
#include "alembert/ensemble.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include "alembert/dop853.hpp"
#include "alembert/pack_run.hpp"
#include "alembert/project.hpp"
#include "alembert/verner.hpp"

namespace alembert {
namespace {

using Packed = void (*)(const Ensemble&, const Options&, const MemberSource&, int width);

template <const auto& tableau>
void run_packed(const Ensemble& ensemble, const Options& options, const MemberSource& source, int width) {
    PackRun<tableau>(ensemble, options, source).go(width);
}

/// The function that runs members side by side; null if the method is no explicit Runge-Kutta method.
Packed packed_method(Method method) {
    switch (method) {
        case Method::euler:
            return run_packed<euler_tableau>;
        case Method::rk2:
            return run_packed<rk2_tableau>;
        case Method::rk4:
            return run_packed<rk4_tableau>;
        case Method::dopri5:
            return run_packed<dopri5_tableau>;
        case Method::dop853:
            return run_packed<dop853_tableau>;
        case Method::verner76:
            return run_packed<verner76_tableau>;
        case Method::verner98:
            return run_packed<verner98_tableau>;
        default:
            return nullptr;
    }
}

void check(const Ensemble& e, const Options& options) {
    const alembert_solver_table& table = e.module.table();
    const std::size_t count = e.count(), width = static_cast<std::size_t>(table.coordinates + table.speeds),
                      p = static_cast<std::size_t>(table.parameters);
    const auto need = [](bool good, const std::string& message) {
        if (!good) throw std::invalid_argument(message);
    };
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
    need(e.stops.empty() || e.stops.size() == static_cast<std::size_t>(table.events),
         fmt::format("{} flags for {} events", e.stops.size(), table.events));
    need(e.directions.empty() || e.directions.size() == e.stops.size(),
         fmt::format("{} directions for {} events", e.directions.size(), e.stops.size()));
    need(e.threads >= 0, fmt::format("threads = {}: zero or more are needed", e.threads));
    if (count == 0) return;
    for (const double start : e.starts)
        need(std::isfinite(start), fmt::format("start = {}: a finite number is needed", start));
    Options longest = options;
    for (const double duration : e.durations) {
        need(std::isfinite(duration) && duration >= 0,
             fmt::format("duration = {}: a finite number, zero or more, is needed", duration));
        longest.duration = std::max(longest.duration, duration);
    }
    check_options(make_rhs(e.module, {}),
                  {e.states.begin(), e.states.begin() + static_cast<std::ptrdiff_t>(width)}, longest);
}

/// The threads that integrate one ensemble.
class Crew {
public:
    Crew(const Ensemble& ensemble, const Options& options, Outcomes& outcomes)
        : e_(ensemble), options_(options), outcomes_(outcomes), count_(ensemble.count()) {
        const alembert_solver_table& table = e_.module.table();
        const bool stops = std::any_of(e_.stops.begin(), e_.stops.end(), [](bool stop) { return stop; });
        if (e_.module.pack() != nullptr && e_.module.pack()->lanes == lanes && table.constraints == 0 && !stops)
            packed_ = packed_method(options.method);
        outcomes_.packed = packed_ != nullptr;
        const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
        threads_ = static_cast<int>(std::clamp<std::size_t>(
            e_.threads > 0 ? static_cast<std::size_t>(e_.threads) : cores, 1, std::max<std::size_t>(1, count_)));
        outcomes_.threads = threads_;
    }

    void go() {
        std::vector<std::thread> others;
        for (int k = 1; k < threads_; ++k) others.emplace_back([this] { work(false); });
        work(true);
        for (std::thread& thread : others) thread.join();
        if (error_) std::rethrow_exception(error_);
    }

private:
    /// The work of one thread. An exception in one thread ends the work of all.
    void work(bool tells) {
        try {
            const MemberSource source{
                .next = [this] { return next(); },
                .done = [this](const Member& m, const Outcome& o, const std::vector<double>& y) { keep(m, o, y); },
                .again = [this](const Member& m) { alone(m); },
                .breathe = [this, tells] { tell(tells); }};
            if (packed_ != nullptr) {
                const std::size_t fair =
                    (count_ + static_cast<std::size_t>(threads_) - 1) / static_cast<std::size_t>(threads_);
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
            next_ = count_;
        }
    }

    void tell(bool tells) const {
        if (tells && e_.progress)
            e_.progress(static_cast<double>(done_.load(std::memory_order_relaxed)) / static_cast<double>(count_));
    }

    std::optional<Member> next() {
        const std::size_t k = next_.fetch_add(1);
        if (k >= count_) return std::nullopt;
        const alembert_solver_table& table = e_.module.table();
        const auto part = [](const std::vector<double>& all, std::size_t which, int size) {
            const auto begin = all.begin() + static_cast<std::ptrdiff_t>(which * static_cast<std::size_t>(size));
            return std::vector<double>(begin, begin + size);
        };
        const bool own = e_.parameters.size() != static_cast<std::size_t>(table.parameters);
        return Member{.index = k,
                      .state = part(e_.states, k, table.coordinates + table.speeds),
                      .parameters = e_.parameters.empty() ? std::vector<double>()
                                                          : part(e_.parameters, own ? k : 0, table.parameters),
                      .start = e_.starts.empty() ? options_.start : e_.starts[k],
                      .duration = e_.durations.empty() ? options_.duration : e_.durations[k]};
    }

    void keep(const Member& member, const Outcome& outcome, const std::vector<double>& state) {
        std::copy_n(state.begin(), outcomes_.dimension,
                    outcomes_.states.begin() + static_cast<std::ptrdiff_t>(member.index) * outcomes_.dimension);
        outcomes_.members[member.index] = outcome;
        done_.fetch_add(1, std::memory_order_relaxed);
    }

    /// Integrates one member with the ordinary integrator.
    void alone(const Member& member) {
        const alembert_solver_table& table = e_.module.table();
        const bool works = e_.work == Work::integrated;
        const Rhs rhs = make_rhs(e_.module, member.parameters, e_.work);
        const std::vector<double> par = prepared(e_.module, member.parameters);
        std::vector<double> state = member.state;
        if (works) state.push_back(0);
        Drift drift(table.coordinates, table.speeds, works);
        Options options = options_;
        options.start = member.start;
        options.duration = member.duration;
        if (!e_.quick_times.empty()) options.quick_times = e_.quick_times[member.index];
        options.sample = member.duration;  // no rows but the end
        options.on_step = [&](double t, std::span<const double> y, std::span<const double> rate) {
            drift(table, par, t, y, rate);
        };
        std::optional<Projection> projection;
        if (table.constraints > 0)
            options.project = projection.emplace(e_.module, member.parameters).after_steps();
        const Trajectory motion = integrate(
            rhs, state, options,
            e_.stops.empty() ? Events() : make_events(e_.module, member.parameters, e_.stops, e_.directions));
        const std::span<const double> end = motion.final_state();
        keep(member,
             {.time = motion.times.back(),
              .steps = motion.statistics.steps,
              .rejected = motion.statistics.rejected,
              .evaluations = motion.statistics.evaluations,
              .energy_drift = drift.energy(),
              .work_balance = drift.balance(),
              .stopped = motion.ending == Ending::stopped_by_event,
              .failure = motion.failure ? motion.failure->message : std::string()},
             {end.begin(), end.end()});
    }

    const Ensemble& e_;
    const Options& options_;
    Outcomes& outcomes_;
    std::size_t count_;
    Packed packed_ = nullptr;
    int threads_ = 1;
    std::atomic<std::size_t> next_ = 0, done_ = 0;
    std::mutex mutex_;
    std::exception_ptr error_;
};

}  // namespace

std::size_t Ensemble::count() const {
    const alembert_solver_table& table = module.table();
    return states.size() / static_cast<std::size_t>(std::max(1, table.coordinates + table.speeds));
}

Outcomes integrate(const Ensemble& ensemble, const Options& options) {
    check(ensemble, options);
    const alembert_solver_table& table = ensemble.module.table();
    Outcomes outcomes{.dimension = table.coordinates + table.speeds,
                      .states = {},
                      .members = {},
                      .method = std::string(name(options.method))};
    outcomes.states.resize(ensemble.states.size());
    outcomes.members.resize(ensemble.count());
    if (ensemble.count() > 0) Crew(ensemble, options, outcomes).go();
    return outcomes;
}

}  // namespace alembert
