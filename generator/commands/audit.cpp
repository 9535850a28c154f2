// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/audit.hpp"

#include <fmt/format.h>

#include <iostream>

#include "alembert/error.hpp"
#include "commands/pipeline.hpp"
#include "report/text.hpp"

namespace alembert {

namespace {

template <typename T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json json_of(const Audit& audit, const Mechanism& m) {
    Json json;
    json["constraints"] = Json::array();
    for (const AuditedConstraint& c : audit.constraints) {
        Json one;
        one["name"] = c.name;
        one["kind"] = c.holonomic ? "holonomic" : "nonholonomic";
        one["rheonomic"] = c.rheonomic;
        one["integrable"] = or_null(c.integrable);
        one["integrable_alone"] = or_null(c.alone);
        one["integral"] = c.integral ? Json(text(*c.integral)) : Json(nullptr);
        one["redundant"] = c.redundant;
        one["residual"] = c.residual;
        one["notes"] = c.notes;
        json["constraints"].push_back(one);
    }
    json["identities"] = m.identities;
    json["rank"] = audit.rank;
    json["degrees_of_freedom"] = audit.degrees_of_freedom;
    json["coordinates_free"] = audit.integrals ? Json(m.size() - *audit.integrals) : Json(nullptr);
    json["contradictory"] = Json::array();
    for (const int k : audit.contradictory) json["contradictory"].push_back(audit.constraints[k].name);
    json["generic_rank"] = or_null(audit.generic_rank);
    json["rank_is_exact"] = audit.exact_rank;
    json["failure_bound_log2"] = audit.failure < 0 ? Json(audit.failure) : Json(nullptr);
    json["integrable_combinations"] = Json::array();
    for (const auto& [name, integral] : audit.combinations)
        json["integrable_combinations"].push_back({{"combination", name}, {"integral", integral ? Json(text(*integral)) : Json(nullptr)}});
    json["adjusted"] = Json::array();
    for (const Adjusted& a : audit.adjusted) json["adjusted"].push_back({{"name", a.name}, {"from", a.from}, {"to", a.to}});
    json["singular_poses"] = Json::array();
    for (const SingularPose& pose : audit.singular_poses) {
        Json one;
        one["coordinates"] = Json::object();
        for (int i = 0; i < m.size(); ++i) one["coordinates"][m.q[i].get_name()] = pose.q[i];
        one["rank"] = pose.rank;
        one["initial"] = pose.given;
        one["among"] = Json::array();
        for (const int k : pose.among) one["among"].push_back(m.constraints[k].name);
        json["singular_poses"].push_back(one);
    }
    json["notes"] = audit.notes;
    if (!audit.problem.empty()) json["problem"] = audit.problem;
    return json;
}

const char* answer(const std::optional<bool>& value) { return value ? (*value ? "yes" : "no") : "undecided"; }

void print(const Audit& audit, const Mechanism& m) {
    fmt::print("{} coordinate{}, rank {}: {} degree{} of freedom", m.size(), m.size() == 1 ? "" : "s", audit.rank, audit.degrees_of_freedom,
               audit.degrees_of_freedom == 1 ? "" : "s");
    if (audit.integrals && m.size() - *audit.integrals != audit.degrees_of_freedom)
        fmt::print(" (independent rates), {} coordinates that can be reached", m.size() - *audit.integrals);
    fmt::print("\n");
    if (!m.identities.empty())
        fmt::print("Left out, since they hold wherever the bodies are: {}\n", fmt::join(m.identities, ", "));
    if (audit.constraints.empty()) {
        fmt::print("There are no constraints.\n");
        return;
    }
    std::size_t width = 10;
    for (const AuditedConstraint& c : audit.constraints) width = std::max(width, c.name.size());
    fmt::print("\n{:<{}}  {:<12}  {:<11}  {:<10}  {:<9}  {:<9}  {:>9}  {:>9}\n", "constraint", width, "kind", "time",
               "integrable", "alone", "redundant", "position", "velocity");
    for (const AuditedConstraint& c : audit.constraints)
        fmt::print("{:<{}}  {:<12}  {:<11}  {:<10}  {:<9}  {:<9}  {:>9}  {:>9.2g}\n", c.name, width,
                   c.holonomic ? "holonomic" : "nonholonomic", c.rheonomic ? "rheonomic" : "scleronomic",
                   answer(c.integrable), answer(c.alone), c.redundant ? "yes" : "no",
                   c.holonomic ? fmt::format("{:.2g}", c.residual[0]) : "-", c.residual[1]);
    fmt::print("\n");
    for (const AuditedConstraint& c : audit.constraints) {
        if (c.integral) fmt::print("{}: {} = const\n", c.name, text(*c.integral));
        for (const std::string& note : c.notes) fmt::print("{}: {}\n", c.name, note);
    }
    for (const auto& [name, integral] : audit.combinations)
        fmt::print("{} is integrable{}\n", name, integral ? fmt::format(": {} = const", text(*integral)) : "");
    for (const std::string& note : audit.notes) fmt::print("{}\n", note);
    for (const Adjusted& a : audit.adjusted) fmt::print("adjusted {} from {:.6g} to {:.17g}\n", a.name, a.from, a.to);
    for (const SingularPose& pose : audit.singular_poses) {
        std::string where, among;
        for (int i = 0; i < m.size(); ++i) where += fmt::format("{}{} = {:.10g}", i == 0 ? "" : ", ", m.q[i].get_name(), pose.q[i]);
        for (const int k : pose.among) among += fmt::format("{}'{}'", among.empty() ? "" : ", ", m.constraints[k].name);
        fmt::print("the rank drops to {} {}at {}: {} {}\n", pose.rank, pose.given ? "at the initial state, " : "", where, among,
                   pose.among.size() == 1 ? "has no row left" : "become dependent");
    }
    fmt::print("The rank is that at states which obey the constraints, with the scene's parameters{}.\n",
               audit.exact_rank ? "; exact arithmetic modulo 2^61 - 1 finds the same" : ", in floating point");
    if (audit.failure < 0)
        fmt::print("Integrable: Frobenius' condition, exactly, for general parameters; the chance of a wrong yes is below 2^{:.0f}.\n", audit.failure);
}

}  // namespace

int audit(const Request& request) {
    const Scene scene = read_scene(request.scene);
    if (!scene.warnings.empty()) std::cerr << describe(scene, scene.warnings);
    const Mechanism mechanism = build(scene);
    check_bodies(scene, mechanism, {});
    const Audit result = audit_of(mechanism);
    if (request.json)
        std::cout << as_text(json_of(result, mechanism));
    else
        print(result, mechanism);
    if (result.problem.empty()) return 0;
    if (result.wrong) throw ModelError(result.problem);
    throw IntegrationError(result.problem, result.start.t, result.start.q);
}

}  // namespace alembert
