// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/taylor.hpp"

#include <cln/float.h>
#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <kainjow/mustache.hpp>
#include <map>
#include <set>
#include <stdexcept>

#include "alembert/error.hpp"
#include "alembert/series.hpp"
#include "emit/pieces.hpp"
#include "emit/templates.hpp"
#include "emit/timely.hpp"
#include "emit/writer.hpp"
#include "program/recurrence.hpp"
#include "program/solve.hpp"

namespace alembert {

namespace {

namespace mustache = kainjow::mustache;
using Kind = SeriesNode::Kind;
using Lines = std::vector<std::string>;

/// Exact in every Real of up to 34 digits: a double, a quotient of two, or a sum of three.
std::string exact_text(const Rational& value) {
    const auto is_double = [](const Rational& r) { return cln::zerop(r) || cln::equal(cln::rational(cln::cl_DF(cln::double_approx(r))), r); };
    const auto text = [](const Rational& r) { return fmt::format("Real({})", shortest(cln::double_approx(r))); };
    if (is_double(value)) return text(value);
    const Rational above = cln::numerator(value), below = cln::denominator(value);
    if (is_double(above) && is_double(below)) return fmt::format("({} / {})", text(above), text(below));
    std::string sum;
    Rational rest = value;
    for (int part = 0; part < 3 && !cln::zerop(rest); ++part) {
        const Rational piece = cln::rational(cln::cl_DF(cln::double_approx(rest)));
        sum += (part > 0 ? " + " : "") + text(piece);
        rest = rest - piece;
    }
    return "(" + sum + ")";
}

constexpr std::size_t least_lanes = 4;   // of a pack
// Measured on chains, planets and a governor; 1 is what a step takes beside its series.
constexpr double operation_cost = 0.0008, product_cost = 0.0055;
constexpr double operation_time = 4, packing_time = 16, gathering_time = 15, solving_time = 12;  // cycles
constexpr int orders_to_settle = 12;     // of dependences that go from order to order
constexpr std::size_t most_straight = 250;  // operations at an order, of which straight-line code is made for all orders
constexpr std::size_t most_edges = 40;   // lanes whose first and last terms are added one by one

bool is_pair(Kind kind) { return kind == Kind::sine || kind == Kind::cosine; }

class TaylorEmitter {
public:
    TaylorEmitter(const Program& program, bool with_work)
        : r_(recurrences(program, with_work)),
          p_(r_.program),
          n_(static_cast<int>(p_.coordinates.size())),
          s_(p_.speeds.empty() ? n_ : static_cast<int>(p_.speeds.size())),
          with_work_(with_work) {
        for (const char* own : {"k", "number", "per_k", "order", "top", "out", "work", "last", "loaded", "wide", "lanes", "columns", "columns_count", "l", "put", "convolved", "squared", "gather", "gathered", "left", "right", "room", "one", "constant", "store",
                                "series", "quad", "clear", "solve", "terms"})
            names_.fresh(own);
        name_everything();
        for (int id = 0; id < size(); ++id) products_.push_back(products_of(id));
        find_packs();
        find_lanes();
    }

    Source emit() {
        mustache::data file;
        const auto set = [&](const char* key, const Lines& lines) {
            mustache::data list{mustache::data::type::list};
            for (const std::string& line : lines) list << line;
            file.set(key, list);
        };
        const auto number = [&](const char* key, std::size_t value) { file.set(key, std::to_string(value)); };
        set("first", order_zero());
        find_times();
        set("given", given());
        set("gathering", gathering());
        set("chain", chain());
        const std::size_t operations = operations_at_an_order();
        is_straight_ = packs_.empty() && has_edges() && operations <= most_straight;
        set("storing", storing());
        set("ones", ones());
        set("edges", edges());
        set("last", last());
        set("arrays", arrays());
        std::string rates;
        for (int i = 0; i < width(); ++i) rates += first(rate_of(i)) + ", ";
        file.set("rates_at_zero", rates);
        set("prepare", prepare());
        file.set("has_constants", !constants_.empty());
        file.set("scene", ascii_identifier(p_.name));
        file.set("formulation", p_.formulation);
        file.set("version", ALEMBERT_VERSION);
        file.set("products", fmt::format("{}", r_.products()));
        file.set("trigonometric", has_trigonometry());
        number("abi", series_abi_version);
        number("n", static_cast<std::size_t>(n_));
        number("s", static_cast<std::size_t>(s_));
        number("extra", with_work_ ? 1 : 0);
        number("width", static_cast<std::size_t>(width()));
        number("p", p_.parameters.size());
        number("most_order", static_cast<std::size_t>(most_order));
        number("most_order_quad", static_cast<std::size_t>(most_order_quad));
        number("k", constants_.size());
        std::string straight;
        for (int k = 1; k <= most_order; ++k) straight += fmt::format("{}one(constant<{}>{{}})", k > 1 ? " && " : "", k);
        file.set("has_straight", is_straight_);
        file.set("straight", straight);
        file.set("order_cost", fmt::format("{:.3g}", operation_cost * static_cast<double>(operations)));
        file.set("product_cost", fmt::format("{:.3g}", product_cost * products_eight_wide()));
        number("columns_count", static_cast<std::size_t>(columns_count_));
        number("single_count", static_cast<std::size_t>(single_count_));
        std::string values;
        for (const Quantity& par : p_.parameters) values += shortest(par.value) + ", ";
        file.set("parameter_values", values);
        mustache::mustache shape{std::string(template_taylor)};
        std::string elementary = mustache::mustache{std::string(template_elementary)}.render(file);
        elementary.pop_back();
        file.set("elementary", elementary);
        return {.file = ascii_identifier(p_.name) + "_taylor.cpp",
                .text = shape.render(file),
                .operations = p_.count(p_.right_hand_side()),
                .formulation = p_.formulation};
    }

private:
    struct Named {
        std::string now, first;            ///< the coefficient of this order; of order 0
        std::string rate;                  ///< k times the coefficient of this order; empty: not needed
        std::string inverse;               ///< of the first coefficient
    };
    struct Product {
        Weight weight;
        int a, b;
        bool a_rate = false, b_rate = false;
        bool weighed = false;  ///< the sum of a power, Σ (α(k−j) − j) a_{k−j} z_j
    };

    /// What is multiplied in one lane of the columns `left` and `right`.
    struct Lane {
        int a, b;
        bool a_rate, b_rate;
        auto operator<=>(const Lane&) const = default;
    };

    /// Nodes of the same shape whose arguments stand in lanes of the same order: one vector operation for all of them.
    struct Pack {
        std::vector<int> nodes;
        std::string column = {}, rates = {}, inverse = {};  ///< arrays [order][padded]; rates and inverse where needed
        bool by_lanes = false;                      ///< each lane computed, or copied from elsewhere, by itself
        bool is_copy = false;
        std::map<int, int> sources = {};            ///< argument of the first lane → pack that has all lanes' arguments
        std::vector<std::string> term_sums = {};    ///< one for each of the products
        std::vector<std::vector<Weight>> weights = {};  ///< of linear, bilinear terms, then products; empty: all the same
        std::vector<std::string> weight_arrays = {};    ///< where they differ
        std::size_t padded() const { return (nodes.size() + 7) / 8 * 8; }
    };
    struct Place {
        int pack = -1, lane = 0;
    };

