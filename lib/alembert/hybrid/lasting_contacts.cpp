// SPDX-License-Identifier: MIT
#include "alembert/hybrid/lasting_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alembert/base/dense.hpp"
#include "alembert/hybrid/friction_modes.hpp"
#include "alembert/hybrid/frictionless_impact.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rank_threshold = 1e-9;  // for rows of length 1
constexpr double negligible_rate = 1e-9, rounding = 1e-13;

/// Rows scaled to length 1 (or 0), and their lengths before.
struct Unit {
    MatrixXd rows;
    VectorXd length;
    explicit Unit(MatrixXd given) : rows(std::move(given)), length(rows.rowwise().norm()) {
        for (Index i = 0; i < rows.rows(); ++i)
            if (length[i] > 0) rows.row(i) /= length[i];
    }
};

Index rank(const MatrixXd& rows) {
    if (rows.rows() == 0) return 0;
    return Orthogonal(Unit(rows).rows.transpose(), rank_threshold).rank();
}

/// Moves load between dependent contacts until the contacts that carry load are independent; the total forces stay
/// the same.
void concentrate(const Situation& here, std::vector<int>& carrying, std::vector<double>& load) {
    const Index m = here.bilateral.rows.rows();
    for (;;) {
        const Unit unit(stacked(here.bilateral, selected(here.contacts, carrying)).rows);
        if (unit.rows.rows() == 0) return;
        Eigen::FullPivLU<MatrixXd> lu;
        lu.setThreshold(rank_threshold);
        lu.compute(unit.rows.transpose());
        if (lu.dimensionOfKernel() == 0) return;
        const MatrixXd kernel = lu.kernel();
        VectorXd shift;
        for (Index c = 0; c < kernel.cols() && shift.size() == 0; ++c)
            if (kernel.col(c).tail(kernel.rows() - m).norm() > rank_threshold * kernel.col(c).norm())
                shift = kernel.col(c).tail(kernel.rows() - m);
        if (shift.size() == 0) return;  // the bilateral rows alone are dependent
        if (shift.maxCoeff() <= 0) shift = -shift;
        for (Index i = 0; i < shift.size(); ++i) shift[i] /= unit.length[m + i];
        std::size_t first = carrying.size();
        double part = 0;
        for (std::size_t i = 0; i < carrying.size(); ++i) {
            const double d = shift[static_cast<Index>(i)];
            if (d > 0 && (first == carrying.size() || load[i] / d < part)) part = load[i] / d, first = i;
        }
        for (std::size_t i = 0; i < carrying.size(); ++i) load[i] -= part * shift[static_cast<Index>(i)];
        carrying.erase(carrying.begin() + static_cast<std::ptrdiff_t>(first));
        load.erase(load.begin() + static_cast<std::ptrdiff_t>(first));
    }
}

/// The friction of a contact as one row along which it slides, or sticks; nothing if it is not clear.
bool add_friction(FrictionRows& row, const Situation::Rough& rough) {
    const double speed = rough.velocity.norm();
    const bool slides = speed > rough.still;
    if (rough.tangent.rows() > 1 && !slides) return false;
    const VectorXd along = rough.tangent.rows() == 1 ? VectorXd::Ones(1) : VectorXd(rough.velocity / speed);
    row.tangent = along.transpose() * rough.tangent;
    row.tangent_offset = -along.dot(rough.acceleration);
    row.coefficient = rough.coefficient;
    row.resting = rough.resting;
    row.side = !slides ? 0 : rough.tangent.rows() > 1 || rough.velocity[0] > 0 ? 1 : -1;
    return true;
}

/// Sliding has the side that it has already, or else the one to which it begins; in a plane it has none.
std::vector<std::string> modes_of(const FrictionMode& choice, const std::vector<FrictionRows>& rows,
                                  const std::vector<bool>& in_plane) {
    std::vector<std::string> modes;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const int side = rows[i].side != 0 ? rows[i].side : choice.moves[i];
        modes.emplace_back(!choice.closed[i]             ? "open"
                           : rows[i].tangent.size() == 0 ? "closed"
                           : side == 0                   ? "stick"
                           : in_plane[i]                 ? "slip"
                           : side > 0                    ? "slip +"
                                                         : "slip -");
    }
    return modes;
}

/// The contacts that last with their friction; `closed` is empty where that is not known.
LastingContacts lasting_with_friction(const Situation& here, const std::vector<int>& candidates) {
    LastingContacts lasting;
    if (candidates.size() > most_contacts_with_friction) return lasting;
    std::vector<FrictionRows> rows;
    std::vector<bool> in_plane;
    bool any = false;
    for (const int k : candidates) {
        in_plane.push_back(false);
        rows.push_back({.normal = here.contacts.rows.row(k),
                        .offset = -here.contacts.acceleration[k],
                        .tangent = {},
                        .tangent_offset = 0});
        int frictions = 0;
        for (const Situation::Rough& rough : here.rough) {
            if (rough.contact != k) continue;
            if (++frictions > 1 || !add_friction(rows.back(), rough)) return lasting;
            in_plane.back() = rough.tangent.rows() > 1;
        }
        any = any || frictions > 0;
    }
    if (!any) return lasting;
    const FrictionModes all =
        consistent_friction_modes(here.M, here.f, here.bilateral.rows, -here.bilateral.acceleration, rows);
    if (all.different.empty()) return lasting;
    if (all.different.size() > 1) {
        lasting.failure = "their accelerations differ";
        for (const FrictionMode& choice : all.different)
            lasting.several.push_back(modes_of(choice, rows, in_plane));
        return lasting;
    }
    const FrictionMode& found = all.different[0];
    lasting.acceleration = found.after;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        if (found.closed[i]) lasting.closed.push_back(candidates[i]);
    lasting.resting = lasting.closed;
    return lasting;
}

}  // namespace

