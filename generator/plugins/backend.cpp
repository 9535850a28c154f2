// SPDX-License-Identifier: GPL-2.0-or-later
// alembert-sundials.so: see backend.hpp.
#include "backend.hpp"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "alembert/base/dense.hpp"

#include "collected_motion.hpp"
#include "sundials_context.hpp"

namespace alembert {

namespace {

/// Vectors, a matrix and a solver of one size, freed at the end.
struct Workspace {
    explicit Workspace(std::size_t size) {
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

    SUNContext context = quiet_context();
    N_Vector y = nullptr, slope = nullptr, between = nullptr;
    SUNMatrix matrix = nullptr;
    SUNLinearSolver solver = nullptr;
};

/// Sets the weights 1 / (tolerance · max(1, |y|)); quadratures are not controlled.
void weigh(const CountedSystem& system, const double* y, double* weights) {
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

Trajectory by_cvode(const System& given, const std::vector<double>& initial, const Options& options,
                    const Events& events, const RunPiece& piece) {
    CountedSystem system{.given = given, .options = options, .piece = piece};
    Workspace w(initial.size());
    std::copy(initial.begin(), initial.end(), N_VGetArrayPointer(w.y));
    void* memory = CVodeCreate(CV_BDF, w.context);
    CVodeInit(
        memory,
        [](sunrealtype t, N_Vector y, N_Vector out, void* s) {
            return static_cast<CountedSystem*>(s)->rate(t, N_VGetArrayPointer(y), N_VGetArrayPointer(out));
        },
        options.start, w.y);
    ALEMBERT_QUIET(CVode, memory);
    CVodeSetUserData(memory, &system);
    CVodeWFtolerances(memory, [](N_Vector y, N_Vector weights, void* s) {
        weigh(*static_cast<CountedSystem*>(s), N_VGetArrayPointer(y), N_VGetArrayPointer(weights));
        return 0;
    });
    CVodeSetLinearSolver(memory, w.solver, w.matrix);
    if (given.rhs.jacobian != nullptr)
        CVodeSetJacFn(
            memory, [](sunrealtype t, N_Vector y, N_Vector, SUNMatrix J, void* s, N_Vector, N_Vector, N_Vector) {
                auto& own = *static_cast<CountedSystem*>(s);
                own.rhs.jacobian(own.rhs.context.get(), t, N_VGetArrayPointer(y), SUNDenseMatrix_Data(J));
                ++own.evaluations;
                // Parts of a derivative may overflow where the function does not change any more, as 1/(1 +
                // exp(x)).
                std::replace_if(
                    SUNDenseMatrix_Data(J), SUNDenseMatrix_Data(J) + own.size() * own.size(),
                    [](double x) { return !std::isfinite(x); }, 0.0);
                return 0;
            });
    if (given.project) {
        CVodeSetProjFn(memory, [](sunrealtype t, N_Vector y, N_Vector change, sunrealtype, N_Vector, void* s) {
            auto& own = *static_cast<CountedSystem*>(s);
            const double* const from = N_VGetArrayPointer(y);
            own.moved.assign(from, from + own.size());
            own.given.project(t, own.moved.data());
            for (std::size_t i = 0; i < own.size(); ++i) N_VGetArrayPointer(change)[i] = own.moved[i] - from[i];
            return is_finite(own.moved.data(), own.size()) ? 0 : recoverable;
        });
        CVodeSetProjErrEst(memory, 0);
    }
    if (options.longest_step > 0) CVodeSetMaxStep(memory, options.longest_step);
    const auto count = [memory](int (*of)(void*, long*)) {
        return [memory, of] {
            long number = 0;
            of(memory, &number);
            return number;
        };
    };
    const SteppedIntegrator by{.name = "cvode",
                               .step =
                                   [&](double& t, double latest) {
                                       CVodeSetStopTime(memory, latest);
                                       return CVode(memory, latest, w.y, &t, CV_ONE_STEP);
                                   },
                               .restart =
                                   [&](double t) {
                                       CVodeGetDky(memory, t, 0, w.between);
                                       std::copy_n(N_VGetArrayPointer(w.between), system.size(),
                                                   N_VGetArrayPointer(w.y));
                                       return CVodeReInit(memory, t, w.y);
                                   },
                               .state = [&] { return N_VGetArrayPointer(w.y); },
                               .at =
                                   [&](double t, double* state) {
                                       CVodeGetDky(memory, t, 0, w.between);
                                       std::copy_n(N_VGetArrayPointer(w.between), system.size(), state);
                                   },
                               .steps = count(CVodeGetNumSteps),
                               .rejected = count(CVodeGetNumErrTestFails),
                               .meaning = [](int flag) { return flag_name(CVodeGetReturnFlagName(flag)); }};
    Trajectory motion = CollectedMotion(system, initial, by, events).go();
    CVodeFree(&memory);
    return motion;
}

/// F(t, y, y') = 0 in (state, λ, μ).
struct Implicit {
    CountedSystem system;
    const Module& module;
    const std::vector<double>& par;
    bool has_signs;    ///< the accelerations are then those of the Rhs
    std::size_t n, m;  ///< coordinates; independent constraints, which are 0 if the equations are those of the Rhs
    std::vector<double> mass, forcing, off, rows, rate, trial, trial_slope, here, moved;

    std::size_t states() const { return system.size(); }
    std::size_t size() const { return states() + 2 * m; }

    int residual(double t, const double* y, const double* slope, double* out) {
        if (m == 0) {
            if (const int failed = system.rate(t, y, out)) return failed;
            for (std::size_t i = 0; i < states(); ++i) out[i] = slope[i] - out[i];
            return 0;
        }
        if (system.is_over_budget()) return unrecoverable;
        const alembert_solver_table& table = module.table();
        const double *lambda = y + states(), *mu = lambda + m;
        if (has_signs) {
            if (const int failed = system.rate(t, y, rate.data())) return failed;
            for (std::size_t i = 0; i < n; ++i) out[n + i] = slope[n + i] - rate[n + i];
            if (states() > 2 * n) out[2 * n] = slope[2 * n] - rate[2 * n];
        } else {
            newton(t, y, slope, out);
        }
        const std::size_t all = off.size() / 2;
        table.constraints_at(t, y, par.data(), off.data(), off.data() + all, rows.data());
        std::copy_n(off.data(), m, out + states());
        std::copy_n(off.data() + all, m, out + states() + m);
        for (std::size_t i = 0; i < n; ++i) {
            out[i] = slope[i] - y[n + i];
            for (std::size_t k = 0; k < m; ++k) {
                out[i] -= rows[k * n + i] * mu[k];
                out[n + i] -= rows[k * n + i] * lambda[k];
            }
        }
        return is_finite(out, size()) ? 0 : recoverable;
    }

    /// M u' − f, and the rate of the work.
    void newton(double t, const double* y, const double* slope, double* out) {
        ++system.evaluations;
        const alembert_solver_table& table = module.table();
        table.mass_forcing(t, y, par.data(), mass.data(), forcing.data());
        for (std::size_t i = 0; i < n; ++i) {
            out[n + i] = -forcing[i];
            for (std::size_t j = 0; j < n; ++j) out[n + i] += mass[i * n + j] * slope[n + j];
        }
        if (states() == 2 * n) return;
        double energy[4], jacobi = 0;
        std::copy_n(y + n, n, rate.begin());
        std::copy_n(slope + n, n, rate.begin() + static_cast<std::ptrdiff_t>(n));
        table.energy(t, y, rate.data(), par.data(), energy, &jacobi);
        out[2 * n] = slope[2 * n] - energy[3];
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

/// The multipliers of the independent constraints that give the same forces as those of all.
void find_multipliers(const Module& module, double t, const double* y, const double* par, double* lambda) {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const alembert_solver_table& table = module.table();
    Eigen::VectorXd of_all(table.constraints), off(2 * table.constraints);
    Rows rows(table.constraints, table.coordinates);
    table.multipliers_at(t, y, par, of_all.data());
    table.constraints_at(t, y, par, off.data(), off.data() + table.constraints, rows.data());
    const Rows kept = rows.topRows(module.independent_constraints());
    if (kept.rows() < rows.rows()) of_all = least_norm(kept.transpose(), rows.transpose() * of_all).x;
    std::copy_n(of_all.data(), kept.rows(), lambda);
}

/// The emitted functions with their parameters (Backend::ida).
struct EmittedCode {
    Module module;
    bool has_signs;
    std::vector<double> par;
};

Trajectory by_ida(const EmittedCode& code, const System& given, const std::vector<double>& initial,
                  const Options& options, const Events& events, const RunPiece& piece) {
    const auto& [module, has_signs, par] = code;
    const alembert_solver_table& table = module.table();
    const auto n = static_cast<std::size_t>(table.coordinates), all = static_cast<std::size_t>(table.constraints),
               m = static_cast<std::size_t>(module.independent_constraints());
    Implicit f{.system = {.given = given, .options = options, .piece = piece},
               .module = module,
               .par = par,
               .has_signs = has_signs,
               .n = n,
               .m = m,
               .mass = std::vector<double>(n * n),
               .forcing = std::vector<double>(n),
               .off = std::vector<double>(2 * all),
               .rows = std::vector<double>(all * n),
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
    if (m > 0 && !has_signs) find_multipliers(module, options.start, initial.data(), par.data(), y + f.states());

    void* memory = IDACreate(w.context);
    IDAInit(
        memory,
        [](sunrealtype t, N_Vector at, N_Vector with, N_Vector out, void* s) {
            return static_cast<Implicit*>(s)->residual(t, N_VGetArrayPointer(at), N_VGetArrayPointer(with),
                                                       N_VGetArrayPointer(out));
        },
        options.start, w.y, w.slope);
    ALEMBERT_QUIET(IDA, memory);
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
    IDASetJacFn(memory, [](sunrealtype t, sunrealtype c, N_Vector at, N_Vector with, N_Vector value, SUNMatrix J,
                           void* s, N_Vector, N_Vector, N_Vector) {
        return static_cast<Implicit*>(s)->jacobian(t, c, N_VGetArrayPointer(at), N_VGetArrayPointer(with),
                                                   N_VGetArrayPointer(value), SUNDenseMatrix_Data(J));
    });
    if (options.longest_step > 0) IDASetMaxStep(memory, options.longest_step);
    const auto count = [memory](int (*of)(void*, long*)) {
        return [memory, of] {
            long number = 0;
            of(memory, &number);
            return number;
        };
    };
    f.here = initial;
    const SteppedIntegrator by{.name = "ida",
                               .step =
                                   [&](double& t, double latest) {
                                       IDASetStopTime(memory, latest);
                                       const int flag = IDASolve(memory, latest, &t, w.y, w.slope, IDA_ONE_STEP);
                                       if (flag < 0) return flag;
                                       std::copy_n(N_VGetArrayPointer(w.y), f.states(), f.here.begin());
                                       if (given.project)
                                           // Projects the state that is reported; IDA goes on from its own.
                                           given.project(t, f.here.data());
                                       return flag;
                                   },
                               .restart =
                                   [&](double t) {
                                       IDAGetDky(memory, t, 1, w.between);
                                       std::copy_n(N_VGetArrayPointer(w.between), f.size(), slope);
                                       IDAGetDky(memory, t, 0, w.between);
                                       std::copy_n(N_VGetArrayPointer(w.between), f.size(), y);
                                       return IDAReInit(memory, t, w.y, w.slope);
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
    Trajectory motion = CollectedMotion(f.system, initial, by, events).go();
    N_VDestroy(differential);
    IDAFree(&memory);
    return motion;
}

const Backend backend{
    .version = backend_version,
    .cvode = []() -> Integrator { return by_cvode; },
    .ida = [](const Module& module, const std::vector<double>& parameters, bool has_signs) -> Integrator {
        return [code = EmittedCode{module, has_signs, prepared(module, parameters)}](
                   const System& system, const std::vector<double>& initial, const Options& options,
                   const Events& events,
                   const RunPiece& piece) { return by_ida(code, system, initial, options, events, piece); };
    }};

}  // namespace

}  // namespace alembert

extern "C" __attribute__((visibility("default"))) const alembert::Backend* alembert_backend() {
    return &alembert::backend;
}