    /// Operations in the lines of one order, on numbers or on eight lanes.
    std::size_t operations_at_an_order() {
        std::size_t count = 0;
        for (const Lines& part : {given(), chain(), storing()})
            for (const std::string& line : part) {
                std::size_t here = 0, blocks = 1;
                for (const char* sign : {" * ", " + ", " - ", " = "})
                    for (std::size_t at = line.find(sign); at != std::string::npos; at = line.find(sign, at + 1)) ++here;
                if (const std::size_t lanes = line.find("l < "); lanes != std::string::npos) blocks = std::stoul(line.substr(lanes + 4)) / 8;
                count += here * blocks;
            }
        return count;
    }

    /// Multiplications of eight lanes in all sums of products, over the square of the order.
    double products_eight_wide() const {
        double count = 0.5 * static_cast<double>(lanes_padded() / 8);
        for (const Pack& pack : packs_) {
            if (pack.is_copy) continue;
            for (const Product& x : products_[pack.nodes[0]])
                count += (x.a == x.b && x.a_rate == x.b_rate ? 0.25 : 0.5) * static_cast<double>(pack.padded() / 8);
        }
        return count;
    }

    int width() const { return n_ + s_ + (with_work_ ? 1 : 0); }
    const SeriesNode& node(int id) const { return r_.nodes[id]; }
    int size() const { return static_cast<int>(r_.nodes.size()); }

    bool has_trigonometry() const {
        if (std::any_of(r_.nodes.begin(), r_.nodes.end(), [](const SeriesNode& x) { return is_pair(x.kind); })) return true;
        for (int id = 0; id < p_.size(); ++id)
            if (p_[id].op == Op::sin || p_[id].op == Op::cos) return true;
        return false;
    }

    void name_everything() {
        named_.resize(r_.nodes.size());
        std::vector<std::string> speeds;
        for (const Quantity& q : p_.coordinates) names_.fresh(q.name);
        for (const Quantity& par : p_.parameters) names_.fresh(par.name);
        for (int id = 0; id < size(); ++id) {
            const SeriesNode& x = node(id);
            const auto i = static_cast<std::size_t>(x.index);
            Named& name = named_[id];
            const auto speed = [&] {
                if (p_.speeds.empty()) return ascii_identifier(p_.coordinates[i].name) + "_dot";
                const Quantity& u = p_.speeds[i];
                return ascii_identifier(u.rate_of < 0 ? u.name : p_.coordinates[static_cast<std::size_t>(u.rate_of)].name + "_dot");
            };
            switch (x.kind) {
                case Kind::coordinate: name.now = names_.fresh(p_.coordinates[i].name + "_k"); break;
                case Kind::speed: name.now = names_.fresh(speed() + "_k"); break;
                case Kind::time: name.now = names_.fresh("t_k"); break;
                case Kind::work: name.now = names_.fresh("work_k"); break;
                case Kind::residual: name.now = names_.numbered("row"); break;
                case Kind::unknown: name.now = x.index < r_.preferred ? names_.numbered("a") : names_.numbered("lambda"); break;
                case Kind::sine: name.now = names_.numbered("sin"); break;
                case Kind::cosine: name.now = names_.numbered("cos"); break;
                default: name.now = names_.numbered("z");
            }
            name.first = names_.fresh(name.now + "_0");
        }
    }

    std::vector<Product> products_of(int id) const {
        const SeriesNode& x = node(id);
        std::vector<Product> list;
        for (const auto* terms : {&x.bilinear, &x.implied})
            for (const auto& [weight, a, b] : *terms) list.push_back({weight, a, b});
        const Weight plus{1, -1}, minus{-1, -1};
        switch (x.kind) {
            case Kind::quotient: list.push_back({minus, x.w, id}); break;
            case Kind::root: list.push_back({minus, id, id}); break;
            case Kind::power:
                list.push_back({x.exponent, x.a, id, true, false});
                list.push_back({minus, id, x.a, true, false});
                break;
            case Kind::sine: case Kind::hyperbolic_sine: case Kind::hyperbolic_cosine: case Kind::area:
                list.push_back({plus, x.a, x.w, true, false});
                break;
            case Kind::cosine: list.push_back({minus, x.a, x.w, true, false}); break;
            case Kind::exponential: list.push_back({plus, x.a, id, true, false}); break;
            case Kind::ratio: list.push_back({minus, id, x.w, true, false}); break;
            case Kind::turn:
                list.push_back({plus, x.b, x.a, false, true});
                list.push_back({minus, x.a, x.b, false, true});
                list.push_back({minus, id, x.w, true, false});
                break;
            default: break;
        }
        return list;
    }

    bool is_packed(int id) const { return place_[id].pack >= 0; }

    void find_lanes() {
        for (int id = 0; id < size(); ++id) {
            if (is_packed(id)) continue;
            for (const Product& product : products_[id]) {
                const Lane lane = lane_of(product);
                if (lanes_.try_emplace(lane, static_cast<int>(lanes_.size())).second) lanes_in_order_.push_back(lane);
                for (const auto& [arg, rate] : {std::pair(lane.a, lane.a_rate), std::pair(lane.b, lane.b_rate)})
                    if (rate && named_[arg].rate.empty()) named_[arg].rate = names_.fresh(named_[arg].now + "_times");
            }
        }
        if (!has_edges()) return;
        for (const Lane& lane : lanes_in_order_)
            for (const int id : {lane.a, lane.b})
                if (!edges_.contains(id)) edges_[id] = {names_.fresh(named_[id].now + "_one"), names_.fresh(named_[id].now + "_before")};
    }

    static Lane lane_of(const Product& x) {
        return std::pair(x.a, x.a_rate) <= std::pair(x.b, x.b_rate) ? Lane{x.a, x.b, x.a_rate, x.b_rate} : Lane{x.b, x.a, x.b_rate, x.a_rate};
    }

    /// The first and the last term of each sum are added one by one: the coefficients of the order before need not come back from memory.
    bool has_edges() const { return lanes_in_order_.size() <= most_edges; }

    /// The sum of a product over orders below k; where ends are added one by one, without these.
    std::string inner_sum(const Product& product) const { return fmt::format("gathered[{}]", lanes_.at(lane_of(product))); }

    std::size_t lanes_padded() const { return (lanes_in_order_.size() + 7) / 8 * 8; }

    // Packs.

    /// What must be equal for two nodes to be lanes of one pack.
    std::string shape(int id) {
        const SeriesNode& x = node(id);
        std::string text = fmt::format("{} {} {}", static_cast<int>(x.kind), static_cast<int>(x.op), x.linear.size());
        for (const auto& [weight, a, b] : x.bilinear) text += a == b ? " s" : " p";
        if (x.kind == Kind::power) text += joined({piece(x.exponent, "")});
        // Which positions hold the same argument: it is then from one pack in all lanes.
        const std::vector<int> list = positions(id);
        for (std::size_t k = 0; k < list.size(); ++k)
            if (const auto same = std::find(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(k), list[k]) - list.begin(); same < static_cast<std::ptrdiff_t>(k))
                text += fmt::format(" {}={}", k, same);
        return text;
    }

