// SPDX-License-Identifier: GPL-2.0-or-later
#include "system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

namespace alembert {

namespace {

double time_of(const std::vector<double>& times, std::size_t k) {
    return times.size() == 1 ? times[0] : times[k];
}

/// Numbers at a multiple of 64 bytes, as the functions for packs want them.
class Aligned {
public:
    explicit Aligned(std::size_t count) : memory_(count + 8) {
        const auto address = reinterpret_cast<std::uintptr_t>(memory_.data());
        begin_ = memory_.data() + (64 - address % 64) % 64 / sizeof(double);
    }
    double* data() { return begin_; }

private:
    std::vector<double> memory_;
    double* begin_;
};

/// The arguments of the functions for packs: every number as often as there are lanes.
struct Packed {
    std::size_t lanes;
    Aligned t, state, rate, par, out;

    Packed(std::size_t lane_count, std::size_t width, std::size_t results, const std::vector<double>& parameters)
        : lanes(lane_count),
          t(lanes),
          state(width * lanes),
          rate(width * lanes),
          par(std::max<std::size_t>(1, parameters.size()) * lanes),
          out(results * lanes) {
        for (std::size_t i = 0; i < parameters.size(); ++i)
            std::fill_n(par.data() + i * lanes, lanes, parameters[i]);
    }
    void set_times(const std::vector<double>& times, std::size_t row) {
        for (std::size_t lane = 0; lane < lanes; ++lane) t.data()[lane] = time_of(times, row + lane);
    }
    /// From the rows that begin with `row`, each of `width` numbers, to the places from `place`; zeros stay where
    /// `rows` is null.
    void gather(Aligned& to, std::size_t place, const double* rows, std::size_t row, std::size_t width) const {
        if (rows == nullptr) return;
        for (std::size_t lane = 0; lane < lanes; ++lane)
            for (std::size_t i = 0; i < width; ++i)
                to.data()[(place + i) * lanes + lane] = rows[(row + lane) * width + i];
    }
    void scatter(double* rows, std::size_t row, std::size_t width) {
        for (std::size_t lane = 0; lane < lanes; ++lane)
            for (std::size_t i = 0; i < width; ++i) rows[(row + lane) * width + i] = out.data()[i * lanes + lane];
    }
};

/// Calls `part(from, to)` for pieces of 0 … count on all cores, each piece a multiple of eight.
template <typename Part>
void on_all_cores(std::size_t count, const Part& part) {
    constexpr std::size_t worth_a_thread = 2048;
    if (count < 2 * worth_a_thread) return part(std::size_t{0}, count);
    static const std::size_t most = std::max(1U, std::thread::hardware_concurrency());  // asking takes 2 us
    const std::size_t threads = std::min(count / worth_a_thread, most);
    if (threads == 1) return part(std::size_t{0}, count);
    const std::size_t piece = (count / threads + 7) / 8 * 8;
    std::vector<std::thread> workers;
    for (std::size_t from = piece; from < count; from += piece)
        workers.emplace_back([&part, from, to = std::min(count, from + piece)] { part(from, to); });
    part(std::size_t{0}, std::min(count, piece));
    for (std::thread& worker : workers) worker.join();
}

}  // namespace

CompiledSystem::CompiledSystem(Module module, std::string source)
    : module_(std::move(module)),
      source_(std::make_shared<const std::string>(std::move(source))),
      n_(module_.table().coordinates),
      s_(module_.table().speeds),
      parameters_(std::make_shared<const Parameters>(Parameters{
          {module_.table().parameter_values, module_.table().parameter_values + module_.table().parameters},
          prepared(module_)})) {}

void CompiledSystem::set_parameters(const std::vector<double>& values) {
    const std::size_t count = parameter_values().size();
    if (values.size() != count)
        throw std::invalid_argument(fmt::format("{} values for {} parameters", values.size(), count));
    parameters_ = std::make_shared<const Parameters>(Parameters{values, prepared(module_, values)});
}

CompiledSystem CompiledSystem::with_inputs(const std::vector<double>& values) const {
    const auto [first, count] = inputs_;
    if (values.size() != count)
        throw std::invalid_argument(
            fmt::format("{} values for {} inputs from outside; one for each is wanted", values.size(), count));
    Parameters given = *parameters_;
    for (std::vector<double>* const list : {&given.values, &given.prepared})
        std::copy(values.begin(), values.end(), list->begin() + static_cast<std::ptrdiff_t>(first));
    CompiledSystem result = *this;
    result.parameters_ = std::make_shared<const Parameters>(std::move(given));
    return result;
}

void CompiledSystem::rhs_of_range(const std::vector<double>& times, const double* states, std::size_t from,
                                  std::size_t to, double* rates) const {
    const auto width = static_cast<std::size_t>(dimension());
    const alembert_pack_table* const pack = module_.pack();
    std::size_t k = from;
    if (pack != nullptr) {
        Packed packed(static_cast<std::size_t>(pack->lanes), width, width, parameters_->prepared);
        for (; k + packed.lanes <= to; k += packed.lanes) {
            packed.set_times(times, k);
            packed.gather(packed.state, 0, states, k, width);
            pack->rhs(packed.t.data(), packed.state.data(), packed.par.data(), packed.out.data());
            packed.scatter(rates, k, width);
        }
    }
    for (; k < to; ++k) rhs(time_of(times, k), states + k * width, rates + k * width);
}

void CompiledSystem::function_of_range(const alembert_named_function& f, const std::vector<double>& times,
                                       const StateRows& states, std::size_t from, std::size_t to,
                                       double* values) const {
    const double *const q = states.q, *const v = states.v, *const a = states.a;
    const auto n = static_cast<std::size_t>(n_), size = static_cast<std::size_t>(f.rows * f.columns);
    std::size_t k = from;
    if (f.pack != nullptr && module_.pack() != nullptr) {
        Packed packed(static_cast<std::size_t>(module_.pack()->lanes), 2 * n, size, parameters_->prepared);
        for (; k + packed.lanes <= to; k += packed.lanes) {
            packed.set_times(times, k);
            packed.gather(packed.state, 0, q, k, n);
            packed.gather(packed.state, n, v, k, n);
            packed.gather(packed.rate, n, a, k, n);
            f.pack(packed.t.data(), packed.state.data(), packed.rate.data(), packed.par.data(), packed.out.data());
            packed.scatter(values, k, size);
        }
    }
    std::vector<double> state(2 * n, 0.0), rate(2 * n, 0.0);
    const auto take = [n](std::vector<double>& to_array, std::size_t place, const double* from_rows,
                          std::size_t row) {
        if (from_rows != nullptr) std::copy_n(from_rows + row * n, n, to_array.begin() + static_cast<long>(place));
    };
    for (; k < to; ++k) {
        take(state, 0, q, k);
        take(state, n, v, k);
        take(rate, n, a, k);
        f.call(time_of(times, k), state.data(), rate.data(), par(), values + k * size);
    }
}

std::vector<std::string> CompiledSystem::function_names() const {
    std::vector<std::string> names;
    if (module_.functions() != nullptr)
        for (int k = 0; k < module_.functions()->count; ++k) names.emplace_back(module_.functions()->list[k].name);
    return names;
}

void CompiledSystem::function_of_many(const alembert_named_function& f, const std::vector<double>& times,
                                      const StateRows& states, std::size_t count, double* values) const {
    on_all_cores(count,
                 [&](std::size_t from, std::size_t to) { function_of_range(f, times, states, from, to, values); });
}

void CompiledSystem::rhs_of_many(const std::vector<double>& times, const double* states, std::size_t count,
                                 double* rates) const {
    on_all_cores(count, [&](std::size_t from, std::size_t to) { rhs_of_range(times, states, from, to, rates); });
}

void CompiledSystem::jacobian_of_many(const std::vector<double>& times, const double* states, std::size_t count,
                                      double* values) const {
    const alembert_derivative_table* const table = module_.derivatives();
    if (table == nullptr) throw std::invalid_argument("this system was compiled without derivatives");
    const auto width = static_cast<std::size_t>(dimension());
    on_all_cores(count, [&](std::size_t from, std::size_t to) {
        std::vector<double> entries(static_cast<std::size_t>(std::max(1, table->entries)));
        for (std::size_t k = from; k < to; ++k) {
            double* const dense = values + k * width * width;
            std::fill_n(dense, width * width, 0.0);
            table->jacobian(time_of(times, k), states + k * width, par(), entries.data());
            for (int i = 0; i < table->entries; ++i)
                if (table->rows[i] < dimension())  // the row beyond is the power's
                    dense[static_cast<std::size_t>(table->rows[i]) * width +
                          static_cast<std::size_t>(table->columns[i])] = entries[static_cast<std::size_t>(i)];
        }
    });
}

void CompiledSystem::mass_of_many(const std::vector<double>& times, const double* states, std::size_t count,
                                  double* mass, double* forcing) const {
    if (module_.table().mass_forcing == nullptr)
        throw std::invalid_argument("the mass matrix of this system is not emitted: it has too many joints");
    const auto width = static_cast<std::size_t>(dimension()), s = static_cast<std::size_t>(s_);
    on_all_cores(count, [&](std::size_t from, std::size_t to) {
        std::vector<double> f(s);
        for (std::size_t k = from; k < to; ++k)
            module_.table().mass_forcing(time_of(times, k), states + k * width, par(), mass + k * s * s,
                                         forcing != nullptr ? forcing + k * s : f.data());
    });
}

void CompiledSystem::energy_of_many(const std::vector<double>& times, const double* states, std::size_t count,
                                    double* energies) const {
    const auto width = static_cast<std::size_t>(dimension());
    on_all_cores(count, [&](std::size_t from, std::size_t to) {
        std::vector<double> rate(width);
        double told[4], jacobi = 0;
        for (std::size_t k = from; k < to; ++k) {
            const double t = time_of(times, k);
            rhs(t, states + k * width, rate.data());
            module_.table().energy(t, states + k * width, rate.data(), par(), told, &jacobi);
            std::copy_n(told, 3, energies + 3 * k);
        }
    });
}

}  // namespace alembert
