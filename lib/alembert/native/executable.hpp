// SPDX-License-Identifier: MIT
#pragma once

/// Machine code in memory.
///
///     const std::shared_ptr<const std::uint8_t> code = executable(bytes);
///     if (code) reinterpret_cast<double (*)(double)>(const_cast<std::uint8_t*>(code.get()))(1.0);
///
/// The memory is written first and made executable afterwards; it is never both. It is given back with the last
/// copy of the pointer. Null if the system does not allow it, or there is no memory.

#include <cstdint>
#include <memory>
#include <span>

namespace alembert {

std::shared_ptr<const std::uint8_t> executable(std::span<const std::uint8_t> code);

}  // namespace alembert
