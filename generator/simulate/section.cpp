// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/section.hpp"

#include <fmt/format.h>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "model/formulas.hpp"
#include "scene/known_names.hpp"

namespace alembert {

namespace {

const char* const section_event = "section_of_Poincare_";

}  // namespace

void add_section(Scene& scene, const Mechanism& mechanism, const std::string& section) {
    const auto refuse = [&](const std::string& why) {
        throw ModelError(
            say("--poincare {}: {}; expected an equation of the state, as in --poincare \"theta1 = 0\"", section,
                why));
    };
    const std::size_t equals = section.find('=');
    if (equals == std::string::npos || section.find('=', equals + 1) != std::string::npos)
        refuse(say("this is none"));
    std::vector<Diagnostic> mistakes;
    const KnownNames names(scene);
    const Expression difference = parse_expression(
        fmt::format("({}) - ({})", section.substr(0, equals), section.substr(equals + 1)), {}, mistakes, &names);
    if (!difference) refuse(mistakes.empty() ? say("this is none") : mistakes[0].message);
    try {
        Formulas formulas(scene, mechanism);
        const GiNaC::ex value = mechanism.z->name(formulas.value(difference));
        if (mechanism.z->depends(value, mechanism.qddot)) refuse(say("it holds accelerations"));
    } catch (const SceneMistake& mistake) {
        refuse(mistake.diagnostic.message);
    }
    scene.events.push_back({.name = {section_event, {}}, .when = difference, .direction = 1});
}

std::vector<EventRecord> take_crossings(Run& run) {
    std::vector<EventRecord> crossings;
    std::erase_if(run.motion.events, [&](const EventRecord& event) {
        if (event.name != section_event) return false;
        crossings.push_back(event);
        return true;
    });
    return crossings;
}

}  // namespace alembert
