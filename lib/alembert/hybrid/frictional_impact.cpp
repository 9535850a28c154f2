// SPDX-License-Identifier: MIT
#include "alembert/hybrid/frictional_impact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "alembert/hybrid/contact_cone.hpp"
#include "alembert/hybrid/friction_modes.hpp"
#include "alembert/hybrid/routh_impact.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double negligible_gain = 1e-9;  // of energy, relative to the work of the impulses
constexpr double no_effect = 1e-12;       // of an impulse on another contact, relative to that on its own

/// Nothing if the contact has several frictions.
std::optional<RoughContact> contact_at(const Situation& here, int k) {
    RoughContact contact{.normal = here.contacts.rows.row(k),
                         .tangent = Eigen::RowVectorXd::Zero(here.M.cols()),
                         .normal_offset = here.contacts.offset[k]};
    int frictions = 0;
    for (const Situation::Rough& rough : here.rough) {
        if (rough.contact != k) continue;
        if (++frictions > 1) return std::nullopt;
        contact.tangent = rough.tangent.row(0);
        contact.tangent_offset = rough.offset[0];
        contact.coefficient = rough.coefficient;
        contact.resting = rough.resting;
        contact.grip = rough.restitution;
        if (rough.tangent.rows() == 1) continue;
        contact.across = rough.tangent.row(1);
        contact.across_offset = rough.offset[1];
    }
    return contact;
}

/// The impact of contact k alone; nothing if another near contact is pressed by it.
std::optional<FrictionalImpact> alone(const Situation& here, const VectorXd& before, const std::vector<int>& near,
                                      int k, double restitution) {
    const std::optional<RoughContact> contact = contact_at(here, k);
    if (!contact)
        return FrictionalImpact{.failure = "an impact can be computed where each contact has one friction only",
                                .after = {}};
    const RouthImpact hit = strike_rough(here.M, before, here.bilateral.rows, *contact, restitution);
    if (!hit) return FrictionalImpact{.failure = hit.failure, .after = {}};
    const VectorXd rates = gap_rates(here, hit.after), still = negligible_rates(here, hit.after);
    if (std::any_of(near.begin(), near.end(), [&](int i) { return i != k && rates[i] < -still[i]; }))
        return std::nullopt;
    return FrictionalImpact{.failure = {},
                            .after = hit.after,
                            .work = hit.work,
                            .events = {{.kind = ContactEvent::Kind::impact,
                                        .contact = k,
                                        .speed_before = gap_rates(here, before)[k],
                                        .speed_after = rates[k],
                                        .energy_loss = hit.loss,
                                        .impulse = hit.impulse}}};
}

/// The impulses and rates of an impact of several contacts together.
struct Together {
    std::string failure;
    VectorXd after, normal, bilateral;
    std::vector<VectorXd> tangential;
};

Together in_cones(const Situation& here, const VectorXd& momentum, const std::vector<ContactCone>& contacts) {
    ConeChoice hit = choose_in_cones(here.M, momentum, here.bilateral.rows, here.bilateral.offset, contacts);
    return {.failure = std::move(hit.failure),
            .after = std::move(hit.after),
            .normal = std::move(hit.normal),
            .bilateral = std::move(hit.bilateral),
            .tangential = std::move(hit.tangential)};
}

/// Where every contact slides along one direction, all choices of modes are tried. Contacts that slide although
/// the static coefficient would hold them if it could have the kinetic one.
Together in_lines(const Situation& here, const VectorXd& momentum, const std::vector<ContactCone>& contacts) {
    if (contacts.size() > most_contacts_with_friction) return in_cones(here, momentum, contacts);
    std::vector<FrictionRows> rows;
    for (const ContactCone& c : contacts)
        rows.push_back(
            {.normal = c.normal,
             .offset = c.offset,
             .tangent = c.tangent.rows() == 0 ? Eigen::RowVectorXd() : Eigen::RowVectorXd(c.tangent.row(0)),
             .tangent_offset = c.tangent.rows() == 0 ? 0 : c.tangent_offset[0],
             .coefficient = c.resting,
             .resting = c.resting});
    FrictionModes all;
    for (bool changed = true; changed;) {
        all = consistent_friction_modes(here.M, momentum, here.bilateral.rows, here.bilateral.offset, rows);
        changed = false;
        for (std::size_t i = 0; i < rows.size() && all.different.size() == 1; ++i) {
            if (all.different[0].moves[i] == 0 || rows[i].coefficient == contacts[i].coefficient) continue;
            rows[i].coefficient = rows[i].resting = contacts[i].coefficient;
            changed = true;
        }
    }
    // A choice whose impulses are not unique is not solved there.
    if (all.different.empty() && !all.is_complete) return in_cones(here, momentum, contacts);
    const auto failed = [](const char* why) {
        return Together{.failure = why, .after = {}, .normal = {}, .bilateral = {}, .tangential = {}};
    };
    if (all.different.empty()) return failed(no_choice_is_consistent);
    if (all.different.size() > 1) return failed(several_choices_are_consistent);
    const FrictionMode& hit = all.different[0];
    Together result{
        .failure = {}, .after = hit.after, .normal = hit.normal, .bilateral = hit.bilateral, .tangential = {}};
    for (std::size_t i = 0; i < contacts.size(); ++i)
        result.tangential.push_back(
            VectorXd::Constant(contacts[i].tangent.rows(), hit.tangential[static_cast<Index>(i)]));
    return result;
}

