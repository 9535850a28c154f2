// SPDX-License-Identifier: GPL-2.0-or-later
#include <filesystem>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/open_page.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/run_verb.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "present/report/marked_page.hpp"
#include "present/report/scene_page.hpp"
#include "scene/text_file.hpp"

namespace alembert {

namespace {

struct ReportVerb : SceneOptions {
    std::string output;
    RunOptions wishes{.budget = 3'000'000};
    bool moves = true, measures = false, opens = false;
    std::string section;
    std::string derivation;  ///< a file; empty for none
};

/// Writes a page that shows the mistake if the scene is no mechanism, and reports the mistake.
[[noreturn]] void report_mistake(const ReportVerb& verb, const std::string& message) {
    write_file(verb.output, error_page(verb.scene, message), {verb.scene});
    throw;
}

/// The page beside which nothing was named: SCENE.html in the current folder.
std::string usual_page(const std::string& scene) {
    return std::filesystem::path(scene).stem().string() + ".html";
}

int run(const ReportVerb& given) {
    ReportVerb verb = given;
    std::error_code none;
    if (!std::filesystem::exists(verb.scene, none)) read_scene(verb.scene);  // throws; a wrong name makes no page
    if (verb.output.empty()) verb.output = usual_page(verb.scene);
    check_output(verb.output, FileForm::page, {verb.scene, verb.derivation});
    Progress progress;
    OverviewOptions options{.by = verb.by, .wishes = verb.wishes, .moves = verb.moves};
    options.section = verb.section;
    options.measures = verb.measures;
    options.wishes.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    std::optional<Overview> all;
    try {
        all =
            overview(with_given(are_warnings_errors() ? scene_of(verb.scene) : read_scene(verb.scene), verb.given),
                     options);
    } catch (const SceneError& mistake) {
        report_mistake(verb, mistake.what());
    } catch (const ModelError& mistake) {
        report_mistake(verb, mistake.what());
    }
    progress.wipe();
    warn(all->warnings);
    std::string marked;
    if (!verb.derivation.empty())
        marked = marked_fragment(
            mark(all->scene, read_derivation(text_of_file(verb.derivation), verb.derivation), {.by = verb.by}));
    write_file(verb.output,
               as_html(*all, {.version = ALEMBERT_VERSION, .by = verb.by, .derivation = std::move(marked)}),
               {verb.scene, verb.derivation});
    if (verb.json)
        show(Json{{"file", verb.output}});
    else
        show(say("wrote {}\n", verb.output));
    if (verb.opens && !verb.json) open_page(verb.output);
    if (all->motion.value && all->motion.value->run.failure) {
        const Run& broken = all->motion.value->run;
        throw IntegrationError(*broken.failure, broken.motion.failure->time, broken.motion.failure->state);
    }
    return 0;
}

}  // namespace

void add_report(CLI::App& app, Chosen& chosen) {
    add_scene_verb<ReportVerb>(
        app, chosen,
        {.name = "report",
         .about = say("writes one page about the scene, with a figure that moves"),
         .example = "alembert report scenes/textbook/double_pendulum.toml"},
        run, [](Verb& verb, ReportVerb& options) {
            verb.add_option("-o,--output", options.output,
                            say("the page, HTML; default: the scene's name with .html, in this folder"))
                .type_name(values::file);
            verb.take("--by", options.by);
            add_given_values(verb, options.given);
            verb.take("--duration", options.wishes.duration);
            verb.take("--budget", options.wishes.budget, say("evaluations of the motion, at most"));
            verb.take("--poincare", options.section);
            verb.add_option("--derivation", options.derivation,
                            say("a derivation by hand, which the page shows line by line with its verdicts"))
                .type_name(values::file);
            verb.add_flag("--bench", options.measures, say("also speed against error, of every method"));
            verb.take("--no-motion", options.moves);
            verb.add_flag("--open", options.opens, say("shows the page in the browser, if there is a display"));
        });
}

}  // namespace alembert
