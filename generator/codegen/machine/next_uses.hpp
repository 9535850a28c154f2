// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The next line that uses a value, while the lines of a function are gone through from the first to the last.
///
///     NextUses uses(lines);
///     uses.next(v, k);        // the first line after line k that uses the value, or NextUses::never

#include <limits>
#include <vector>

#include "codegen/machine/lines.hpp"

namespace alembert::machine {

class NextUses {
public:
    static constexpr int never = std::numeric_limits<int>::max();

    explicit NextUses(const Lines& lines) : first_(lines.homes.size() + 1, 0) {
        const auto each = [&](const auto& use) {
            for (int k = 0; k < static_cast<int>(lines.list.size()); ++k) {
                const Line& line = lines.list[k];
                if (line.kind == Line::Kind::sines)
                    for (const int v : lines.groups[line.place].angles) use(v, k);
                for (const int v : line.of)
                    if (v >= 0) use(v, k);
            }
            if (lines.largest >= 0) use(lines.largest, static_cast<int>(lines.list.size()));
        };
        each([&](int v, int) { ++first_[v + 1]; });
        for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
        uses_.resize(static_cast<std::size_t>(first_.back()));
        next_ = first_;
        each([&](int v, int line) { uses_[next_[v]++] = line; });
        next_ = first_;
    }

    int next(int v, int line) {
        int& place = next_[v];
        while (place < first_[v + 1] && uses_[place] <= line) ++place;
        return place < first_[v + 1] ? uses_[place] : never;
    }

private:
    std::vector<int> first_, uses_, next_;
};

}  // namespace alembert::machine
