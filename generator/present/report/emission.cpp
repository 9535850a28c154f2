// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/emission.hpp"

#include <fmt/ranges.h>

#include "base/language/say.hpp"
#include "codegen/emit/layout.hpp"
#include "model/formalism/joint_tree.hpp"
#include "present/report/page.hpp"

namespace alembert {

namespace {

/// What the program found in the scene that the scene does not say.
std::string findings(const JointTree& tree) {
    const TreeFindings& found = tree.findings;
    std::string page;
    if (found.in_positions)
        say_on(page, "the positions of the masses are those of a tree of {}\n",
               shown_count(static_cast<long>(tree.joints.size()), to_say("joint")));
    if (!found.merged.empty())
        say_on(page, "masses at the point of another one, with which they count: {}\n",
               fmt::join(found.merged, ", "));
    if (!found.at_rest.empty())
        say_on(page, "masses that never move, which the equations leave out: {}\n",
               fmt::join(found.at_rest, ", "));
    if (is_planar_in_space(tree)) page += say("all bodies move in parallel planes: the motion is planar\n");
    return page;
}

Json findings_json(const JointTree& tree) {
    const TreeFindings& found = tree.findings;
    return {{"joints", tree.joints.size()},
            {"in_positions", found.in_positions},
            {"same_point", found.merged},
            {"at_rest", found.at_rest},
            {"planar_in_space", is_planar_in_space(tree)}};
}

}  // namespace

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
    if (e.choice.tree) result["tree"] = findings_json(*e.choice.tree);
    if (e.derivatives) {
        result["jacobian_operations"] = e.derivatives->operations.total();
        result["jacobian_route"] = e.derivatives->route;
    }
    for (const NamedFunction& f : e.functions)
        result["functions"].push_back(
            {{"name", f.name}, {"rows", f.rows}, {"columns", f.columns}, {"operations", f.operations.total()}});
    if (!e.mechanism.unilateral.empty()) result["closed"] = Json::array();
    return result;
}

std::string as_text(const Emission& e, const std::vector<std::string>& paths) {
    const Operations& count = e.source.operations;
    std::string page;
    for (const std::string& path : paths) put(page, "{}\n", path);
    say_on(page, "{}; {} a right-hand side ({}, {}, {}, {})\n", translated_parts(e.source.formulation),
           shown_count(count.total(), to_say("operation")), shown_count(count.additions, to_say("addition")),
           shown_count(count.multiplications, to_say("multiplication")),
           shown_count(count.divisions, to_say("division")), shown_count(count.functions, to_say("function")));
    if (e.derivatives)
        say_on(page, "the Jacobian takes {} ({})\n",
               shown_count(e.derivatives->operations.total(), to_say("operation")), e.derivatives->route);
    for (const NamedFunction& f : e.functions)
        say_on(page, "{}: {} x {}, {}\n", f.name, f.rows, f.columns,
               shown_count(f.operations.total(), to_say("operation")));
    if (e.choice.runner_up)
        say_on(page, "next best: {}, {}\n", translated_parts(e.choice.runner_up->formulation),
               shown_count(e.choice.runner_up->cost.operations, to_say("operation")));
    if (e.choice.tree) page += findings(*e.choice.tree);
    if (!e.mechanism.unilateral.empty())
        page +=
            say("this is the motion while all gaps are open; simulate emits the other contact modes as it meets "
                "them\n");
    return page;
}

}  // namespace alembert
