// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/emit.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "commands/pipeline.hpp"

namespace alembert {

int emit_files(const Request& request) {
    const Derived d = derived(request);
    const Choice choice = lowered(d, request);
    const Source source = emit(choice.program);
    std::error_code failed;
    std::filesystem::create_directories(request.output, failed);
    if (failed) throw CompileError(fmt::format("cannot make the folder '{}': {}", request.output, failed.message()));
    const std::string path = (std::filesystem::path(request.output) / source.file).string();
    write_file(path, source.text);
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
        if (has_contacts) result["closed"] = Json::array();
        std::cout << result.dump(2) << "\n";
    } else {
        fmt::print("{}\n{}; {} operations a right-hand side ({} additions, {} multiplications, {} divisions, {} "
                   "functions)\n",
                   path, source.formulation, source.operations.total(), source.operations.additions,
                   source.operations.multiplications, source.operations.divisions, source.operations.functions);
        if (choice.runner_up)
            fmt::print("next best: {}, {} operations\n", choice.runner_up->formulation, choice.runner_up->cost.operations);
        if (has_contacts)
            fmt::print("this is the motion while all gaps are open; simulate emits the other contact modes as it meets them\n");
    }
    return 0;
}

}  // namespace alembert
