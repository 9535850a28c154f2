// SPDX-License-Identifier: MIT
#include "allocations.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> allocations = 0;

}  // namespace

// They replace those of the whole program; the other forms of `new` and `delete` call these.
void* operator new(std::size_t size) {
    ++allocations;
    if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace alembert::test {

std::size_t allocations_of(const std::function<void()>& work) {
    const std::size_t before = allocations;
    work();
    return allocations - before;
}

}  // namespace alembert::test
