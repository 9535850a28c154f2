// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "present/report/branches.hpp"
#include "present/report/equilibria.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

constexpr int undecided = 2;

struct EquilibriumVerb : SceneOptions {
    std::vector<std::string> at;
    std::string follow, output, svg;
    int starts = 0;
};

/// NAME=FROM:TO
void read_range(const std::string& item, FollowOptions& options, const Scene& scene) {
    const std::size_t equals = item.find('='), colon = item.find(':', equals == item.npos ? 0 : equals);
    options.name = item.substr(0, equals);
    const auto read = [&](const std::string& text, double& value) {
        try {
            value = number_of(in_si(scene, options.name, text));
            return std::isfinite(value);
        } catch (const ModelError&) {
            return false;
        }
    };
    if (equals == item.npos || equals == 0 || colon == item.npos ||
        !read(item.substr(equals + 1, colon - equals - 1), options.from) ||
        !read(item.substr(colon + 1), options.to))
        throw ModelError(
            say("--follow {}: expected NAME=FROM:TO with two numbers, as in --follow Omega=0:20", item));
}

int follow(const EquilibriumVerb& verb) {
    Scene scene = scene_of(verb.scene);
    FollowOptions options{.by = verb.by, .at = overrides_of(verb.at, scene)};
    read_range(verb.follow, options, scene);
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
        show(as_text(found));
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
    if (!verb.follow.empty()) return follow(verb);
    if (!verb.output.empty() || !verb.svg.empty())
        throw ModelError(say("-o and --svg show branches; expected --follow NAME=FROM:TO with them"));
    Scene scene = scene_of(verb.scene);
    EquilibriumOptions options{.by = verb.by, .at = overrides_of(verb.at, scene), .starts = verb.starts};
    Progress progress;
    options.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    const Equilibria found = equilibria(std::move(scene), options);
    progress.wipe();
    warn(found.warnings);
    if (verb.json)
        show(as_json(found));
    else
        show(as_text(found));
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
            add_by_option(verb, options.by);
            add_at_option(verb, options.at);
            verb.add_option("--follow", options.follow,
                            say("follows all over a parameter, with folds and bifurcations"))
                .type_name(values::interval);
            verb.add_option("--starts", options.starts, say("Newton's method starts that often"))
                .type_name(values::count)
                .between(1, 1000000);
            verb.add_option("-o,--output", options.output, say("CSV file of the branches"))
                .type_name(values::file);
            verb.add_option("--svg", options.svg, say("picture of the branches")).type_name(values::file);
        });
}

}  // namespace alembert
