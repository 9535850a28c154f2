// SPDX-License-Identifier: MIT
// Inertia against sums over mass points.
#include <doctest/doctest.h>

#include <random>

#include "alembert/base/inertia.hpp"

namespace runtime_inertia {

using namespace alembert;

namespace {

struct Points {
    std::vector<double> mass;
    std::vector<Vector3r<>> at;
};

Points cloud() {
    std::mt19937_64 random(20040110);
    std::uniform_real_distribution<double> one(-1, 1), mass(0.1, 1);
    Points points;
    for (int i = 0; i < 7; ++i) {
        points.mass.push_back(mass(random));
        points.at.push_back({one(random), one(random), one(random)});
    }
    return points;
}

Matrix3<> about(const Points& points, const Vector3r<>& P) {
    Matrix3<> I = Matrix3<>::Zero();
    for (std::size_t i = 0; i < points.mass.size(); ++i) {
        const Vector3r<> r = points.at[i] - P;
        I += points.mass[i] * skew<double>(r).transpose() * skew<double>(r);
    }
    return I;
}

}  // namespace

TEST_CASE("inertia: transport to another point and frame is the sum over the mass points there") {
    const Points points = cloud();
    double mass = 0;
    Vector3r<> centre = Vector3r<>::Zero();
    for (std::size_t i = 0; i < points.mass.size(); ++i) {
        mass += points.mass[i];
        centre += points.mass[i] * points.at[i];
    }
    centre /= mass;
    const Vector3r<> P(0.3, -1.2, 2.0);
    CHECK((moved_from_centre<double>(about(points, centre), mass, centre - P) - about(points, P)).norm() < 1e-12);
    CHECK((moved_to_centre<double>(about(points, P), mass, P - centre) - about(points, centre)).norm() < 1e-12);

    const Matrix3<> R_AB = rotation_by_angles("zxz", {0.3, 1.1, -0.8});
    Points seen = points;  // along B
    for (Vector3r<>& r : seen.at) r = R_AB.transpose() * r;
    CHECK((turned<double>(about(seen, Vector3r<>::Zero()), R_AB) - about(points, Vector3r<>::Zero())).norm() <
          1e-13);
}

TEST_CASE(
    "inertia: principal axes make the tensor diagonal, and no cloud of points breaks the triangle inequality") {
    const Matrix3<> I = about(cloud(), Vector3r<>::Zero());
    const PrincipalAxes<> own = principal_axes<double>(I);
    CHECK((own.R * own.moments.asDiagonal() * own.R.transpose() - I).norm() < 1e-13);
    CHECK(own.R.determinant() == doctest::Approx(1));
    CHECK(own.moments[0] <= own.moments[1]);
    CHECK(own.moments[1] <= own.moments[2]);
    CHECK_FALSE(has_negative_moment(own));
    CHECK_FALSE(breaks_triangle_inequality(own));
    const auto with = [](double xx, double yy, double zz, double xy) {
        return principal_axes<double>(inertia_matrix<double>({.xx = xx, .yy = yy, .zz = zz, .xy = xy}));
    };
    CHECK_FALSE(breaks_triangle_inequality(with(1, 2, 3, 0)));  // a plate
    CHECK(breaks_triangle_inequality(with(1, 2, 3.001, 0)));
    CHECK(breaks_triangle_inequality(with(2, 2, 1, 1.8)));  // 0.2, 1, 3.8
    CHECK(has_negative_moment(with(1, 1, 1, 2)));           // -1, 1, 3
    CHECK(with(2, 2, 1, 1.8).moments[2] == doctest::Approx(3.8));
}

}  // namespace runtime_inertia
