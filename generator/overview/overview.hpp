// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Everything that the program can say about one scene: its derivation, what became of its claims, whether the
/// formalisms agree, its constraints, its figure, its motion and its C++.
///
///     const Overview all = overview(read_scene("scenes/textbook/double_pendulum.toml"));
///     all.derived.value->shown.equations;
///     all.motion.problem;                 // why there is none, where the numbers failed
///
/// A part that fails keeps its reason, and the others are there all the same.

#include <optional>

#include "agree/agree.hpp"
#include "audit/audit.hpp"
#include "check/check.hpp"
#include "contact/impact.hpp"
#include "derive/derive.hpp"
#include "figure/drawing.hpp"
#include "run/emission.hpp"
#include "run/simulate.hpp"

namespace alembert {

/// A value, or why there is none.
template <typename T>
struct PartOfOverview {
    std::optional<T> value = {};
    std::string problem = {};
    bool was_asked = true;
};

struct OverviewOptions {
    std::string by = {};  ///< a formalism; empty: the program chooses
    RunOptions wishes{.sample = -1, .budget = 3'000'000};
    bool moves = true;  ///< the scene is run
};

/// A motion with what stands beside its rows: poses of the figure, energies, residuals of the constraints.
struct WatchedMotion {
    Run run;
    std::vector<std::size_t> frames = {};  ///< rows of run.rows that have a pose, in order
    std::vector<Pose> poses = {};
    std::vector<double> kinetic = {}, potential = {};  ///< by row; empty where a Lagrangian is given
    std::vector<std::string> constraints = {};
    std::vector<std::vector<double>> position = {}, velocity = {};  ///< residuals, by constraint, then by row
};

struct Overview {
    Scene scene;
    Mechanism mechanism;
    std::vector<std::string> warnings = {};
    State<double> start = {};  ///< assembled, or as the scene gives it
    PartOfOverview<DerivedScene> derived = {};
    PartOfOverview<CheckedScene> checked = {};
    PartOfOverview<Agreed> agreed = {};
    PartOfOverview<Audited> audited = {};
    PartOfOverview<Drawing> drawing = {};
    PartOfOverview<WatchedMotion> motion = {};
    PartOfOverview<Emission> emitted = {};
    PartOfOverview<Struck> struck = {};
};

/// Throws SceneError or ModelError where the scene describes no mechanism at all.
Overview overview(Scene scene, const OverviewOptions& options = {});

}  // namespace alembert
