// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/register_order.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "program/processor.hpp"

namespace alembert {

namespace {

using processor::registers;

/// Cycles in which a statement keeps one of the units busy.
double occupied(const Computation& statement) {
    return std::max(1.0, processor::fused * statement.operations) / processor::units;
}

/// The depth-first order from the results, arguments that take longest first.
std::vector<int> depth_first(const std::vector<Computation>& statements,
                             const std::vector<std::vector<int>>& users) {
    std::vector<int> depth, place(statements.size(), -1);
    for (const Computation& s : statements) {
        int before = 0;
        for (const int need : s.needs) before = std::max(before, depth[need]);
        depth.push_back(before + s.latency);
    }
    int taken = 0;
    std::vector<int> stack;
    for (int end = 0; end < static_cast<int>(statements.size()); ++end) {
        if (!users[end].empty()) continue;
        stack.push_back(end);
        while (!stack.empty()) {
            const int id = stack.back();
            int deepest = -1;
            for (const int need : statements[id].needs)
                if (place[need] < 0 && (deepest < 0 || depth[need] > depth[deepest])) deepest = need;
            if (place[id] < 0 && deepest >= 0) {
                stack.push_back(deepest);
                continue;
            }
            if (place[id] < 0) place[id] = taken++;
            stack.pop_back();
        }
    }
    return place;
}

}  // namespace

std::vector<int> register_order(const std::vector<Computation>& statements) {
    const auto count = statements.size();
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::vector<std::vector<int>> users(count);
    for (std::size_t id = 0; id < count; ++id)
        for (const int need : statements[id].needs) users[need].push_back(static_cast<int>(id));
    std::vector<int> tail(count, 0);
    double work = 0, chain = 0;
    for (std::size_t id = count; id-- > 0;) {
        for (const int user : users[id]) tail[id] = std::max(tail[id], tail[user] + statements[user].latency);
        chain = std::max(chain, static_cast<double>(tail[id] + statements[id].latency));
        work += occupied(statements[id]);
    }
    if (work < chain || count > processor::most_ordered) return order;

    const std::vector<int> place = depth_first(statements, users);
    std::vector<int> waits, uses, free;
    std::vector<int> ends(count, 0);  // values that a statement is the last one to use
    std::vector<double> at(count, 0);
    for (std::size_t id = 0; id < count; ++id) {
        waits.push_back(static_cast<int>(statements[id].needs.size()));
        uses.push_back(static_cast<int>(users[id].size()));
        if (waits.back() == 0) free.push_back(static_cast<int>(id));
        if (uses.back() == 1) ++ends[static_cast<std::size_t>(users[id][0])];
    }
    std::vector<char> is_done(count, 0);
    const auto last_use_is_left = [&](int need) {
        for (const int user : users[need])
            if (is_done[user] == 0) ++ends[user];
    };
    order.clear();
    double cycle = 0;
    for (int live = 0; !free.empty();) {
        const auto roomy = [&](int a, int b) {
            return std::make_tuple(at[a] > cycle, -tail[a], a) < std::make_tuple(at[b] > cycle, -tail[b], b);
        };
        const auto frees = [&](int id) { return ends[id] > 0 || uses[id] == 0; };
        const auto key = [&](int id) {
            return std::make_tuple(!frees(id), at[id] > cycle + processor::look_ahead, place[id]);
        };
        const auto tight = [&](int a, int b) { return key(a) < key(b); };
        auto best = live < registers ? std::min_element(free.begin(), free.end(), roomy)
                                     : std::min_element(free.begin(), free.end(), tight);
        if (live < registers && at[*best] > cycle) {
            cycle = at[*std::min_element(free.begin(), free.end(), [&](int a, int b) { return at[a] < at[b]; })];
            best = std::min_element(free.begin(), free.end(), roomy);
        }
        const int id = *best;
        free.erase(best);
        order.push_back(id);
        is_done[id] = 1;
        for (const int need : statements[id].needs) {
            if (--uses[need] == 0) --live;
            if (uses[need] == 1) last_use_is_left(need);
        }
        if (uses[id] > 0) ++live;
        const double start = std::max(cycle, at[id]);
        for (const int user : users[id]) {
            at[user] = std::max(at[user], start + statements[id].latency);
            if (--waits[user] == 0) free.push_back(user);
        }
        cycle += occupied(statements[id]);
    }
    return order;
}

}  // namespace alembert
