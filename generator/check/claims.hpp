// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The claims of a scene as programs: expressions that are zero if the claims are right, and their dependence on
/// the names that the author leaves open.

#include <map>
#include <set>

#include "analysis/contact/impact.hpp"
#include "analysis/exact/motions.hpp"
#include "check/printed_names.hpp"
#include "model/formalism/driven.hpp"
#include "model/formalism/with_states.hpp"
#include "model/formulas.hpp"

namespace alembert {

/// One equation, lhs − rhs, and its time derivatives.
struct ClaimForm {
    GiNaC::ex residual;
    std::vector<GiNaC::ex>
        derivatives;        ///< time derivatives, up to those that contain accelerations; only for integrals
    std::vector<int> open;  ///< positions in Claims::open of the names that occur
    bool linear = true;     ///< whether it is linear in these names
    int order = 0;          ///< highest derivative of a coordinate
    bool third = false;     ///< whether it held third derivatives, which the equations of motion have replaced
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
    /// `names`: those that `derive` gives, if claims hold any.
    Claims(const Scene& scene, const Mechanism& mechanism, const Equations& equations,
           std::shared_ptr<RootSheets> sheets = {}, const PrintedNames& names = {});

    /// Reads a claim of the scene. Throws SceneMistake.
    ClaimForm read(const Claim& claim);
    /// From now on `read` puts the value of a constant of the motion, which another claim gives, into claims that
    /// are not linear in what they leave open: L = m r² θ' into m r'' − L²/(m r³) = …
    void define(const GiNaC::symbol& constant, const GiNaC::ex& value) { defined_[constant] = value; }
    GiNaC::ex read(const Expression& expression) {
        const GiNaC::ex value = m_.z->name(formulas_.value(expression));
        return counted_from(without_state_rates(value, m_), m_, driven_);
    }
    /// The same at the scene's impact, for claims about it.
    GiNaC::ex read_at_impact(const Expression& expression);
    /// The same with the values of constants that `define` gave.
    GiNaC::ex read_with_constants(const Expression& expression);
    /// From now on the rates in mechanism and equations are counted from these (model/formalism/driven.hpp), and
    /// `read` gives expressions in such rates.
    void count_rates_from(GiNaC::exmap driven) { driven_ = std::move(driven); }
    const GiNaC::exmap& driven() const { return driven_; }

    /// The rates after the scene's impulses (analysis/contact/impact.hpp), as expressions at the initial pose.
    /// Nothing if they are known only as numbers, or not at all; `impact_obstacle` then gives the reason.
    const std::optional<Impact::Exact>& after_impact();
    const std::string& impact_obstacle() const { return impact_obstacle_; }

    /// A symbol that no state gives, as θ_0 of a derivation; random in exact arithmetic.
    void add_letter(const GiNaC::symbol& letter) { letters_.push_back(letter); }
    /// Lowers into `program`; symbols of multipliers and open names become its unknowns.
    std::vector<int> lower(Program& program, const std::vector<GiNaC::ex>& list) const;

    /// Whether the name is a letter of the textbook here (model/book_letters.hpp).
    bool is_letter(const std::string& name) const { return formulas_.is_letter(name); }
    /// Whether Q_q and deltaW hold the forces of V in what is read from now on. At first they do.
    void read_forces_as_whole(bool whole) { formulas_.letters().read_forces_as_whole(whole); }
    /// The virtual displacements in what was read, each with the position of its coordinate.
    const std::vector<std::pair<int, GiNaC::symbol>>& displacements() const {
        return formulas_.letters().displacements();
    }

    const std::vector<Open>& open() const { return open_; }
    const Mechanism& mechanism() const { return m_; }
    const Equations& equations() const { return e_; }
    std::vector<GiNaC::symbol> open_symbols() const;

private:
    GiNaC::ex at_impact(const GiNaC::ex& e) const;
    /// Which names the form leaves open; returns whether constants are among them.
    bool find_open(ClaimForm& form) const;
    void open_name(const std::string& name, bool constant);
    GiNaC::ex without_third_derivatives(const GiNaC::ex& residual, Place at) const;

    const Mechanism& m_;
    const Equations& e_;
    Formulas formulas_;
    std::vector<Open> open_;
    GiNaC::exmap defined_, driven_;
    std::vector<GiNaC::symbol> letters_;  ///< of add_letter
    std::vector<GiNaC::symbol> third_;    ///< q'''
    bool has_struck_ = false;
    std::optional<Impact::Exact> after_;
    std::string impact_obstacle_;
};

/// The highest derivative of a coordinate or an input; multipliers count as accelerations.
int order_of(const GiNaC::ex& e, const Mechanism& mechanism);

}  // namespace alembert
