// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/overview/overview.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alembert/base/error.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"
#include "simulate/section.hpp"

namespace alembert {

namespace {

constexpr int rows_shown = 480;                // of a motion
constexpr std::size_t poses_shown = 360;       // of a figure
constexpr std::size_t numbers_shown = 30'000;  // the most points times poses, so that the page stays small
constexpr double work_of_agreement = 1e5;      // for normal forms; after that sampling decides
// The most coordinates for which all formalisms are compared and constraints audited.
constexpr int readable_size = 10;

template <typename Make>
auto attempted(const Make& make) {
    PartOfOverview<decltype(make())> part;
    try {
        part.value = make();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        part.problem = error.what();
    }
    return part;
}

template <typename T>
PartOfOverview<T> left_out(const std::string& why) {
    return {.problem = why, .was_asked = false};
}

State<double> start_state(const Mechanism& m) {
    Start start = start_of(m);
    try {
        Start moved = start;
        assemble(moved, m, lower_constraints(m), {}, false);
        return moved.state();
    } catch (const std::exception&) {
        return start.state();
    }
}

State<double> state_of_row(const MotionTable& rows, std::size_t row, State<double> like) {
    const std::size_t n = like.q.size();
    like.t = rows.at(row, 0);
    for (std::size_t k = 0; k < n; ++k) {
        like.q[k] = rows.at(row, 1 + k);
        like.qdot[k] = rows.at(row, 1 + n + k);
    }
    return like;
}

/// Computes T and V on every row.
void watch_energies(WatchedMotion& motion, const Mechanism& m, const State<double>& start) {
    if (m.given_lagrangian) return;
    Program program = begun(m);
    const std::vector<int> nodes = lower_expressions(program, m, {m.kinetic_energy(), m.potential_energy()});
    for (std::size_t row = 0; row < motion.run.rows.rows(); ++row) {
        const std::vector<double> value = interpret(program, state_of_row(motion.run.rows, row, start));
        motion.kinetic.push_back(value[nodes[0]]);
        motion.potential.push_back(value[nodes[1]]);
    }
}

void watch_constraints(WatchedMotion& motion, const Mechanism& m, const State<double>& start) {
    if (m.constraints.empty()) return;
    const Program program = lower_constraints(m);
    const std::vector<int> position = program.nodes_of(Group::position),
                           velocity = program.nodes_of(Group::velocity);
    for (const Mechanism::Constraint& c : m.constraints) motion.constraints.push_back(c.name);
    motion.position.resize(position.size());
    motion.velocity.resize(velocity.size());
    for (std::size_t row = 0; row < motion.run.rows.rows(); ++row) {
        const std::vector<double> value = interpret(program, state_of_row(motion.run.rows, row, start));
        for (std::size_t k = 0; k < position.size(); ++k) motion.position[k].push_back(value[position[k]]);
        for (std::size_t k = 0; k < velocity.size(); ++k) motion.velocity[k].push_back(value[velocity[k]]);
    }
}

void pose(WatchedMotion& motion, Drawing& drawing, const State<double>& start) {
    const std::size_t rows = motion.run.rows.rows();
    const std::size_t most =
        std::clamp(numbers_shown / std::max<std::size_t>(drawing.spots.size(), 1), std::size_t{60}, poses_shown);
    const std::size_t step = std::max<std::size_t>(1, (rows + most - 1) / most);
    for (std::size_t row = 0; row < rows; ++row) {
        const bool jumps = row + 1 < rows && motion.run.rows.at(row, 0) == motion.run.rows.at(row + 1, 0);
        if (row % step != 0 && row + 1 != rows && !jumps) continue;
        const State<double> state = state_of_row(motion.run.rows, row, start);
        Pose pose = pose_at(drawing, state);
        if (!std::all_of(pose.begin(), pose.end(), [](const Eigen::Vector3d& p) { return p.allFinite(); }))
            continue;
        motion.frames.push_back(row);
        motion.poses.push_back(std::move(pose));
    }
    stretch_grounds(drawing, motion.poses);
}

WatchedMotion watched(Overview& all, const OverviewOptions& options) {
    RunOptions wishes = options.wishes;
    wishes.by = options.by;
    if (!wishes.sample) {
        const double duration = wishes.duration.value_or(start_of(all.mechanism).duration);
        const int rows =
            std::clamp(static_cast<int>(numbers_shown) / (2 * std::max(1, all.mechanism.size())), 120, rows_shown);
        if (duration > 0) wishes.sample = duration / rows;
    }
    Scene scene = all.scene;
    if (!options.section.empty()) add_section(scene, all.mechanism, options.section);
    WatchedMotion motion{.run = simulate(std::move(scene), wishes)};
    motion.section = options.section;
    for (const EventRecord& crossing : take_crossings(motion.run)) motion.crossings.push_back(crossing.state);
    watch_energies(motion, all.mechanism, all.start);
    watch_constraints(motion, all.mechanism, all.start);
    if (all.drawing.value && all.drawing.value->obstacle.empty()) pose(motion, *all.drawing.value, all.start);
    return motion;
}

constexpr int equilibria_judged = 6;

/// Only for scenes so small that this takes a second or two.
std::string too_large_to_judge(const Mechanism& m) {
    if (m.size() <= 4 && m.constraints.size() <= 2) return "";
    return say("Left out here, as the scene is large; the program does it when asked: alembert {}",
               "equilibrium, alembert stability");
}

JudgedEquilibria judged(const Scene& scene, const std::string& by) {
    JudgedEquilibria result{equilibria(scene, {.by = by, .starts = 100})};
    const Mechanism& m = result.found.mechanism;
    for (const Equilibrium& one : result.found.list) {
        result.verdicts.emplace_back();
        // Where inertia vanishes, whether numbers are near enough to judge at is a matter of their digits.
        if (result.verdicts.size() > equilibria_judged || one.judgement.singular) continue;
        StabilityOptions options{.by = by};
        const auto give = [&](const std::string& name, double value) {
            options.at.emplace_back(name, value + 0.0);
            options.exact_at.emplace_back(name, fmt::format("{}", value + 0.0));
        };
        for (int i = 0; i < m.size(); ++i) {
            give(m.q[i].get_name(), one.start.q[i]);
            if (m.speeds.empty()) give(m.q[i].get_name() + "'", one.start.qdot[i]);
        }
        try {
            result.verdicts.back() = stability(scene, options);
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception&) {  // the first judgement of `equilibria` stands
        }
    }
    return result;
}

}  // namespace

Overview overview(Scene scene, const OverviewOptions& options) {
    Prepared begun = prepared(std::move(scene));
    Overview all{.scene = std::move(begun.scene), .mechanism = std::move(begun.mechanism)};
    all.warnings = std::move(begun.warnings);
    all.start = start_state(all.mechanism);
    const auto tell = [&](const std::string& what) {
        if (options.wishes.progress) options.wishes.progress(what, 0);
    };
    const Scene& s = all.scene;
    if (Scene unused = s; !options.section.empty())  // throws before anything long is done
        add_section(unused, all.mechanism, options.section);
    const bool is_readable = all.mechanism.size() <= readable_size;
    tell(say("deriving"));
    all.derived = attempted([&] { return derive(s, {.by = options.by}); });
    tell(say("checking claims"));
    all.checked = s.claims.empty() ? left_out<CheckedScene>(say("The scene makes no claims."))
                                   : attempted([&] { return check(s, options.by); });
    tell(say("comparing formalisms"));
    const auto too_large = [](const char* verb) {
        return say("Left out here, as the scene is large; the program does it when asked: alembert {}", verb);
    };
    all.agreed = is_readable ? attempted([&] { return agree(s, work_of_agreement); })
                             : left_out<Agreed>(too_large("agree"));
    tell(say("auditing constraints"));
    all.audited = is_readable ? attempted([&] { return audit(s); }) : left_out<Audited>(too_large("audit"));
    tell(say("looking for equilibria"));
    const std::string too_large_here = too_large_to_judge(all.mechanism);
    all.rest = too_large_here.empty() ? attempted([&] { return judged(s, options.by); })
                                      : left_out<JudgedEquilibria>(too_large_here);
    tell(say("drawing"));
    all.drawing = attempted([&] { return draw(s, all.mechanism); });
    all.struck = s.impulses.empty() && s.generalized_impulses.empty()
                     ? left_out<Struck>(say("The scene has no impulses."))
                     : attempted([&] { return impact(s); });
    all.emitted = attempted([&] { return emission(s, {.by = options.by}); });
    all.motion = options.moves ? attempted([&] { return watched(all, options); })
                               : left_out<WatchedMotion>(say("The scene was not run."));
    if (options.measures) {
        BenchOptions wishes{.wishes = options.wishes};
        wishes.wishes.by = options.by;
        wishes.wishes.sample = {};
        all.bench = attempted([&] { return bench(s, wishes); });
    } else {
        all.bench = left_out<Bench>(say("No methods were measured."));
    }
    return all;
}

}  // namespace alembert
