// SPDX-License-Identifier: MIT
#pragma once

/// How much the reader of scenes does, counted and not timed: the same on every machine, however busy it is.
///
///     CHECK(steps_of([&] { parse_scene(longer, "a"); }) < 3 * steps_of([&] { parse_scene(half, "a"); }));
///
/// A step is a piece of code without branches that is entered. The compiler reports each
/// (-fsanitize-coverage=trace-pc) in the copy of the room `scene` that is compiled for test_scene, toml++
/// included; code of other libraries is not counted.

#include <cstddef>
#include <functional>

namespace alembert::test {

std::size_t steps_of(const std::function<void()>& work);

}  // namespace alembert::test
