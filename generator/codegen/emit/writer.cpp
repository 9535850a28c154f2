// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/writer.hpp"

#include <cln/float.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>

#include "codegen/emit/numbers.hpp"
#include "codegen/emit/register_order.hpp"
#include "codegen/emit/schedule.hpp"
#include "program/processor.hpp"

namespace alembert {

namespace {

constexpr std::size_t readable_statements = 60;  // with more statements, speed is more important than sections
constexpr int widest_expression = 10;            // the most operations in one statement, so that it can be read

bool is_negation(const Node& node) {
    return node.is_scaled() && cln::equal(node.coefficients[0], -1);
}

}  // namespace

bool Writer::is_simple(int id) const {
    const Node& node = program_[id];
    return is_leaf(id) || node.is_number() || node.op == Op::pi || (is_negation(node) && is_leaf(node.args[0]));
}

void Writer::count_uses(const std::vector<Goal>& goals) {
    std::vector<int> stack;
    const auto use = [&](int node, int times) {
        int& count = uses_[node];
        if (count == 0) stack.push_back(node);
        count += times;
    };
    for (const Goal& goal : goals)
        if (goal.is_computed) use(goal.node, 1);
    while (!stack.empty()) {
        const int id = stack.back();
        stack.pop_back();
        if (is_leaf(id)) continue;
        const Node& node = program_[id];
        for (std::size_t k = 0; k < node.args.size(); ++k)
            use(node.args[k], node.exponents.empty() ? 1 : std::abs(node.exponents[k]));
    }
}

/// Nodes inside a long statement get statements of their own, the longest first, until the rest fits on a line.
void Writer::shorten(int id, NodeMap<int>& length) {
    const Node& node = program_[id];
    int& operations = length[id];
    for (const int arg : node.args) operations += 1 + (wanted_.contains(arg) ? 0 : length[arg]);
    while (operations > widest_expression) {
        int longest = -1;
        for (const int arg : node.args)
            if (!wanted_.contains(arg) && length[arg] > 0 && (longest < 0 || length[arg] > length[longest]))
                longest = arg;
        if (longest < 0) break;
        wanted_.emplace(longest, "");
        operations -= length[longest];
    }
}

void Writer::choose_statements(const std::vector<Goal>& goals) {
    NodeMap<int> length;  // operations that are written in place, by node
    for (const auto& [id, count] : uses_) {
        if (is_simple(id)) continue;
        shorten(id, length);
        if ((count > 1 && !is_negation(program_[id])) || is_trigonometric(program_[id])) wanted_.emplace(id, "");
    }
    // An argument of sin or cos that is more than a name gets one: phi0.
    for (const auto& [id, count] : uses_) {
        const Node& node = program_[id];
        if (!is_trigonometric(node) || is_leaf(id)) continue;
        if (!is_simple(node.args[0])) wanted_.emplace(node.args[0], "");
        auto& [sine, cosine] = sines_.try_emplace(node.args[0], -1, -1).first->second;
        (node.op == Op::sin ? sine : cosine) = id;
    }
    for (const Goal& goal : goals) {
        if (!goal.is_computed || is_simple(goal.node) || goal.name.empty() ||
            is_trigonometric(program_[goal.node]))
            continue;
        std::string& wish = wanted_[goal.node];
        if (goal.is_negative) {
            if (wish.empty()) wanted_negatives_.emplace(goal.node, goal.name);
            continue;
        }
        if (wish.empty()) wish = goal.name;
        if (goal.own_name) promised_.emplace(goal.node, goal.name);
    }
    std::erase_if(wanted_negatives_, [&](const auto& item) { return !wanted_[item.first].empty(); });
}

std::vector<Passage> Writer::write(const std::vector<Goal>& goals) {
    leaves_ = named_;
    std::vector<int> nodes;
    for (const Goal& goal : goals)
        if (goal.is_computed) nodes.push_back(goal.node);
    ready_.emplace(program_, nodes);
    count_uses(goals);
    choose_statements(goals);
    const Sections sections = sections_of(goals);
    const bool is_long = ready_->is_ordered() && wanted_.size() > readable_statements;
    std::vector<Passage> passages = is_long ? in_order_of_time(sections, nodes) : in_sections(sections);
    add_notes(passages, goals);
    std::erase_if(passages,
                  [](const Passage& passage) { return passage.statements.empty() && passage.notes.empty(); });
    return passages;
}

/// A node that only the last section ("solve") and one other section need belongs to the other one. No node comes
/// after its users.
Writer::Sections Writer::sections_of(const std::vector<Goal>& goals) const {
    Sections sections{.titles = {"Trigonometry", "Shared terms"}, .place = {}};
    auto& [titles, place] = sections;
    NodeMap<unsigned> needed_by;  // one bit for each of the goals' sections, in their order
    std::map<std::string, std::vector<int>> roots_of;
    for (const Goal& goal : goals) {
        if (std::find(titles.begin(), titles.end(), goal.section) == titles.end()) titles.push_back(goal.section);
        if (goal.is_computed) roots_of[goal.section].push_back(goal.node);
    }
    for (std::size_t s = titles.size(); s-- > 2;)
        for (const int id : program_.needed(roots_of[titles[s]])) needed_by[id] |= 1U << s;
    std::vector<int> trigonometric;
    for (const auto& [id, count] : uses_)
        if (is_trigonometric(program_[id]) && !is_leaf(id)) trigonometric.push_back(id);
    for (const int id : program_.needed(trigonometric)) needed_by[id] |= 1U;

    const unsigned last = titles.size() > 3 ? 1U << (titles.size() - 1) : 0U;
    for (const auto& [id, count] : uses_) {
        const unsigned bits = needed_by[id];
        const unsigned own = (bits & ~last) != 0 ? bits & ~last : bits;
        std::size_t s = 0;
        while (s < titles.size() && (own >> s) != 1U) ++s;
        place[id] = (bits & 1U) != 0 ? 0 : (own & (own - 1)) != 0 ? 1 : s;
    }
    for (std::size_t s = 2; s < titles.size(); ++s)
        for (const int id : roots_of[titles[s]])
            if (place[id] != 0) place[id] = s;
    for (int id = program_.size() - 1; id >= 0; --id)
        if (const auto user = place.find(id); user != place.end())
            for (const int arg : program_[id].args)
                if (const auto it = place.find(arg); it != place.end())
                    it->second = std::min(it->second, user->second);
    return sections;
}

std::vector<Passage> Writer::in_sections(const Sections& sections) {
    std::vector<Passage> passages;
    std::vector<int> first;
    for (const auto& [id, wish] : wanted_)
        if (sections.of(id) == 0 && !named_.contains(id)) first.push_back(id);
    passages.push_back({.title = sections.titles[0], .statements = trigonometry(first)});
    for (std::size_t s = 1; s < sections.titles.size(); ++s) {
        passages.push_back({.title = sections.titles[s]});
        for (const auto& [id, wish] : wanted_)
            if (sections.of(id) == s && !named_.contains(id)) passages.back().statements.push_back(statement(id));
    }
    return passages;
}

std::vector<Passage> Writer::in_order_of_time(const Sections& sections, const std::vector<int>& nodes) {
    std::vector<int> first, statements;
    for (const auto& [id, wish] : wanted_)
        if (sections.of(id) == 0 && !named_.contains(id)) first.push_back(id);
    std::vector<Passage> passages{{.title = sections.titles[0], .statements = trigonometry(first)},
                                  {.title = "All else, each value soon after those that it is made of"}};
    const auto is_done = [&](int node) {
        return sections.of(node) == 0 || is_leaf(node) || named_.contains(node);
    };
    const bool in_parts = wanted_.size() > longest_whole_;
    for (const int id : in_parts ? depth_first(nodes, is_done) : scheduled(program_, *ready_, nodes, is_done))
        if (wanted_.contains(id) && !named_.contains(id)) statements.push_back(id);
    if (!in_parts) statements = in_registers(statements);
    for (const int id : statements) passages[1].statements.push_back(statement(id));
    return passages;
}

/// The nodes that the roots need, those of the first root first, each soon before the first of its users. Of a
/// large Jacobian, with rows as roots, parts of 400 statements exchange a fifth of the values that they exchange
/// in the order of urgency.
std::vector<int> Writer::depth_first(const std::vector<int>& roots,
                                     const std::function<bool(int)>& is_done) const {
    std::vector<int> order;
    std::vector<char> is_met(static_cast<std::size_t>(program_.size()), 0);
    std::vector<std::pair<int, std::size_t>> stack;  // a node, and how many of its arguments have been entered
    const auto enter = [&](int id) {
        if (std::exchange(is_met[static_cast<std::size_t>(id)], 1) == 0 && !is_done(id)) stack.emplace_back(id, 0);
    };
    for (const int root : roots) {
        enter(root);
        while (!stack.empty()) {
            auto& [id, entered] = stack.back();
            const std::span<const int> args = program_[id].args;
            if (entered < args.size()) {
                enter(args[entered++]);
                continue;
            }
            order.push_back(id);
            stack.pop_back();
        }
    }
    return order;
}

/// Adds notes for goals that are a number or a parameter, or whose value has another name.
void Writer::add_notes(std::vector<Passage>& passages, const std::vector<Goal>& goals) {
    const auto is_known = [&](int id) { return is_simple(id) || named_.contains(id) || negatives_.contains(id); };
    for (const Goal& goal : goals) {
        if (!goal.is_noted ||
            !(is_known(goal.node) || (program_[goal.node].is_scaled() && is_known(program_[goal.node].args[0]))))
            continue;
        if (const auto negative = negatives_.find(goal.node); goal.is_negative && negative != negatives_.end())
            continue;
        const Node& node = program_[goal.node];
        const std::string value = node.is_number()   ? shortest(cln::double_approx(node.number))
                                  : goal.is_negative ? "-" + text(goal.node, multiplicative)
                                                     : text(goal.node, additive);
        if (value == goal.name) continue;
        const auto same = [&](const Passage& passage) { return passage.title == goal.section; };
        const auto passage = std::find_if(passages.begin(), passages.end(), same);
        (passage != passages.end() ? *passage : passages.back())
            .notes.push_back(fmt::format("{} = {}", goal.name, value));
    }
    reading_.clear();
    operations_ = 0;
}

/// Orders statements for the registers; each includes the nodes that are written in place.
std::vector<int> Writer::in_registers(const std::vector<int>& nodes) const {
    NodeMap<int> position;
    for (std::size_t k = 0; k < nodes.size(); ++k) position.emplace(nodes[k], static_cast<int>(k));
    std::vector<Computation> statements;
    for (const int id : nodes) {
        Computation made{.needs = {}, .operations = 0, .latency = 0};
        std::vector<int> stack{id};
        while (!stack.empty()) {
            const Node& node = program_[stack.back()];
            stack.pop_back();
            made.operations += std::max(1, static_cast<int>(node.args.size()) - 1);
            if (node.is_reciprocal()) made.latency += processor::division;
            for (const int arg : node.args)
                if (const auto known = position.find(arg); known != position.end())
                    made.needs.push_back(known->second);
                else if (!is_leaf(arg) && !named_.contains(arg) && !program_[arg].args.empty())
                    stack.push_back(arg);
        }
        std::sort(made.needs.begin(), made.needs.end());
        made.needs.erase(std::unique(made.needs.begin(), made.needs.end()), made.needs.end());
        made.latency += processor::step * std::min(processor::most_steps, made.operations);
        statements.push_back(std::move(made));
    }
    std::vector<int> result;
    for (const int k : register_order(statements)) result.push_back(nodes[k]);
    return result;
}

}  // namespace alembert
