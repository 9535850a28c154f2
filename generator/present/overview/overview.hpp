// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Everything that the program can say about one scene: its derivation, the verdicts on its claims, the agreement
/// of the formalisms, its constraints, its figure, its motion and its C++.
///
///     const Overview all = overview(read_scene("scenes/textbook/double_pendulum.toml"));
///     all.derived.value->shown.equations;
///     all.motion.problem;                 // why there is none, where the numbers failed
///
/// If a part fails, the reason is kept, and the other parts are still there.

#include <optional>

#include "analysis/agree/agree.hpp"
#include "analysis/audit/audit.hpp"
#include "analysis/contact/impact.hpp"
#include "analysis/derive/derive.hpp"
#include "check/check.hpp"
#include "present/figure/drawing.hpp"
#include "simulate/bench.hpp"
#include "simulate/emission.hpp"
#include "simulate/simulate.hpp"
#include "stability/equilibrium/equilibria.hpp"
#include "stability/stability.hpp"

namespace alembert {

/// A value, or the reason why there is none.
template <typename T>
struct PartOfOverview {
    std::optional<T> value = {};
    std::string problem = {};
    bool was_asked = true;
};

struct OverviewOptions {
    std::string by = {};  ///< a formalism; if empty, the program chooses
    RunOptions wishes{.budget = 3'000'000};
    bool moves = true;         ///< whether the scene is simulated
    std::string section = {};  ///< of Poincaré: "a = b", expressions of the state
    bool measures = false;     ///< whether every method is measured (simulate/bench.hpp)
};

/// A motion with further values for its rows: poses of the figure, energies, residuals of the constraints.
struct WatchedMotion {
    Run run;
    std::vector<std::size_t> frames = {};  ///< the rows of run.rows that have a pose, in order
    std::vector<Pose> poses = {};
    std::vector<double> kinetic = {}, potential = {};  ///< by row; empty if a Lagrangian is given
    std::vector<std::string> constraints = {};
    std::vector<std::vector<double>> position = {}, velocity = {};  ///< residuals, by constraint, then by row
    std::string section = {};                                       ///< of Poincaré, as it was asked for
    std::vector<std::vector<double>> crossings = {};  ///< coordinates, then rates, where a − b grows through zero
};

/// Equilibria and steady motions, and what `stability` says about each of the first ones.
struct JudgedEquilibria {
    Equilibria found;
    std::vector<std::optional<Stability>> verdicts = {};  ///< by equilibrium
};

struct Overview {
    Scene scene;
    Mechanism mechanism;
    std::vector<std::string> warnings = {};
    State<double> start = {};  ///< the assembled state, or the one that the scene gives
    PartOfOverview<DerivedScene> derived = {};
    PartOfOverview<CheckedScene> checked = {};
    PartOfOverview<Agreed> agreed = {};
    PartOfOverview<Audited> audited = {};
    PartOfOverview<Drawing> drawing = {};
    PartOfOverview<WatchedMotion> motion = {};
    PartOfOverview<Emission> emitted = {};
    PartOfOverview<Struck> struck = {};
    PartOfOverview<JudgedEquilibria> rest = {};
    PartOfOverview<Bench> bench = {};
};

/// Throws SceneError or ModelError if the scene describes no mechanism at all, and ModelError for a section that
/// is no equation of the state.
Overview overview(Scene scene, const OverviewOptions& options = {});

}  // namespace alembert
