// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds which names of the scene the letters of a derivation are, where neither the user nor the names say so: by
/// what makes the most lines right.
///
///     choose_letters(system, written, {{"\\ell", "l"}}).told      // "\\varphi" → "theta"

#include <map>
#include <set>
#include <string>
#include <vector>

#include "check/derivation/letters.hpp"
#include "check/derivation/system.hpp"
#include "check/written/read.hpp"

namespace alembert {

struct ChosenLetters {
    Letters letters;
    std::map<std::string, std::string> told;  ///< as written → in the scene, where these differ
    std::set<Letter> given;                   ///< those that the user has said
    std::vector<std::string> remarks;         ///< what was assumed, and what could be otherwise
};

/// `given`: as written → in the scene. Throws SceneError for letters that cannot be read, and for names that the
/// scene does not have.
ChosenLetters choose_letters(DerivedSystem& system, const Written& written,
                             const std::map<std::string, std::string>& given);

}  // namespace alembert