    /// Arguments by position: linear ones, bilinear ones, a, b, w.
    std::vector<int> positions(int id) const {
        const SeriesNode& x = node(id);
        std::vector<int> list;
        for (const auto& [weight, a] : x.linear) list.push_back(a);
        for (const auto& [weight, a, b] : x.bilinear) list.insert(list.end(), {a, b});
        for (const int arg : {x.a, x.b, x.w}) if (arg >= 0) list.push_back(arg);
        return list;
    }

    bool can_be_packed(int id) const {
        switch (node(id).kind) {
            case Kind::time: case Kind::coordinate: case Kind::speed: case Kind::work: case Kind::unknown: case Kind::residual: return false;
            default: return true;
        }
    }

    int level(int id) const { return levels_[id]; }

    /// What the solve needs stands below what needs the solve: they are never lanes of one pack.
    void find_levels() {
        levels_.assign(static_cast<std::size_t>(size()), 0);
        int solve = 0;
        for (const bool is_known : {false, true}) {
            for (int id = 0; id < size(); ++id) {
                int highest = node(id).kind == Kind::unknown ? solve : 0;
                for (const int arg : arguments(id)) highest = std::max(highest, levels_[arg]);
                levels_[id] = highest + 1;
            }
            if (is_known) break;
            for (const int id : r_.residuals) solve = std::max(solve, levels_[id]);
            for (const SeriesEntry& e : r_.matrix)
                if (e.node >= 0) solve = std::max(solve, levels_[e.node]);
        }
    }

    void find_packs() {
        place_.resize(r_.nodes.size());
        find_levels();
        std::map<std::pair<int, std::string>, std::vector<int>> groups;
        for (int id = 0; id < size(); ++id)
            if (can_be_packed(id)) groups[{-level(id), shape(id)}].push_back(id);
        for (const auto& [key, group] : groups) {
            // From the last level to the first, so that users decide the order of lanes; nobody shares an argument in a pack.
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
            for (const std::vector<int>& part : parts) {
                const bool is_linear = products_[part[0]].empty();  // worth a pack only as an argument of one
                if (part.size() >= least_lanes && !is_linear) add_pack(part);
            }
            const int here = -key.first;
            for (std::size_t p = 0; p < packs_.size(); ++p)
                if (!packs_[p].is_copy && level(packs_[p].nodes[0]) == here && packs_[p].column.empty()) arrange(static_cast<int>(p));
        }
        for (std::size_t p = 0; p < packs_.size(); ++p)
            if (packs_[p].column.empty()) arrange(static_cast<int>(p));
        for (Pack& pack : packs_)
            if (const SeriesNode& x = node(pack.nodes[0]); x.kind == Kind::power && !pack.is_copy && !pack.by_lanes && x.exponent.constant < 0)
                for (const int id : pack.nodes) products_[id] = {{{1, -1}, node(id).a, id, false, false, true}};
        for (Pack& pack : packs_)
            if (!pack.is_copy) find_weights(pack);
    }

    /// Reorders `part` so that each of its nodes shares an argument with the node of `leader` in the same lane; false: there is no
    /// such order. What both take from the lanes of a third pack then stands in one order for both.
    bool follow(const std::vector<int>& leader, std::vector<int>& part) const {
        if (leader.size() != part.size()) return false;
        const std::size_t count = positions(leader[0]).size();
        if (positions(part[0]).size() != count) return false;
        for (std::size_t k = 0; k < count; ++k) {
            std::map<int, int> with;
            for (const int id : part) with[positions(id)[k]] = id;
            std::vector<int> ordered;
            for (const int id : leader)
                if (const auto found = with.find(positions(id)[k]); found != with.end() && can_be_packed(found->first)) ordered.push_back(found->second);
            if (with.size() != part.size() || ordered.size() != part.size()) continue;
            part = ordered;
            return true;
        }
        return false;
    }

    int add_pack(const std::vector<int>& nodes) {
        const int number = static_cast<int>(packs_.size());
        packs_.push_back({.nodes = nodes});
        for (std::size_t lane = 0; lane < nodes.size(); ++lane) place_[nodes[lane]] = {number, static_cast<int>(lane)};
        return number;
    }

