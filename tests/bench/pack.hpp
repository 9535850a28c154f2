// SPDX-License-Identifier: MIT
#pragma once

/// The walk of rhs.cpp over packs: the same 64 states, eight side by side, each perturbed by its own previous
/// answer.
///
///     PackWalk walk(module, states, values);       // values: 64 × (n + s), state by state
///     walk();                                      // 64 right-hand sides
///
/// The parameters are given to each lane, as an ensemble does.

#include <cstddef>
#include <span>
#include <vector>

#include "alembert/batch/packs.hpp"
#include "alembert/native/module.hpp"

namespace alembert {

class PackWalk {
public:
    PackWalk(const Module& module, int states, std::span<const double> values, double feedback)
        : module_(module),
          width_(module.table().coordinates + module.table().speeds),
          groups_(states / lanes),
          feedback_(feedback),
          par_(prepared_packs(module)),
          base_(static_cast<std::size_t>(groups_ * width_)),
          answer_(base_.size()),
          state_(static_cast<std::size_t>(width_)) {
        for (int k = 0; k < states; ++k)
            for (int i = 0; i < width_; ++i) base_[k / lanes * width_ + i][k % lanes] = values[k * width_ + i];
    }

    void operator()() {
        const alembert_pack_table& pack = *module_.pack();
        for (int group = 0; group < groups_; ++group) {
            Lanes* const answer = &answer_[group * width_];
            for (int i = 0; i < width_; ++i)
                whole(state_[i]) = whole(base_[group * width_ + i]) + feedback_ * whole(answer[i]);
            pack.rhs(reals(&time_), reals(state_.data()), reals(par_.data()), reals(answer));
        }
    }

private:
    /// As one vector: a pack that is stored in pieces and loaded whole waits until the pieces have left for the
    /// cache.
    using Whole [[gnu::may_alias]] = double __attribute__((vector_size(sizeof(Lanes))));
    static Whole& whole(Lanes& pack) { return reinterpret_cast<Whole&>(pack); }

    const Module& module_;
    int width_, groups_;
    double feedback_;
    std::vector<Lanes> par_, base_, answer_, state_;
    Lanes time_{};
};

}  // namespace alembert
