// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Dimensions by the units in the scene.
///
///     Dimensions dimensions(scene);
///     dimensions.of(force.vector.component[0]);     // kg: 1, m: 1, s: −2
///     dimensions.contradictions();                  // "m*g + k: one term is in kg*m/s^2, the other in kg/s^2"
///
/// A name without a unit may have any dimension, and so has what is made of it. An angle is a number.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

using Dimension = UnitExponents;  ///< without rad

/// "kg*m^2/s^2"; "1" for a number.
std::string text_of(const Dimension& dimension);

/// That of a quantity differentiated so many times by time: m → m/s.
Dimension over_time(Dimension dimension, int times = 1);

/// That of the text of a unit; nothing if it is empty or none.
std::optional<Dimension> dimension_of_unit(const std::string& unit);

class Dimensions {
public:
    /// What a number without a unit is: a number (in claims, where 2 and 9.81 are coefficients), or, unless it is
    /// small and whole, anything (in scenes, where "9.81" may be an acceleration).
    enum class Numbers { pure, any };

    explicit Dimensions(const Scene& scene, Numbers numbers = Numbers::any);

    /// Nothing where it is not known. What contradicts itself in the expression is kept in `contradictions`.
    std::optional<Dimension> of(const Expression& expression);

    /// That of a name of the scene, under the same condition.
    std::optional<Dimension> of_name(const std::string& name);

    /// Concludes what names are: the expression is in `wanted`, if that is known, and where it has a sum, a sine
    /// or a product of which all but one factor is known, this tells the rest. Returns whether anything was new.
    bool learn(const Expression& expression, const std::optional<Dimension>& wanted);
    /// Takes the dimension of a name for known; returns whether it is new.
    bool learn(const std::string& name, const Dimension& dimension);

    /// The two sides and all terms in them are terms of one sum.
    void hold(const Equality& equation);

    /// What was found so far, each with its place.
    const std::vector<Diagnostic>& contradictions() const { return contradictions_; }

    /// The term that stands out first, as the text has it.
    const std::optional<std::string>& wrong_term() const { return wrong_; }

    /// Whether any unit but rad and s is known.
    bool are_useful() const { return is_useful_; }

private:
    using Known = std::optional<Dimension>;
    struct Term {
        std::string text;
        Place place;
        Known dimension;
    };

    void know(const std::string& name, const std::string& unit);
    void add(std::vector<Term>& terms, const Tree& tree);
    /// `in` is the function whose arguments they are; null for terms of a sum.
    Known common(const std::vector<Term>& terms, const std::string* in = nullptr);
    Known of(const Tree& tree);
    Known of_number(const Tree& tree) const;
    Known of_name(const Tree& tree);
    Known of_product(const Tree& tree);
    Known of_power(const Tree& tree);
    Known of_call(const Tree& tree);
    const UnspecifiedFunction* table_named(const std::string& name) const;
    Known of_table(const UnspecifiedFunction& table, const Tree& tree, const std::vector<Known>& args);
    bool learn(const Tree& tree, const Known& wanted);
    bool learn_factor(const Tree& product, const Dimension& wanted);
    std::string text(const Tree& tree) const;

    Numbers numbers_;
    std::vector<UnspecifiedFunction> functions_;
    std::map<std::string, Dimension> names_;
    std::map<std::string, const Expression*> definitions_;  ///< looked at when they are asked for
    const Expression* current_ = nullptr;
    std::vector<Diagnostic> contradictions_;
    std::optional<std::string> wrong_;
    bool is_useful_ = false;
};

/// The first term, inside a sum or of a whole side, whose dimension differs from that of most terms of its sum, as
/// the claim writes it; if there are only two terms, the later one. Nothing if all terms agree as far as units are
/// given. A unit outside the SI is a dimension of its own.
std::optional<std::string> term_of_wrong_unit(const Claim& claim, const Scene& scene);

/// The SI unit of an expression of the scene: "kg*m/s^2". An angle is a number; positions
/// are in m. Nothing for a number, and where the
/// units of the names in it do not tell, contradict each other or are outside the SI.
std::optional<std::string> si_unit_of(const Expression& expression, const Scene& scene);

}  // namespace alembert