Situation::Rows selected(const Situation::Rows& rows, const std::vector<int>& which) {
    const auto count = static_cast<Index>(which.size());
    Situation::Rows result{MatrixXd(count, rows.rows.cols()), VectorXd(count), VectorXd(count), VectorXd(count)};
    for (Index i = 0; i < count; ++i) {
        const int k = which[static_cast<std::size_t>(i)];
        result.rows.row(i) = rows.rows.row(k);
        result.value[i] = rows.value[k];
        result.offset[i] = rows.offset[k];
        result.acceleration[i] = rows.acceleration[k];
    }
    return result;
}

Situation::Rows stacked(const Situation::Rows& a, const Situation::Rows& b) {
    const auto joined = [](const VectorXd& x, const VectorXd& y) {
        VectorXd result(x.size() + y.size());
        result << x, y;
        return result;
    };
    Situation::Rows result{MatrixXd(a.rows.rows() + b.rows.rows(), b.rows.cols()), joined(a.value, b.value),
                           joined(a.offset, b.offset), joined(a.acceleration, b.acceleration)};
    if (a.rows.rows() > 0) result.rows.topRows(a.rows.rows()) = a.rows;
    if (b.rows.rows() > 0) result.rows.bottomRows(b.rows.rows()) = b.rows;
    return result;
}

VectorXd gap_rates(const Situation& here, const VectorXd& rates) {
    return here.contacts.rows * rates + here.contacts.offset;
}

VectorXd negligible_rates(const Situation& here, const VectorXd& rates) {
    const VectorXd sizes = (negligible_rate * rates.cwiseAbs()).array() + rounding;
    return here.contacts.rows.cwiseAbs() * sizes + negligible_rate * here.contacts.offset.cwiseAbs();
}

VectorXd negligible_gaps(const Situation& here, const VectorXd& q, double tolerance) {
    return tolerance * (here.contacts.rows.cwiseAbs() * q.cwiseAbs().cwiseMax(1.0));
}

bool is_carried(const Situation& here, const std::vector<int>& closed, int k) {
    const MatrixXd without = stacked(here.bilateral, selected(here.contacts, closed)).rows;
    std::vector<int> more = closed;
    more.push_back(k);
    return rank(stacked(here.bilateral, selected(here.contacts, more)).rows) == rank(without);
}

std::string refusal_of(const LastingContacts& lasting, double t, const std::vector<int>& candidates,
                       const std::vector<std::string>& names) {
    const auto name = [&](std::size_t i) { return names[static_cast<std::size_t>(candidates[i])]; };
    std::string text;
    if (lasting.several.empty()) {
        for (std::size_t i = 0; i < candidates.size(); ++i) text += (i == 0 ? "'" : ", '") + name(i) + "'";
        return fmt::format("no contact mode is consistent at t = {} with the contacts {} closed: {}", t, text,
                           lasting.failure);
    }
    for (std::size_t k = 0; k < lasting.several.size(); ++k)
        for (std::size_t i = 0; i < candidates.size(); ++i)
            text += (i > 0 ? ", " : k > 0 ? " | " : "") + name(i) + ": " + lasting.several[k][i];
    return fmt::format("more than one contact mode is consistent at t = {}, with different accelerations: {}", t,
                       text);
}

LastingContacts lasting_contacts(const Situation& here, const std::vector<int>& candidates) {
    if (LastingContacts found = lasting_with_friction(here, candidates); !found.closed.empty() || !found)
        return found;
    const Situation::Rows contacts = selected(here.contacts, candidates);
    const FrictionlessImpact result = press(here.M, here.f, {here.bilateral.rows, -here.bilateral.acceleration},
                                            {contacts.rows, -contacts.acceleration});
    LastingContacts lasting{.failure = result.failure, .acceleration = result.after, .closed = {}, .resting = {}};
    if (!result) return lasting;
    std::vector<double> load;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const double pi = result.contact[static_cast<Index>(i)];
        if (pi <= 0 || !result.stays_closed[i]) continue;
        lasting.closed.push_back(candidates[i]);
        load.push_back(pi);
    }
    concentrate(here, lasting.closed, load);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (!result.stays_closed[i]) continue;
        lasting.resting.push_back(candidates[i]);
        const bool is_in =
            std::find(lasting.closed.begin(), lasting.closed.end(), candidates[i]) != lasting.closed.end();
        if (!is_in && !is_carried(here, lasting.closed, candidates[i])) lasting.closed.push_back(candidates[i]);
    }
    std::sort(lasting.closed.begin(), lasting.closed.end());
    return lasting;
}

}  // namespace alembert
