// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/emission.hpp"

#include "report/page.hpp"

namespace alembert {

Json as_json(const Emission& e, const std::string& path) {
    Json result;
    result["files"] = {path};
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

std::string as_text(const Emission& e, const std::string& path) {
    const Operations& count = e.source.operations;
    std::string page;
    put(page,
        "{}\n{}; {} operations a right-hand side ({} additions, {} multiplications, {} divisions, {} functions)\n",
        path, e.source.formulation, count.total(), count.additions, count.multiplications, count.divisions,
        count.functions);
    if (e.derivatives)
        put(page, "the Jacobian takes {} operations ({})\n", e.derivatives->operations.total(),
            e.derivatives->route);
    if (e.choice.runner_up)
        put(page, "next best: {}, {} operations\n", e.choice.runner_up->formulation,
            e.choice.runner_up->cost.operations);
    if (!e.mechanism.unilateral.empty())
        page +=
            "this is the motion while all gaps are open; simulate emits the other contact modes as it meets "
            "them\n";
    return page;
}

}  // namespace alembert
