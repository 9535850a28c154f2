// SPDX-License-Identifier: MIT
#pragma once

/// Packs (packs.hpp) as vectors of so many numbers as a register holds.
///
///     using Pieces = PackPieces<4>;
///     Pieces::Reals* const y = Pieces::in(list);           // a pack is `Pieces::pieces` of them in a row

#include "alembert/batch/packs.hpp"

namespace alembert {

/// `width` of the eight numbers, as many as a register holds: 8 with AVX-512, 4 with AVX2, else 2. No function
/// returns one: how that is done depends on the processor.
template <int width>
struct PackPieces {
    using Reals [[gnu::vector_size(width * sizeof(double)), gnu::may_alias]] = double;
    using Bits [[gnu::vector_size(width * sizeof(double)), gnu::may_alias]] = long long;
    static_assert(sizeof(Reals) == width * sizeof(double) && sizeof(Bits) == sizeof(Reals));
    static constexpr int pieces = lanes / width;
    static Reals* in(Lanes* first) { return reinterpret_cast<Reals*>(first); }
    static const Reals* in(const Lanes* first) { return reinterpret_cast<const Reals*>(first); }
};

}  // namespace alembert
