// SPDX-License-Identifier: GPL-2.0-or-later
// GSL's explicit pairs of order 8 (Prince & Dormand) and 5 (Fehlberg), and its Adams method.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "peers.hpp"

namespace alembert::peers {

namespace {

struct Calls {
    const Rhs* rhs;
    long count = 0, budget;
};

int rate(double t, const double y[], double out[], void* data) {
    auto& calls = *static_cast<Calls*>(data);
    if (++calls.count > calls.budget) return GSL_EBADFUNC;
    (*calls.rhs)(t, y, out);
    return GSL_SUCCESS;
}

Answer solve(const Task& task, const gsl_odeiv2_step_type* type) {
    gsl_set_error_handler_off();
    Calls calls{&task.rhs, 0, task.budget};
    gsl_odeiv2_system system{rate, nullptr, task.initial.size(), &calls};
    gsl_odeiv2_driver* const driver = gsl_odeiv2_driver_alloc_y_new(&system, type, (task.end - task.start) * 1e-6,
                                                                    task.tolerance, task.tolerance);
    Answer answer{.failed = false, .state = task.initial, .evaluations = 0, .steps = 0};
    double t = task.start;
    answer.failed =
        driver == nullptr || gsl_odeiv2_driver_apply(driver, &t, task.end, answer.state.data()) != GSL_SUCCESS;
    answer.evaluations = calls.count;
    if (driver != nullptr) {
        answer.steps = static_cast<long>(driver->n);
        gsl_odeiv2_driver_free(driver);
    }
    return answer;
}

}  // namespace

std::vector<Peer> gsl() {
    return {{"gsl", "rk8pd", [](const Task& task) { return solve(task, gsl_odeiv2_step_rk8pd); }},
            {"gsl", "rkf45", [](const Task& task) { return solve(task, gsl_odeiv2_step_rkf45); }},
            {"gsl", "msadams", [](const Task& task) { return solve(task, gsl_odeiv2_step_msadams); }}};
}

}  // namespace alembert::peers
