// SPDX-License-Identifier: MIT
#include "alembert/hybrid/contact_transition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "alembert/base/dense.hpp"
#include "alembert/hybrid/frictional_impact.hpp"
#include "alembert/hybrid/frictionless_impact.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double clock_grain = 1e-12;  // relative to the time; flights shorter than this cannot be resolved
constexpr int most_rounds = 4;         // Newton's method from within the tolerance needs one or two

class Settling {
public:
    Settling(const Contacts& contacts, const PhaseEnd& instant, std::vector<double>& state)
        : contacts_(contacts), at_(instant), state_(state), count_(static_cast<int>(contacts.names.size())) {
        look();
        n_ = here_.f.size();
    }

    ContactTransition go() {
        if (n_ == 0) return {};  // a system of states alone
        place();
        find_near();
        if (!strike_all()) return std::move(result_);
        while (lay_one_down()) {
        }
        choose();
        tell_changes();
        return std::move(result_);
    }

private:
    void look() { here_ = contacts_.situation(at_.t, state_.data()); }
    Eigen::Map<VectorXd> q() { return {state_.data(), n_}; }
    Eigen::Map<VectorXd> u() { return {state_.data() + n_, n_}; }
    bool approaches(int k) { return gap_rates(here_, u())[k] < -negligible_rates(here_, u())[k]; }
    bool parts(int k) { return gap_rates(here_, u())[k] > negligible_rates(here_, u())[k]; }

    /// Moves the positions so that the gaps that touch and do not open are zero.
    void place() {
        const VectorXd slack = negligible_gaps(here_, q(), at_.tolerance);
        std::vector<int> touching;
        for (int k = 0; k < count_; ++k)
            if (contains(at_.closed, k) || contains(at_.touched, k) ||
                (std::abs(here_.contacts.value[k]) <= slack[k] && !parts(k)))
                touching.push_back(k);
        double former = HUGE_VAL;
        for (int round = 0; round < most_rounds && !touching.empty(); ++round) {
            const Situation::Rows rows = stacked(here_.bilateral, selected(here_.contacts, touching));
            const double size = rows.value.lpNorm<Eigen::Infinity>();
            if (!(size > 0) || !(size < former / 2)) return;
            former = size;
            const MatrixXd weighted = solve_symmetric(here_.M, rows.rows.transpose());
            const VectorXd change = weighted * least_norm(rows.rows * weighted, rows.value).x;
            if (!change.allFinite()) return;
            q() -= change;
            look();
        }
    }

    void find_near() {
        const VectorXd slack = negligible_gaps(here_, q(), at_.tolerance);
        for (int k = 0; k < count_; ++k)
            if (contains(at_.closed, k) || contains(at_.touched, k) ||
                std::abs(here_.contacts.value[k]) <= slack[k])
                near_.push_back(k);
    }

    /// Sets new rates and reports the work of generalized impulses and of impulses Λ along rows: Σ Λ·(mean of
    /// value' − offset).
    void jump_to(const VectorXd& after, const Situation::Rows& rows, const VectorXd& impulse,
                 const VectorXd& generalized) {
        const VectorXd mean = (u() + after) / 2;
        jump_to(after, impulse.dot(rows.rows * mean) + generalized.dot(mean));
    }

    void jump_to(const VectorXd& after, double work) {
        const std::vector<double> before = state_;
        u() = after;
        look();
        if (contacts_.on_jump) contacts_.on_jump(at_.t, before.data(), state_.data(), work);
    }

