// SPDX-License-Identifier: GPL-2.0-or-later
// alembert-sundials.so: see backend.hpp.
#include "backend.hpp"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "alembert/run.hpp"

namespace alembert {

namespace {

constexpr int unrecoverable = -1, recoverable = 1;

void quiet(int, const char*, const char*, char*, void*) {}

bool is_finite(const double* values, std::size_t size) {
    return std::all_of(values, values + size, [](double x) { return std::isfinite(x); });
}

/// The right-hand side with a count of its calls, and everything else that SUNDIALS needs of the system.
struct System {
    const Rhs& rhs;
    const Options& options;
    long evaluations = 0;
    std::vector<double> moved = {};

    std::size_t size() const { return static_cast<std::size_t>(rhs.dimension); }
    bool is_over_budget() const { return evaluations >= options.budget; }
    int rate(double t, const double* y, double* out) {
        if (is_over_budget()) return unrecoverable;
        rhs(t, y, out);
        ++evaluations;
        return is_finite(out, size()) ? 0 : recoverable;
    }
};

/// Vectors, a matrix and a solver of one size, freed at the end.
struct Workspace {
    explicit Workspace(std::size_t size) {
        SUNContext_Create(nullptr, &context);
        const auto n = static_cast<sunindextype>(size);
        for (N_Vector* v : {&y, &slope, &between}) *v = N_VNew_Serial(n, context);
        N_VConst(0, slope);
        matrix = SUNDenseMatrix(n, n, context);
        solver = SUNLinSol_Dense(y, matrix, context);
    }
    ~Workspace() {
        SUNLinSolFree(solver);
        SUNMatDestroy(matrix);
        for (N_Vector v : {y, slope, between}) N_VDestroy(v);
        SUNContext_Free(&context);
    }
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;

    SUNContext context = nullptr;
    N_Vector y = nullptr, slope = nullptr, between = nullptr;
    SUNMatrix matrix = nullptr;
    SUNLinearSolver solver = nullptr;
};

/// One running integrator: a step, and states within it.
struct Stepping {
    std::string name;
    std::function<int(double& t)> step;  ///< negative values are error flags of SUNDIALS
    std::function<const double*()> state;
    std::function<void(double t, double* state)> at;
    std::function<long()> steps, rejected;
    std::function<std::string(int flag)> meaning;
};

/// Rows and events of a run.
class Collected {
public:
    Collected(System& system, const std::vector<double>& initial, const Stepping& by, const Events& events)
        : system_(system),
          by_(by),
          events_(events),
          watch_(events, system.rhs),
          grid_(system.options.grid.value_or(system.options.start)),
          interval_(sample_interval(system.options)),
          next_(std::lround(std::floor((system.options.start - grid_) / interval_ + 1e-9)) + 1),
          row_(initial),
          rate_(initial.size()) {
        motion_.dimension = system.rhs.dimension;
        motion_.names = system.rhs.names;
        add(system.options.start, initial.data());
        look_at_rate(system.options.start, initial.data());
        if (has_events()) watch_.begin(system.options.start, initial.data(), rate_.data());
        tell(system.options.start, initial.data());
    }

    Trajectory go() && {
        const double end = system_.options.start + system_.options.duration;
        double t = system_.options.start;
        while (t < end && motion_.ending == Ending::completed) {
            double reached = t;
            const int flag = by_.step(reached);
            if (flag < 0) {
                fail(t, flag);
                break;
            }
            finish_step(t, reached);
            t = reached;
            if (t >= end && motion_.ending == Ending::completed) add(end, row_.data());
        }
        motion_.statistics = {.steps = by_.steps(),
                              .rejected = by_.rejected(),
                              .evaluations = system_.evaluations + watch_.evaluations(),
                              .seconds = 0,
                              .method = by_.name};
        return std::move(motion_);
    }

private:
    bool has_events() const { return !events_.list.empty(); }

    void add(double t, const double* state) {
        motion_.times.push_back(t);
        motion_.states.insert(motion_.states.end(), state, state + motion_.dimension);
    }

