// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Notices steps that pass a feature of a long table at once, such as a narrow pulse.
///
///     TableWatch watch(program, parameters);
///     watch(t, state);                   // at the end of each step, in order
///     if (watch.passed()) …              // "f near 5.3, at t = 4.3"
///
/// The knots of short tables are seen each by itself (TabulatedFunction::tells_knots). Those of long ones that one
/// step passes are compared with the cubic through four values of the table in it, as inputs over the time are
/// (program/lower/quick_times.hpp): a method of high order sees no more of it. Where a step comes to knots over
/// the state that are closer than it is long, its stages may have been beyond them, although it ends at the first.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "program/program.hpp"
#include "program/tape.hpp"

namespace alembert {

class TableWatch {
public:
    TableWatch(const Program& program, const std::vector<double>& parameters);

    /// Whether there is a table over the state to look at.
    static bool has_work(const Program& program);

    void operator()(double t, std::span<const double> state);
    /// The next state does not follow from the last one.
    void jump() { before_.clear(); }

    struct Passed {
        std::string table;
        double near, time;
    };
    const std::optional<Passed>& passed() const { return passed_; }
    static std::string text_of(const Passed& passed);

private:
    struct Call {
        std::string name;
        std::shared_ptr<const TabulatedFunction> table;
        std::size_t first, count;     ///< of its arguments in the tape
        double range;                 ///< between its smallest and its largest value
        std::array<double, 2> close;  ///< knots along an argument that are no more apart; 0 where all are seen
    };
    void look(const Call& call, double t);

    std::vector<Call> calls_;
    std::optional<Tape<double>> tape_;
    std::size_t coordinates_;
    std::vector<double> before_, now_;
    std::optional<Passed> passed_;
};

}  // namespace alembert
