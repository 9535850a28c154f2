// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/registers.hpp"

#include <algorithm>

#include "alembert/native/simd_math.hpp"
#include "codegen/machine/register_file.hpp"

namespace alembert::machine {

namespace {

using Xbyak::Xmm, Xbyak::Ymm, Xbyak::Zmm;

constexpr std::int32_t largest_frame = 1 << 20;  ///< in bytes; a thread's stack has several times as much

Xbyak::Reg64 pointer(Base base) {
    return Xbyak::Reg64(static_cast<int>(base));
}

Instruction plus(Instruction first, int k) {
    return static_cast<Instruction>(static_cast<int>(first) + k);
}

class Registering : RegisterFile {
public:
    Registering(Encoder& code, const Lines& lines, std::size_t other) : RegisterFile(code, lines), other_(other) {}

    bool write() {
        code_.enter();
        for (int k = 0; k < saved_; ++k) code_.mov(code_.at({Base::rsp, 8 * k}), pointer(bases[k]));
        if (l_.takes_time && !is_packed()) code_.store({Base::rsp, time_}, 0);
        for (at_ = 0; at_ < static_cast<int>(l_.list.size()); ++at_) write(l_.list[at_]);
        if (l_.largest >= 0) {
            locked_ = 0;
            load(l_.largest);
            code_.end_unless_above(reg_[l_.largest], farthest_for_code, other_, frame_);
            return frame_ <= largest_frame;
        }
        if (!is_packed()) {
            frame_ += frame_ % 16 == 8 ? 0 : 8;  // with the return address, a multiple of 16
            if (has_fours_) code_.vzeroupper();
        }
        code_.end(frame_);
        return frame_ <= largest_frame;
    }

private:
    void write(const Line& line) {
        locked_ = 0;
        for (const int v : line.of)
            if (v >= 0) lock(v);
        switch (line.kind) {
            case Line::Kind::add:
                return binary(line, Instruction::add, true);
            case Line::Kind::multiply:
                return binary(line, Instruction::multiply, true);
            case Line::Kind::subtract:
                return binary(line, Instruction::subtract, false);
            case Line::Kind::divide:
                return binary(line, Instruction::divide, false);
            case Line::Kind::root:
                load(line.of[0]);
                return unary(line, Instruction::root, {});
            case Line::Kind::absolute:
                load(line.of[0]);
                return unary(line, Instruction::both_bits, Encoder::all_but_sign());
            case Line::Kind::negative:
                load(line.of[0]);
                return unary(line, Instruction::other_bits, code_.sign());
            case Line::Kind::larger_size:
                return larger_size(line);
            case Line::Kind::shift_left:
            case Line::Kind::shift_right: {
                load(line.of[0]);
                const int x = reg_[line.of[0]], to = target(line);
                const auto bits = static_cast<std::uint8_t>(line.place);
                line.kind == Line::Kind::shift_left ? code_.vpsllq(code_.reg(to), code_.reg(x), bits)
                                                    : code_.vpsraq(Zmm(to), Zmm(x), bits);
                return finish(line, to);
            }
            case Line::Kind::select:
            case Line::Kind::turn_sign:
                return l_.lanes == 4 ? bits_of_four(line) : bits(line);
            case Line::Kind::fused:
                return fused(line);
            case Line::Kind::call:
                return call(line);
            case Line::Kind::sines:
                return sines(l_.groups[line.place]);
            case Line::Kind::store:
                load(line.of[0]);
                code_.store({base(line.argument), step_ * line.place}, reg_[line.of[0]]);
                return drop(line.of[0]);
            case Line::Kind::pair:
            case Line::Kind::join:
                return beside(line);
            case Line::Kind::repeat:
                return repeat(line);
            case Line::Kind::keep:
                load(line.of[0]);
                code_.store({Base::rsp, block_ + unit_ * line.place}, reg_[line.of[0]], numbers(line.of[0]));
                return drop(line.of[0]);
        }
    }

    void larger_size(const Line& line) {
        load(line.of[0]);
        load(line.of[1]);
        const int x = reg_[line.of[0]], y = reg_[line.of[1]];
        const int to = l_.lanes == 8 ? target(line) : taken();  // AVX2 needs both after the result is begun
        constexpr std::uint8_t largest_absolute = 3, sign_is_clear = 2 << 2;
        if (l_.lanes == 8) {
            code_.vrangepd(Zmm(to), Zmm(x), Zmm(y), largest_absolute | sign_is_clear);
        } else {
            code_.vandpd(Ymm(to), Ymm(y), code_.at(Encoder::all_but_sign()));
            code_.vmaxpd(Ymm(to), Ymm(to), Ymm(x));  // x where y is not a number
        }
        finish(line, to);
    }

