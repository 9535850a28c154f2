// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/agree.hpp"

#include <fmt/format.h>

#include <array>

#include "base/language/say.hpp"

namespace alembert {

const char* name_of(Agreement::Verdict verdict) {
    return std::array{to_say("proved"), to_say("refuted"), to_say("undecided")}[static_cast<std::size_t>(verdict)];
}

std::string how_it_was_proved(const Agreement& a) {
    if (a.normal_form)
        return say(
            "The normal forms of all entries of M and f are equal; so are the accelerations at {} random points "
            "modulo 2^61 - 1\n",
            a.points);
    return say(
        "The accelerations are equal at {} random points modulo 2^61 - 1; the chance that a difference was missed "
        "is below 2^{:.0f}\n",
        a.points, a.failure);
}

Json as_json(const Agreed& agreed) {
    const Agreement& a = agreed.agreement;
    Json json;
    json["formalisms"] = Json::array();
    for (const Equations& e : agreed.derivations.equations) json["formalisms"].push_back(e.formalism);
    json["verdict"] = name_of(a.verdict);
    json["method"] = a.normal_form ? "proved" : "sampled";
    json["points"] = a.points;
    json["failure_bound_log2"] = a.failure;
    json["refused"] = Json::object();
    for (const auto& [name, reason] : agreed.derivations.refused) json["refused"][name] = reason;
    if (!a.reason.empty()) json["reason"] = a.reason;
    json["seconds"] = agreed.seconds;
    return json;
}

std::string as_text(const Agreed& agreed, const Ink& ink) {
    const Agreement& a = agreed.agreement;
    const std::string& tone = a.verdict == Agreement::Verdict::proved    ? ink.good
                              : a.verdict == Agreement::Verdict::refuted ? ink.bad
                                                                         : ink.unsure;
    std::string names;
    for (const Equations& e : agreed.derivations.equations) names += (names.empty() ? "" : ", ") + e.formalism;
    std::string text = fmt::format("{}: {}{}{}\n", names, tone, translated(name_of(a.verdict)), ink.end);
    text += a.verdict == Agreement::Verdict::proved ? how_it_was_proved(a) : a.reason + "\n";
    for (const auto& [name, reason] : agreed.derivations.refused)
        text += say("{} does not apply: {}\n", name, reason);
    return text + fmt::format("{:.3f} s\n", agreed.seconds);
}

}  // namespace alembert
