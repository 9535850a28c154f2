// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/projection_text.hpp"

#include <algorithm>
#include <kainjow/mustache.hpp>

#include "codegen/emit/names.hpp"
#include "codegen/emit/solver_functions.hpp"
#include "codegen/emit/templates.hpp"

namespace alembert {

namespace {

/// Whether the speeds have eliminated all constraints.
bool is_eliminated(const Program& p) {
    const std::vector<int> rows = p.nodes_of(Group::speed_row);
    return !p.speeds.empty() && std::all_of(rows.begin(), rows.end(), [&](int node) { return p.is_zero(node); });
}

}  // namespace

std::string all_constraints(const Program& p) {
    const std::size_t all = constraints_of(p);
    return all == p.nodes_of(Group::velocity).size() ? "constraints" : std::to_string(all);
}

std::string projection_text(const Program& p, CodeLanguage language, const ProjectionParts& parts) {
    const bool is_c = language == CodeLanguage::c, has_project = !project(p).results.empty();
    kainjow::mustache::data file;
    file.set("call", is_c ? ascii_identifier(p.name) + "_" : "");
    file.set("math", is_c ? "" : "::");
    file.set("own_speeds", !p.speeds.empty());
    file.set("all_constraints", all_constraints(p));
    file.set("has_project", has_project);
    file.set("has_energy", parts.watches_energy && !energy(p).results.empty());
    file.set("has_constraints_at", !constraints_at(p).results.empty());
    file.set("has_near", has_project && !is_eliminated(p) && !gamma_at(p).results.empty() &&
                             !mass_forcing(p).results.empty() && !constraints_at(p).results.empty());
    file.set("has_contacts", parts.contacts > 0);
    file.set("has_responses", parts.responses > 0);
    file.set("responses", std::to_string(parts.responses));
    file.set("rates", parts.contacts > 0 ? "free_rates" : "held_rates");
    file.set("contacts", kainjow::mustache::mustache{std::string(template_contacts)}.render(file));
    return kainjow::mustache::mustache{std::string(template_projection)}.render(file);
}

}  // namespace alembert
