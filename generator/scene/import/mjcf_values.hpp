// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The values of elements of an MJCF file (the format of MuJoCo): with the defaults of their classes, in radians.
/// Only the readers of MJCF use this.
///
///     MjcfValues values(file);                       // reads <compiler> and <default>
///     values.number(joint, "damping")                // its own, or that of its class
///     values.rotation(body)                          // of quat, axisangle, euler, xyaxes or zaxis

#include <map>

#include "scene/import/mesh_solid.hpp"
#include "scene/import/xml.hpp"

namespace alembert {

/// Mass, mass centre and inertia about it, along the axes of the body.
struct MjcfInertia {
    double mass = 0;
    Real3 centre = Real3::Zero();
    Real33 inertia = Real33::Zero();
};

/// An element of a body, and the place of the <frame>s in which it stands.
struct MjcfPart {
    const XmlElement* element;
    RobotPlace frame;
};

class MjcfValues {
public:
    explicit MjcfValues(XmlFile& file);

    XmlFile& file() const { return file_; }
    /// The attribute, or that of the default of the element's class and of the classes around it. `or_as` is the
    /// name of another element whose default also counts, as <equality> for <weld>; <general> stands for motors of
    /// all kinds, which share one default: what is written last counts.
    std::optional<std::string> text(const XmlElement& e, const char* attribute, const char* or_as = nullptr);
    std::optional<std::vector<double>> numbers(const XmlElement& e, const char* attribute, std::size_t count = 0,
                                               const char* or_as = nullptr);
    std::optional<double> number(const XmlElement& e, const char* attribute, const char* or_as = nullptr);
    std::optional<bool> flag(const XmlElement& e, const char* attribute, const char* or_as = nullptr);
    /// The attributes that the defaults of an element give.
    std::set<std::string> default_attributes(const XmlElement& e, const char* or_as);
    /// The elements of defaults that count for an element, each before those that count more.
    std::vector<const XmlElement*> defaults_of(const XmlElement& e, const char* or_as);
    Real3 three(const XmlElement& e, const char* attribute, const Real3& missing);
    Real33 rotation(const XmlElement& e);
    RobotPlace place(const XmlElement& e) { return {three(e, "pos", Real3::Zero()), rotation(e)}; }
    /// An angle of an element in radians.
    double angle(const XmlElement& e, double written) const;

    /// <inertial>.
    MjcfInertia given(const XmlElement& inertial);
    /// The sum of all <geom> of a body. What has no inside that is known here is left out with a remark.
    MjcfInertia by_shapes(const std::vector<MjcfPart>& geoms, const std::string& body);
    /// <compiler> boundmass, boundinertia, balanceinertia.
    void bound(MjcfInertia& inertia) const;

    /// The bytes of a file that a mesh names; throws MeshMistake. Without it, no such file is read.
    std::function<std::string(const std::string& file)> bytes_of = {};

    enum class FromShapes { never, where_missing, always } from_shapes = FromShapes::where_missing;
    bool autolimits = true;
    double total_mass = -1;  ///< that all masses are scaled to; none if not positive

private:
    struct Class {
        std::string parent;
        std::vector<const XmlElement*> elements;  // the last one first, which counts before the others
    };
    /// Gives each <default> that counts for an element to `give`, the nearest class first, until that is true.
    void each_default(const XmlElement& e, const char* or_as, const std::function<bool(const XmlElement&)>& give);
    void read_compiler(const XmlElement& e);
    void read_class(const XmlElement& e, const std::string& parent);
    const Class& class_of(const XmlElement& e);
    std::optional<MjcfInertia> shape(const XmlElement& geom, const std::string& body);
    const XmlElement* mesh_named(const std::string& name) const;
    Triangles triangles_of(const XmlElement& mesh);
    std::optional<MjcfInertia> mesh(const XmlElement& geom, const std::string& body);

    XmlFile& file_;
    bool in_degrees_ = true;
    std::string euler_ = "xyz";
    double least_mass_ = 0, least_moment_ = 0;
    bool balance_ = false, strips_path_ = false;
    std::string mesh_folder_ = {};  ///< with a slash at its end, or empty
    std::array<double, 2> groups_{0, 5};
    std::map<std::string, Class> classes_;
};

}  // namespace alembert
