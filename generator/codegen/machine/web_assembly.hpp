// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lines (lines.hpp) as a WebAssembly module, byte by byte as the specification has them (WebAssembly Core
/// Specification 1.0, chapter 5). Nothing here runs what it writes, so that any program can test it.
///
///     ModuleOfLines module({.block = place, .sines = index});
///     module.add(lines);                         // exported as "0", the next one as "1" …
///     const std::vector<std::uint8_t> bytes = module.bytes();
///
/// The module imports the memory `e.m` and the table `e.t` of its host. A function takes t, if its lines do, as a
/// number of 64 bits, and its arrays as places in that memory. Every value is a local variable, or stays on the
/// stack of operands; the engine that compiles the module gives out registers. Of eight systems side by side, a
/// value is four vectors of two lanes (the specification's extension for vectors of 128 bits), and t comes as an
/// array too. There is no fused multiply-add: a product is rounded before it is added.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "codegen/machine/lines.hpp"

namespace alembert::machine {

/// What functions find at their host.
struct WebHost {
    /// A place in memory for angles, sines and cosines: `room_in_block` of the largest function.
    std::uint32_t block = 0;
    std::uint32_t sines = 0;  ///< in the table: (angles, distance, count) ↦ sines after them, cosines after these
    /// The place of a C++ function in the table.
    std::uint32_t (*place_of)(const void* function) = nullptr;
};

/// How many numbers a function needs in the block.
inline std::size_t room_in_block(const Lines& lines) {
    return static_cast<std::size_t>(lines.lanes) * (static_cast<std::size_t>(lines.block) + 2);
}

class ModuleOfLines {
public:
    explicit ModuleOfLines(WebHost host) : host_(host) {}

    /// False if the function is too large for an engine. Lines of packs call their sines (Sines::called).
    bool add(const Lines& lines);
    /// A function that calls the one at the place `function`, of (double, five numbers of 32 bits), with `last` as
    /// one more argument.
    void add_call(std::uint32_t function, std::uint32_t last);

    int size() const { return static_cast<int>(bodies_.size()); }
    std::vector<std::uint8_t> bytes() const;

    using Bytes = std::vector<std::uint8_t>;

private:
    friend class WebFunction;
    std::uint32_t type(const std::string& of);  ///< arguments and result as letters: "dii>" and "d>d"

    WebHost host_;
    std::vector<std::string> types_ = {};
    std::vector<std::uint32_t> type_of_ = {};
    std::vector<Bytes> bodies_ = {};
};

}  // namespace alembert::machine
