// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/series_lanes.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace alembert {

using Kind = SeriesNode::Kind;

bool operator<(const SeriesShape& a, const SeriesShape& b) {
    if (a.numbers != b.numbers) return a.numbers < b.numbers;
    if (a.exponent.constant != b.exponent.constant) return a.exponent.constant < b.exponent.constant;
    return cln::compare(a.exponent.number, b.exponent.number) < 0;
}

bool operator==(const SeriesShape& a, const SeriesShape& b) {
    return !(a < b) && !(b < a);
}

std::vector<int> arguments_of(const SeriesNode& x) {
    std::vector<int> list;
    for (const auto& [weight, a] : x.linear) list.push_back(a);
    for (const auto& [weight, a, b] : x.bilinear) list.insert(list.end(), {a, b});
    for (const int arg : {x.a, x.b})
        if (arg >= 0) list.push_back(arg);
    if (x.kind == Kind::quotient || x.kind == Kind::ratio || x.kind == Kind::turn) list.push_back(x.w);
    return list;
}

int divisor_of(const Recurrences& r, int id) {
    const SeriesNode& x = r.nodes[id];
    if (x.kind == Kind::quotient || x.kind == Kind::ratio || x.kind == Kind::turn) return x.w;
    if (x.kind == Kind::power) return x.a;
    return x.kind == Kind::root ? id : -1;
}

SeriesLanes::SeriesLanes(const Recurrences& recurrences, bool with_packs)
    : r_(recurrences), place_(recurrences.nodes.size()) {
    for (int id = 0; id < size(); ++id) products_.push_back(products_of(id));
    if (with_packs) find_packs();
    find_lanes();
}

double SeriesLanes::products_eight_wide() const {
    double count = 0.5 * static_cast<double>(padded() / processor::lanes);
    for (const SeriesPack& pack : packs_) {
        if (pack.is_copy) continue;
        for (const SeriesProduct& x : products_[pack.nodes[0]])
            count += (x.is_square() ? 0.25 : 0.5) * static_cast<double>(pack.padded() / processor::lanes);
    }
    return count;
}

std::vector<SeriesProduct> SeriesLanes::products_of(int id) const {
    const SeriesNode& x = node(id);
    std::vector<SeriesProduct> list;
    for (const auto* terms : {&x.bilinear, &x.implied})
        for (const auto& [weight, a, b] : *terms) list.push_back({weight, a, b});
    const Weight plus{1, -1}, minus{-1, -1};
    switch (x.kind) {
        case Kind::quotient:
            list.push_back({minus, x.w, id});
            break;
        case Kind::root:
            list.push_back({minus, id, id});
            break;
        case Kind::power:
            list.push_back({x.exponent, x.a, id, true, false});
            list.push_back({minus, id, x.a, true, false});
            break;
        case Kind::sine:
        case Kind::hyperbolic_sine:
        case Kind::hyperbolic_cosine:
        case Kind::area:
            list.push_back({plus, x.a, x.w, true, false});
            break;
        case Kind::cosine:
            list.push_back({minus, x.a, x.w, true, false});
            break;
        case Kind::exponential:
            list.push_back({plus, x.a, id, true, false});
            break;
        case Kind::ratio:
            list.push_back({minus, id, x.w, true, false});
            break;
        case Kind::turn:
            list.push_back({plus, x.b, x.a, false, true});
            list.push_back({minus, x.a, x.b, false, true});
            list.push_back({minus, id, x.w, true, false});
            break;
        default:
            break;
    }
    return list;
}

void SeriesLanes::find_lanes() {
    rate_needed_.assign(r_.nodes.size(), 0);
    for (int id = 0; id < size(); ++id) {
        if (is_packed(id)) continue;
        for (const SeriesProduct& product : products_[id]) {
            const SeriesLane lane = lane_of(product);
            if (numbers_.try_emplace(lane, static_cast<int>(numbers_.size())).second) lanes_.push_back(lane);
            if (lane.a_rate) rate_needed_[lane.a] = 1;
            if (lane.b_rate) rate_needed_[lane.b] = 1;
        }
    }
}

SeriesLane SeriesLanes::lane_of(const SeriesProduct& x) {
    return std::pair(x.a, x.a_rate) <= std::pair(x.b, x.b_rate) ? SeriesLane{x.a, x.b, x.a_rate, x.b_rate}
                                                                : SeriesLane{x.b, x.a, x.b_rate, x.a_rate};
}

