// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Reads the numbers of a robot description strictly: a number that cannot be read is refused with its line, and
/// none silently becomes zero. (urdfdom drops a whole <inertial> for one number that it cannot read.)
///
///     Elements elements("arm.urdf");
///     elements.number(mass, "value")         // <mass value="1.5"/>; refuses "1,5"
///     elements.pose(origin, "link arm")      // xyz, with rpy or quat_xyzw
///
/// `remarks` collects facts that are no mistakes but that the user should know.

#include <tinyxml.h>

#include <optional>
#include <string>
#include <vector>

#include "scene/import/robot.hpp"

namespace alembert {

class Elements {
public:
    explicit Elements(std::string file) : file_(std::move(file)) {}

    /// Throws SceneError: file, line, column and the reason.
    [[noreturn]] void refuse(const Place& place, const std::string& why) const;
    void remark(const Place& place, const std::string& what) { remarks_.push_back({place, what}); }
    const std::vector<Diagnostic>& remarks() const { return remarks_; }

    /// A finite number; blanks and line breaks around it are ignored. Nothing if the attribute is missing.
    std::optional<double> number(const TiXmlElement& e, const char* attribute) const;
    double needed_number(const TiXmlElement& e, const char* attribute) const;
    /// The number in <tag>1.5</tag>; nothing if it is empty.
    std::optional<double> number_inside(const TiXmlElement& e) const;
    /// Three numbers between blanks or line breaks; the default if the attribute is missing.
    Real3 three(const TiXmlElement& e, const char* attribute, const Real3& missing) const;
    /// The pose of <origin>; the identity for null.
    RobotPose pose(const TiXmlElement* origin);

    /// Reads mass, mass centre and inertia tensor of <inertial>, along the link's axes, into `link`.
    void read_inertial(const TiXmlElement& inertial, Robot::Link& link);

    /// The only child of this name, or null. A second one is refused.
    const TiXmlElement* only(const TiXmlElement& e, const char* tag) const;
    /// Attributes that no reader of this element knows, such as xzy="…", and that would be ignored.
    std::vector<std::string> unknown_attributes(const TiXmlElement& e) const;

    static Place place_of(const TiXmlElement& e) { return {e.Row(), e.Column()}; }

private:
    std::vector<double> numbers(const TiXmlElement& e, const char* attribute, std::size_t count) const;
    double needed_moment(const TiXmlElement& inertia, const char* attribute) const;

    std::string file_;
    std::vector<Diagnostic> remarks_;
};

/// The element for messages: "<mass>".
std::string shown(const TiXmlElement& e);

/// The description that urdfdom checks: names and joints only, without the parts that `Elements` reads itself or
/// that are dropped anyway, and with one blank between words. It is completed where urdfdom requires more than
/// dynamics needs: a name of the robot, limits of a joint, the link `world` to which joints may be attached.
TiXmlDocument checkable(const TiXmlDocument& document, Elements& elements);

}  // namespace alembert
