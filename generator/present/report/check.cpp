// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/check.hpp"

#include <fmt/format.h>

#include <array>

#include "base/language/say.hpp"
#include "present/report/state_text.hpp"
#include "scene/claim_mode.hpp"

namespace alembert {

const char* name_of(Verdict verdict) {
    return std::array{to_say("proved"), to_say("refuted"), to_say("undecided"),
                      to_say("vacuous")}[static_cast<std::size_t>(verdict)];
}

std::string words_of_completeness(const Checked& checked) {
    if (checked.complete && checked.is_of_states_alone)
        return say("There are no equations of motion: the scene has states alone, and gives their rates.");
    if (checked.complete && checked.has_states)
        return say("With the constraints and the rates of the states, the claims that hold determine the motion.");
    if (checked.complete) return say("With the constraints, the claims that hold determine the motion.");
    const int missing = checked.missing, all = checked.freedom;
    if (missing == 0) return say("The equations that are proved do not yet determine the motion.");
    if (all == 1) return say("The equation of motion is still missing.");
    return missing == 1 ? say("1 of {} equations of motion is still missing.", all)
                        : say("{} of {} equations of motion are still missing.", missing, all);
}

bool is_missing_term(const CheckedClaim& claim) {
    return claim.likely && claim.likely->kind == "missing_term" && claim.likely->written.empty();
}

namespace {

Json json_of(const Claim& claim, const CheckedClaim& checked) {
    Json json;
    json["equation"] = text_of(claim.equation);
    json["line"] = claim.place.line;
    if (!claim.source.empty()) json["source"] = claim.source;
    json["at"] = mode_text(claim);
    json["verdict"] = name_of(checked.verdict);
    json["method"] = checked.normal_form ? "proved" : "sampled";
    if (checked.verdict == Verdict::proved && !checked.normal_form) json["failure_bound_log2"] = checked.failure;
    json["kinematic"] = checked.kinematic;
    json["counterexample"] = Json::object();
    for (const auto& [name, value] : checked.counterexample) json["counterexample"][name] = value;
    json["residual"] = checked.residual.empty() ? Json(nullptr) : Json(checked.residual_value);
    if (!checked.residual.empty()) json["residual_text"] = checked.residual;
    json["difference"] = checked.difference;
    if (!checked.nearest.empty()) json["nearest"] = checked.nearest;
    json["likely"] = nullptr;
    if (checked.verdict == Verdict::refuted) {
        const Slip slip = checked.likely.value_or(Slip{});
        json["likely"] = {{"kind", slip.kind}, {"term", slip.term}};
        for (const auto& [name, value] :
             {std::pair("repair", slip.repair), std::pair("should_be", slip.should_be),
              std::pair("written", slip.written), std::pair("meant", slip.meant), std::pair("also", slip.also)})
            if (!value.empty()) json["likely"][name] = value;
    }
    if (!checked.reason.empty()) json["reason"] = checked.reason;
    if (checked.up_to)
        json["up_to"] = {{"kind", checked.up_to->kind == UpTo::Kind::constant ? "constant" : "derivative"},
                         {"text", checked.up_to->text}};
    if (const auto where = conditions_of(checked); !where.empty()) json["where"] = where;
    json["assumed"] = Json::array();
    for (const Assumption& one : checked.assumed)
        json["assumed"].push_back({{"kind", name_of(one.kind)}, {"text", one.text}});
    if (!checked.holds_where.empty()) json["holds_where"] = checked.holds_where;
    if (checked.other_branch) {
        const OtherBranch& other = *checked.other_branch;
        Json state = Json::object(), where = nullptr;
        for (const auto& [name, value] : other.counterexample) state[name] = value;
        if (!other.where.empty()) {
            std::vector<std::string> equations;
            for (const auto& [name, value] : other.where) equations.push_back(fmt::format("{} = {}", name, value));
            where = fmt::format("{}", fmt::join(equations, ", "));
        }
        json["other_branches"] = {
            {{"where", where}, {"verdict", name_of(other.verdict)}, {"counterexample", state}}};
    }
    return json;
}

std::string text_of(const Claim& claim, const CheckedClaim& c, const Ink& ink) {
    const std::string& tone = c.verdict == Verdict::proved    ? ink.good
                              : c.verdict == Verdict::refuted ? ink.bad
                                                              : ink.unsure;
    std::string page =
        fmt::format("{}{:<9}{}  {}\n", tone, translated(name_of(c.verdict)), ink.end, text_of(claim.equation));
    const auto line = [&page](const std::string& label, const std::string& text) {
        page += fmt::format("{:<9}  {}{}\n", "", label, text);
    };
    if (!claim.source.empty()) line("", claim.source);
    if (const auto where = conditions_of(c); !where.empty())
        line(say("where "), fmt::format("{}", fmt::join(where, ", ")));
    for (const Assumption& one : c.assumed)
        if (one.kind == Assumption::Kind::small) line("", one.text);
    if (!c.reason.empty()) line("", c.reason);
    if (c.other_branch) {
        const bool holds = c.other_branch->verdict == Verdict::proved;
        const std::string where = text_of_state(c.other_branch->where);
        if (where.empty())
            line("", holds ? say("on another branch of the constraints it holds")
                           : say("on another branch of the constraints it fails"));
        else
            line("", holds ? say("on another branch of the constraints, as at {}, it holds", where)
                           : say("on another branch of the constraints, as at {}, it fails", where));
    }
    if (c.verdict != Verdict::refuted) return page;
    if (!c.difference.empty() && !is_missing_term(c)) line(say("extra in your equation: "), c.difference);
    if (c.likely) line(say("probable slip: "), words_of(*c.likely));
    if (!c.nearest.empty()) line(say("correct equation: "), c.nearest);
    if (!c.counterexample.empty()) {
        line(say("it fails at "), text_of_state(c.counterexample, text_of(claim.equation)));
        line("", say("where {}", as_written(say("left - right"), c.residual)));
    }
    for (const std::string& sides : c.holds_where) line(say("it holds where "), sides);
    return page;
}

}  // namespace

Json as_json(const CheckedScene& checked) {
    Json json;
    json["claims"] = Json::array();
    for (std::size_t k = 0; k < checked.checked.claims.size(); ++k)
        json["claims"].push_back(json_of(checked.scene.claims[k], checked.checked.claims[k]));
    json["complete"] = checked.checked.complete;
    json["missing_equations"] = checked.checked.missing;
    json["degrees_of_freedom"] = checked.checked.freedom;
    return json;
}

std::string as_text(const CheckedScene& checked, const Ink& ink) {
    std::string page;
    for (std::size_t k = 0; k < checked.checked.claims.size(); ++k)
        page += text_of(checked.scene.claims[k], checked.checked.claims[k], ink);
    return page + words_of_completeness(checked.checked) + "\n";
}

}  // namespace alembert
