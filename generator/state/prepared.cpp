// SPDX-License-Identifier: GPL-2.0-or-later
#include "state/prepared.hpp"

#include "state/inertia_check.hpp"
#include "state/redundancy.hpp"

namespace alembert {

std::vector<std::string> check_bodies(const Scene& scene, const Mechanism& mechanism, const Overrides& at) {
    if (mechanism.masses.empty()) return {};
    std::vector<Diagnostic> errors, warnings;
    for (Diagnostic& found : InertiaCheck(scene, mechanism).findings(start_of(mechanism, at).state()))
        (found.severity == Severity::warning ? warnings : errors).push_back(std::move(found));
    if (!errors.empty()) fail(scene, std::move(errors));
    if (warnings.empty()) return {};
    return {describe(scene, warnings)};
}

void Prepared::warn(std::string warning) {
    if (scene.on_warning)
        scene.on_warning(warning);
    else
        warnings.push_back(std::move(warning));
}

Prepared prepared(Scene scene, const Overrides& at, bool on_sheets) {
    Prepared result{.scene = std::move(scene), .mechanism = {}, .warnings = {}};
    if (!result.scene.warnings.empty()) result.warn(describe(result.scene, result.scene.warnings));
    OnSheets built = on_sheets ? build_on_sheets(result.scene) : OnSheets{build(result.scene), nullptr};
    result.mechanism = with_regular_rows(std::move(built.mechanism));
    result.sheets = std::move(built.sheets);
    for (std::string& warning : check_bodies(result.scene, result.mechanism, at)) result.warn(std::move(warning));
    return result;
}

}  // namespace alembert
