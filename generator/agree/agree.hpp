// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Do all formalisms say the same?
///
///     const Agreed all = agree(read_scene("scenes/textbook/coin.toml"));
///     const Agreement result = agree(derive_all(mechanism).equations, mechanism);
///     result.verdict == Agreement::Verdict::proved
///
/// First exactly, modulo 2⁶¹ − 1 at random points: the reduced row echelon form of [−Aᵀ M | f; 0 A | γ] is the
/// same for all formalisms if and only if they have the same solutions, also where M is singular. Equations in
/// speeds are compared by the q'' that they give, at rates that obey the constraints they have eliminated. Then
/// the Fourier normal form of the entries, where it ends quickly: then the method is `proved`, otherwise
/// `sampled`, and 2^failure bounds the chance that the sampling has missed a difference (failure ≤ −60). A
/// difference is `refuted` once it is seen in long double arithmetic too, `undecided` otherwise: the modular
/// evaluation does not know every identity between functions.

#include "formalism/formalisms.hpp"
#include "state/prepared.hpp"

namespace alembert {

struct Derivations {
    std::vector<Equations> equations;
    std::vector<std::pair<std::string, std::string>> refused;  ///< name, reason
};
/// By every formalism that applies.
Derivations derive_all(const Mechanism& mechanism);

struct Agreement {
    enum class Verdict { proved, refuted, undecided };
    Verdict verdict = Verdict::undecided;
    bool normal_form = false;  ///< proved by normal form, not by sampling alone
    double failure = 0;        ///< log₂ of the chance that sampling alone is wrong
    int points = 0;
    std::string reason;  ///< where refuted: which two differ and how; where undecided: why
};

/// Compares all with the first. `seconds`: how long the normal form may take.
Agreement agree(const std::vector<Equations>& equations, const Mechanism& mechanism, double seconds = 10);

/// The whole verb: a scene's formalisms and what they agree on.
struct Agreed : Prepared {
    Derivations derivations = {};
    Agreement agreement = {};
    double seconds = 0;  ///< by the clock on the wall
};

/// Derives by every formalism that applies, and compares. Throws SceneError for a mistake in the scene.
Agreed agree(Scene scene, double seconds = 10);

}  // namespace alembert
