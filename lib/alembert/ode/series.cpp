// SPDX-License-Identifier: MIT
#include "alembert/ode/series.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "alembert/base/error.hpp"
#include "alembert/native/module.hpp"

namespace alembert {

SeriesModule load_series(const std::filesystem::path& object) {
    const ObjectFile file(object);
    using Entry = const alembert_series_table* (*)();
    const auto entry = reinterpret_cast<Entry>(file.find("alembert_series"));
    const alembert_series_table* const table = entry != nullptr ? entry() : nullptr;
    if (table == nullptr)
        throw CompileError(object.string() + " holds no Taylor series: it has no alembert_series()");
    if (table->abi != series_abi_version)
        throw CompileError(fmt::format(
            "{} was emitted for version {} of the series' ABI, this program has version {}; emit it again",
            object.string(), table->abi, series_abi_version));
    return {file.handle(), table};
}

Series make_series(const SeriesModule& module, const std::vector<double>& values) {
    const auto count = static_cast<std::size_t>(module->parameters);
    if (!values.empty() && values.size() != count)
        throw std::invalid_argument(
            fmt::format("{} takes {} parameters, {} were given", module->scene, count, values.size()));
    auto par = std::make_shared<std::vector<double>>(count + static_cast<std::size_t>(module->constants));
    std::copy_n(values.empty() ? module->parameter_values : values.data(), count, par->begin());
    module->prepare(par->data());
    return {.module = module,
            .par = par,
            .width = module->coordinates + module->speeds + module->extra,
            .workspace = module->workspace};
}

}  // namespace alembert
