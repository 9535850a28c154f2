// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The system that a derivation is about: its quantities, its motions, and the verdict on claims about it.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "analysis/derive/derived.hpp"
#include "check/check.hpp"
#include "check/claims.hpp"
#include "check/derivation/letters.hpp"
#include "check/derivation/motion_rows.hpp"
#include "check/derivation/world.hpp"

namespace alembert {

/// A line in the language of claims.
struct LineClaim {
    std::string lhs, rhs;
    std::vector<std::string> constants = {};  ///< names that it claims to be constant
    /// Near this state it is to hold to first order; empty if it is to hold exactly.
    std::vector<std::pair<std::string, std::string>> near = {};
    bool at_rest = false;    ///< whether it speaks of states of rest
    bool at_impact = false;  ///< whether its rates are those just after the scene's impulses
    bool open = false;       ///< whether it is about motions with open contacts only
};

class DerivedSystem {
public:
    /// Throws what `derived` throws.
    DerivedSystem(Scene scene, const std::string& by);
    DerivedSystem(const DerivedSystem&) = delete;
    DerivedSystem& operator=(const DerivedSystem&) = delete;

    const Scene& scene() const { return derived_.scene; }
    const Mechanism& mechanism() const { return m_; }
    const Equations& equations() const { return e_; }
    const std::shared_ptr<RootSheets>& sheets() const { return derived_.sheets; }
    MotionRows& rows() { return *rows_; }
    /// A symbol in place of a value of this name, which is held while something is differentiated.
    GiNaC::symbol held(const std::string& name) {
        const auto [place, is_new] = held_.try_emplace(name);
        if (is_new) claims_->add_letter(place->second = m_.symbols->declare(name, SymbolInfo::Kind::other));
        return place->second;
    }

    /// Generalized forces: of the loads that have no potential, or of all.
    std::vector<GiNaC::ex> forces(bool with_potential) const;
    /// Σ λ ∂f/∂q of the constraints along coordinate i.
    GiNaC::ex reaction(int i) const;
    /// The equation of motion along coordinate i, as what vanishes.
    GiNaC::ex motion_residual(int i) const;

    /// A speed of motions that the constraints allow: one of the scene's, or one that is chosen as `derive` does.
    struct IndependentSpeed {
        std::string name;                    ///< that of the coordinate for its rate
        bool is_rate = false;                ///< whether it is the rate of a coordinate
        bool is_of_scene = false;            ///< whether the scene defines it
        GiNaC::ex form;                      ///< in q, q', t
        std::vector<GiNaC::ex> slopes = {};  ///< ∂q'/∂u, one for each coordinate
    };
    /// Empty if the scene has no speeds and no nonholonomic constraint, or if the speeds do not determine the
    /// rates.
    std::vector<IndependentSpeed> independent_speeds() const;
    /// What is zero at states of rest, one for each coordinate: the forces and the reactions at q' = q'' = 0.
    std::vector<GiNaC::ex> conditions_of_rest() const;
    /// The expressions at q' = q'' = 0.
    std::vector<GiNaC::ex> at_rest(const std::vector<GiNaC::ex>& list) const;
    /// The expression without accelerations: at q'' = 0.
    GiNaC::ex without_accelerations(const GiNaC::ex& e) const;
    /// The inputs and their derivatives as the scene gives them in t: a support's s = a t²/2.
    GiNaC::exmap inputs_in_time() const;
    /// The values with which nothing resists a motion: the parameters of dampers and friction are zero. Empty if
    /// there are none such, or if these parameters do more than that.
    GiNaC::exmap without_resistance() const;
    /// Multipliers become unknowns of the program.
    std::vector<int> lower(Program& program, const std::vector<GiNaC::ex>& list) const {
        return claims_->lower(program, list);
    }

    /// The verdicts of the check, with slips; `known` are further names with their values.
    std::vector<CheckedClaim> check(const std::vector<LineClaim>& claims,
                                    const std::map<std::string, GiNaC::ex>& known) const;

private:
    std::vector<IndependentSpeed> solved_speeds() const;

    mutable std::optional<std::vector<IndependentSpeed>> speeds_;  ///< made when they are first asked for
    Derived derived_;
    std::string by_;
    Mechanism m_;
    Equations e_;
    std::unique_ptr<Claims> claims_;
    std::unique_ptr<MotionRows> rows_;
    std::map<std::string, GiNaC::symbol> held_;
};

/// The verdicts together; where that fails, of each claim alone.
std::vector<CheckedClaim> verdicts_on(const std::vector<LineClaim>& claims,
                                      const std::map<std::string, GiNaC::ex>& known, const DerivedSystem& system);

}  // namespace alembert
