// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/emission.hpp"

namespace alembert {

Emission emission(Scene scene, const EmissionOptions& options) {
    Emission e{derived(std::move(scene), {.by = options.by, .use = Use::run})};
    e.choice = lowered(e, options.fold);
    if (options.jacobian) {
        e.derivatives = differentiated(e.choice.program, {.parameters = true, .power = true});
        if (!e.derivatives)
            throw ModelError(
                "the derivatives of the right-hand side are too long to be written out; leave the Jacobian out");
    }
    e.source = emit(e.derivatives ? e.derivatives->program : e.choice.program,
                    {.batch = options.batch, .language = options.language});
    return e;
}

}  // namespace alembert
