// SPDX-License-Identifier: MIT
#pragma once

/// Events as lists of instructions, from which bounds on their values and derivatives within a step follow.
///
///     const std::shared_ptr<const EventCode> code = event_code(program);        // program/event_code.hpp
///     Events events = make_events(module, values, stops);
///     events.bounds = bounds_of(code, values);
///
/// An event that this cannot express has no instructions, and no bounds.

#include <functional>
#include <memory>
#include <vector>

#include "alembert/base/interval.hpp"
#include "alembert/base/tabulated_function.hpp"

namespace alembert {

struct EventInstruction {
    enum class Op : unsigned char {
        number,
        parameter,
        time,
        state,
        rate,
        sum,
        product,
        inverse,
        sin,
        cos,
        tan,
        asin,
        acos,
        atan,
        sinh,
        cosh,
        tanh,
        exp,
        log,
        sqrt,
        abs,
        sign,
        pow,
        atan2,
        min,
        max,
        side,  ///< the side function `index` of a table
    };         // clang-format would put each on a line of its own
    struct Term {
        int arg;            ///< an earlier instruction
        double factor = 1;  ///< in a sum
        int exponent = 1;   ///< in a product
    };
    Op op;
    int index = 0;      ///< of a parameter, or of a component of the state; the order of a side function
    double number = 0;  ///< the number, or the constant of a sum
    std::vector<Term> terms = {};
    std::shared_ptr<const TabulatedFunction> table = {};
};

struct EventCode {
    /// For each event its own instructions; the last one is the event.
    std::vector<std::vector<EventInstruction>> events;
};

/// A piece of a motion: time, and the components of the state and of y' that an event needs.
struct MotionBounds {
    Bounds time;
    std::function<Bounds(int component)> state, rate;
};

/// The bounds of event `index` on a piece of the motion, which must be those of an event that has bounds.
struct EventBounds {
    std::function<bool(int index)> exist = {};
    std::function<Bounds(int index, const MotionBounds& motion)> of = {};

    bool has(int index) const { return exist && exist(index); }
};

Bounds bounds_of(const std::vector<EventInstruction>& event, const double* parameters, const MotionBounds& motion);

/// `parameters` are those that the program has, held ones among them.
EventBounds bounds_of(std::shared_ptr<const EventCode> code, std::vector<double> parameters);

}  // namespace alembert
