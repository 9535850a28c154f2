// SPDX-License-Identifier: GPL-2.0-or-later
// Moments of homogeneous solids about their centres, with the sizes of MJCF (radius r, half lengths a b c h):
//   sphere 2 m r²/5;  ellipsoid m (b² + c²)/5;  box m (b² + c²)/3;  cylinder m (3 r² + 4 h²)/12, m r²/2;
//   capsule: its cylinder, and its two halves of a sphere with s = the mass of both,
//            2 s r²/5 + s (h² + 3 r h/4) across the axis, 2 s r²/5 about it.
#include <cmath>

#include "alembert/base/inertia.hpp"
#include "base/language/say.hpp"
#include "scene/import/mjcf_values.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

struct Solid {
    double volume;
    Real3 moments;  ///< for mass 1
};

std::optional<Solid> solid(const std::string& type, const std::array<double, 3>& size) {
    const auto [a, b, c] = size;
    if (type == "sphere") return Solid{4 * M_PI / 3 * a * a * a, Real3::Constant(0.4 * a * a)};
    if (type == "ellipsoid" || type == "box") {
        const double over = type == "box" ? 3 : 5, volume = type == "box" ? 8 : 4 * M_PI / 3;
        return Solid{volume * a * b * c, Real3(b * b + c * c, c * c + a * a, a * a + b * b) / over};
    }
    const double across = (3 * a * a + 4 * b * b) / 12, along = a * a / 2;
    const double tube = 2 * M_PI * a * a * b, ball = 4 * M_PI / 3 * a * a * a;
    if (type == "cylinder") return Solid{tube, {across, across, along}};
    if (type != "capsule") return std::nullopt;
    const double t = tube / (tube + ball), s = ball / (tube + ball);
    const double ends = s * (0.4 * a * a + b * b + 0.75 * a * b);
    return Solid{tube + ball, {t * across + ends, t * across + ends, t * along + s * 0.4 * a * a}};
}

}  // namespace

MjcfInertia MjcfValues::given(const XmlElement& e) {
    MjcfInertia result;
    const RobotPlace at = place(e);
    const auto mass = file_.number(e, "mass");
    if (!mass || *mass < 0) file_.refuse(e, say("<inertial> has no mass of zero or more"));
    result.mass = *mass;
    result.centre = at.shift;
    Real33 own = Real33::Zero();
    if (const auto full = file_.numbers(e, "fullinertia", 6))
        own = inertia_matrix<double>({(*full)[0], (*full)[1], (*full)[2], (*full)[3], (*full)[5], (*full)[4]});
    else if (const auto diagonal = file_.numbers(e, "diaginertia", 3))
        own = Real3((*diagonal)[0], (*diagonal)[1], (*diagonal)[2]).asDiagonal();
    else
        file_.remark(e, say("<inertial> has no diaginertia or fullinertia: its mass is a point"));
    result.inertia = turned<double>(own, at.R);
    return result;
}

std::optional<MjcfInertia> MjcfValues::shape(const XmlElement& geom, const std::string& body) {
    const std::string type = text(geom, "type").value_or("sphere");
    const double group = number(geom, "group").value_or(0);
    if (type == "plane" || type == "hfield" || group < groups_[0] || group > groups_[1]) return std::nullopt;
    const auto mass = number(geom, "mass");
    if (type == "mesh" && mass.value_or(1) != 0) return mesh(geom, body);
    RobotPlace at = place(geom);
    std::vector<double> size = numbers(geom, "size").value_or(std::vector<double>{});
    if (const auto ends = numbers(geom, "fromto", 6)) {
        const Real3 from((*ends)[0], (*ends)[1], (*ends)[2]), to((*ends)[3], (*ends)[4], (*ends)[5]);
        at.shift = (from + to) / 2;
        at.R = Eigen::Quaterniond::FromTwoVectors(Real3::UnitZ(), from - to).toRotationMatrix();
        if (size.empty()) file_.refuse(geom, say("<geom> has fromto and no size; expected its radius"));
        const bool thick = type == "box" || type == "ellipsoid";
        size = thick ? std::vector<double>{size[0], size[0], (to - from).norm() / 2}
                     : std::vector<double>{size[0], (to - from).norm() / 2};
    }
    const std::size_t needed = type == "sphere" ? 1 : type == "capsule" || type == "cylinder" ? 2 : 3;
    const std::optional<Solid> form =
        solid(type, {size.empty() ? 0 : size[0], size.size() > 1 ? size[1] : 0, size.size() > 2 ? size[2] : 0});
    if (!form || flag(geom, "shellinertia").value_or(false)) {
        if (mass.value_or(1) != 0)
            file_.remark(geom, say("the mass of body {} leaves out a <geom> of type {}, which is no homogeneous "
                                   "sphere, capsule, cylinder, ellipsoid or box; give the body <inertial>",
                                   in_quotes(body), type));
        if (mass.value_or(1) != 0)
            file_.drop(say("masses of <geom>s that are no homogeneous solids"), body, Robot::Effect::motion);
        return std::nullopt;
    }
    if (size.size() < needed)
        file_.refuse(geom,
                     say("<geom> of type {} has {} numbers in size; expected {}", type, size.size(), needed));
    MjcfInertia result;
    result.mass = mass.value_or(number(geom, "density").value_or(1000) * form->volume);
    result.centre = at.shift;
    result.inertia = turned<double>(Real33((result.mass * form->moments).asDiagonal()), at.R);
    return result;
}

MjcfInertia MjcfValues::by_shapes(const std::vector<MjcfPart>& geoms, const std::string& body) {
    std::vector<MjcfInertia> parts;
    MjcfInertia whole;
    for (const MjcfPart& geom : geoms)
        if (auto part = shape(*geom.element, body)) {
            part->centre = geom.frame.shift + geom.frame.R * part->centre;
            part->inertia = turned<double>(part->inertia, geom.frame.R);
            parts.push_back(*part);
            whole.mass += part->mass;
            whole.centre += part->mass * part->centre;
        }
    if (whole.mass > 0) whole.centre /= whole.mass;
    for (const MjcfInertia& part : parts)
        whole.inertia += moved_from_centre<double>(part.inertia, part.mass, part.centre - whole.centre);
    return whole;
}

void MjcfValues::bound(MjcfInertia& i) const {
    i.mass = std::max(i.mass, least_mass_);
    if (least_moment_ == 0 && !balance_) return;
    const Eigen::SelfAdjointEigenSolver<Real33> own(i.inertia);
    Real3 moments = own.eigenvalues().cwiseMax(least_moment_);
    if (balance_ && moments[0] + moments[1] < moments[2]) moments = Real3::Constant(moments.mean());
    i.inertia = own.eigenvectors() * moments.asDiagonal() * own.eigenvectors().transpose();
}

}  // namespace alembert
