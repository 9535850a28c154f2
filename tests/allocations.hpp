// SPDX-License-Identifier: MIT
#pragma once

/// How much a computation does, counted and not timed, where what it makes is allocated: the same on every
/// machine, however busy it is.
///
///     CHECK(allocations_of([&] { fourier(longer, symbols); }) < 3 * allocations_of([&] { fourier(half, symbols);
///     }));

#include <cstddef>
#include <functional>

namespace alembert::test {

/// How often `work` has called `new`, in all threads and libraries.
std::size_t allocations_of(const std::function<void()>& work);

}  // namespace alembert::test