    /// Names, and where each argument's lanes come from.
    void arrange(int number) {
        packs_[number].column = names_.numbered("p");
        const std::vector<int> nodes = packs_[number].nodes;
        std::vector<std::vector<int>> lists;  // by position, the lanes' arguments
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

    /// A pack with just these lanes: one that exists, a new one, or copies. −1: linear sums are better computed lane by lane.
    int pack_of(const std::vector<int>& list, bool is_linear) {
        for (std::size_t p = 0; p < packs_.size(); ++p)
            if (packs_[p].nodes == list) return static_cast<int>(p);
        const std::set<int> distinct(list.begin(), list.end());
        const auto same = [&](int id) { return can_be_packed(id) && !is_packed(id) && level(id) == level(list[0]) && shape(id) == shape(list[0]); };
        if (!is_linear && distinct.size() == list.size() && std::all_of(list.begin(), list.end(), same)) return add_pack(list);
        if (is_linear) return -1;
        packs_.push_back({.nodes = list, .column = names_.numbered("p"), .by_lanes = true, .is_copy = true});
        return static_cast<int>(packs_.size()) - 1;
    }

    void find_weights(Pack& pack) {
        const auto same = [](const Weight& a, const Weight& b) { return a.constant == b.constant && cln::equal(a.number, b.number); };
        const auto list = [&](int id) {
            std::vector<Weight> all;
            for (const auto& [weight, a] : node(id).linear) all.push_back(weight);
            for (const auto& [weight, a, b] : node(id).bilinear) all.push_back(weight);
            for (const Product& product : products_[id]) all.push_back(product.weight);
            return all;
        };
        const std::vector<Weight> first = list(pack.nodes[0]);
        for (std::size_t k = 0; k < first.size(); ++k) {
            std::vector<Weight> lanes;
            for (const int id : pack.nodes) lanes.push_back(list(id)[k]);
            const bool differ = std::any_of(lanes.begin(), lanes.end(), [&](const Weight& w) { return !same(w, lanes[0]); });
            pack.weight_arrays.push_back(differ && !pack.by_lanes ? names_.fresh(pack.column + "_w" + std::to_string(k)) : "");
            pack.weights.push_back(differ ? lanes : std::vector<Weight>());
        }
        for (std::size_t t = 0; t < products_[pack.nodes[0]].size(); ++t) pack.term_sums.push_back(names_.fresh(fmt::format("{}_s{}", pack.column, t)));
        for (const Product& product : products_[pack.nodes[0]])
            for (const auto& [arg, rate] : {std::pair(product.a, product.a_rate), std::pair(product.b, product.b_rate)}) {
                Pack& source = packs_[source_of(pack, arg)];
                if (rate && source.rates.empty()) source.rates = names_.fresh(source.column + "_rates");
            }
    }

    int source_of(const Pack& pack, int arg) const {
        if (arg == pack.nodes[0]) return place_[arg].pack;
        return pack.sources.at(arg);
    }

    // Text of weights and sums.

    std::string constant(int id) {
        const Node& x = p_[id];
        if (x.op == Op::variable) return fmt::format("par[{}]", x.variable.index);
        if (x.is_number()) return exact_text(x.number);
        auto place = std::find(constants_.begin(), constants_.end(), id);
        if (place == constants_.end()) place = constants_.insert(constants_.end(), id);
        return fmt::format("par[{}]", p_.parameters.size() + static_cast<std::size_t>(place - constants_.begin()));
    }

    Piece piece(const Weight& weight, const std::string& factor) {
        const Rational size = cln::abs(weight.number);
        std::string text;
        if (!cln::equal(size, 1)) text = exact_text(size);
        if (weight.constant >= 0) text += (text.empty() ? "" : " * ") + constant(weight.constant);
        if (!factor.empty()) text += (text.empty() ? "" : " * ") + factor;
        return {cln::minusp(weight.number), text.empty() ? "Real(1)" : text};
    }

    std::string now(int id) const {
        if (!is_packed(id)) return named_[id].now;
        const Pack& pack = packs_[place_[id].pack];
        return fmt::format("{}[{} * k + {}]", pack.column, pack.padded(), place_[id].lane);
    }
    std::string first(int id) const {
        return is_packed(id) ? fmt::format("{}[{}]", packs_[place_[id].pack].column, place_[id].lane) : named_[id].first;
    }

    /// How the text of a value names what it is made of: of one node, or of all lanes from l on.
    struct View {
        std::function<std::string(int)> now, first, inverse;
        std::function<Piece(std::size_t term, const Weight&, const std::string&)> piece;
        std::string sums;
    };

    std::string sums_of(int id) {
        if (products_[id].empty() || is_packed(id)) return "";
        std::vector<Piece> pieces;
        for (const Product& product : products_[id]) pieces.push_back(piece(product.weight, inner_sum(product)));
        return bracketed(joined(pieces));
    }

    View view(int id) {
        return {.now = [this](int arg) { return now(arg); },
                .first = [this](int arg) { return first(arg); },
                .inverse = [this](int arg) { return named_[arg].inverse; },
                .piece = [this](std::size_t, const Weight& weight, const std::string& factor) { return piece(weight, factor); },
                .sums = sums_of(id)};
    }

    View view(const Pack& pack) {
        const auto at = [this, &pack](int arg, const char* order) {
            const Pack& source = packs_[source_of(pack, arg)];
            return fmt::format("loaded({} + {}l)", source.column, *order == 'k' ? fmt::format("{} * k + ", source.padded()) : "");
        };
        const auto weighed = [this, &pack](std::size_t term, const Weight& weight, const std::string& factor) -> Piece {
            if (pack.weight_arrays[term].empty()) return piece(weight, factor);
            return {false, fmt::format("loaded({} + l) * {}", pack.weight_arrays[term], factor)};
        };
        const SeriesNode& x = node(pack.nodes[0]);
        std::vector<Piece> sums;
        for (std::size_t t = 0; t < pack.term_sums.size(); ++t)
            sums.push_back(weighed(x.linear.size() + x.bilinear.size() + t, products_[pack.nodes[0]][t].weight, fmt::format("loaded({} + l)", pack.term_sums[t])));
        return {.now = [at](int arg) { return at(arg, "k"); },
                .first = [at](int arg) { return at(arg, "0"); },
                .inverse = [this, &pack](int arg) { return fmt::format("loaded({} + l)", packs_[source_of(pack, arg)].inverse); },
                .piece = weighed,
                .sums = sums.empty() ? "" : bracketed(joined(sums))};
    }

    // Order 0.

    /// Small halves without `pow`.
    std::string power_at_zero(const Weight& exponent, const std::string& base) {
        const Rational size = cln::abs(exponent.number);
        if (exponent.constant >= 0 || !cln::equal(cln::denominator(size), 2) || size > 4) return fmt::format("pow({}, {})", base, joined({piece(exponent, "")}));
        std::string text = fmt::format("sqrt({})", base);
        for (Rational rest = size; rest > 1; rest = rest - 1) text = base + " * " + text;
        return cln::minusp(exponent.number) ? fmt::format("Real(1) / ({})", text) : text;
    }

    std::string value_at_zero(int id, const View& v) {
        const SeriesNode& x = node(id);
        const auto first = [&](int arg) { return v.first(arg); };
        const auto call = [&](const char* function) { return fmt::format("{}({})", function, first(x.a)); };
        std::vector<Piece> pieces;
        std::size_t term = 0;
        for (const auto& [weight, a] : x.linear) pieces.push_back(v.piece(term++, weight, first(a)));
        for (const auto& [weight, a, b] : x.bilinear) pieces.push_back(v.piece(term++, weight, first(a) + " * " + first(b)));
        for (const Weight& weight : x.constants) pieces.push_back(piece(weight, ""));
        switch (x.kind) {
            case Kind::quotient: return bracketed(joined(pieces)) + " / " + first(x.w);
            case Kind::root: return call("sqrt");
            case Kind::power: return power_at_zero(x.exponent, first(x.a));
            case Kind::sine: return call("sin");
            case Kind::cosine: return call("cos");
            case Kind::hyperbolic_sine: return call("sinh");
            case Kind::hyperbolic_cosine: return call("cosh");
            case Kind::exponential: return call("exp");
            case Kind::area: case Kind::ratio: return call(name_of(x.op));
            case Kind::turn: return fmt::format("atan2({}, {})", first(x.a), first(x.b));
            default: return joined(pieces);
        }
    }

    std::vector<int> arguments(int id) const {
        const SeriesNode& x = node(id);
        std::vector<int> list;
        for (const auto& [weight, a] : x.linear) list.push_back(a);
        for (const auto& [weight, a, b] : x.bilinear) list.insert(list.end(), {a, b});
        for (const int arg : {x.a, x.b}) if (arg >= 0) list.push_back(arg);
        if (x.kind == Kind::quotient || x.kind == Kind::ratio || x.kind == Kind::turn) list.push_back(x.w);
        return list;
    }

    /// Everything that is ready, then all sines that are ready at once, until nothing is left.
    Lines order_zero() {
        Lines lines;
        std::vector<char> done(r_.nodes.size(), 0);
        const auto ready = [&](int id) {
            const auto list = arguments(id);
            return done[id] == 0 && std::all_of(list.begin(), list.end(), [&](int arg) { return done[arg] != 0; });
        };
        bool solved = r_.matrix.empty();
        for (bool moved = true; moved;) {
            moved = false;
            for (int id = 0; id < size(); ++id) {
                if (!ready(id) || is_pair(node(id).kind) || (node(id).kind == Kind::unknown && !solved)) continue;
                if (const int pack = place_[id].pack; pack >= 0 && is_vector_at_zero(packs_[pack])) {
                    if (!std::all_of(packs_[pack].nodes.begin(), packs_[pack].nodes.end(), ready)) continue;
                    add_copies(lines, packs_[pack], true);
                    const View v = view(packs_[pack]);
                    if (node(id).kind == Kind::root || node(id).kind == Kind::power) {
                        const SeriesNode& leader = node(packs_[pack].nodes[0]);
                        const std::string base = packs_[source_of(packs_[pack], leader.a)].column + "[l]";
                        lines.push_back(fmt::format("for (int l = 0; l < {}; ++l) {}[l] = {};", packs_[pack].padded(), packs_[pack].column,
                                                    leader.kind == Kind::root ? "sqrt(" + base + ")" : power_at_zero(leader.exponent, base)));
                    }
                    else
                        lines.push_back(over_lanes(packs_[pack], packs_[pack].column + " + l", value_at_zero(packs_[pack].nodes[0], v)));
                    for (const int lane : packs_[pack].nodes) done[lane] = 1;
                } else {
                    if (node(id).kind != Kind::unknown) lines.push_back(statement_at_zero(id));
                    done[id] = 1;
                }
                moved = true;
            }
            if (moved) continue;
            std::vector<int> pairs;
            for (int id = 0; id < size() && pairs.size() < 8; ++id)
                if (node(id).kind == Kind::sine && ready(id)) pairs.push_back(id);
            if (!pairs.empty()) {
                add_sines(lines, pairs);
                for (const int id : pairs) done[id] = done[node(id).w] = 1;
                moved = true;
            } else if (!solved) {
                const Lines solution = solution_at_zero();
                lines.insert(lines.end(), solution.begin(), solution.end());
                solved = moved = true;
            }
        }
        for (const Pack& pack : packs_)  // those that only the products need
            if (pack.is_copy) add_copy(lines, pack, true);
        add_inverses(lines);
        return lines;
    }

    bool is_vector_at_zero(const Pack& pack) const {
        const SeriesNode& x = node(pack.nodes[0]);
        const auto plain = [&](int id) { return node(id).constants.empty(); };
        return !pack.by_lanes && (x.kind == Kind::sum || x.kind == Kind::quotient || x.kind == Kind::root || x.kind == Kind::power) &&
               std::all_of(pack.nodes.begin(), pack.nodes.end(), plain);
    }

    static std::string over_lanes(const Pack& pack, const std::string& to, const std::string& value) {
        return fmt::format("for (int l = 0; l < {}; l += lanes<Real>) put({}, {});", pack.padded(), to, value);
    }

    void add_copy(Lines& lines, const Pack& pack, bool at_zero) const {
        for (std::size_t lane = 0; lane < pack.nodes.size(); ++lane) {
            const int id = pack.nodes[lane];
            const std::string place = at_zero ? std::to_string(lane) : fmt::format("{} * k + {}", pack.padded(), lane);
            lines.push_back(fmt::format("{}[{}] = {};", pack.column, place, at_zero ? first(id) : now(id)));
        }
    }

    /// What a pack takes from lanes that stand elsewhere.
    void add_copies(Lines& lines, const Pack& pack, bool at_zero) const {
        for (const auto& [arg, source] : pack.sources)
            if (packs_[source].is_copy) add_copy(lines, packs_[source], at_zero);
    }

    void add_sines(Lines& lines, const std::vector<int>& pairs) {
        const auto declared = [&](int id) { return (is_packed(id) ? "" : "const Real ") + first(id); };
        const std::string both = names_.numbered("both");
        std::string angles;
        for (const int id : pairs) angles += (angles.empty() ? "" : ", ") + first(node(id).a);
        if (pairs.size() == 1) {
            lines.push_back(fmt::format("const auto {} = sincos({});", both, angles));
            lines.push_back(fmt::format("{} = {}.s;", declared(pairs[0]), both));
            lines.push_back(fmt::format("{} = {}.c;", declared(node(pairs[0]).w), both));
            return;
        }
        lines.push_back(fmt::format("const auto {} = sincos({});", both, angles));
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            lines.push_back(fmt::format("{} = {}.sine[{}];", declared(pairs[i]), both, i));
            lines.push_back(fmt::format("{} = {}.cosine[{}];", declared(node(pairs[i]).w), both, i));
        }
    }

