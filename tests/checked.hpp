// SPDX-License-Identifier: MIT
#pragma once

/// Verdicts on claims about a scene, and what a test expects of them.

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "analysis/state/prepared.hpp"
#include "check/check.hpp"
#include "scene/claims_file.hpp"
#include "scenes.hpp"

namespace alembert::test {

inline Checked checked(Scene scene) {
    const Mechanism m = prepared(scene).mechanism;
    return check(scene, m);
}

/// A textbook scene with these claims in place of its own.
inline Checked checked(const std::string& name, const std::string& claims) {
    return checked(
        with_claims(read_scene(source_path("scenes/textbook/" + name + ".toml")), claims, "claims.txt"));
}

/// Claims about a scene that is written down, on the sheets of roots on which it starts, as the command judges
/// them.
inline Checked checked_on_sheets(const std::string& scene, const std::string& claims) {
    const Scene read = with_claims(parse_scene(scene, "scene.toml"), claims, "claims.txt");
    const Prepared made = prepared(read, {}, true);
    return check(made.scene, made.mechanism, made.sheets);
}

inline void check_verdicts(const Checked& result, const std::vector<Verdict>& expected) {
    REQUIRE(result.claims.size() == expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        CAPTURE(k);
        CHECK(result.claims[k].verdict == expected[k]);
    }
}

}  // namespace alembert::test
