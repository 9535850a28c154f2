// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/memory_code.hpp"

#include <utility>

#include "alembert/native/executable.hpp"
#include "codegen/machine/registers.hpp"
#include "codegen/machine/side_by_side.hpp"
#include "codegen/machine/two_halves.hpp"

namespace alembert::machine {

struct MemoryCode::Parts {
    Encoder code;
    bool is_possible = true;
    std::vector<std::pair<std::size_t, Put>> functions = {};

    std::size_t begin() {
        code.align();
        return code.getSize();
    }
};

MemoryCode::MemoryCode(int lanes, int registers) : parts_(new Parts{.code = Encoder(lanes, registers)}) {}
MemoryCode::~MemoryCode() = default;

int MemoryCode::lanes() const {
    return parts_->code.lanes();
}

std::size_t MemoryCode::write_aside(const Lines& lines) {
    const std::size_t begin = parts_->begin();
    parts_->is_possible = parts_->is_possible && write_function(parts_->code, lines);
    return begin;
}

void MemoryCode::write(const Lines& lines, std::size_t other, Put put) {
    std::size_t begin = parts_->begin();
    parts_->is_possible = parts_->is_possible && write_function(parts_->code, side_by_side(lines), other);
    if (lines.lanes == 4) {
        const std::size_t body = std::exchange(begin, parts_->begin());
        write_in_two_halves(parts_->code, body, lines.arrays + (lines.takes_time ? 1 : 0));
    }
    parts_->functions.emplace_back(begin, std::move(put));
}

void MemoryCode::write_call(const void* function, const void* last, Put put) {
    parts_->functions.emplace_back(parts_->begin(), std::move(put));
    Encoder& code = parts_->code;
    code.mov(code.r9, reinterpret_cast<std::uintptr_t>(last));
    code.mov(code.rax, reinterpret_cast<std::uintptr_t>(function));
    code.jmp(code.rax);
}

std::shared_ptr<const void> MemoryCode::placed() {
    if (!parts_->is_possible) return nullptr;
    const std::shared_ptr<const std::uint8_t> memory = executable(parts_->code.finished());
    if (memory)
        for (const auto& [begin, put] : parts_->functions)
            put(reinterpret_cast<std::uintptr_t>(memory.get()) + begin);
    return memory;
}

}  // namespace alembert::machine
