// SPDX-License-Identifier: GPL-2.0-or-later
// Code in memory where the program itself is WebAssembly: the engine that runs it compiles a module beside it,
// which shares its memory and its table of functions.
#include <emscripten.h>

#include <cmath>

#include "codegen/machine/memory_code.hpp"
#include "codegen/machine/web_assembly.hpp"

// The place of the first of `count` functions in the table; 0 if the engine refuses them.
EM_JS(int, alembert_add_module, (const std::uint8_t* bytes, int size, int count), {
    try {
        const module = new WebAssembly.Module(HEAPU8.slice(bytes, bytes + size));
        const instance = new WebAssembly.Instance(module, {e : {m : wasmMemory, t : wasmTable}});
        const first = wasmTable.grow(count);
        for (let k = 0; k < count; ++k) wasmTable.set(first + k, instance.exports[k]);
        return first;
    } catch (refused) {
        return 0;
    }
});

EM_JS(void, alembert_remove_functions, (int first, int count), {
    for (let k = first; k < first + count; ++k) wasmTable.set(k, null);
});

namespace alembert::machine {

namespace {

/// Angles, then sines from the place `distance` on, and cosines from twice that.
void sines_of(double* angles, int distance, int count) {
    for (int k = 0; k < count; ++k) {
        angles[distance + k] = std::sin(angles[k]);
        angles[2 * distance + k] = std::cos(angles[k]);
    }
}

std::uint32_t number_of(const void* pointer) {
    return reinterpret_cast<std::uintptr_t>(pointer);
}

/// Functions in the table, which is as long as it was at its longest, and the memory that they use.
struct InTable {
    InTable(int at, int size, std::shared_ptr<const void> memory)
        : first(at), count(size), used(std::move(memory)) {}
    InTable(const InTable&) = delete;
    InTable& operator=(const InTable&) = delete;
    ~InTable() { alembert_remove_functions(first, count); }
    int first, count;
    std::shared_ptr<const void> used;
};

constexpr std::size_t longest_block = 1 << 14;  // of sines, in numbers

}  // namespace

struct MemoryCode::Parts {
    std::shared_ptr<std::vector<double>> block = std::make_shared<std::vector<double>>(longest_block);
    ModuleOfLines module{{.block = number_of(block->data()),
                          .sines = number_of(reinterpret_cast<const void*>(sines_of)),
                          .place_of = number_of}};
    bool is_possible = true;
    std::vector<Put> puts = {};
};

MemoryCode::MemoryCode(int, int) : parts_(new Parts) {}
MemoryCode::~MemoryCode() = default;

std::size_t MemoryCode::write_aside(const Lines&) {
    return 0;
}

void MemoryCode::write(const Lines& lines, std::size_t, Put put) {
    Parts& p = *parts_;
    p.is_possible = p.is_possible && lines.block <= static_cast<int>(longest_block) && p.module.add(lines);
    p.puts.push_back(std::move(put));
}

void MemoryCode::write_call(const void* function, const void* last, Put put) {
    parts_->module.add_call(number_of(function), number_of(last));
    parts_->puts.push_back(std::move(put));
}

std::shared_ptr<const void> MemoryCode::placed() {
    if (!parts_->is_possible) return nullptr;
    const std::vector<std::uint8_t> bytes = parts_->module.bytes();
    const int count = parts_->module.size();
    const int first = alembert_add_module(bytes.data(), static_cast<int>(bytes.size()), count);
    if (first == 0) return nullptr;
    for (int k = 0; k < count; ++k)
        parts_->puts[static_cast<std::size_t>(k)](static_cast<std::uintptr_t>(first + k));
    return std::make_shared<const InTable>(first, count, parts_->block);
}

bool can_run(int lanes) {
    return lanes == 1;
}

int registers_of_processor() {
    return 16;
}

}  // namespace alembert::machine
