// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The claims of a scene as programs: what is zero if they are right, and how it depends on what the author leaves
/// open.

#include <map>
#include <set>

#include "contact/impact.hpp"
#include "exact/motions.hpp"
#include "model/formulas.hpp"

namespace alembert {

/// One equation, lhs − rhs, and its time derivatives.
struct ClaimForm {
    GiNaC::ex residual;
    std::vector<GiNaC::ex>
        derivatives;        ///< with respect to time, as far as accelerations reach; only of integrals
    std::vector<int> open;  ///< positions in Claims::open of the names that occur
    bool linear = true;     ///< in these
    int order = 0;          ///< highest derivative of a coordinate
};

/// A name that a claim leaves open: an unknown function or a constant of the motion.
struct Open {
    std::string name;
    bool constant = false;
    GiNaC::symbol symbol;
    Variable variable;
};

class Claims {
public:
    Claims(const Scene& scene, const Mechanism& mechanism, const Equations& equations,
           std::shared_ptr<RootSheets> sheets = {});

    /// Reads a claim of the scene. Throws SceneMistake.
    ClaimForm read(const Claim& claim);
    GiNaC::ex read(const Expression& expression) { return m_.z->name(formulas_.value(expression)); }

    /// Rates after the scene's impulses (§ `contact/impact.hpp`), as expressions at the pose where it starts;
    /// nothing where they are known in numbers only, or not at all: then `impact_obstacle` says why.
    const std::optional<Impact::Exact>& after_impact();
    const std::string& impact_obstacle() const { return impact_obstacle_; }

    /// Lowers into `program`; symbols of multipliers and open names become its unknowns.
    std::vector<int> lower(Program& program, const std::vector<GiNaC::ex>& list) const;

    const std::vector<Open>& open() const { return open_; }
    const Mechanism& mechanism() const { return m_; }
    const Equations& equations() const { return e_; }
    std::vector<GiNaC::symbol> open_symbols() const;

private:
    GiNaC::ex at_impact(const GiNaC::ex& e) const;
    void know_intermediates(const Scene& scene);
    void open_name(const std::string& name, bool constant);
    GiNaC::ex without_third_derivatives(const GiNaC::ex& residual, Place at) const;

    const Mechanism& m_;
    const Equations& e_;
    Formulas formulas_;
    std::vector<Open> open_;
    std::vector<GiNaC::symbol> third_;  ///< q'''
    bool has_struck_ = false;
    std::optional<Impact::Exact> after_;
    std::string impact_obstacle_;
};

/// The time derivative at most `times` times, each in q'' at the highest; nothing more once it would hold q'''.
int order_of(const GiNaC::ex& e, const Mechanism& mechanism);

}  // namespace alembert
