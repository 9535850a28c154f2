// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The motions of which a claim speaks, as scenes and files of claims write them.
///
///     Claim claim;
///     set_mode(claim, "sticking slope");   // claim.at is Claim::At::sticking, claim.sticking is {"slope"}
///     mode_text(claim);                    // "sticking slope"

#include "scene/scene.hpp"

namespace alembert {

/// Sets `at`, `sticking` and `closed` from "motion", "rest", "impact", "solution", "sticking" with the names of
/// frictions after it, or "closed" with those of contacts, between blanks of any kind. False, with the claim
/// unchanged, for any other text. (A claim near a state is written with the values of that state.)
bool set_mode(Claim& claim, const std::string& text);

/// The text of `at`, `sticking` and `closed`.
std::string mode_text(const Claim& claim);

}  // namespace alembert