    bool strike_all() {
        result_.struck = u();
        const bool is_kicked = at_.impulse.size() > 0;
        if (!is_kicked && std::none_of(near_.begin(), near_.end(), [&](int k) { return approaches(k); }))
            return true;
        for (const Situation::Rough& rough : here_.rough)
            if (contains(near_, rough.contact)) return strike_with_friction(is_kicked);
        const VectorXd kick = is_kicked ? at_.impulse : VectorXd::Zero(n_);
        const Situation::Rows rows = selected(here_.contacts, near_);
        VectorXd restitution(rows.offset.size());
        for (std::size_t i = 0; i < near_.size(); ++i)
            restitution[static_cast<Index>(i)] = contacts_.restitution[near_[i]];
        const FrictionlessImpact hit = strike(here_.M, u(), kick, {here_.bilateral.rows, here_.bilateral.offset},
                                              {rows.rows, rows.offset}, restitution);
        if (!hit) return is_kicked ? fail_kick(hit.failure) : fail(near_, hit.failure);
        result_.struck = hit.after;
        const VectorXd before = rows.rows * u() + rows.offset, after = rows.rows * hit.after + rows.offset;
        for (std::size_t i = 0; i < near_.size(); ++i) {
            const auto at = static_cast<Index>(i);
            if (hit.contact[at] <= 0) continue;
            bounced_.push_back(near_[i]);
            result_.events.push_back(
                {.kind = ContactEvent::Kind::impact,
                 .contact = near_[i],
                 .time = at_.t,
                 .speed_before = before[at],
                 .speed_after = after[at],
                 .energy_loss = hit.contact[at] * (rows.offset[at] - (before[at] + after[at]) / 2),
                 .impulse = hit.contact[at]});
        }
        VectorXd impulse(hit.bilateral.size() + hit.contact.size());
        impulse << hit.bilateral, hit.contact;
        jump_to(hit.after, stacked(here_.bilateral, rows), impulse, kick);
        return true;
    }

    bool strike_with_friction(bool is_kicked) {
        const FrictionalImpact hit =
            strike_rough_contacts(here_, u(), near_, contacts_.restitution, is_kicked ? at_.impulse : VectorXd());
        if (!hit) return fail(near_, hit.failure);
        result_.struck = hit.after;
        for (ContactEvent event : hit.events) {
            event.time = at_.t;
            bounced_.push_back(event.contact);
            result_.events.push_back(event);
        }
        jump_to(hit.after, hit.work);
        return true;
    }

    std::vector<int> candidates() {
        std::vector<int> result;
        for (const int k : near_)
            if (!approaches(k) && !parts(k)) result.push_back(k);
        return result;
    }

    /// Brings to rest the first contact whose bounces have become too low to follow.
    bool lay_one_down() {
        for (const int k : bounced_) {
            if (!parts(k)) continue;
            const std::vector<int> resting = candidates();
            const LastingContacts motion = lasting_contacts(here_, resting);
            if (!motion) return false;
            const double fall =
                here_.contacts.acceleration[k] - here_.contacts.rows.row(k).dot(motion.acceleration);
            const double speed = gap_rates(here_, u())[k], e = contacts_.restitution[k];
            if (!(fall > 0)) continue;
            const double flight = 2 * speed / fall, all = e < 1 ? flight / (1 - e) : HUGE_VAL;
            const Situation::Rows rows = stacked(here_.bilateral, selected(here_.contacts, joined(resting, k)));
            const FrictionlessImpact still = strike(here_.M, u(), VectorXd::Zero(n_), {rows.rows, rows.offset},
                                                    {MatrixXd(0, n_), VectorXd()}, VectorXd());
            if (!still) continue;
            const VectorXd displaced = (u() - still.after) * all;
            const bool is_low =
                (displaced.cwiseAbs().array() <= at_.tolerance * q().cwiseAbs().cwiseMax(1.0).array()).all();
            if (!is_low && flight > clock_grain * std::abs(at_.t)) continue;
            const double last = at_.t + (e < 1 ? all : 0),
                         loss = still.bilateral.tail(1)[0] * (here_.contacts.offset[k] - speed / 2);
            rests_[k] = {.kind = ContactEvent::Kind::rest,
                         .contact = k,
                         .time = last,
                         .speed_before = speed,
                         .energy_loss = loss};
            for (const int other : bounced_)  // another bouncing contact may come to rest with it
                if (other != k && parts(other))
                    rests_.emplace(other,
                                   ContactEvent{.kind = ContactEvent::Kind::rest, .contact = other, .time = last});
            jump_to(still.after, rows, still.bilateral, VectorXd::Zero(n_));
            return true;
        }
        return false;
    }

    static std::vector<int> joined(std::vector<int> list, int k) {
        list.push_back(k);
        return list;
    }