SeriesShape SeriesLanes::shape(int id) const {
    const SeriesNode& x = node(id);
    SeriesShape shape{
        .numbers = {static_cast<int>(x.kind), static_cast<int>(x.op), static_cast<int>(x.linear.size())},
        .exponent = {}};
    for (const auto& [weight, a, b] : x.bilinear) shape.numbers.push_back(a == b ? 1 : 0);
    if (x.kind == Kind::power) shape.exponent = x.exponent;
    // The positions that have the same argument; this argument then comes from one pack in all lanes.
    shape.numbers.push_back(-1);
    const std::vector<int> list = positions(id);
    for (std::size_t k = 0; k < list.size(); ++k)
        shape.numbers.push_back(static_cast<int>(std::find(list.begin(), list.end(), list[k]) - list.begin()));
    return shape;
}

/// The arguments by position: those of linear terms, of bilinear terms, a, b, w.
std::vector<int> SeriesLanes::positions(int id) const {
    const SeriesNode& x = node(id);
    std::vector<int> list;
    for (const auto& [weight, a] : x.linear) list.push_back(a);
    for (const auto& [weight, a, b] : x.bilinear) list.insert(list.end(), {a, b});
    for (const int arg : {x.a, x.b, x.w})
        if (arg >= 0) list.push_back(arg);
    return list;
}

bool SeriesLanes::can_be_packed(int id) const {
    switch (node(id).kind) {
        case Kind::time:
        case Kind::coordinate:
        case Kind::speed:
        case Kind::work:
        case Kind::unknown:
        case Kind::residual:
            return false;
        default:
            return true;
    }
}

/// Nodes that the solution of the linear system needs are on lower levels than nodes that need the solution, so
/// that they are never lanes of one pack.
void SeriesLanes::find_levels() {
    levels_.assign(static_cast<std::size_t>(size()), 0);
    int solve = 0;
    for (const bool is_known : {false, true}) {
        for (int id = 0; id < size(); ++id) {
            int highest = node(id).kind == Kind::unknown ? solve : 0;
            for (const int arg : arguments_of(node(id))) highest = std::max(highest, levels_[arg]);
            levels_[id] = highest + 1;
        }
        if (is_known) break;
        for (const int id : r_.residuals) solve = std::max(solve, levels_[id]);
        for (const SeriesEntry& e : r_.matrix)
            if (e.node >= 0) solve = std::max(solve, levels_[e.node]);
    }
}

/// Divides the nodes of a group into parts, from the last level to the first, so that users decide the order of
/// lanes. The nodes of a part have no argument in common.
std::vector<std::vector<int>> SeriesLanes::parts_of(const std::vector<int>& group) const {
    std::vector<std::vector<int>> parts;
    std::vector<std::set<std::pair<std::size_t, int>>> taken;
    for (const int id : group) {
        if (is_packed(id)) continue;
        const std::vector<int> mine = positions(id);
        std::size_t part = 0;
        const auto clashes = [&] {
            for (std::size_t k = 0; k < mine.size(); ++k)
                if (can_be_packed(mine[k]) && taken[part].contains({k, mine[k]})) return true;
            return false;
        };
        while (part < parts.size() && clashes()) ++part;
        if (part == parts.size()) parts.emplace_back(), taken.emplace_back();
        parts[part].push_back(id);
        for (std::size_t k = 0; k < mine.size(); ++k) taken[part].insert({k, mine[k]});
    }
    for (std::size_t part = 1; part < parts.size(); ++part)
        for (std::size_t before = 0; before < part; ++before)
            if (follow(parts[before], parts[part])) break;
    return parts;
}

void SeriesLanes::find_packs() {
    find_levels();
    std::map<std::pair<int, SeriesShape>, std::vector<int>> groups;
    for (int id = 0; id < size(); ++id)
        if (can_be_packed(id)) groups[{-levels_[id], shape(id)}].push_back(id);
    for (const auto& [key, group] : groups) {
        for (const std::vector<int>& part : parts_of(group)) {
            // Linear sums are worth a pack only as arguments of one.
            const bool is_linear = products_[part[0]].empty();
            if (part.size() >= processor::least_lanes && !is_linear) add_pack(part);
        }
        const int here = -key.first;
        for (std::size_t p = 0; p < packs_.size(); ++p)
            if (!packs_[p].is_copy && levels_[packs_[p].nodes[0]] == here && packs_[p].number < 0)
                arrange(static_cast<int>(p));
    }
    for (std::size_t p = 0; p < packs_.size(); ++p)
        if (packs_[p].number < 0) arrange(static_cast<int>(p));
    for (const SeriesPack& pack : packs_)
        if (const SeriesNode& x = node(pack.nodes[0]);
            x.kind == Kind::power && !pack.is_copy && !pack.by_lanes && x.exponent.constant < 0)
            for (const int id : pack.nodes) products_[id] = {{{1, -1}, node(id).a, id, false, false, true}};
    for (SeriesPack& pack : packs_)
        if (!pack.is_copy) find_weights(pack);
}

