// SPDX-License-Identifier: GPL-2.0-or-later
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <iterator>
#include <sstream>

#include "alembert/base/error.hpp"
#include "base/archive/file_form.hpp"
#include "base/language/say.hpp"
#include "check/derivation/scene_from.hpp"
#include "commands/grade.hpp"
#include "commands/output.hpp"
#include "commands/show.hpp"
#include "commands/terminal.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "present/report/check.hpp"
#include "present/report/marked.hpp"
#include "present/report/marked_page.hpp"
#include "scene/claims_file.hpp"
#include "scene/text_file.hpp"

namespace alembert {

namespace {

struct CheckOptions : SceneOptions {
    std::string claims;     ///< a file or a folder; if empty, the claims of the scene
    bool complete = false;  ///< whether the right claims must determine the motion
    std::vector<std::string> letters;
    std::string page, csv, json_file;
    bool drafts = false;  ///< whether `scene` is a derivation from which a scene is drafted
};

/// Text for people, or JSON with --json, which goes into a file too if one is named.
template <typename AsJson, typename AsText>
void tell(const CheckOptions& options, const AsJson& json, const AsText& text) {
    if (!options.json_file.empty()) write_file(options.json_file, shown(json()), {options.scene, options.claims});
    if (options.json)
        show(json());
    else
        text();
}

int exit_code(const Checked& checked, bool must_be_complete) {
    bool open = must_be_complete && !checked.complete;
    for (const CheckedClaim& c : checked.claims) {
        if (c.verdict == Verdict::refuted) return 1;
        open = open || c.verdict == Verdict::undecided || c.verdict == Verdict::vacuous;
    }
    return open ? 2 : 0;
}

int exit_code(const Marked& marked, bool must_be_complete) {
    if (marked.first_mistake) return 1;
    const bool open = count_of(marked, LineStatus::undecided) + count_of(marked, LineStatus::not_understood) +
                              count_of(marked, LineStatus::unfounded) >
                          0 ||
                      count_judged(marked) == 0;
    return open || (must_be_complete && !marked.complete) ? 2 : 0;
}

int exit_code(const Gradebook& book) {
    bool is_open = false, has_problem = false;
    for (const GradedRow& row : book.rows) {
        if (row.first_mistake) return 1;
        is_open = is_open || row.open > 0;
        has_problem = has_problem || !row.problem.empty();
    }
    return has_problem ? 3 : is_open ? 2 : 0;
}

MarkOptions mark_options(const CheckOptions& options) {
    MarkOptions result{.by = options.by};
    for (const std::string& given : options.letters) {
        const std::size_t equals = given.rfind('=');
        if (equals == 0 || equals == std::string::npos || equals + 1 == given.size())
            throw ModelError(say("--letters {}: expected LETTER=NAME, as in --letters \"\\\\ell=l\"", given));
        result.letters[given.substr(0, equals)] = given.substr(equals + 1);
    }
    return result;
}

bool is_read_as_derivation(const CheckOptions& options, const std::string& text) {
    if (options.claims == "-" || !options.page.empty() || !options.csv.empty() || !options.letters.empty())
        return true;
    return is_derivation(text, options.claims);
}

int run_claims(Scene scene, const CheckOptions& options) {
    const CheckedScene checked = check(std::move(scene), options.by);
    warn(checked.warnings);
    tell(
        options, [&] { return as_json(checked); },
        [&] { show_formulas(as_text(checked, ink_for(STDOUT_FILENO))); });
    return exit_code(checked.checked, options.complete);
}

void write_book(const Gradebook& book, const CheckOptions& options, const Scene& scene,
                const std::vector<std::string>& inputs) {
    if (!options.csv.empty()) write_file(options.csv, as_csv(book), inputs);
    if (!options.page.empty())
        write_file(options.page, as_html(book, {.title = scene.title, .version = ALEMBERT_VERSION}), inputs);
}

int run_folder(const Scene& scene, const CheckOptions& options) {
    const std::vector<std::string> files = derivations_in(options.claims);
    std::vector<std::string> inputs = files;
    inputs.push_back(options.scene);
    for (const std::string* output : {&options.page, &options.csv, &options.json_file})
        check_output(*output, inputs);
    const Gradebook book = grade(scene, files, mark_options(options), !options.page.empty());
    write_book(book, options, scene, inputs);
    tell(
        options, [&] { return as_json(book); }, [&] { show(as_text(book, ink_for(STDOUT_FILENO))); });
    return exit_code(book);
}

int run_derivation(const Scene& scene, const CheckOptions& options, std::string text) {
    const std::string name = options.claims == "-" ? say("standard input") : options.claims;
    const Marked marked = mark(scene, read_derivation(std::move(text), name), mark_options(options));
    if (!options.page.empty())
        write_file(options.page, as_html(marked, {.title = scene.title, .version = ALEMBERT_VERSION}),
                   {options.scene, options.claims});
    if (!options.csv.empty())
        write_file(options.csv, as_csv(Gradebook{.rows = {graded(marked)}}), {options.scene, options.claims});
    tell(
        options, [&] { return as_json(marked); },
        [&] { show(as_text(marked, ink_for(STDOUT_FILENO), columns_of(STDOUT_FILENO).value_or(0))); });
    return exit_code(marked, options.complete);
}

std::string text_of_input() {
    return {std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
}

/// The scene, and what its derivation is worth by it, in comments: the whole can be kept as a scene.
int run_draft(const CheckOptions& options) {
    if (!options.claims.empty())
        throw ModelError(say("--scene-from drafts the scene from the derivation itself; name this file alone"));
    std::string text = options.scene == "-" ? text_of_input() : text_of_file(options.scene);
    Written written = read_derivation(std::move(text), options.scene);
    const DraftedScene drafted = scene_from(written);
    const Scene scene = parse_scene(drafted.text, say("the scene drafted from {}", options.scene));
    const Marked marked = mark(scene, std::move(written), mark_options(options));
    if (!options.page.empty())
        write_file(options.page, as_html(marked, {.title = scene.title, .version = ALEMBERT_VERSION}),
                   {options.scene});
    const auto json = [&] {
        Json result = as_json(marked);
        result["scene"] = drafted.text;
        result["assumed"] = drafted.assumed;
        return result;
    };
    tell(options, json, [&] {
        show(drafted.text + "\n");
        std::istringstream report(as_text(marked, ink_for(STDOUT_FILENO), columns_of(STDOUT_FILENO).value_or(0)));
        for (std::string line; std::getline(report, line);) show((line.empty() ? "#" : "# " + line) + "\n");
    });
    return exit_code(marked, options.complete);
}

int run(const CheckOptions& options) {
    check_output(options.page, FileForm::page, {options.scene, options.claims});
    check_output(options.csv, FileForm::csv, {options.scene, options.claims});
    check_output(options.json_file, FileForm::json, {options.scene, options.claims});
    if (options.drafts && !options.given.at.empty())
        throw ModelError(say("--at gives values of a scene, and --scene-from drafts one; leave one of them out"));
    if (options.drafts) return run_draft(options);
    Scene scene = scene_of(options);
    if (options.claims.empty()) {
        if (!options.page.empty() || !options.csv.empty() || !options.letters.empty())
            throw ModelError(say("--html, -o and --letters are for a derivation; name its file"));
        return run_claims(std::move(scene), options);
    }
    std::error_code error;
    if (std::filesystem::is_directory(options.claims, error)) return run_folder(scene, options);
    std::string text = options.claims == "-" ? text_of_input() : text_of_file(options.claims);
    if (is_read_as_derivation(options, text)) return run_derivation(scene, options, std::move(text));
    return run_claims(with_claims(std::move(scene), std::move(text), options.claims), options);
}

}  // namespace

void add_check(CLI::App& app, Chosen& chosen) {
    add_scene_verb<CheckOptions>(
        app, chosen,
        {.name = "check",
         .about = say("checks your equations, or a derivation, against the derived ones"),
         .example = "alembert check scenes/textbook/double_pendulum.toml"},
        run, [](Verb& verb, CheckOptions& options) {
            verb.add_option("claims", options.claims,
                            say("a file, one equation a line; a derivation in LaTeX, Markdown or text; a folder "
                                "of these; - "
                                "for standard input; default: the scene's [[claim]]s"))
                .type_name(values::claims);
            verb.add_flag("--complete", options.complete, say("exit code 2 also if the motion is not determined"));
            verb.add_option("--letters", options.letters, say("what a letter stands for, as in \"\\\\ell=l\""))
                .type_name(values::assignment);
            verb.add_flag("--scene-from", options.drafts,
                          say("SCENE is a derivation, from which a scene is drafted that judges its lines"));
            verb.add_option("--html", options.page, say("the marked derivation, or derivations, as a page"))
                .type_name(values::file);
            verb.add_option("--json-file", options.json_file, say("the JSON object too, into this file"))
                .type_name(values::file);
            verb.take("--output", options.csv, say("a row for each derivation, as a table"));
            add_given_state(verb, options.given);
            verb.take("--by", options.by);
        });
}

}  // namespace alembert
