// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The three name spaces of a scene: values (coordinates, speeds, states, parameters, inputs, definitions,
/// functions), frames (and bodies), points (and particles and bodies' mass centres).

#include <string>
#include <unordered_map>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

struct Declared {
    enum class Kind {
        coordinate,
        speed,
        state,
        parameter,
        input,
        definition,
        function,
        frame,
        point,
        particle,
        body,
        multiplier
    };
    Kind kind;
    std::size_t index;  ///< the position in the scene's list of that kind
    Place place;
};

/// "a coordinate", "an input", …
std::string described(Declared::Kind kind);

/// Whether this text is a name; if not, that is added to the diagnostics.
bool need_name(const Name& name, std::vector<Diagnostic>& diagnostics);

struct NameSpaces {
    using Space = std::unordered_map<std::string, Declared>;
    Space values, frames, points;
    std::vector<UnspecifiedFunction> functions;

    static const Declared* find(const Space& space, const std::string& name) {
        const auto found = space.find(name);
        return found == space.end() ? nullptr : &found->second;
    }
};

/// Collects what the scene declares and reports illegal, reserved and repeated names.
NameSpaces declare(const Scene& scene, std::vector<Diagnostic>& diagnostics);

/// All names of a name space, for "did you mean".
std::vector<std::string> spellings(const NameSpaces::Space& space);

}  // namespace alembert
