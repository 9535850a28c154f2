// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lists that live as long as one call, in memory on the stack as long as they are short:
///
///     ShortLists lists;
///     ShortList<int> args(lists);      // a std::vector
///     args.reserve(3);
///
/// What a list gives back is not used again; what does not fit is on the heap. (std::pmr's buffer does the same,
/// but emscripten's C++ library has none.)

#include <array>
#include <cstddef>
#include <functional>
#include <new>
#include <vector>

namespace alembert {

class ShortLists {
public:
    ShortLists() = default;
    ShortLists(const ShortLists&) = delete;
    ShortLists& operator=(const ShortLists&) = delete;

    void* take(std::size_t bytes, std::size_t alignment) {
        const std::size_t at = (used_ + alignment - 1) / alignment * alignment;
        if (at + bytes > room_.size()) return ::operator new(bytes);
        used_ = at + bytes;
        return room_.data() + at;
    }

    void give_back(void* taken) noexcept {
        const std::less<const void*> lies_before;
        if (lies_before(taken, room_.data()) || !lies_before(taken, room_.data() + room_.size()))
            ::operator delete(taken);
    }

private:
    alignas(std::max_align_t) std::array<std::byte, 1536> room_;
    std::size_t used_ = 0;
};

/// What a std::vector asks for its memory.
template <typename T>
class ShortListMemory {
public:
    using value_type = T;
    static_assert(alignof(T) <= alignof(std::max_align_t));

    ShortListMemory(ShortLists& lists) : lists_(&lists) {}
    template <typename Other>
    ShortListMemory(const ShortListMemory<Other>& other) : lists_(other.lists()) {}

    T* allocate(std::size_t count) { return static_cast<T*>(lists_->take(count * sizeof(T), alignof(T))); }
    void deallocate(T* taken, std::size_t) noexcept { lists_->give_back(taken); }

    ShortLists* lists() const { return lists_; }
    friend bool operator==(const ShortListMemory& a, const ShortListMemory& b) { return a.lists_ == b.lists_; }

private:
    ShortLists* lists_;
};

template <typename T>
using ShortList = std::vector<T, ShortListMemory<T>>;

}  // namespace alembert
