// SPDX-License-Identifier: MIT
// A planar chain eliminated from both ends, against the dense solve of the composite bodies' matrix.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

#include "model/formalism/planar_chain.hpp"
#include "model/formalism/tree_recursions.hpp"

namespace formalism_chain {

using namespace alembert;

namespace {

/// Rods of different lengths and masses, mass centres anywhere; every `light`-th has 10⁻⁶ of its mass.
template <typename S>
BodyTree<S> random_chain(int n, int light, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> angle(-3, 3), length(0.5, 2), offset(-0.3, 0.3);
    BodyTree<S> tree;
    for (int j = 0; j < n; ++j) {
        TreeLink<S> link{.parent = j - 1};
        const double a = angle(random);
        link.cosine = std::cos(S(a)), link.sine = std::sin(S(a));
        link.still = link.absolute = true;
        link.continues = j > 0;
        if (j > 0) link.p = {S(length(random)), S(offset(random)), S(0)};
        const S m = S(length(random)) * (light > 0 && j % light == 0 ? S(1e-6) : S(1)), x = S(length(random)),
                y = S(offset(random));
        link.body.mass = m;
        link.body.first = {m * x, m * y, S(0)};
        link.body.second = {
            m * (x * x + S(length(random))), m * (y * y + S(length(random))), S(0), m * x * y, S(0), S(0)};
        tree.links.push_back(link);
    }
    return tree;
}

template <typename S>
using Dense = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
template <typename S>
using Column = Eigen::Matrix<S, Eigen::Dynamic, 1>;

template <typename S>
Dense<S> matrix_of(const BodyTree<S>& tree) {
    const std::vector<std::vector<S>> rows = composite_bodies(regrouped(tree));
    Dense<S> M(tree.size(), tree.size());
    for (int i = 0; i < tree.size(); ++i)
        for (int j = 0; j <= i; ++j) M(i, j) = M(j, i) = rows[i][j];
    return M;
}

template <typename S>
Column<S> chain_solution(const BodyTree<S>& tree, const Column<S>& f) {
    const std::vector<S> w = from_both_ends(tree, std::vector<S>(f.begin(), f.end()));
    return Eigen::Map<const Column<S>>(w.data(), tree.size());
}

Column<double> random_loads(int n, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> load(-5, 5);
    Column<double> f(n);
    for (double& x : f) x = load(random);
    return f;
}

}  // namespace

TEST_CASE("recursive: a planar chain from both ends solves M w' = f of the composite bodies") {
    const unsigned seed = 19880112;
    CAPTURE(seed);
    for (const int n : {2, 3, 4, 7, 16, 33}) {
        CAPTURE(n);
        const BodyTree<double> tree = random_chain<double>(n, 0, seed + n);
        const Dense<double> M = matrix_of(tree);
        const Column<double> f = random_loads(n, seed);
        const Column<double> w = chain_solution(tree, f);
        // The residual of a backward stable solve: n² roundings of |M| |w|.
        const double allowed =
            n * n * std::numeric_limits<double>::epsilon() * (M.cwiseAbs() * w.cwiseAbs()).maxCoeff();
        CHECK((M * w - f).cwiseAbs().maxCoeff() <= allowed);
    }
}

TEST_CASE(
    "recursive: with masses in a ratio of a million, a chain from both ends is as good as a pivoted solve to a "
    "factor of ten") {
    const unsigned seed = 19880113;
    CAPTURE(seed);
    const int n = 12;
    double ours = 0, pivoted = 0;
    for (unsigned k = 0; k < 20; ++k)
        for (const int light : {2, 3, 5}) {
            const Column<double> f = random_loads(n, seed + k);
            const Column<long double> exact =
                matrix_of(random_chain<long double>(n, light, seed + k)).fullPivLu().solve(f.cast<long double>());
            const BodyTree<double> tree = random_chain<double>(n, light, seed + k);
            const auto error = [&](const Column<double>& w) {
                return static_cast<double>((w.cast<long double>() - exact).cwiseAbs().maxCoeff() /
                                           exact.cwiseAbs().maxCoeff());
            };
            ours = std::max(ours, error(chain_solution(tree, f)));
            pivoted = std::max(pivoted, error(matrix_of(tree).fullPivLu().solve(f)));
        }
    CAPTURE(ours);
    CAPTURE(pivoted);
    CHECK(ours <= 10 * pivoted);
}

TEST_CASE("recursive: a moving chain from both ends has fewer roundings than a pivoted solve of M w' = Q - n") {
    const unsigned seed = 20261127;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> number(-2, 2);
    for (const int n : {6, 16, 32}) {
        CAPTURE(n);
        double ours = 0, pivoted = 0;
        for (unsigned k = 0; k < 40; ++k) {
            BodyTree<double> tree = random_chain<double>(n, 0, seed + k);
            BodyTree<long double> wide = random_chain<long double>(n, 0, seed + k);
            for (int j = 0; j < n; ++j) {
                const double rate = number(random), bias = number(random);
                tree.links[j].rate = rate, wide.links[j].rate = rate;
                tree.links[j].bias = bias, wide.links[j].bias = bias;
            }
            tree.gravity = {0.5, -9.81, 0}, wide.gravity = {0.5L, -9.81, 0};
            const Column<double> Q = random_loads(n, seed + k);
            const auto loads = [](const auto& t) {
                const auto lean = regrouped(t);
                return joint_loads(lean, Bias(lean).wrenches);
            };
            const std::vector<double> less = loads(tree);
            const std::vector<long double> wide_less = loads(wide);
            const Column<double> f = Q - Eigen::Map<const Column<double>>(less.data(), n);
            const Column<long double> exact = matrix_of(wide).fullPivLu().solve(
                Q.cast<long double>() - Eigen::Map<const Column<long double>>(wide_less.data(), n));
            const auto error = [&](const Column<double>& w) {
                return static_cast<double>((w.cast<long double>() - exact).cwiseAbs().maxCoeff() /
                                           exact.cwiseAbs().maxCoeff());
            };
            const double here = error(chain_solution(tree, Q));
            CHECK(here < 1e-12);
            ours += here / 40;
            pivoted += error(matrix_of(tree).fullPivLu().solve(f)) / 40;
        }
        MESSAGE(n << " links: mean error " << ours << ", of a pivoted solve " << pivoted);
        CHECK(ours < pivoted);
    }
}

}  // namespace formalism_chain
