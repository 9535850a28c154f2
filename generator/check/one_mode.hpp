// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Claims about motions in which the same friction sticks and the same contacts are closed (check/check.hpp tells
/// how they are judged). The equations are derived once, for all claims that are ever compared with them.
///
///     OneMode mode(prepared(scene, {}, true), "");
///     mode.check(scene, mode.sheets());

#include "check/basis.hpp"
#include "check/check.hpp"
#include "check/printed_names.hpp"

namespace alembert {

class OneMode {
public:
    /// What sticks and what is closed have become constraints of the scene (scene/sticking.hpp). `by`: the
    /// formalism whose names claims may hold; `shown`: its equations, if they are known.
    OneMode(Prepared mode, const std::string& by, std::optional<Equations> shown = {});

    /// The claims of a scene that is this one but for its claims.
    Checked check(const Scene& scene, const std::shared_ptr<RootSheets>& sheets);

    const Scene& scene() const { return mode_.scene; }
    const std::shared_ptr<RootSheets>& sheets() const { return mode_.sheets; }

private:
    Basis& resting();
    const PrintedNames& printed();

    Prepared mode_;
    std::string by_;
    std::optional<Equations> shown_;
    std::optional<Basis> moving_;
    std::optional<Basis> resting_;  ///< with rates that are counted from driven ones, where there are any
    bool has_looked_for_driven_ = false;
    std::optional<PrintedNames> printed_;
};

/// The scene with these claims only.
Scene with_some_claims(Scene scene, const std::vector<std::size_t>& claims);

}  // namespace alembert
