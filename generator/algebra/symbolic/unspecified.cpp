// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/unspecified.hpp"

#include <array>
#include <stdexcept>

namespace alembert {

using GiNaC::ex;

namespace {

/// The function and the pairs of an order and an argument.
GiNaC::exvector operands(const UnspecifiedCall& call) {
    GiNaC::exvector result{call.function};
    for (std::size_t k = 0; k < call.arguments.size(); ++k) {
        result.emplace_back(call.orders[k]);
        result.push_back(call.arguments[k]);
    }
    return result;
}

UnspecifiedCall call_of(const GiNaC::exvector& operands) {
    UnspecifiedCall result{.function = operands[0], .arguments = {}, .orders = {}};
    for (std::size_t k = 1; k < operands.size(); k += 2) {
        result.orders.push_back(GiNaC::ex_to<GiNaC::numeric>(operands[k]).to_int());
        result.arguments.push_back(operands[k + 1]);
    }
    return result;
}

/// GiNaC asks for no derivative by the function or by an order, as these hold no variable.
ex derivative(const GiNaC::exvector& operands, unsigned operand) {
    if (operand == 0 || operand % 2 == 1) return 0;
    return unspecified_value(differentiated_by(call_of(operands), operand / 2 - 1));
}

unsigned serial(std::size_t arguments) {
    static const std::array<unsigned, 4> serials = [] {
        std::array<unsigned, 4> made{};
        for (unsigned n = 0; n < 4; ++n)
            made[n] = GiNaC::function::register_new(
                GiNaC::function_options(unspecified_name, 3 + 2 * n).derivative_func(derivative).overloaded(4));
        return made;
    }();
    if (arguments < 1 || arguments > 4) throw std::invalid_argument("a function has one to four arguments");
    return serials[arguments - 1];
}

}  // namespace

ex unspecified_value(const UnspecifiedCall& call) {
    return GiNaC::function(serial(call.arguments.size()), operands(call));
}

std::optional<UnspecifiedCall> unspecified_call(const ex& e) {
    if (!GiNaC::is_a<GiNaC::function>(e) || GiNaC::ex_to<GiNaC::function>(e).get_name() != unspecified_name)
        return {};
    return call_of(GiNaC::exvector(e.begin(), e.end()));
}

UnspecifiedCall differentiated_by(UnspecifiedCall call, std::size_t argument) {
    ++call.orders.at(argument);
    return call;
}

}  // namespace alembert
