// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/side_by_side.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "codegen/machine/line_cycles.hpp"

namespace alembert::machine {

namespace {

using Kind = Line::Kind;

constexpr std::size_t most = 4;
constexpr int gathering = 4, spreading = 8;  ///< cycles into one register, and out of it through memory
constexpr double worth = 0.95;               ///< the part of the cycles that must not be exceeded
constexpr std::size_t most_levels = 6;       ///< that are tried one by one
constexpr std::size_t most_compared = 2000;  ///< lines; of longer functions only one other way is looked at

bool is_slow(const Line& line) {
    return line.kind == Kind::root || line.kind == Kind::divide;
}

/// Values that stand side by side; the last one is there several times where they are fewer than the places.
using Tuple = std::array<int, most>;

/// Lines that become one; the first, second and third values of all.
struct Group {
    std::array<int, most> lines = {-1, -1, -1, -1};
    std::size_t count = 0;
    std::array<Tuple, 3> of = {};
};

Tuple results_of(const Lines& l, const Group& group) {
    Tuple result;
    for (std::size_t k = 0; k < most; ++k) result[k] = l.list[group.lines[std::min(k, group.count - 1)]].to;
    return result;
}

/// What waits for what.
struct Uses {
    explicit Uses(const Lines& l) : origin(origins_of(l)), needs(l.list.size()), users(l.homes.size()) {
        for (std::size_t k = 0; k < l.list.size(); ++k) {
            const Line& line = l.list[k];
            const auto use = [&](int v) {
                if (v < 0) return;
                if (origin[v] >= 0) needs[k].push_back(origin[v]);
                if (users[v].empty() || users[v].back() != static_cast<int>(k))
                    users[v].push_back(static_cast<int>(k));
            };
            for (const int v : line.of) use(v);
            if (line.kind == Kind::sines)
                for (const int v : l.groups[line.place].angles) use(v);
        }
    }
    std::vector<int> origin;
    std::vector<std::vector<int>> needs, users;  ///< of each line; of each value
};

/// The order in which groups can be written: lines and, as −1 − n, groups; nothing if two groups wait for each
/// other. A group stands where its first line stood, after all that its lines wait for.
std::optional<std::vector<int>> order_of(const Lines& l, const Uses& uses, const std::vector<Group>& groups) {
    const int count = static_cast<int>(l.list.size());
    std::vector<int> group_of(l.list.size(), -1), order, stack;
    for (std::size_t n = 0; n < groups.size(); ++n)
        for (std::size_t k = 0; k < groups[n].count; ++k) group_of[groups[n].lines[k]] = static_cast<int>(n);
    enum class State : unsigned char { waiting, begun, done };
    std::vector<State> state(l.list.size() + groups.size(), State::waiting);
    const auto unit = [&](int line) { return group_of[line] < 0 ? line : count + group_of[line]; };
    for (int first = 0; first < count; ++first) {
        if (state[unit(first)] == State::waiting) stack.push_back(unit(first));
        while (!stack.empty()) {
            const int at = stack.back();
            if (state[at] == State::done) {
                stack.pop_back();
                continue;
            }
            if (state[at] == State::begun) {
                state[at] = State::done;
                stack.pop_back();
                order.push_back(at < count ? at : count - 1 - at);
                continue;
            }
            state[at] = State::begun;
            const auto wait_for = [&](int line) {
                for (auto need = uses.needs[line].rbegin(); need != uses.needs[line].rend(); ++need) {
                    if (state[unit(*need)] == State::begun) return false;
                    if (state[unit(*need)] == State::waiting) stack.push_back(unit(*need));
                }
                return true;
            };
            if (at < count) {
                if (!wait_for(at)) return std::nullopt;
                continue;
            }
            const Group& group = groups[at - count];
            for (std::size_t k = group.count; k-- > 0;)
                if (!wait_for(group.lines[k])) return std::nullopt;
        }
    }
    return order;
}

/// Finds groups.
class Grouping {
public:
    Grouping(const Lines& lines, const Uses& uses, int cycles)
        : l_(lines), uses_(uses), is_grouped_(lines.list.size(), 0) {
        const std::size_t count = l_.list.size();
        std::vector<int> early(count, 0), rank(count, 0), rest(count, 0);
        for (std::size_t k = 0; k < count; ++k)
            for (const int need : uses_.needs[k]) {
                early[k] = std::max(early[k], early[need] + latency_of(l_.list[need]));
                rank[k] = std::max(rank[k], rank[need] + (is_slow(l_.list[need]) ? 1 : 0));
            }
        for (std::size_t k = count; k-- > 0;) {
            rest[k] += latency_of(l_.list[k]);
            for (const int need : uses_.needs[k]) rest[need] = std::max(rest[need], rest[k]);
        }
        // Of the same rank none waits for another one.
        std::map<std::tuple<int, Kind>, std::vector<int>> levels;
        for (std::size_t k = 0; k < count; ++k)
            if (is_slow(l_.list[k])) levels[{rank[k], l_.list[k].kind}].push_back(static_cast<int>(k));
        for (auto& [level, lines_of_level] : levels) {
            std::stable_sort(lines_of_level.begin(), lines_of_level.end(),
                             [&](int a, int b) { return early[a] < early[b]; });
            levels_.emplace_back();
            Group group;
            int limit = 0;
            for (const int k : lines_of_level) {
                const int longest = cycles - rest[k] - gathering - spreading;  // when it can begin
                if (group.count == most || (group.count > 0 && early[k] > std::min(limit, longest))) close(group);
                limit = group.count == 0 ? longest : std::min(limit, longest);
                if (early[k] <= longest) group.lines[group.count++] = k;
            }
            close(group);
        }
    }

