// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the letters of the textbook mean in claims (scene/book_letters.hpp has which of them there are):
///
///     T, V        kinetic and potential energy; with a given Lagrangian its part of second degree in the rates,
///     and −L
///                 at rest
///     L, E        T − V, or the given Lagrangian; T + V, with a given Lagrangian q'·∂L/∂q' − L
///     H           Σ p q' − L. diff(H, q) and diff(H, p_q) hold the momenta: −∂L/∂q and q'
///     Q_q         the generalized force: of everything, −∂V/∂q included, or of the loads that are not in V
///     deltaW      Σ Q_q delta_q, the virtual work of virtual displacements delta_q
///     T(M1)       of one particle or body; T(translation_B) and T(rotation_B) are the two parts of a body
///     V(spring_1) of one part of V: gravity, gravity_M1 or M1, spring_1, springs, energy
///     Q_q(force_1)     of one part of V, one load (force_1, torque_1, damper_1, dissipation, friction_NAME, a
///     point's or
///                      body's name) or one constraint, by its name
///     inertia(B, P)    the moment of inertia of a body or particle about the axis of N's z through the point P;
///     with a
///                      vector u that about the axis along u, with two of them the element u·I v of the tensor

#include <string>
#include <vector>

#include "model/places.hpp"

namespace alembert {

class BookLetters {
public:
    BookLetters(const Mechanism& mechanism, Translator& translator, Places& places)
        : m_(mechanism), translator_(translator), places_(places) {}
    BookLetters(const BookLetters&) = delete;
    BookLetters& operator=(const BookLetters&) = delete;

    /// Makes the translator know each letter that it does not know from the scene.
    void teach();

    /// Whether Q_q and deltaW hold −∂V/∂q from now on. At first they do.
    void read_forces_as_whole(bool whole);

    /// The virtual displacements that have been asked for, each with the position of its coordinate.
    const std::vector<std::pair<int, GiNaC::symbol>>& displacements() const { return displacements_; }

private:
    void offer(const std::string& name, std::function<GiNaC::ex()> value);
    GiNaC::ex force(int coordinate);
    GiNaC::ex work();
    GiNaC::ex displacement(int coordinate);
    GiNaC::ex hamiltonian();
    std::optional<Value> call(const Tree& tree);
    GiNaC::ex energy_part(const Tree& tree, const std::vector<Part>& parts);
    GiNaC::ex force_part(const Tree& tree, int coordinate);
    GiNaC::ex inertia(const Tree& tree);
    std::optional<GiNaC::ex> partial_of_hamiltonian(const Tree& by);

    const Mechanism& m_;
    Translator& translator_;
    Places& places_;
    bool whole_ = true;
    std::vector<std::pair<int, GiNaC::symbol>> displacements_;
};

}  // namespace alembert
