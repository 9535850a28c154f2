// SPDX-License-Identifier: MIT
#pragma once

/// A loaded solver: the object file stays in the process as long as a copy of its Module lives.
///
///     const Module module = load(compile(text, "pendulum", {}).object);
///     const int n = module.table().coordinates;
///
/// A file that is linked with the program is one too, without a compiler or a file at run time:
///
///     #include "pendulum.hpp"                        // beside the emitted pendulum.cpp
///     const Module module = linked(pendulum::tables());
///
/// `load` throws CompileError if the file does not load, has no `alembert_solver`, or was emitted for another
/// version of the ABI (the message gives both numbers); `linked` in the last case.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "alembert/native/abi.hpp"

namespace alembert {

/// An emitted and compiled file. It is unloaded with its last copy. The constructor throws CompileError.
class ObjectFile {
public:
    explicit ObjectFile(const std::filesystem::path& path);
    /// The `extern "C"` function that the file exports as `name`; null if it has none.
    void* find(const char* name) const;
    const std::shared_ptr<void>& handle() const { return handle_; }

private:
    std::shared_ptr<void> handle_;
};

class Module {
public:
    /// The tables of a solver, which `alive` keeps alive: those of a file (`load`), or of code in memory.
    Module(const std::shared_ptr<const void>& alive, const alembert_tables& all)
        : table_(alive, static_cast<const alembert_solver_table*>(all.solver)),
          derivatives_(static_cast<const alembert_derivative_table*>(all.derivatives)),
          projection_(static_cast<const alembert_projection_table*>(all.projection)),
          pack_(static_cast<const alembert_pack_table*>(all.pack)),
          functions_(static_cast<const alembert_function_table*>(all.functions)),
          independent_(all.independent_constraints) {}

    const alembert_solver_table& table() const { return *table_; }
    /// Null if the file was emitted without derivatives.
    const alembert_derivative_table* derivatives() const { return derivatives_; }
    /// Of the table's constraints, the first ones, from which the others follow.
    int independent_constraints() const { return independent_; }
    /// Null if the system has no constraints.
    const alembert_projection_table* projection() const { return projection_; }
    /// Null if the file was emitted without `--batch`.
    const alembert_pack_table* pack() const { return pack_; }
    /// Null if the file was emitted without functions of their own.
    const alembert_function_table* functions() const { return functions_; }
    /// A function of that name (`emit --functions`); null if the file has none.
    const alembert_named_function* function(const std::string& name) const;

    /// The components of the state on which the accelerations depend, and the rates if the speeds are not the
    /// rates; −1 among them stands for time. Null if nobody has told.
    const std::shared_ptr<const std::vector<int>>& needed_state() const { return needed_state_; }
    void tell_needed_state(std::vector<int> components) {
        needed_state_ = std::make_shared<const std::vector<int>>(std::move(components));
    }

private:
    std::shared_ptr<const alembert_solver_table> table_;  ///< owns what the tables point to
    const alembert_derivative_table* derivatives_;        ///< in it
    const alembert_projection_table* projection_;         ///< in it
    const alembert_pack_table* pack_;                     ///< in it
    const alembert_function_table* functions_;            ///< in it
    int independent_;
    std::shared_ptr<const std::vector<int>> needed_state_ = {};
};

Module load(const std::filesystem::path& object);
/// Of what `tables()` of an emitted header returns.
Module linked(const void* tables);

/// The array `par` of the ABI: `values` (the scene's own if empty) followed by the constants that `prepare`
/// computes from them. Throws std::invalid_argument if there are too many or too few values, and for one
/// that is not finite.
std::vector<double> prepared(const Module& module, const std::vector<double>& values = {});

}  // namespace alembert
