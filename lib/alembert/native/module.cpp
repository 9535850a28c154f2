// SPDX-License-Identifier: MIT
#include "alembert/native/module.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "alembert/base/argument.hpp"
#include "alembert/base/error.hpp"
#include "alembert/native/program_path.hpp"

namespace alembert {

ObjectFile::ObjectFile(const std::filesystem::path& path) {
    // An absolute path: a bare file name would be searched for in the system's library folders.
    void* const handle = dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr)
        throw CompileError(
            fmt::format("cannot load the solver: {}; delete it from the cache, and see that the folder "
                        "allows programs to run",
                        dlerror()));
    handle_ = std::shared_ptr<void>(handle, [](void* open) { dlclose(open); });
}

void* ObjectFile::find(const char* name) const {
    return dlsym(handle_.get(), name);
}

std::filesystem::path own_file() {
    Dl_info found;
    if (dladdr(reinterpret_cast<const void*>(&own_file), &found) == 0 || found.dli_fname == nullptr) return {};
    return found.dli_fname;
}

Module load(const std::filesystem::path& object) {
    const ObjectFile file(object);
    using Entry = const alembert_solver_table* (*)();
    const auto entry = reinterpret_cast<Entry>(file.find("alembert_solver"));
    const alembert_solver_table* const table = entry != nullptr ? entry() : nullptr;
    if (table == nullptr) throw CompileError(object.string() + " is not a solver: it has no alembert_solver()");
    if (table->abi != abi_version)
        throw CompileError(
            fmt::format("{} was emitted for version {} of the solver ABI, this program has version {}; "
                        "emit it again",
                        object.string(), table->abi, abi_version));
    const auto further = [&]<class Table>(const char* name, const Table*& place) {
        using Make = const Table* (*)();
        const auto make = reinterpret_cast<Make>(file.find(name));
        place = make != nullptr ? make() : nullptr;
    };
    const alembert_derivative_table* derivatives = nullptr;
    const alembert_projection_table* projection = nullptr;
    const alembert_pack_table* pack = nullptr;
    further("alembert_derivatives", derivatives);
    further("alembert_projection", projection);
    further("alembert_pack", pack);
    const alembert_function_table* functions = nullptr;
    further("alembert_functions", functions);
    using Count = int (*)();
    const auto independent = reinterpret_cast<Count>(file.find("alembert_independent_constraints"));
    return Module(std::shared_ptr<const alembert_solver_table>(file.handle(), table), derivatives, projection,
                  pack, functions, independent != nullptr ? std::optional(independent()) : std::nullopt);
}

const alembert_named_function* Module::function(const std::string& name) const {
    for (int k = 0; functions_ != nullptr && k < functions_->count; ++k)
        if (functions_->list[k].name == name) return &functions_->list[k];
    return nullptr;
}

std::vector<double> prepared(const Module& module, const std::vector<double>& values) {
    const alembert_solver_table& solver = module.table();
    const auto count = static_cast<std::size_t>(solver.parameters);
    if (!values.empty() && values.size() != count)
        throw std::invalid_argument(
            fmt::format("{} takes {} parameters, {} were given", solver.scene, count, values.size()));
    for (std::size_t k = 0; k < values.size(); ++k) argument::need_finite(solver.parameter_names[k], values[k]);
    std::vector<double> par(count + static_cast<std::size_t>(solver.constants));
    if (values.empty())
        std::copy_n(solver.parameter_values, count, par.begin());
    else
        std::copy(values.begin(), values.end(), par.begin());
    if (solver.prepare != nullptr) solver.prepare(par.data());
    return par;
}

}  // namespace alembert
