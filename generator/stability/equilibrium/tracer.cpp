// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/equilibrium/tracer.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "stability/linear/dense_long.hpp"

namespace alembert {

using Index = Eigen::Index;
using Matrix = MatrixOf<long double>;
using Column = VectorOf<long double>;

namespace {

constexpr int most_steps = 12;
constexpr long double converged = 1e-15L, good_enough = 1e-12L;
constexpr double difference = 1e-6;  // relative to the span, for the derivative with respect to the parameter

/// Least squares with rows scaled to similar size.
Column solved(Matrix M, Column right) {
    for (Index i = 0; i < M.rows(); ++i) {
        const long double row = M.row(i).cwiseAbs().maxCoeff();
        if (row > 0) M.row(i) /= row, right[i] /= row;
    }
    return least_norm(M, right, std::numeric_limits<long double>::epsilon()).x;
}

Matrix bordered(const TracedSystem& here, const Column& direction) {
    Matrix M(here.by.rows() + 1, here.by.cols());
    M.topRows(here.by.rows()) = here.by;
    M.bottomRows(1) = direction.transpose() * here.lift;
    return M;
}

}  // namespace

Instant<long double> Tracer::with(const Instant<long double>& at, double p) const {
    Instant<long double> result = path_(p);
    result.q = at.q;
    result.u = at.u;
    return result;
}

Column Tracer::place(const Instant<long double>& at, double p) const {
    const int n = problem_.residuals().n;
    Column y(n + 1);
    for (int i = 0; i < n; ++i) y[i] = problem_.essential()[i] ? at.q[i] / problem_.scales()[i] : 0;
    y[n] = static_cast<long double>(p) / span_;
    return y;
}

TracedSystem Tracer::linearized_at(const Instant<long double>& at, double p, const Split* split) const {
    TracedSystem result{
        .system = problem_.linearized_at(at, path_(p).u, Rates::given, split), .by = {}, .lift = {}};
    const SteadySystem& here = result.system;
    const int n = problem_.residuals().n;
    const Index k = static_cast<Index>(here.unknowns.size());
    result.by.resize(here.by.rows(), k + 1);
    result.by.leftCols(k) = here.by;
    result.lift = Matrix::Zero(n + 1, k + 1);
    const auto in_scale = [&](const Column& q) {
        Column y = Column::Zero(n + 1);
        for (int i = 0; i < n; ++i) y[i] = problem_.essential()[i] ? q[i] / problem_.scales()[i] : 0;
        return y;
    };
    for (Index j = 0; j < k; ++j) result.lift.col(j) = in_scale(here.tangent.along.col(here.unknowns[j]));
    const double later = p + difference * span_, before = p - difference * span_;
    Instant<long double> a = with(at, later), b = with(at, before);
    if (!problem_.settle_at(a, &here.split) || !problem_.settle_at(b, &here.split))
        throw IntegrationError(say("the constraints cannot be satisfied near this value of the parameter"), p, {});
    const long double unit = span_ / static_cast<long double>(later - before);
    result.by.col(k) = unit * (problem_.linearized_at(a, path_(later).u, Rates::given, &here.split).residual -
                               problem_.linearized_at(b, path_(before).u, Rates::given, &here.split).residual);
    Column moved(n);
    for (int i = 0; i < n; ++i) moved[i] = unit * (a.q[i] - b.q[i]);
    result.lift.col(k) = in_scale(moved);
    result.lift(n, k) = 1;
    return result;
}

long double Tracer::turn_of(const TracedSystem& here, const Column& tangent) const {
    const Matrix F = independent_rows(here);
    if (F.rows() + 1 != F.cols()) return std::nanl("");
    Matrix square(F.cols(), F.cols());
    square.topRows(F.rows()) = F;
    square.bottomRows(1) = tangent.transpose() * here.lift;
    return determinant(square);
}

Matrix Tracer::independent_rows(const TracedSystem& here) const {
    std::vector<Index> rows;
    const auto p = static_cast<Index>(here.system.split.u.size());
    for (Index i = 0; i < here.by.rows(); ++i)
        if (i >= p || !problem_.residuals().rates_are_speeds || problem_.essential()[here.system.split.u[i]])
            rows.push_back(i);
    Matrix result(static_cast<Index>(rows.size()), here.by.cols());
    for (std::size_t i = 0; i < rows.size(); ++i) result.row(static_cast<Index>(i)) = here.by.row(rows[i]);
    return result;
}

void Tracer::finish(TracedPoint& point, const Column& direction) const {
    const TracedSystem here = linearized_at(point.at, point.p);
    point.split = here.system.split;
    Column right = Column::Zero(here.by.rows() + 1);
    right[here.by.rows()] = 1;
    Column tangent = here.lift * solved(bordered(here, direction), right);
    if (!(tangent.norm() > 0) || !tangent.allFinite()) tangent = direction;
    point.tangent = tangent / tangent.norm();
    if (point.tangent.dot(direction) < 0) point.tangent = -point.tangent;
    point.turn = turn_of(here, point.tangent);
}

std::optional<TracedPoint> Tracer::at_parameter(const Instant<long double>& guess, double p) const try {
    Instant<long double> from = path_(p);
    from.q = guess.q;
    const auto root = problem_.solve(from);
    if (!root) return {};
    TracedPoint point{.at = root->at, .p = p, .tangent = {}, .split = {}};
    const int n = problem_.residuals().n;
    finish(point, Column::Unit(n + 1, n));
    return point;
} catch (const IntegrationError&) {
    return {};
}

std::optional<TracedPoint> Tracer::step(const TracedPoint& from, long double sigma, const Column* along) const
    try {
    const int n = problem_.residuals().n;
    const Column& direction = along != nullptr ? *along : from.tangent;
    const Column target = place(from.at, from.p) + sigma * direction;
    TracedPoint point{.at = from.at, .p = from.p, .tangent = {}, .split = {}, .turn = 0, .step = sigma};
    long double last = HUGE_VALL;
    for (int step = 0; step < most_steps; ++step) {
        const TracedSystem here = linearized_at(point.at, point.p);
        Column right(here.by.rows() + 1);
        right.head(here.by.rows()) = -here.system.residual;
        right[here.by.rows()] = direction.dot(target - place(point.at, point.p));
        const Column change = solved(bordered(here, direction), right);
        if (!change.allFinite()) return {};
        Column local = Column::Zero(here.system.tangent.along.cols());
        for (std::size_t j = 0; j < here.system.unknowns.size(); ++j)
            local[here.system.unknowns[j]] = change[static_cast<Index>(j)];
        const Column whole = here.system.tangent.along * local;
        const Column y = here.lift * change;
        for (int i = 0; i < n; ++i)
            point.at.q[i] += problem_.essential()[i] ? problem_.scales()[i] * y[i] : whole[i];
        for (int i = 0; i < problem_.residuals().s; ++i) point.at.u[i] += whole[n + i];
        point.p += static_cast<double>(y[n]) * span_;
        point.at = with(point.at, point.p);
        if (!problem_.settle_at(point.at)) return {};
        const long double size = y.cwiseAbs().maxCoeff();
        if (size < converged || (size < good_enough && size >= last / 4)) {
            finish(point, direction);
            return point;
        }
        if (step > 4 && size > last) return {};
        last = size;
    }
    return {};
} catch (const IntegrationError&) {
    return {};
}

long double Tracer::turn_by(const TracedPoint& point, const Split& split) const try {
    return turn_of(linearized_at(point.at, point.p, &split), point.tangent);
} catch (const IntegrationError&) {
    return std::nanl("");
}

std::optional<Column> Tracer::moved(const TracedPoint& point, const Column& change) const try {
    const TracedSystem here = linearized_at(point.at, point.p, &point.split);
    const int n = problem_.residuals().n;
    Column local = Column::Zero(here.system.tangent.along.cols());
    for (std::size_t j = 0; j < here.system.unknowns.size(); ++j)
        local[here.system.unknowns[j]] = change[static_cast<Index>(j)];
    const Column whole = here.system.tangent.along * local;
    TracedPoint other = point;
    for (int i = 0; i < n; ++i) other.at.q[i] += whole[i];
    for (int i = 0; i < problem_.residuals().s; ++i) other.at.u[i] += whole[n + i];
    other.p += static_cast<double>(change[change.size() - 1]) * span_;
    other.at = with(other.at, other.p);
    if (!problem_.settle_at(other.at, &point.split)) return {};
    TracedSystem there{.system = problem_.linearized_at(other.at, path_(other.p).u, Rates::given, &point.split),
                       .by = {},
                       .lift = {}};
    there.by = there.system.residual;
    return Column(independent_rows(there));
} catch (const IntegrationError&) {
    return {};
}

}  // namespace alembert
