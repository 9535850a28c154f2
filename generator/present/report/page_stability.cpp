// SPDX-License-Identifier: GPL-2.0-or-later
/// Equilibria and their stability; the section of Poincaré; speed against error.
#include <cmath>
#include <numbers>

#include "base/language/say.hpp"
#include "present/report/bench.hpp"
#include "present/report/equilibria.hpp"
#include "present/report/page_parts.hpp"
#include "present/report/page_plot.hpp"

namespace alembert {

namespace {

constexpr std::size_t equilibria_shown = 12;

struct PageVerdict {
    const char* style;  ///< its class in the page's style sheet
    std::string verdict, because;
    std::vector<std::complex<double>> eigenvalues;
};

const char* style_of(StabilityVerdict verdict) {
    return verdict == StabilityVerdict::unstable    ? "refuted"
           : verdict == StabilityVerdict::undecided ? "undecided"
                                                    : "proved";
}

PageVerdict verdict_of(const Equilibrium& one, const std::optional<Stability>& judged) {
    if (judged) {
        PageVerdict result{style_of(judged->verdict), translated(name_of(judged->verdict)), judged->reason, {}};
        if (judged->theorem != StabilityTheorem::none)
            result.because = translated(name_of(judged->theorem)) + ": " + result.because;
        for (const RootOf& root : judged->eigenvalues) result.eigenvalues.push_back(root.value);
        return result;
    }
    const StabilityHint& hint = one.judgement;
    switch (hint.stable) {
        case Stable::yes:
            return {"proved", say("stable"), hint.because, hint.eigenvalues};
        case Stable::no:
            return {"refuted", say("unstable"), hint.because, hint.eigenvalues};
        default:
            return {"undecided", say("undecided"), hint.because, hint.eigenvalues};
    }
}

std::string state_text(const Equilibria& found, const Equilibrium& one) {
    const Mechanism& m = found.mechanism;
    std::string text;
    const auto add = [&](const std::string& name, double value, const std::string& exact) {
        put(text, "{}{} = {}", text.empty() ? "" : "<br>", html_letters(name),
            exact.empty() ? fmt::format("{:.6g}", value + 0.0)
                          : fmt::format("{:.6g} = {}", value + 0.0, html_letters(exact)));
    };
    for (int i = 0; i < m.size(); ++i) {
        const std::string name = m.q[i].get_name();
        const bool is_cyclic = std::find(found.cyclic.begin(), found.cyclic.end(), name) != found.cyclic.end();
        if (!is_cyclic)
            add(name, one.start.q[i], one.exact && one.exact->text[i] != "0" ? one.exact->text[i] : "");
        if (one.start.qdot[i] != 0) add(name + "'", one.start.qdot[i], "");
    }
    if (text.empty()) return say("any state");
    if (!one.family) return text;
    std::string free;
    for (const std::string& name : free_names(m, *one.family))
        free += (free.empty() ? "" : ", ") + html_letters(name);
    return text + "<br>" + say("beside it there is one for each value of {}", free);
}

void add_plane(PageParts& page, const std::vector<PageVerdict>& verdicts) {
    std::vector<PagePlotLine> lines;
    for (std::size_t k = 0; k < std::min<std::size_t>(verdicts.size(), 7); ++k) {
        PagePlotLine line{.name = std::to_string(k + 1), .y = {}};
        for (const std::complex<double>& root : verdicts[k].eigenvalues) {
            line.x.push_back(root.real());
            line.y.push_back(root.imag());
        }
        if (!line.x.empty()) lines.push_back(std::move(line));
    }
    if (lines.empty()) return;
    page.body += page_plot({.title = say("Eigenvalues"),
                            .x_name = say("real part"),
                            .x_unit = "",
                            .y_name = say("imaginary part"),
                            .y_unit = "",
                            .points = true,
                            .axes = true},
                           {0}, lines);
}

}  // namespace

void add_stability(PageParts& page, const Overview& all) {
    if (!all.rest.value) {
        if (all.rest.problem.empty()) return;
        page.section("stability", say("Equilibria and stability"));
        put(page.body, "<p class=\"hint\">{}</p>\n", html(all.rest.problem));
        page.end();
        return;
    }
    const Equilibria& found = all.rest.value->found;
    page.section("stability", say("Equilibria and stability"));
    if (found.list.empty()) {
        put(page.body, "<p>{}.</p>\n", html(found.nothing));
        page.end();
        return;
    }
    put(page.body,
        "<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\"></th><th scope=\"col\">{}</th>"
        "<th scope=\"col\">{}</th><th scope=\"col\">{}</th></tr></thead>\n<tbody>\n",
        say("state"), say("verdict"), say("because"));
    std::vector<PageVerdict> verdicts;
    for (std::size_t k = 0; k < std::min(found.list.size(), equilibria_shown); ++k) {
        const Equilibrium& one = found.list[k];
        verdicts.push_back(verdict_of(one, all.rest.value->verdicts[k]));
        put(page.body,
            "<tr><th scope=\"row\">{}</th><td>{}</td><td><strong class=\"verdict {}\">{}</strong></td>"
            "<td>{}</td></tr>\n",
            k + 1, state_text(found, one), verdicts.back().style, html(verdicts.back().verdict),
            html(verdicts.back().because));
    }
    put(page.body, "</tbody></table></div>\n");
    if (found.list.size() > equilibria_shown)
        put(page.body, "<p class=\"hint\">{}</p>\n",
            say("The first {} of {} are shown.", equilibria_shown, found.list.size()));
    if (!found.cyclic.empty()) {
        std::string names;
        for (const std::string& name : found.cyclic) names += (names.empty() ? "" : ", ") + html_letters(name);
        put(page.body, "<p>{}</p>\n", say("Nothing depends on {}: any value will do.", names));
    }
    put(page.body, "<p class=\"hint\">{}</p>\n",
        found.closed ? say("Solved in the parameters: these are all, modulo whole turns.")
                     : say("Found by Newton's method from {} starts; there may be more.", found.search.starts));
    add_plane(page, verdicts);
    page.end();
}

void add_section_of_poincare(PageParts& page, const Overview& all) {
    if (!all.motion.value || all.motion.value->section.empty()) return;
    const WatchedMotion& motion = *all.motion.value;
    page.section("poincare", say("Section of Poincaré"));
    put(page.body, "<p>{}{}.</p>\n",
        say("The motion crosses {}, from less to more, {} time{}", html(motion.section), motion.crossings.size(),
            motion.crossings.size() == 1 ? "" : "s"),
        motion.crossings.size() < 20 ? say("; a longer motion, --duration, gives more points") : std::string());
    const Mechanism& m = all.mechanism;
    const std::size_t n = m.q.size();
    put(page.body, "<div class=\"plots\">\n");
    for (std::size_t k = 0; k < n && !motion.crossings.empty(); ++k) {
        PagePlotLine line{.name = "", .y = {}};
        for (const std::vector<double>& state : motion.crossings) {
            const double q = state[k];
            line.x.push_back(m.units[k] == "rad" ? std::remainder(q, 2 * std::numbers::pi) : q);
            line.y.push_back(state[n + k]);
        }
        const auto [low, high] = std::minmax_element(line.x.begin(), line.x.end());
        if (motion.crossings.size() > 1 && *high - *low < 1e-6) continue;  // what the section holds fast
        const std::string name = m.q[k].get_name();
        page.body += page_plot({.title = say("Section"),
                                .x_name = name,
                                .x_unit = unit_text(m.units[k]),
                                .y_name = name + "'",
                                .y_unit = "",
                                .points = true},
                               {}, {line});
    }
    put(page.body, "</div>\n");
    page.end();
}

void add_bench(PageParts& page, const Overview& all) {
    if (!all.bench.was_asked) return;
    page.section("bench", say("Speed against error"));
    if (all.bench.value)
        put(page.body, "<div class=\"sheet\">{}</div>\n<details><summary>{}</summary><pre>{}</pre></details>\n",
            as_svg(*all.bench.value), say("The numbers"), html(as_text(*all.bench.value)));
    else
        page.problem(all.bench.problem);
    page.end();
}

}  // namespace alembert