    /// Adds the rows of the grid before a time, but not the last row of the run.
    void add_rows_before(double time) {
        const double end = system_.options.start + system_.options.duration;
        for (;; ++next_) {
            const double at = grid_ + static_cast<double>(next_) * interval_;
            if (!(at < std::min(time, end - 1e-9 * interval_))) return;
            by_.at(at, row_.data());
            if (system_.options.project) system_.options.project(at, row_.data());
            add(at, row_.data());
        }
    }

    /// Records what lies between two ends of steps.
    void finish_step(double begin, double end) {
        const std::vector<double> state(by_.state(), by_.state() + system_.size());
        look_at_rate(end, state.data());
        if (has_events()) {
            const std::vector<Crossing> crossings = watch_.look(
                {.start = begin,
                 .end = end,
                 .end_state = state.data(),
                 .end_rate = rate_.data(),
                 .interpolate = [&](double theta, double* out) { by_.at(begin + theta * (end - begin), out); }});
            for (std::size_t k = 0; k < crossings.size(); ++k) {
                if (!crossings[k].counts) continue;
                add_rows_before(crossings[k].time);
                by_.at(crossings[k].time, row_.data());
                note(crossings[k]);
                if (events_.list[static_cast<std::size_t>(crossings[k].index)].stop)
                    return stop_at(crossings, k, simultaneous(begin, end));
            }
        }
        add_rows_before(end);
        row_ = state;
        tell(end, row_.data());
    }

    /// The state there is in row_.
    void note(const Crossing& crossing) {
        motion_.events.push_back({.index = crossing.index,
                                  .name = events_.list[static_cast<std::size_t>(crossing.index)].name,
                                  .time = crossing.time,
                                  .state = row_});
    }

    /// Ends the run at the crossing k, whose state is in row_, with all that are simultaneous.
    void stop_at(const std::vector<Crossing>& crossings, std::size_t k, double grain) {
        const double time = crossings[k].time;
        for (std::size_t j = 0; j < crossings.size(); ++j) {
            if (std::abs(crossings[j].time - time) > grain) continue;
            if (j > k && crossings[j].counts) note(crossings[j]);
            motion_.last_zeros.push_back(
                {.event = crossings[j].index, .direction = crossings[j].direction, .counts = crossings[j].counts});
        }
        look_at_rate(time, row_.data());
        tell(time, row_.data());
        if (motion_.rows() > 1 && motion_.times.back() > time - 1e-9 * interval_) {
            motion_.times.pop_back();
            motion_.states.resize(motion_.states.size() - row_.size());
        }
        if (motion_.times.back() < time) add(time, row_.data());
        motion_.ending = Ending::stopped_by_event;
    }

    void look_at_rate(double t, const double* state) {
        if (!system_.options.on_step && !has_events()) return;
        system_.rhs(t, state, rate_.data());
        ++system_.evaluations;
    }

    void tell(double t, const double* state) const {
        if (system_.options.on_step) system_.options.on_step(t, {state, rate_.size()}, rate_);
    }

    void fail(double t, int flag) {
        if (motion_.times.back() < t) add(t, row_.data());
        motion_.ending = Ending::failed;
        const bool budget = system_.is_over_budget();
        motion_.failure = Failure{
            .kind = budget ? FailureKind::budget_used_up : FailureKind::step_underflow,
            .message = budget
                           ? fmt::format("{} right-hand sides were not enough to come further than t = {:.17g}; "
                                         "raise the budget, loosen the tolerance or shorten the duration",
                                         system_.options.budget, t)
                           : fmt::format("{} gave up at t = {:.17g} with {}; loosen the tolerance, or take radau",
                                         by_.name, t, by_.meaning(flag)),
            .time = t,
            .state = row_};
    }

