// SPDX-License-Identifier: MIT
#include "alembert/hybrid/mode_guard.hpp"

#include <algorithm>
#include <limits>

#include "alembert/base/tolerances.hpp"

namespace alembert {

namespace {

// A negative normal force smaller than this, relative to the largest, is zero.
constexpr double negligible_normal = 1e-9;
constexpr double outgrown = 1e3;  // v has so many times the size of δ

double value_of(const ModeGuard& w, const SlidingField& at, const std::vector<double>& normals) {
    switch (w.what) {
        case ModeGuard::What::bound:
            return w.sign * (at.sides().is_pair(w.index) ? at.share(w.index) : at.sign(w.index)) +
                   w.offset * at.bound(w.index);
        case ModeGuard::What::turn:
            return at.ahead(w.index);
        case ModeGuard::What::smoothing:
            return outgrown * at.sides().slides[w.index / 2].smoothing - at.velocity(w.index).norm();
        case ModeGuard::What::normal:
            return at.normal(w.index) + w.offset + 2 * negligible_normal * normals[w.index] +
                   std::numeric_limits<double>::min();
        case ModeGuard::What::idle:
            return w.sign * at.value(w.index) + w.offset;
        default:
            return w.sign * at.value(w.index);
    }
}

}  // namespace

std::vector<ModeGuard> mode_guards(const SlidingField& now, PieceSpan span, const std::vector<double>& sizes) {
    std::vector<ModeGuard> list;
    for (int k = 0; k < now.count(); ++k) {
        if (now.has_bounds())
            list.push_back(
                {.what = ModeGuard::What::normal, .index = k, .offset = -2 * std::min(0.0, now.normal(k))});
        const bool is_pair = now.sides().is_pair(k);
        if (is_pair && k % 2 == 1) continue;
        if (is_pair && now.sides()[k] != 0) {
            list.push_back({.what = ModeGuard::What::turn, .index = k});
            if (now.sides().slides[k / 2].smoothing > 0)
                list.push_back({.what = ModeGuard::What::smoothing, .index = k});
            continue;
        }
        if (now.sides().is_idle(k)) {
            for (const double sign : {-1.0, 1.0})
                list.push_back({.what = ModeGuard::What::idle,
                                .index = k,
                                .sign = sign,
                                .offset = 2 * std::abs(now.value(k)) + now.sides().idle_up_to[k]});
            continue;
        }
        if (now.sides()[k] == 0) {
            const bool is_close = now.share(k) > (1 - 1e-12) * now.bound(k);
            for (const double sign : is_pair ? std::vector{-1.0} : std::vector{-1.0, 1.0})
                list.push_back({.what = ModeGuard::What::bound,
                                .index = k,
                                .sign = sign,
                                .offset = is_close ? 1 + 1e-12 : 1 + 16 * tolerance::epsilon});
            continue;
        }
        ModeGuard one{.index = k, .sign = static_cast<double>(now.sides()[k])};
        const double off = std::abs(now.value(k)), speed = one.sign * now.slope(k);
        const double rounding = 2 * off + 64 * tolerance::epsilon * sizes[k];
        if (one.sign * now.value(k) <= 64 * tolerance::epsilon * sizes[k]) {
            if (speed * (span.end - span.begin) > 1e6 * rounding)
                one.held.until = span.begin + rounding / speed;
            else
                one.held.bound = rounding + 1e-13 * sizes[k] + std::numeric_limits<double>::min();
        }
        list.push_back(one);
    }
    return list;
}

double guard_value(const ModeGuard& w, double t, const SlidingField& at, const std::vector<double>& normals) {
    return w.held(t, value_of(w, at, normals));
}

}  // namespace alembert
