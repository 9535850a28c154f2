// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes instructions of x86-64 as bytes: those that straight-line code on doubles needs.
///
///     Encoder code;
///     code.load(3, Memory{.base = Base::rsi, .offset = 8});                  // vmovsd xmm3, [rsi + 8]
///     code.compute(Instruction::add, 1, 2, Operand{.reg = 3});               // vaddsd xmm1, xmm2, xmm3
///     code.compute(Instruction::fused_add_231, 1, 2, Operand{.memory = place});  // xmm1 += xmm2·[place]
///
/// Registers are 0 … 15, with AVX-512 also 16 … 31. Constants lie behind the code, and are addressed relative to
/// it. The encoding is that of Intel's Software Developer's Manual, volume 2, 2.3 (VEX) and 2.7 (EVEX).
///
/// With eight lanes, a register and a place in memory hold eight doubles side by side (AVX-512), and a constant is
/// one double that stands for eight.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace alembert::machine {

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

/// Whether this processor and its system have the instructions: AVX2 and FMA; for eight lanes AVX-512.
bool can_run(int lanes = 1);

class Encoder {
public:
    /// `lanes`: 1 or 8. `registers`: how many of them the code may use, 16 or 32.
    explicit Encoder(int lanes = 1, int registers = registers_of_processor())
        : is_packed_(lanes > 1), registers_(registers) {}
    static int registers_of_processor();
    int registers() const { return registers_; }

    void compute(Instruction instruction, int to, int first, const Operand& second);
    /// Shifts the bits of each double to the left, or to the right so that the sign moves in; eight lanes only.
    void shift(bool to_left, int to, int from, int bits);
    /// The larger size of two; the second where the bits of a mask are set, else the result's register; the
    /// result's register with its sign turned where that of the second is set. Eight lanes only.
    void larger_size(int to, int first, const Operand& second);
    void select(int to, int second, int mask);
    void turn_sign(int to, int by);
    void load(int to, const Memory& from);
    void store(const Memory& to, int from);
    void copy(int to, int from);

    /// Makes room on the stack; how much is said at the end.
    std::size_t lower_stack();
    void raise_stack_and_return(std::size_t lowered, std::int32_t bytes);
    /// The same where the stack is then at a multiple of 64 bytes.
    std::size_t lower_aligned_stack();
    void leave_and_return(std::size_t lowered, std::int32_t bytes);
    /// The same, but goes to the function at `other` if a double in the register is larger than `bound`.
    void leave_and_return_unless_above(int reg, double bound, std::size_t other, std::size_t lowered,
                                       std::int32_t bytes);
    void load_pointer(Base to, const Memory& from);
    void store_pointer(const Memory& to, Base from);
    void address(Base to, const Memory& of);
    void number(Base to, std::int32_t value);
    void pointer(Base to, const void* value);
    void call(const void* function);
    void jump(const void* function);
    /// Before code of others: it would wait for the upper parts of registers.
    void forget_upper_parts();

    /// A constant behind the code; equal ones share a place.
    Memory constant(double value);
    /// Constants of 16 bytes: everything but the sign of a double, and the sign alone.
    static Memory all_but_sign() { return {Base::constants, 0}; }
    static Memory sign() { return {Base::constants, 16}; }

    std::size_t size() const { return bytes_.size(); }
    void align();
    /// The code with its constants.
    std::vector<std::uint8_t> finished();

private:
    struct Opcode;
    void byte(unsigned value) { bytes_.push_back(static_cast<std::uint8_t>(value)); }
    void four(std::uint32_t value);
    void encode(const Opcode& code, int to, int first, const Operand& second);
    void encode_packed(const Opcode& code, int to, int first, const Operand& second, bool broadcasts,
                       std::optional<unsigned> last = {});
    void extended(const Opcode& code, int to, int first, const Operand& second, unsigned more);
    void whole(unsigned opcode, Base reg, const Memory& memory);
    void place(unsigned reg, const Memory& memory, int unit, int after = 0);

    bool is_packed_;
    int registers_;
    std::vector<std::uint8_t> bytes_;
    std::vector<std::uint64_t> constants_{0x7fffffffffffffff, 0, 0x8000000000000000, 0};
    std::map<std::uint64_t, std::int32_t> places_;
    /// Where an offset counts from the end of the instruction, which is so many bytes after its own four.
    std::vector<std::pair<std::size_t, int>> relative_;
};

}  // namespace alembert::machine
