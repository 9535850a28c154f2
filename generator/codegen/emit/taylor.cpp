// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/taylor.hpp"

#include <fmt/format.h>

#include <kainjow/mustache.hpp>

#include "alembert/ode/series.hpp"
#include "codegen/emit/elementary.hpp"
#include "codegen/emit/numbers.hpp"
#include "codegen/emit/series_writer.hpp"
#include "codegen/emit/templates.hpp"
#include "program/motion_system.hpp"

namespace alembert {

namespace {

namespace mustache = kainjow::mustache;
using Kind = SeriesNode::Kind;

/// The elementary functions that order 0 and the constants need.
std::set<Op> elementary_functions(const Recurrences& r, const std::vector<int>& constants) {
    std::set<Op> functions;
    for (const int id : r.program.needed(constants))
        if (r.program[id].op >= Op::sin) functions.insert(r.program[id].op);
    for (const SeriesNode& x : r.nodes) switch (x.kind) {
            case Kind::sine:
            case Kind::cosine:
                functions.insert(Op::sin);
                break;
            case Kind::hyperbolic_sine:
                functions.insert(Op::sinh);
                break;
            case Kind::hyperbolic_cosine:
                functions.insert(Op::cosh);
                break;
            case Kind::exponential:
                functions.insert(Op::exp);
                break;
            case Kind::root:
                functions.insert(Op::sqrt);
                break;
            case Kind::power:
                functions.insert({Op::sqrt, Op::pow});
                break;
            case Kind::area:
            case Kind::ratio:
                functions.insert(x.op);
                break;
            case Kind::turn:
                functions.insert(Op::atan2);
                break;
            default:
                break;
        }
    return functions;
}

mustache::data list_of(const std::vector<CodeStatement>& statements) {
    mustache::data list{mustache::data::type::list};
    for (const CodeStatement& statement : statements) list << statement.text;
    return list;
}

std::size_t cost_of(const std::vector<CodeStatement>& statements) {
    std::size_t cost = 0;
    for (const CodeStatement& statement : statements) cost += static_cast<std::size_t>(statement.cost);
    return cost;
}

/// The calls of all orders in straight-line code.
std::string straight_calls() {
    std::string calls;
    for (int k = 1; k <= most_order; ++k) calls += fmt::format("{}one(constant<{}>{{}})", k > 1 ? " && " : "", k);
    return calls;
}

void describe(mustache::data& file, const Recurrences& r, std::size_t width) {
    const Program& p = r.program;
    const auto number = [&](const char* key, std::size_t value) { file.set(key, std::to_string(value)); };
    const std::size_t n = p.coordinates.size(), s = speeds_of(p);
    file.set("scene", ascii_identifier(p.name));
    file.set("formulation", p.formulation);
    file.set("version", ALEMBERT_VERSION);
    file.set("products", fmt::format("{}", r.products()));
    number("abi", series_abi_version);
    number("n", n);
    number("s", s);
    number("extra", width - n - s);
    number("width", width);
    number("p", p.parameters.size());
    number("most_order", static_cast<std::size_t>(most_order));
    number("most_order_quad", static_cast<std::size_t>(most_order_quad));
    std::string values;
    for (const Quantity& par : p.parameters) values += shortest(par.value) + ", ";
    file.set("parameter_values", values);
}

SeriesCost cost_of_orders(std::size_t operations, const SeriesLanes& lanes) {
    return {.order = processor::operation_cost * static_cast<double>(operations),
            .product = processor::product_cost * lanes.products_eight_wide()};
}

}  // namespace

SeriesCost series_cost(const Program& program) {
    const Recurrences recurred = recurrences(program);
    const SeriesLanes lanes(recurred);
    SeriesWriter writer(recurred, lanes);
    writer.order_zero();
    writer.schedule();
    std::size_t operations = cost_of(writer.given());
    writer.gathering();
    operations += cost_of(writer.chain());
    operations += cost_of(writer.storing(false));
    return cost_of_orders(operations, lanes);
}

Source emit_taylor(const Program& program, bool with_work) {
    const Recurrences recurred = recurrences(program, with_work);
    const SeriesLanes lanes(recurred);
    SeriesWriter writer(recurred, lanes);
    mustache::data file;
    describe(file, recurred, static_cast<std::size_t>(writer.width()));
    file.set("first", list_of(writer.order_zero()));
    writer.schedule();
    const std::vector<CodeStatement> given = writer.given();
    file.set("given", list_of(given));
    file.set("gathering", list_of(writer.gathering()));
    const std::vector<CodeStatement> chain = writer.chain();
    file.set("chain", list_of(chain));
    const std::size_t operations = cost_of(given) + cost_of(chain) + cost_of(writer.storing(false));
    const bool is_straight = lanes.packs().empty() && lanes.has_edges() && operations <= processor::most_straight;
    file.set("storing", list_of(writer.storing(is_straight)));
    file.set("ones", list_of(writer.ones()));
    file.set("edges", list_of(writer.edges()));
    file.set("last", list_of(writer.last()));
    const SeriesWriter::Arrays arrays = writer.arrays();
    file.set("arrays", list_of(arrays.lines));
    file.set("columns_count", std::to_string(arrays.columns));
    file.set("single_count", std::to_string(arrays.single));
    file.set("rates_at_zero", writer.rates_at_zero());
    file.set("prepare", list_of(writer.prepare()));
    file.set("k", std::to_string(writer.constants().size()));
    file.set("has_straight", is_straight);
    file.set("straight", straight_calls());
    const SeriesCost cost = cost_of_orders(operations, lanes);
    file.set("order_cost", fmt::format("{:.3g}", cost.order));
    file.set("product_cost", fmt::format("{:.3g}", cost.product));
    const std::set<Op> functions = elementary_functions(recurred, writer.constants());
    set_elementary(file, functions);
    add_elementary(file);
    return {.file = ascii_identifier(program.name) + "_taylor.cpp",
            .text = mustache::mustache{std::string(template_taylor)}.render(file),
            .operations = recurred.program.count(recurred.program.right_hand_side()),
            .formulation = recurred.program.formulation};
}

}  // namespace alembert
