// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions that are written into memory and can be called: what lies between lines (lines.hpp) and the tables of
/// a solver. Two files have it, for x86-64 (memory_code.cpp) and for WebAssembly (web_memory_code.cpp), and a
/// third says that there is none (no_machine_code.cpp).
///
///     MemoryCode code;
///     code.write(lines, table.rhs);
///     if (const std::shared_ptr<const void> held = code.placed())    // from now on table.rhs can be called,
///         …                                                           // as long as `held` or a copy of it lives

#include <cstdint>
#include <functional>
#include <memory>

#include "codegen/machine/can_run.hpp"
#include "codegen/machine/lines.hpp"

namespace alembert::machine {

class MemoryCode {
public:
    /// `lanes`: 1, or 4 or 8, with which functions are for eight systems side by side; `registers`: how many of
    /// the processor's it may use.
    explicit MemoryCode(int lanes = 1, int registers = registers_of_processor());
    ~MemoryCode();
    MemoryCode(const MemoryCode&) = delete;
    MemoryCode& operator=(const MemoryCode&) = delete;
    int lanes() const;

    /// Writes a function whose address `place` gets when it is placed. Lines with sines inside need `other`, which
    /// `write_aside` has given of the same function with called sines: it is taken for large angles.
    template <typename Function>
    void write(const Lines& lines, Function& place, std::size_t other = 0) {
        write(lines, other, put_into(place));
    }
    std::size_t write_aside(const Lines& lines);

    /// Writes a function that calls `function` with its own arguments (a double, three pointers or numbers of 32
    /// bits, two more) and `last` as one more.
    template <typename Function>
    void write_call(const void* function, const void* last, Function& place) {
        write_call(function, last, put_into(place));
    }

    /// Keeps what is written callable; null if a function is too large, or the system does not allow it.
    std::shared_ptr<const void> placed();

private:
    using Put = std::function<void(std::uintptr_t)>;
    template <typename Function>
    static Put put_into(Function& place) {
        return [&place](std::uintptr_t address) { place = reinterpret_cast<Function>(address); };
    }
    void write(const Lines& lines, std::size_t other, Put put);
    void write_call(const void* function, const void* last, Put put);

    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace alembert::machine
