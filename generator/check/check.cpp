// SPDX-License-Identifier: GPL-2.0-or-later
// Claims about sticking friction or closed contacts are claims about the motions of another mechanism, in which
// constraints take the place of what sticks or touches. So the claims are judged in groups, one for each such set.
#include "check/check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "base/language/say.hpp"
#include "check/arithmetic_error.hpp"
#include "check/one_mode.hpp"
#include "scene/closed_contacts.hpp"
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

/// What distinguishes the mechanisms of which claims of one scene speak, and the states at which they hold.
struct Mode {
    std::vector<std::string> sticking, closed, where;
    auto operator<=>(const Mode&) const = default;
    bool is_of_scene() const { return sticking.empty() && closed.empty(); }
};

Mode mode_of(const Claim& claim, const Scene& scene) {
    Mode mode{.sticking = {}, .closed = closed_in(claim, scene), .where = {}};
    if (claim.at == Claim::At::sticking) mode.sticking = sticking_in(claim, scene);
    for (const Inequality& assumed : claim.where)
        mode.where.push_back(assumed.greater.text + '>' + assumed.less.text);
    return mode;
}

Checked check_in(const Mode& mode, Scene part, const Mechanism& mechanism,
                 const std::shared_ptr<RootSheets>& sheets, const std::string& by) {
    if (mode.is_of_scene()) return check_together(part, mechanism, sheets, by);
    for (Claim& claim : part.claims)
        if (claim.at == Claim::At::sticking || claim.at == Claim::At::closed) claim.at = Claim::At::motion;
    const Prepared held = prepared(
        with_closed_contacts(with_sticking(std::move(part), mode.sticking), mode.closed), {}, sheets != nullptr);
    return check_together(held.scene, held.mechanism, held.sheets, by);
}

/// The sets of contacts that may be closed together, the smaller ones first.
std::vector<std::vector<std::string>> sets_of_contacts(const Scene& scene) {
    constexpr std::size_t most_contacts = 4;
    std::vector<std::vector<std::string>> result;
    const std::size_t count = scene.unilateral.size();
    if (count > most_contacts) {
        for (const UnilateralRule& contact : scene.unilateral) result.push_back({contact.name.text});
        return result;
    }
    for (unsigned set = 1; set < 1U << count; ++set) {
        result.emplace_back();
        for (std::size_t k = 0; k < count; ++k)
            if (((set >> k) & 1U) != 0) result.back().push_back(scene.unilateral[k].name.text);
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
    return result;
}

/// A claim that fails while the contacts are open may mean the motion while they are closed.
void withdraw_what_holds_when_closed(const Scene& scene, const Mechanism& mechanism,
                                     const std::shared_ptr<RootSheets>& sheets, const std::string& by,
                                     Checked& result) {
    for (const std::vector<std::string>& closed : sets_of_contacts(scene)) {
        std::vector<std::size_t> wrong;
        for (std::size_t k = 0; k < scene.claims.size(); ++k)
            if (scene.claims[k].at == Claim::At::motion && closed_in(scene.claims[k], scene).empty() &&
                result.claims[k].verdict == Verdict::refuted)
                wrong.push_back(k);
        if (wrong.empty()) return;
        Checked held;
        try {
            held = check_in({.sticking = {}, .closed = closed, .where = {}}, with_some_claims(scene, wrong),
                            mechanism, sheets, by);
        } catch (const std::exception&) {
            continue;  // these contacts cannot be closed together
        }
        for (std::size_t i = 0; i < wrong.size(); ++i) {
            if (held.claims[i].verdict != Verdict::proved) continue;
            result.claims[wrong[i]] = {};
            result.claims[wrong[i]].reason = say(
                "it fails while the contacts are open, and holds while closed: {0}; say at = \"closed {1}\" if "
                "this is meant",
                fmt::join(closed, ", "), fmt::join(closed, " "));
        }
    }
}

}  // namespace

Checked check(const Scene& scene, const Mechanism& mechanism, const std::shared_ptr<RootSheets>& sheets,
              const std::string& by) {
    std::map<Mode, std::vector<std::size_t>> modes;
    for (std::size_t k = 0; k < scene.claims.size(); ++k) modes[mode_of(scene.claims[k], scene)].push_back(k);
    Checked result{.claims = std::vector<CheckedClaim>(scene.claims.size())};
    for (const auto& [mode, claims] : modes) {
        Checked checked = check_in(mode, with_some_claims(scene, claims), mechanism, sheets, by);
        if (mode.is_of_scene() && (mode.where.empty() || modes.size() == 1)) {
            result.complete = checked.complete;
            result.missing = checked.missing;
            result.freedom = checked.freedom;
        }
        for (std::size_t i = 0; i < claims.size(); ++i) result.claims[claims[i]] = std::move(checked.claims[i]);
    }
    withdraw_what_holds_when_closed(scene, mechanism, sheets, by, result);
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
