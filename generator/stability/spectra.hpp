// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Eigenvalues, Floquet multipliers or roots of a polynomial as functions of parameters, in floating point: for
/// pictures, not for verdicts.
///
///     const Spectra spectra(scene, {.at = …}, {"a", "q"}, {2, 1});
///     const auto roots = spectra.at({2.5, 1});           // nothing where there is no equilibrium
///     kind_of(*roots, spectra.of());                      // divergence, flutter …
///
/// The equilibrium is the one that Newton's method reaches from the scene's state at these parameters, or from the
/// one that was found beside; a periodic motion is found by shooting from there.

#include <complex>
#include <functional>
#include <memory>
#include <optional>

#include "stability/stability.hpp"

namespace alembert {

enum class SpectrumOf { eigenvalues, multipliers, roots };

/// What the root that lies farthest to the right (the largest multiplier) does.
enum class SpectrumKind {
    none,        ///< no equilibrium or periodic motion was found
    inside,      ///< all to the left of the axis, or inside the unit circle
    edge,        ///< none beyond, some on it
    divergence,  ///< beyond it, a real one (a multiplier beyond 1)
    flip,        ///< a real multiplier beyond −1
    flutter      ///< a complex pair beyond
};
const char* name_of(SpectrumKind kind);

class Spectra {
public:
    using Roots = std::vector<std::complex<double>>;
    /// `names`: parameters, or rates of cyclic coordinates; `middle`: values at which the scene is looked at
    /// first. Throws ModelError for names that are unknown, that are coordinates, or that options.at holds.
    Spectra(Scene scene, const StabilityOptions& options, const std::vector<std::string>& names,
            const std::vector<double>& middle);

    SpectrumOf of() const { return of_; }
    const std::string& title() const { return title_; }
    /// The coordinates and first-order states of an equilibrium, or the state with which a periodic motion begins;
    /// empty if none is known.
    using Place = std::vector<long double>;
    std::optional<Roots> at(const std::vector<double>& values) const {
        Place anywhere;
        return at_(values, anywhere);
    }
    /// From `near` on, which then is what was found; from the scene's state if that leads nowhere.
    std::optional<Roots> following(const std::vector<double>& values, Place& near) const;

private:
    void take_polynomial(const Scene& scene, const StabilityOptions& options);
    void take_motion(const std::shared_ptr<const Derived>& derived, const StabilityOptions& options,
                     const std::vector<double>& middle);
    void take_equilibrium(const std::shared_ptr<const Derived>& derived, const std::vector<double>& middle);
    std::vector<double> all(const std::vector<double>& values) const;

    SpectrumOf of_ = SpectrumOf::eigenvalues;
    std::string title_;
    std::vector<std::string> names_;  ///< those that are held first
    std::vector<double> held_;
    std::function<std::optional<Roots>(const std::vector<double>&, Place&)> at_;
};

/// How far the worst root lies beyond the axis (its real part) or the unit circle (its size less 1).
double beyond(const Spectra::Roots& roots, SpectrumOf of);

/// Rounding counts as on the edge; more of it where the roots lie in pairs on both sides, as those of a
/// Hamiltonian system do: there a double root is known to the square root of rounding only.
SpectrumKind kind_of(const Spectra::Roots& roots, SpectrumOf of);

/// Up to how far beyond the edge is on it.
double edge_margin(const Spectra::Roots& roots, SpectrumOf of);

/// Of one root.
double beyond(const std::complex<double>& root, SpectrumOf of);

inline bool is_unstable(SpectrumKind kind) {
    return kind == SpectrumKind::divergence || kind == SpectrumKind::flip || kind == SpectrumKind::flutter;
}

}  // namespace alembert
