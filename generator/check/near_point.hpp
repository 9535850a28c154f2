// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// An equilibrium or a steady motion, and the equations of motion near it to first order, in symbols.
///
///     NearPoint near(mechanism, equations, {{"theta", 0}});
///     if (near.obstacle().empty())
///         near.slopes_of(near.rows()[0])        // of an equation by q'', λ and each small deviation
///
/// Rates that are not named are near 0; coordinates that are not named and that no constraint gives there may have
/// any value. Inputs are near 0, or have the values that the scene gives them in time; then accelerations and
/// multipliers at the point are what these make them.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/formalism/equations.hpp"
#include "model/parameter_values.hpp"

namespace alembert {

class NearPoint {
public:
    struct Small {
        GiNaC::symbol variable;
        GiNaC::ex value;  ///< the value from which the variable differs little
    };

    enum class Inputs { small, in_time };

    /// `near`: coordinates, and rates as "x'", with their values in parameters. `mechanism` and `equations` must
    /// outlive this.
    NearPoint(const Mechanism& mechanism, const Equations& equations,
              const std::vector<std::pair<std::string, GiNaC::ex>>& near, Inputs inputs = Inputs::small);

    /// Fills in the point itself and the equations; the reason why that cannot be done, if it cannot.
    std::string obstacle();
    /// Whether that reason is that the point is no equilibrium and no steady motion.
    bool is_no_equilibrium() const { return is_no_equilibrium_; }

    /// Without the inputs whose values in time are taken.
    GiNaC::ex read(const GiNaC::ex& e) const { return e.subs(in_time_, GiNaC::subs_options::no_pattern); }
    GiNaC::ex at(const GiNaC::ex& e) const { return e.subs(base_, GiNaC::subs_options::no_pattern); }
    const std::vector<Small>& small() const { return small_; }
    /// Of the equations of motion, each equal to zero.
    const std::vector<GiNaC::ex>& rows() const { return rows_; }
    /// Of the constraints: accelerations, rates and position of each.
    const std::vector<GiNaC::ex>& bound() const { return bound_; }

    /// The derivatives at the point with respect to the accelerations, the multipliers and each small quantity.
    std::vector<GiNaC::ex> slopes_of(const GiNaC::ex& e) const;

    /// Reduced row echelon form over the first columns; the pivot's column for each row, or nothing where it could
    /// not be decided whether an entry is zero.
    std::optional<std::vector<std::size_t>> reduce(std::vector<std::vector<GiNaC::ex>>& rows,
                                                   std::size_t columns) const;

private:
    std::string place_dependent();
    std::optional<GiNaC::ex> root_near(const GiNaC::ex& f, const GiNaC::symbol& x, double start) const;
    bool find_multipliers();
    GiNaC::exvector unknowns_at_point() const;

    const Mechanism& m_;
    const Equations& e_;
    GiNaC::exmap in_time_, base_;
    std::vector<Small> small_;
    std::vector<GiNaC::ex> rows_, bound_;
    bool is_no_equilibrium_ = false;
};

}  // namespace alembert
