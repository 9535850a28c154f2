// SPDX-License-Identifier: GPL-2.0-or-later
// The names of coefficients and arrays, and the places of the arrays in the work space.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "codegen/emit/series_writer.hpp"

#include "program/motion_system.hpp"

namespace alembert {

using Kind = SeriesNode::Kind;

namespace {

// What templates/taylor.cpp.mustache declares besides what every emitted file does.
constexpr const char* own_names[] = {
    "k",        "number", "per_k", "order",      "top",       "out",           "work",      "last",    "loaded",
    "wide",     "lanes",  "l",     "columns",    "put",       "columns_count", "convolved", "squared", "gather",
    "gathered", "left",   "right", "room",       "one",       "constant",      "store",     "series",  "quad",
    "clear",    "solve",  "terms", "most_order", "most_room", "workspace",     "weighed"};

}  // namespace

SeriesWriter::SeriesWriter(const Recurrences& recurrences, const SeriesLanes& lanes)
    : r_(recurrences),
      p_(r_.program),
      lanes_(lanes),
      n_(static_cast<int>(p_.coordinates.size())),
      s_(static_cast<int>(speeds_of(p_))) {
    for (const char* name : own_names) names_.fresh(name);
    name_nodes();
    name_packs();
    name_lanes();
}

std::string SeriesWriter::speed_name(int i) const {
    const auto k = static_cast<std::size_t>(i);
    const int q = p_.speeds.empty() ? i : p_.speeds[k].rate_of;
    return ascii_identifier(q < 0 ? p_.speeds[k].name : p_.coordinates[static_cast<std::size_t>(q)].name + "_dot");
}

void SeriesWriter::name_nodes() {
    names_of_.resize(r_.nodes.size());
    for (const Quantity& q : p_.coordinates) names_.fresh(q.name);
    for (const Quantity& par : p_.parameters) names_.fresh(par.name);
    for (int id = 0; id < size(); ++id) {
        const SeriesNode& x = node(id);
        NodeNames& name = names_of_[id];
        switch (x.kind) {
            case Kind::coordinate:
                name.now = names_.fresh(p_.coordinates[static_cast<std::size_t>(x.index)].name + "_k");
                break;
            case Kind::speed:
                name.now = names_.fresh(speed_name(x.index) + "_k");
                break;
            case Kind::time:
                name.now = names_.fresh("t_k");
                break;
            case Kind::work:
                name.now = names_.fresh("work_k");
                break;
            case Kind::residual:
                name.now = names_.numbered("row");
                break;
            case Kind::unknown:
                name.now = x.index < r_.preferred ? names_.numbered("a") : names_.numbered("lambda");
                break;
            case Kind::sine:
                name.now = names_.numbered("sin");
                break;
            case Kind::cosine:
                name.now = names_.numbered("cos");
                break;
            default:
                name.now = names_.numbered("z");
        }
        name.first = names_.fresh(name.now + "_0");
    }
}

void SeriesWriter::name_packs() {
    const std::vector<SeriesPack>& packs = lanes_.packs();
    packs_.resize(packs.size());
    std::vector<std::size_t> order(packs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return packs[a].number < packs[b].number; });
    for (const std::size_t p : order) packs_[p].column = names_.numbered("p");
    for (std::size_t p = 0; p < packs.size(); ++p) {
        if (packs[p].is_copy) continue;
        PackNames& own = packs_[p];
        for (std::size_t k = 0; k < packs[p].weights.size(); ++k) {
            const bool is_array = !packs[p].weights[k].empty() && !packs[p].by_lanes;
            own.weights.push_back(is_array ? names_.fresh(fmt::format("{}_w{}", own.column, k)) : "");
        }
        for (std::size_t t = 0; t < lanes_.products(packs[p].nodes[0]).size(); ++t)
            own.sums.push_back(names_.fresh(fmt::format("{}_s{}", own.column, t)));
    }
    for (std::size_t p = 0; p < packs.size(); ++p)
        if (packs[p].needs_rates) packs_[p].rates = names_.fresh(packs_[p].column + "_rates");
}

void SeriesWriter::name_lanes() {
    for (int id = 0; id < size(); ++id)
        if (lanes_.needs_rate(id)) names_of_[id].rate = names_.fresh(names_of_[id].now + "_times");
    if (!lanes_.has_edges()) return;
    for (const SeriesLane& lane : lanes_.lanes())
        for (const int id : {lane.a, lane.b})
            if (!edges_.contains(id))
                edges_[id] = {names_.fresh(names_of_[id].now + "_one"),
                              names_.fresh(names_of_[id].now + "_before")};
}

SeriesWriter::Arrays SeriesWriter::arrays() const {
    Arrays result;
    const auto place = [&](const std::string& name, std::size_t rows, bool has_orders) {
        if (name.empty()) return;
        std::size_t& count = has_orders ? result.columns : result.single;
        result.lines.push_back(fmt::format("Real* const {} = columns + {}{};", name, count,
                                           has_orders ? " * room" : " + columns_count * room"));
        count += rows;
    };
    const std::vector<SeriesPack>& packs = lanes_.packs();
    for (std::size_t p = 0; p < packs.size(); ++p)
        for (const std::string* name : {&packs_[p].column, &packs_[p].rates})
            place(*name, packs[p].padded(), true);
    if (!lanes_.lanes().empty()) {
        place("left", lanes_.padded(), true);
        place("right", lanes_.padded(), true);
        place("gathered", lanes_.padded(), false);
    }
    for (std::size_t p = 0; p < packs.size(); ++p) {
        place(packs_[p].inverse, packs[p].padded(), false);
        for (const auto* list : {&packs_[p].sums, &packs_[p].weights})
            for (const std::string& name : *list) place(name, packs[p].padded(), false);
    }
    return result;
}

}  // namespace alembert
