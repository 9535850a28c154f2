// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/operational_space.hpp"

#include <fmt/format.h>

#include "base/language/say.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/robot_functions.hpp"
#include "program/lower/scene_motion.hpp"
#include "program/modular.hpp"
#include "program/reduce_rows.hpp"
#include "program/solve.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr std::size_t directions = 6;

/// The lower triangle of a full matrix.
std::vector<int> triangle(const std::vector<int>& full, std::size_t n) {
    std::vector<int> result;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) result.push_back(full[i * n + j]);
    return result;
}

/// J M⁻¹ Jᵀ, row by row.
std::vector<int> mobility(Program& program, const std::vector<int>& mass,
                          const std::vector<std::vector<int>>& rows) {
    const std::size_t n = rows[0].size();
    const auto moved = solve_for_sides(program, triangle(mass, n), rows, 0);
    if (!moved) throw ModelError(say("the mass matrix is singular at every state, so that it has no inverse"));
    std::vector<int> result(directions * directions);
    for (std::size_t i = 0; i < directions; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            std::vector<Program::Term> terms;
            for (std::size_t k = 0; k < n; ++k)
                terms.emplace_back(1, program.product(1, {{rows[j][k], 1}, {(*moved)[i][k], 1}}));
            result[i * directions + j] = result[j * directions + i] = program.sum(0, terms);
        }
    return result;
}

/// Whether J has rank 6 at a random point modulo a prime. Points with square roots may be unusable.
bool moves_in_all_directions(const Program& program, const std::vector<std::vector<int>>& rows) {
    std::vector<int> all;
    for (const std::vector<int>& row : rows) all.insert(all.end(), row.begin(), row.end());
    constexpr std::uint64_t most_tries = 20;
    for (std::uint64_t seed = 1; seed <= most_tries; ++seed) {
        const auto at = evaluate_mod(program, {.seed = seed}, all);
        if (!at) continue;
        std::vector<std::vector<Prime>> J;
        for (const std::vector<int>& row : rows) {
            J.emplace_back();
            for (const int node : row) J.back().push_back(at->value[static_cast<std::size_t>(node)]);
        }
        return reduce_rows(J, rows[0].size()) == static_cast<int>(directions);
    }
    return true;
}

std::vector<int> inverse(Program& program, const std::vector<int>& full) {
    std::vector<std::vector<int>> units;
    for (std::size_t i = 0; i < directions; ++i) {
        units.emplace_back();
        for (std::size_t j = 0; j < directions; ++j) units.back().push_back(program.number(i == j ? 1 : 0));
    }
    const auto columns = solve_for_sides(program, triangle(full, directions), units, 0);
    if (!columns) throw ModelError(say("the mass matrix is singular at every state, so that it has no inverse"));
    std::vector<int> result;
    for (const std::vector<int>& column : *columns) result.insert(result.end(), column.begin(), column.end());
    return result;
}

}  // namespace

const std::vector<std::string>& functions_of_operational_space() {
    static const std::vector<std::string> names{"mobility", "operational_inertia"};
    return names;
}

FunctionProgram operational_function(const Scene& scene, const Mechanism& mechanism, const std::string& place,
                                     const std::string& prefix, const std::string& name, bool fold) {
    if (!mechanism.constraints.empty())
        throw ModelError(say("'{}' is that of a tree of joints, and constraint '{}' holds this scene", name,
                             mechanism.constraints[0].name));
    const bool inverted = name == "operational_inertia";
    const Mechanism m = with_own_intermediates(mechanism);
    Program program = RobotFunctions(m, fold).dynamics("mass").program;
    const std::vector<int> mass = program.nodes_of(Group::function);
    std::vector<std::vector<int>> rows(directions);
    {
        SceneMotion motion(program, scene, m, fold);
        const SceneMotion::Spot spot = motion.spot(place);
        for (int k = 0; k < m.size(); ++k) {
            const LinearAngular column = motion.column(spot, k);
            for (std::size_t i = 0; i < 3; ++i) {
                rows[i].push_back(column.linear[i].node(program));
                rows[3 + i].push_back(column.angular[i].node(program));
            }
        }
    }
    if (inverted && !moves_in_all_directions(program, rows))
        throw ModelError(
            say("{} does not move in all six directions, so that its operational-space inertia does not "
                "exist; ask for 'mobility'",
                in_quotes(place)));
    std::vector<int> values = mobility(program, mass, rows);
    if (inverted) values = inverse(program, values);
    return {.name = prefix + "_" + name,
            .about = inverted ? fmt::format("(J M^-1 J^T)^-1 of {}, along N: linear, then angular.", place)
                              : fmt::format("J M^-1 J^T of {}, along N: linear, then angular.", place),
            .rows = static_cast<int>(directions),
            .columns = static_cast<int>(directions),
            .program = with_values_only(std::move(program), values)};
}

}  // namespace alembert