    System& system_;
    const Stepping& by_;
    const Events& events_;
    EventWatch watch_;
    double grid_, interval_;
    long next_;  ///< the number of the next row on the grid
    Trajectory motion_;
    std::vector<double> row_, rate_;
};

/// Sets the weights 1 / (tolerance · max(1, |y|)); quadratures are not controlled.
void weigh(const System& system, const double* y, double* weights) {
    for (int i = 0; i < system.rhs.dimension; ++i)
        weights[i] = i < system.rhs.dimension - system.rhs.extra
                         ? 1 / (system.options.tolerance * std::max(1.0, std::abs(y[i])))
                         : 1e-30;
}

std::string flag_name(char* text) {
    std::string name = text;
    std::free(text);
    return name;
}

Trajectory by_cvode(const Rhs& rhs, const std::vector<double>& initial, const Options& options,
                    const Events& events) {
    System system{.rhs = rhs, .options = options};
    Workspace w(initial.size());
    std::copy(initial.begin(), initial.end(), N_VGetArrayPointer(w.y));
    void* memory = CVodeCreate(CV_BDF, w.context);
    CVodeInit(
        memory,
        [](realtype t, N_Vector y, N_Vector out, void* s) {
            return static_cast<System*>(s)->rate(t, N_VGetArrayPointer(y), N_VGetArrayPointer(out));
        },
        options.start, w.y);
    CVodeSetErrHandlerFn(memory, quiet, nullptr);
    CVodeSetUserData(memory, &system);
    CVodeWFtolerances(memory, [](N_Vector y, N_Vector weights, void* s) {
        weigh(*static_cast<System*>(s), N_VGetArrayPointer(y), N_VGetArrayPointer(weights));
        return 0;
    });
    CVodeSetLinearSolver(memory, w.solver, w.matrix);
    if (rhs.jacobian != nullptr)
        CVodeSetJacFn(
            memory, [](realtype t, N_Vector y, N_Vector, SUNMatrix J, void* s, N_Vector, N_Vector, N_Vector) {
                auto& own = *static_cast<System*>(s);
                own.rhs.jacobian(own.rhs.context.get(), t, N_VGetArrayPointer(y), SUNDenseMatrix_Data(J));
                ++own.evaluations;
                return is_finite(SUNDenseMatrix_Data(J), own.size() * own.size()) ? 0 : recoverable;
            });
    if (options.project) {
        CVodeSetProjFn(memory, [](realtype t, N_Vector y, N_Vector change, realtype, N_Vector, void* s) {
            auto& own = *static_cast<System*>(s);
            const double* const from = N_VGetArrayPointer(y);
            own.moved.assign(from, from + own.size());
            own.options.project(t, own.moved.data());
            for (std::size_t i = 0; i < own.size(); ++i) N_VGetArrayPointer(change)[i] = own.moved[i] - from[i];
            return is_finite(own.moved.data(), own.size()) ? 0 : recoverable;
        });
        CVodeSetProjErrEst(memory, 0);
    }
    CVodeSetStopTime(memory, options.start + options.duration);
    if (options.longest_step > 0) CVodeSetMaxStep(memory, options.longest_step);
    const auto count = [memory](int (*of)(void*, long*)) {
        return [memory, of] {
            long number = 0;
            of(memory, &number);
            return number;
        };
    };
    const Stepping by{
        .name = "cvode",
        .step = [&](double& t) { return CVode(memory, options.start + options.duration, w.y, &t, CV_ONE_STEP); },
        .state = [&] { return N_VGetArrayPointer(w.y); },
        .at =
            [&](double t, double* state) {
                CVodeGetDky(memory, t, 0, w.between);
                std::copy_n(N_VGetArrayPointer(w.between), system.size(), state);
            },
        .steps = count(CVodeGetNumSteps),
        .rejected = count(CVodeGetNumErrTestFails),
        .meaning = [](int flag) { return flag_name(CVodeGetReturnFlagName(flag)); }};
    Trajectory motion = Collected(system, initial, by, events).go();
    CVodeFree(&memory);
    return motion;
}

/// F(t, y, y') = 0 in (state, λ, μ).
struct Implicit {
    System system;
    const Module& module;
    const std::vector<double>& par;
    std::size_t n, m;  ///< coordinates; constraints, which are 0 if the equations are those of the Rhs
    std::vector<double> mass, forcing, rows, rate, trial, trial_slope, here, moved;

