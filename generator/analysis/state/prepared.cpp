// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/prepared.hpp"

#include <algorithm>

#include "analysis/state/given_inputs.hpp"
#include "analysis/state/inertia_check.hpp"
#include "analysis/state/irregular_constraints.hpp"
#include "analysis/state/likely_mistakes.hpp"
#include "analysis/state/nearly_redundant.hpp"
#include "analysis/state/redundancy.hpp"
#include "base/language/say.hpp"

namespace alembert {

std::vector<Diagnostic> check_bodies(const Scene& scene, const Mechanism& mechanism, const Overrides& at) {
    if (mechanism.masses.empty()) return {};
    std::vector<Diagnostic> errors, warnings;
    for (Diagnostic& found : InertiaCheck(scene, mechanism).findings(start_of(mechanism, at).state()))
        (found.severity == Severity::warning ? warnings : errors).push_back(std::move(found));
    if (!errors.empty()) fail(scene, std::move(errors));
    return warnings;
}

namespace {

bool is_allowed(const Scene& scene, const std::string& kind) {
    return std::find(scene.allowed.begin(), scene.allowed.end(), kind) != scene.allowed.end();
}

void tell(Prepared& p, Warning warning) {
    if (p.scene.on_warning)
        p.scene.on_warning(warning);
    else
        p.warnings.push_back(std::move(warning.text));
}

}  // namespace

void Prepared::warn(std::vector<Diagnostic> found) {
    std::erase_if(found, [this](const Diagnostic& one) { return is_allowed(scene, one.kind); });
    if (found.empty()) return;
    std::string text = describe(scene, found);
    tell(*this, {std::move(text), std::move(found)});
}

void Prepared::warn(const std::string& kind, const std::string& text) {
    if (is_allowed(scene, kind)) return;
    std::string sentence = text.substr(0, text.find('\n'));
    if (const std::string prefix = say("warning: "); sentence.starts_with(prefix))
        sentence.erase(0, prefix.size());
    tell(*this, {text, {{{}, std::move(sentence), Severity::warning, kind}}});
}

namespace {

/// One for each group of constraints to which equations were added.
std::vector<Diagnostic> warnings_of_squares(const Prepared& p) {
    std::vector<Diagnostic> found;
    const auto& all = p.mechanism.constraints;
    for (auto c = all.begin(); c != all.end();) {
        const auto next = std::find_if(c, all.end(), [&](const auto& o) { return o.squared_in != c->squared_in; });
        if (!c->squared_in.empty()) {
            std::string names;
            for (auto each = c; each != next; ++each) names += (each == c ? "'" : ", '") + each->name + "'";
            found.push_back(
                {c->place,
                 say("the constraints {} only touch: wherever all of them hold their rows depend on each other, "
                     "and "
                     "loads in some directions would need forces without bound. A combination of them is a sum of "
                     "squares, each of which is therefore zero; these equations are added as {}, and their "
                     "multipliers bear such loads",
                     c->squared_in, names),
                 Severity::warning, "added_equations", c->name});
        }
        c = next;
    }
    return found;
}

/// One for each force at a place that moves within a body.
std::vector<Diagnostic> warnings_of_moving_places(const Prepared& p) {
    std::vector<Diagnostic> found;
    for (const Load& load : p.mechanism.loads) {
        if (!load.at_moving_place) continue;
        const Force& force = p.scene.forces[static_cast<std::size_t>(load.origin.index)];
        found.push_back(
            {force.place,
             say("the place '{0}' is fixed in no body, and the work of this force is that along its way. "
                 "A force that pushes a body at a changing place works along the body's point there: "
                 "say on = \"BODY\"",
                 force.at.text),
             Severity::warning, "moving_place", force.at.text});
    }
    return found;
}

}  // namespace

Prepared prepared(Scene scene, const Overrides& given, bool on_sheets, Coordinates coordinates) {
    const Overrides at = with_inputs_given(scene, given);
    Prepared result{.scene = std::move(scene), .mechanism = {}, .warnings = {}};
    result.warn(result.scene.warnings);
    OnSheets built = on_sheets ? build_on_sheets(result.scene) : OnSheets{build(result.scene), nullptr};
    if (built.mechanism.q.empty() && built.mechanism.states.empty() && coordinates == Coordinates::needed)
        throw ModelError(
            say("the scene has no coordinates, so that nothing in it moves; eval --reactions and derive "
                "--reactions give what its joints bear"));
    result.mechanism =
        with_regular_constraints(with_regular_rows(without_nearly_redundant(std::move(built.mechanism))));
    result.warn(warnings_of_nearly_redundant(result.mechanism));
    result.warn(warnings_of_squares(result));
    result.warn(warnings_of_moving_places(result));
    result.sheets = std::move(built.sheets);
    result.warn(check_bodies(result.scene, result.mechanism, at));
    result.warn(likely_mistakes(result.scene, result.mechanism, at));
    return result;
}

}  // namespace alembert
