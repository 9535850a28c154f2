// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The assembler of xbyak (S. Mitsunari, BSD-3-Clause), with what straight-line code on doubles needs besides.
///
///     Encoder code;
///     code.load(3, Memory{.base = Base::rsi, .offset = 8});                      // vmovsd xmm3, [rsi + 8]
///     code.compute(Instruction::add, 1, 2, Operand{.reg = 3});                   // vaddsd xmm1, xmm2, xmm3
///     code.compute(Instruction::fused_add_231, 1, 2, Operand{.memory = place});  // xmm1 += xmm2·[place]
///     code.vzeroupper();                                                         // and all that xbyak has
///
/// Registers are 0 … 15, with AVX-512 also 16 … 31. With several lanes, a register and a place in memory hold so
/// many doubles side by side. A constant is one double, with eight lanes too, where it stands for all; with four
/// lanes, which AVX2 has, it is there four times. Constants lie behind the code, and are addressed relative to it.

#include <xbyak/xbyak.h>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "codegen/machine/can_run.hpp"

namespace alembert::machine {

/// In xbyak's order, and the constants.
enum class Base : unsigned char { rax, rcx, rdx, rbx, rsp, rbp, rsi, rdi, r8, r9, constants };

struct Memory {
    Base base = Base::rsp;
    std::int32_t offset = 0;  ///< in bytes; for Base::constants from the first constant
};

/// A register, or a place in memory.
struct Operand {
    int reg = -1;
    std::optional<Memory> memory = {};
};

/// In the order of their rows in encoder.cpp. The digits say which operands are multiplied: 213 is second times
/// first plus third. `fused_subtract` is a·b − c, `fused_from` c − a·b, and `fused_minus` −a·b − c.
enum class Instruction : unsigned char {
    add,
    multiply,
    subtract,
    divide,
    root,
    both_bits,
    other_bits,
    fused_add_132,
    fused_add_213,
    fused_add_231,
    fused_subtract_132,
    fused_subtract_213,
    fused_subtract_231,
    fused_from_132,
    fused_from_213,
    fused_from_231,
    fused_minus_132,
    fused_minus_213,
    fused_minus_231
};

class Encoder : public Xbyak::CodeGenerator {
public:
    /// `lanes`: 1, 4 or 8. `registers`: how many of them the code may use, 16 or, not with four lanes, 32.
    explicit Encoder(int lanes = 1, int registers = registers_of_processor());
    int lanes() const { return lanes_; }
    int registers() const { return registers_; }

    /// `numbers`: how many the registers hold, 1, 2, 4 or 8.
    void compute(Instruction instruction, int to, int first, const Operand& second, int numbers);
    void load(int to, const Memory& from, int numbers);
    void store(const Memory& to, int from, int numbers);
    void copy(int to, int from, int numbers);
    void compute(Instruction instruction, int to, int first, const Operand& second) {
        compute(instruction, to, first, second, lanes_);
    }
    void load(int to, const Memory& from) { load(to, from, lanes_); }
    void store(const Memory& to, int from) { store(to, from, lanes_); }
    void copy(int to, int from) { copy(to, from, lanes_); }
    static Xbyak::Xmm reg(int number, int numbers) {
        if (numbers == 8) return Xbyak::Zmm(number);
        return numbers == 4 ? Xbyak::Ymm(number) : Xbyak::Xmm(number);
    }
    Xbyak::Xmm reg(int number) const { return reg(number, lanes_); }
    Xbyak::Address at(const Memory& memory, bool stands_for_all = false);

    /// Begins a function with room on its stack, with several lanes at a multiple of 64 bytes; the end says how
    /// much.
    void enter();
    void end(std::int32_t bytes);
    /// The same, but goes to the function at `other` if a double in the register is larger than `bound`. Several
    /// lanes only.
    void end_unless_above(int number, double bound, std::size_t other, std::int32_t bytes);

    /// A constant behind the code; equal ones share a place.
    Memory constant(double value);
    /// Constants of 16 bytes, with four lanes of 32: everything but the sign of a double, and the sign alone.
    static Memory all_but_sign() { return {Base::constants, 0}; }
    Memory sign() const { return {Base::constants, lanes_ == 4 ? 32 : 16}; }

    /// The code with its constants.
    std::vector<std::uint8_t> finished();

private:
    bool is_packed() const { return lanes_ > 1; }

    int lanes_, registers_;
    std::size_t frame_ = 0;  ///< where the room on the stack is said
    Xbyak::Label begin_of_constants_;
    std::vector<std::uint64_t> constants_;
    std::map<std::uint64_t, std::int32_t> places_;
};

}  // namespace alembert::machine
