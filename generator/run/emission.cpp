// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/emission.hpp"

#include "emit/standalone.hpp"
#include "language/say.hpp"
#include "state/assemble.hpp"

namespace alembert {

namespace {

/// The main program supports equations and constraints only.
SourceFile main_program(const Emission& e, const Program& program, CodeLanguage language) {
    const Mechanism& m = e.mechanism;
    if (!m.unilateral.empty() || m.has_kicks() || !program.nodes_of(Group::slip).empty())
        throw ModelError(
            say("a main program beside the equations follows no contacts, dry friction nor events that change the "
                "motion, and this scene has some; use 'alembert simulate', or the library"));
    Start start = start_of(m);
    assemble(start, m, lower_constraints(m), {});
    const State<double> state = state_of(start, m, e.equations);
    StandaloneStart from{.t = state.t, .state = state.q, .duration = start.duration, .tolerance = start.tolerance};
    from.state.insert(from.state.end(), state.qdot.begin(), state.qdot.end());
    return standalone(program, from, language);
}

}  // namespace

Emission emission(Scene scene, const EmissionOptions& options) {
    Emission e{derived(std::move(scene), {.by = options.by, .use = Use::run})};
    e.choice = lowered(e, options.fold);
    if (options.jacobian) {
        e.derivatives = differentiated(e.choice.program, {.parameters = true, .power = true});
        if (!e.derivatives)
            throw ModelError(say(
                "the derivatives of the right-hand side are too long to be written out; leave the Jacobian out"));
    }
    const Program& program = e.derivatives ? e.derivatives->program : e.choice.program;
    e.source = emit(program, {.batch = options.batch, .language = options.language});
    if (options.standalone) e.main = main_program(e, program, options.language);
    return e;
}

}  // namespace alembert
