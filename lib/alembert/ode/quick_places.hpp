// SPDX-License-Identifier: MIT
#pragma once

/// Functions in a right-hand side that change fast in a small region of states and hardly anywhere else, as
/// exp(−((x − 5)/w)²) and tanh(v/w) do, and whether a step has passed over such a region.
///
///     PlaceWatch watch({quick_places_code(program), parameters}, rhs, allowed);      // program/event_code.hpp
///     watch.clear_part(step);                           // 1, or where the next try should end
///
/// A method sees the right-hand side at its stages, a power series sees it at the start of a step; a narrow hill
/// between them leaves no trace, and the estimated error is zero. The states within a step are known, however. So
/// intervals are computed (event_code.hpp) that contain all values which the functions take within the step. Where
/// such an interval holds clearly more than the values at some points of the step, or where the values of
/// neighbouring points differ much, the step is divided; and wherever it is divided, the right-hand side is
/// compared with the slope of the step, at places that follow from the functions and not from the method. A
/// step that differs there has passed over something. Steps in which all functions change little cost one interval
/// of each function and nothing else.
///
/// A region that lies behind the place at which a step is wrong need not be found; that place itself is, since the
/// step is right up to there.

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "alembert/ode/event_code.hpp"
#include "alembert/ode/events.hpp"
#include "alembert/ode/rhs.hpp"

namespace alembert {

struct QuickPlaces {
    /// The functions, each with its own instructions; a function without instructions is not watched. May be null.
    std::shared_ptr<const EventCode> code = {};
    std::vector<double> parameters = {};  ///< as the program has them, held ones among them
};

class PlaceWatch {
public:
    /// The slope of a step times its length may differ from the rates by `allowed` max(1, |y|).
    PlaceWatch(const QuickPlaces& places, const Rhs& rhs, double allowed);

    bool watches() const { return !functions_.empty(); }

    /// Whether all functions change little within a step, as far as the states and rates at its ends tell.
    bool is_mild(const StepView& step) const;

    /// 1 if the step has passed over nothing; otherwise the part of it before the first place that was found at
    /// which its slope is not the rate there. Start and start rate of the step must be known.
    double clear_part(const StepView& step);

    long evaluations() const { return evaluations_; }

private:
    using Function = const std::vector<EventInstruction>*;
    struct Sample {
        double theta = 0, value = 0;  ///< the value of the function that is looked at
        std::vector<double> state;
        bool is_compared = false;
    };
    struct Piece {
        std::array<std::size_t, 5> samples;  ///< their numbers, in the order of time
        Interval values;
        int depth = 0;
    };

    bool is_mild(const StepView& step, Function function) const;
    std::optional<double> look(const StepView& step, Function function);
    std::optional<double> compare(const StepView& step, const Piece& piece);
    std::size_t sample_at(const StepView& step, Function function, double theta);
    void add(const StepView& step, Function function, Piece piece);
    double value(const StepView& step, Function function, const Sample& sample) const;
    Interval enclosure(const StepView& step, Function function, const Piece& piece) const;
    bool keeps(const StepView& step, const Sample& sample);

    const QuickPlaces& places_;
    const Rhs& rhs_;
    double allowed_;
    std::vector<Function> functions_;
    std::vector<double> rate_, before_, here_, after_;
    std::deque<Sample> samples_;
    std::vector<Piece> pieces_;  ///< a heap, the one with the largest change first
    Interval seen_;              ///< the values at the samples
    long evaluations_ = 0;
};

}  // namespace alembert
