// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The numbers of a robot description, read strictly: what cannot be read is refused with its line, and nothing
/// becomes zero without a word. (urdfdom drops a whole <inertial> for one number that it cannot read.)
///
///     Elements elements("arm.urdf");
///     elements.number(mass, "value")         // <mass value="1.5"/>; refuses "1,5"
///     elements.pose(origin, "link arm")      // xyz, with rpy or quat_xyzw
///
/// `remarks` gathers what is no mistake but should be known.

#include <tinyxml.h>

#include <optional>
#include <string>
#include <vector>

#include "urdf/robot.hpp"

namespace alembert {

class Elements {
public:
    explicit Elements(std::string file) : file_(std::move(file)) {}

    /// Throws SceneError: file, line, column and the reason.
    [[noreturn]] void refuse(const Place& place, const std::string& why) const;
    void remark(const Place& place, const std::string& what) { remarks_.push_back({place, what}); }
    const std::vector<Diagnostic>& remarks() const { return remarks_; }

    /// A finite number; blanks and line breaks around it are nothing. Empty where the attribute is missing.
    std::optional<double> number(const TiXmlElement& e, const char* attribute) const;
    double needed_number(const TiXmlElement& e, const char* attribute) const;
    /// Three numbers between blanks or line breaks; the default where the attribute is missing.
    Real3 three(const TiXmlElement& e, const char* attribute, const Real3& missing) const;
    /// Of <origin>, or of null: none.
    RobotPose pose(const TiXmlElement* origin);

    /// Mass, mass centre and tensor of <inertial>, along the link's axes, into `link`.
    void read_inertial(const TiXmlElement& inertial, Robot::Link& link);

    /// The only child of this name, or null. A second one is refused.
    const TiXmlElement* only(const TiXmlElement& e, const char* tag) const;
    /// Attributes that no reader of this element knows, as in xzy="…", which would be lost.
    std::vector<std::string> unknown_attributes(const TiXmlElement& e) const;

    static Place place_of(const TiXmlElement& e) { return {e.Row(), e.Column()}; }

private:
    std::vector<double> numbers(const TiXmlElement& e, const char* attribute, std::size_t count) const;
    double needed_moment(const TiXmlElement& inertia, const char* attribute) const;

    std::string file_;
    std::vector<Diagnostic> remarks_;
};

/// What a reader may expect in this element; "<mass>".
std::string shown(const TiXmlElement& e);

/// The description that urdfdom is given to check: names and joints alone, without what `Elements` reads by itself
/// or what is dropped anyway, with one blank between words, and completed where urdfdom asks for more than
/// dynamics needs: a name of the robot, limits of a joint, the link `world` that joints may hang from.
TiXmlDocument checkable(const TiXmlDocument& document, Elements& elements);

}  // namespace alembert