    std::string statement_at_zero(int id) {
        const SeriesNode& x = node(id);
        switch (x.kind) {
            case Kind::time: return fmt::format("const Real {} = t;", first(id));
            case Kind::coordinate: return fmt::format("const Real {} = state[{}];", first(id), x.index);
            case Kind::speed: return fmt::format("const Real {} = state[{}];", first(id), n_ + x.index);
            case Kind::work: return fmt::format("const Real {} = state[{}];", first(id), n_ + s_);
            default: return fmt::format("{}{} = {};", is_packed(id) ? "" : "const Real ", first(id), value_at_zero(id, view(id)));
        }
    }

    /// Whose first coefficient a node is divided by; −1: none.
    int divisor(int id) const {
        const SeriesNode& x = node(id);
        if (x.kind == Kind::quotient || x.kind == Kind::ratio || x.kind == Kind::turn) return x.w;
        if (x.kind == Kind::power) return x.a;
        return x.kind == Kind::root ? id : -1;
    }

    void add_inverses(Lines& lines) {
        for (Pack& pack : packs_) {
            if (pack.is_copy || pack.by_lanes) continue;
            const int of = divisor(pack.nodes[0]);
            if (of < 0) continue;
            Pack& source = packs_[source_of(pack, of)];
            if (!source.inverse.empty()) continue;
            source.inverse = names_.fresh("per_" + source.column);
            lines.push_back(fmt::format("for (int l = 0; l < {}; l += lanes<Real>) put({} + l, Real(1) / loaded({} + l));", source.padded(),
                                        source.inverse, source.column));
        }
        for (int id = 0; id < size(); ++id) {
            if (is_packed(id) && !packs_[place_[id].pack].by_lanes) continue;
            const int of = divisor(id);
            if (of < 0 || !named_[of].inverse.empty()) continue;
            named_[of].inverse = names_.fresh("per_" + named_[of].now);
            lines.push_back(fmt::format("const Real {} = Real(1) / {};", named_[of].inverse, first(of)));
        }
        for (Pack& pack : packs_)
            for (std::size_t k = 0; k < pack.weight_arrays.size(); ++k)
                for (std::size_t lane = 0; lane < pack.nodes.size() && !pack.weight_arrays[k].empty(); ++lane)
                    weight_lines_.push_back(fmt::format("{}[{}] = {};", pack.weight_arrays[k], lane, joined({piece(pack.weights[k][lane], "")})));
        lines.insert(lines.begin(), weight_lines_.begin(), weight_lines_.end());
    }

    // The linear system: factors at order 0, then a function of the residuals.