    /// By kind and by how many roots and quotients come before.
    const std::vector<std::vector<Group>>& levels() const { return levels_; }

    /// With lines whose values all stand side by side already.
    std::vector<Group> extended(std::vector<Group> groups) {
        packs_.clear();
        std::fill(is_grouped_.begin(), is_grouped_.end(), 0);
        for (const Group& group : groups)
            for (std::size_t k = 0; k < group.count; ++k) is_grouped_[group.lines[k]] = 1;
        for (const Group& group : groups) {
            for (std::size_t j = 0; j < 3; ++j)
                if (group.of[j][0] >= 0) packs_[group.of[j][0]].insert(group.of[j]);
            const Tuple results = results_of(l_, group);
            packs_[results[0]].insert(results);
        }
        for (std::size_t n = 0; n < groups.size(); ++n) {
            const Group from = groups[n];
            const Tuple lanes = results_of(l_, from);
            for (const int user : uses_.users[lanes[0]]) {
                if (!may_join(user)) continue;
                if (const std::optional<Group> found = users_like(user, lanes, from.count)) {
                    for (std::size_t k = 0; k < found->count; ++k) is_grouped_[found->lines[k]] = 1;
                    const Tuple results = results_of(l_, *found);
                    packs_[results[0]].insert(results);
                    groups.push_back(*found);
                }
            }
        }
        return groups;
    }

private:
    void close(Group& group) {
        if (group.count > 1) {
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t k = 0; k < most; ++k)
                    group.of[j][k] = l_.list[group.lines[std::min(k, group.count - 1)]].of[j];
            levels_.back().push_back(group);
        }
        group = {};
    }

    bool may_join(int line) const {
        switch (l_.list[line].kind) {
            case Kind::add:
            case Kind::subtract:
            case Kind::multiply:
            case Kind::fused:
                return is_grouped_[line] == 0;
            default:
                return false;
        }
    }

    /// The tuples that a value may begin: itself in all places, and those that are there.
    std::vector<Tuple> tuples_with(int value) const {
        std::vector<Tuple> result;
        if (const auto known = packs_.find(value); known != packs_.end())
            result.assign(known->second.begin(), known->second.end());
        result.push_back({value, value, value, value});
        return result;
    }

