// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/memory_series_packs.hpp"

#include <functional>
#include <utility>

#include "codegen/machine/memory_code.hpp"
#include "codegen/machine/series_steps.hpp"

namespace alembert {

namespace {

using namespace machine;

/// For one of the eight systems, in units of the time that a step takes besides its series, about 45 ns: a
/// component of the state and an operation at each order, and a product per square of the order. Fitted to ten
/// systems of 4 to 36 components, whose series took within 20 % of this.
constexpr double cost_of_component = 0.011, cost_of_operation = 0.0006, cost_of_product = 0.00107;

void write_packed(MemoryCode& functions, const Program& program, const Vocabulary& words, const Readiness& ready,
                  const FunctionTask& task, auto& place) {
    const int lanes = functions.lanes();
    const Lines inside = lines_of_packs(program, words, ready, task, Sines::inside, lanes);
    std::size_t other = 0;
    if (inside.largest >= 0)
        other = functions.write_aside(lines_of_packs(program, words, ready, task, Sines::called, lanes));
    functions.write(inside, place, other);
}

void describe(PackSeries& packs, const SeriesSteps& steps, std::size_t constants, std::size_t fixed_constants) {
    packs.places = steps.places;
    packs.products = steps.pairs;
    packs.factors = steps.factors;
    packs.fixed = static_cast<int>(steps.at_order.parameters.size() + fixed_constants);
    packs.parameters = static_cast<int>(steps.at_zero.parameters.size());
    packs.constants = static_cast<int>(constants);
    const Operations operations = steps.at_order.count(nodes_of(steps.next));
    packs.order_cost = cost_of_component * steps.places.width +
                       cost_of_operation * (operations.total() + static_cast<int>(steps.next.results.size()));
    double terms = 0;
    for (const PackSeries::Product& product : packs.products) terms += product.left == product.right ? 0.25 : 0.5;
    packs.product_cost = cost_of_product * terms;
}

}  // namespace

std::shared_ptr<const PackSeries> memory_series_packs(const Program& program, bool with_work,
                                                      std::optional<int> wished) {
    const int lanes = wished.value_or(lanes_of_processor());
    if (!can_run(lanes)) return nullptr;
    const SeriesSteps steps = series_steps(recurrences(program, with_work), true);
    const Vocabulary zero_words(steps.at_zero), order_words(steps.at_order);
    const Readiness zero(steps.at_zero, nodes_of(steps.first)), order(steps.at_order, nodes_of(steps.next));
    const auto packs = std::make_shared<PackSeries>();
    describe(*packs, steps, zero_words.constants().size(), order_words.constants().size());
    MemoryCode alone, packed(lanes);
    packs->prepare = packs->fix = [](double*) {};
    if (!zero_words.constants().empty())
        alone.write(lines_of_constants(steps.at_zero, zero_words, zero), packs->prepare);
    if (!order_words.constants().empty())
        packed.write(lines_of_constants_in_packs(steps.at_order, order_words, order, lanes), packs->fix);
    write_packed(packed, steps.at_zero, zero_words, zero, steps.first, packs->first);
    write_packed(packed, steps.at_order, order_words, order, steps.next, packs->next);
    auto code = std::make_shared<std::pair<std::shared_ptr<const void>, std::shared_ptr<const void>>>(
        alone.placed(), packed.placed());
    if (!code->first || !code->second) return nullptr;
    packs->code = std::move(code);
    return packs;
}

}  // namespace alembert
