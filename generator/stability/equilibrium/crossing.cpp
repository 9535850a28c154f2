// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/equilibrium/crossing.hpp"

#include <array>
#include <cmath>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "stability/linear/dense_long.hpp"

namespace alembert {

using Index = Eigen::Index;
using Column = VectorOf<long double>;

namespace {

constexpr long double apart = 1e-3L;     // distance for second differences
constexpr long double vertical = 1e-2L;  // a tangent is vertical if the parameter has a smaller part in it

struct Kernel {
    std::array<Column, 2> right;
    Column left;
};

Kernel kernel_at_crossing(const MatrixOf<long double>& F) {
    const LongSingularValues svd = singular_values(F);
    const Index last = F.cols() - 1;
    return {.right = {svd.right.col(last), svd.right.col(last - 1)}, .left = svd.left.col(last - 1)};
}

}  // namespace

const char* name_of(PointKind kind) {
    switch (kind) {
        case PointKind::fold:
            return to_say("fold");
        case PointKind::pitchfork:
            return to_say("pitchfork");
        case PointKind::transcritical:
            return to_say("transcritical");
        case PointKind::touching:
            return to_say("touching");
        case PointKind::family:
            return to_say("family");
        case PointKind::hopf:
            return to_say("hopf");
        case PointKind::hamiltonian_hopf:
            return to_say("hamiltonian hopf");
    }
    return "";
}

BranchCrossing crossing_at(const Tracer& tracer, const TracedPoint& point) try {
    const TracedSystem here = tracer.linearized_at(point.at, point.p, &point.split);
    const MatrixOf<long double> F = tracer.independent_rows(here);
    if (F.cols() < 2 || F.rows() + 1 != F.cols()) return {};
    const Kernel kernel = kernel_at_crossing(F);
    const auto& [v1, v2] = kernel.right;
    const auto at = [&](const Column& change) -> long double {
        const auto F = tracer.moved(point, change);
        return F ? kernel.left.dot(*F) : std::nanl("");
    };
    const long double middle = at(Column::Zero(v1.size()));
    const auto curvature = [&](const Column& v) {
        return (at(apart * v) + at(-apart * v) - 2 * middle) / (apart * apart);
    };
    const long double b11 = curvature(v1), b22 = curvature(v2), b12 = (curvature(v1 + v2) - b11 - b22) / 2,
                      inside = b12 * b12 - b11 * b22;
    BranchCrossing result;
    if (!(inside > 0)) return result;
    // b₁₁ α² + 2 b₁₂ α β + b₂₂ β² = 0 without cancellation: α : β = s : b₁₁ and b₂₂ : s
    const long double s = -(b12 + std::copysign(std::sqrt(inside), b12));
    for (const Column& change : {Column(s * v1 + b11 * v2), Column(b22 * v1 + s * v2)}) {
        const Column direction = here.lift * change;
        if (!(direction.norm() > 0)) return {};
        result.directions.push_back(direction / direction.norm());
    }
    const Index n = result.directions[0].size() - 1;
    const bool stands =
        std::abs(result.directions[0][n]) < vertical || std::abs(result.directions[1][n]) < vertical;
    result.kind = stands ? PointKind::pitchfork : PointKind::transcritical;
    return result;
} catch (const IntegrationError&) {
    return {};
}

}  // namespace alembert
