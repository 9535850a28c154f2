// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/words_meant.hpp"

#include <algorithm>
#include <iterator>

namespace alembert {

namespace {

struct Word {
    std::string_view typed, meant;
};

constexpr Word verbs_meant[] = {
    {"run", "simulate"},
    {"sim", "simulate"},
    {"solve", "simulate"},
    {"integrate", "simulate"},
    {"motion", "simulate"},
    {"animate", "report --watch"},
    {"view", "report"},
    {"open", "report"},
    {"serve", "report --watch"},
    {"plot", "simulate --svg"},
    {"verify", "check"},
    {"prove", "check"},
    {"test", "check"},
    {"validate", "check"},
    {"grade", "check"},
    {"eom", "derive"},
    {"equations", "derive"},
    {"lagrange", "derive"},
    {"kane", "derive"},
    {"compare", "check --formalisms"},
    {"linearise", "stability --matrices"},
    {"linear", "stability --matrices"},
    {"eigenvalues", "stability --matrices"},
    {"modes", "stability --matrices"},
    {"stable", "stability"},
    {"rest", "equilibrium"},
    {"equilibria", "equilibrium"},
    {"balance", "equilibrium"},
    {"evaluate", "eval"},
    {"compute", "eval"},
    {"generate", "emit"},
    {"codegen", "emit"},
    {"export", "emit"},
    {"code", "emit"},
    {"html", "report"},
    {"page", "report"},
    {"urdf", "import"},
    {"convert", "import"},
    {"mjcf", "import"},
    {"collision", "eval --impact"},
    {"benchmark", "bench"},
    {"constraints", "audit"},
    {"scan", "sweep"},
    {"vary", "sweep"},
    {"id", "eval --inverse"},
    {"inversedynamics", "eval --inverse"},
    {"fit", "eval --identify"},
    {"estimate", "eval --identify"},
    {"draw", "derive --svg"},
    {"figure", "derive --svg"},
    {"show", "report"},
    {"display", "report"},
    {"animation", "report"},
    {"list", "--help"},
    {"verbs", "--help"},
    {"commands", "--help"},
    {"init", "new"},
    {"create", "new"},
    {"start", "new"},
    {"make", "new"},
    {"template", "new"},
    {"fmi", "emit --fmu"},
    {"unit", "emit --fmu"},
    {"compile", "emit"},
    {"jacobian", "eval --kinematics"},
    {"mass", "eval --inertia"},
    {"dynamics", "derive"},
    {"calculate", "eval"},
    {"state", "eval"},
    {"locus", "stability --vary"},
    {"follow", "equilibrium --vary"},
    {"bifurcation", "equilibrium --vary"},
    {"version", "--version"},
    {"manual", "--man"},
};

constexpr Word options_meant[] = {
    {"tol", "--tolerance"},
    {"rtol", "--tolerance"},
    {"atol", "--tolerance"},
    {"reltol", "--tolerance"},
    {"abstol", "--tolerance"},
    {"eps", "--tolerance"},
    {"precision", "--tolerance"},
    {"accuracy", "--tolerance"},
    {"time", "--duration"},
    {"tend", "--duration"},
    {"tmax", "--duration"},
    {"tfinal", "--duration"},
    {"end", "--duration"},
    {"stoptime", "--duration"},
    {"until", "--duration"},
    {"t", "--duration"},
    {"dt", "--step"},
    {"h", "--step"},
    {"timestep", "--step"},
    {"stepsize", "--step"},
    {"out", "--output"},
    {"outfile", "--output"},
    {"file", "--output"},
    {"save", "--output"},
    {"dir", "--output"},
    {"o", "--output"},
    {"solver", "--method"},
    {"integrator", "--method"},
    {"ode", "--method"},
    {"formalism", "--by"},
    {"using", "--by"},
    {"with", "--by"},
    {"method", "--by"},
    {"set", "--at"},
    {"state", "--at"},
    {"initial", "--at"},
    {"init", "--at"},
    {"ic", "--at"},
    {"param", "--at"},
    {"params", "--at"},
    {"parameter", "--at"},
    {"parameters", "--at"},
    {"value", "--at"},
    {"lang", "--language"},
    {"locale", "--language"},
    {"tex", "--format"},
    {"latex", "--format"},
    {"mathml", "--format"},
    {"figure", "--svg"},
    {"graph", "--svg"},
    {"range", "--vary"},
    {"forces", "--reactions"},
    {"verbose", "--steps"},
    {"stepbystep", "--steps"},
    {"n", "--samples"},
    {"maxsteps", "--budget"},
    {"usage", "--help"},
    {"picture", "--svg"},
    {"plot", "--svg"},
    {"draw", "--svg"},
    {"over", "--vary"},
    {"csv", "--output"},
    {"image", "--svg"},
    {"table", "--output"},
    {"locus", "--vary"},
    {"follow", "--vary"},
    {"browser", "--open"},
    {"watch", "--watch"},
};

template <std::size_t count>
std::string_view word_in(const Word (&table)[count], std::string_view word) {
    const auto found =
        std::find_if(std::begin(table), std::end(table), [&](const Word& w) { return w.typed == word; });
    return found == std::end(table) ? std::string_view() : found->meant;
}

}  // namespace

std::string_view verb_meant_by(std::string_view word) {
    return word_in(verbs_meant, word);
}

std::string_view option_meant_by(std::string_view word) {
    return word_in(options_meant, word);
}

}  // namespace alembert
