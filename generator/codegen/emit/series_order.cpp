// SPDX-License-Identifier: GPL-2.0-or-later
// The statements of order k: the state from the rates of the order before, all coefficients, and the factors that
// later orders need.
//
// The cost of a statement is the number of its operations, addresses and the assignment included, times the number
// of its vectors.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "codegen/emit/series_writer.hpp"

namespace alembert {

using Kind = SeriesNode::Kind;

std::vector<CodeStatement> SeriesWriter::given() const {
    std::vector<CodeStatement> lines;
    for (int id = 0; id < size(); ++id) {
        const SeriesNode& x = node(id);
        const int place = x.kind == Kind::coordinate ? x.index
                          : x.kind == Kind::speed    ? n_ + x.index
                          : x.kind == Kind::work     ? n_ + s_
                                                     : -1;
        if (place < 0) continue;
        const std::string name = now(id).text;
        lines.push_back({.cost = 2, .text = fmt::format("const Real {} = per_k * last[{}];", name, place)});
        lines.push_back({.cost = 3, .text = fmt::format("out[k * {} + {}] = {};", width(), place, name)});
    }
    return lines;
}

CodeExpression SeriesWriter::value_alone(int id) {
    const auto sum = sums_.find(id);
    return sum != sums_.end() ? sum->second.value(times_) : value(id, view(id));
}

void SeriesWriter::schedule() {
    for (int id = 0; id < size(); ++id)
        if (lanes_.has_edges() && !lanes_.is_packed(id) && !lanes_.products(id).empty())
            sums_.emplace(id, sum_parts(id));
    times_ = series_times(r_, lanes_, sums_);
}

/// Sums of products in packs, over all orders below k; only this order needs them.
std::vector<std::string> SeriesWriter::gathering() {
    std::vector<std::string> lines;
    if (!lanes_.lanes().empty())
        lines.push_back(
            fmt::format("gather<{}, {}>(gathered, left, right, k);", lanes_.padded(), lanes_.has_edges() ? 2 : 1));
    for (std::size_t p = 0; p < packs_.size(); ++p) {
        const SeriesPack& pack = lanes_.packs()[p];
        for (std::size_t t = 0; t < packs_[p].sums.size(); ++t) {
            const SeriesProduct& x = lanes_.products(pack.nodes[0])[t];
            const std::string& to = packs_[p].sums[t];
            const auto array = [&](int arg, bool rate) -> const std::string& {
                const PackNames& source = packs_[lanes_.source_of(pack, arg)];
                return rate ? source.rates : source.column;
            };
            const std::string &a = array(x.a, x.a_rate), &b = array(x.b, x.b_rate);
            if (x.weighed)
                lines.push_back(fmt::format("weighed<{}>({}, {}, {}, {}, k);", pack.padded(), to, a, b,
                                            number(node(pack.nodes[0]).exponent).text));
            else if (x.is_square())
                lines.push_back(fmt::format("squared<{}>({}, {}, k);", pack.padded(), to, a));
            else
                lines.push_back(fmt::format("convolved<{}>({}, {}, {}, k);", pack.padded(), to, a, b));
        }
    }
    return lines;
}

/// The nodes whose coefficients of this order that of a node needs. The cosine of a sine, for example, is not
/// among them, because only the products of later orders need it.
std::vector<int> SeriesWriter::needed_now(int id) const {
    std::vector<int> list = arguments_of(node(id));
    for (const auto& [weight, m, a] : node(id).implied)
        list.push_back(m);  // the solution of the linear system at order 0 gives its first coefficient
    return list;
}

bool SeriesWriter::is_ready(int id, const std::vector<char>& done, bool solved) const {
    if (node(id).kind == Kind::unknown) return solved;
    const std::vector<int> list = needed_now(id);
    return std::all_of(list.begin(), list.end(), [&](int arg) { return done[arg] != 0; });
}

/// Computes the coefficient of a node, or those of all lanes of its pack.
void SeriesWriter::add_coefficients(std::vector<CodeStatement>& lines, int id) {
    const Kind kind = node(id).kind;
    if (!lanes_.is_packed(id)) {
        if (kind == Kind::coordinate || kind == Kind::speed || kind == Kind::work || kind == Kind::unknown) return;
        const CodeExpression value = value_alone(id);
        lines.push_back(
            {.cost = 1 + value.operations, .text = fmt::format("const Real {} = {};", now(id).text, value.text)});
        return;
    }
    const SeriesPack& pack = pack_of(id);
    if (!pack.by_lanes) {
        for (const int source : copies_needed_now(pack)) add_copy(lines, source, false);
        const std::string& column = packs_[lanes_.pack(id)].column;
        const CodeExpression made = value(pack.nodes[0], view_of_pack(lanes_.pack(id)));
        lines.push_back(over_lanes(pack, {fmt::format("{} + {} * k + l", column, pack.padded()), 3}, made));
        return;
    }
    for (const int lane : pack.nodes) {
        const CodeExpression to = now(lane), made = value(lane, view(lane));
        lines.push_back(
            {.cost = 1 + to.operations + made.operations, .text = fmt::format("{} = {};", to.text, made.text)});
    }
}

std::vector<CodeStatement> SeriesWriter::chain() {
    std::vector<CodeStatement> lines;
    std::vector<char> done(r_.nodes.size(), 0);
    bool solved = r_.matrix.empty();
    const auto ready = [&](int id) { return is_ready(id, done, solved); };
    for (bool moved = true; moved;) {
        moved = false;
        for (int id = 0; id < size(); ++id) {
            if (done[id] != 0 || !ready(id)) continue;
            const std::vector<int> nodes = lanes_.is_packed(id) ? pack_of(id).nodes : std::vector<int>{id};
            if (!std::all_of(nodes.begin(), nodes.end(), ready)) continue;
            moved = true;
            add_coefficients(lines, id);
            for (const int lane : nodes) {
                if (const std::string& rate = names_of_[lane].rate; !rate.empty())
                    lines.push_back({.cost = 2 + now(lane).operations,
                                     .text = fmt::format("const Real {} = number * {};", rate, now(lane).text)});
                done[lane] = 1;
            }
        }
        if (!moved && !solved) {
            std::string unknowns;
            for (const int a : r_.unknowns) unknowns += (unknowns.empty() ? "" : ", ") + now(a).text;
            lines.push_back({.text = fmt::format("Real {};", unknowns)});
            lines.push_back({.text = solve_call([&](int a) { return now(a).text; })});
            solved = moved = true;
        }
    }
    add_what_products_need(lines);
    return lines;
}

/// Adds the copies that have not been needed before, and the rates.
void SeriesWriter::add_what_products_need(std::vector<CodeStatement>& lines) const {
    const std::vector<SeriesPack>& packs = lanes_.packs();
    std::set<int> made;
    for (const SeriesPack& pack : packs)
        if (!pack.is_copy && !pack.by_lanes) made.merge(copies_needed_now(pack));
    for (std::size_t p = 0; p < packs.size(); ++p) {
        if (packs[p].is_copy && !made.contains(static_cast<int>(p))) add_copy(lines, static_cast<int>(p), false);
        if (packs_[p].rates.empty()) continue;
        const auto at = [&](const std::string& column) {
            return fmt::format("{} + {} * k + l", column, packs[p].padded());
        };
        lines.push_back(over_lanes(packs[p], {at(packs_[p].rates), 3},
                                   {fmt::format("number * loaded({})", at(packs_[p].column)), 4}));
    }
}

std::vector<std::string> SeriesWriter::last() const {
    std::vector<std::string> lines;
    for (int i = 0; i < width(); ++i)
        lines.push_back(fmt::format("last[{}] = {};", i, now(rate_node(r_, i)).text));
    return lines;
}

std::vector<CodeStatement> SeriesWriter::storing(bool is_straight) const {
    std::vector<CodeStatement> lines;
    const std::vector<SeriesLane>& lanes = lanes_.lanes();
    const auto scalar = [&](int id, bool rate) { return rate ? CodeExpression(names_of_[id].rate) : now(id); };
    for (std::size_t l = 0; l < lanes.size() && !is_straight; ++l)
        for (const auto& [array, value] : {std::pair("left", scalar(lanes[l].a, lanes[l].a_rate)),
                                           std::pair("right", scalar(lanes[l].b, lanes[l].b_rate))})
            lines.push_back({.cost = 3 + value.operations,
                             .text = fmt::format("{}[{} * k + {}] = {};", array, lanes_.padded(), l, value.text)});
    for (std::size_t first = 0; first < lanes.size() && is_straight; first += processor::lanes) {
        std::string left, right;
        for (std::size_t l = first; l < std::min(first + processor::lanes, lanes.size()); ++l) {
            left += ", " + scalar(lanes[l].a, lanes[l].a_rate).text;
            right += ", " + scalar(lanes[l].b, lanes[l].b_rate).text;
        }
        for (const auto& [array, values] : {std::pair("left", &left), std::pair("right", &right)})
            lines.push_back(
                {.text = fmt::format("store<{}, {}>({}, k{});", lanes_.padded(), first, array, *values)});
    }
    for (const auto& [id, edge] : edges_)
        lines.push_back(
            {.cost = 1 + now(id).operations, .text = fmt::format("{} = {};", edge.before, now(id).text)});
    return lines;
}

/// The first coefficients for the edges. They are halved at order 1, so that the only term of order 2 is counted
/// once.
std::vector<std::string> SeriesWriter::ones() const {
    std::vector<std::string> lines;
    for (const auto& [id, edge] : edges_)
        lines.push_back(
            fmt::format("{} = k == 1 ? Real(0.5) * {} : Real(2) * {};", edge.one, now(id).text, edge.one));
    return lines;
}

std::vector<std::string> SeriesWriter::edges() const {
    std::vector<std::string> lines;
    for (const auto& [id, edge] : edges_)
        lines.push_back(fmt::format("Real {} = 0, {} = 0;", edge.one, edge.before));
    return lines;
}

CodeStatement SeriesWriter::over_lanes(const SeriesPack& pack, const CodeExpression& to,
                                       const CodeExpression& value) {
    const int vectors = static_cast<int>(pack.padded() / processor::lanes);
    return {.cost = (1 + to.operations + value.operations) * vectors,
            .text = fmt::format("for (int l = 0; l < {}; l += lanes<Real>) put({}, {});", pack.padded(), to.text,
                                value.text)};
}

void SeriesWriter::add_copy(std::vector<CodeStatement>& lines, int number, bool at_zero) const {
    const SeriesPack& pack = lanes_.packs()[number];
    for (std::size_t lane = 0; lane < pack.nodes.size(); ++lane) {
        const int id = pack.nodes[lane];
        const CodeExpression from = at_zero ? first(id) : now(id);
        const std::string place = at_zero ? std::to_string(lane) : fmt::format("{} * k + {}", pack.padded(), lane);
        lines.push_back({.cost = (at_zero ? 1 : 3) + from.operations,
                         .text = fmt::format("{}[{}] = {};", packs_[number].column, place, from.text)});
    }
}

/// The copies of lanes of other packs that a pack needs for its coefficients of this order.
std::set<int> SeriesWriter::copies_needed_now(const SeriesPack& pack) const {
    std::set<int> result;
    for (const int arg : needed_now(pack.nodes[0]))
        if (const int source = lanes_.source_of(pack, arg); lanes_.packs()[source].is_copy) result.insert(source);
    return result;
}

}  // namespace alembert
