// SPDX-License-Identifier: MIT
// The second route: the equations and integrals that the scenes' authors derived by hand, which the scenes carry
// as claims, hold with the accelerations that the program derives, at random states.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include "analysis/state/assemble.hpp"
#include "analysis/state/prepared.hpp"
#include "model/formalism/routh.hpp"
#include "program/lower/choose.hpp"
#include "scenes.hpp"

namespace generator_claims {

using namespace alembert;

namespace {

/// The largest |lhs − rhs| over the sum of the sizes of its terms, at 32 random states, for each claim that speaks
/// of motion: each becomes an output of the scene. A claim of a single term (x'' = 0) is compared with the largest
/// acceleration of the state; −1 if no state could be found for a claim.
std::vector<std::pair<std::string, double>> misfits(const Scene& scene) {
    std::string text = scene.text;
    std::string outputs;
    std::vector<std::string> claims;
    for (const Claim& claim : scene.claims) {
        if (claim.at != Claim::At::motion || !claim.unknowns.empty() || !claim.constants.empty()) continue;
        outputs += fmt::format("claim{} = \"({}) - ({})\"\n", claims.size(), claim.equation.lhs.text,
                               claim.equation.rhs.text);
        claims.push_back(claim.equation.lhs.text + " = " + claim.equation.rhs.text);
    }
    if (const std::size_t table = text.find("[outputs]\n"); table != std::string::npos)
        text.insert(table + 10, outputs);
    else
        text += "\n[outputs]\n" + outputs;
    Mechanism mechanism = prepared(parse_scene(text, scene.file)).mechanism;
    mechanism.q_is_guess.assign(mechanism.q.size(), true);  // random states move to the constraints
    mechanism.qdot_is_guess.assign(mechanism.q.size(), true);
    for (Mechanism::Speed& speed : mechanism.speeds) speed.start.reset();
    const Equations equations = routh(mechanism);
    const Program program = lower(mechanism, equations, energy_of(mechanism));

    const unsigned seed = 1788;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::vector<std::pair<std::string, double>> result;
    for (const std::string& claim : claims) result.emplace_back(claim, -1);
    for (int k = 0; k < 32; ++k) {
        Start start = start_of(mechanism);
        State<double> state = test::random_state(start, random);
        start.t = state.t;
        start.q = state.q;
        start.qdot = state.qdot;
        try {
            assemble(start, mechanism, lower_constraints(mechanism), {});
        } catch (const IntegrationError&) {
            continue;  // no such state near this one
        }
        state = start.state();
        std::vector<double> value = interpret(program, state);
        for (const int id : program.nodes_of(Group::acceleration)) state.qddot.push_back(value[id]);
        value = interpret(program, state);
        std::size_t claim = 0;
        for (const Root& root : program.roots) {
            if (root.group != Group::output || !root.name.starts_with("claim")) continue;
            const Node* node = &program[root.node];
            while (node->is_scaled()) node = &program[node->args[0]];
            double size = 0;
            for (const int arg : node->args) size += std::abs(value[arg]);
            if (node->args.empty())
                for (const double a : state.qddot) size = std::max(size, std::abs(a));
            if (std::isfinite(value[root.node]))
                result[claim].second =
                    std::max(result[claim].second, std::abs(value[root.node]) / std::max(size, 1e-300));
            ++claim;
        }
    }
    return result;
}

}  // namespace

TEST_CASE("generator: the hand derivations in textbook scenes hold") {
    int claims = 0;
    for (const std::string& file : test::scenes_in("scenes/textbook")) {
        CAPTURE(file);
        for (const auto& found : misfits(read_scene(file))) {
            const std::string& claim = found.first;
            const double misfit = found.second;
            CAPTURE(claim);
            // A few dozen roundings in each term; accelerations from a solve with a condition below 10³.
            CHECK(misfit >= 0);
            CHECK(misfit < 1e-11);
            ++claims;
        }
    }
    CHECK(claims >= 150);
}

TEST_CASE("generator: a wrong hand derivation does not hold") {
    Scene scene = read_scene(test::source_path("scenes/textbook/cart_rod.toml"));
    std::string text = scene.text;
    const std::string right = "4*l*phi'' + 3*x''*cos(phi) + 3*g*sin(phi) = 0";
    REQUIRE(text.find(right) != std::string::npos);
    text.replace(text.find(right), right.size(), "4*l*phi'' + 3*x''*cos(phi) - 3*g*sin(phi) = 0");
    const auto result = misfits(parse_scene(text, "wrong.toml"));
    CHECK(result[0].second < 1e-11);
    CHECK(result[1].second > 1e-3);
}

}  // namespace generator_claims
