// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/stretching.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/random.hpp"

namespace alembert {

using Index = Eigen::Index;

namespace {

constexpr int most_intervals = 20000, least_intervals = 400, most_rows = 20;

/// By the last estimate, the largest first: after a short motion the vectors need not be in this order.
void put_in_order(std::vector<LyapunovExponents::Row>& all) {
    const std::vector<double> last = all.back().estimates;
    std::vector<std::size_t> order(last.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return last[a] > last[b]; });
    for (LyapunovExponents::Row& row : all) {
        const std::vector<double> before = row.estimates;
        for (std::size_t k = 0; k < order.size(); ++k) row.estimates[k] = before[order[k]];
    }
}

}  // namespace

int intervals_of(double duration, double fast) {
    return static_cast<int>(std::clamp(std::ceil(duration * std::max(1e-6, fast) / 2), double(least_intervals),
                                       double(most_intervals)));
}

Stretching::Stretching(const Eigen::MatrixXd& space, int columns) {
    std::mt19937_64 random(8);
    NormalReal normal;
    Eigen::MatrixXd first(space.cols(), columns);
    for (Index c = 0; c < columns; ++c)
        for (Index i = 0; i < space.cols(); ++i) first(i, c) = normal(random);
    vectors = space * first;
    sums_ = Eigen::VectorXd::Zero(columns);
    orthonormal();
}

/// Q of QR; the diagonal of R, positive.
Eigen::VectorXd Stretching::orthonormal() {
    Eigen::VectorXd lengths(vectors.cols());
    for (Index c = 0; c < vectors.cols(); ++c) {
        for (int twice = 0; twice < 2; ++twice)
            for (Index b = 0; b < c; ++b) vectors.col(c) -= vectors.col(b).dot(vectors.col(c)) * vectors.col(b);
        lengths[c] = vectors.col(c).norm();
        vectors.col(c) /= lengths[c];
    }
    return lengths;
}

void Stretching::renew(double t, double interval, bool counts, double trace) {
    const Eigen::VectorXd lengths = orthonormal();
    if (!counts) return;
    sums_ += lengths.array().log().matrix();
    trace_ += trace;
    counted_ += interval;
    const Eigen::VectorXd now = sums_ / counted_;
    all_.push_back({t, {now.data(), now.data() + now.size()}});
}

void Stretching::finish(LyapunovExponents& result, bool has_trace) const {
    std::vector<LyapunovExponents::Row> all = all_;
    put_in_order(all);
    result.exponents = all.back().estimates;
    for (std::size_t c = 0; c < result.exponents.size(); ++c) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (std::size_t k = all.size() / 2; k < all.size(); ++k) {
            low = std::min(low, all[k].estimates[c]);
            high = std::max(high, all[k].estimates[c]);
        }
        result.spread.push_back(high - low);
    }
    for (int row = 1; row <= most_rows; ++row)
        result.rows.push_back(all[all.size() * static_cast<std::size_t>(row) / most_rows - 1]);
    if (has_trace) result.divergence = trace_ / counted_;
    if (static_cast<int>(result.exponents.size()) < result.size) return;
    result.sum = 0;
    for (const double one : result.exponents) *result.sum += one;
}

}  // namespace alembert
