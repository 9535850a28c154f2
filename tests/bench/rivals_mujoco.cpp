// SPDX-License-Identifier: MIT
// MuJoCo: composite bodies and a sparse LᵀL, by its four stages of forward dynamics without constraints.
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <unistd.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "rivals_principal.hpp"

namespace alembert::bench {

namespace {

std::string text(const Eigen::Quaterniond& q) {
    return fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}", q.w(), q.x(), q.y(), q.z());
}
std::string text(const Eigen::Vector3d& v) {
    return fmt::format("{:.17g} {:.17g} {:.17g}", v[0], v[1], v[2]);
}

std::string xml_of(const Tree& tree) {
    std::string bodies, ends;
    for (const TreeBody& body : tree.bodies) {  // a chain: each in the one before
        const Principal own = principal_of(body);
        bodies += fmt::format(
            "<body pos='{}' quat='{}'><inertial pos='{}' quat='{}' mass='{:.17g}' diaginertia='{}'/><joint "
            "type='hinge' axis='{}'/>\n",
            text(eigen(body.p)), text(Eigen::Quaterniond(rotation_of(body))), text(eigen(body.com)),
            text(Eigen::Quaterniond(own.axes)), body.mass, text(own.moments), text(eigen(body.axis)));
        ends += "</body>";
    }
    return fmt::format(
        "<mujoco><option gravity='{}'><flag constraint='disable' "
        "contact='disable'/></option>\n<worldbody>{}{}</worldbody></mujoco>",
        text(eigen(tree.gravity)), bodies, ends);
}

}  // namespace

Rival mujoco(const Tree& tree) {
    const std::string path =
        (std::filesystem::temp_directory_path() / fmt::format("alembert-{}-{}.xml", getpid(), tree.name)).string();
    std::ofstream(path) << xml_of(tree);
    char error[1000] = "";
    const std::shared_ptr<mjModel> model(mj_loadXML(path.c_str(), nullptr, error, sizeof error), mj_deleteModel);
    std::filesystem::remove(path);
    if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error);
    const std::shared_ptr<mjData> data(mj_makeData(model.get()), mj_deleteData);
    const int n = model->nv;
    std::copy_n(tree.tau.begin(), n, data->qfrc_applied);
    return {"mujoco", [model, data, n](const double* q, const double* u, double* a) {
                std::copy_n(q, n, data->qpos);
                std::copy_n(u, n, data->qvel);
                mj_fwdPosition(model.get(), data.get());
                mj_fwdVelocity(model.get(), data.get());
                mj_fwdActuation(model.get(), data.get());
                mj_fwdAcceleration(model.get(), data.get());
                std::copy_n(data->qacc_smooth, n, a);
            }};
}

}  // namespace alembert::bench
