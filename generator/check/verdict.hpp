// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What is said of one claim.

#include <string>
#include <utility>
#include <vector>

#include "check/slip.hpp"

namespace alembert {

enum class Verdict { proved, refuted, undecided, vacuous };

struct CheckedClaim {
    Verdict verdict = Verdict::undecided;
    bool normal_form = false;  ///< proved by normal form
    bool kinematic = false;    ///< proved for every motion that the constraints allow, whatever the forces
    double failure = 0;        ///< log₂ of the chance that sampling is wrong
    std::string reason;        ///< in words, where there is something to say
    std::vector<std::pair<std::string, std::string>> counterexample;  ///< name → value, as typed
    std::string residual;                                             ///< lhs − rhs there
    double residual_value = 0;
    std::string difference;  ///< claim − nearest right equation, term by term
    std::string nearest;     ///< that right equation
    std::optional<Slip> likely;
    std::vector<std::string> where;  ///< the sheet or branch of roots on which the verdict holds: "r > 0"
};

}  // namespace alembert