    /// The line, and for each further lane one that uses the value of that lane in the same way.
    std::optional<Group> users_like(int first, const Tuple& lanes, std::size_t count) const {
        const Line& line = l_.list[first];
        std::array<std::vector<Tuple>, 3> possible;
        for (std::size_t j = 0; j < 3 && line.of[j] >= 0; ++j) possible[j] = tuples_with(line.of[j]);
        Group group{.lines = {first, -1, -1, -1}, .count = count};
        for (std::size_t k = 1; k < count; ++k) {
            const auto& users = uses_.users[lanes[k]];
            const auto found = std::find_if(users.begin(), users.end(), [&](int user) {
                return may_join(user) &&
                       std::find(group.lines.begin(), group.lines.begin() + k, user) == group.lines.begin() + k &&
                       narrow(possible, line, l_.list[user], k);
            });
            if (found == users.end()) return std::nullopt;
            group.lines[k] = *found;
        }
        for (std::size_t j = 0; j < 3; ++j) {
            group.of[j].fill(-1);
            if (line.of[j] < 0) continue;
            group.of[j] = possible[j].front();
            std::fill(group.of[j].begin() + count, group.of[j].end(), group.of[j][count - 1]);
        }
        return group;
    }

    /// Keeps the tuples that have the values of the other line at place k; false, and all of them, if it has none.
    static bool narrow(std::array<std::vector<Tuple>, 3>& possible, const Line& line, const Line& other,
                       std::size_t k) {
        if (other.kind != line.kind || other.minus_product != line.minus_product ||
            other.minus_rest != line.minus_rest)
            return false;
        const auto tried = [&](std::array<int, 3> of) {
            auto left = possible;
            for (std::size_t j = 0; j < 3 && line.of[j] >= 0; ++j) {
                std::erase_if(left[j], [&](const Tuple& tuple) { return tuple[k] != of[j]; });
                if (left[j].empty()) return false;
            }
            possible = std::move(left);
            return true;
        };
        return tried(other.of) || (line.kind != Kind::subtract && tried({other.of[1], other.of[0], other.of[2]}));
    }

    const Lines& l_;
    const Uses& uses_;
    std::vector<std::vector<Group>> levels_;
    std::vector<char> is_grouped_;
    std::map<int, std::set<Tuple>> packs_;  ///< by their first value
};

/// Cycles for which the divider is free instead.
int saved_by(const Lines& l, const Group& group) {
    const int alone = divider_cycles(l.list[group.lines[0]], 1);
    return static_cast<int>(group.count) * alone -
           divider_cycles(l.list[group.lines[0]], group.count == 2 ? 2 : 4);
}

/// Writes lines with groups.
class Writing {
public:
    /// `needed`: the values of groups that are used alone.
    Writing(const Lines& lines, const std::vector<Group>& groups, const std::vector<int>& order,
            std::set<int> needed)
        : l_(lines), needed_(std::move(needed)) {
        result_ = lines;
        result_.list.clear();
        result_.block = (result_.block + 1) / 2 * 2;
        for (const Group& group : groups)
            for (std::size_t k = 0; k < group.count; ++k) is_ours_.insert(l_.list[group.lines[k]].to);
        for (const int at : order)
            if (at < 0)
                write(groups[static_cast<std::size_t>(-1 - at)]);
            else
                write(l_.list[at]);
    }

    Lines result() && { return std::move(result_); }
    std::set<int> used_alone() && { return std::move(used_alone_); }

private:
    void write(const Line& line) {
        for (const int v : line.of) use(v);
        if (line.kind == Kind::sines)
            for (const int v : l_.groups[line.place].angles) use(v);
        result_.list.push_back(line);
    }
    void use(int v) {
        if (is_ours_.contains(v)) used_alone_.insert(v);
    }

    int add(Line line, int numbers) {
        line.to = static_cast<int>(result_.homes.size());
        result_.homes.push_back({.numbers = numbers});
        result_.list.push_back(line);
        return line.to;
    }