    std::size_t states() const { return system.size(); }
    std::size_t size() const { return states() + 2 * m; }

    int residual(double t, const double* y, const double* slope, double* out) {
        if (m == 0) {
            if (const int failed = system.rate(t, y, out)) return failed;
            for (std::size_t i = 0; i < states(); ++i) out[i] = slope[i] - out[i];
            return 0;
        }
        if (system.is_over_budget()) return unrecoverable;
        ++system.evaluations;
        const alembert_solver_table& table = module.table();
        const double *lambda = y + states(), *mu = lambda + m;
        table.mass_forcing(t, y, par.data(), mass.data(), forcing.data());
        table.constraints_at(t, y, par.data(), out + states(), out + states() + m, rows.data());
        for (std::size_t i = 0; i < n; ++i) {
            out[i] = slope[i] - y[n + i];
            out[n + i] = -forcing[i];
            for (std::size_t j = 0; j < n; ++j) out[n + i] += mass[i * n + j] * slope[n + j];
            for (std::size_t k = 0; k < m; ++k) {
                out[i] -= rows[k * n + i] * mu[k];
                out[n + i] -= rows[k * n + i] * lambda[k];
            }
        }
        if (states() > 2 * n) {
            double energy[4], jacobi = 0;
            std::copy_n(y + n, n, rate.begin());
            std::copy_n(slope + n, n, rate.begin() + static_cast<std::ptrdiff_t>(n));
            table.energy(t, y, rate.data(), par.data(), energy, &jacobi);
            out[2 * n] = slope[2 * n] - energy[3];
        }
        return is_finite(out, size()) ? 0 : recoverable;
    }

