// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The files that a robot description names. They are read only if they are regular files, and only inside the
/// folder of the description, unless the user allows others: a description from elsewhere must not read what it
/// likes.
///
///     const NamedFiles named("robots/arm.xml", {});
///     named.text("hand.xml", refuse)                   // robots/hand.xml
///     named.model("model://hand", refuse)              // robots/hand/model.sdf, or in a package, or above
///
/// `refuse` gets the reason and throws.

#include <functional>
#include <string>

#include "scene/import/robot.hpp"

namespace alembert {

class NamedFiles {
public:
    using Refuse = std::function<void(const std::string& why)>;

    NamedFiles(const std::string& file, const OtherFiles& others);

    /// The path of a file that is named relative to the description.
    std::string path(const std::string& name, const Refuse& refuse) const;
    std::string text(const std::string& name, const Refuse& refuse) const;
    /// Of a file of data, up to 64 MiB.
    std::string bytes(const std::string& name, const Refuse& refuse) const;
    /// The SDF file of the model that a URI names: model://NAME is a folder in a package, beside the description,
    /// or in one of the three folders above; file:// and relative names are a file, or the folder of a model.
    std::string model(const std::string& uri, const Refuse& refuse) const;

private:
    std::string in_folder(const std::string& folder, const Refuse& refuse) const;

    std::string folder_;
    OtherFiles others_;
};

}  // namespace alembert
