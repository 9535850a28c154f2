// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/kinematics/kinematics.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "alembert/base/dense.hpp"
#include "alembert/base/error.hpp"
#include "alembert/base/tolerances.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/formulas.hpp"
#include "program/lower/frame_functions.hpp"
#include "program/lower/lower.hpp"
#include "scene/body_points.hpp"
#include "scene/text.hpp"
#include "scene/used_places.hpp"
#include "simulate/evaluate.hpp"
#include "simulate/given_accelerations.hpp"
#include "simulate/kinematics/frames.hpp"
#include "simulate/kinematics/points.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

void check_names(const std::vector<std::string>& asked, const Scene& scene) {
    std::vector<std::string> known = frames_and_bodies(scene);
    for (const std::string& point : points_of(scene))
        if (std::find(known.begin(), known.end(), point) == known.end()) known.push_back(point);
    if (known.empty())
        throw ModelError(
            say("the scene has no frames, bodies or points, whose motion could be told; expected [[frame]] or "
                "[[point]]"));
    for (const std::string& name : asked) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        const std::string meant = nearest(name, known);
        throw ModelError(say("there is no frame, body or point {}{}; expected one of: {}", in_quotes(name),
                             meant.empty() ? "" : say(" (did you mean '{}'?)", meant), fmt::join(known, ", ")));
    }
}

/// Accelerations that take the given ones and differ least from `others` among those that the constraints allow.
std::vector<double> with_given(const Mechanism& m, State<double> state, const std::vector<double>& others,
                               const std::vector<std::optional<double>>& given) {
    std::vector<double> a = others;
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < a.size(); ++i) given[i] ? void(a[i] = *given[i]) : open.push_back(i);
    if (m.constraints.empty()) return a;
    std::vector<ex> list;
    for (const Mechanism::Constraint& c : m.constraints) {
        list.insert(list.end(), c.row.begin(), c.row.end());
        list.push_back(c.acceleration);
    }
    Program program;
    const std::vector<int> nodes = lower_expressions(program, m, list);
    state.qddot = a;
    const std::vector<double> value = interpret(program, state);
    const auto rows = static_cast<Eigen::Index>(m.constraints.size());
    Eigen::MatrixXd A(rows, static_cast<Eigen::Index>(open.size()));
    Eigen::VectorXd off(rows), size(rows);
    for (Eigen::Index k = 0; k < rows; ++k) {
        const int* row = &nodes[static_cast<std::size_t>(k) * (a.size() + 1)];
        off[k] = value[row[a.size()]];
        size[k] = std::abs(off[k]);
        for (std::size_t i = 0; i < a.size(); ++i) {
            off[k] -= value[row[i]] * a[i];
            size[k] += std::abs(value[row[i]] * a[i]);
        }
        for (std::size_t j = 0; j < open.size(); ++j) A(k, static_cast<Eigen::Index>(j)) = value[row[open[j]]];
    }
    const Eigen::VectorXd change = open.empty() ? Eigen::VectorXd() : Eigen::VectorXd(least_norm(A, off).x);
    for (Eigen::Index k = 0; k < rows; ++k) {
        const double left = off[k] - (open.empty() ? 0 : A.row(k).dot(change));
        if (std::abs(left) > tolerance::balanced_load * std::max(1.0, size[k]))
            throw ModelError(say(
                "the accelerations given break constraint '{}', by {:.3g}; leave some of them out: they follow",
                m.constraints[static_cast<std::size_t>(k)].name, left));
    }
    for (std::size_t j = 0; j < open.size(); ++j) a[open[j]] += change[static_cast<Eigen::Index>(j)];
    return a;
}

/// q'' of the motion, or of what is given.
void find_accelerations(SceneKinematics& s, const KinematicsOptions& options, const State<double>& state) {
    const Mechanism& m = s.mechanism;
    const std::vector<std::optional<double>> given = given_accelerations(options.at, m);
    const bool any = std::any_of(given.begin(), given.end(), [](const auto& a) { return a.has_value(); });
    s.has_masses = !m.kinetic.empty() || m.given_lagrangian;
    std::vector<double> others(m.q.size(), 0);
    if (s.has_masses) try {
            Scene scene = s.scene;
            scene.on_warning = [](const Warning&) {};  // they have been told
            others = evaluate(std::move(scene), {.at = without_accelerations(options.at)}).accelerations;
        } catch (const IntegrationError& e) {
            s.no_accelerations = e.what();
        } catch (const ModelError& e) {
            s.no_accelerations = e.what();
        }
    const bool all = std::all_of(given.begin(), given.end(), [](const auto& a) { return a.has_value(); });
    if (!s.no_accelerations.empty() && !all) return;
    s.no_accelerations.clear();
    s.accelerations = any || !s.has_masses ? with_given(m, state, others, given) : others;
}

