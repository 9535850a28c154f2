// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A map from nodes of a program, found by their numbers, and in their order:
///
///     NodeMap<std::string> names;
///     names[id] = "z0";
///     if (const auto known = names.find(id); known != names.end()) known->second;
///     for (const auto& [id, name] : names) …
///
/// References stay valid while nodes are added.

#include <deque>
#include <map>
#include <utility>
#include <vector>

namespace alembert {

template <typename T>
class NodeMap {
public:
    using Item = std::pair<int, T>;

    NodeMap() = default;
    explicit NodeMap(const std::map<int, T>& items) {
        for (const auto& [id, value] : items) emplace(id, value);
    }

    template <typename Map, typename Value>
    class Iterator {
    public:
        Iterator(Map* map, std::size_t id) : map_(map), id_(id) { pass(); }
        Value& operator*() const { return map_->items_[static_cast<std::size_t>(map_->place_[id_])]; }
        Value* operator->() const { return &**this; }
        Iterator& operator++() {
            ++id_;
            pass();
            return *this;
        }
        bool operator==(const Iterator& o) const { return id_ == o.id_; }

    private:
        void pass() {
            while (id_ < map_->place_.size() && map_->place_[id_] < 0) ++id_;
        }
        Map* map_;
        std::size_t id_;
    };
    using iterator = Iterator<NodeMap, Item>;
    using const_iterator = Iterator<const NodeMap, const Item>;

    iterator begin() { return {this, 0}; }
    iterator end() { return {this, place_.size()}; }
    const_iterator begin() const { return {this, 0}; }
    const_iterator end() const { return {this, place_.size()}; }

    bool contains(int id) const {
        return static_cast<std::size_t>(id) < place_.size() && place_[static_cast<std::size_t>(id)] >= 0;
    }
    iterator find(int id) { return {this, contains(id) ? static_cast<std::size_t>(id) : place_.size()}; }
    const_iterator find(int id) const {
        return {this, contains(id) ? static_cast<std::size_t>(id) : place_.size()};
    }

    /// The value of the node; `otherwise` is added if it has none.
    T& emplace(int id, T otherwise) {
        const auto k = static_cast<std::size_t>(id);
        if (k >= place_.size()) place_.resize(k + k / 2 + 16, -1);
        if (place_[k] < 0) {
            place_[k] = static_cast<int>(items_.size());
            items_.emplace_back(id, std::move(otherwise));
        }
        return items_[static_cast<std::size_t>(place_[k])].second;
    }
    T& operator[](int id) { return emplace(id, T()); }
    std::size_t size() const { return items_.size(); }

private:
    std::vector<int> place_;  ///< of each node, in `items_`; −1 if it has no value
    std::deque<Item> items_;
};

}  // namespace alembert
