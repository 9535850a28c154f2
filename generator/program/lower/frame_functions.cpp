// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/frame_functions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/scene_motion.hpp"

namespace alembert {

namespace {

/// What a function computes: its values in the program of `motion`, row by row.
using Values = std::function<std::vector<Symbolic>(SceneMotion& motion)>;

struct Made {
    std::string name, about;
    int rows, columns;
    Values values;
};

FunctionProgram made(const Scene& scene, const Mechanism& mechanism, const Made& function, bool fold) {
    const Mechanism m = with_own_intermediates(mechanism);
    Program program = begun(m, fold);
    SceneMotion motion(program, scene, m, fold);
    std::vector<int> nodes;
    for (const Symbolic& value : function.values(motion)) nodes.push_back(value.node(program));
    return {.name = function.name,
            .about = function.about,
            .rows = function.rows,
            .columns = function.columns,
            .program = with_values_only(std::move(program), nodes)};
}

std::vector<Symbolic> listed(const LinearAngular& v) {
    return {v.linear[0], v.linear[1], v.linear[2], v.angular[0], v.angular[1], v.angular[2]};
}

/// A matrix from its columns.
std::vector<Symbolic> by_rows(const std::vector<std::vector<Symbolic>>& columns) {
    std::vector<Symbolic> result;
    for (std::size_t i = 0; !columns.empty() && i < columns[0].size(); ++i)
        for (const std::vector<Symbolic>& column : columns) result.push_back(column[i]);
    return result;
}

std::vector<Symbolic> pose(SceneMotion& motion, const SceneMotion::Spot& spot) {
    const Matrix<Symbolic> R = motion.rotation(spot.frame);
    const SymbolicVector r = motion.position(spot.point);
    std::vector<Symbolic> result;
    for (std::size_t i = 0; i < 3; ++i) {
        result.insert(result.end(), R[i].begin(), R[i].end());
        result.push_back(r[i]);
    }
    return result;
}

}  // namespace

std::vector<FunctionProgram> frame_functions(const Scene& scene, const Mechanism& mechanism,
                                             const std::string& place, const std::string& prefix, bool fold) {
    const int n = mechanism.size();
    const auto on_spot = [&](const auto& values) {
        return [&place, values](SceneMotion& motion) { return values(motion, motion.spot(place)); };
    };
    using Spot = SceneMotion::Spot;
    const std::vector<Made> list{
        {prefix + "_pose", fmt::format("[R r] of {}: the columns of R are its axes along N.", place), 3, 4,
         on_spot([](SceneMotion& motion, const Spot& spot) { return pose(motion, spot); })},
        {prefix + "_jacobian", fmt::format("J of {}: (v, omega) = J q', along N.", place), 6, n,
         on_spot([n](SceneMotion& motion, const Spot& spot) {
             std::vector<std::vector<Symbolic>> columns;
             for (int k = 0; k < n; ++k) columns.push_back(listed(motion.column(spot, k)));
             return by_rows(columns);
         })},
        {prefix + "_drift", fmt::format("J' q' of {}: (a, alpha) at q'' = 0, along N.", place), 6, 1,
         on_spot([](SceneMotion& motion, const Spot& spot) { return listed(motion.acceleration(spot, false)); })},
        {prefix + "_velocity", fmt::format("(v, omega) of {}, along N.", place), 6, 1,
         on_spot(
             [](SceneMotion& motion, const Spot& spot) { return listed(motion.velocity(spot, motion.rates())); })},
        {prefix + "_acceleration", fmt::format("(a, alpha) of {}, along N.", place), 6, 1,
         on_spot([](SceneMotion& motion, const Spot& spot) { return listed(motion.acceleration(spot, true)); })}};
    std::vector<FunctionProgram> result;
    for (const Made& function : list) result.push_back(made(scene, mechanism, function, fold));
    return result;
}

void check_place(const Scene& scene, const std::string& place) {
    check_spot(scene, place);
}

const std::vector<std::string>& functions_of_masses() {
    static const std::vector<std::string> names{"com", "com_jacobian", "momentum", "centroidal",
                                                "centroidal_drift"};
    return names;
}

bool weighs(const Mechanism& m) {
    return std::any_of(m.masses.begin(), m.masses.end(),
                       [](const MassElement& one) { return !one.mass.is_zero(); });
}

FunctionProgram mass_function(const Scene& scene, const Mechanism& mechanism, const std::string& name, bool fold) {
    if (const auto unknown = masses_unknown(mechanism, say("Functions such as '{}'", name)))
        throw ModelError(*unknown);
    if (!weighs(mechanism))
        throw ModelError(say("the scene has no mass, and so no mass centre; '{}' needs one", name));
    const int n = mechanism.size();
    Made function{.name = name, .about = "The mass centre, along N.", .rows = 3, .columns = 1, .values = {}};
    if (name == "com") {
        function.values = [](SceneMotion& motion) {
            const SymbolicVector c = motion.mass_centre();
            return std::vector<Symbolic>(c.begin(), c.end());
        };
    } else if (name == "com_jacobian") {
        function.about = "J of the mass centre: v = J q', along N.";
        function.columns = n;
        function.values = [n](SceneMotion& motion) {
            std::vector<std::vector<Symbolic>> columns;
            for (int k = 0; k < n; ++k) {
                const SymbolicVector v = Symbolic(1) / motion.whole_mass() * motion.linear_momentum_column(k);
                columns.emplace_back(v.begin(), v.end());
            }
            return by_rows(columns);
        };
    } else if (name == "centroidal") {
        function.about = "A of the momentum A q': linear, then angular about the mass centre, along N.";
        function.rows = 6;
        function.columns = n;
        function.values = [n](SceneMotion& motion) {
            std::vector<std::vector<Symbolic>> columns;
            for (int k = 0; k < n; ++k) columns.push_back(listed(motion.momentum_column(k)));
            return by_rows(columns);
        };
    } else if (name == "centroidal_drift") {
        function.about = "A' q': the derivative of the momentum by time at q'' = 0, along N.";
        function.rows = 6;
        function.values = [](SceneMotion& motion) { return listed(motion.momentum_drift()); };
    } else {
        function.about = "Linear momentum, and angular momentum about the mass centre, along N.";
        function.rows = 6;
        function.values = [](SceneMotion& motion) { return listed(motion.momentum()); };
    }
    return made(scene, mechanism, function, fold);
}

}  // namespace alembert