    void binary(const Line& line, Instruction instruction, bool commutes) {
        int a = line.of[0], b = line.of[1];
        if (commutes && reg_[a] < 0 && reg_[b] >= 0) std::swap(a, b);
        load(a);
        load_if_useful(b);
        const int first = reg_[a];
        const Operand second = operand(b);
        const int to = target(line);
        code_.compute(instruction, to, first, second, numbers(line.to));
        finish(line, to);
    }

    void unary(const Line& line, Instruction instruction, const std::optional<Memory>& mask) {
        const int x = reg_[line.of[0]], to = target(line);
        code_.compute(instruction, to, x, mask ? Operand{.memory = mask} : Operand{.reg = x}, numbers(line.to));
        finish(line, to);
    }

    /// Two numbers, or two pairs of them.
    void beside(const Line& line) {
        load(line.of[0]);
        if (line.kind == Line::Kind::join) load_if_useful(line.of[1]);
        const int first = reg_[line.of[0]];
        const Operand second = operand(line.of[1]);
        const int to = target(line);
        if (line.kind == Line::Kind::join) {
            const auto insert = code_.registers() == 32 ? &Encoder::vinsertf64x2 : &Encoder::vinsertf128;
            if (second.memory)
                (code_.*insert)(Ymm(to), Ymm(first), code_.at(*second.memory), 1);
            else
                (code_.*insert)(Ymm(to), Ymm(first), Xmm(second.reg), 1);
        } else if (second.memory) {
            code_.vmovhpd(Xmm(to), Xmm(first), code_.at(*second.memory));
        } else {
            code_.vunpcklpd(Xmm(to), Xmm(first), Xmm(second.reg));
        }
        finish(line, to);
    }

    void repeat(const Line& line) {
        const Operand from = operand(line.of[0]);
        const int to = target(line);
        if (numbers(line.to) == 4)
            from.memory ? code_.vbroadcastsd(Ymm(to), code_.at(*from.memory))
                        : code_.vbroadcastsd(Ymm(to), Xmm(from.reg));
        else
            from.memory ? code_.vmovddup(Xmm(to), code_.at(*from.memory)) : code_.vmovddup(Xmm(to), Xmm(from.reg));
        finish(line, to);
    }

    /// ± a·b ± c. One of the three registers takes the result: that of a value that is not used again, or a new
    /// one.
    void fused(const Line& line) {
        int a = line.of[0], b = line.of[1];
        const int c = line.of[2];
        const Instruction first =
            line.minus_product ? (line.minus_rest ? Instruction::fused_minus_132 : Instruction::fused_from_132)
                               : (line.minus_rest ? Instruction::fused_subtract_132 : Instruction::fused_add_132);
        const auto ends = [&](int v) { return next(v) == never; };
        const auto is_free = [&](int v) { return reg_[v] >= 0 && ends(v); };
        const bool is_square = a == b;
        int base = -1;
        if (c != a && c != b && is_free(c))
            base = c;
        else if (!is_square && a != c && is_free(a))
            base = a;
        else if (!is_square && b != c && is_free(b))
            base = b;
        int r = -1;
        if (base >= 0) {
            r = reg_[base];
        } else {  // a copy of one of them
            const auto from_memory = [&](int v) { return reg_[v] < 0 && ends(v); };
            base = c;
            if (!is_square && !from_memory(c)) base = from_memory(a) ? a : from_memory(b) ? b : c;
            r = taken();
            free_ &= ~(1U << r);
            if (reg_[base] >= 0)
                code_.copy(r, reg_[base], numbers(base));
            else
                code_.load(r, memory(base), numbers(base));
            locked_ |= 1U << r;
        }
        if (base == b) std::swap(a, b);
        // The result's register is first; then a register; then a register or a place in memory.
        int second = base == c ? a : b, third = base == c ? b : c;
        const bool may_swap = base == c;
        if (may_swap && reg_[second] < 0 && reg_[third] >= 0) std::swap(second, third);
        if (!may_swap) {  // 213: second times first plus third; 132: first times third plus second
            const bool by_132 = reg_[second] < 0 && reg_[third] >= 0;
            if (by_132) std::swap(second, third);
            in_registers(second, third);
            code_.compute(plus(first, by_132 ? 0 : 1), r, reg_[second], operand(third), numbers(line.to));
        } else {
            in_registers(second, third);
            code_.compute(plus(first, 2), r, reg_[second], operand(third), numbers(line.to));
        }
        if (reg_[base] == r) {
            holds_[r] = -1;
            reg_[base] = -1;
        }
        finish(line, r);
    }

    /// A result that takes the register of the first operand, or of its copy.
    void bits(const Line& line) {
        for (const int v : line.of)
            if (v >= 0) load(v);
        const int a = line.of[0];
        int r = reg_[a];
        if (next(a) == never) {
            holds_[r] = -1;
            reg_[a] = -1;
        } else {
            r = taken();
            free_ &= ~(1U << r);
            code_.copy(r, reg_[a]);
        }
        // The last byte lists the result for all bits of the three.
        const Zmm second(reg_[line.of[1]]);
        if (line.kind == Line::Kind::select)
            code_.vpternlogq(Zmm(r), second, Zmm(reg_[line.of[2]]), 0xd8);
        else
            code_.vpternlogq(Zmm(r), second, code_.at(code_.sign(), true), 0x78);
        finish(line, r);
    }

