// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The names that a scene has, for reading what people type in place of one of them. A name of the scene always
/// comes first: another spelling is looked for only where the scene does not have the word itself.
///
///     KnownNames names;                 // of a scene with the coordinate theta_1
///     names.meant("θ_1")                // "theta_1"
///     names.rate_meant("theta_1dot")    // "theta_1'"

#include <map>
#include <string>
#include <utility>

#include "scene/unit_text.hpp"

namespace alembert {

struct Scene;

class KnownNames {
public:
    KnownNames() = default;
    /// What a scene declares. (What a file declares: scene/file_names.hpp.)
    explicit KnownNames(const Scene& scene);

    void add(const std::string& name, bool moves = false);

    bool has(const std::string& name) const { return names_.contains(name); }
    /// Whether it is a coordinate, a speed, an input or a definition, which have derivatives and may be written as
    /// functions of the time.
    bool moves(const std::string& name) const;
    /// The name of the scene; of a word with Greek letters, that with their Latin spellings, and the reverse.
    /// Empty if there is none, or more than one.
    std::string meant(const std::string& word) const;
    /// The same, and the word itself where no name is meant.
    std::string spelled(const std::string& word) const;
    /// "theta'" for thetadot, theta_dot, θdot, θ̇; "theta''" for thetaddot. Empty if it is no such word.
    std::string rate_meant(const std::string& word) const;

    /// The units of its own, which are words after a number alone.
    const OwnUnits& units() const { return units_; }
    void set_units(OwnUnits units) { units_ = std::move(units); }

private:
    OwnUnits units_;
    std::map<std::string, bool> names_;               // whether it moves
    std::map<std::string, std::string> by_spelling_;  // Latin spelling → name; empty if there are several
};

}  // namespace alembert