    void choose() {
        const std::vector<int> all = candidates();
        if (at_.released && contains(all, *at_.released)) {
            const int k = *at_.released;
            std::vector<int> others = all;
            others.erase(std::find(others.begin(), others.end(), k));
            if (const LastingContacts without = lasting_contacts(here_, others)) {
                const double opens = opening(here_, without, k);
                const double small =
                    at_.tolerance * acceleration_scale(k, without.acceleration) + uncertainty(others, k, opens);
                if (opens >= -small) {
                    take(without);
                    if (std::abs(opens) <= small && is_carried(here_, without.closed, k))
                        result_.resting.push_back(k);
                    return;
                }
            }
        }
        const LastingContacts lasting = lasting_contacts(here_, all);
        if (lasting)
            take(lasting);
        else if (count_ > 0)
            result_.failure = refusal_of(lasting, at_.t, all, contacts_.names);
    }

    /// gap'' of contact k without its force.
    static double opening(const Situation& here, const LastingContacts& without, int k) {
        return here.contacts.rows.row(k).dot(without.acceleration) - here.contacts.acceleration[k];
    }

    /// By how much errors of the state and of the instant change gap'' of a contact whose reaction has just come
    /// down to zero. There the forces that press it balance, so that gap'' itself does not tell its size; and
    /// since the reaction falls, gap''' decides, which is positive.
    double uncertainty(const std::vector<int>& others, int k, double opens) const {
        constexpr double instant = 1e-12;
        const auto change = [&](double t, const std::vector<double>& state) {
            const Situation beside = contacts_.situation(t, state.data());
            const LastingContacts without = lasting_contacts(beside, others);
            return without ? std::abs(opening(beside, without, k) - opens) : 0;
        };
        double sum = change(at_.t + instant * std::max(1.0, std::abs(at_.t)), state_);
        for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(n_); ++i) {
            std::vector<double> state = state_;
            state[i] += at_.tolerance * std::max(1.0, std::abs(state[i]));
            sum += change(at_.t, state);
        }
        return sum;
    }

    /// The size that gap'' has with or without the contact forces; its errors are measured relative to it.
    double acceleration_scale(int k, const VectorXd& acceleration) const {
        const LastingContacts free = lasting_contacts(here_, {});
        VectorXd size = acceleration.cwiseAbs();
        if (free) size = size.cwiseMax(free.acceleration.cwiseAbs());
        return here_.contacts.rows.row(k).cwiseAbs().dot(size) + std::abs(here_.contacts.acceleration[k]);
    }

    void take(const LastingContacts& lasting) {
        result_.closed = lasting.closed;
        result_.resting = lasting.resting;
        result_.acceleration = lasting.acceleration;
    }

    void tell_changes() {
        for (const int k : at_.resting)
            if (!contains(result_.resting, k))
                result_.events.push_back({.kind = ContactEvent::Kind::release,
                                          .contact = k,
                                          .time = at_.t,
                                          .speed_after = gap_rates(here_, u())[k]});
        for (const int k : result_.resting) {
            if (contains(at_.resting, k)) continue;
            const auto found = rests_.find(k);
            result_.events.push_back(
                found != rests_.end()
                    ? found->second
                    : ContactEvent{.kind = ContactEvent::Kind::rest, .contact = k, .time = at_.t});
        }
    }

    bool fail(const std::vector<int>& those, const std::string& why) {
        result_.failure = refusal_of({.failure = why}, at_.t, those, contacts_.names);
        return false;
    }

    bool fail_kick(const std::string& why) {
        result_.failure =
            fmt::format("there are no rates after the impulses of the events at t = {}: {}", at_.t, why);
        return false;
    }

    const Contacts& contacts_;
    const PhaseEnd& at_;
    std::vector<double>& state_;
    int count_;
    Index n_ = 0;
    Situation here_;
    std::vector<int> near_, bounced_;
    std::map<int, ContactEvent> rests_;
    ContactTransition result_;
};

}  // namespace

ContactTransition settle(const Contacts& contacts, const PhaseEnd& instant, std::vector<double>& state) {
    return Settling(contacts, instant, state).go();
}

}  // namespace alembert