    Lines solution_at_zero() {
        Program solver;
        std::map<int, std::string> leaves;
        Lines lines;
        std::vector<int> lower, right;
        for (const SeriesEntry& e : r_.matrix) {
            if (e.node < 0 && e.constant.constant < 0) {
                lower.push_back(solver.number(e.constant.number));
                continue;
            }
            const int variable = solver.variable({Variable::Kind::parameter, static_cast<int>(lower.size())});
            lower.push_back(variable);
            leaves[variable] = e.node >= 0 ? first(e.node) : names_.numbered("m");
            if (e.node < 0) lines.push_back(fmt::format("const Real {} = {};", leaves[variable], joined({piece(e.constant, "")})));
        }
        std::string residuals, results, firsts;
        for (std::size_t i = 0; i < r_.residuals.size(); ++i) {
            right.push_back(solver.variable({Variable::Kind::unknown, static_cast<int>(i)}));
            const std::string row = names_.numbered("r");
            leaves[right.back()] = row;
            residuals += fmt::format("{}const Real& {}", i > 0 ? ", " : "", row);
            results += fmt::format(", Real& {}", now(r_.unknowns[i]));
            firsts += fmt::format("{}{}", i > 0 ? ", " : "", first(r_.unknowns[i]));
        }
        const auto solution = solve_symmetric(solver, lower, right, r_.preferred);
        if (!solution) throw ModelError("the mass matrix is singular at every state: there are no accelerations to emit");
        // What does not depend on the residuals is done once.
        std::set<int> fixed;
        for (const int id : solver.needed(*solution))
            if (!solver[id].is_constant())
                for (const int arg : solver[id].args)
                    if (solver[arg].is_constant() && !solver[arg].args.empty()) fixed.insert(arg);
        std::vector<Goal> goals;
        for (const int id : fixed) goals.push_back({"Factors", names_.numbered("factor"), id, true});
        Writer factors(solver, names_, leaves);
        for (const Passage& section : factors.write(goals)) lines.insert(lines.end(), section.lines.begin(), section.lines.end());
        for (const Goal& goal : goals) {
            if (const std::string value = factors.value(goal.node); value != goal.name)
                lines.push_back(fmt::format("const Real {} = {};", goal.name, value));
            leaves[goal.node] = goal.name;
        }
        lines.push_back(fmt::format("const auto solve = [&]({}{}) __attribute__((always_inline)) {{", residuals, results));
        Writer writer(solver, names_, leaves);
        goals.clear();
        for (const int id : *solution) goals.push_back({"Solution", "", id});
        for (const Passage& section : writer.write(goals))
            for (const std::string& line : section.lines) lines.push_back("    " + line);
        for (std::size_t i = 0; i < solution->size(); ++i)
            lines.push_back(fmt::format("    {} = {};", now(r_.unknowns[i]), writer.value((*solution)[i])));
        lines.emplace_back("};");
        lines.push_back(fmt::format("Real {};", firsts));
        lines.push_back(solve_call([&](int id) { return first(id); }));
        return lines;
    }

    template <class Name>
    std::string solve_call(Name name) const {
        std::string args;
        for (const auto* list : {&r_.residuals, &r_.unknowns})
            for (const int id : *list) args += (args.empty() ? "" : ", ") + name(id);
        return fmt::format("solve({});", args);
    }

    // Order k.

    Lines given() const {
        Lines lines;
        for (int id = 0; id < size(); ++id) {
            const SeriesNode& x = node(id);
            const int place = x.kind == Kind::coordinate ? x.index : x.kind == Kind::speed ? n_ + x.index : x.kind == Kind::work ? n_ + s_ : -1;
            if (place < 0) continue;
            lines.push_back(fmt::format("const Real {} = per_k * last[{}];", now(id), place));
            lines.push_back(fmt::format("out[k * {} + {}] = {};", width(), place, now(id)));
        }
        return lines;
    }

    /// The coefficient of order k, sums of products being complete but for their ends.
    std::string value(int id, const View& v) {
        const SeriesNode& x = node(id);
        const auto now = [&](int arg) { return v.now(arg); };
        const auto first = [&](int arg) { return v.first(arg); };
        const auto boundary = [&](int a, int b) {
            if (a == b) return fmt::format("Real(2) * {} * {}", first(a), now(a));
            return fmt::format("({} * {} + {} * {})", first(a), now(b), now(a), first(b));
        };
        const std::string& sums = v.sums;
        std::vector<Piece> pieces;
        std::size_t term = 0;
        if (!sums.empty() && x.kind != Kind::quotient) pieces.push_back({false, sums});
        for (const auto& [weight, a] : x.linear) pieces.push_back(v.piece(term++, weight, now(a)));
        for (const auto& [weight, a, b] : x.bilinear) pieces.push_back(v.piece(term++, weight, boundary(a, b)));
        for (const auto& [weight, m, a] : x.implied) pieces.push_back(piece(weight, fmt::format("{} * {}", now(m), first(a))));
        const std::string shared = sums.empty() ? "" : "per_k * " + sums;
        switch (x.kind) {
            case Kind::time: return "Real(k == 1)";
            case Kind::quotient:
                pieces.push_back({true, fmt::format("{} * {}", now(x.w), first(id))});
                pieces.push_back({false, sums});
                return fmt::format("({}) * {}", joined(pieces), v.inverse(x.w));
            case Kind::root: return fmt::format("Real(0.5) * ({} + {}) * {}", sums, now(x.a), v.inverse(id));
            case Kind::power: return fmt::format("({} + {}) * {}", shared, bracketed(joined({piece(x.exponent, now(x.a) + " * " + first(id))})), v.inverse(x.a));
            case Kind::sine: case Kind::hyperbolic_sine: case Kind::hyperbolic_cosine: case Kind::area:
                return fmt::format("{} + {} * {}", shared, now(x.a), first(x.w));
            case Kind::cosine: return fmt::format("{} - {} * {}", shared, now(x.a), first(x.w));
            case Kind::exponential: return fmt::format("{} + {} * {}", shared, now(x.a), first(id));
            case Kind::ratio: return fmt::format("({} + {}) * {}", shared, now(x.a), v.inverse(x.w));
            case Kind::turn:
                return fmt::format("({} + {} * {} - {} * {}) * {}", shared, first(x.b), now(x.a), first(x.a), now(x.b), v.inverse(x.w));
            default: return joined(pieces);
        }
    }

    /// The coefficient of order k of a node that stands alone, where the ends of its sums of products are added one by one.
    TimelySum timely(int id) {
        const SeriesNode& x = node(id);
        TimelySum sum;
        const auto add_now = [&](const Weight& weight, const std::string& factor, int arg) {
            const Piece outside = piece(weight, "");
            sum.terms.push_back({.weight = outside.text == "Real(1)" ? "" : outside.text, .factor = factor, .late = now(arg), .ready = {.node = arg}, .negative = outside.negative});
        };
        const bool by_order = x.kind != Kind::sum && x.kind != Kind::residual && x.kind != Kind::quotient && x.kind != Kind::root;
        if (by_order) sum.inner = "per_k";
        if (const int of = divisor(id); of >= 0) sum.outer = (x.kind == Kind::root ? "Real(0.5) * " : "") + named_[of].inverse;

        for (const Product& product : products_[id]) {
            const Lane lane = lane_of(product);
            const auto add_part = [&](const std::string& times, const std::string& factor, const std::string& late, Moment ready) {
                const Piece weight = piece(product.weight, times);
                sum.terms.push_back({.weight = weight.text == "Real(1)" ? "" : weight.text, .factor = factor, .late = late, .ready = ready, .is_inner = true, .negative = weight.negative});
            };
            const auto add_edge = [&](int one, int before, bool before_rate, const char* twice) {
                add_part(before_rate ? "(number - Real(1))" : twice, edges_.at(one).first, edges_.at(before).second, {.node = before, .before = 1});
            };
            add_part("", "", inner_sum(product), {.node = size(), .before = 2, .delay = gathering_time});
            if (lane.a == lane.b && lane.a_rate == lane.b_rate) {
                add_edge(lane.a, lane.a, lane.a_rate, "Real(2)");
            } else {
                add_edge(lane.a, lane.b, lane.b_rate, "");
                add_edge(lane.b, lane.a, lane.a_rate, "");
            }
        }
        for (const auto& [weight, a] : x.linear) add_now(weight, "", a);
        for (const auto& [weight, a, b] : x.bilinear) {
            add_now(weight, (a == b ? "Real(2) * " : "") + first(a), b);
            if (a != b) add_now(weight, first(b), a);
        }
        for (const auto& [weight, m, a] : x.implied) add_now(weight, first(a), m);
        const Weight plus{1, -1}, minus{-1, -1};
        switch (x.kind) {
            case Kind::quotient: add_now(minus, first(id), x.w); break;
            case Kind::root: case Kind::ratio: add_now(plus, "", x.a); break;
            case Kind::power: add_now(x.exponent, first(id), x.a); break;
            case Kind::cosine: add_now(minus, first(x.w), x.a); break;
            case Kind::sine: case Kind::hyperbolic_sine: case Kind::hyperbolic_cosine: case Kind::area: add_now(plus, first(x.w), x.a); break;
            case Kind::exponential: add_now(plus, first(id), x.a); break;
            case Kind::turn:
                add_now(plus, first(x.b), x.a);
                add_now(minus, first(x.a), x.b);
                break;
            default: break;
        }
        return sum;
    }

