// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/audit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "algebra/notation/text.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "present/report/page.hpp"

namespace alembert {

namespace {

std::string answer(const std::optional<bool>& value) {
    return value ? (*value ? say("yes") : say("no")) : say("undecided");
}

}  // namespace

Json as_json(const Audited& audited) {
    const Audit& audit = audited.audit;
    const Mechanism& m = audited.mechanism;
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
        one["residual"] = std::isfinite(c.residual[0]) ? Json(c.residual) : Json(nullptr);
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
        json["integrable_combinations"].push_back(
            {{"combination", name}, {"integral", integral ? Json(text(*integral)) : Json(nullptr)}});
    json["adjusted"] = Json::array();
    for (const Adjusted& a : audit.adjusted)
        json["adjusted"].push_back({{"name", a.name}, {"from", a.from}, {"to", a.to}});
    json["singular_poses"] = Json::array();
    const auto add_pose = [&](const SingularPose& pose, const char* kind, const auto& name) {
        Json one;
        one["kind"] = kind;
        one["coordinates"] = Json::object();
        for (int i = 0; i < m.size(); ++i) one["coordinates"][m.q[i].get_name()] = pose.q[i];
        one["rank"] = pose.rank;
        one["initial"] = pose.given;
        one["among"] = Json::array();
        for (const int k : pose.among) one["among"].push_back(name(k));
        json["singular_poses"].push_back(one);
    };
    for (const SingularPose& pose : audit.singular_poses)
        add_pose(pose, "mechanism", [&](int k) { return m.constraints[k].name; });
    for (const SingularPose& pose : audit.description_poses)
        add_pose(pose, "description", [&](int k) { return m.q[k].get_name(); });
    for (const Mechanism::Friction& f : m.frictions)
        json["friction"].push_back(
            {{"name", f.name}, {"modes", f.across ? Json{"stick", "slip"} : Json{"stick", "slip +", "slip -"}}});
    json["notes"] = audit.notes;
    if (!audit.problem.empty()) json["problem"] = audit.problem;
    return json;
}

namespace {

std::string place_of(const SingularPose& pose, const Mechanism& m) {
    std::string where;
    for (int i = 0; i < m.size(); ++i)
        where += fmt::format("{}{} = {:.10g}", i == 0 ? "" : ", ", m.q[i].get_name(), pose.q[i]);
    return where;
}

}  // namespace

std::string as_text(const Audited& audited) {
    const Audit& audit = audited.audit;
    const Mechanism& m = audited.mechanism;
    std::string page;
    say_on(page, "{} coordinate{}, rank {}: {} degree{} of freedom", m.size(), m.size() == 1 ? "" : "s",
           audit.rank, audit.degrees_of_freedom, audit.degrees_of_freedom == 1 ? "" : "s");
    if (audit.integrals && m.size() - *audit.integrals != audit.degrees_of_freedom)
        say_on(page, " (independent rates), {} coordinates that can be reached", m.size() - *audit.integrals);
    put(page, "\n");
    if (!m.identities.empty())
        say_on(page, "Left out, since they hold wherever the bodies are: {}\n", fmt::join(m.identities, ", "));
    for (const Mechanism::Friction& f : m.frictions)
        page += f.across ? say("friction {} has two modes: it sticks, or slips in some direction of its plane\n",
                               f.name)
                         : say("friction {} has three modes: it sticks, or slips one way or the other\n", f.name);
    for (const SingularPose& pose : audit.description_poses) {
        std::vector<std::string> among;
        for (const int k : pose.among) among.push_back("'" + m.q[k].get_name() + "'");
        say_on(page,
               "the coordinates fail {}at {}: the mass matrix has the rank {} there, as rates of {} move no mass; "
               "the mechanism itself is regular\n",
               pose.given ? say("at the initial state, ") : "", place_of(pose, m), pose.rank,
               fmt::join(among, ", "));
    }
    if (audit.constraints.empty()) {
        say_on(page, "There are no constraints.\n");
        return page;
    }
    std::size_t width = 10;
    for (const AuditedConstraint& c : audit.constraints) width = std::max(width, c.name.size());
    put(page, "\n{:<{}}  {:<12}  {:<11}  {:<10}  {:<9}  {:<9}  {:>9}  {:>9}\n", say("constraint"), width,
        say("kind"), say("time"), say("integrable"), say("alone"), say("redundant"), say("position"),
        say("velocity"));
    const auto size = [](double residual) {
        return std::isfinite(residual) ? fmt::format("{:.2g}", residual) : say("unknown");
    };
    for (const AuditedConstraint& c : audit.constraints)
        put(page, "{:<{}}  {:<12}  {:<11}  {:<10}  {:<9}  {:<9}  {:>9}  {:>9}\n", c.name, width,
            c.holonomic ? say("holonomic") : say("nonholonomic"),
            c.rheonomic ? say("rheonomic") : say("scleronomic"), answer(c.integrable), answer(c.alone),
            c.redundant ? say("yes") : say("no"), c.holonomic ? size(c.residual[0]) : "-", size(c.residual[1]));
    put(page, "\n");
    for (const AuditedConstraint& c : audit.constraints) {
        if (c.integral) say_on(page, "{}: {} = const\n", c.name, text(*c.integral));
        for (const std::string& note : c.notes) put(page, "{}: {}\n", c.name, note);
    }
    for (const auto& [name, integral] : audit.combinations)
        say_on(page, "{} is integrable{}\n", name, integral ? say(": {} = const", text(*integral)) : "");
    for (const std::string& note : audit.notes) put(page, "{}\n", note);
    for (const Adjusted& a : audit.adjusted)
        say_on(page, "adjusted {}\n", moved_in_own_unit(m, a.name, a.from, a.to));
    for (const SingularPose& pose : audit.singular_poses) {
        std::string among;
        for (const int k : pose.among)
            among += fmt::format("{}'{}'", among.empty() ? "" : ", ", m.constraints[k].name);
        say_on(page, "the rank drops to {} {}at {}: {} {}\n", pose.rank,
               pose.given ? say("at the initial state, ") : "", place_of(pose, m), among,
               pose.among.size() == 1 ? say("has no row left") : say("become dependent"));
    }
    say_on(
        page, "The rank is that at states which obey the constraints, with the scene's parameters{}.\n",
        audit.exact_rank ? say("; exact arithmetic modulo 2^61 - 1 finds the same") : say(", in floating point"));
    if (audit.failure < 0)
        say_on(page,
               "Integrable: Frobenius' condition, exactly, for general parameters; the chance of a wrong yes is "
               "below 2^{:.0f}.\n",
               audit.failure);
    return page;
}

}  // namespace alembert
