// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "analysis/assemble.hpp"
#include "analysis/contacts.hpp"
#include "analysis/diagnose.hpp"
#include "analysis/joint_reactions.hpp"
#include "commands/pipeline.hpp"

namespace alembert {

namespace {

/// {name: value} of a group of roots, or `otherwise` where there is none.
Json named_values(const Program& program, const std::vector<double>& value, const char* group, const Json& otherwise) {
    Json object = Json::object();
    for (const Root& root : program.roots)
        if (root.group == group) object[root.name] = value[root.node];
    return object.empty() ? otherwise : object;
}
constexpr double closed_gap = 1e-9;  // · max(1, |q|), as much as the initial values of a constraint may be off

/// {constraint: {coordinate: force}}
Json reactions_of(const Mechanism& m, const Json& outputs) {
    Json result = Json::object();
    for (const Mechanism::Constraint& c : m.constraints)
        for (const GiNaC::symbol& q : m.q) {
            const std::string output = fmt::format("R_{}_{}", c.name, q.get_name());
            if (outputs.contains(output)) result[c.name][q.get_name()] = outputs[output];
        }
    return result;
}

}  // namespace

int eval(const Request& request) {
    Derived d = derived(request, Use::asked);
    Program program = lowered(d, request).program;
    const Overrides overrides = overrides_of(request);
    Start start = start_of(d.mechanism, overrides);
    const std::vector<std::string> moved = assemble(start, d.mechanism, lower_constraints(d.mechanism), overrides);
    State<double> state = state_of(start, d.mechanism, d.equations);
    std::vector<int> closed;
    if (!d.mechanism.unilateral.empty()) {
        need_rates(d);
        const ContactView view(d.mechanism);
        check_gaps(d.scene, d.mechanism, view, state, closed_gap);
        closed = contacts_at_rest(view, state, closed_gap).closed;
        if (!closed.empty()) {
            d = derived_again(d, with_closed(d.mechanism, closed), "routh");
            program = lowered(d, request).program;
        }
    }

    const auto fails = [&](const Program& p) {
        const std::vector<double> value = interpret(p, state);
        const std::vector<int> wanted = p.nodes_of("acceleration");
        return massless_combination(p, state) ||
               std::any_of(wanted.begin(), wanted.end(), [&](int id) { return !std::isfinite(value[id]); });
    };
    if (fails(program))
        throw IntegrationError(fmt::format("there are no finite accelerations at t = {:.6g}: {}", state.t,
                                           failure_at(d, state).value_or("the numbers overflow")),
                               state.t, start.q);
    std::vector<double> value = interpret(program, state);
    for (const int id : program.nodes_of("acceleration")) state.qddot.push_back(value[id]);
    value = interpret(program, state);  // outputs may hold accelerations
    const auto single = [&](const char* group) { return value[program.nodes_of(group)[0]]; };

    Json result;
    result["time"] = state.t;
    result["coordinates"] = by_coordinate(program, state.q.data());
    const auto group = [&](const char* name) {
        std::vector<double> numbers;
        for (const int id : program.nodes_of(name)) numbers.push_back(value[id]);
        return numbers;
    };
    const bool own_speeds = !program.speeds.empty();
    const std::vector<double> rates = own_speeds ? group("rate") : state.qdot;
    const std::vector<double> accelerations = own_speeds ? group("second_rate") : state.qddot;
    result["rates"] = by_coordinate(program, rates.data());
    result["accelerations"] = by_coordinate(program, accelerations.data());
    result["speeds"] = named_values(program, value, "speed", result["rates"]);
    result["speed_rates"] = named_values(program, value, "speed_rate", result["accelerations"]);
    result["multipliers"] = Json::object();
    for (const Root& root : program.roots)
        if (root.group == "multiplier") result["multipliers"][root.name] = value[root.node];
    for (const Mechanism::Unilateral& contact : d.mechanism.unilateral)
        if (!result["multipliers"].contains(contact.gap.multiplier.get_name()))
            result["multipliers"][contact.gap.multiplier.get_name()] = 0.0;  // open
    result["kinetic"] = single("kinetic");
    result["potential"] = single("potential");
    result["energy"] = single("energy");
    result["residuals"] = Json::object();
    const std::vector<int> position = program.nodes_of("position"), velocity = program.nodes_of("velocity");
    for (std::size_t k = 0; k < position.size(); ++k)
        result["residuals"][d.mechanism.constraints[k].name] = {value[position[k]], value[velocity[k]]};
    if (!d.mechanism.unilateral.empty()) {
        result["closed"] = Json::array();
        for (const int k : closed) result["closed"].push_back(d.mechanism.unilateral[k].gap.name);
    }
    if (!moved.empty()) result["adjusted"] = moved;
    result["outputs"] = Json::object();
    for (const Root& root : program.roots)
        if (root.group == "output") result["outputs"][root.name] = value[root.node];
    std::vector<JointLoad> joint_loads;
    if (request.reactions) {
        result["reactions"] = reactions_of(d.mechanism, result["outputs"]);
        result["joint_reactions"] = Json::object();
        if (!d.mechanism.joints.empty()) joint_loads = joint_reactions(d.scene, d.mechanism).at(program, state);
        for (const JointLoad& load : joint_loads) result["joint_reactions"][load.joint] = {{"force", load.force}, {"moment", load.moment}};
    }
    if (request.json) {
        std::cout << as_text(result);
        return 0;
    }
    std::size_t width = 16;
    for (const Quantity& q : program.coordinates) width = std::max(width, q.name.size() + 1);
    for (const auto& [name, multiplier] : result["multipliers"].items()) width = std::max(width, name.size() + 1);
    for (const JointLoad& load : joint_loads) width = std::max(width, load.joint.size() + 1);
    fmt::print("t = {}\n\n{:<{}}{:>24}{:>24}{:>24}\n", state.t, "", width, "value", "rate", "acceleration");
    for (int i = 0; i < d.mechanism.size(); ++i)
        fmt::print("{:<{}}{:>24.16g}{:>24.16g}{:>24.16g}\n", program.coordinates[i].name, width, state.q[i], rates[i], accelerations[i]);
    for (const Mechanism::Speed& speed : d.mechanism.speeds) {
        const std::string name = speed.u.get_name();
        fmt::print("{:<{}}{:>24.16g}{:>24.16g}\n", name, width, result["speeds"][name].get<double>(), result["speed_rates"][name].get<double>());
    }
    for (const auto& [name, multiplier] : result["multipliers"].items())
        fmt::print("{:<{}}{:>24.16g}\n", name, width, multiplier.get<double>());
    for (const std::string& line : moved) fmt::print("adjusted {}\n", line);
    fmt::print("\nT = {:.16g}\nV = {:.16g}\nE = {:.16g}\n", single("kinetic"), single("potential"), single("energy"));
    for (const auto& [name, output] : result["outputs"].items()) fmt::print("{} = {:.16g}\n", name, output.get<double>());
    if (!joint_loads.empty()) fmt::print("\nJoints exert on their children, along the joint's axes:\n");
    for (const JointLoad& load : joint_loads)
        for (const auto& [what, v] : {std::pair("force", &load.force), std::pair("moment", &load.moment)})
            fmt::print("{:<{}}{:<8}{:>24.16g}{:>24.16g}{:>24.16g}\n", load.joint, width, what, (*v)[0], (*v)[1], (*v)[2]);
    return 0;
}

}  // namespace alembert
