// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/encoder.hpp"

#include <array>
#include <bit>

#include "alembert/native/registers.hpp"

namespace alembert::machine {

namespace {

using Xbyak::CodeGenerator, Xbyak::Xmm, Xbyak::Ymm, Xbyak::Zmm;

/// Memory that is never executed: `executable` copies what is finished.
struct Heap : Xbyak::Allocator {
    bool useProtect() const override { return false; }
};
Heap heap;

using Call = void (*)(CodeGenerator&, const Xmm& to, const Xmm& first, const Xbyak::Operand& second);
template <auto of>
constexpr Call call = [](CodeGenerator& code, const Xmm& to, const Xmm& first, const Xbyak::Operand& second) {
    (code.*of)(to, first, second);
};
constexpr Call packed_root = [](CodeGenerator& code, const Xmm& to, const Xmm&, const Xbyak::Operand& second) {
    code.vsqrtpd(to, second);
};

/// For one double, and for several.
using C = CodeGenerator;
constexpr std::array<std::array<Call, 2>, 19> calls{{
    {call<&C::vaddsd>, call<&C::vaddpd>},
    {call<&C::vmulsd>, call<&C::vmulpd>},
    {call<&C::vsubsd>, call<&C::vsubpd>},
    {call<&C::vdivsd>, call<&C::vdivpd>},
    {call<&C::vsqrtsd>, packed_root},
    {call<&C::vandpd>, call<&C::vandpd>},
    {call<&C::vxorpd>, call<&C::vxorpd>},
    {call<&C::vfmadd132sd>, call<&C::vfmadd132pd>},
    {call<&C::vfmadd213sd>, call<&C::vfmadd213pd>},
    {call<&C::vfmadd231sd>, call<&C::vfmadd231pd>},
    {call<&C::vfmsub132sd>, call<&C::vfmsub132pd>},
    {call<&C::vfmsub213sd>, call<&C::vfmsub213pd>},
    {call<&C::vfmsub231sd>, call<&C::vfmsub231pd>},
    {call<&C::vfnmadd132sd>, call<&C::vfnmadd132pd>},
    {call<&C::vfnmadd213sd>, call<&C::vfnmadd213pd>},
    {call<&C::vfnmadd231sd>, call<&C::vfnmadd231pd>},
    {call<&C::vfnmsub132sd>, call<&C::vfnmsub132pd>},
    {call<&C::vfnmsub213sd>, call<&C::vfnmsub213pd>},
    {call<&C::vfnmsub231sd>, call<&C::vfnmsub231pd>},
}};

}  // namespace

bool can_run(int lanes) {
    return registers() == Registers::widest || (lanes < 8 && registers() == Registers::wide);
}

int lanes_of_processor() {
    return registers() == Registers::widest ? 8 : 4;
}

int registers_of_processor() {
    return registers() == Registers::widest ? 32 : 16;
}

Encoder::Encoder(int lanes, int registers)
    : CodeGenerator(1 << 16, Xbyak::AutoGrow, &heap), lanes_(lanes), registers_(lanes == 4 ? 16 : registers) {
    constexpr std::uint64_t size = 0x7fffffffffffffff, sign = ~size;
    if (lanes == 4)
        constants_ = {size, size, size, size, sign, sign, sign, sign};
    else
        constants_ = {size, 0, sign, 0};
}

Xbyak::Address Encoder::at(const Memory& memory, bool stands_for_all) {
    if (memory.base != Base::constants) return ptr[Xbyak::Reg64(static_cast<int>(memory.base)) + memory.offset];
    return (stands_for_all ? ptr_b : ptr)[rip + begin_of_constants_ + memory.offset];
}

void Encoder::compute(Instruction instruction, int to, int first, const Operand& second, int numbers) {
    const Call call = calls[static_cast<std::size_t>(instruction)][numbers > 1 ? 1 : 0];
    if (second.memory)
        call(*this, reg(to, numbers), reg(first, numbers), at(*second.memory, numbers == 8));
    else
        call(*this, reg(to, numbers), reg(first, numbers), reg(second.reg, numbers));
}

void Encoder::load(int to, const Memory& from, int numbers) {
    if (numbers == 1)
        vmovsd(Xmm(to), at(from));
    else if (from.base == Base::constants && numbers == 8)
        vbroadcastsd(Zmm(to), at(from));
    else
        vmovupd(reg(to, numbers), at(from));
}

void Encoder::store(const Memory& to, int from, int numbers) {
    if (numbers > 1)
        vmovupd(at(to), reg(from, numbers));
    else
        vmovsd(at(to), Xmm(from));
}

void Encoder::copy(int to, int from, int numbers) {
    vmovapd(reg(to, numbers), reg(from, numbers));
}

void Encoder::enter() {
    constexpr std::uint32_t any_large = 1 << 20;  // so that it takes four bytes
    if (is_packed()) {
        push(rbp);
        mov(rbp, rsp);
    }
    sub(rsp, any_large);
    frame_ = getSize() - sizeof any_large;
    if (is_packed()) and_(rsp, -64);
}

void Encoder::end(std::int32_t bytes) {
    rewrite(frame_, static_cast<std::uint32_t>(bytes), sizeof bytes);
    if (is_packed()) {
        vzeroupper();
        leave();
    } else {
        add(rsp, static_cast<std::uint32_t>(bytes));
    }
    ret();
}

void Encoder::end_unless_above(int number, double bound, std::size_t other, std::int32_t bytes) {
    constexpr std::uint8_t greater = 30;
    const int free = number == 0 ? 1 : 0;
    load(free, constant(bound));
    if (lanes_ == 8) {
        vcmppd(k1, Zmm(number), Zmm(free), greater);  // a bit for each double
        kortestb(k1, k1);                             // whether one of the eight is set
    } else {
        vcmppd(Ymm(free), Ymm(number), Ymm(free), greater);
        vtestpd(Ymm(free), Ymm(free));  // whether one of the four signs is set
    }
    rewrite(frame_, static_cast<std::uint32_t>(bytes), sizeof bytes);
    vzeroupper();
    leave();
    db(0x850f, 2);  // jnz; xbyak knows labels alone
    dd(static_cast<std::uint32_t>(other - (getSize() + 4)));
    ret();
}

Memory Encoder::constant(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto [known, is_new] = places_.try_emplace(bits, static_cast<std::int32_t>(8 * constants_.size()));
    if (is_new) constants_.insert(constants_.end(), lanes_ == 4 ? 4 : 1, bits);
    return {Base::constants, known->second};
}

std::vector<std::uint8_t> Encoder::finished() {
    align();
    L(begin_of_constants_);
    for (const std::uint64_t bits : constants_) dq(bits);
    ready();
    return {getCode(), getCode() + getSize()};
}

}  // namespace alembert::machine
