// SPDX-License-Identifier: GPL-2.0-or-later
// In straight-line code the next use of every value is known. When a register is needed, the value goes whose next
// use lies furthest ahead, which takes the fewest loads (Belady, A study of replacement algorithms for a
// virtual-storage computer, IBM Systems Journal 5, 1966). A value without a home is stored on the stack first.
#include "codegen/machine/registers.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "alembert/native/simd_math.hpp"

namespace alembert::machine {

namespace {

using Xbyak::Ymm, Xbyak::Zmm;

constexpr int never = std::numeric_limits<int>::max();
constexpr std::int32_t largest_frame = 1 << 20;  ///< in bytes; a thread's stack has several times as much
constexpr int soon = 200;  ///< lines; a value that is used again so soon is loaded into a register if one is free
constexpr std::int32_t pack_size = 64;  ///< in bytes, of a value in the arrays of eight systems
constexpr std::array bases{Base::rdi, Base::rsi, Base::rdx, Base::rcx, Base::r8, Base::r9};

Xbyak::Reg64 pointer(Base base) {
    return Xbyak::Reg64(static_cast<int>(base));
}

Instruction plus(Instruction first, int k) {
    return static_cast<Instruction>(static_cast<int>(first) + k);
}

class Registering {
public:
    Registering(Encoder& code, const Lines& lines, std::size_t other)
        : code_(code),
          other_(other),
          l_(lines),
          holds_(static_cast<std::size_t>(code.registers()), -1),
          reg_(lines.homes.size(), -1),
          slot_(lines.homes.size(), -1),
          unit_(8 * lines.lanes),
          step_(lines.lanes > 1 ? pack_size : 8) {
        free_ = holds_.size() == 32 ? ~0U : 0xffffU;
        find_uses();
        const bool calls = std::any_of(l_.list.begin(), l_.list.end(), [](const Line& line) {
            return line.kind == Line::Kind::call || line.kind == Line::Kind::sines;
        });
        saved_ = calls ? l_.arrays + first_array() : 0;
        const auto in_units = [&](std::int32_t bytes) { return (bytes + unit_ - 1) / unit_ * unit_; };
        time_ = in_units(8 * saved_);
        block_ = time_ + (is_packed() ? 2 * unit_ : 8);  // packed: for the arguments of a call
        frame_ = block_ + unit_ * l_.block;
    }

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
        if (!is_packed()) frame_ += frame_ % 16 == 8 ? 0 : 8;  // with the return address, a multiple of 16
        code_.end(frame_);
        return frame_ <= largest_frame;
    }

private:
    bool is_packed() const { return l_.lanes > 1; }
    /// Packs are given a pointer to their times, before the arrays.
    int first_array() const { return is_packed() && l_.takes_time ? 1 : 0; }
    Base base(int array) const { return bases[static_cast<std::size_t>(array + first_array())]; }

    /// Lists, for each value, the lines that use it.
    void find_uses() {
        first_.assign(l_.homes.size() + 1, 0);
        const auto each = [&](const auto& use) {
            for (int k = 0; k < static_cast<int>(l_.list.size()); ++k) {
                const Line& line = l_.list[k];
                if (line.kind == Line::Kind::sines)
                    for (const int v : l_.groups[line.place].angles) use(v, k);
                for (const int v : line.of)
                    if (v >= 0) use(v, k);
            }
            if (l_.largest >= 0) use(l_.largest, static_cast<int>(l_.list.size()));
        };
        each([&](int v, int) { ++first_[v + 1]; });
        for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
        uses_.resize(static_cast<std::size_t>(first_.back()));
        next_ = first_;
        each([&](int v, int line) { uses_[next_[v]++] = line; });
        next_ = first_;
    }

    /// The next line after this one that uses the value.
    int next(int v) {
        int& place = next_[v];
        while (place < first_[v + 1] && uses_[place] <= at_) ++place;
        return place < first_[v + 1] ? uses_[place] : never;
    }

    bool has_memory(int v) const { return l_.homes[v].kind != Home::Kind::none || slot_[v] >= 0; }
    Memory memory(int v) {
        const Home& home = l_.homes[v];
        switch (home.kind) {
            case Home::Kind::time:
                return is_packed() ? Memory{bases[0], 0} : Memory{Base::rsp, time_};
            case Home::Kind::argument:
                return {base(home.argument), step_ * home.place};
            case Home::Kind::constant:
                return code_.constant(home.number);
            case Home::Kind::sines:
                return {Base::rsp, block_ + unit_ * home.place};
            case Home::Kind::none:
                break;
        }
        return {Base::rsp, slot_[v]};
    }
    Operand operand(int v) { return reg_[v] >= 0 ? Operand{.reg = reg_[v]} : Operand{.memory = memory(v)}; }

    void lock(int v) {
        if (reg_[v] >= 0) locked_ |= 1U << reg_[v];
    }

    /// Stores a value on the stack that has no other home.
    void save(int v) {
        if (has_memory(v)) return;
        if (slots_.empty()) {
            slot_[v] = frame_;
            frame_ += unit_;
        } else {
            slot_[v] = slots_.back();
            slots_.pop_back();
        }
        code_.store({Base::rsp, slot_[v]}, reg_[v]);
    }

