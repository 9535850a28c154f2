// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/stability.hpp"

#include <fmt/format.h>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/vary.hpp"
#include "commands/verb.hpp"
#include "present/report/stability_charts.hpp"

namespace alembert {

namespace {

constexpr std::size_t chart_columns = 121, chart_rows = 91, locus_values = 200;

struct StabilityVerb : SceneOptions {
    std::vector<std::string> at, vary;
    double period = 0, duration = 0;
    bool modes = false;
    std::string lyapunov, exponents, output, svg;
    std::string locus;  ///< the earlier name of --vary over one parameter
};

StabilityOptions options_of(const StabilityVerb& verb, const Scene& scene) {
    return {.by = verb.by,
            .at = overrides_of(verb.at, scene),
            .exact_at = exact_overrides_of(verb.at, scene),
            .period = verb.period,
            .lyapunov = in_words_of(scene, verb.lyapunov)};
}

void need_alone(const StabilityVerb& verb) {
    const bool is_picture = !verb.vary.empty();
    const int asked = is_picture + !verb.locus.empty() + !verb.exponents.empty() + !verb.lyapunov.empty();
    if (asked > 1)
        throw ModelError(say("--vary, --exponents and --lyapunov are different questions; expected one of them"));
    if (verb.vary.size() > 2)
        throw ModelError(
            say("a chart is drawn over two parameters; expected --vary twice, as in --vary a=0:5 --vary q=0:4 "
                "(once, it follows the roots)"));
    if (!verb.svg.empty() && !is_picture && verb.locus.empty())
        throw ModelError(say("--svg shows a chart or a root locus; expected --vary with it"));
    if (!verb.output.empty() && !is_picture && verb.locus.empty() && verb.exponents.empty())
        throw ModelError(say("-o is for a chart, a root locus or exponents; expected --vary or --exponents"));
    if (verb.duration > 0 && verb.exponents.empty()) throw ModelError(say("--duration belongs to --exponents"));
}

/// Files and page of what has no verdict.
template <typename Found>
void hand_over(const StabilityVerb& verb, const Found& found) {
    if (!verb.output.empty()) write_file(verb.output, as_csv(found), {verb.scene});
    if constexpr (!std::is_same_v<Found, LyapunovExponents>)
        if (!verb.svg.empty()) write_file(verb.svg, as_svg(found), {verb.scene, verb.output});
    if (verb.json)
        show(as_json(found));
    else
        show_page(as_text(found), verb.full);
}

int draw_over(const StabilityVerb& verb) {
    Scene scene = scene_of(verb.scene);
    ChartOptions options{.stability = options_of(verb, scene)};
    Progress progress;
    options.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    if (verb.vary.size() != 2) {
        const std::string& given = verb.vary.empty() ? verb.locus : verb.vary[0];
        const Axis range = range_of("--vary", given, locus_values, scene);
        const RootLocus locus = root_locus(std::move(scene), range, options);
        progress.wipe();
        hand_over(verb, locus);
        return 0;
    }
    const Axis across = range_of("--vary", verb.vary[0], chart_columns, scene),
               up = range_of("--vary", verb.vary[1], chart_rows, scene);
    const StabilityChart chart = stability_chart(std::move(scene), across, up, options);
    progress.wipe();
    hand_over(verb, chart);
    return 0;
}

int find_exponents(const StabilityVerb& verb) {
    Scene scene = scene_of(verb.scene);
    ExponentOptions options{.by = verb.by, .at = overrides_of(verb.at, scene)};
    if (verb.exponents != "all") {
        const double count = number_of(verb.exponents);
        if (!(count >= 1 && count <= 1000) || count != static_cast<int>(count))
            throw ModelError(say("--exponents {}: expected how many, from 1, or `all`", verb.exponents));
        options.count = static_cast<int>(count);
    } else {
        options.count = 0;
    }
    if (verb.duration > 0) options.duration = verb.duration;
    Progress progress;
    options.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    const LyapunovExponents found = lyapunov_exponents(std::move(scene), options);
    progress.wipe();
    warn(found.warnings);
    hand_over(verb, found);
    return 0;
}

int run(const StabilityVerb& verb) {
    check_output(verb.output, FileForm::csv, {verb.scene});
    check_output(verb.svg, FileForm::picture, {verb.scene});
    need_alone(verb);
    if (!verb.exponents.empty()) return find_exponents(verb);
    if (!verb.vary.empty() || !verb.locus.empty()) return draw_over(verb);
    Scene scene = scene_of(verb.scene);
    const StabilityOptions options = options_of(verb, scene);
    const Stability result = stability(std::move(scene), options);
    warn(result.warnings);
    if (verb.json)
        show(as_json(result));
    else
        show_page(as_text(result, verb.modes), verb.full);
    switch (result.verdict) {
        case StabilityVerdict::asymptotically_stable:
        case StabilityVerdict::stable:
            return 0;
        case StabilityVerdict::unstable:
            return 1;
        case StabilityVerdict::undecided:
            return 2;
    }
    return 2;
}

}  // namespace

void add_stability(CLI::App& app, Chosen& chosen) {
    add_scene_verb<StabilityVerb>(
        app, chosen,
        {.name = "stability",
         .about = say("says whether an equilibrium or a motion is stable, and why"),
         .example = "alembert stability scenes/textbook/watt_governor.toml --at alpha=0"},
        run, [](Verb& verb, StabilityVerb& options) {
            verb.take("--by", options.by);
            verb.take("--at", options.at);
            verb.add_option("--period", options.period, say("of a periodic system or motion: Floquet multipliers"))
                .type_name(values::seconds)
                .positive();
            verb.add_option("--lyapunov", options.lyapunov,
                            say("a function V of the state: judges what it proves"))
                .type_name(values::formula);
            verb.take("--modes", options.modes);
            verb.take("--vary", options.vary,
                      say("follows the roots over a parameter; twice: a chart of stability over two"));
            verb.add_option("--locus", options.locus, "").silent();
            verb.add_option("--exponents", options.exponents,
                            say("so many Lyapunov exponents of the motion, or `all`"))
                .type_name(values::count);
            verb.take("--duration", options.duration, say("of the motion for exponents; 1000 if missing"))
                .positive();
            verb.take("--output", options.output, say("CSV file of a chart, locus or exponents"));
            verb.take("--svg", options.svg, say("picture of a chart or locus"));
            verb.take("--full", options.full);
        });
}

}  // namespace alembert
