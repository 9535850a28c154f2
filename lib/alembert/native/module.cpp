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

namespace {

/// `alive` keeps the tables alive; `name` is that of the file in messages.
Module module_of(const alembert_tables& all, const std::shared_ptr<const void>& alive, const std::string& name) {
    const auto* const table = static_cast<const alembert_solver_table*>(all.solver);
    if (table->abi != abi_version)
        throw CompileError(
            fmt::format("{} was emitted for version {} of the solver ABI, this program has version {}; "
                        "emit it again",
                        name, table->abi, abi_version));
    return {alive, all};
}

}  // namespace

Module load(const std::filesystem::path& object) {
    const ObjectFile file(object);
    const auto called = [&](const char* name) {
        using Entry = const void* (*)();
        const auto entry = reinterpret_cast<Entry>(file.find(name));
        return entry != nullptr ? entry() : nullptr;
    };
    alembert_tables all{.solver = called(module_entries.solver),
                        .derivatives = called(module_entries.derivatives),
                        .projection = called(module_entries.projection),
                        .pack = called(module_entries.pack),
                        .functions = called(module_entries.functions),
                        .independent_constraints = 0};
    if (all.solver == nullptr)
        throw CompileError(object.string() + " is not a solver: it has no alembert_solver()");
    using Count = int (*)();
    const auto count = reinterpret_cast<Count>(file.find(module_entries.independent_constraints));
    all.independent_constraints =
        count != nullptr ? count() : static_cast<const alembert_solver_table*>(all.solver)->constraints;
    return module_of(all, file.handle(), object.string());
}

Module linked(const void* tables) {
    const auto& all = *static_cast<const alembert_tables*>(tables);
    return module_of(all, std::shared_ptr<const void>(tables, [](const void*) {}),
                     fmt::format("the system '{}'", static_cast<const alembert_solver_table*>(all.solver)->scene));
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
