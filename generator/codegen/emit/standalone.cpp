// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/standalone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>

#include "alembert/base/argument.hpp"
#include "codegen/emit/comment.hpp"
#include "codegen/emit/interface.hpp"
#include "codegen/emit/numbers.hpp"
#include "codegen/emit/projection_text.hpp"
#include "codegen/emit/solver_functions.hpp"
#include "codegen/emit/templates.hpp"
#include "codegen/emit/vocabulary.hpp"

namespace alembert {

std::vector<std::string> quick_rows(const std::vector<InputTimeScale>& quick) {
    std::vector<std::string> rows;
    for (const InputTimeScale& q : quick)
        rows.push_back(fmt::format("    {{{}, {}, {}, {}}}", shortest(q.from), shortest(q.to), shortest(q.enter),
                                   shortest(q.step)));
    return rows;
}

namespace {

/// Whether an event has accelerations in it.
bool needs_rates(const Program& program) {
    const std::vector<int> nodes = program.needed(program.nodes_of(Group::event));
    return std::any_of(nodes.begin(), nodes.end(), [&](int id) {
        return program[id].op == Op::variable && program[id].variable.kind == Variable::Kind::acceleration;
    });
}

}  // namespace

SourceFile standalone(const Program& program, const StandaloneStart& start, const EmitOptions& options) {
    const CodeLanguage language = options.language;
    const Vocabulary words(program);
    const std::string scene = ascii_identifier(program.name), ending = language == CodeLanguage::c ? "c" : "cpp",
                      name = scene + "_main." + ending;
    std::string initial, columns;
    for (const double x : start.state) initial += shortest(x) + ", ";
    for (const auto* names : {&words.q(), &words.u()})
        for (const std::string& column : *names) columns += "," + label_of(column);
    kainjow::mustache::data file;
    file.set("scene", scene);
    file.set("space", namespace_of(program));
    file.set("version", ALEMBERT_VERSION);
    file.set("command", comment_text(options.command));
    file.set("c", language == CodeLanguage::c);
    file.set("compile", language == CodeLanguage::c
                            ? fmt::format("cc -std=c99 -O2 {} {}.c -lm -o {}", name, scene, scene)
                            : fmt::format("c++ -std=c++20 -O2 {} -o {}", name, scene));
    file.set("n", std::to_string(words.q().size()));
    file.set("s", std::to_string(words.u().size()));
    file.set("p", std::to_string(words.par().size()));
    file.set("k", std::to_string(words.constants().size()));
    file.set("constraints", std::to_string(program.nodes_of(Group::velocity).size()));
    file.set("has_project", !program.nodes_of(Group::projected).empty());
    file.set("has_energy", !energy(program).results.empty());
    const std::vector<std::string> quick = quick_rows(start.quick_times);
    file.set("has_quick", !quick.empty());
    file.set("quick_times", std::to_string(quick.size()));
    file.set("quick", fmt::format("{}", fmt::join(quick, ",\n")));
    std::vector<int> events, directions;
    std::vector<std::string> failures;
    bool can_fail = false;
    for (const StopEvent& stop : start.stops) {
        events.push_back(stop.event), directions.push_back(stop.direction);
        failures.push_back(stop.failure.empty() ? "0" : "\"" + stop.failure + "\"");
        can_fail = can_fail || !stop.failure.empty();
    }
    file.set("has_stop", !events.empty());
    file.set("can_fail", can_fail);
    file.set("failures", fmt::format("{}", fmt::join(failures, ", ")));
    file.set("events", std::to_string(program.nodes_of(Group::event).size()));
    file.set("stops_count", std::to_string(events.size()));
    file.set("stop_events", fmt::format("{}", fmt::join(events, ", ")));
    file.set("stop_directions", fmt::format("{}", fmt::join(directions, ", ")));
    file.set("has_places", start.event_places > 0);
    file.set("places", std::to_string(start.event_places));
    file.set("pieces", needs_rates(program) ? "4" : "16");
    file.set("needs_rates", needs_rates(program));
    file.set("projection", projection_text(program, language));
    file.set("initial", initial);
    file.set("columns", columns);
    file.set("start", shortest(start.t));
    file.set("duration", shortest(start.duration));
    file.set("tolerance", shortest(start.tolerance));
    file.set("finite", argument::finite);
    file.set("positive", argument::positive);
    file.set("nonnegative", argument::nonnegative);
    file.set("whole_positive", argument::whole_positive);
    return {name, kainjow::mustache::mustache{std::string(template_standalone)}.render(file)};
}

}  // namespace alembert