    /// ∂F/∂y + c ∂F/∂y' by differences, column by column.
    int jacobian(double t, double c, const double* y, const double* slope, const double* value, double* columns) {
        const std::size_t N = size();
        trial.assign(y, y + N);
        trial_slope.assign(slope, slope + N);
        for (std::size_t j = 0; j < N; ++j) {
            constexpr double root_epsilon = 1.4901161193847656e-8;
            trial[j] = y[j] + root_epsilon * std::max({std::abs(y[j]), std::abs(slope[j] / c), 1e-3});
            const double difference = trial[j] - y[j];
            trial_slope[j] = slope[j] + c * difference;
            double* const column = columns + j * N;
            if (const int failed = residual(t, trial.data(), trial_slope.data(), column)) return failed;
            for (std::size_t i = 0; i < N; ++i) column[i] = (column[i] - value[i]) / difference;
            trial[j] = y[j];
            trial_slope[j] = slope[j];
        }
        return 0;
    }
};

Trajectory by_ida(const Module& module, const std::vector<double>& par, const Rhs& rhs,
                  const std::vector<double>& initial, const Options& options, const Events& events) {
    const alembert_solver_table& table = module.table();
    const auto n = static_cast<std::size_t>(table.coordinates), m = static_cast<std::size_t>(table.constraints);
    Implicit f{.system = {.rhs = rhs, .options = options},
               .module = module,
               .par = par,
               .n = n,
               .m = m,
               .mass = std::vector<double>(n * n),
               .forcing = std::vector<double>(n),
               .rows = std::vector<double>(m * n),
               .rate = std::vector<double>(initial.size()),
               .trial = {},
               .trial_slope = {},
               .here = {},
               .moved = {}};
    Workspace w(f.size());
    double *const y = N_VGetArrayPointer(w.y), *const slope = N_VGetArrayPointer(w.slope);
    std::fill_n(y, f.size(), 0.0);
    std::copy(initial.begin(), initial.end(), y);
    f.system.rate(options.start, y, slope);
    if (m > 0) table.multipliers_at(options.start, initial.data(), par.data(), y + f.states());

    void* memory = IDACreate(w.context);
    IDAInit(
        memory,
        [](realtype t, N_Vector at, N_Vector with, N_Vector out, void* s) {
            return static_cast<Implicit*>(s)->residual(t, N_VGetArrayPointer(at), N_VGetArrayPointer(with),
                                                       N_VGetArrayPointer(out));
        },
        options.start, w.y, w.slope);
    IDASetErrHandlerFn(memory, quiet, nullptr);
    IDASetUserData(memory, &f);
    // Multipliers are controlled neither in the error test nor in Newton's iteration.
    IDAWFtolerances(memory, [](N_Vector at, N_Vector weights, void* s) {
        const auto& own = *static_cast<Implicit*>(s);
        std::fill_n(N_VGetArrayPointer(weights), own.size(), 1e-30);
        weigh(own.system, N_VGetArrayPointer(at), N_VGetArrayPointer(weights));
        return 0;
    });
    N_Vector differential = N_VClone(w.y);
    std::fill_n(N_VGetArrayPointer(differential), f.size(), 0.0);
    std::fill_n(N_VGetArrayPointer(differential), f.states(), 1.0);
    if (m > 0) {
        IDASetId(memory, differential);
        IDASetSuppressAlg(memory, 1);
    }
    IDASetLinearSolver(memory, w.solver, w.matrix);
    IDASetJacFn(memory, [](realtype t, realtype c, N_Vector at, N_Vector with, N_Vector value, SUNMatrix J,
                           void* s, N_Vector, N_Vector, N_Vector) {
        return static_cast<Implicit*>(s)->jacobian(t, c, N_VGetArrayPointer(at), N_VGetArrayPointer(with),
                                                   N_VGetArrayPointer(value), SUNDenseMatrix_Data(J));
    });
    IDASetStopTime(memory, options.start + options.duration);
    if (options.longest_step > 0) IDASetMaxStep(memory, options.longest_step);
    const auto count = [memory](int (*of)(void*, long*)) {
        return [memory, of] {
            long number = 0;
            of(memory, &number);
            return number;
        };
    };
    f.here = initial;
    const Stepping by{.name = "ida",
                      .step =
                          [&](double& t) {
                              const int flag = IDASolve(memory, options.start + options.duration, &t, w.y, w.slope,
                                                        IDA_ONE_STEP);
                              if (flag < 0) return flag;
                              std::copy_n(N_VGetArrayPointer(w.y), f.states(), f.here.begin());
                              if (options.project)
                                  // Projects the state that is reported; IDA goes on from its own.
                                  options.project(t, f.here.data());
                              return flag;
                          },
                      .state = [&] { return f.here.data(); },
                      .at =
                          [&](double t, double* state) {
                              IDAGetDky(memory, t, 0, w.between);
                              std::copy_n(N_VGetArrayPointer(w.between), f.states(), state);
                          },
                      .steps = count(IDAGetNumSteps),
                      .rejected = count(IDAGetNumErrTestFails),
                      .meaning = [](int flag) { return flag_name(IDAGetReturnFlagName(flag)); }};
    Trajectory motion = Collected(f.system, initial, by, events).go();
    N_VDestroy(differential);
    IDAFree(&memory);
    return motion;
}

const Backend backend{.version = backend_version,
                      .cvode = [](const Module&, const std::vector<double>&) -> Integrator { return by_cvode; },
                      .ida = [](const Module& module, const std::vector<double>& parameters) -> Integrator {
                          return [module, par = prepared(module, parameters)](
                                     const Rhs& rhs, const std::vector<double>& initial, const Options& options,
                                     const Events& events) {
                              return by_ida(module, par, rhs, initial, options, events);
                          };
                      }};

}  // namespace

}  // namespace alembert

extern "C" __attribute__((visibility("default"))) const alembert::Backend* alembert_backend() {
    return &alembert::backend;
}