/// Reorders `part` so that each of its nodes shares an argument with the node of `leader` in the same lane; false
/// if there is no such order. The arguments that both take from a third pack then have the same order for both.
bool SeriesLanes::follow(const std::vector<int>& leader, std::vector<int>& part) const {
    if (leader.size() != part.size()) return false;
    const std::size_t count = positions(leader[0]).size();
    if (positions(part[0]).size() != count) return false;
    for (std::size_t k = 0; k < count; ++k) {
        std::map<int, int> with;
        for (const int id : part) with[positions(id)[k]] = id;
        std::vector<int> ordered;
        for (const int id : leader)
            if (const auto found = with.find(positions(id)[k]); found != with.end() && can_be_packed(found->first))
                ordered.push_back(found->second);
        if (with.size() != part.size() || ordered.size() != part.size()) continue;
        part = ordered;
        return true;
    }
    return false;
}

int SeriesLanes::add_pack(const std::vector<int>& nodes) {
    const int number = static_cast<int>(packs_.size());
    packs_.push_back({.nodes = nodes});
    for (std::size_t lane = 0; lane < nodes.size(); ++lane) place_[nodes[lane]] = {number, static_cast<int>(lane)};
    return number;
}

/// Numbers a pack and determines the packs from which its arguments come.
void SeriesLanes::arrange(int number) {
    packs_[number].number = numbered_++;
    const std::vector<int> nodes = packs_[number].nodes;
    std::vector<std::vector<int>> lists;  // the arguments of the lanes, by position
    for (const int id : nodes) {
        const std::vector<int> list = positions(id);
        lists.resize(list.size());
        for (std::size_t k = 0; k < list.size(); ++k) lists[k].push_back(list[k]);
    }
    const bool is_linear = products_[nodes[0]].empty();
    std::map<int, int> sources;
    for (const std::vector<int>& list : lists) {
        const int source = pack_of(list, is_linear);
        if (source < 0) {
            packs_[number].by_lanes = true;
            return;
        }
        const auto [place, is_new] = sources.try_emplace(list[0], source);
        if (!is_new && place->second != source) throw std::logic_error("an argument with two orders of lanes");
    }
    packs_[number].sources = sources;
}

/// A pack with exactly these lanes: an existing one, a new one, or one of copies. −1 if these are linear sums,
/// which are better computed lane by lane.
int SeriesLanes::pack_of(const std::vector<int>& list, bool is_linear) {
    for (std::size_t p = 0; p < packs_.size(); ++p)
        if (packs_[p].nodes == list) return static_cast<int>(p);
    const std::set<int> distinct(list.begin(), list.end());
    const auto same = [&](int id) {
        return can_be_packed(id) && !is_packed(id) && levels_[id] == levels_[list[0]] &&
               shape(id) == shape(list[0]);
    };
    if (!is_linear && distinct.size() == list.size() && std::all_of(list.begin(), list.end(), same))
        return add_pack(list);
    if (is_linear) return -1;
    packs_.push_back({.nodes = list, .number = numbered_++, .by_lanes = true, .is_copy = true});
    return static_cast<int>(packs_.size()) - 1;
}

void SeriesLanes::find_weights(SeriesPack& pack) {
    const auto same = [](const Weight& a, const Weight& b) {
        return a.constant == b.constant && cln::equal(a.number, b.number);
    };
    const auto list = [&](int id) {
        std::vector<Weight> all;
        for (const auto& [weight, a] : node(id).linear) all.push_back(weight);
        for (const auto& [weight, a, b] : node(id).bilinear) all.push_back(weight);
        for (const SeriesProduct& product : products_[id]) all.push_back(product.weight);
        return all;
    };
    const std::vector<Weight> first = list(pack.nodes[0]);
    for (std::size_t k = 0; k < first.size(); ++k) {
        std::vector<Weight> lanes;
        for (const int id : pack.nodes) lanes.push_back(list(id)[k]);
        const bool differ =
            std::any_of(lanes.begin(), lanes.end(), [&](const Weight& w) { return !same(w, lanes[0]); });
        pack.weights.push_back(differ ? lanes : std::vector<Weight>());
    }
    for (const SeriesProduct& product : products_[pack.nodes[0]]) {
        if (product.a_rate) packs_[source_of(pack, product.a)].needs_rates = true;
        if (product.b_rate) packs_[source_of(pack, product.b)].needs_rates = true;
    }
}

int SeriesLanes::source_of(const SeriesPack& pack, int arg) const {
    if (arg == pack.nodes[0]) return place_[arg].pack;
    return pack.sources.at(arg);
}

}  // namespace alembert
