// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/pipeline.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "analysis/assemble.hpp"
#include "analysis/audit.hpp"
#include "analysis/diagnose.hpp"
#include "analysis/gimbal.hpp"
#include "analysis/inertia_check.hpp"
#include "analysis/redundancy.hpp"
#include "analysis/speeds.hpp"
#include "formalism/elements.hpp"
#include "formalism/formalisms.hpp"
#include "formalism/joint_tree.hpp"
#include "formalism/recursive.hpp"
#include "lower/lower.hpp"

namespace alembert {

double process_seconds() {
    double seconds = 0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        for (const timeval& part : {usage.ru_utime, usage.ru_stime})
            seconds += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
    }
    return seconds;
}

namespace {

/// The formalism of that name; without one, the one a teacher would choose.
Equations equations_by(const std::string& name, const Mechanism& mechanism) {
    if (!name.empty()) return formalism(name).derive(mechanism);
    if (!mechanism.speeds.empty() && mechanism.unilateral.empty() && masses_are_known(mechanism)) return formalism("kane").derive(mechanism);
    return formalism(mechanism.constraints.empty() ? "lagrange" : "routh").derive(mechanism);
}

constexpr int many_pairs = 128;  // of bodies above each other: 16 in a row
constexpr int most_with_matrix = 80;  // joints; of more, M would be most of what is derived, emitted and compiled

/// Nothing where other equations may be faster. M has an element for each joint and each one above it, which are as many operations for
/// all formalisms but articulated bodies.
std::optional<Equations> recursive_for_large_trees(const Mechanism& m, Use use) {
    if (!m.speeds.empty() || !m.constraints.empty() || !m.unilateral.empty() || m.size() * (m.size() + 1) / 2 < many_pairs || !masses_are_known(m)) return {};
    try {
        const JointTree tree = joint_tree(m);
        std::vector<int> depth;
        int pairs = 0;
        for (const TreeJoint& joint : tree.joints) {
            depth.push_back(joint.link.parent < 0 ? 1 : depth[static_cast<std::size_t>(joint.link.parent)] + 1);
            pairs += depth.back();
        }
        if (pairs < many_pairs) return {};
        if (use == Use::run && static_cast<int>(tree.joints.size()) > most_with_matrix) return recursive_without_matrix(m);
        return formalism("recursive").derive(m);
    } catch (const ModelError&) {  // it does not apply
        return {};
    }
}

/// Constraints that no state obeys are told by name; initial values that break some are for those to tell who need them.
void refuse_contradiction(const Mechanism& m) {
    if (m.constraints.empty()) return;
    Start start = start_of(m);
    try {
        assemble(start, m, lower_constraints(m), {});
    } catch (const std::runtime_error&) {
        const Audit found = audit_of(m);
        if (found.contradictory.size() > 1) throw ModelError(found.problem);
    }
}

/// R_<constraint>_<coordinate> as outputs.
void add_reactions(Mechanism& m) {
    for (const Mechanism::Constraint& c : m.constraints)
        for (int i = 0; i < m.size(); ++i)
            if (!c.row[i].is_zero())
                m.outputs.push_back({fmt::format("R_{}_{}", c.name, m.q[i].get_name()), m.z->name(c.row[i] * c.multiplier)});
}

}  // namespace

void check_bodies(const Scene& scene, const Mechanism& mechanism, const Overrides& overrides) {
    if (mechanism.masses.empty()) return;
    std::vector<Diagnostic> errors, warnings;
    for (Diagnostic& found : InertiaCheck(scene, mechanism).findings(start_of(mechanism, overrides).state()))
        (found.severity == Severity::warning ? warnings : errors).push_back(std::move(found));
    if (!warnings.empty()) std::cerr << describe(scene, warnings);
    if (!errors.empty()) fail(scene, std::move(errors));
}

