// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/identification.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/language/say.hpp"
#include "present/report/page.hpp"

namespace alembert {

namespace {

/// "zz(upper) + l1^2*m(lower)"
std::string sum_of(const BaseParameter& base) {
    std::string text;
    for (const BaseTerm& term : base.terms) {
        std::string factor = term.coefficient;
        const bool is_sum = factor.find(" + ") != std::string::npos || factor.find(" - ") != std::string::npos,
                   is_negative = !is_sum && factor[0] == '-';
        if (is_sum) factor = "(" + factor + ")";
        if (is_negative) factor = factor.substr(1);
        if (!text.empty()) text += is_negative ? " - " : " + ";
        text += factor == "1" ? term.parameter : factor + "*" + term.parameter;
    }
    return text;
}

}  // namespace

Json as_json(const Identification& found) {
    Json result;
    result["parameters"] = found.parameters;
    result["rank"] = found.base.size();
    result["base"] = Json::array();
    for (const BaseParameter& base : found.base) {
        Json terms = Json::array();
        for (const BaseTerm& term : base.terms)
            terms.push_back(
                {{"parameter", term.parameter}, {"coefficient", term.coefficient}, {"value", term.value}});
        result["base"].push_back({{"text", sum_of(base)}, {"terms", terms}, {"value", base.value}});
    }
    result["without_influence"] = found.without_influence;
    result["centres"] = Json::object();
    for (const Identification::Body& body : found.bodies) result["centres"][body.name] = body.centre;
    return result;
}

std::string as_text(const Identification& found) {
    std::string page;
    const std::size_t all = found.parameters.size(), shown = found.base.size();
    if (all == 1 && shown == 1)
        say_on(page, "Motion and loads show the only inertial parameter:\n");
    else if (shown == 1)
        say_on(page, "Of {} inertial parameters, motion and loads show one combination:\n", all);
    else
        say_on(page, "Of {} inertial parameters, motion and loads show {} combinations:\n", all, shown);
    for (const BaseParameter& base : found.base) put(page, "  {} = {:.10g}\n", sum_of(base), base.value);
    if (!found.without_influence.empty())
        say_on(page, "without influence: {}\n", fmt::join(found.without_influence, ", "));
    if (!found.bodies.empty())
        page += say("first moments and moments of inertia are about these origins, along the body's axes:\n");
    for (const Identification::Body& body : found.bodies)
        say_on(page, "  {}: the mass centre is at ({:.6g}, {:.6g}, {:.6g})\n", body.name, body.centre[0] + 0.0,
               body.centre[1] + 0.0, body.centre[2] + 0.0);
    return page;
}

}  // namespace alembert
