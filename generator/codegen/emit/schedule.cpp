// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/schedule.hpp"

#include <algorithm>
#include <queue>
#include <tuple>

#include "program/processor.hpp"

namespace alembert {

namespace {

using processor::division, processor::function, processor::step, processor::units;

int latency(const Node& node) {
    if (node.is_reciprocal()) return division;
    return node.op == Op::sum || node.op == Op::product ? step : function;
}

/// The number of instructions. A product that is added nearly always costs none of its own.
int instructions(const Node& node) {
    if (node.op == Op::sum)
        return std::max(1, static_cast<int>(node.args.size()) - (cln::zerop(node.number) ? 1 : 0));
    if (node.op == Op::product) return std::max(1, static_cast<int>(node.args.size()) - 1);
    return 1;
}

}  // namespace

std::vector<int> scheduled(const Program& program, const Readiness& ready, std::span<const int> roots,
                           const std::function<bool(int)>& is_done) {
    std::vector<int> nodes;
    for (const int id : program.needed(roots))
        if (!is_done(id)) nodes.push_back(id);
    const auto count = static_cast<std::size_t>(program.size());
    std::vector<char> is_ours(count, 0);
    for (const int id : nodes) is_ours[id] = 1;

    std::vector<int> tail(count, 0), waits(count, 0), at(count, 0);
    std::vector<std::vector<int>> users(count);
    for (auto id = nodes.rbegin(); id != nodes.rend(); ++id) {
        const Node& node = program[*id];
        for (const int arg : node.args) {
            tail[arg] = std::max(tail[arg], tail[*id] + latency(node));
            if (!is_ours[arg]) {
                at[*id] = std::max(at[*id], ready[arg]);
                continue;
            }
            users[arg].push_back(*id);
            ++waits[*id];
        }
    }
    using Waiting = std::tuple<int, int>;  // time, node
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> later;
    const auto less_urgent = [&](int a, int b) { return std::tie(tail[a], b) < std::tie(tail[b], a); };
    std::priority_queue<int, std::vector<int>, decltype(less_urgent)> now(less_urgent);
    for (const int id : nodes)
        if (waits[id] == 0) later.emplace(at[id], id);

    std::vector<int> order;
    for (int cycle = 0, room = units; !later.empty() || !now.empty();) {
        while (!later.empty() && std::get<0>(later.top()) <= cycle) {
            now.push(std::get<1>(later.top()));
            later.pop();
        }
        if (now.empty() || room <= 0) {
            if (now.empty()) cycle = std::max(cycle, std::get<0>(later.top()) - 1);
            ++cycle;
            room = std::min(room, 0) + units;
            continue;
        }
        const int id = now.top();
        now.pop();
        order.push_back(id);
        room -= instructions(program[id]);
        for (const int user : users[id]) {
            at[user] = std::max(at[user], cycle + latency(program[id]));
            if (--waits[user] == 0) later.emplace(at[user], user);
        }
    }
    return order;
}

}  // namespace alembert
