// SPDX-License-Identifier: MIT
#include "rivals.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace alembert::bench {

namespace {

Vector vector_of(const nlohmann::json& list) {
    return {list.at(0), list.at(1), list.at(2)};
}

/// N uniform rods of mass and length 1 that hang along −z and turn about y, each against the one before.
Tree chain(int n) {
    Tree tree{.name = "pend" + std::to_string(n), .gravity = {0, 0, -9.81}, .bodies = {}, .tau = {}};
    for (int i = 0; i < n; ++i)
        tree.bodies.push_back({.parent = i - 1,
                               .R = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                               .p = {0, 0, i == 0 ? 0. : -1.},
                               .axis = {0, 1, 0},
                               .mass = 1,
                               .com = {0, 0, -0.5},
                               .inertia = {1. / 12, 0, 0, 1. / 12, 0, 1e-4}});
    return tree;
}

}  // namespace

std::optional<Tree> tree_of(const std::string& name, const std::string& folder) {
    if (name.starts_with("pend") && name.size() > 4 &&
        name.find_first_not_of("0123456789", 4) == std::string::npos) {
        Tree tree = chain(std::stoi(name.substr(4)));
        tree.tau.assign(tree.bodies.size(), 0.0);
        return tree;
    }
    const std::string path = folder + "/" + name + ".json";
    if (!std::filesystem::exists(path)) return std::nullopt;
    const nlohmann::json system = nlohmann::json::parse(std::ifstream(path));
    Tree tree{
        .name = name, .gravity = vector_of(system.at("gravity")), .bodies = {}, .tau = system.at("ref").at("tau")};
    for (const nlohmann::json& b : system.at("bodies")) {
        TreeBody body{.parent = b.at("parent"),
                      .R = {},
                      .p = vector_of(b.at("p")),
                      .axis = vector_of(b.at("axis")),
                      .mass = b.at("mass"),
                      .com = vector_of(b.at("com")),
                      .inertia = b.at("inertia")};
        for (std::size_t row = 0; row < 3; ++row) body.R[row] = vector_of(b.at("R").at(row));
        tree.bodies.push_back(body);
    }
    return tree;
}

std::vector<Rival> rivals_of([[maybe_unused]] const Tree& tree) {
    std::vector<Rival> rivals;
#ifdef RIVAL_MUJOCO
    rivals.push_back(mujoco(tree));
#endif
#ifdef RIVAL_BULLET
    rivals.push_back(bullet(tree));
#endif
#ifdef RIVAL_KDL
    rivals.push_back(kdl(tree));
#endif
#ifdef RIVAL_DART
    rivals.push_back(dart(tree));
#endif
#ifdef RIVAL_SIMBODY
    rivals.push_back(simbody(tree));
#endif
    return rivals;
}

}  // namespace alembert::bench
