// SPDX-License-Identifier: MIT
#include "alembert/ode/event_code.hpp"

namespace alembert {

Bounds bounds_of(const std::vector<EventInstruction>& event, const double* parameters,
                 const MotionBounds& motion) {
    using Op = EventInstruction::Op;
    std::vector<Bounds> value;
    value.reserve(event.size());
    const auto constant = [](double x) { return Bounds{{x, x}, {}, {}}; };
    for (const EventInstruction& step : event) {
        const auto arg = [&](std::size_t k) -> const Bounds& {
            return value[static_cast<std::size_t>(step.terms[k].arg)];
        };
        Bounds result;
        // clang-format off
        switch (step.op) {
            case Op::number: result = constant(step.number); break;
            case Op::parameter: result = constant(parameters[step.index]); break;
            case Op::time: result = motion.time; break;
            case Op::state: result = motion.state(step.index); break;
            case Op::rate: result = motion.rate(step.index); break;
            case Op::sum:
                result = constant(step.number);
                for (std::size_t k = 0; k < step.terms.size(); ++k) result = result + step.terms[k].factor * arg(k);
                break;
            case Op::product:
                for (std::size_t k = 0; k < step.terms.size(); ++k) {
                    const Bounds factor = power(arg(k), step.terms[k].exponent);
                    result = k == 0 ? factor : result * factor;
                }
                break;
            case Op::inverse: result = inverse(arg(0)); break;
            case Op::sin: result = sin(arg(0)); break;
            case Op::cos: result = cos(arg(0)); break;
            case Op::tan: result = tan(arg(0)); break;
            case Op::asin: result = asin(arg(0)); break;
            case Op::acos: result = acos(arg(0)); break;
            case Op::atan: result = atan(arg(0)); break;
            case Op::sinh: result = sinh(arg(0)); break;
            case Op::cosh: result = cosh(arg(0)); break;
            case Op::tanh: result = tanh(arg(0)); break;
            case Op::exp: result = exp(arg(0)); break;
            case Op::log: result = log(arg(0)); break;
            case Op::sqrt: result = sqrt(arg(0)); break;
            case Op::abs: result = abs(arg(0)); break;
            case Op::sign: result = sign(arg(0)); break;
            case Op::pow: result = pow(arg(0), arg(1)); break;
            case Op::atan2: result = atan2(arg(0), arg(1)); break;
            case Op::min: result = least_of(arg(0), arg(1)); break;
            case Op::max: result = -1.0 * least_of(-1.0 * arg(0), -1.0 * arg(1)); break;
            case Op::side: result = step.table->side_bounds(step.index, arg(0)); break;
        }
        // clang-format on
        value.push_back(result);
    }
    return value.back();
}

EventBounds bounds_of(std::shared_ptr<const EventCode> code, std::vector<double> parameters) {
    if (!code) return {};
    return {.exist = [code](int index) { return !code->events[static_cast<std::size_t>(index)].empty(); },
            .of =
                [code, parameters = std::move(parameters)](int index, const MotionBounds& motion) {
                    return bounds_of(code->events[static_cast<std::size_t>(index)], parameters.data(), motion);
                }};
}

}  // namespace alembert
