// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The rows of a run, for its CSV file and for plots.

#include "analysis/reaction/joint_reactions.hpp"
#include "simulate/loaded_modes.hpp"

namespace alembert {

/// A table of numbers, row by row.
struct MotionTable {
    std::vector<std::string> columns;
    std::vector<double> values;  ///< rows() · columns.size()

    std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
    double at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
};

/// t, coordinates, rates (theta1'), first-order states, multipliers of constraints, then of unilateral contacts (0
/// while open), energy, outputs, the scene's own speeds and, if `reactions` is not null, JOINT.fx … JOINT.mz.
std::vector<std::string> row_columns(const Mechanism& mechanism, const Program& program,
                                     const JointReactions* reactions);

/// Throws ModelError for a name that is no column; the message has the nearest name and all others.
void check_columns(const std::vector<std::string>& columns, const std::vector<std::string>& wanted);
/// Throws SceneError, with their places, for names that events of the scene record and that are no columns.
void check_recorded(const Scene& scene, const std::vector<std::string>& columns);

/// The table with these columns. If rates jump, there are two rows for the same time, before and after; if only
/// the equations change, there is one. Reactions are evaluated with the parameters of `first`.
MotionTable rows_of(const HybridMotion& motion, const Derived& derived, LoadedModes& modes,
                    const JointReactions* reactions, const State<double>& first);

/// Whether an event of the scene tells values.
bool has_records(const Mechanism& mechanism);

/// The table of the same columns with a row for each event, in the order of the motion, in the state before it.
MotionTable rows_at_events(const HybridMotion& motion, const Derived& derived, LoadedModes& modes,
                           const JointReactions* reactions, const State<double>& first);

/// An event whose expression has a value at a row of a run and none at the next: it ends between these times,
/// perhaps without a zero, and nothing is found from there on.
struct EndedEvent {
    std::string name;
    double last, first_without;
};
/// What is told of it.
std::string warning_of_end(const std::string& event, double last, double first_without);
std::vector<EndedEvent> ended_events(const HybridMotion& motion, const Mechanism& mechanism, LoadedModes& modes);

}  // namespace alembert
