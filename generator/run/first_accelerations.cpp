// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/first_accelerations.hpp"

#include "alembert/error.hpp"
#include "language/say.hpp"
#include "run/held_state.hpp"
#include "state/diagnose.hpp"

namespace alembert {

void need_accelerations(const Derived& derived, const Program& program, State<double> first) {
    first.parameters = with_held_parameters(std::move(first.parameters), program);
    if (program.singular || massless_combination(program, first))
        throw IntegrationError(say("there are no finite accelerations at t = {:.6g}: {}", first.t,
                                   failure_at(derived, first).value_or(say("the mass matrix is singular"))),
                               first.t, first.q);
}

}  // namespace alembert
