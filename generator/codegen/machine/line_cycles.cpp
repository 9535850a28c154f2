// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/line_cycles.hpp"

#include <algorithm>
#include <utility>

#include "program/processor.hpp"

namespace alembert::machine {

namespace {

using processor::division, processor::function, processor::step, processor::units;

constexpr int root_latency = 18;                 ///< cycles from the argument to the value
constexpr int through_memory = 8;                ///< from a value that is stored to one that is loaded
constexpr int moving = 2;                        ///< from one place in a register to another
constexpr int busy_root = 6, busy_division = 4;  ///< cycles for which the divider takes nothing else
constexpr std::size_t lines_ahead = 100;         ///< lines among which the processor finds what can begin

/// What is busy in each cycle.
class Busy {
public:
    explicit Busy(int most) : most_(most) {}
    /// The first cycle from `start` on at which so much is free for so long; from now on it is taken.
    int take(int start, int amount, int length) {
        int begin = std::max(start, full_until_);
        for (int free = 0; free < length;) {
            reach(begin + free);
            if (taken_[static_cast<std::size_t>(begin + free)] + amount > most_)
                begin += std::exchange(free, 0) + 1;
            else
                ++free;
        }
        for (int k = begin; k < begin + length; ++k) taken_[static_cast<std::size_t>(k)] += amount;
        reach(full_until_);
        while (taken_[static_cast<std::size_t>(full_until_)] >= most_) reach(++full_until_);
        return begin;
    }

private:
    void reach(int cycle) {
        if (static_cast<std::size_t>(cycle) >= taken_.size())
            taken_.resize(2 * static_cast<std::size_t>(cycle) + 64);
    }
    int most_, full_until_ = 0;
    std::vector<int> taken_;
};

}  // namespace

int latency_of(const Line& line) {
    switch (line.kind) {
        case Line::Kind::divide:
            return division;
        case Line::Kind::root:
            return root_latency;
        case Line::Kind::call:
        case Line::Kind::sines:
            return function;
        case Line::Kind::keep:
            return through_memory;
        case Line::Kind::pair:
        case Line::Kind::join:
        case Line::Kind::repeat:
            return moving;
        default:
            return step;
    }
}

int divider_cycles(const Line& line, int numbers) {
    return (line.kind == Line::Kind::root ? busy_root : busy_division) * (numbers == 4 ? 2 : 1);
}

std::vector<int> origins_of(const Lines& lines) {
    std::vector<int> origin(lines.homes.size(), -1), writer(static_cast<std::size_t>(lines.block), -1);
    for (int k = 0; const Line& line : lines.list) {
        if (line.to >= 0) origin[static_cast<std::size_t>(line.to)] = k;
        const auto writes = [&](int place, int count) { std::fill_n(writer.begin() + place, count, k); };
        if (line.kind == Line::Kind::keep)
            writes(line.place, lines.homes[static_cast<std::size_t>(line.of[0])].numbers);
        if (line.kind == Line::Kind::sines) {
            const SineGroup& group = lines.groups[static_cast<std::size_t>(line.place)];
            writes(group.place, 3 * group.size);
        }
        ++k;
    }
    for (std::size_t v = 0; v < origin.size(); ++v)
        if (lines.homes[v].kind == Home::Kind::block)
            origin[v] = writer[static_cast<std::size_t>(lines.homes[v].place)];
    return origin;
}

namespace {

/// What of the processor a line takes.
class Processor {
public:
    explicit Processor(const Lines& lines) : l_(lines) {}

    /// The first cycle from `start` on at which it can begin; `back`: where time runs backwards, at which it has
    /// begun.
    int take(const Line& line, int start, bool back = false) {
        const int value = line.to >= 0 ? line.to : line.of[0];
        const int numbers = value >= 0 ? l_.homes[static_cast<std::size_t>(value)].numbers : 1;
        const int times = numbers == 4 ? 2 : 1;
        const auto on = [&](Busy& unit, int amount, int length) {
            return back ? unit.take(start - length, amount, length) + length : unit.take(start, amount, length);
        };
        switch (line.kind) {
            case Line::Kind::root:
            case Line::Kind::divide:
                return on(divider_, 1, divider_cycles(line, numbers));
            case Line::Kind::store:
            case Line::Kind::keep:
                return on(memory_, 1, times);
            case Line::Kind::pair:
            case Line::Kind::join:
            case Line::Kind::repeat:
                return on(units_, 1, 1);
            default:
                return on(units_, times, 1);
        }
    }

private:
    const Lines& l_;
    Busy units_{units}, divider_{1}, memory_{1};
};

/// The values that a line uses.
void each_value(const Lines& lines, const Line& line, const auto& use) {
    for (const int v : line.of)
        if (v >= 0) use(static_cast<std::size_t>(v));
    if (line.kind == Line::Kind::sines)
        for (const int v : lines.groups[static_cast<std::size_t>(line.place)].angles)
            use(static_cast<std::size_t>(v));
}

}  // namespace

int cycles_of(const Lines& lines) {
    const std::vector<int> origin = origins_of(lines);
    Processor processor(lines);
    std::vector<int> ready, retired;
    for (const Line& line : lines.list) {
        int start = retired.size() < lines_ahead ? 0 : retired[retired.size() - lines_ahead];
        each_value(lines, line, [&](std::size_t v) {
            if (origin[v] >= 0) start = std::max(start, ready[static_cast<std::size_t>(origin[v])]);
        });
        ready.push_back(processor.take(line, start) + latency_of(line));
        retired.push_back(std::max(retired.empty() ? 0 : retired.back(), ready.back()));
    }
    return retired.empty() ? 0 : retired.back();
}

std::vector<Line> as_late_as_possible(const Lines& lines) {
    const std::vector<int> origin = origins_of(lines);
    const auto count = lines.list.size();
    Processor processor(lines);
    std::vector<int> rest(count, 0), to_end(count, 0), order(count);  // from the start of a line to the end
    for (std::size_t k = count; k-- > 0;) {
        const Line& line = lines.list[k];
        to_end[k] = processor.take(line, rest[k] + latency_of(line), true);
        each_value(lines, line, [&](std::size_t v) {
            if (origin[v] < 0) return;
            int& before = rest[static_cast<std::size_t>(origin[v])];
            before = std::max(before, to_end[k]);
        });
        order[k] = static_cast<int>(k);
    }
    // What is stored need not wait.
    for (std::size_t k = 0; k < count; ++k) {
        const Line& line = lines.list[k];
        if (line.kind != Line::Kind::store && line.kind != Line::Kind::keep) continue;
        const int from = origin[static_cast<std::size_t>(line.of[0])];
        if (from >= 0) to_end[k] = to_end[static_cast<std::size_t>(from)];
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return to_end[static_cast<std::size_t>(a)] > to_end[static_cast<std::size_t>(b)];
    });
    std::vector<Line> result;
    for (const int k : order) result.push_back(lines.list[static_cast<std::size_t>(k)]);
    return result;
}

}  // namespace alembert::machine