    void write(const Group& group) {
        const int numbers = group.count == 2 ? 2 : 4;
        Line line = l_.list[group.lines[0]];
        for (std::size_t j = 0; j < 3 && line.of[j] >= 0; ++j) line.of[j] = gathered(group.of[j], numbers);
        const int value = add(line, numbers);
        const Tuple lanes = results_of(l_, group);
        packs_[{lanes, numbers}] = value;
        if (std::none_of(lanes.begin(), lanes.end(), [&](int v) { return needed_.contains(v); })) return;
        result_.list.push_back({.kind = Kind::keep, .of = {value, -1, -1}, .place = result_.block});
        for (std::size_t k = 0; k < group.count; ++k)
            result_.homes[lanes[k]] = {.kind = Home::Kind::block, .place = result_.block + static_cast<int>(k)};
        result_.block += numbers;
    }

    int gathered(const Tuple& of, int numbers) {
        const auto [known, is_new] = packs_.try_emplace({of, numbers}, -1);
        if (!is_new) return known->second;
        for (const int v : of) use(v);
        const auto pair = [&](int a, int b) {
            return a == b ? add({.kind = Kind::repeat, .of = {a, -1, -1}}, 2)
                          : add({.kind = Kind::pair, .of = {a, b, -1}}, 2);
        };
        int value = -1;
        if (of[0] == of[1] && of[1] == of[2] && of[2] == of[3]) {
            value = add({.kind = Kind::repeat, .of = {of[0], -1, -1}}, numbers);
        } else {
            value = pair(of[0], of[1]);
            if (numbers == 4) value = add({.kind = Kind::join, .of = {value, pair(of[2], of[3]), -1}}, 4);
        }
        return packs_[{of, numbers}] = value;
    }

    const Lines& l_;
    Lines result_;
    std::set<int> needed_, is_ours_, used_alone_;
    std::map<std::pair<Tuple, int>, int> packs_;
};

/// Nothing if groups wait for each other.
std::optional<Lines> written(const Lines& lines, const Uses& uses, const std::vector<Group>& groups) {
    const auto order = order_of(lines, uses, groups);
    if (!order) return std::nullopt;
    Lines result = Writing(lines, groups, *order, Writing(lines, groups, *order, {}).used_alone()).result();
    result.list = as_late_as_possible(result);
    return result;
}

}  // namespace

Lines side_by_side(const Lines& lines) {
    if (lines.lanes != 1 || std::count_if(lines.list.begin(), lines.list.end(), is_slow) < 2) return lines;
    Lines best = lines;
    int least = cycles_of(lines);
    const Uses uses(lines);
    Grouping grouping(lines, uses, least);
    std::vector<std::vector<Group>> levels = grouping.levels();
    const auto saved = [&](const std::vector<Group>& groups) {
        int cycles = 0;
        for (const Group& group : groups) cycles += saved_by(lines, group);
        return cycles;
    };
    std::vector<Group> all, taken;
    for (const std::vector<Group>& level : levels) all.insert(all.end(), level.begin(), level.end());
    if (saved(all) < (1 - worth) * least) return lines;
    const auto is_better = [&](const std::vector<Group>& groups) {
        const std::optional<Lines> other = written(lines, uses, groups);
        const int cycles = other ? cycles_of(*other) : 0;
        if (!other || cycles > worth * least) return false;
        best = *other;
        least = cycles;
        return true;
    };
    const auto is_either_better = [&](const std::vector<Group>& groups) {
        const bool with_more = is_better(grouping.extended(groups));
        return is_better(groups) || with_more;
    };
    if (is_either_better(all) || lines.list.size() > most_compared) return best;
    std::stable_sort(levels.begin(), levels.end(),
                     [&](const auto& a, const auto& b) { return saved(a) > saved(b); });
    if (levels.size() > most_levels) levels.resize(most_levels);
    for (const std::vector<Group>& level : levels) {
        std::vector<Group> tried = taken;
        tried.insert(tried.end(), level.begin(), level.end());
        if (is_either_better(tried)) taken = std::move(tried);
    }
    return best;
}

}  // namespace alembert::machine
