// SPDX-License-Identifier: GPL-2.0-or-later
// Claims about sticking friction are claims about the motions of another mechanism, in which constraints take the
// place of what sticks. So the claims are judged in groups, one for each set of frictions that stick.
#include "check/check.hpp"

#include <map>

#include "check/arithmetic_error.hpp"
#include "check/one_mode.hpp"
#include "language/say.hpp"
#include "scene/sticking.hpp"

namespace alembert {

namespace {

/// The claims are judged together. If that meets an error of the arithmetic, each is judged alone, and the one
/// that meets it is undecided.
Checked check_together(const Scene& scene, const Mechanism& mechanism, const std::shared_ptr<RootSheets>& sheets,
                       const std::string& by) try {
    return check_of_one_mode(scene, mechanism, sheets, by);
} catch (const std::exception&) {
    const std::string reason = words_of_arithmetic_error();
    Checked result;
    if (scene.claims.size() == 1) {
        result.claims.emplace_back().reason = reason;
        return result;
    }
    for (std::size_t k = 0; k < scene.claims.size(); ++k)
        result.claims.push_back(
            std::move(check_together(with_some_claims(scene, {k}), mechanism, sheets, by).claims[0]));
    return result;
}

}  // namespace

Checked check(const Scene& scene, const Mechanism& mechanism, const std::shared_ptr<RootSheets>& sheets,
              const std::string& by) {
    std::map<std::vector<std::string>, std::vector<std::size_t>> modes;  // by what sticks
    for (std::size_t k = 0; k < scene.claims.size(); ++k)
        modes[scene.claims[k].at == Claim::At::sticking ? sticking_in(scene.claims[k], scene)
                                                        : std::vector<std::string>()]
            .push_back(k);
    if (modes.size() == 1 && modes.begin()->first.empty()) return check_together(scene, mechanism, sheets, by);
    Checked result{.claims = std::vector<CheckedClaim>(scene.claims.size())};
    for (const auto& [sticking, claims] : modes) {
        Scene part = with_some_claims(scene, claims);
        Checked checked;
        if (sticking.empty()) {
            checked = check_together(part, mechanism, sheets, by);
            result.complete = checked.complete;
            result.missing = checked.missing;
            result.freedom = checked.freedom;
        } else {
            for (Claim& claim : part.claims) claim.at = Claim::At::motion;
            const Prepared stuck = prepared(with_sticking(std::move(part), sticking), {}, sheets != nullptr);
            checked = check_together(stuck.scene, stuck.mechanism, stuck.sheets, by);
        }
        for (std::size_t i = 0; i < claims.size(); ++i) result.claims[claims[i]] = std::move(checked.claims[i]);
    }
    return result;
}

CheckedScene check(Scene scene, const std::string& by) {
    CheckedScene result{derived(std::move(scene), {.by = by, .on_sheets = true})};
    if (result.scene.claims.empty())
        throw ModelError(say(
            "there are no claims: write [[claim]] in the scene, or give a file of claims, one equation a line"));
    result.checked = check(result.scene, result.mechanism, result.sheets, by);
    return result;
}

}  // namespace alembert
