// SPDX-License-Identifier: MIT
#include "alembert/hybrid/phase_guards.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "alembert/base/tolerances.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double part_of_row = 1e-9;   // coefficients below this part of the largest are rounding
constexpr double finest_gap = 1e-12;   // of the size of its terms: what stays of a gap after it has been closed
constexpr double reaction_slack = 10;  // times the tolerance: errors of the state, through the accelerations

/// The size of a reaction that would balance the other forces of the system.
double reaction_scale(const Situation& here, const VectorXd& acceleration, int k) {
    const VectorXd row = here.contacts.rows.row(k).cwiseAbs();
    const VectorXd force = here.f.cwiseAbs() + here.M.cwiseAbs() * acceleration.cwiseAbs();
    double size = 0;
    for (Index i = 0; i < row.size(); ++i)
        if (row[i] > part_of_row * row.maxCoeff()) size = std::max(size, force[i]);
    return row.maxCoeff() > 0 ? size / row.maxCoeff() : 0;
}

/// Gaps and reactions at the start of a phase.
class ContactGuards {
public:
    ContactGuards(const Contacts& contacts, const PhaseStart& start, const std::vector<double>& rate)
        : start_(start), here_(contacts.situation(start.t, start.state.data())), n_(here_.f.size()) {
        const Eigen::Map<const VectorXd> q(start.state.data(), n_), u(start.state.data() + n_, n_);
        acceleration_ = Eigen::Map<const VectorXd>(rate.data() + n_, n_);
        speed_ = gap_rates(here_, u);
        still_ = negligible_rates(here_, u);
        sizes_ = negligible_gaps(here_, q, 1);
    }

    HeldGuard operator()(int k, double value) const {
        return contains(start_.closed, k) ? of_reaction(k, value) : of_gap(k, value);
    }

private:
    HeldGuard of_reaction(int k, double value) const {
        const double uncertain = reaction_slack * start_.tolerance * reaction_scale(here_, acceleration_, k);
        if (!(value <= uncertain)) return {};
        return {.bound = 2 * std::max(uncertain, -value) + std::numeric_limits<double>::min()};
    }

    HeldGuard of_gap(int k, double value) const {
        const double slack = start_.tolerance * sizes_[k], off = std::abs(value);
        if (!(value <= slack)) return {};  // also where it has no value
        if (!(speed_[k] > still_[k])) {
            const double known = contains(start_.resting, k) ? reaction_slack * slack : finest_gap * sizes_[k];
            return {.bound = std::max(known, 2 * off)};
        }
        const double fall = here_.contacts.acceleration[k] - here_.contacts.rows.row(k).dot(acceleration_);
        const double rise = (2 * off + 16 * tolerance::epsilon * sizes_[k]) / speed_[k];
        const double quarter_of_flight = fall > 0 ? speed_[k] / fall / 2 : rise;
        return {.until = start_.t + std::min(rise, quarter_of_flight)};
    }

    const PhaseStart& start_;
    Situation here_;
    Index n_;
    VectorXd acceleration_, speed_, still_, sizes_;
};

}  // namespace

Events phase_guards(const Contacts& contacts, const ContactMode& mode, const PhaseStart& start) {
    const std::size_t scene = mode.events.list.size() - contacts.names.size();
    std::vector<Event> list = mode.events.list;
    for (std::size_t k = 0; k < scene; ++k) {
        if (!contacts.kicks.has(k)) continue;
        list[k].stop = true;
        list[k].at_once = !start.is_first;
    }
    std::vector<HeldGuard> held;
    for (const PassedZero& zero : start.passed) held.push_back(held_from(start.t, zero));
    if (contacts.names.empty()) return with_guards_held(mode.events, std::move(list), held);
    held.resize(list.size());
    std::vector<double> rate(start.state.size()), value(list.size());
    mode.system.rhs(start.t, start.state.data(), rate.data());
    mode.events(start.t, start.state.data(), rate.data(), value.data());
    const ContactGuards guard(contacts, start, rate);
    for (std::size_t k = scene; k < list.size(); ++k) {
        list[k].stop = list[k].at_once = true;
        held[k] = guard(static_cast<int>(k - scene), value[k]);
    }
    return with_guards_held(mode.events, std::move(list), held);
}

}  // namespace alembert