template <typename Visit>
void visit_entries(SceneKinematics& s, const Visit& visit) {
    const auto all = [&](auto&... vectors) { (std::for_each(vectors.begin(), vectors.end(), visit), ...); };
    for (FrameKinematics& f : s.frames) {
        for (KinematicVector& axis : f.axes) all(axis);
        all(f.omega.along_N, f.omega.own, f.alpha.along_N, f.alpha.own);
        for (TurnStep& t : f.turns) all(t.axis, t.omega, t.alpha, t.turning);
        if (f.carried) all((*f.carried)[0], (*f.carried)[1], (*f.carried)[2]);
    }
    for (PointKinematics& p : s.points) {
        for (TwofoldVector* v : {&p.position, &p.velocity, &p.acceleration}) all(v->along_N, v->own);
        for (PlaceStep& t : p.places)
            all(t.offset, t.relative_velocity, t.turning_velocity, t.relative, t.tangential, t.centripetal,
                t.coriolis);
    }
}

/// Values of all entries at the state.
void evaluate_entries(SceneKinematics& s, State<double> state) {
    std::vector<ex> list;
    visit_entries(s, [&](KinematicEntry& entry) { list.push_back(entry.expression); });
    Program program;
    const std::vector<int> nodes = lower_expressions(program, s.mechanism, list);
    state.qddot = s.accelerations;
    if (state.qddot.empty()) state.qddot.assign(state.q.size(), std::numeric_limits<double>::quiet_NaN());
    const std::vector<double> value = interpret(program, state);
    auto next = nodes.begin();
    visit_entries(s, [&](KinematicEntry& entry) { entry.value = value[static_cast<std::size_t>(*next++)]; });
    for (FrameKinematics& f : s.frames) {
        Matrix3<double> R;
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 3; ++i)
                R(i, k) = f.axes[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)].value;
        if (R.allFinite()) f.turn = turn_of<double>(R);
    }
}

std::vector<double> values_at(const FunctionProgram& f, const State<double>& state) {
    const std::vector<double> all = interpret(f.program, state);
    std::vector<double> result;
    for (const int node : f.program.nodes_of(Group::function))
        result.push_back(all[static_cast<std::size_t>(node)]);
    return result;
}

std::vector<std::vector<double>> rows_at(const FunctionProgram& f, const State<double>& state) {
    const std::vector<double> all = values_at(f, state);
    std::vector<std::vector<double>> rows;
    for (auto at = all.begin(); at != all.end(); at += f.columns) rows.emplace_back(at, at + f.columns);
    return rows;
}

void find_jacobians(SceneKinematics& s, const State<double>& state) {
    if (s.mechanism.q.empty()) return;
    for (const PointKinematics& p : s.points) {
        PointJacobian found;
        for (const FunctionProgram& f : frame_functions(s.scene, s.mechanism, p.name, "", false)) {
            if (f.name == "_jacobian") found.jacobian = rows_at(f, state);
            if (f.name == "_drift") found.bias = values_at(f, state);
        }
        s.jacobians.emplace_back(p.name, std::move(found));
    }
    if (!weighs(s.mechanism) || masses_unknown(s.mechanism, "")) return;
    const auto function = [&](const char* name) { return mass_function(s.scene, s.mechanism, name, false); };
    const std::vector<double> momentum = values_at(function("momentum"), state);
    const bool has_centre =
        std::all_of(momentum.begin(), momentum.end(), [](double x) { return std::isfinite(x); });
    if (!has_centre) return;  // the masses are parameters with the value 0
    s.mass_centre = MassCentreMotion{.position = values_at(function("com"), state),
                                     .jacobian = rows_at(function("com_jacobian"), state),
                                     .linear_momentum = {momentum.begin(), momentum.begin() + 3},
                                     .angular_momentum = {momentum.begin() + 3, momentum.end()}};
}

}  // namespace

SceneKinematics kinematics(Scene scene, const KinematicsOptions& options) {
    const Overrides at = without_accelerations(options.at);
    if (options.of.empty())
        all_places_are_used(scene);
    else
        are_used(scene, options.of);
    SceneKinematics s{prepared(std::move(scene), at, false, Coordinates::optional)};
    check_names(options.of, s.scene);
    const auto is_wanted = [&](const std::string& name) {
        return options.of.empty() || std::find(options.of.begin(), options.of.end(), name) != options.of.end();
    };
    Start start = start_of(s.mechanism, at);
    s.adjusted = assemble(start, s.mechanism, lower_constraints(s.mechanism), at);
    s.time = start.t;
    s.q = start.q;
    s.rates = start.qdot;
    for (const GiNaC::symbol& q : s.mechanism.q) s.coordinates.push_back(q.get_name());
    find_accelerations(s, options, start.state());

    Formulas formulas(s.scene, s.mechanism);
    VectorWriter write(s.mechanism);
    for (const std::string& name : frames_and_bodies(s.scene))
        if (is_wanted(name))
            s.frames.push_back(frame_kinematics(name, s.scene, formulas.places(), write, options.steps));
    PointWriter point(s.scene, formulas.places(), write);
    for (const std::string& name : points_of(s.scene))
        if (is_wanted(name)) s.points.push_back(point(name, options.steps));
    evaluate_entries(s, start.state());
    if (options.jacobian) find_jacobians(s, start.state());
    return s;
}

}  // namespace alembert
