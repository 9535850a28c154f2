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
    const auto sign = readable_sign(mechanism.z->expand(positive), *mechanism.symbols);
    return sign ? text(sign->of) + ' ' + sign->words : say("a root of the claim") + " > 0";
}

}  // namespace alembert