    std::string value_alone(int id) {
        const auto sum = sums_.find(id);
        return sum != sums_.end() ? sum->second.text(times_) : value(id, view(id));
    }

    /// When each coefficient is ready: a few orders, one after the other.
    void find_times() {
        for (int id = 0; id < size(); ++id)
            if (has_edges() && !is_packed(id) && !products_[id].empty()) sums_.emplace(id, timely(id));
        for (std::vector<double>& times : times_) times.assign(r_.nodes.size() + 1, 0);
        for (int order = 0; order < orders_to_settle; ++order) {
            std::rotate(times_.begin(), times_.end() - 1, times_.end());
            std::vector<double>& here = times_[0];
            double solved = 0, stored = 0;
            for (int id = 0; id < size(); ++id) {
                const SeriesNode& x = node(id);
                const int state = x.kind == Kind::coordinate ? x.index : x.kind == Kind::speed ? n_ + x.index : -1;
                if (state >= 0) {
                    here[id] = times_[1][rate_of(state)] + operation_time;
                } else if (x.kind == Kind::unknown) {
                    here[id] = solved + solving_time * static_cast<double>(r_.unknowns.size());
                } else if (const auto sum = sums_.find(id); sum != sums_.end()) {
                    here[id] = sum->second.ready(times_);
                } else {
                    double latest = 0;
                    for (const int arg : arguments(id)) latest = std::max(latest, here[arg]);
                    here[id] = latest + (is_packed(id) ? packing_time : operation_time);
                }
                if (x.kind == Kind::residual) solved = std::max(solved, here[id]);
            }
            for (const Lane& lane : lanes_in_order_) stored = std::max({stored, here[lane.a], here[lane.b]});
            here.back() = stored;  // a row is read as a whole, when the last of its lanes has been stored
        }
    }

    /// Sums of products in packs: all of orders below k, needed by nothing but this order.
    Lines gathering() {
        Lines lines;
        if (!lanes_in_order_.empty()) lines.push_back(fmt::format("gather<{}, {}>(gathered, left, right, k);", lanes_padded(), has_edges() ? 2 : 1));
        for (const Pack& pack : packs_) {
            if (pack.is_copy) continue;
            for (std::size_t t = 0; t < pack.term_sums.size(); ++t) {
                const Product& x = products_[pack.nodes[0]][t];
                const auto array = [&](int arg, bool rate) -> const std::string& {
                    const Pack& source = packs_[source_of(pack, arg)];
                    return rate ? source.rates : source.column;
                };
                if (x.weighed)
                    lines.push_back(fmt::format("weighed<{}>({}, {}, {}, {}, k);", pack.padded(), pack.term_sums[t], array(x.a, false), array(x.b, false),
                                                joined({piece(node(pack.nodes[0]).exponent, "")})));
                else if (x.a == x.b && x.a_rate == x.b_rate)
                    lines.push_back(fmt::format("squared<{}>({}, {}, k);", pack.padded(), pack.term_sums[t], array(x.a, x.a_rate)));
                else
                    lines.push_back(fmt::format("convolved<{}>({}, {}, {}, k);", pack.padded(), pack.term_sums[t], array(x.a, x.a_rate), array(x.b, x.b_rate)));
            }
        }
        return lines;
    }

    Lines chain() {
        Lines lines;
        std::vector<char> done(r_.nodes.size(), 0);
        bool solved = r_.matrix.empty();
        const auto is_given = [&](int id) {
            const Kind kind = node(id).kind;
            return kind == Kind::coordinate || kind == Kind::speed || kind == Kind::work;
        };
        const auto ready = [&](int id) {
            if (node(id).kind == Kind::unknown) return solved;
            std::vector<int> list = arguments(id);
            for (const auto& [weight, m, a] : node(id).implied) list.push_back(m);  // its first coefficient is met at order 0 by the solve
            return std::all_of(list.begin(), list.end(), [&](int arg) { return done[arg] != 0; });
        };
        const auto finish = [&](int id) {
            if (!named_[id].rate.empty()) lines.push_back(fmt::format("const Real {} = number * {};", named_[id].rate, now(id)));
            done[id] = 1;
        };
        for (bool moved = true; moved;) {
            moved = false;
            for (int id = 0; id < size(); ++id) {
                if (done[id] != 0 || !ready(id)) continue;
                if (is_packed(id)) {
                    const auto& lanes = packs_[place_[id].pack].nodes;
                    if (!std::all_of(lanes.begin(), lanes.end(), ready)) continue;
                }
                moved = true;
                if (!is_packed(id)) {
                    if (!is_given(id) && node(id).kind != Kind::unknown) lines.push_back(fmt::format("const Real {} = {};", now(id), value_alone(id)));
                    finish(id);
                    continue;
                }
                const Pack& pack = packs_[place_[id].pack];
                if (pack.by_lanes) {
                    for (const int lane : pack.nodes) lines.push_back(fmt::format("{} = {};", now(lane), value(lane, view(lane))));
                } else {
                    add_copies(lines, pack, false);
                    lines.push_back(over_lanes(pack, fmt::format("{} + {} * k + l", pack.column, pack.padded()), value(pack.nodes[0], view(pack))));
                }
                for (const int lane : pack.nodes) finish(lane);
            }
            if (!moved && !solved) {
                std::string unknowns;
                for (const int a : r_.unknowns) unknowns += (unknowns.empty() ? "" : ", ") + now(a);
                lines.push_back(fmt::format("Real {};", unknowns));
                lines.push_back(solve_call([&](int a) { return now(a); }));
                solved = moved = true;
            }
        }
        for (const Pack& pack : packs_) {
            bool used_before = !pack.is_copy;  // copies that only products need
            for (const Pack& other : packs_)
                if (!other.is_copy && !other.by_lanes)
                    for (const auto& [arg, source] : other.sources) used_before = used_before || &packs_[source] == &pack;
            if (!used_before) add_copy(lines, pack, false);
            if (!pack.rates.empty())
                lines.push_back(over_lanes(pack, fmt::format("{} + {} * k + l", pack.rates, pack.padded()),
                                           fmt::format("number * loaded({} + {} * k + l)", pack.column, pack.padded())));
        }
        return lines;
    }

