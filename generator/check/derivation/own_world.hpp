// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The system as a derivation has it: its own T, V, L, momenta, forces and equations, however wrong.
///
///     OwnWorld own(system, letters);
///     own.state("L", value, 3);            // line 3 states L, wrongly
///     own.explained_by(row)                // 3 for an equation that Lagrange's equations give with this L
///
/// What the derivation does not state is as it is in the system, and what follows from its own values follows: L
/// is T − V, p is ∂L/∂q'. Each value knows the wrong line that it comes from, if there is one.

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "check/derivation/letters.hpp"
#include "check/derivation/system.hpp"

namespace alembert {

class OwnWorld {
public:
    OwnWorld(DerivedSystem& system, const Letters& letters);

    /// Throws NoMeaning.
    GiNaC::ex value(const std::string& text) { return world_.value(text); }
    /// The same where some names have these values.
    GiNaC::ex value_with(const std::string& text, const std::map<std::string, GiNaC::ex>& given);
    /// The name has this value from now on. `wrong`: the line from which a wrong value comes.
    void state(const std::string& name, const GiNaC::ex& value, std::optional<std::size_t> wrong);
    /// The same where `is_so` then says that it is; otherwise all is as before.
    bool state_if(const std::string& name, const GiNaC::ex& value, std::size_t wrong,
                  const std::function<bool()>& is_so);
    /// The name is a part of the sum `whole`, "T_1" of "T": what it is said to be counts in the whole, too.
    void count_as_part(const std::string& name, const std::string& whole, const GiNaC::ex& truth);
    /// The name, or the step of this text, is a velocity, or a component of one, of a mass, whose kinetic energy
    /// counts in the whole.
    void count_as_velocity(const std::string& text, const GiNaC::ex& truth, const GiNaC::ex& mass);
    /// The same of an expression that is no name, by its text: "diff(L,theta')".
    void state_step(const std::string& text, const GiNaC::ex& value, std::optional<std::size_t> wrong);
    /// The time derivative of a value, as the derivation has written it out.
    void state_rate(const GiNaC::ex& of, const GiNaC::ex& value, std::optional<std::size_t> wrong);
    const std::map<std::string, std::string>& steps() const { return steps_; }
    /// Whether its value comes from a wrong line.
    bool is_wrong_step(const std::string& text) const {
        const auto found = step(text);
        return found && found->wrong;
    }

    /// The latest wrong line from which the value of one of these names comes.
    std::optional<std::size_t> wrong_in(const std::set<std::string>& names) const;
    /// All that is stated or follows from it, by name.
    std::map<std::string, GiNaC::ex> values() const;
    /// An equation of motion of the derivation's own.
    void add_equation(MotionRow row, std::size_t line, bool is_wrong, bool is_near);

    /// A relation between coordinates and rates that is wrong, solved for one of the rates.
    void add_relation(const GiNaC::ex& residual, std::size_t line);
    /// The latest wrong relation without which `residual` would not vanish; nothing if it does not vanish with
    /// them.
    std::optional<std::size_t> explained_by_relations(const GiNaC::ex& residual);

    /// The wrong line that explains a row: Lagrange's equations with the derivation's own quantities give it, or
    /// its own equations do. `near`: whether equations near an equilibrium count.
    std::optional<std::size_t> explained_by(const MotionRow& row, bool near);
    /// The wrong line that explains this ω²: the derivation's own equations near an equilibrium have this
    /// frequency.
    std::optional<std::size_t> explains_frequency(const GiNaC::ex& square);
    /// The wrong equation that gives this row once both are linearized by `linear`.
    std::optional<std::size_t> explained_by_linearizing(
        const GiNaC::ex& residual, const std::function<std::optional<GiNaC::ex>(const GiNaC::ex&)>& linear);
    /// The wrong equation, or law with wrong quantities, of which `is_same` says that it gives the line at rest.
    std::optional<std::size_t> explained_at_rest(const std::function<bool(const GiNaC::ex&)>& is_same);
    /// Whether a right equation follows from the derivation's own quantities or equations, or these are all right.
    bool founds(const MotionRow& row);
    /// Whether generalized forces contain those of the potential: d/dt ∂T/∂q' − ∂T/∂q = Q.
    void count_potential_forces(bool all);

private:
    struct Stated {
        GiNaC::ex value;
        std::optional<std::size_t> wrong;
    };
    struct Law {
        MotionRow row;
        std::optional<std::size_t> wrong;
    };
    struct OwnEquation {
        MotionRow row;
        std::size_t line;
        bool is_wrong, is_near;
    };
    Stated stated_or(const std::string& name, const Stated& otherwise) const;
    std::optional<Stated> step(const std::string& text) const;
    void refresh();
    void know(const std::string& name, const Stated& value);
    Law law_of(int coordinate, bool with_reactions);
    /// With the reactions of the constraints, and as if the coordinates were independent.
    const std::vector<Law>& laws(bool with_reactions);
    /// The latest equations that agree with each other.
    std::vector<const OwnEquation*> consistent(bool near, bool bound) const;

    DerivedSystem& system_;
    const Letters& letters_;
    World world_;
    std::map<std::string, Stated> stated_, known_;
    std::map<std::string, std::string> steps_;
    std::vector<OwnEquation> equations_;
    std::optional<std::vector<Law>> laws_[2];
    struct PartOf {
        std::string whole;
        GiNaC::ex truth;
        GiNaC::ex mass{};  ///< of a velocity; 0 of a part that is a sum's
    };
    std::map<std::string, PartOf> parts_;
    /// The value of a sum with its parts as they are stated.
    Stated with_parts(const std::string& whole, const GiNaC::ex& truth) const;
    struct Rate {
        GiNaC::ex of;
        Stated value;
    };
    std::vector<Rate> rates_;
    /// The derivative of what has this value, if it has been written out.
    std::optional<Stated> rate_of(const GiNaC::ex& value) const;
    struct Relation {
        GiNaC::exmap rate;
        std::size_t line;
    };
    std::vector<Relation> relations_;
    bool all_forces_ = false;
};

/// The later of two lines, of which any may be missing.
std::optional<std::size_t> later(std::optional<std::size_t> a, std::optional<std::size_t> b);

}  // namespace alembert
