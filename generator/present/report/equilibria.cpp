// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/equilibria.hpp"

#include <map>

#include "base/language/say.hpp"
#include "present/report/page.hpp"
#include "present/report/shown_unit.hpp"

namespace alembert {

namespace {

Json exact_of(const Mechanism& m, const ClosedRoot& root) {
    Json result = Json::object();
    for (int i = 0; i < m.size(); ++i)
        if (!root.text[i].empty()) result[m.q[i].get_name()] = root.text[i];
    return result;
}

/// " from 0 to 1.3": the ends of a continuum of one dimension that are known, and how far the others were looked
/// for.
std::string ends_of(const Mechanism& m, const SteadyFamily& family) {
    const std::optional<long double>&from = family.from, &to = family.to, &low = family.seen_from,
                             &high = family.seen_to;
    if (!from && !to && !low && !high) return "";
    const int i = family.free[0];
    const ShownUnit unit(i < m.size() ? m.shown_units[static_cast<std::size_t>(i)]
                                      : m.states[static_cast<std::size_t>(i - m.size())].shown);
    const auto shown = [&](long double x) {
        const std::string name = unit.text({});
        return fmt::format("{:.10g}{}{}", unit.value(static_cast<double>(x)) + 0.0, name.empty() ? "" : " ", name);
    };
    if (from && to) return say(" from {} to {}", shown(*from), shown(*to));
    if (to && low) return say(" up to {}; downwards no end was found as far as {}", shown(*to), shown(*low));
    if (from && high) return say(" from {} on; no end was found as far as {}", shown(*from), shown(*high));
    if (low && high) return say("; no ends were found between {} and {}", shown(*low), shown(*high));
    if (low) return say("; downwards no end was found as far as {}", shown(*low));
    if (high) return say("; upwards no end was found as far as {}", shown(*high));
    return to ? say(" up to {}", shown(*to)) : say(" from {} on", shown(*from));
}

Json json_of(const Equilibria& found, const Equilibrium& one) {
    const Mechanism& m = found.mechanism;
    Json result;
    result["coordinates"] = by_name_of(m, one.start.q);
    result["rates"] = by_name_of(m, one.start.qdot);
    for (std::size_t k = 0; k < m.states.size(); ++k)
        result["states"][m.states[k].derivative[0].get_name()] = one.start.states[k] + 0.0;
    result["moving"] = one.moving;
    if (one.exact) {
        result["exact"] = exact_of(m, *one.exact);
        result["where"] = one.exact->where;
    }
    result["multipliers"] = Json::object();
    for (std::size_t k = 0; k < one.multipliers.size(); ++k)
        result["multipliers"][found.equations.lambda[k].get_name()] = one.multipliers[k] + 0.0;
    result["residual"] = one.residual;
    result["state"] = name_of(one.known);
    result["isolated"] = !one.family;
    if (one.family) {
        result["family"] = {{"dimension", one.family->dimension}, {"free", free_names(m, *one.family)}};
        if (one.family->from) result["family"]["from"] = static_cast<double>(*one.family->from) + 0.0;
        if (one.family->to) result["family"]["to"] = static_cast<double>(*one.family->to) + 0.0;
        const auto seen = [&](const char* key, const std::optional<long double>& value) {
            if (value) result["family"][key] = static_cast<double>(*value) + 0.0;
        };
        seen("seen_from", one.family->seen_from);
        seen("seen_to", one.family->seen_to);
    }
    result["stable"] = name_of(one.judgement.stable);
    result["because"] = one.judgement.because;
    result["assumed"] = Json::array();
    for (const Assumption& assumed : one.judgement.assumed)
        result["assumed"].push_back({{"kind", name_of(assumed.kind)}, {"text", assumed.text}});
    result["eigenvalues"] = Json::array();
    for (const std::complex<double>& value : one.judgement.eigenvalues)
        result["eigenvalues"].push_back({value.real() + 0.0, value.imag() + 0.0});
    return result;
}

/// "1, 3": of those that are known like that.
std::string numbers_of(const Equilibria& found, StateKnown known) {
    std::vector<std::size_t> list;
    for (std::size_t k = 0; k < found.list.size(); ++k)
        if (found.list[k].known == known) list.push_back(k + 1);
    return fmt::format("{}", fmt::join(list, ", "));
}

}  // namespace

std::vector<std::string> free_names(const Mechanism& m, const SteadyFamily& family) {
    std::vector<std::string> names;
    for (const int i : family.free)
        names.push_back(i < m.size() ? m.q[i].get_name()
                                     : m.states[static_cast<std::size_t>(i - m.size())].derivative[0].get_name());
    return names;
}

Json by_name_of(const Mechanism& m, const std::vector<double>& values) {
    Json result = Json::object();
    for (int i = 0; i < m.size(); ++i) result[m.q[i].get_name()] = values[i] + 0.0;
    return result;
}

Json as_json(const Equilibria& found) {
    Json result;
    result["formalism"] = found.equations.formalism;
    result["method"] = found.closed ? "closed form" : "search";
    result["complete"] = found.closed;
    result["starts"] = found.search.starts;
    result["cyclic"] = found.cyclic;
    result["equilibria"] = Json::array();
    for (const Equilibrium& one : found.list) result["equilibria"].push_back(json_of(found, one));
    result["absent"] = Json::array();
    for (const ClosedRoot& root : found.not_real)
        result["absent"].push_back({{"exact", exact_of(found.mechanism, root)}, {"where", root.where}});
    if (!found.nothing.empty()) result["reason"] = found.nothing;
    return result;
}

std::string as_text(const Equilibria& found) {
    const Mechanism& m = found.mechanism;
    std::string page;
    if (!found.scene.title.empty()) put(page, "{}\n\n", found.scene.title);
    for (std::size_t k = 0; k < found.list.size(); ++k) {
        const Equilibrium& one = found.list[k];
        if (one.moving.empty())
            say_on(page, "{}. Equilibrium{}\n", k + 1, one.family ? say(", one of a continuum") : "");
        else
            say_on(page, "{}. Steady motion in which {} {}{}\n", k + 1, fmt::join(one.moving, ", "),
                   one.moving.size() == 1 ? say("moves") : say("move"),
                   one.family ? say(", one of a continuum") : "");
        for (int i = 0; i < m.size(); ++i) {
            const ShownUnit unit(m.shown_units[static_cast<std::size_t>(i)]);
            const std::string name = m.q[i].get_name();
            put(page, "     {} = {:.16g}", unit.label(name), unit.value(one.start.q[i] + 0.0));
            if (one.start.qdot[i] != 0)
                put(page, ", {} = {:.10g}", unit.label(name + "'", 1), unit.value(one.start.qdot[i]));
            if (one.exact && !one.exact->text[i].empty() && one.exact->text[i] != "0")
                put(page, "  = {}", one.exact->text[i]);
            put(page, "\n");
        }
        for (std::size_t k = 0; k < m.states.size(); ++k) {
            const ShownUnit unit(m.states[k].shown);
            put(page, "     {} = {:.16g}\n", unit.label(m.states[k].derivative[0].get_name()),
                unit.value(one.start.states[k] + 0.0));
        }
        if (one.family)
            put(page, "   {}{}\n",
                say("beside it there is one for each value of {}", fmt::join(free_names(m, *one.family), ", ")),
                ends_of(m, *one.family));
        if (one.exact && !one.exact->where.empty())
            say_on(page, "   where {}\n", fmt::join(one.exact->where, ", "));
        say_on(page, "   stable: {} ({})\n\n", translated(name_of(one.judgement.stable)), one.judgement.because);
    }
    if (!found.cyclic.empty())
        say_on(page, "Nothing depends on {}: any value will do.\n", fmt::join(found.cyclic, ", "));
    if (found.search.in_families > 1)
        say_on(page, "{} roots belong to continua; of those that a way within a continuum joins, one is shown.\n",
               found.search.in_families);
    for (const ClosedRoot& root : found.not_real) {
        say_on(page, "Not at these parameters:");
        for (int i = 0; i < m.size(); ++i)
            if (!root.text[i].empty()) put(page, " {} = {},", m.q[i].get_name(), root.text[i]);
        say_on(page, " where {}\n", fmt::join(root.where, ", "));
    }
    if (found.closed)
        say_on(page, "Solved in the parameters: these are all, modulo whole turns.\n");
    else if (!found.list.empty())
        say_on(page, "Found by Newton's method from {} starts; there may be more (--starts N searches longer).\n",
               found.search.starts);
    const std::string proved = numbers_of(found, StateKnown::proved), open = numbers_of(found, StateKnown::open);
    if (!proved.empty())
        say_on(page, "It is proved that there is one, and one only, within {:g} of the numbers of {}.\n",
               proved_radius, proved);
    if (!open.empty()) say_on(page, "It is not proved that there is one at the numbers of {}.\n", open);
    std::map<std::string, std::vector<std::size_t>> assumed;  // of which
    for (std::size_t k = 0; k < found.list.size(); ++k)
        for (const Assumption& one : found.list[k].judgement.assumed) assumed[one.text].push_back(k + 1);
    for (const auto& [text, of] : assumed) say_on(page, "Not proved of {}: {}\n", fmt::join(of, ", "), text);
    return page;
}

}  // namespace alembert