    /// The node of component i's rate.
    int rate_of(int i) const {
        if (i < n_) return r_.coordinate_rates.empty() ? n_ + i : r_.coordinate_rates[i];
        return i < n_ + s_ ? r_.accelerations[i - n_] : r_.work;
    }

    Lines last() const {
        Lines lines;
        for (int i = 0; i < width(); ++i) lines.push_back(fmt::format("last[{}] = {};", i, now(rate_of(i))));
        return lines;
    }

    std::string scalar(int id, bool rate) const { return rate ? named_[id].rate : now(id); }

    Lines storing() const {
        Lines lines;
        for (std::size_t l = 0; l < lanes_in_order_.size() && !is_straight_; ++l) {
            const Lane& lane = lanes_in_order_[l];
            lines.push_back(fmt::format("left[{} * k + {}] = {};", lanes_padded(), l, scalar(lane.a, lane.a_rate)));
            lines.push_back(fmt::format("right[{} * k + {}] = {};", lanes_padded(), l, scalar(lane.b, lane.b_rate)));
        }
        for (std::size_t first = 0; first < lanes_in_order_.size() && is_straight_; first += 8) {
            std::string left, right;
            for (std::size_t l = first; l < std::min(first + 8, lanes_in_order_.size()); ++l) {
                const Lane& lane = lanes_in_order_[l];
                left += ", " + scalar(lane.a, lane.a_rate);
                right += ", " + scalar(lane.b, lane.b_rate);
            }
            for (const auto& [name, values] : {std::pair("left", &left), std::pair("right", &right)})
                lines.push_back(fmt::format("store<{}, {}>({}, k{});", lanes_padded(), first, name, *values));
        }
        for (const auto& [id, names] : edges_) lines.push_back(fmt::format("{} = {};", names.second, now(id)));
        return lines;
    }

    /// The first coefficients for the edges, half at order 1: the only term of order 2 is then counted once.
    Lines ones() const {
        Lines lines;
        for (const auto& [id, names] : edges_)
            lines.push_back(fmt::format("{} = k == 1 ? Real(0.5) * {} : Real(2) * {};", names.first, now(id), names.first));
        return lines;
    }

    Lines edges() const {
        Lines lines;
        for (const auto& [id, names] : edges_) lines.push_back(fmt::format("Real {} = 0, {} = 0;", names.first, names.second));
        return lines;
    }

    Lines arrays() {
        Lines lines;
        std::size_t columns = 0, single = 0;
        const auto place = [&](const std::string& name, std::size_t rows, std::size_t& count) {
            if (name.empty()) return;
            lines.push_back(fmt::format("Real* const {} = columns + {}{};", name, count, &count == &columns ? " * room" : " + columns_count * room"));
            count += rows;
        };
        for (const Pack& pack : packs_)
            for (const std::string* name : {&pack.column, &pack.rates}) place(*name, pack.padded(), columns);
        if (!lanes_in_order_.empty()) {
            place("left", lanes_padded(), columns);
            place("right", lanes_padded(), columns);
            place("gathered", lanes_padded(), single);
        }
        for (const Pack& pack : packs_) {
            place(pack.inverse, pack.padded(), single);
            for (const auto* list : {&pack.term_sums, &pack.weight_arrays})
                for (const std::string& name : *list) place(name, pack.padded(), single);
        }
        columns_count_ = static_cast<int>(columns), single_count_ = static_cast<int>(single);
        return lines;
    }

    // What depends on parameters alone; called last, when all constants are known.

    Lines prepare() {
        Lines lines;
        std::map<int, std::string> known;
        const auto text = [&](int id) -> std::string {
            const Node& x = p_[id];
            if (x.op == Op::variable) return fmt::format("par[{}]", x.variable.index);
            if (x.is_number()) return exact_text(x.number);
            if (x.op == Op::pi) return "(Real(3.141592653589793) + Real(1.2246467991473532e-16) + Real(-2.9947698097183397e-33))";
            return known.at(id);
        };
        for (const int id : p_.needed(constants_)) {
            const Node& x = p_[id];
            if (x.args.empty()) continue;
            std::string value;
            if (x.op == Op::sum) {
                std::vector<Piece> pieces;
                for (std::size_t k = 0; k < x.args.size(); ++k) {
                    const Rational size = cln::abs(x.coefficients[k]);
                    pieces.push_back({cln::minusp(x.coefficients[k]), (cln::equal(size, 1) ? "" : exact_text(size) + " * ") + text(x.args[k])});
                }
                if (!cln::zerop(x.number)) pieces.push_back({cln::minusp(x.number), exact_text(cln::abs(x.number))});
                value = joined(pieces);
            } else if (x.op == Op::product) {
                std::string above, below;
                for (std::size_t k = 0; k < x.args.size(); ++k)
                    for (int e = 0; e < std::abs(x.exponents[k]); ++e)
                        (x.exponents[k] > 0 ? above : below) += (x.exponents[k] < 0 ? " / " : above.empty() ? "" : " * ") + text(x.args[k]);
                value = (above.empty() ? "Real(1)" : above) + below;
            } else {
                value = std::string(name_of(x.op)) + "(" + text(x.args[0]) + (x.args.size() > 1 ? ", " + text(x.args[1]) : "") + ")";
            }
            known[id] = names_.numbered("c");
            lines.push_back(fmt::format("const Real {} = {};", known[id], value));
        }
        for (std::size_t k = 0; k < constants_.size(); ++k)
            lines.push_back(fmt::format("par[{}] = {};", p_.parameters.size() + k, text(constants_[k])));
        return lines;
    }

    const Recurrences r_;
    const Program& p_;
    int n_, s_;
    bool with_work_;
    Names names_;
    std::vector<Named> named_;                    // of each node
    std::vector<std::vector<Product>> products_;  // that each node sums up
    std::vector<int> constants_;                  // of the Program, in the order of `par`
    bool is_straight_ = false;                    // all orders in straight-line code
    int columns_count_ = 0, single_count_ = 0;
    std::map<Lane, int> lanes_;
    std::vector<Lane> lanes_in_order_;
    std::map<int, std::pair<std::string, std::string>> edges_;  ///< of a factor: coefficient of order 1 (its rate's too), of the order before
    std::vector<Pack> packs_;
    std::vector<Place> place_;                    // of each node
    std::vector<int> levels_;
    Times times_;                                 ///< of each node; then of a row of lanes
    std::map<int, Timely> sums_;                  ///< of nodes that stand alone, where sums have edges
    Lines weight_lines_;
};

}  // namespace

Source emit_taylor(const Program& program, bool with_work) {
    if (program.singular)
        throw ModelError("the mass matrix is singular at every state: there are no accelerations to emit");
    return TaylorEmitter(program, with_work).emit();
}

}  // namespace alembert
