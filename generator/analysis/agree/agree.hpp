// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Decides whether all formalisms give the same equations of motion.
///
///     const Agreed all = agree(read_scene("scenes/textbook/coin.toml"));
///     const Agreement result = agree(derive_all(mechanism).equations, mechanism);
///     result.verdict == Agreement::Verdict::proved
///
/// The equations are first compared exactly, modulo 2⁶¹ − 1 at random points: the reduced row echelon form of [−Aᵀ
/// M | f; 0 A | γ] is the same for all formalisms if and only if they have the same solutions, also where M is
/// singular. Equations in speeds are compared by their q'', at rates that obey the constraints that they have
/// eliminated. Then the Fourier normal forms of the entries are compared, if they can be computed quickly; if so,
/// the method is `proved`, otherwise `sampled`, and 2^failure bounds the probability that sampling has missed a
/// difference (failure ≤ −60). If there is a difference, the verdict is `refuted` if it shows in long double
/// arithmetic too, otherwise `undecided`, because the modular evaluation does not know every identity between
/// functions.

#include "analysis/state/prepared.hpp"
#include "model/formalism/formalisms.hpp"

namespace alembert {

struct Derivations {
    std::vector<Equations> equations;
    std::vector<std::pair<std::string, std::string>> refused;  ///< name, reason
};
/// Derives the equations by every formalism that applies.
Derivations derive_all(const Mechanism& mechanism);

struct Agreement {
    enum class Verdict { proved, refuted, undecided };
    Verdict verdict = Verdict::undecided;
    bool normal_form = false;  ///< whether it is proved by normal form and not by sampling only
    double failure = 0;        ///< log₂ of the probability that sampling alone is wrong
    int points = 0;
    std::string reason;  ///< if refuted, which two differ and how; if undecided, why
};

/// The size (nodes of expressions, with what their intermediate symbols stand for) of what is compared by normal
/// forms at most; these take some microseconds a node. After that sampling decides.
constexpr double work_of_normal_forms = 1e6;

/// Compares all equations with the first, by normal forms as far as `work` allows.
Agreement agree(const std::vector<Equations>& equations, const Mechanism& mechanism,
                double work = work_of_normal_forms);

/// The result of the verb: a scene's formalisms and their agreement.
struct Agreed : Prepared {
    Derivations derivations = {};
    Agreement agreement = {};
    double seconds = 0;  ///< wall time
};

/// Derives by every formalism that applies, and compares. Throws SceneError for a mistake in the scene.
Agreed agree(Scene scene, double work = work_of_normal_forms);

}  // namespace alembert
