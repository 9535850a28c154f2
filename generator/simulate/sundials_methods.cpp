// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/sundials_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "alembert/base/error.hpp"
#include "alembert/native/process.hpp"
#include "base/language/say.hpp"
#include "plugins/backend.hpp"

namespace alembert {

namespace {

constexpr std::string_view cvode = "cvode", ida = "ida";

/// The back end, in the same folder as this program; it stays loaded until the end.
const Backend& backend(std::string_view method) {
    const std::filesystem::path beside = beside_this_program("alembert-sundials.so");
    if (beside.empty())
        throw CompileError(
            say("method '{}' needs SUNDIALS, with which this program was not built; install "
                "libsundials-dev (Debian) and build "
                "again, or take bdf or radau",
                method));
    static const ObjectFile file(beside);
    using Function = const Backend* (*)();
    const auto function = reinterpret_cast<Function>(file.find(backend_function));
    const Backend* const found = function != nullptr ? function() : nullptr;
    if (found == nullptr || found->version != backend_version)
        throw CompileError(
            say("{} belongs to another version of this program; build both again", beside.string()));
    return *found;
}

}  // namespace

bool is_sundials(std::string_view method) {
    return method == cvode || method == ida;
}

void need_sundials(const Derived& d, std::string_view method) {
    if (method == ida && !d.mechanism.constraints.empty() && !d.equations.speeds_are_rates())
        throw ModelError(say("method '{}' does not follow {}; take {}", method,
                             say("constraints in generalized speeds (the formalism 'routh' has them in rates)"),
                             say("cvode, radau (stiff both) or dop853")));
    const auto& constraints = d.mechanism.constraints;
    const auto tied = std::find_if(constraints.begin(), constraints.end(),
                                   [](const Mechanism::Constraint& c) { return c.tie.has_value(); });
    if (method == ida && tied != constraints.end())
        throw ModelError(
            say("method '{}' does not follow {}; take {}", method,
                say("rows of constraints that depend on each other at some poses, as '{}' does", tied->name),
                say("cvode, radau (stiff both) or dop853")));
}

Integrator sundials_integrator(std::string_view method, const Module& module,
                               const std::vector<double>& parameters, bool has_signs) {
    const Backend& own = backend(method);
    return method == ida ? own.ida(module, parameters, has_signs) : own.cvode();
}

}  // namespace alembert
