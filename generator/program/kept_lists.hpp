// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Memory of a program (program.hpp): lists that never change once they stand, and a table of what is known.
///
///     KeptLists<int> lists;
///     const std::span<const int> kept = lists.keep(list);     // valid as long as `lists` or a copy of it
///
///     KnownItems known;
///     known.find(hash, [&](int item) { return list_of(item) == list; });      // an item, or −1
///     known.insert(hash, item);
///
/// A node has up to four lists, most of them of one to three items. As vectors they took half of the time in which
/// a program is made, and a map of nodes by hash an eighth.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace alembert {

/// Copies share the lists that stand, and each adds further ones in memory of its own.
template <typename T>
class KeptLists {
public:
    KeptLists() = default;
    KeptLists(const KeptLists& other) : chunks_(other.chunks_) {}
    KeptLists(KeptLists&& other) noexcept
        : chunks_(std::exchange(other.chunks_, {})),
          next_(std::exchange(other.next_, nullptr)),
          room_(std::exchange(other.room_, 0)),
          length_(other.length_) {}
    KeptLists& operator=(KeptLists other) noexcept {
        std::swap(chunks_, other.chunks_);
        std::swap(next_, other.next_);
        std::swap(room_, other.room_);
        std::swap(length_, other.length_);
        return *this;
    }
    ~KeptLists() = default;

    std::span<const T> keep(std::span<const T> list) {
        if (list.empty()) return {};
        if (list.size() > room_) {
            room_ = std::max(length_, list.size());
            length_ = std::min(2 * length_, longest);
            chunks_.push_back(std::shared_ptr<T[]>(new T[room_]));
            next_ = chunks_.back().get();
        }
        T* const first = next_;
        next_ = std::copy(list.begin(), list.end(), first);
        room_ -= list.size();
        return {first, list.size()};
    }

private:
    static constexpr std::size_t shortest = 64, longest = 8192;  // items of a chunk

    std::vector<std::shared_ptr<T[]>> chunks_;
    T* next_ = nullptr;  ///< in the last chunk
    std::size_t room_ = 0, length_ = shortest;
};

/// The numbers of items by the hash of their contents: a table with open addressing.
class KnownItems {
public:
    /// The item of this hash of which `is_same` holds; −1 if there is none.
    template <typename IsSame>
    int find(std::uint64_t hash, const IsSame& is_same) const {
        if (slots_.empty()) return -1;
        const auto mark = static_cast<std::uint32_t>(hash);
        for (std::size_t k = mark & mask();; k = (k + 1) & mask()) {
            if (slots_[k].item < 0) return -1;
            if (slots_[k].mark == mark && is_same(slots_[k].item)) return slots_[k].item;
        }
    }

    void insert(std::uint64_t hash, int item) {
        reserve(count_ + 1);
        put({static_cast<std::uint32_t>(hash), item});
        ++count_;
    }

    void reserve(std::size_t count) {
        std::size_t size = std::max<std::size_t>(slots_.size(), 16);
        while (size < 2 * count) size *= 2;
        if (size == slots_.size()) return;
        const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(size));
        for (const Slot& slot : old)
            if (slot.item >= 0) put(slot);
    }

private:
    struct Slot {
        std::uint32_t mark = 0;  ///< the lower half of the hash
        int item = -1;
    };

    std::size_t mask() const { return slots_.size() - 1; }

    void put(const Slot& slot) {
        std::size_t k = slot.mark & mask();
        while (slots_[k].item >= 0) k = (k + 1) & mask();
        slots_[k] = slot;
    }

    std::vector<Slot> slots_;  ///< as many as a power of two, at most half of them taken
    std::size_t count_ = 0;
};

}  // namespace alembert
