// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/scene_page.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "present/report/page_files.hpp"
#include "present/report/page_parts.hpp"
#include "present/report/sha256.hpp"
#include "present/report/state_text.hpp"

namespace alembert {

namespace {

/// "en", "zh-CN": what the language of the reader is called in HTML.
std::string language_tag() {
    return say("en");
}

}  // namespace

std::string page_head(const std::string& title, bool has_script, const std::vector<std::string>& more) {
    std::string page, scripts = has_script ? "; script-src 'sha256-" + sha256_base64(page_script) + "'" : "";
    for (const std::string& script : more) scripts += " 'sha256-" + sha256_base64(script) + "'";
    put(page,
        "<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; base-uri 'none'; form-action "
        "'none'; style-src 'sha256-{}'{}\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" "
        "content=\"light dark\">\n<meta name=\"generator\" content=\"alembert\">\n<title>{}</title>\n"
        "<style>{}</style>\n</head>\n<body>\n",
        language_tag(), sha256_base64(page_style), scripts, html(title), page_style);
    return page;
}

std::string unit_text(std::string unit) {
    for (const auto& [typed, print] : {std::pair("^2", "²"), std::pair("^3", "³"), std::pair("*", "·")})
        for (std::size_t at = unit.find(typed); at != std::string::npos; at = unit.find(typed))
            unit.replace(at, std::string(typed).size(), print);
    return unit;
}

void add_failing_state(std::string& body, const CheckedClaim& claim) {
    if (claim.counterexample.empty()) return;
    put(body, "<details><summary>{}</summary><dl class=\"state\">", say("A state at which it fails"));
    for (const auto& [name, value] : claim.counterexample) {
        const WrittenNumber number = written_number(name, value);
        put(body, "<div><dt>{}</dt><dd>{}{}</dd></div>", html(name), number.is_exact ? "" : "≈ ",
            html(number.text));
    }
    put(body, "</dl><p>{}</p></details>\n",
        html(say("There {}", as_written(say("left − right"), claim.residual))));
}

void begin_table(std::string& body, const std::string& caption, const std::vector<std::string>& columns) {
    put(body, "<div class=\"scroll\"><table>\n<caption>{}</caption>\n<thead><tr>", html(caption));
    for (const std::string& column : columns) put(body, "<th scope=\"col\">{}</th>", html(column));
    put(body, "</tr></thead>\n<tbody>\n");
}

void add_table(std::string& body, const std::string& caption, const std::vector<std::string>& columns,
               const std::vector<std::vector<std::string>>& rows) {
    const auto is_used = [&](std::size_t column) {
        return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return !row.at(column).empty(); });
    };
    std::vector<std::size_t> used;
    std::vector<std::string> headings;
    for (std::size_t k = 0; k < columns.size(); ++k) {
        if (!is_used(k)) continue;
        used.push_back(k);
        headings.push_back(columns[k]);
    }
    begin_table(body, caption, headings);
    for (const std::vector<std::string>& row : rows) {
        body += "<tr>";
        for (const std::size_t k : used)
            body += (k == 0 ? "<th scope=\"row\">" : "<td>") + row.at(k) + (k == 0 ? "</th>" : "</td>");
        body += "</tr>\n";
    }
    body += "</tbody></table></div>\n";
}

// The browser opens a fold for a link to what lies in it, so the section has the name, and not the fold.
void PageParts::section(const std::string& id, const std::string& heading, Fold fold) {
    contents.emplace_back(id, heading);
    in_fold_ = fold != Fold::never;
    if (in_fold_)
        put(body, "<details class=\"fold\"{}><summary><h2 id=\"{}-heading\">{}</h2></summary>\n",
            fold == Fold::open ? " open" : "", id, html(heading));
    put(body, "<section id=\"{0}\" aria-labelledby=\"{0}-heading\">\n", id);
    if (!in_fold_) put(body, "<h2 id=\"{}-heading\">{}</h2>\n", id, html(heading));
}

void PageParts::end() {
    body += in_fold_ ? "</section>\n</details>\n" : "</section>\n";
}

void PageParts::copy(const std::string& what, const std::string& text) {
    Json& copies = data["copies"];
    put(body, "<button type=\"button\" class=\"copy\" data-copy=\"{}\">{}</button>\n", copies.size(),
        html(say("Copy {}", what)));
    copies.push_back(text);
}

void PageParts::problem(const std::string& message) {
    put(body, "<pre class=\"problem\" role=\"note\">{}</pre>\n", html(message));
}

std::string as_html(const Overview& all, const ScenePageOptions& options) {
    PageParts parts;
    parts.data["copies"] = Json::array();
    parts.data["words"] = {{"play", say("Play")},
                           {"pause", say("Pause")},
                           {"copied", say("Copied")},
                           {"refused", say("Copying is not allowed")}};
    parts.body += "<div class=\"first\">\n";
    add_figure(parts, all);
    add_equations(parts, all);
    parts.body += "</div>\n";
    add_mechanism(parts, all);
    add_derivation(parts, all);
    add_claims(parts, all);
    if (!options.derivation.empty()) {
        parts.section("hand-derivation", say("Derivation by hand"), Fold::open);
        parts.body += options.derivation;
        parts.end();
    }
    add_agreement(parts, all);
    add_constraints(parts, all);
    add_stability(parts, all);
    add_plots(parts, all);
    add_section_of_poincare(parts, all);
    add_motion(parts, all);
    add_bench(parts, all);
    add_code(parts, all);
    add_commands(parts, all, options.by);

    const std::string title = all.scene.title.empty() ? all.mechanism.name : all.scene.title;
    std::string page = page_head(title, true, parts.scripts);
    put(page, "<a class=\"skip\" href=\"#main\">{}</a>\n<header>\n<h1>{}</h1>\n", say("To the content"),
        html(title));
    if (!all.scene.source.empty()) put(page, "<p class=\"source\">{}</p>\n", html(all.scene.source));
    if (!all.scene.notes.empty()) put(page, "<p class=\"notes\">{}</p>\n", html(all.scene.notes));
    put(page, "<nav aria-label=\"{}\"><ul>\n", say("Contents"));
    for (const auto& [id, heading] : parts.contents)
        put(page, "<li><a href=\"#{}\">{}</a></li>\n", id, html(heading));
    put(page, "</ul></nav>\n</header>\n<main id=\"main\">\n");
    for (const std::string& warning : all.warnings)
        put(page, "<pre class=\"warning\" role=\"note\">{}</pre>\n", html(warning));
    put(page, "{}</main>\n<footer>{}</footer>\n", parts.body,
        html(say("Made by alembert {} from {}.", options.version, all.mechanism.name + ".toml")));
    put(page, "<script type=\"application/json\" id=\"data\">{}</script>\n", script_json(parts.data));
    for (const std::string& script : parts.scripts) put(page, "<script>{}</script>\n", script);
    put(page, "<script>{}</script>\n</body>\n</html>\n", page_script);
    return page;
}

std::string error_page(const std::string& file, const std::string& message) {
    std::string page = page_head(say("There is a mistake in {}", file), false);
    put(page,
        "<header><h1>{}</h1></header>\n<main id=\"main\"><section>\n<p>{}</p>\n"
        "<pre class=\"problem\" role=\"alert\">{}</pre>\n<p>{}</p>\n</section></main>\n</body>\n</html>\n",
        say("The scene has a mistake"),
        say("alembert cannot read {}. It says:", "<code>" + html(file) + "</code>"), html(message),
        say("Correct the scene and make the page again."));
    return page;
}

}  // namespace alembert
