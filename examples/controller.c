/* SPDX-License-Identifier: MIT
   A controller's program in C99: no allocation, no library but libm. It moves the trolley of a crane by 2 m so that the
   load hangs still at the end, and predicts with the emitted equations, as a model in a controller would. */
#include <math.h>
#include <stdio.h>

#include "crane.h"

enum { states = crane_state };

static void rk4_step(double h, double *y, const double *par) {
    double k[4][states], at[states];
    static const double part[4] = {0, 0.5, 0.5, 1};
    for (int stage = 0; stage < 4; ++stage) {
        for (int i = 0; i < states; ++i) at[i] = y[i] + (stage > 0 ? part[stage] * h * k[stage - 1][i] : 0);
        crane_rhs(0, at, par, k[stage]);
    }
    for (int i = 0; i < states; ++i) y[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

int main(void) {
    double y[states] = {0}, par[crane_par];
    const double h = 0.005;
    crane_defaults(par);
    for (int step = 0; step < 6000; ++step) {
        const double x = y[0], theta = y[1], v = y[2], turn = y[3];
        par[4] = 80 * (2 - x) - 180 * v + 450 * theta - 100 * turn; /* F, the fifth parameter */
        crane_prepare(par);
        rk4_step(h, y, par);
    }
    printf("the trolley is %.3f m from its goal, the rope %.3f rad from the vertical\n", fabs(2 - y[0]), fabs(y[1]));
    return fabs(2 - y[0]) < 1e-3 && fabs(y[1]) < 1e-3 ? 0 : 1;
}
