// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/in_print.hpp"

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "base/language/say.hpp"

namespace alembert {

std::string in_print(const GiNaC::ex& e, const Mechanism& mechanism) {
    const auto f = fourier(e, *mechanism.symbols);
    return f ? text(readable(*f)) : std::string();
}

std::string inequality(const GiNaC::ex& positive, const Mechanism& mechanism) {
    const std::string written = in_print(positive, mechanism);
    return (written.empty() ? say("a root of the claim") : written) + " > 0";
}

}  // namespace alembert
