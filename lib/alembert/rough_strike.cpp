// SPDX-License-Identifier: MIT
#include "alembert/rough_strike.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "alembert/rough_choice.hpp"
#include "alembert/rough_impact.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double negligible_gain = 1e-9;  // of energy, relative to the work of the impulses

/// Nothing if the contact has several frictions.
std::optional<RoughContact> contact_at(const Situation& here, int k) {
    RoughContact contact{.normal = here.contacts.rows.row(k),
                         .slip = Eigen::RowVectorXd::Zero(here.M.cols()),
                         .normal_drift = here.contacts.drift[k]};
    int frictions = 0;
    for (const Situation::Rough& rough : here.rough) {
        if (rough.contact != k) continue;
        if (++frictions > 1) return std::nullopt;
        contact.slip = rough.slip.row(0);
        contact.slip_drift = rough.drift[0];
        contact.coefficient = rough.coefficient;
        contact.resting = rough.resting;
        contact.grip = rough.restitution;
        if (rough.slip.rows() == 1) continue;
        contact.across = rough.slip.row(1);
        contact.across_drift = rough.drift[1];
    }
    return contact;
}

/// The impact of contact k alone; nothing if another near contact is pressed by it.
std::optional<RoughStrike> alone(const Situation& here, const VectorXd& before, const std::vector<int>& near,
                                 int k, double restitution) {
    const std::optional<RoughContact> contact = contact_at(here, k);
    if (!contact)
        return RoughStrike{.failure = "an impact can be computed where each contact has one friction only",
                           .after = {}};
    const RoughImpact hit = strike_rough(here.M, before, here.bilateral.rows, *contact, restitution);
    if (!hit) return RoughStrike{.failure = hit.failure, .after = {}};
    const VectorXd rates = gap_rates(here, hit.after), still = negligible_rates(here, hit.after);
    if (std::any_of(near.begin(), near.end(), [&](int i) { return i != k && rates[i] < -still[i]; }))
        return std::nullopt;
    return RoughStrike{.failure = {},
                       .after = hit.after,
                       .work = hit.work,
                       .events = {{.kind = ContactEvent::Kind::impact,
                                   .contact = k,
                                   .speed_before = gap_rates(here, before)[k],
                                   .speed_after = rates[k],
                                   .energy_loss = hit.loss,
                                   .impulse = hit.impulse}}};
}

RoughStrike together(const Situation& here, const VectorXd& before, const std::vector<int>& near,
                     const std::vector<double>& restitution, const VectorXd& kick) {
    std::vector<RoughRows> rows;
    const VectorXd speed = gap_rates(here, before);
    for (const int k : near) {
        const std::optional<RoughContact> contact = contact_at(here, k);
        if (!contact || contact->across.size() > 0 || contact->grip > 0)
            return {.failure =
                        "simultaneous impacts with friction can be computed where each contact has one "
                        "friction in one direction, without a restitution of its own",
                    .after = {}};
        const double e = restitution[static_cast<std::size_t>(k)];
        rows.push_back({.normal = contact->normal,
                        .offset = contact->normal_drift + e * std::min(0.0, speed[k]),
                        .slip = contact->slip.isZero(0) ? Eigen::RowVectorXd() : contact->slip,
                        .slip_offset = contact->slip_drift,
                        .coefficient = contact->coefficient,
                        .resting = contact->resting});
    }
    const VectorXd momentum = here.M * before + kick;
    const RoughChoice hit = choose_rough(here.M, momentum, here.bilateral.rows, here.bilateral.drift, rows);
    if (!hit.exists)
        return {.failure = "no choice of sticking and sliding is consistent in their impact together",
                .after = {}};
    const VectorXd after = gap_rates(here, hit.after), mean = (before + hit.after) / 2;
    RoughStrike result{
        .failure = {}, .after = hit.after, .work = hit.bilateral.dot(here.bilateral.rows * mean) + kick.dot(mean)};
    double loss = 0, size = 0;
    for (std::size_t i = 0; i < near.size(); ++i) {
        const int k = near[i];
        const double pi = hit.normal[static_cast<Index>(i)], tau = hit.tangential[static_cast<Index>(i)];
        if (!(pi > 0)) continue;
        const bool is_rough = rows[i].slip.size() > 0;
        const double normal = pi * rows[i].normal.dot(mean), along = is_rough ? tau * rows[i].slip.dot(mean) : 0;
        const double lost =
            -normal - pi * here.contacts.drift[k] - along - (is_rough ? tau * rows[i].slip_offset : 0);
        result.work += normal + along;
        loss += lost;
        size += std::abs(normal) + std::abs(along);
        result.events.push_back({.kind = ContactEvent::Kind::impact,
                                 .contact = k,
                                 .speed_before = speed[k],
                                 .speed_after = after[k],
                                 .energy_loss = lost,
                                 .impulse = pi});
    }
    if (loss < -negligible_gain * size)
        return {.failure = "their impact together would gain energy with these restitutions and coefficients",
                .after = {}};
    return result;
}

}  // namespace

RoughStrike strike_rough_contacts(const Situation& here, const VectorXd& before, const std::vector<int>& near,
                                  const std::vector<double>& restitution, const VectorXd& kick) {
    const VectorXd rates = gap_rates(here, before), still = negligible_rates(here, before);
    std::vector<int> striking;
    for (const int k : near)
        if (rates[k] < -still[k]) striking.push_back(k);
    if (striking.size() == 1 && kick.size() == 0)
        if (std::optional<RoughStrike> hit =
                alone(here, before, near, striking[0], restitution[static_cast<std::size_t>(striking[0])]))
            return *std::move(hit);
    return together(here, before, near, restitution, kick.size() > 0 ? kick : VectorXd::Zero(before.size()));
}

}  // namespace alembert
