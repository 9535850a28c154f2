// SPDX-License-Identifier: GPL-2.0-or-later
// CVODE (Adams with fixed-point iteration, BDF with Newton's method and a Jacobian from differences), ARKODE's
// explicit method of order 8 and IDA on y' − f(t, y) = 0. Both the relative and the absolute tolerance are set,
// which is nearest to tolerance · max(1, |y|).
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cstdio>

#include "peers.hpp"
#include "plugins/sundials_context.hpp"

// What the explicit methods of ARKODE are set and asked by: from SUNDIALS 7.1 on the functions of all its methods.
#if SUNDIALS_VERSION_MAJOR > 7 || (SUNDIALS_VERSION_MAJOR == 7 && SUNDIALS_VERSION_MINOR >= 1)
#define ALEMBERT_ARK(verb) ARKode##verb
#else
#define ALEMBERT_ARK(verb) ERKStep##verb
#endif

namespace alembert::peers {

namespace {

struct Calls {
    const Rhs* rhs;
    long count = 0, budget;
};

int rate(sunrealtype t, N_Vector y, N_Vector out, void* data) {
    auto& calls = *static_cast<Calls*>(data);
    if (++calls.count > calls.budget) return -1;
    (*calls.rhs)(t, N_VGetArrayPointer(y), N_VGetArrayPointer(out));
    return 0;
}

int residual(sunrealtype t, N_Vector y, N_Vector slope, N_Vector out, void* data) {
    if (const int failed = rate(t, y, out, data)) return failed;
    N_VLinearSum(1.0, slope, -1.0, out, out);
    return 0;
}

/// The data that all of them need, freed at the end.
struct Common {
    explicit Common(const Task& task) : calls{&task.rhs, 0, task.budget} {
        const auto n = static_cast<sunindextype>(task.initial.size());
        y = N_VNew_Serial(n, context);
        std::copy(task.initial.begin(), task.initial.end(), N_VGetArrayPointer(y));
        matrix = SUNDenseMatrix(n, n, context);
        solver = SUNLinSol_Dense(y, matrix, context);
    }
    ~Common() {
        SUNLinSolFree(solver);
        SUNMatDestroy(matrix);
        N_VDestroy(y);
        SUNContext_Free(&context);
    }
    Common(const Common&) = delete;
    Common& operator=(const Common&) = delete;

    Answer answer(int flag, long steps) const {
        const double* const state = N_VGetArrayPointer(y);
        return {.failed = flag < 0,
                .state = {state, state + N_VGetLength(y)},
                .evaluations = calls.count,
                .steps = steps};
    }

    Calls calls;
    SUNContext context = quiet_context();
    N_Vector y = nullptr;
    SUNMatrix matrix = nullptr;
    SUNLinearSolver solver = nullptr;
};

Answer cvode(const Task& task, int family) {
    Common common(task);
    void* memory = CVodeCreate(family, common.context);
    CVodeInit(memory, rate, task.start, common.y);
    ALEMBERT_QUIET(CVode, memory);
    CVodeSStolerances(memory, task.tolerance, task.tolerance);
    CVodeSetUserData(memory, &common.calls);
    CVodeSetMaxNumSteps(memory, task.budget);
    CVodeSetStopTime(memory, task.end);
    SUNNonlinearSolver iteration = nullptr;
    if (family == CV_ADAMS) {
        iteration = SUNNonlinSol_FixedPoint(common.y, 0, common.context);
        CVodeSetNonlinearSolver(memory, iteration);
    } else {
        CVodeSetLinearSolver(memory, common.solver, common.matrix);
    }
    sunrealtype reached = 0;
    const int flag = CVode(memory, task.end, common.y, &reached, CV_NORMAL);
    long steps = 0;
    CVodeGetNumSteps(memory, &steps);
    const Answer answer = common.answer(flag, steps);
    CVodeFree(&memory);
    if (iteration != nullptr) SUNNonlinSolFree(iteration);
    return answer;
}

Answer arkode(const Task& task) {
    Common common(task);
    void* memory = ERKStepCreate(rate, task.start, common.y, common.context);
    ALEMBERT_QUIET(ERKStep, memory);
    ALEMBERT_ARK(SetOrder)(memory, 8);
    ALEMBERT_ARK(SStolerances)(memory, task.tolerance, task.tolerance);
    ALEMBERT_ARK(SetUserData)(memory, &common.calls);
    ALEMBERT_ARK(SetMaxNumSteps)(memory, task.budget);
    ALEMBERT_ARK(SetStopTime)(memory, task.end);
    sunrealtype reached = 0;
    const int flag = ALEMBERT_ARK(Evolve)(memory, task.end, common.y, &reached, ARK_NORMAL);
    long steps = 0;
    ALEMBERT_ARK(GetNumSteps)(memory, &steps);
    const Answer answer = common.answer(flag, steps);
    ALEMBERT_ARK(Free)(&memory);
    return answer;
}

Answer ida(const Task& task) {
    Common common(task);
    N_Vector slope = N_VClone(common.y);
    rate(task.start, common.y, slope, &common.calls);
    void* memory = IDACreate(common.context);
    IDAInit(memory, residual, task.start, common.y, slope);
    ALEMBERT_QUIET(IDA, memory);
    IDASStolerances(memory, task.tolerance, task.tolerance);
    IDASetUserData(memory, &common.calls);
    IDASetMaxNumSteps(memory, task.budget);
    IDASetStopTime(memory, task.end);
    IDASetLinearSolver(memory, common.solver, common.matrix);
    sunrealtype reached = 0;
    const int flag = IDASolve(memory, task.end, &reached, common.y, slope, IDA_NORMAL);
    long steps = 0;
    IDAGetNumSteps(memory, &steps);
    const Answer answer = common.answer(flag, steps);
    IDAFree(&memory);
    N_VDestroy(slope);
    return answer;
}

}  // namespace

std::vector<Peer> sundials() {
    return {{"cvode", "adams", [](const Task& task) { return cvode(task, CV_ADAMS); }},
            {"cvode", "bdf", [](const Task& task) { return cvode(task, CV_BDF); }},
            {"arkode", "erk8", arkode},
            {"ida", "bdf", ida}};
}

}  // namespace alembert::peers
