// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/formalism/formalisms.hpp"

#include <fmt/format.h>

#include "base/language/say.hpp"
#include "model/formalism/appell.hpp"
#include "model/formalism/dalembert.hpp"
#include "model/formalism/hamilton.hpp"
#include "model/formalism/kane.hpp"
#include "model/formalism/lagrange.hpp"
#include "model/formalism/lagrange1.hpp"
#include "model/formalism/maggi.hpp"
#include "model/formalism/nielsen.hpp"
#include "model/formalism/recursive.hpp"
#include "model/formalism/roberson_wittenburg.hpp"
#include "model/formalism/routh.hpp"
#include "model/formalism/routhian.hpp"
#include "model/formalism/schiehlen.hpp"
#include "scene/advice.hpp"
#include "scene/scene.hpp"
#include "scene/text.hpp"

namespace alembert {

const std::vector<Formalism>& formalisms() {
    static const std::vector<Formalism> all{
        {.name = "lagrange",
         .title = to_say("Lagrange's equations of the second kind"),
         .obstacle = obstacle_to_lagrange,
         .derive = lagrange,
         .independent = true},
        {.name = "lagrange1",
         .title = to_say("Lagrange's equations of the first kind"),
         .obstacle = obstacle_to_lagrange1,
         .derive = lagrange1,
         .steps = steps_of_lagrange1},
        {.name = "routh",
         .title = to_say("Routh's equations with multipliers"),
         .obstacle = obstacle_to_routh,
         .derive = routh,
         .without_constraints = "lagrange"},
        {.name = "kane",
         .title = to_say("Kane's equations"),
         .obstacle = obstacle_to_kane,
         .derive = kane,
         .steps = steps_of_kane},
        {.name = "dalembert",
         .title = to_say("the general equation of dynamics"),
         .obstacle = obstacle_to_dalembert,
         .derive = dalembert,
         .steps = steps_of_dalembert},
        {.name = "nielsen",
         .title = to_say("Nielsen's equations"),
         .obstacle = obstacle_to_nielsen,
         .derive = nielsen,
         .steps = steps_of_nielsen},
        {.name = "schiehlen",
         .title = to_say("Schiehlen's equations: Newton-Euler, projected"),
         .obstacle = obstacle_to_schiehlen,
         .derive = schiehlen,
         .steps = steps_of_schiehlen},
        {.name = "roberson-wittenburg",
         .title = to_say("Roberson and Wittenburg's equations"),
         .obstacle = obstacle_to_roberson_wittenburg,
         .derive = roberson_wittenburg,
         .outline = outline_of_roberson_wittenburg},
        {.name = "hamilton",
         .title = to_say("Hamilton's equations, the momenta eliminated"),
         .obstacle = obstacle_to_hamilton,
         .derive = hamilton,
         .steps = steps_of_hamilton,
         .independent = true,
         .in_momenta = true},
        {.name = "recursive",
         .title = to_say("the recursive equations from body to body"),
         .obstacle = obstacle_to_recursive,
         .derive = recursive},
        {.name = "routhian",
         .title = to_say("Routh's procedure, the momenta eliminated"),
         .obstacle = obstacle_to_routhian,
         .derive = routhian,
         .steps = steps_of_routhian,
         .independent = true,
         .in_momenta = true},
        {.name = "appell",
         .title = to_say("the Gibbs-Appell equations"),
         .obstacle = obstacle_to_appell,
         .derive = appell,
         .steps = steps_of_appell},
        {.name = "maggi",
         .title = to_say("Maggi's equations"),
         .obstacle = obstacle_to_maggi,
         .derive = maggi,
         .steps = steps_of_maggi},
    };
    return all;
}

std::string formalism_names() {
    std::string names;
    for (const Formalism& f : formalisms()) names += (names.empty() ? "" : ", ") + f.name;
    return names;
}

const Formalism& formalism(const std::string& name) {
    for (const Formalism& f : formalisms())
        if (bare(f.name) == bare(name)) return f;
    std::vector<std::string> names;
    for (const Formalism& f : formalisms()) names.push_back(f.name);
    std::string meant(formalism_meant(name));
    if (meant.empty()) meant = nearest(name, names);
    throw ModelError(say("there is no formalism {}{}; expected one of: {}", in_quotes(name),
                         meant.empty() ? "" : say(" (did you mean '{}'?)", meant), formalism_names()));
}

}  // namespace alembert