    void release(int r) {
        reg_[holds_[r]] = -1;
        holds_[r] = -1;
        free_ |= 1U << r;
    }

    /// A register that is not locked, empty now.
    int taken() {
        if (free_ == 0) {
            int furthest = -1, distance = -1;
            for (int r = 0; r < static_cast<int>(holds_.size()); ++r) {
                if ((locked_ >> r & 1) != 0) continue;
                const int then = next(holds_[r]);
                if (then > distance) furthest = r, distance = then;
            }
            if (distance != never) save(holds_[furthest]);
            release(furthest);
        }
        return std::countr_zero(free_);
    }

    void hold(int r, int v) {
        holds_[r] = v;
        reg_[v] = r;
        free_ &= ~(1U << r);
        locked_ |= 1U << r;
    }

    void load(int v) {
        if (reg_[v] < 0) {
            const int r = taken();
            code_.load(r, memory(v));
            hold(r, v);
        }
        lock(v);
    }
    /// Loads a value that stays in memory otherwise, if it is used again soon and there is room.
    void load_if_useful(int v) {
        if (reg_[v] >= 0 || free_ == 0) return;
        const int then = next(v);
        if (then != never && then - at_ < soon) load(v);
    }

    /// Gives up registers and places on the stack of what is not used any more.
    void drop(int v) {
        if (v < 0 || next(v) != never) return;
        if (reg_[v] >= 0) {
            locked_ &= ~(1U << reg_[v]);
            release(reg_[v]);
        }
        if (slot_[v] >= 0) {
            slots_.push_back(slot_[v]);
            slot_[v] = -1;
        }
    }

    /// A register for the result, perhaps one of an operand. Their places on the stack are given up later: what is
    /// saved to make room would overwrite them.
    int target(const Line& line) {
        for (const int v : line.of)
            if (v >= 0 && reg_[v] >= 0 && next(v) == never) {
                locked_ &= ~(1U << reg_[v]);
                release(reg_[v]);
            }
        return taken();
    }

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
        }
    }

    void finish(const Line& line, int r) {
        for (const int v : line.of) drop(v);
        hold(r, line.to);
        drop(line.to);
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
        code_.compute(instruction, to, first, second);
        finish(line, to);
    }

    void unary(const Line& line, Instruction instruction, const std::optional<Memory>& mask) {
        const int x = reg_[line.of[0]], to = target(line);
        code_.compute(instruction, to, x, mask ? Operand{.memory = mask} : Operand{.reg = x});
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
                code_.copy(r, reg_[base]);
            else
                code_.load(r, memory(base));
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
            code_.compute(plus(first, by_132 ? 0 : 1), r, reg_[second], operand(third));
        } else {
            in_registers(second, third);
            code_.compute(plus(first, 2), r, reg_[second], operand(third));
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

    void in_registers(int first, int second) {
        load(first);
        load_if_useful(second);
    }

    /// Saves what a call would destroy, except for values that end in this line.
    void save_all() {
        for (const int v : holds_)
            if (v >= 0 && next(v) != never) save(v);
    }
    void after_call(auto function) {
        if (is_packed()) code_.vzeroupper();  // code of others would wait for the upper parts of registers
        code_.mov(code_.rax, reinterpret_cast<std::uintptr_t>(function));
        code_.call(code_.rax);
        for (int r = 0; r < static_cast<int>(holds_.size()); ++r)
            if (holds_[r] >= 0) release(r);
        for (int k = 0; k < saved_; ++k) code_.mov(pointer(bases[k]), code_.at({Base::rsp, 8 * k}));
    }

    void call_packed(const Line& line) {
        for (int k = 0; k < 2 && line.of[k] >= 0; ++k) {
            load(line.of[k]);
            code_.store({Base::rsp, time_ + unit_ * k}, reg_[line.of[k]]);
        }
        save_all();
        code_.mov(code_.rdi, reinterpret_cast<std::uintptr_t>(line.function));
        code_.lea(code_.rsi, code_.at({Base::rsp, time_}));
        if (line.of[1] < 0)
            after_call(l_.lanes == 8 ? each_for_code : each_of_four_for_code);
        else
            after_call(l_.lanes == 8 ? each_pair_for_code : each_pair_of_four_for_code);
        code_.load(0, {Base::rsp, time_});
        finish(line, 0);
    }

    void call(const Line& line) {
        if (is_packed()) return call_packed(line);
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

    Encoder& code_;
    std::size_t other_;
    const Lines& l_;
    std::vector<int> holds_;           // the value in each register
    std::vector<int> reg_;             // the register of each value
    std::vector<std::int32_t> slot_;   // the place on the stack of each value
    std::vector<std::int32_t> slots_;  // places that are free
    std::int32_t unit_, step_;         // the size of a value, and its distance to the next one in an array; bytes
    std::vector<int> first_, uses_, next_;
    unsigned free_ = 0, locked_ = 0;  // registers, a bit for each
    int at_ = 0;                      // the current line
    int saved_ = 0;                   // pointers that are kept on the stack
    std::int32_t time_ = 0, block_ = 0, frame_ = 0;
};

}  // namespace

bool write_function(Encoder& code, const Lines& lines, std::size_t other) {
    code.align();
    return Registering(code, lines, other).write();
}

}  // namespace alembert::machine
