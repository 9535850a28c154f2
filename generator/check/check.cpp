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

/// The sheets as they are before any claim is read, which adds to what is positive on them.
std::shared_ptr<RootSheets> copy_of(const std::shared_ptr<RootSheets>& sheets) {
    return sheets ? std::make_shared<RootSheets>(*sheets) : nullptr;
}

/// The claims are judged together. If that meets an error of the arithmetic, each is judged alone, and the one
/// that meets it is undecided.
Checked check_together(OneMode& mode, const Scene& scene) try {
    return mode.check(scene, copy_of(mode.sheets()));
} catch (const std::exception&) {
    const std::string reason = words_of_arithmetic_error();
    Checked result;
    if (scene.claims.size() == 1) {
        result.claims.emplace_back().reason = reason;
        return result;
    }
    for (std::size_t k = 0; k < scene.claims.size(); ++k)
        result.claims.push_back(std::move(check_together(mode, with_some_claims(scene, {k})).claims[0]));
    return result;
}

/// `scene` with these claims.
Scene with_claims_of(Scene scene, const Scene& claims) {
    scene.claims = claims.claims;
    scene.file = claims.file;
    scene.text = claims.text;
    scene.own_file = claims.own_file;
    scene.own_text = claims.own_text;
    return scene;
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

}  // namespace

/// The mechanisms of which claims speak, each made when it is first needed.
class Checker::Modes {
public:
    Modes(Prepared prepared, const std::string& by, std::optional<Equations> shown) : by_(by) {
        modes_.try_emplace({}, std::move(prepared), by, std::move(shown));
    }

    Checked check(const Scene& scene) {
        std::map<Mode, std::vector<std::size_t>> modes;
        for (std::size_t k = 0; k < scene.claims.size(); ++k) modes[mode_of(scene.claims[k], scene)].push_back(k);
        Checked result{.claims = std::vector<CheckedClaim>(scene.claims.size()),
                       .has_states = !scene.states.empty(),
                       .is_of_states_alone = scene.coordinates.empty() && scene.joints.empty()};
        for (const auto& [mode, claims] : modes) {
            const Scene part = with_some_claims(scene, claims);
            const bool is_own = mode.held.is_of_scene();
            Checked checked = is_own ? check_together(own(), part) : check_in(mode.held, part);
            if (is_own && (mode.where.empty() || modes.size() == 1)) {
                result.complete = checked.complete;
                result.missing = checked.missing;
                result.freedom = checked.freedom;
            }
            for (std::size_t i = 0; i < claims.size(); ++i) {
                CheckedClaim& claim = result.claims[claims[i]] = std::move(checked.claims[i]);
                for (const std::string& contact : mode.held.closed)
                    claim.assumed.push_back(
                        {Assumption::Kind::closed, say("contact {} is closed", contact), false});
                for (const std::string& friction : mode.held.sticking)
                    claim.assumed.push_back(
                        {Assumption::Kind::stated, say("friction {} sticks", friction), false});
            }
        }
        withdraw_what_holds_when_closed(scene, result);
        return result;
    }

private:
    /// Which friction sticks and which contacts are closed.
    struct HeldParts {
        std::vector<std::string> sticking = {}, closed = {};
        auto operator<=>(const HeldParts&) const = default;
        bool is_of_scene() const { return sticking.empty() && closed.empty(); }
    };

    /// What distinguishes the mechanisms of which claims of one scene speak, and the states at which they hold.
    struct Mode {
        HeldParts held;
        std::vector<std::string> where;
        auto operator<=>(const Mode&) const = default;
    };

    static Mode mode_of(const Claim& claim, const Scene& scene) {
        Mode mode{.held = {.sticking = {}, .closed = closed_in(claim, scene)}, .where = {}};
        if (claim.at == Claim::At::sticking) mode.held.sticking = sticking_in(claim, scene);
        for (const Inequality& assumed : claim.where)
            mode.where.push_back(assumed.greater.text + '>' + assumed.less.text);
        return mode;
    }

    OneMode& own() { return modes_.at({}); }

    OneMode& mode(const HeldParts& held) {
        const auto known = modes_.find(held);
        if (known != modes_.end()) return known->second;
        Scene scene = with_closed_contacts(with_sticking(own().scene(), held.sticking), held.closed);
        Prepared made = prepared(std::move(scene), {}, own().sheets() != nullptr);
        return modes_.try_emplace(held, std::move(made), by_).first->second;
    }

    Checked check_in(const HeldParts& held, Scene part) {
        for (Claim& claim : part.claims)
            if (claim.at == Claim::At::sticking || claim.at == Claim::At::closed) claim.at = Claim::At::motion;
        OneMode& of = mode(held);
        return check_together(of, with_claims_of(of.scene(), part));
    }

    /// A claim that fails while the contacts are open may mean the motion while they are closed.
    void withdraw_what_holds_when_closed(const Scene& scene, Checked& result) {
        for (const std::vector<std::string>& closed : sets_of_contacts(scene)) {
            std::vector<std::size_t> wrong;
            for (std::size_t k = 0; k < scene.claims.size(); ++k)
                if (scene.claims[k].at == Claim::At::motion && closed_in(scene.claims[k], scene).empty() &&
                    result.claims[k].verdict == Verdict::refuted)
                    wrong.push_back(k);
            if (wrong.empty()) return;
            Checked held;
            try {
                held = check_in({.sticking = {}, .closed = closed}, with_some_claims(scene, wrong));
            } catch (const std::exception&) {
                continue;  // these contacts cannot be closed together
            }
            for (std::size_t i = 0; i < wrong.size(); ++i) {
                if (held.claims[i].verdict != Verdict::proved) continue;
                result.claims[wrong[i]] = {};
                result.claims[wrong[i]].reason =
                    say("it fails while the contacts are open, and holds while closed: {0}; say at = \"closed "
                        "{1}\" if "
                        "this is meant",
                        fmt::join(closed, ", "), fmt::join(closed, " "));
            }
        }
    }

    std::string by_;
    std::map<HeldParts, OneMode> modes_;
};

Checker::Checker(const Derived& derived)
    : modes_(std::make_unique<Modes>(static_cast<const Prepared&>(derived), derived.by, derived.equations)) {}
Checker::Checker(Prepared prepared, const std::string& by)
    : modes_(std::make_unique<Modes>(std::move(prepared), by, std::nullopt)) {}
Checker::Checker(Checker&&) noexcept = default;
Checker::~Checker() = default;

Checked Checker::check(const Scene& scene) {
    return modes_->check(scene);
}

Checked check(const Scene& scene, const Mechanism& mechanism, const std::shared_ptr<RootSheets>& sheets,
              const std::string& by) {
    return Checker({.scene = scene, .mechanism = mechanism, .warnings = {}, .sheets = sheets}, by).check(scene);
}

CheckedScene check(Scene scene, const std::string& by) {
    CheckedScene result{derived(std::move(scene), {.by = by, .on_sheets = true})};
    if (result.scene.claims.empty())
        throw ModelError(say(
            "there are no claims: write [[claim]] in the scene, or give a file of claims, one equation a line"));
    result.checked = Checker(static_cast<const Derived&>(result)).check(result.scene);
    return result;
}

}  // namespace alembert
