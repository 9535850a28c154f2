// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Translates expressions of the scene language, such as claims, to expressions in the symbols of a mechanism.
///
///     Formulas formulas(scene, mechanism);
///     const ex residual = formulas.value(claim.lhs) - formulas.value(claim.rhs);
///
/// Expressions may contain the names of the scene, multipliers, the momenta p_<coordinate> (∂L/∂q', Zhang & Qin
/// §1.7), the letters of model/book_letters.hpp and names that `know` adds. SceneMistake is thrown for others.

#include "model/book_letters.hpp"
#include "model/places.hpp"

namespace alembert {

class Formulas {
public:
    /// `sheets` are those on which the mechanism was built, if any.
    Formulas(const Scene& scene, const Mechanism& mechanism, std::shared_ptr<RootSheets> sheets = {});
    Formulas(const Formulas&) = delete;
    Formulas& operator=(const Formulas&) = delete;

    GiNaC::ex value(const Expression& expression) { return translator_.scalar(expression); }
    void know(const std::string& name, const GiNaC::ex& value) { translator_.know(name, value); }
    void has_no_derivative(const GiNaC::symbol& symbol) { translator_.has_no_derivative(symbol); }
    /// The frames and points of the scene.
    Places& places() { return places_; }
    /// Whether the name is a letter of the textbook here.
    bool is_letter(const std::string& name) const { return translator_.is_offered(name); }
    BookLetters& letters() { return letters_; }
    const BookLetters& letters() const { return letters_; }

private:
    Translator translator_;
    Places places_;
    BookLetters letters_;
};

}  // namespace alembert
