// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/basis.hpp"

#include "analysis/state/branch.hpp"

namespace alembert {

Basis::Basis(const Mechanism& of, Equations derived, GiNaC::exmap counted)
    : equations(std::move(derived)), mechanism(in_terms_of(equations, of)), driven(std::move(counted)) {}

Equations Basis::with_multipliers(const std::vector<std::size_t>& undetermined) const {
    Equations law = equations;
    for (const std::size_t k : undetermined) {
        const Mechanism::Constraint& c = *mechanism.undetermined()[k];
        for (int i = 0; i < law.size(); ++i) law.own[i] += c.row[i] * c.multiplier;
    }
    return law;
}

const std::optional<OwnBranch>& Basis::own_branch() {
    if (!own_branch_) own_branch_ = alembert::own_branch(mechanism);
    return *own_branch_;
}

std::unique_ptr<ExactStates> Basis::own_states(const Wanted& wanted, const Mechanism& of) {
    const Equations law =
        wanted.is_any_motion ? any_motion(equations, mechanism) : with_multipliers(wanted.spoken);
    auto made = std::make_unique<ExactStates>(
        of, law,
        Motions::Sampling{.at = wanted.at,
                          .halves = wanted.halves,
                          .halvings = wanted.halvings,
                          .positions = wanted.positions,
                          .own = wanted.knows_own_branch ? own_branch() : std::optional<OwnBranch>()});
    if (wanted.stays_on_own_branch) made->stay_on_own_branch();
    return made;
}

ExactStates& Basis::states(const Wanted& wanted) {
    std::unique_ptr<ExactStates>& made = states_[wanted];
    if (!made) made = own_states(wanted, mechanism);
    return *made;
}

Equations any_motion(Equations e, const Mechanism& m) {
    for (int i = 0; i < e.size(); ++i) {
        const auto row = static_cast<unsigned>(i);
        for (unsigned j = 0; j < e.M.cols(); ++j) e.M(row, j) = row == j ? 1 : 0;
        e.own[i] = m.qddot[i];
        e.dissipative[i] = 0;
        e.applied[i] = 0;
    }
    return e;
}

}  // namespace alembert
