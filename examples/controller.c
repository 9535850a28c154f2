/* SPDX-License-Identifier: MIT
   A controller's program in C99: no allocation, no library but libm. It moves the trolley of a crane by 2 m so that the
   load hangs still at the end. The function that a timer's interrupt calls every 5 ms sets the force, which the emitted
   equations take as an input from outside; they predict the motion as a model in a controller would. */
#include <math.h>
#include <stdio.h>

#include "crane.h"

enum { states = crane_state };

static double state[states], par[crane_par], inputs[crane_inputs]; /* the force F is the only input */

static void rk4_step(double h) {
    double k[4][states], at[states];
    static const double part[4] = {0, 0.5, 0.5, 1};
    for (int stage = 0; stage < 4; ++stage) {
        for (int i = 0; i < states; ++i) at[i] = state[i] + (stage > 0 ? part[stage] * h * k[stage - 1][i] : 0);
        crane_rhs(0, at, par, inputs, k[stage]);
    }
    for (int i = 0; i < states; ++i) state[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

static void on_timer(void) {
    const double x = state[0], theta = state[1], v = state[2], turn = state[3];
    inputs[0] = 80 * (2 - x) - 180 * v + 450 * theta - 100 * turn;
    rk4_step(0.005);
}

int main(void) {
    crane_defaults(par);
    for (int step = 0; step < 6000; ++step) on_timer();
    printf("the trolley is %.3f m from its goal, the rope %.3f rad from the vertical\n", fabs(2 - state[0]), fabs(state[1]));
    return fabs(2 - state[0]) < 1e-3 && fabs(state[1]) < 1e-3 ? 0 : 1;
}
