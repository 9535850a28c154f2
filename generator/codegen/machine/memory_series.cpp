// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/memory_series.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "codegen/emit/names.hpp"
#include "codegen/machine/memory_code.hpp"
#include "codegen/machine/series_steps.hpp"
#include "program/motion_system.hpp"

namespace alembert {

namespace {

using namespace machine;

/// A compiled series that has taken the place of that in memory. Its constants are others, and follow from the
/// parameters when these change.
struct Replacement {
    explicit Replacement(const SeriesModule& compiled)
        : module(compiled),
          par(static_cast<std::size_t>(compiled->parameters + compiled->constants)),
          room(static_cast<std::size_t>(compiled->workspace) + 8) {
        void* start = room.data();
        std::size_t bytes = room.size() * sizeof(double);
        work = static_cast<double*>(std::align(64, bytes - 64, start, bytes));
    }

    void operator()(double t, const double* state, const double* parameters, int order, double* out) {
        if (!is_prepared || !std::equal(par.begin(), par.begin() + module->parameters, parameters)) {
            std::copy_n(parameters, module->parameters, par.begin());
            module->prepare(par.data());
            is_prepared = true;
        }
        module->series(t, state, par.data(), order, out, work);
    }

    SeriesModule module;
    std::vector<double> par, room;
    double* work = nullptr;
    bool is_prepared = false;
};

/// All that the code needs at run time.
struct Running {
    SeriesCode code;
    std::unique_ptr<Replacement> replacement;
    std::string scene;
    std::vector<double> values;
    std::shared_ptr<const void> memory;
    alembert_series_table table{};
};

void expand(double t, const double* state, const double* par, int order, double* out, double* work,
            Running* self) {
    if (!self->replacement)
        self->code.expand(t, state, par, order, out, work);
    else
        (*self->replacement)(t, state, par, order, out);
}

class SeriesBuilding {
public:
    SeriesBuilding(const Program& program, bool with_work)
        : steps_(series_steps(recurrences(program, with_work))),
          zero_words_(steps_.at_zero),
          order_words_(steps_.at_order),
          running_(std::make_shared<Running>()) {}

    std::optional<MemorySeries> series() {
        describe();
        alembert_series_table& table = running_->table;
        const Readiness zero(steps_.at_zero, nodes_of(steps_.first)),
            order(steps_.at_order, nodes_of(steps_.next));
        table.prepare = running_->code.fix = [](double*) {};
        if (!zero_words_.constants().empty())
            code_.write(lines_of_constants(steps_.at_zero, zero_words_, zero), table.prepare);
        if (!order_words_.constants().empty())
            code_.write(lines_of_constants(steps_.at_order, order_words_, order), running_->code.fix);
        code_.write(lines_of(steps_.at_zero, zero_words_, zero, steps_.first), running_->code.first);
        code_.write(lines_of(steps_.at_order, order_words_, order, steps_.next), running_->code.next);
        // The table's function: `expand` with one more argument after those of the table's.
        code_.write_call(reinterpret_cast<const void*>(expand), running_.get(), table.series);
        running_->memory = code_.placed();
        if (!running_->memory) return std::nullopt;
        return MemorySeries{.module = {running_, &running_->table},
                            .go_over = [running = running_](const SeriesModule& compiled) {
                                running->replacement = std::make_unique<Replacement>(compiled);
                            }};
    }

private:
    void describe() {
        const Program& p = steps_.at_zero;
        const auto count = [](std::size_t size) { return static_cast<int>(size); };
        Running& r = *running_;
        r.code.places = steps_.places;
        r.code.place_of_factor = steps_.place_of_factor;
        r.code.fixed = count(steps_.at_order.parameters.size() + order_words_.constants().size());
        r.scene = ascii_identifier(p.name);
        for (const Quantity& parameter : p.parameters) r.values.push_back(parameter.value);
        alembert_series_table& t = r.table;
        t.abi = series_abi_version;
        t.coordinates = count(p.coordinates.size());
        t.speeds = count(speeds_of(p));
        t.extra = r.code.places.width - t.coordinates - t.speeds;
        t.parameters = count(p.parameters.size());
        t.constants = count(zero_words_.constants().size());
        t.workspace = workspace_of(r.code);
        const SeriesCost cost = cost_in_memory(steps_);
        t.order_cost = cost.order;
        t.product_cost = cost.product;
        t.scene = r.scene.c_str();
        t.parameter_values = r.values.data();
    }

    SeriesSteps steps_;
    Vocabulary zero_words_, order_words_;
    std::shared_ptr<Running> running_;
    MemoryCode code_;
};

}  // namespace

std::optional<MemorySeries> memory_series(const Program& program, bool with_work) {
    if (!can_run()) return std::nullopt;
    return SeriesBuilding(program, with_work).series();
}

}  // namespace alembert
