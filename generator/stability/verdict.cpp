// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/language/say.hpp"
#include "model/formalism/with_states.hpp"
#include "program/univariate.hpp"

namespace alembert {

using GiNaC::ex;
using Side = RootOf::Side;

namespace {

std::string shown(const RootOf& root) {
    const double re = root.value.real(), im = root.value.imag();
    if (im == 0) return fmt::format("{:.8g}", re);
    return fmt::format("{:.8g} {} {:.8g}i", re, im < 0 ? "-" : "+", std::abs(im));
}

const RootOf* first_on(const std::vector<RootOf>& roots, Side side) {
    const auto found = std::find_if(roots.rbegin(), roots.rend(), [&](const RootOf& r) { return r.side == side; });
    return found == roots.rend() ? nullptr : &*found;
}

std::vector<Rational> rationals(const RealBallVector& values) {
    std::vector<Rational> result;
    for (const RealBall& c : values)
        if (const auto r = c.rational()) result.push_back(*r);
    return result.size() == values.size() ? result : std::vector<Rational>();
}

/// Do multiple roots on the axis have as many eigenvectors as their multiplicity? All roots must lie left of the
/// axis or on it. With g, the product of (s − root) over the different roots on the axis, this is so if and only
/// if g(A) and g(A)² have the same rank. Nothing if A is not rational.
std::optional<bool> axis_is_semisimple(const RealBallMatrix& A) {
    Univariate<Rational> p = rationals(characteristic(A));
    if (p.empty()) return {};
    std::reverse(p.begin(), p.end());
    Univariate<Rational> mirrored = p;
    for (std::size_t k = 1; k < p.size(); k += 2) mirrored[k] = -mirrored[k];
    const Univariate<Rational> g = univariate::divisor(p, mirrored);
    const Univariate<Rational> simple = univariate::quotient(g, univariate::divisor(g, univariate::derivative(g)));
    RealBallMatrix value(A.rows, A.rows);  // Horner's scheme
    for (std::size_t k = simple.size(); k-- > 0;) {
        value = value * A;
        for (int i = 0; i < A.rows; ++i) value(i, i) += RealBall(simple[k]);
    }
    const auto once = rank(value), twice = rank(value * value);
    if (!once || !twice) return {};
    return *once == *twice;
}

}  // namespace

Decision decide_linear(const std::vector<RootOf>& roots, const RealBallMatrix* A) {
    const std::string what = A ? say("eigenvalue") : say("root");
    if (const RootOf* const right = first_on(roots, Side::right))
        return {StabilityVerdict::unstable, StabilityTheorem::hurwitz,
                say("the {} {} has a positive real part", what, shown(*right))};
    if (const RootOf* const unclear = first_on(roots, Side::unclear))
        return {StabilityVerdict::undecided, StabilityTheorem::none,
                say("the {} {} may lie on either side of the imaginary axis", what, shown(*unclear))};
    const RootOf* const axis = first_on(roots, Side::axis);
    if (!axis)
        return {StabilityVerdict::asymptotically_stable, StabilityTheorem::hurwitz,
                say("all {}s have negative real parts", what)};
    const auto multiple = std::find_if(roots.begin(), roots.end(),
                                       [](const RootOf& r) { return r.side == Side::axis && r.multiplicity > 1; });
    if (multiple == roots.end())
        return {StabilityVerdict::stable, StabilityTheorem::jordan,
                say("no {} has a positive real part, and those on the imaginary axis are simple", what)};
    if (!A)
        return {StabilityVerdict::unstable, StabilityTheorem::jordan,
                say("the root {} on the imaginary axis is a multiple one: solutions of the equation with "
                    "this characteristic polynomial grow like a power of t",
                    shown(*multiple))};
    const std::optional<bool> semisimple = axis_is_semisimple(*A);
    if (!semisimple)
        return {StabilityVerdict::undecided, StabilityTheorem::none,
                say("{} on the imaginary axis is multiple to the last digit, and how many eigenvectors it has "
                    "is not decided",
                    shown(*multiple))};
    if (*semisimple)
        return {StabilityVerdict::stable, StabilityTheorem::jordan,
                say("no eigenvalue has a positive real part, and those on the imaginary axis have as many "
                    "eigenvectors as "
                    "they count (rank, exactly)")};
    return {StabilityVerdict::unstable, StabilityTheorem::jordan,
            say("the multiple eigenvalue {} on the imaginary axis has a Jordan block (rank, exactly): motions "
                "grow like a power of t",
                shown(*multiple))};
}

Decision decide_first(const std::vector<RootOf>& roots) {
    if (const RootOf* const right = first_on(roots, Side::right))
        return {StabilityVerdict::unstable, StabilityTheorem::first_approximation,
                say("the eigenvalue {} of the first approximation has a positive real part", shown(*right))};
    if (!first_on(roots, Side::axis) && !first_on(roots, Side::unclear))
        return {StabilityVerdict::asymptotically_stable, StabilityTheorem::first_approximation,
                say("all eigenvalues of the first approximation have negative real parts")};
    return {};
}

bool is_linear(const Mechanism& m, const Equations& e) {
    if (!m.constraints.empty() || !m.unilateral.empty() || !m.speeds.empty()) return false;
    std::vector<GiNaC::symbol> state = m.q;
    state.insert(state.end(), e.u.begin(), e.u.end());
    for (int i = 0; i < m.size(); ++i)
        if (!e.h[static_cast<std::size_t>(i)].is_equal(m.qdot[static_cast<std::size_t>(i)])) return false;
    for (int i = 0; i < e.size(); ++i) {
        for (int j = 0; j <= i; ++j)
            if (m.z->depends(e.M(i, j), state)) return false;
        const ex force = without_state_rates(e.forcing(i), m);
        if (m.z->tree_size(force) > 2000) return false;
        const ex f = m.z->expand(force);
        for (const GiNaC::symbol& x : state)
            if (m.z->depends(f.diff(x), state)) return false;
    }
    return true;
}

std::vector<RootOf> eigenvalues_of(const RealBallMatrix& A, bool even) {
    std::vector<RootOf> result;
    const auto blocks = even ? std::vector<std::vector<int>>() : diagonal_blocks(A);
    if (even && A.rows > 0) result = roots_of(characteristic(A), true);
    for (const std::vector<int>& block : blocks) {
        const std::vector<RootOf> own = roots_of(characteristic(A.part(block, block)));
        result.insert(result.end(), own.begin(), own.end());
    }
    // The same root in several blocks counts for each of them.
    for (RootOf& r : result) {
        r.multiplicity = static_cast<int>(std::count_if(result.begin(), result.end(), [&](const RootOf& other) {
            return std::abs(other.value - r.value) <= r.radius + other.radius;
        }));
    }
    std::sort(result.begin(), result.end(), precedes);
    return result;
}

}  // namespace alembert
