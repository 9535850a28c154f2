// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// States of rest or of steady motion in numbers, for several values of the parameters: does a line hold at them,
/// at some of them, or to first order near them?
///
///     RestStates states(system, {.special = {{k1, k2}}});     // where k1 = k2
///     states.vanishes(residual, {})                           // at all of them, on a branch, or nowhere
///     states.is_frequency(square, {})                         // of small vibrations about one of them
///     states.vanishes_near(residual, {.places = {{theta_0, theta}}})
///
/// They are found by Newton's method, in least squares, from several starts, for values of the parameters that are
/// drawn. This says what a line may mean, and is no proof. The verb `equilibrium` searches more thoroughly
/// (stability/equilibrium/search.hpp), for one set of values, in a room above this one.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "check/derivation/system.hpp"
#include "program/interpret.hpp"

namespace alembert {

class RestStates {
public:
    struct Kind {
        GiNaC::exmap special = {};  ///< values of parameters, in others
        bool steady = false;        ///< whether coordinates on which nothing depends may move at a constant rate
    };
    /// `system` must outlive it.
    RestStates(const DerivedSystem& system, Kind kind);

    enum class Found {
        everywhere,  ///< at all that were found
        trivially,   ///< at all, and because all of its terms are zero there
        on_branch,   ///< at those that are stable or next to the scene's start, or where the line names the place
        elsewhere,   ///< at others alone
        nowhere,
        unknown,  ///< too few were found
    };
    /// What an expression is about.
    struct About {
        GiNaC::exmap places = {};  ///< letters for the values of coordinates at the state: θ_0 ↦ θ
        bool names_place = false;  ///< whether it states the value of a coordinate: all of its terms may be zero
        bool of_number = false;    ///< whether that value is a number, θ = π: of whatever state
        GiNaC::exmap base = {};    ///< values of coordinates at the states that are meant; empty for all
        std::vector<GiNaC::ex> relations = {};  ///< what vanishes at the states that are meant
    };
    /// Whether the expression vanishes at the states.
    Found vanishes(const GiNaC::ex& residual, const About& about);
    /// Whether it vanishes to first order on all motions near a state that have its momenta.
    Found vanishes_near(const GiNaC::ex& residual, const About& about);
    /// Whether i√square solves the equations near a state: with all forces, or without damping.
    Found is_frequency(const GiNaC::ex& square, const About& about);

    /// Whether all that grows or vibrates near a state as e^{st} solves Σ coefficient x^k = 0 for x = s, for x = ω
    /// or for x = ω² with s² = −ω²; zeros need not.
    Found is_characteristic(const std::vector<GiNaC::ex>& coefficients, const About& about);

    const Kind& kind() const { return kind_; }
    const std::vector<std::size_t>& moving() const { return cyclic_; }

private:
    using Matrix = Eigen::MatrixXd;
    struct Nodes {
        std::vector<int> roots, needed;
    };
    struct Place {
        State<double> state;
        bool is_own = false;  ///< whether it is the nearest to the scene's start
    };
    /// Of the equations near a state: inertia, forces by rates and by coordinates, constraints, momenta by rates
    /// and by coordinates.
    struct Near {
        Matrix mass, by_rates, by_places, rows, momenta_by_rates, momenta_by_places;
    };
    Nodes lowered(const std::vector<GiNaC::ex>& list, const GiNaC::exmap& places);
    std::vector<double> values(const Nodes& nodes, const State<double>& at) const;
    double drawn(double own, int set, std::size_t k) const;
    State<double> at_random(int set, int start) const;
    bool is_linear();
    double& unknown(State<double>& state, Eigen::Index k) const;
    std::optional<State<double>> reached(State<double> from) const;
    const std::vector<Place>& places(int set);
    std::optional<Near> near(const State<double>& at) const;
    static bool solves(const Near& near, double square, bool resisting);
    static Eigen::VectorXcd eigenvalues(const Near& near);
    static bool oscillates(const Near& near, double square);
    bool is_stable(const State<double>& at) const;
    /// What a test finds at a state; nothing where it has no value.
    struct Seen {
        bool holds = false, is_told = true;  ///< told: not because all of its terms are zero there
    };
    /// `is_any`: the line may be about any state that has its relations, and not only about the scene's own or a
    /// stable one.
    Found weighed(const About& about, bool is_any,
                  const std::function<std::optional<Seen>(const State<double>&)>& test);
    bool obeys(const State<double>& at, const Nodes& relations) const;
    bool is_trivial(const State<double>& at, const About& about) const;

    const DerivedSystem& system_;
    Kind kind_;
    GiNaC::exmap inputs_;  ///< with their derivatives, in t
    bool is_usable_ = false;
    std::vector<std::size_t> cyclic_;  ///< coordinates that move
    Eigen::Index coordinates_ = 0, multipliers_ = 0, conditions_ = 0, holonomic_ = 0, kept_ = 0;
    Program program_;
    Nodes rest_;  ///< the conditions and the constraints, then their slopes by the unknowns
    Nodes near_;
    std::vector<std::vector<Place>> sets_;
};

}  // namespace alembert
