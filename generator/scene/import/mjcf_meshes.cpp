// SPDX-License-Identifier: GPL-2.0-or-later
// The masses of meshes of an MJCF file (documentation of MuJoCo: "XML reference, asset/mesh"): a corner v of the
// file is diag(scale) R(refquat)ᵀ (v − refpos) in the geom.
#include <cmath>
#include <cstring>

#include "alembert/base/inertia.hpp"
#include "base/language/say.hpp"
#include "scene/import/mesh_solid.hpp"
#include "scene/import/mjcf_values.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

/// The name of a file without folders and ending.
std::string stem_of(const std::string& file) {
    const std::size_t slash = file.find_last_of("/\\"), from = slash == std::string::npos ? 0 : slash + 1;
    return file.substr(from, file.find_last_of('.') - from);
}

}  // namespace

const XmlElement* MjcfValues::mesh_named(const std::string& name) const {
    for (const XmlElement* all = file_.root().FirstChildElement("asset"); all != nullptr;
         all = all->NextSiblingElement("asset"))
        for (const XmlElement* mesh = all->FirstChildElement("mesh"); mesh != nullptr;
             mesh = mesh->NextSiblingElement("mesh")) {
            const char *const own = mesh->Attribute("name"), *const file = mesh->Attribute("file");
            if (own != nullptr ? name == own : file != nullptr && name == stem_of(file)) return mesh;
        }
    return nullptr;
}

/// The triangles of a mesh, in metres, in the geom. Throws MeshMistake if they cannot be had.
Triangles MjcfValues::triangles_of(const XmlElement& mesh) {
    Triangles surface;
    if (const auto file = text(mesh, "file")) {
        const std::string plain = strips_path_ ? file->substr(file->find_last_of("/\\") + 1) : *file;
        if (!bytes_of) throw MeshMistake(say("there are no files here"));
        surface = triangles_of_file(bytes_of(mesh_folder_ + plain), plain);
    } else {
        const auto corners = numbers(mesh, "vertex"), faces = numbers(mesh, "face");
        if (!corners || !faces || corners->size() % 3 != 0 || faces->size() % 3 != 0)
            throw MeshMistake(say("it has neither a file nor corners and faces"));
        const auto corner = [&](double number) {
            const auto at = static_cast<std::size_t>(3 * std::max(0.0, number));
            if (!(number >= 0) || at + 2 >= corners->size())
                throw MeshMistake(say("a face has a corner {}, and there are {}", number, corners->size() / 3));
            return Real3((*corners)[at], (*corners)[at + 1], (*corners)[at + 2]);
        };
        for (std::size_t k = 0; k < faces->size(); k += 3)
            surface.push_back({corner((*faces)[k]), corner((*faces)[k + 1]), corner((*faces)[k + 2])});
    }
    const Real3 shift = three(mesh, "refpos", Real3::Zero()), scale = three(mesh, "scale", Real3::Ones());
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    if (const auto q = numbers(mesh, "refquat", 4)) turn = Eigen::Quaterniond((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
    if (turn.norm() == 0) throw MeshMistake(say("its refquat is zero"));
    const Real33 to_geom = scale.asDiagonal() * turn.normalized().toRotationMatrix().transpose();
    for (auto& triangle : surface)
        for (Real3& v : triangle) v = to_geom * (v - shift);
    return surface;
}

/// Nothing, with a remark, for what is no solid.
std::optional<MjcfInertia> MjcfValues::mesh(const XmlElement& geom, const std::string& body) {
    const std::string name = text(geom, "mesh").value_or("");
    try {
        const XmlElement* const found = mesh_named(name);
        if (found == nullptr) throw MeshMistake(say("there is none of this name among the assets"));
        const std::string how = text(*found, "inertia").value_or("legacy");
        if (how == "convex" || how == "shell" || flag(geom, "shellinertia").value_or(false))
            throw MeshMistake(say("its inertia is that of its {}, which is not known here",
                                  how == "convex" ? say("convex hull") : say("shell")));
        const MeshSolid solid = mesh_solid(triangles_of(*found));
        if (!solid.is_closed) throw MeshMistake(say("its surface is not closed"));
        if (!(solid.volume > 0)) throw MeshMistake(say("its volume is zero"));
        if (how == "legacy" && std::abs(solid.volume_of_pyramids / solid.volume - 1) > 1e-6)
            file_.remark(
                geom,
                say("the mass of mesh {} of body {} is that of its volume, {:.6g} m^3; MuJoCo takes {:.6g} m^3 "
                    "unless the mesh says inertia=\"exact\"",
                    in_quotes(name), in_quotes(body), solid.volume, solid.volume_of_pyramids),
                "version");
        const RobotPlace at = place(geom);
        MjcfInertia result;
        result.mass = number(geom, "mass").value_or(number(geom, "density").value_or(1000) * solid.volume);
        result.centre = at.shift + at.R * solid.centre;
        result.inertia = turned<double>(Real33(result.mass / solid.volume * solid.inertia), at.R);
        return result;
    } catch (const MeshMistake& mistake) {
        file_.remark(geom, say("the mass of body {} leaves out the mesh {}: {}; give the body <inertial>",
                               in_quotes(body), in_quotes(name), mistake.what()));
        file_.drop(say("masses of <geom>s that are no homogeneous solids"), body, Robot::Effect::motion);
        return std::nullopt;
    }
}

}  // namespace alembert