FrictionalImpact together(const Situation& here, const VectorXd& before, const std::vector<int>& near,
                          const std::vector<double>& restitution, const VectorXd& kick) {
    std::vector<ContactCone> rows;
    bool in_a_plane = false;
    const VectorXd speed = gap_rates(here, before);
    for (const int k : near) {
        const std::optional<RoughContact> contact = contact_at(here, k);
        if (!contact || contact->grip > 0)
            return {.failure =
                        "simultaneous impacts with friction can be computed where each contact has one "
                        "friction, without a restitution of its own",
                    .after = {}};
        const double e = restitution[static_cast<std::size_t>(k)];
        const Index components = contact->across.size() > 0 ? 2 : contact->tangent.isZero(0) ? 0 : 1;
        in_a_plane = in_a_plane || components == 2;
        ContactCone row{.normal = contact->normal,
                        .offset = contact->normal_offset + e * std::min(0.0, speed[k]),
                        .tangent = Eigen::MatrixXd(components, before.size()),
                        .tangent_offset = VectorXd(components),
                        .coefficient = contact->coefficient,
                        .resting = contact->resting};
        if (components > 0) {
            row.tangent.row(0) = contact->tangent;
            row.tangent_offset[0] = contact->tangent_offset;
        }
        if (components > 1) {
            row.tangent.row(1) = contact->across;
            row.tangent_offset[1] = contact->across_offset;
        }
        rows.push_back(std::move(row));
    }
    const VectorXd momentum = here.M * before + kick;
    const Together hit = in_a_plane ? in_cones(here, momentum, rows) : in_lines(here, momentum, rows);
    if (!hit.failure.empty()) return {.failure = hit.failure, .after = {}};
    const VectorXd after = gap_rates(here, hit.after), mean = (before + hit.after) / 2;
    FrictionalImpact result{
        .failure = {}, .after = hit.after, .work = hit.bilateral.dot(here.bilateral.rows * mean) + kick.dot(mean)};
    double loss = 0, size = 0;
    for (std::size_t i = 0; i < near.size(); ++i) {
        const int k = near[i];
        const double pi = hit.normal[static_cast<Index>(i)];
        if (!(pi > 0)) continue;
        const VectorXd& tau = hit.tangential[i];
        const double normal = pi * rows[i].normal.dot(mean), along = tau.dot(rows[i].tangent * mean);
        const double lost = -normal - pi * here.contacts.offset[k] - along - tau.dot(rows[i].tangent_offset);
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

/// The contacts in groups of which none feels the impulses of another: they change neither its gaps nor its
/// sliding velocities.
std::vector<std::vector<int>> groups_of(const Situation& here, const std::vector<int>& near) {
    std::vector<Eigen::MatrixXd> rows, responses;
    for (const int k : near) {
        Eigen::MatrixXd own = here.contacts.rows.row(k);
        for (const Situation::Rough& rough : here.rough) {
            if (rough.contact != k) continue;
            own.conservativeResize(own.rows() + rough.tangent.rows(), Eigen::NoChange);
            own.bottomRows(rough.tangent.rows()) = rough.tangent;
        }
        Eigen::MatrixXd response(own.cols(), own.rows());
        for (Index i = 0; i < own.rows(); ++i)
            response.col(i) = response_to(here.M, here.bilateral.rows, own.row(i).transpose());
        rows.push_back(std::move(own));
        responses.push_back(std::move(response));
    }
    const auto feels = [&](std::size_t a, std::size_t b) {
        const Eigen::MatrixXd felt = (rows[a] * responses[b]).cwiseAbs();
        const VectorXd own = (rows[a] * responses[a]).diagonal().cwiseMax(0).cwiseSqrt(),
                       other = (rows[b] * responses[b]).diagonal().cwiseMax(0).cwiseSqrt();
        return (felt.array() > no_effect * (own * other.transpose()).array()).any();
    };
    std::vector<std::size_t> group(near.size());
    for (std::size_t i = 0; i < near.size(); ++i) group[i] = i;
    for (std::size_t a = 0; a < near.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (group[a] != group[b] && feels(a, b))
                std::replace(group.begin(), group.end(), std::size_t(group[a]), std::size_t(group[b]));
    std::vector<std::vector<int>> result;
    for (std::size_t g = 0; g < near.size(); ++g) {
        std::vector<int> members;
        for (std::size_t i = 0; i < near.size(); ++i)
            if (group[i] == g) members.push_back(near[i]);
        if (!members.empty()) result.push_back(std::move(members));
    }
    return result;
}

/// Nothing if no contact of the group strikes.
std::optional<FrictionalImpact> strike_group(const Situation& here, const VectorXd& before,
                                             const std::vector<int>& group,
                                             const std::vector<double>& restitution) {
    const VectorXd rates = gap_rates(here, before), still = negligible_rates(here, before);
    std::vector<int> striking;
    for (const int k : group)
        if (rates[k] < -still[k]) striking.push_back(k);
    if (striking.empty()) return std::nullopt;
    if (striking.size() == 1)
        if (std::optional<FrictionalImpact> hit =
                alone(here, before, group, striking[0], restitution[static_cast<std::size_t>(striking[0])]))
            return hit;
    return together(here, before, group, restitution, VectorXd::Zero(before.size()));
}

}  // namespace

FrictionalImpact strike_rough_contacts(const Situation& here, const VectorXd& before, const std::vector<int>& near,
                                       const std::vector<double>& restitution, const VectorXd& kick) {
    if (kick.size() > 0) return together(here, before, near, restitution, kick);
    FrictionalImpact all{.failure = {}, .after = before};
    for (const std::vector<int>& group : groups_of(here, near)) {
        const std::optional<FrictionalImpact> hit = strike_group(here, before, group, restitution);
        if (!hit) continue;
        if (!*hit) return *hit;
        all.after += hit->after - before;
        all.work += hit->work;
        all.events.insert(all.events.end(), hit->events.begin(), hit->events.end());
    }
    return all;
}

}  // namespace alembert
