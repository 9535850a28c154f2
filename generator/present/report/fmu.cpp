// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/fmu.hpp"

#include "base/language/say.hpp"
#include "present/report/page.hpp"

namespace alembert {

namespace {

using UnitKind = UnitVariable::Kind;

std::vector<std::string> names_of_kind(const FunctionalUnit& unit, UnitKind kind) {
    std::vector<std::string> names;
    for (const UnitVariable& v : unit.variables)
        if (v.kind == kind) names.push_back(v.name);
    return names;
}

std::vector<std::string> output_names(const FunctionalUnit& unit) {
    std::vector<std::string> names;
    for (const UnitVariable& v : unit.variables)
        if (v.is_output) names.push_back(v.name);
    return names;
}

/// "theta, der(theta)"; "none" for an empty list.
std::string listed(const std::vector<std::string>& names) {
    std::string line;
    for (const std::string& name : names) line += (line.empty() ? "" : ", ") + name;
    return line.empty() ? say("none") : line;
}

}  // namespace

Json as_json(const FunctionalUnit& unit, const std::string& path) {
    Json result;
    result["file"] = path;
    result["fmi"] = unit.version == 2 ? "2.0" : "3.0";
    result["token"] = unit.token;
    result["platform"] = unit.platform;
    result["states"] = names_of_kind(unit, UnitKind::state);
    result["inputs"] = names_of_kind(unit, UnitKind::input);
    result["outputs"] = output_names(unit);
    result["parameters"] = names_of_kind(unit, UnitKind::parameter);
    result["fixed_parameters"] = names_of_kind(unit, UnitKind::tied_parameter);
    result["event_indicators"] = names_of_kind(unit, UnitKind::event);
    result["directional_derivatives"] = unit.contacts == 0;
    return result;
}

std::string as_text(const FunctionalUnit& unit, const std::string& path) {
    std::string page;
    put(page, "{}\n", path);
    say_on(page, "FMI {}, model exchange and co-simulation; C sources, and a binary for {}\n",
           unit.version == 2 ? "2.0" : "3.0", unit.platform);
    say_on(page, "states      {}\n", listed(names_of_kind(unit, UnitKind::state)));
    say_on(page, "inputs      {}\n", listed(names_of_kind(unit, UnitKind::input)));
    say_on(page, "outputs     {}\n", listed(output_names(unit)));
    say_on(page, "parameters  {}\n", listed(names_of_kind(unit, UnitKind::parameter)));
    if (const auto fixed = names_of_kind(unit, UnitKind::tied_parameter); !fixed.empty())
        say_on(page, "fixed       {}\n", listed(fixed));
    return page;
}

}  // namespace alembert
