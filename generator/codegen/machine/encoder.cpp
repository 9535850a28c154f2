// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/encoder.hpp"

#include <bit>
#include <cstring>

#include "alembert/native/cpu_features.hpp"

namespace alembert::machine {

/// The mandatory prefix (1: 66, 3: F2), the table of opcodes (1: 0F, 2: 0F38), the opcode, and the bit W.
struct Encoder::Opcode {
    unsigned prefix, table, code;
    bool wide = false;
};

namespace {

constexpr unsigned no_register = 0;  ///< in the field of a register that an instruction does not have

}  // namespace

bool can_run(int lanes) {
    return registers() == Registers::widest || (lanes == 1 && registers() == Registers::wide);
}

int Encoder::registers_of_processor() {
    return alembert::registers() == Registers::widest ? 32 : 16;
}

void Encoder::four(std::uint32_t value) {
    for (int k = 0; k < 4; ++k) byte(value >> (8 * k) & 0xff);
}

/// The bytes that say which register and which place in memory. An offset of one byte counts units of so many
/// bytes. `after`: the bytes of the instruction that follow.
void Encoder::place(unsigned reg, const Memory& memory, int unit, int after) {
    const unsigned middle = (reg & 7) << 3;
    if (memory.base == Base::constants) {
        byte(middle | 5);
        relative_.emplace_back(bytes_.size(), after);
        four(static_cast<std::uint32_t>(memory.offset));
        return;
    }
    const unsigned base = static_cast<unsigned>(memory.base) & 7;
    const int units = memory.offset / unit;
    const bool is_short = memory.offset % unit == 0 && units >= -128 && units <= 127;
    byte((is_short ? 0x40U : 0x80U) | middle | base);
    if (base == 4) byte(0x24);  // rsp needs a byte that says: no index
    if (is_short)
        byte(static_cast<unsigned>(units) & 0xff);
    else
        four(static_cast<std::uint32_t>(memory.offset));
}

namespace {

/// The number of a register, or of the base of a place in memory.
unsigned number_of(const Operand& operand) {
    if (!operand.memory) return static_cast<unsigned>(operand.reg);
    return operand.memory->base == Base::constants ? 0U : static_cast<unsigned>(operand.memory->base);
}

}  // namespace

/// An instruction with the prefix EVEX. `more`: the bits of its last byte besides that of the register `first`.
void Encoder::extended(const Opcode& code, int to, int first, const Operand& second, unsigned more) {
    const auto t = static_cast<unsigned>(to), f = static_cast<unsigned>(first);
    const unsigned s = number_of(second), not_x = second.memory ? 1 : ~s >> 4 & 1;
    byte(0x62);
    byte((~t >> 3 & 1) << 7 | not_x << 6 | (~s >> 3 & 1) << 5 | (~t >> 4 & 1) << 4 | code.table);
    byte(1U << 7 | (~f & 15) << 3 | 1U << 2 | code.prefix);
    byte((~f >> 4 & 1) << 3 | more);
    byte(code.code);
}

void Encoder::encode_packed(const Opcode& code, int to, int first, const Operand& second, bool broadcasts,
                            std::optional<unsigned> last) {
    constexpr unsigned whole_register = 0x40, one_for_all = 0x10;
    extended(code, to, first, second, whole_register | (broadcasts ? one_for_all : 0));
    if (second.memory)
        place(static_cast<unsigned>(to), *second.memory, 64, last ? 1 : 0);
    else
        byte(0xc0 | (static_cast<unsigned>(to) & 7) << 3 | (number_of(second) & 7));
    if (last) byte(*last);
}

void Encoder::encode(const Opcode& code, int to, int first, const Operand& second) {
    const auto t = static_cast<unsigned>(to), f = static_cast<unsigned>(first);
    const unsigned s = number_of(second), not_r = ~t >> 3 & 1, not_b = ~s >> 3 & 1;
    const bool is_extended = t > 15 || f > 15 || (!second.memory && s > 15);
    if (is_extended) {
        extended(code, to, first, second, 0);
    } else if (code.table == 1 && !code.wide && not_b == 1) {
        byte(0xc5);
        byte(not_r << 7 | (~f & 15) << 3 | code.prefix);
        byte(code.code);
    } else {
        byte(0xc4);
        byte(not_r << 7 | 1U << 6 | not_b << 5 | code.table);
        byte((code.wide ? 1U : 0U) << 7 | (~f & 15) << 3 | code.prefix);
        byte(code.code);
    }
    if (second.memory)
        place(t, *second.memory, is_extended ? 8 : 1);
    else
        byte(0xc0 | (t & 7) << 3 | (s & 7));
}

void Encoder::compute(Instruction instruction, int to, int first, const Operand& second) {
    static constexpr std::array<Opcode, 19> opcodes{{
        {3, 1, 0x58},       {3, 1, 0x59},       {3, 1, 0x5c},       {3, 1, 0x5e},       {3, 1, 0x51},
        {1, 1, 0x54},       {1, 1, 0x57},       {1, 2, 0x99, true}, {1, 2, 0xa9, true}, {1, 2, 0xb9, true},
        {1, 2, 0x9b, true}, {1, 2, 0xab, true}, {1, 2, 0xbb, true}, {1, 2, 0x9d, true}, {1, 2, 0xad, true},
        {1, 2, 0xbd, true}, {1, 2, 0x9f, true}, {1, 2, 0xaf, true}, {1, 2, 0xbf, true},
    }};
    const Opcode& code = opcodes[static_cast<std::size_t>(instruction)];
    if (!is_packed_) return encode(code, to, first, second);
    // The opcodes of fused instructions on whole registers are even; a root has one operand.
    const bool is_root = instruction == Instruction::root;
    encode_packed({1, code.table, code.table == 2 ? code.code & ~1U : code.code, true}, to,
                  is_root ? no_register : first, second, second.memory && second.memory->base == Base::constants);
}

void Encoder::shift(bool to_left, int to, int from, int bits) {
    // The register of the result stands where other instructions have their first operand.
    encode_packed({1, 1, to_left ? 0x73U : 0x72U, true}, to_left ? 6 : 4, to, {.reg = from}, false,
                  static_cast<unsigned>(bits));
}

void Encoder::larger_size(int to, int first, const Operand& second) {
    constexpr unsigned largest_absolute = 3, sign_is_clear = 2 << 2;
    encode_packed({1, 3, 0x50, true}, to, first, second, false, largest_absolute | sign_is_clear);
}

// The last byte lists the result for all bits of the result's register, the second and the third.
void Encoder::select(int to, int second, int mask) {
    encode_packed({1, 3, 0x25, true}, to, second, {.reg = mask}, false, 0xd8);
}

void Encoder::turn_sign(int to, int by) {
    encode_packed({1, 3, 0x25, true}, to, by, {.memory = sign()}, true, 0x78);
}

void Encoder::load(int to, const Memory& from) {
    if (!is_packed_)
        encode({3, 1, 0x10}, to, no_register, {.memory = from});
    else if (from.base == Base::constants)
        encode_packed({1, 2, 0x19, true}, to, no_register, {.memory = from}, false);
    else
        encode_packed({1, 1, 0x10, true}, to, no_register, {.memory = from}, false);
}

void Encoder::store(const Memory& to, int from) {
    if (is_packed_)
        encode_packed({1, 1, 0x11, true}, from, no_register, {.memory = to}, false);
    else
        encode({3, 1, 0x11}, from, no_register, {.memory = to});
}

void Encoder::copy(int to, int from) {
    if (is_packed_)
        encode_packed({1, 1, 0x28, true}, to, no_register, {.reg = from}, false);
    else
        encode({1, 1, 0x28}, to, no_register, {.reg = from});
}

/// An instruction on a whole register of 64 bits.
void Encoder::whole(unsigned opcode, Base reg, const Memory& memory) {
    const unsigned r = static_cast<unsigned>(reg),
                   b = memory.base == Base::constants ? 0U : static_cast<unsigned>(memory.base);
    byte(0x48 | (r >> 3 & 1) << 2 | (b >> 3 & 1));
    byte(opcode);
    place(r, memory, 1);
}

void Encoder::load_pointer(Base to, const Memory& from) {
    whole(0x8b, to, from);
}

void Encoder::store_pointer(const Memory& to, Base from) {
    whole(0x89, from, to);
}

void Encoder::address(Base to, const Memory& of) {
    whole(0x8d, to, of);
}

std::size_t Encoder::lower_stack() {
    for (const unsigned b : {0x48U, 0x81U, 0xecU}) byte(b);
    four(0);
    return bytes_.size() - 4;
}

void Encoder::raise_stack_and_return(std::size_t lowered, std::int32_t bytes) {
    std::memcpy(&bytes_[lowered], &bytes, sizeof bytes);
    for (const unsigned b : {0x48U, 0x81U, 0xc4U}) byte(b);
    four(static_cast<std::uint32_t>(bytes));
    byte(0xc3);
}

// push rbp; mov rbp, rsp; sub rsp, …; and rsp, −64
std::size_t Encoder::lower_aligned_stack() {
    for (const unsigned b : {0x55U, 0x48U, 0x89U, 0xe5U}) byte(b);
    const std::size_t lowered = lower_stack();
    for (const unsigned b : {0x48U, 0x83U, 0xe4U, 0xc0U}) byte(b);
    return lowered;
}

void Encoder::leave_and_return(std::size_t lowered, std::int32_t bytes) {
    std::memcpy(&bytes_[lowered], &bytes, sizeof bytes);
    byte(0xc9);
    byte(0xc3);
}

void Encoder::leave_and_return_unless_above(int reg, double bound, std::size_t other, std::size_t lowered,
                                            std::int32_t bytes) {
    constexpr unsigned greater = 30;
    std::memcpy(&bytes_[lowered], &bytes, sizeof bytes);
    const int free = reg == 0 ? 1 : 0;
    load(free, constant(bound));
    encode_packed({1, 1, 0xc2, true}, 1, reg, {.reg = free}, false, greater);  // a bit for each double, to k1
    for (const unsigned b : {0xc5U, 0xf9U, 0x98U, 0xc9U}) byte(b);             // whether one of the eight is set
    forget_upper_parts();
    byte(0xc9);
    byte(0x0f);
    byte(0x85);
    four(static_cast<std::uint32_t>(static_cast<std::int64_t>(other) -
                                    static_cast<std::int64_t>(bytes_.size() + 4)));
    byte(0xc3);
}

void Encoder::forget_upper_parts() {
    for (const unsigned b : {0xc5U, 0xf8U, 0x77U}) byte(b);
}

void Encoder::number(Base to, std::int32_t value) {
    byte(0xb8 | static_cast<unsigned>(to));
    four(static_cast<std::uint32_t>(value));
}

void Encoder::pointer(Base to, const void* value) {
    const auto r = static_cast<unsigned>(to);
    byte(0x48 | r >> 3);
    byte(0xb8 | (r & 7));
    const auto at = reinterpret_cast<std::uintptr_t>(value);
    four(static_cast<std::uint32_t>(at));
    four(static_cast<std::uint32_t>(at >> 32));
}

void Encoder::call(const void* function) {
    pointer(Base::rax, function);
    byte(0xff);
    byte(0xd0);
}

void Encoder::jump(const void* function) {
    pointer(Base::rax, function);
    byte(0xff);
    byte(0xe0);
}

Memory Encoder::constant(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto [known, is_new] = places_.try_emplace(bits, static_cast<std::int32_t>(8 * constants_.size()));
    if (is_new) constants_.push_back(bits);
    return {Base::constants, known->second};
}

void Encoder::align() {
    while (bytes_.size() % 16 != 0) byte(0xcc);  // never reached
}

std::vector<std::uint8_t> Encoder::finished() {
    align();
    const std::size_t end = bytes_.size();
    for (const auto& [at, after] : relative_) {
        std::int32_t offset = 0;
        std::memcpy(&offset, &bytes_[at], sizeof offset);
        offset += static_cast<std::int32_t>(end - (at + sizeof offset)) - after;
        std::memcpy(&bytes_[at], &offset, sizeof offset);
    }
    relative_.clear();
    bytes_.resize(end + 8 * constants_.size());
    std::memcpy(&bytes_[end], constants_.data(), 8 * constants_.size());
    return bytes_;
}

}  // namespace alembert::machine
