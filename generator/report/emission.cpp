// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/emission.hpp"

#include "emit/layout.hpp"
#include "report/page.hpp"

namespace alembert {

Json as_json(const Emission& e, const std::vector<std::string>& paths) {
    Json result;
    result["files"] = paths;
    result["operations"] = e.source.operations.total();
    result["formulation"] = e.source.formulation;
    result["chain"] = e.choice.cost.chain;
    if (e.choice.runner_up) {
        const RunnerUp& second = *e.choice.runner_up;
        result["runner_up"] = {{"formulation", second.formulation},
                               {"operations", second.cost.operations},
                               {"chain", second.cost.chain}};
        result["runner_up_operations"] = second.cost.operations;
    }
    if (e.derivatives) {
        result["jacobian_operations"] = e.derivatives->operations.total();
        result["jacobian_route"] = e.derivatives->route;
    }
    if (!e.mechanism.unilateral.empty()) result["closed"] = Json::array();
    return result;
}

std::string as_text(const Emission& e, const std::vector<std::string>& paths) {
    const Operations& count = e.source.operations;
    std::string page;
    for (const std::string& path : paths) put(page, "{}\n", path);
    put(page, "{}; {} a right-hand side ({}, {}, {}, {})\n", e.source.formulation,
        counted(count.total(), "operation"), counted(count.additions, "addition"),
        counted(count.multiplications, "multiplication"), counted(count.divisions, "division"),
        counted(count.functions, "function"));
    if (e.derivatives)
        put(page, "the Jacobian takes {} ({})\n", counted(e.derivatives->operations.total(), "operation"),
            e.derivatives->route);
    if (e.choice.runner_up)
        put(page, "next best: {}, {}\n", e.choice.runner_up->formulation,
            counted(e.choice.runner_up->cost.operations, "operation"));
    if (!e.mechanism.unilateral.empty())
        page +=
            "this is the motion while all gaps are open; simulate emits the other contact modes as it meets "
            "them\n";
    return page;
}

}  // namespace alembert
