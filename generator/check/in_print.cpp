// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/in_print.hpp"

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "base/language/say.hpp"

namespace alembert {

using GiNaC::ex;

std::string in_print(const ex& e, const Mechanism& mechanism) {
    const auto f = fourier(e, *mechanism.symbols);
    return f ? text(readable(*f)) : std::string();
}

std::string inequality(const ex& positive, const Mechanism& mechanism) {
    if (const ex opposite = -positive; GiNaC::is_a<GiNaC::symbol>(opposite))
        return in_print(opposite, mechanism) + " < 0";
    const std::string written = in_print(positive, mechanism);
    return (written.empty() ? say("a root of the claim") : written) + " > 0";
}

}  // namespace alembert
