// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which names of a scene the letters of a derivation are.
///
///     Letters letters(scene);
///     letters.name_of({.base = "theta", .index = "1"})      // "theta1" or "theta_1", as the scene has it
///     letters.name_of({.base = "L"})                        // "L", the Lagrangian, unless the scene has an L
///
/// A letter is what the user says, else what the derivation has defined, else the name of the scene that is
/// written so, else one of mechanics' own letters, else a name of the scene in another hand (\varphi for phi, \ell
/// for l).

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "check/written/math.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// What mechanics has a letter for.
enum class MechanicalQuantity { kinetic, potential, lagrangian, energy, hamiltonian, momentum, force };

/// The letter as mechanics' own; nothing if it is none: T, K, E_k; V, U, E_p; L; E; H; p_q; Q_q.
std::optional<MechanicalQuantity> quantity_of(const Letter& letter);

/// C, c_1, h: a constant of integration.
bool is_letter_of_constant(const Letter& letter);

/// Letters and digits of a text in small letters: what two spellings of a name share.
std::string plain_word(const std::string& text);

/// A name of the claim language for a letter: theta_1, x_C, T_particle_M1.
std::string identifier_of(const Letter& letter);

class Letters {
public:
    explicit Letters(const Scene& scene);

    /// From now on the letter is this name, whatever it was.
    void bind(const Letter& letter, const std::string& name);
    /// It is not bound any more.
    void release(const Letter& letter) { bound_.erase(letter); }
    /// From now on it is none of mechanics' own letters: T is a tension here.
    void leave_open(const Letter& letter) { open_.insert(letter); }
    /// It is the author's own, whatever the scene or mechanics have of that name: only what he says of it counts.
    void leave_to_author(const Letter& letter) { own_.insert(letter); }
    bool is_authors(const Letter& letter) const { return own_.contains(letter); }
    /// From now on c_{12} is the cosine of the difference of two angles, not of their sum.
    void read_sines_of_differences() { reads_differences_ = true; }
    bool reads_sines_of_differences() const { return reads_differences_; }
    const std::set<Letter>& authors() const { return own_; }
    /// The name that claims have for it; nothing if it is not known. `as_quantity`: where it stands it can only be
    /// a quantity of mechanics (∂L/∂q'), even if the scene has a length of this name.
    std::optional<std::string> name_of(const Letter& letter, bool as_quantity = false) const;

    bool is_function(const std::string& name) const { return functions_.contains(name); }
    bool is_of_scene(const std::string& name) const { return scene_names_.contains(name); }
    bool moves(const std::string& name) const { return moving_.contains(name); }
    /// The name of the quantity in claims: "T", or "T_kinetic" where the scene uses T itself.
    std::string name_of(MechanicalQuantity quantity) const;
    /// The coordinate that an index means: "theta_1", "\\varphi", or its number; empty if none.
    std::string coordinate_of(const std::string& index) const;
    /// A name of the form `wanted` that is not in use.
    std::string free_name(std::string wanted) const;

    const std::vector<std::string>& coordinates() const { return coordinates_; }
    const std::set<std::string>& scene_names() const { return scene_names_; }

private:
    std::optional<std::string> in_scene(const Letter& letter) const;
    std::optional<std::string> of_mechanics(const Letter& letter) const;

    std::map<Letter, std::string> bound_;
    std::map<Letter, std::string> written_so_;  ///< the letters of the scene's names
    std::set<Letter> open_, own_;
    std::set<std::string> scene_names_, functions_, moving_, taken_;
    std::vector<std::string> coordinates_;
    bool reads_differences_ = false;
};

}  // namespace alembert
