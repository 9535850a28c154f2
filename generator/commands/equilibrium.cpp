// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <iostream>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/vary.hpp"
#include "commands/verb.hpp"
#include "present/report/branches.hpp"
#include "present/report/equilibria.hpp"
#include "stability/judged_equilibria.hpp"

namespace alembert {

namespace {

constexpr int undecided = 2;

struct EquilibriumVerb : SceneOptions {
    std::vector<std::string> at;
    std::string vary, output, svg;
    int starts = 0;
};

int follow(const EquilibriumVerb& verb) {
    Scene scene = scene_of(verb.scene);
    const Axis range = interval_of("--vary", verb.vary, scene);
    FollowOptions options{
        .by = verb.by, .at = overrides_of(verb.at, scene), .name = range.name, .from = range.from, .to = range.to};
    Progress progress;
    options.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    const Branches found = branches(std::move(scene), options);
    progress.wipe();
    warn(found.warnings);
    if (!verb.output.empty()) write_file(verb.output, as_csv(found), {verb.scene});
    if (!verb.svg.empty()) write_file(verb.svg, as_svg(found), {verb.scene, verb.output});
    if (verb.json)
        show(as_json(found));
    else
        show_page(as_text(found), verb.full);
    if (!found.branches.empty()) return 0;
    std::cout.flush();
    warn(
        {say("{}: no equilibrium or steady motion was found for {} from {} to {}. This is no proof that "
             "there is none\n",
             verb.scene, found.parameter, found.from, found.to)});
    return undecided;
}

int run(const EquilibriumVerb& verb) {
    check_output(verb.output, FileForm::csv, {verb.scene});
    check_output(verb.svg, FileForm::picture, {verb.scene});
    if (!verb.vary.empty()) return follow(verb);
    if (!verb.output.empty() || !verb.svg.empty())
        throw ModelError(say("-o and --svg show branches; expected --vary NAME=FROM:TO with them"));
    Scene scene = scene_of(verb.scene);
    EquilibriumOptions options{.by = verb.by, .at = overrides_of(verb.at, scene), .starts = verb.starts};
    Progress progress;
    options.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    const Equilibria found = judged_equilibria(scene, options);
    progress.wipe();
    warn(found.warnings);
    if (verb.json)
        show(as_json(found));
    else
        show_page(as_text(found), verb.full);
    if (!found.list.empty()) return 0;
    std::cout.flush();
    warn({fmt::format("{}: {}\n", verb.scene, found.nothing)});
    return undecided;
}

}  // namespace

void add_equilibrium(CLI::App& app, Chosen& chosen) {
    add_scene_verb<EquilibriumVerb>(
        app, chosen,
        {.name = "equilibrium",
         .about = say("finds where the system can stay at rest, or move steadily"),
         .example = "alembert equilibrium scenes/textbook/watt_governor.toml"},
        run, [](Verb& verb, EquilibriumVerb& options) {
            verb.take("--by", options.by);
            verb.take("--at", options.at);
            verb.take("--vary", options.vary, say("follows all over a parameter, with folds and bifurcations"));
            verb.add_option("--starts", options.starts, say("Newton's method starts that often"))
                .type_name(values::count)
                .between(1, 1000000);
            verb.take("--output", options.output, say("CSV file of the branches"));
            verb.take("--svg", options.svg, say("picture of the branches"));
            verb.take("--full", options.full);
        });
}

}  // namespace alembert
