// SPDX-License-Identifier: MIT
#pragma once

/// Numbers of eight systems side by side, in the layout of alembert_pack_table (abi.hpp).
///
///     std::vector<Lanes> par = prepared_packs(module);         // the scene's own parameters in every lane
///     std::vector<Lanes> state(4), rate(4);
///     state[0][3] = 0.5;                                       // the first coordinate of the fourth system
///     module.pack()->rhs(reals(&t), reals(state.data()), reals(par.data()), reals(rate.data()));

#include <cstddef>
#include <vector>

#include "alembert/native/module.hpp"

namespace alembert {

inline constexpr int lanes = 8;

/// One number of each of eight systems.
struct alignas(lanes * sizeof(double)) Lanes {
    double value[lanes] = {};
    double& operator[](int lane) { return value[lane]; }
    double operator[](int lane) const { return value[lane]; }
};

/// The numbers of consecutive Lanes; null for a null pointer, which an empty list gives.
inline double* reals(Lanes* first) {
    return first != nullptr ? first->value : nullptr;
}
inline const double* reals(const Lanes* first) {
    return first != nullptr ? first->value : nullptr;
}

/// The result of `prepared` (module.hpp) in every lane.
inline std::vector<Lanes> prepared_packs(const Module& module, const std::vector<double>& values = {}) {
    const std::vector<double> par = prepared(module, values);
    std::vector<Lanes> packs(par.size());
    for (std::size_t i = 0; i < par.size(); ++i)
        for (int lane = 0; lane < lanes; ++lane) packs[i][lane] = par[i];
    return packs;
}

}  // namespace alembert
