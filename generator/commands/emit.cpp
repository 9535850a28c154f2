// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/emit.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "commands/output.hpp"
#include "commands/pipeline.hpp"
#include "lower/differentiate.hpp"

namespace alembert {

int emit_files(const Request& request) {
    const Derived d = derived(request, Use::run);
    const Choice choice = lowered(d, request);
    std::optional<Differentiated> derivatives;
    if (request.jacobian) {
        derivatives = differentiated(choice.program, {.parameters = true, .power = true});
        if (!derivatives) throw ModelError("the derivatives of the right-hand side are too long to be written out; leave out --jacobian");
    }
    const Source source = emit(derivatives ? derivatives->program : choice.program, {.batch = request.batch});
    std::error_code failed;
    std::filesystem::create_directories(request.output, failed);
    if (failed) throw CompileError(fmt::format("cannot make the folder '{}': {}", request.output, failed.message()));
    const std::string path = (std::filesystem::path(request.output) / source.file).string();
    write_file(path, source.text, request);
    const bool has_contacts = !d.mechanism.unilateral.empty();
    if (request.json) {
        Json result;
        result["files"] = {path};
        result["operations"] = source.operations.total();
        result["formulation"] = source.formulation;
        result["chain"] = choice.cost.chain;
        if (choice.runner_up) {
            const RunnerUp& second = *choice.runner_up;
            result["runner_up"] = {{"formulation", second.formulation}, {"operations", second.cost.operations}, {"chain", second.cost.chain}};
            result["runner_up_operations"] = second.cost.operations;
        }
        if (derivatives) {
            result["jacobian_operations"] = derivatives->operations.total();
            result["jacobian_route"] = derivatives->route;
        }
        if (has_contacts) result["closed"] = Json::array();
        std::cout << as_text(result);
    } else {
        fmt::print("{}\n{}; {} operations a right-hand side ({} additions, {} multiplications, {} divisions, {} "
                   "functions)\n",
                   path, source.formulation, source.operations.total(), source.operations.additions,
                   source.operations.multiplications, source.operations.divisions, source.operations.functions);
        if (derivatives)
            fmt::print("the Jacobian takes {} operations ({})\n", derivatives->operations.total(), derivatives->route);
        if (choice.runner_up)
            fmt::print("next best: {}, {} operations\n", choice.runner_up->formulation, choice.runner_up->cost.operations);
        if (has_contacts)
            fmt::print("this is the motion while all gaps are open; simulate emits the other contact modes as it meets them\n");
    }
    return 0;
}

}  // namespace alembert
