// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which value is in which register, or in which place on the stack, while the lines of a function are written.
///
///     load(v);                          // reg_[v] is a register now
///     const int to = target(line);      // a register for the result
///     …
///     finish(line, to);
///
/// In straight-line code the next use of every value is known. When a register is needed, the value goes whose
/// next use lies furthest ahead, which takes the fewest loads (Belady, A study of replacement algorithms for a
/// virtual-storage computer, IBM Systems Journal 5, 1966). A value without a home is stored on the stack first.

#include <algorithm>
#include <array>
#include <bit>

#include "codegen/machine/encoder.hpp"
#include "codegen/machine/lines.hpp"
#include "codegen/machine/next_uses.hpp"

namespace alembert::machine {

class RegisterFile {
protected:
    static constexpr int never = NextUses::never;
    static constexpr std::array bases{Base::rdi, Base::rsi, Base::rdx, Base::rcx, Base::r8, Base::r9};

    RegisterFile(Encoder& code, const Lines& lines)
        : code_(code),
          l_(lines),
          holds_(static_cast<std::size_t>(code.registers()), -1),
          reg_(lines.homes.size(), -1),
          unit_(8 * lines.lanes),
          step_(lines.lanes > 1 ? pack_size : 8),
          uses_(lines),
          slot_(lines.homes.size(), -1) {
        free_ = holds_.size() == 32 ? ~0U : 0xffffU;
        const bool calls = std::any_of(l_.list.begin(), l_.list.end(), [](const Line& line) {
            return line.kind == Line::Kind::call || line.kind == Line::Kind::sines;
        });
        has_fours_ = is_packed() || std::any_of(l_.homes.begin(), l_.homes.end(),
                                                [](const Home& home) { return home.numbers == 4; });
        saved_ = calls ? l_.arrays + first_array() : 0;
        const auto in_units = [&](std::int32_t bytes) { return (bytes + unit_ - 1) / unit_ * unit_; };
        time_ = in_units(8 * saved_);
        const bool of_three = std::any_of(l_.list.begin(), l_.list.end(), [](const Line& line) {
            return line.kind == Line::Kind::call && line.of[2] >= 0;
        });
        block_ = time_ + (is_packed() ? (of_three ? 3 : 2) * unit_ : 8);  // packed: for the arguments of a call
        if (!is_packed() && has_fours_) block_ = (block_ + 15) / 16 * 16;
        frame_ = block_ + unit_ * l_.block;
    }

    bool is_packed() const { return l_.lanes > 1; }
    /// Packs are given a pointer to their times, before the arrays.
    int first_array() const { return is_packed() && l_.takes_time ? 1 : 0; }
    Base base(int array) const { return bases[static_cast<std::size_t>(array + first_array())]; }

    int next(int v) { return uses_.next(v, at_); }
    /// How many numbers a register holds that has this value.
    int numbers(int v) const { return l_.lanes * l_.homes[v].numbers; }

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
            case Home::Kind::block:
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
        std::vector<std::int32_t>& free = free_slots(v);
        if (free.empty()) {
            slot_[v] = frame_;
            frame_ += 8 * numbers(v);
        } else {
            slot_[v] = free.back();
            free.pop_back();
        }
        code_.store({Base::rsp, slot_[v]}, reg_[v], numbers(v));
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
            code_.load(r, memory(v), numbers(v));
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
            free_slots(v).push_back(slot_[v]);
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

    void finish(const Line& line, int r) {
        for (const int v : line.of) drop(v);
        hold(r, line.to);
        drop(line.to);
    }

    void in_registers(int first, int second) {
        load(first);
        load_if_useful(second);
    }

    Encoder& code_;
    const Lines& l_;
    std::vector<int> holds_;          ///< the value in each register
    std::vector<int> reg_;            ///< the register of each value
    std::int32_t unit_, step_;        ///< the size of a number, and its distance to the next in an array; bytes
    bool has_fours_ = false;          ///< whether registers of four numbers or more are used
    int at_ = 0;                      ///< the current line
    int saved_ = 0;                   ///< pointers that are kept on the stack
    unsigned free_ = 0, locked_ = 0;  ///< registers, a bit for each
    std::int32_t time_ = 0, block_ = 0, frame_ = 0;

private:
    static constexpr int soon =
        200;  ///< lines; a value that is used again so soon is loaded if a register is free
    static constexpr std::int32_t pack_size = 64;  ///< in bytes, of a value in the arrays of eight systems

    std::vector<std::int32_t>& free_slots(int v) {
        return slots_[std::bit_width(static_cast<unsigned>(l_.homes[v].numbers)) - 1];
    }

    NextUses uses_;
    std::vector<std::int32_t> slot_;                  // the place on the stack of each value
    std::array<std::vector<std::int32_t>, 3> slots_;  // places that are free, for one, two and four numbers
};

}  // namespace alembert::machine
