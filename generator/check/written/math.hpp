// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Mathematics as people write it, as a tree: letters with their indices, accents and dots, before any of them is
/// a name of the scene.
///
///     \frac{\partial L}{\partial \dot\theta_1} = m l^2 \ddot\theta   is   partial(L; θ₁ with a dot) = product(m,
///     l², θ with two dots)
///
/// LaTeX, Unicode mathematics, plain text and what SymPy, Mathematica, MATLAB and Maple print give the same trees
/// (check/written/read.hpp).

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace alembert {

/// A letter as written. Two that look alike are equal, whatever notation they were written in: `\theta_{1}`, `θ₁`
/// and `theta1` all have the base "theta" and the index "1"; `\ell` has the base "ell", `\varphi` "varphi".
struct Letter {
    std::string base{};  ///< ASCII: the letter, the word in \mathrm{…}, or the name of the sign without backslash
    std::string index{};  ///< of what stands below: "1", "1,2", "C", "cm", "theta_1"; empty if nothing does
    std::string
        raised{};  ///< of what stands above and is no power: "*", "(1)", "C", "particle M1"; empty likewise
    std::string accent{};  ///< "vec", "hat", "bar", "tilde", "mathbf", "mathcal", "prime" …; empty if plain
    auto operator<=>(const Letter&) const = default;
};

struct Math;
using MathPtr = std::shared_ptr<const Math>;

/// One node. `offset` and `length` are bytes of the document.
struct Math {
    enum class Kind {
        number,  ///< text: digits with at most one point, and perhaps an exponent: "2", ".5", "2e3"
        letter,  ///< letter, dots (of Newton and primes together): \ddot\theta, θ̈, theta'', Derivative(theta(t),
                 ///< (t, 2))
        call,  ///< text: sin, cos, tan, cot, sec, csc, asin, acos, atan, atan2, sinh, cosh, tanh, sqrt, exp, ln,
               ///< abs, sign; args
        applied,   ///< letter with arguments that is no such function: F(t), V(r), L(q, \dot q, t), or a product
                   ///< m(g+a) that was written without a sign (only the names of the scene tell which); args
        sum,       ///< args, at least two; a difference has `negate` nodes in it
        product,   ///< args, at least two
        negate,    ///< one arg
        quotient,  ///< numerator, denominator
        power,     ///< base, exponent
        rate,      ///< d/dt of the one arg; dots: the order
        partial,  ///< ∂/∂x of the first arg with respect to the others, which are letters: ∂L/∂q̇, ∂²T/∂q̇∂q
        variation,  ///< δ of the one arg: \delta W, \delta\theta; also the d of dW = Q dq
        vector,     ///< the components: column vectors, (x, y), x i + y j is a sum as written
        matrix,     ///< rows, each a `vector`
        quantity,   ///< a number or expression, and text: its unit as written ("m/s^2", "\,\mathrm{kg}")
    };
    Kind kind;
    std::string text{};
    Letter letter{};
    int dots = 0;
    std::vector<MathPtr> args{};
    std::size_t offset = 0;
    std::size_t length = 0;
    bool grouped = false;  ///< `applied` in brackets of its own: of (s(a + b))^2 all is squared
    int levels = 1;        ///< of nodes in each other, itself counted; at most 300
};

}  // namespace alembert
