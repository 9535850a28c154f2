// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/contact/impact.hpp"

#include <fmt/format.h>

#include <cmath>

#include "alembert/base/dense.hpp"
#include "alembert/base/tolerances.hpp"
#include "analysis/contact/impact_algebra.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "model/formalism/routh.hpp"
#include "model/friction.hpp"
#include "program/lower/lower.hpp"
#include "program/rounding.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// A program with mass matrix, rows and positions. It has no accelerations, because there may be none with
/// constraints that only an impact can impose.
Program program_of(Mechanism m) {
    m.outputs.clear();
    m.events.clear();
    m.event_actions.clear();
    Energy energy = energy_of(m);
    energy.power = 0;
    return lower(m, routh(m), energy, {.states_are_given = true});
}

/// The numbers at the start that the law of impact needs.
class Numbers {
public:
    explicit Numbers(const Mechanism& m) : m_(m), program_(program_of(m)) {
        std::vector<ex> wanted = m.generalized_impulses();
        for (const Mechanism::Constraint& c : m.constraints) wanted.push_back(c.offset);
        for (const Mechanism::Unilateral& u : m.unilateral) {
            wanted.insert(wanted.end(), {*u.gap.position, u.gap.offset, u.restitution});
            wanted.insert(wanted.end(), u.gap.row.begin(), u.gap.row.end());
        }
        nodes_ = lower_expressions(program_, m, wanted);
    }

    Impact go() {
        Impact result;
        result.start = start_of(m_);
        result.adjusted = assemble(result.start, m_, lower_constraints(m_), {}, false);
        value_ = interpret(program_, result.start.state());
        find_contacts(result);
        find_broken(result);
        const Eigen::Index n = m_.size(), m = rows(Group::velocity),
                           k = static_cast<Eigen::Index>(result.contacts.size());
        Eigen::MatrixXd M(n, n), A(m, n), G(k, n);
        const std::vector<int> mass = program_.nodes_of(Group::mass), row = program_.nodes_of(Group::row);
        for (Eigen::Index i = 0, next = 0; i < n; ++i)
            for (Eigen::Index j = 0; j <= i; ++j) M(i, j) = M(j, i) = value_[mass[next++]];
        for (Eigen::Index c = 0; c < m; ++c)
            for (Eigen::Index i = 0; i < n; ++i) A(c, i) = value_[row[c * n + i]];
        Eigen::VectorXd impulse(n), b(m), c(k), e(k);
        for (Eigen::Index i = 0; i < n; ++i) impulse[i] = wanted(i);
        for (Eigen::Index i = 0; i < m; ++i) b[i] = wanted(n + i);
        for (Eigen::Index i = 0; i < k; ++i) {
            const Eigen::Index at = first_of(result.contacts[i]);
            c[i] = wanted(at + 1);
            e[i] = wanted(at + 2);
            for (Eigen::Index j = 0; j < n; ++j) G(i, j) = wanted(at + 3 + j);
        }
        const Eigen::VectorXd before = Eigen::Map<const Eigen::VectorXd>(result.start.qdot.data(), n);
        result.numbers = strike(M, before, impulse, {A, b}, {G, c}, e);
        if (!result.numbers)
            throw IntegrationError(say("there are no rates after the impact: {}", result.numbers.failure),
                                   result.start.t, result.start.q);
        take_least(result.numbers.bilateral, A);
        result.kinetic_before = before.dot(M * before) / 2;
        result.kinetic_after = result.numbers.after.dot(M * result.numbers.after) / 2;
        result.floors = -b.dot(result.numbers.bilateral) - c.dot(result.numbers.contact);
        const Eigen::VectorXd change = M * (result.numbers.after - before);
        const double size = (M * before).norm() + impulse.norm();
        result.nothing_happens = impulse.isZero(0) && result.imposed.empty() && change.norm() <= 1e-12 * size;
        return result;
    }

private:
    /// Where rows follow from others, the impulses of least norm that change the rates in the same way.
    static void take_least(Eigen::VectorXd& impulses, const Eigen::MatrixXd& A) {
        const Orthogonal across(A.transpose(), tolerance::dependent_row);
        if (across.rank() < A.rows()) impulses = across.solve(A.transpose() * impulses);
    }

    Eigen::Index rows(Group group) const { return static_cast<Eigen::Index>(program_.nodes_of(group).size()); }
    double wanted(Eigen::Index i) const { return value_[nodes_[i]]; }
    /// The index of the first value of a unilateral constraint; its values are gap, offset, restitution, row.
    Eigen::Index first_of(std::size_t u) const {
        return static_cast<Eigen::Index>(m_.size() + m_.constraints.size() + u * (3 + m_.size()));
    }

    void find_contacts(Impact& result) const {
        const std::vector<double> sizes = sizes_of_terms(program_, result.start.state());
        for (std::size_t u = 0; u < m_.unilateral.size(); ++u) {
            const Eigen::Index at = first_of(u);
            double size = sizes[nodes_[at]];
            for (int i = 0; i < m_.size(); ++i) size += std::abs(wanted(at + 3 + i) * result.start.q[i]);
            const double gap = wanted(at);
            if (gap < -tolerance::closed_gap * size)
                throw ModelError(
                    say("the gap '{}' is {:.6g} at the start; expected zero (contact) or more: give "
                        "initial values at which nothing penetrates",
                        m_.unilateral[u].gap.name, gap));
            if (gap <= tolerance::closed_gap * size) result.contacts.push_back(static_cast<int>(u));
        }
    }

    void find_broken(Impact& result) const {
        const std::vector<int> velocity = program_.nodes_of(Group::velocity);
        const std::vector<double> rounded = rounding_errors(program_, result.start.state()),
                                  sizes = sizes_of_terms(program_, result.start.state());
        for (std::size_t k = 0; k < velocity.size(); ++k)
            if (std::abs(value_[velocity[k]]) > tolerance::closed_gap * sizes[velocity[k]] + rounded[velocity[k]])
                result.imposed.push_back(m_.constraints[k].name);
    }

    const Mechanism& m_;
    Program program_;
    std::vector<int> nodes_;
    std::vector<double> value_;
};

}  // namespace

Impact impact(const Mechanism& mechanism) {
    Impact result = Numbers(mechanism).go();
    add_algebra(result, mechanism);
    return result;
}

Struck impact(Scene scene) {
    Struck result{prepared(std::move(scene))};
    need_given_normal_forces(result.mechanism, "impact");
    result.hit = impact(result.mechanism);
    return result;
}

}  // namespace alembert
