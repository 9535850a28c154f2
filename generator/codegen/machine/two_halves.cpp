// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/two_halves.hpp"

#include <array>

namespace alembert::machine {

void write_in_two_halves(Encoder& code, std::size_t body, int arrays) {
    constexpr std::array registers{Base::rdi, Base::rsi, Base::rdx, Base::rcx, Base::r8, Base::r9};
    const auto pointer = [&](int k) {
        return Xbyak::Reg64(static_cast<int>(registers[static_cast<std::size_t>(k)]));
    };
    constexpr int relative_call = 0xe8, relative_jump = 0xe9, half = 32;
    const auto go = [&](int how) {  // xbyak knows labels alone
        code.db(static_cast<std::uint8_t>(how));
        code.dd(static_cast<std::uint32_t>(body - (code.getSize() + 4)));
    };
    const int room = 8 * (arrays + 1 - arrays % 2);  // with the return address, a multiple of 16
    code.sub(code.rsp, room);
    for (int k = 0; k < arrays; ++k) code.mov(code.at({Base::rsp, 8 * k}), pointer(k));
    go(relative_call);
    for (int k = 0; k < arrays; ++k) {
        code.mov(pointer(k), code.at({Base::rsp, 8 * k}));
        code.add(pointer(k), half);
    }
    code.add(code.rsp, room);
    go(relative_jump);
}

}  // namespace alembert::machine
