// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/kinematics/vectors.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_terms_shown = 40;
/// In a scene with more formulas than these that are too long, others are sought with less effort.
constexpr int most_long_ones = 30;

}  // namespace

KinematicVector VectorWriter::operator()(const Vector3& v) {
    KinematicVector result;
    for (std::size_t k = 0; k < 3; ++k) result[k] = {.expression = v[k], .formula = formula(v[k])};
    return result;
}

KinematicVector VectorWriter::derivative(const Vector3& v, const KinematicVector& before) {
    KinematicVector result;
    for (std::size_t k = 0; k < 3; ++k) {
        result[k].expression = v[k];
        if (before[k].formula) result[k].formula = formula(v[k]);
    }
    return result;
}

std::optional<Phrase> VectorWriter::formula(const ex& e) {
    const auto f = long_ones_ < most_long_ones ? steps_.normal(e) : steps_.normal(e, 1);
    if (!f || f->size() > most_terms_shown) {
        ++long_ones_;
        return std::nullopt;
    }
    return readable(*f);
}

Vector3 VectorWriter::rate(const Vector3& v) const {
    const std::vector<ex> result = m_.time_derivative({v[0], v[1], v[2]});
    return {result[0], result[1], result[2]};
}

Vector3 VectorWriter::unit(const Vector3& v) const {
    return unit_.any() ? Vector3{unit_(v[0]), unit_(v[1]), unit_(v[2])} : v;
}

Vector3 VectorWriter::along(const std::array<Vector3, 3>& axes, const Vector3& v) const {
    return {dot(axes[0], v, *m_.z), dot(axes[1], v, *m_.z), dot(axes[2], v, *m_.z)};
}

Vector3 VectorWriter::along_N(const std::array<Vector3, 3>& axes, const Vector3& v) const {
    const auto row = [&](std::size_t i) { return Vector3{axes[0][i], axes[1][i], axes[2][i]}; };
    return {dot(row(0), v, *m_.z), dot(row(1), v, *m_.z), dot(row(2), v, *m_.z)};
}

}  // namespace alembert
