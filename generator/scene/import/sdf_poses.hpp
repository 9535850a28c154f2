// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Where the links, joints and frames of an SDF file stand: each <pose> is given relative to another frame (its
/// own default, or `relative_to`), and frames may be attached to each other (sdformat.org, "Pose frame
/// semantics").
///
///     SdfPoses poses(file);
///     poses.place("arm::hand")        // in the world
///     poses.link("arm::tool_frame")   // "arm::hand", the link to which a frame is attached
///
/// Only sdf.cpp uses this. Names are paths from the world, with :: between them.

#include <map>

#include "scene/import/xml.hpp"

namespace alembert {

class SdfPoses {
public:
    explicit SdfPoses(XmlFile& file) : file_(file) {}

    struct Entry {
        enum class Kind { world, model, link, joint, frame } kind;
        const XmlElement* element;  ///< null for the world
        std::string scope;          ///< of the model in which its names are looked up: "", "arm::"
        std::string usual;          ///< the frame to which its pose is relative if it does not say
        std::string attached;       ///< of a frame
    };
    /// Adds a model with its links, joints, frames and models inside; `name` is its path.
    void add_model(const XmlElement& model, const std::string& name, const std::string& around);

    const std::map<std::string, Entry>& entries() const { return entries_; }
    const std::vector<std::string>& order() const { return order_; }  ///< as in the file
    /// The path of a name that stands in a model; refused if it is none of the file.
    std::string path(const XmlElement& e, const std::string& scope, const std::string& name) const;
    RobotPlace place(const std::string& path);
    std::string link(const std::string& path, int steps = 0) const;
    /// The numbers of a <pose>.
    RobotPlace written(const XmlElement& pose);

private:
    void add(const std::string& path, Entry entry);

    XmlFile& file_;
    std::map<std::string, Entry> entries_{{"world", {Entry::Kind::world, nullptr, "", "", ""}}};
    std::vector<std::string> order_;
    std::map<std::string, RobotPlace> known_{{"world", {}}};
    std::vector<std::string> open_;  // being resolved
};

}  // namespace alembert
