// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/branches.hpp"

#include "base/language/say.hpp"
#include "present/report/equilibria.hpp"
#include "present/report/page.hpp"
#include "present/report/shown_unit.hpp"
#include "scene/units.hpp"

namespace alembert {

Json as_json(const Branches& found) {
    const Mechanism& m = found.mechanism;
    Json result;
    result["formalism"] = found.equations.formalism;
    result["follow"] = {{"name", found.parameter}, {"from", found.from}, {"to", found.to}};
    result["branches"] = Json::array();
    for (const Branch& branch : found.branches) {
        Json rows = Json::array();
        for (const BranchPoint& point : branch.points) {
            Json row{{"parameter", point.parameter},
                     {"coordinates", by_name_of(m, point.q)},
                     {"stable", name_of(point.stable)}};
            if (point.kind) row["kind"] = name_of(*point.kind);
            rows.push_back(std::move(row));
        }
        result["branches"].push_back({{"closed", branch.closed}, {"points", std::move(rows)}});
        if (branch.family_at) result["branches"].back()["family_at"] = *branch.family_at;
    }
    result["points"] = Json::array();
    for (const SpecialPoint& point : found.points)
        result["points"].push_back({{"kind", name_of(point.kind)},
                                    {"parameter", point.parameter},
                                    {"coordinates", by_name_of(m, point.q)},
                                    {"branch", point.branch + 1}});
    result["cut"] = found.cut;
    return result;
}

std::string as_text(const Branches& found) {
    const Mechanism& m = found.mechanism;
    const UnitOfName unit = unit_of_name(found.scene, found.parameter);
    const std::string parameter = unit.label(found.parameter);
    std::string page;
    if (!found.scene.title.empty()) put(page, "{}\n\n", found.scene.title);
    say_on(page, "{} branch{} of equilibria for {} from {} to {}\n", found.branches.size(),
           found.branches.size() == 1 ? "" : "es", parameter, found.from / unit.size, found.to / unit.size);
    for (std::size_t k = 0; k < found.branches.size(); ++k) {
        const Branch& branch = found.branches[k];
        if (branch.family_at) {
            say_on(page, "  {:>2}. {} = {:.10g}, a family of states, {} points{}\n", k + 1, parameter,
                   *branch.family_at / unit.size, branch.points.size(), branch.closed ? say(", closed") : "");
            continue;
        }
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const BranchPoint& point : branch.points)
            low = std::min(low, point.parameter), high = std::max(high, point.parameter);
        say_on(page, "  {:>2}. {} from {:.10g} to {:.10g}, {} points{}\n", k + 1, parameter, low / unit.size,
               high / unit.size, branch.points.size(), branch.closed ? say(", closed") : "");
    }
    put(page, "\n");
    for (const SpecialPoint& point : found.points) {
        if (point.kind == PointKind::family)
            say_on(page, "meets a family of states at {} = {:.12g}\n", parameter, point.parameter / unit.size);
        else
            say_on(page, "{} at {} = {:.12g}\n", translated(name_of(point.kind)), parameter,
                   point.parameter / unit.size);
        for (int i = 0; i < m.size(); ++i) {
            if (!found.essential[i]) continue;
            const ShownUnit shown(m.shown_units[static_cast<std::size_t>(i)]);
            put(page, "     {} = {:.10g}\n", shown.label(m.q[i].get_name()), shown.value(point.q[i] + 0.0));
        }
    }
    if (found.points.empty()) say_on(page, "no folds or bifurcations\n");
    if (found.cut) say_on(page, "At least one branch was given up before its end.\n");
    return page;
}

std::string as_csv(const Branches& found) {
    std::string text = "branch," + found.parameter;
    for (const GiNaC::symbol& q : found.mechanism.q) text += "," + q.get_name();
    text += ",stable,kind\n";
    for (std::size_t k = 0; k < found.branches.size(); ++k)
        for (const BranchPoint& point : found.branches[k].points) {
            put(text, "{},{:.17g}", k + 1, point.parameter);
            for (const double x : point.q) put(text, ",{:.17g}", x + 0.0);
            put(text, ",{},{}\n", name_of(point.stable), point.kind ? name_of(*point.kind) : "");
        }
    return text;
}

}  // namespace alembert