    /// The same by AVX2, whose instructions have a register for the result.
    void bits_of_four(const Line& line) {
        for (const int v : line.of)
            if (v >= 0) load(v);
        const Ymm a(reg_[line.of[0]]), b(reg_[line.of[1]]);
        if (line.kind == Line::Kind::select) {
            const int mask = reg_[line.of[2]], to = target(line);
            code_.vblendvpd(Ymm(to), a, b, Ymm(mask));
            return finish(line, to);
        }
        const int to = taken();
        code_.vandpd(Ymm(to), b, code_.at(code_.sign()));
        code_.vxorpd(Ymm(to), Ymm(to), a);
        finish(line, to);
    }

    /// Saves what a call would destroy, except for values that end in this line.
    void save_all() {
        for (const int v : holds_)
            if (v >= 0 && next(v) != never) save(v);
    }
    void after_call(auto function) {
        if (has_fours_) code_.vzeroupper();  // code of others would wait for the upper parts of registers
        code_.mov(code_.rax, reinterpret_cast<std::uintptr_t>(function));
        code_.call(code_.rax);
        for (int r = 0; r < static_cast<int>(holds_.size()); ++r)
            if (holds_[r] >= 0) release(r);
        for (int k = 0; k < saved_; ++k) code_.mov(pointer(bases[k]), code_.at({Base::rsp, 8 * k}));
    }

    void call_packed(const Line& line) {
        for (int k = 0; k < 3 && line.of[k] >= 0; ++k) {
            load(line.of[k]);
            code_.store({Base::rsp, time_ + unit_ * k}, reg_[line.of[k]]);
        }
        save_all();
        code_.mov(code_.rdi, reinterpret_cast<std::uintptr_t>(line.function));
        code_.lea(code_.rsi, code_.at({Base::rsp, time_}));
        if (line.of[1] < 0)
            after_call(l_.lanes == 8 ? each_for_code : each_of_four_for_code);
        else if (line.of[2] >= 0)
            after_call(l_.lanes == 8 ? each_triple_for_code : each_triple_of_four_for_code);
        else
            after_call(l_.lanes == 8 ? each_pair_for_code : each_pair_of_four_for_code);
        code_.load(0, {Base::rsp, time_});
        finish(line, 0);
    }

    void call_of_three(const Line& line) {
        save_all();
        for (const int v : line.of) save(v);
        for (int k = 0; k < 3; ++k) code_.load(k, memory(line.of[static_cast<std::size_t>(k)]));
        after_call(line.function);
        finish(line, 0);
    }

    void call(const Line& line) {
        if (is_packed()) return call_packed(line);
        if (line.of[2] >= 0) return call_of_three(line);
        save_all();
        const int a = line.of[0], b = line.of[1];
        int rb = b >= 0 ? reg_[b] : -1;
        if (rb == 0 && a != b) {  // out of the way of the first argument
            rb = reg_[a] == 2 ? 3 : 2;
            code_.copy(rb, 0);
        }
        const int ra = reg_[a];
        if (ra > 0)
            code_.copy(0, ra);
        else if (ra < 0)
            code_.load(0, memory(a));
        if (b >= 0 && rb >= 0 && rb != 1)
            code_.copy(1, a == b ? 0 : rb);
        else if (b >= 0 && rb < 0)
            code_.load(1, memory(b));
        after_call(line.function);
        finish(line, 0);
    }

    void sines(const SineGroup& group) {
        const int count = group.size;
        const auto angle = [&](int k) {
            return group.angles[std::min(static_cast<std::size_t>(k), group.angles.size() - 1)];
        };
        const auto store = [&](int k) {
            code_.store({Base::rsp, block_ + unit_ * (group.place + k)}, reg_[angle(k)]);
        };
        std::vector<int> others;  // a register for one of these may be that of an angle which has been stored
        for (int k = 0; k < count; ++k)
            if (reg_[angle(k)] >= 0)
                store(k);
            else
                others.push_back(k);
        for (const int k : others) {
            locked_ = 0;
            load(angle(k));
            store(k);
        }
        save_all();
        code_.lea(code_.rdi, code_.at({Base::rsp, block_ + unit_ * group.place}));
        code_.mov(code_.esi, count * l_.lanes);
        after_call(l_.lanes == 8 ? sines_of_packs_for_code : sines_for_code);
        for (const int v : group.angles) drop(v);
    }

    std::size_t other_;
};

}  // namespace

bool write_function(Encoder& code, const Lines& lines, std::size_t other) {
    code.align();
    return Registering(code, lines, other).write();
}

}  // namespace alembert::machine