Derived derived(const Request& request, Use use) {
    const double start = process_seconds();
    Scene scene = read_scene(request.scene);
    if (!scene.warnings.empty()) std::cerr << describe(scene, scene.warnings);
    Mechanism mechanism = build(scene);
    check_bodies(scene, mechanism, overrides_of(request));
    const std::vector<int> redundant = redundant_constraints(mechanism);
    check_implied(mechanism, redundant);
    for (const int k : redundant) {
        const Mechanism::Constraint& c = mechanism.constraints[k];
        if (c.closes_loop) continue;
        if (std::any_of(scene.rolling.begin(), scene.rolling.end(), [&](const RollingRule& r) { return r.name.place == c.place; }))
            continue;  // a rolling has three rows, of which one may well follow from where the body is; `audit` tells it
        std::cerr << describe(scene, {{c.place,
                                       fmt::format("constraint '{}' follows from the others; its equation is left "
                                                   "out, and the reactions of all are the least that keep them",
                                                   c.name),
                                       Severity::warning}});
    }
    mechanism = without_constraints(std::move(mechanism), redundant);
    refuse_contradiction(mechanism);
    if (request.reactions) add_reactions(mechanism);
    if (const std::optional<Diagnostic> mistake = mistake_in_speeds(mechanism)) fail(scene, {*mistake});
    std::optional<Equations> at_once;
    if (use != Use::shown && request.by.empty()) at_once = recursive_for_large_trees(mechanism, use);
    Equations equations = at_once ? *std::move(at_once) : equations_by(request.by, mechanism);
    if (mechanism.speeds.empty() && !equations.poles.empty())
        std::cerr << "warning: the rates that remain when the nonholonomic constraints are solved do not determine the others at "
                     "every pose, and numbers lose accuracy near such poses; give the scene generalized speeds, [speeds]\n";
    return {std::move(scene), std::move(mechanism), std::move(equations), process_seconds() - start};
}

Derived derived_again(const Derived& d, Mechanism mechanism, const std::string& by) {
    const double start = process_seconds();
    Equations equations = equations_by(by, mechanism);
    return {d.scene, std::move(mechanism), std::move(equations), process_seconds() - start};
}

void need_rates(const Derived& d) {
    if (!d.equations.h.empty())
        throw ModelError("contacts are followed in coordinates and their rates, and impulses of events in these or the scene's own speeds; leave out --by kane, or "
                         "take --by routh");
}

Choice lowered(const Derived& d, const Request& request) {
    std::vector<Equations> all{d.equations};
    // Where the user leaves the choice, the recursions compete.
    if (request.by.empty() && d.equations.h.empty() && !d.equations.tree) {
        try {
            all.push_back(formalism("recursive").derive(d.mechanism));
        } catch (const ModelError&) {  // it does not apply
        }
    }
    return choose(d.mechanism, all, {.fold = request.fold});
}

std::optional<std::string> failure_at(const Derived& d, const State<double>& state) {
    if (auto lock = gimbal_lock(d.scene, d.mechanism, state)) return lock;
    LowerOptions options;
    if (d.equations.M.rows() == 0) options.recursion = RecursionForm{.solve = RecursionForm::Solve::articulated};
    const Program program = lower(d.mechanism, d.equations, energy_of(d.mechanism), options);
    if (const auto combination = massless_combination(program, state))
        return fmt::format("no inertia resists {}: the mass matrix is singular; give it a mass, or remove a coordinate",
                           *combination);
    if (auto lost = lost_rank(program, state, d.equations.kept(d.mechanism))) return lost;
    return not_finite(program, state, program.singular ? "forcing" : "acceleration");
}

Overrides overrides_of(const Request& request) {
    Overrides result;
    for (const std::string& item : request.at) {
        const std::size_t equals = item.find('=');
        std::size_t used = 0;
        double value = 0;
        try {
            value = std::stod(item.substr(equals + 1), &used);
        } catch (const std::exception&) {
            used = 0;
        }
        if (equals == std::string::npos || equals == 0 || used == 0 || used != item.size() - equals - 1)
            throw ModelError(fmt::format("--at {}: expected NAME=VALUE with a number, as in --at theta1=0.3", item));
        result.emplace_back(item.substr(0, equals), value);
    }
    return result;
}

void write_file(const std::string& path, const std::string& text) {
    const std::string beside = fmt::format("{}.{}.part", path, getpid());
    {
        std::ofstream out(beside, std::ios::binary);
        out << text;
        out.flush();
        if (!out) {
            const std::string reason = std::strerror(errno);
            std::error_code ignored;
            std::filesystem::remove(beside, ignored);
            throw CompileError(fmt::format("cannot write '{}': {}", path, reason));
        }
    }
    std::error_code failed;
    std::filesystem::rename(beside, path, failed);
    if (failed) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        throw CompileError(fmt::format("cannot write '{}': {}", path, failed.message()));
    }
}

Json by_coordinate(const Program& program, const double* values) {
    Json object = Json::object();
    for (std::size_t i = 0; i < program.coordinates.size(); ++i) object[program.coordinates[i].name] = values[i];
    return object;
}

}  // namespace alembert
