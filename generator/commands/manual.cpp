// SPDX-License-Identifier: GPL-2.0-or-later
// Pages of the manual in roff (man(7)), written from the tree of verbs and options.
#include <fmt/format.h>

#include <fmt/ranges.h>
#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/help.hpp"
#include "commands/modes.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "present/report/page.hpp"
#include "scene/scene.hpp"

namespace alembert {

namespace {

/// Escapes text for roff, so that backslashes and hyphens are printed as they are and no line is a request.
std::string roff(const std::string& text) {
    std::string result;
    if (!text.empty() && (text[0] == '.' || text[0] == '\'')) result = "\\&";
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\')
            result += "\\e";
        else if (text[i] == '-')
            result += "\\-";
        else if (text[i] == '\'')
            result += "\\(aq";
        else if (text.compare(i, 3, "…") == 0)
            result += "...", i += 2;
        else
            result += text[i];
    }
    return result;
}

std::string bold(const std::string& text) {
    return "\\fB" + roff(text) + "\\fR";
}
std::string italic(const std::string& text) {
    return "\\fI" + roff(text) + "\\fR";
}

std::string page_name(const CLI::App& app) {
    return app.get_parent() == nullptr ? "alembert" : "alembert-" + app.get_name();
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

void begin(std::string& page, const CLI::App& app, const std::string& about) {
    put(page, ".TH {} 1 \"\" \"alembert {}\" \"User Commands\"\n", upper(page_name(app)), ALEMBERT_VERSION);
    put(page, ".SH {}\n{} \\- {}\n", say("NAME"), roff(page_name(app)), roff(about));
}

void add_option(std::string& page, const OptionText& option) {
    std::string names;
    for (const std::string& name : option.names)
        names += (names.empty() ? "" : ", ") + (option.positional ? italic(name) : bold(name));
    if (!option.value.empty()) names += " " + italic(option.value + (option.repeated ? "…" : ""));
    put(page, ".TP\n{}\n{}.\n", names, roff(option.about));
}

void end(std::string& page, const CLI::App& app, const std::string& also) {
    put(page, ".SH {}\n", say("EXIT STATUS"));
    for (const auto& [code, meaning] : exit_codes()) put(page, ".TP\n{}\n{}.\n", code, roff(meaning));
    put(page, ".SH {}\n", say("ENVIRONMENT"));
    for (const auto& [name, about] :
         {std::pair("CXX", say("The C++ compiler of motions; g++ or clang++ where it is not set.")),
          std::pair("XDG_CACHE_HOME",
                    say("Compiled solvers are kept in its folder alembert, or in ~/.cache/alembert.")),
          std::pair("LANG",
                    say("Where it begins with zh, what people read is Chinese; --language zh does the same.")),
          std::pair("NO_COLOR", say("Where it is set and not empty, nothing is colored."))})
        put(page, ".TP\n.B {}\n{}\n", name, about);
    put(page, ".SH {}\n.EX\n{}\n.EE\n", say("EXAMPLES"), roff(app.get_footer()));
    put(page, ".SH {}\n{}\n", say("SEE ALSO"), also);
}

/// The options of a mode that are not those of all verbs.
void add_mode(std::string& page, const VerbMode& mode, const CLI::App& app) {
    const CLI::App& verb = *app.get_subcommand(mode.earlier);
    put(page, ".SH {} \\-\\-{}\n{}\n.PP\n{}.\n", say("OPTIONS WITH"), upper(mode.option + 2), bold(usage_of(verb)),
        roff(verb.get_description()));
    for (const OptionText& option : options_of(verb)) {
        const std::string& name = option.names.back();
        if (!option.positional && name != "--json" && name != "--strict" && name != "--language" &&
            name != "--help")
            add_option(page, option);
    }
}

std::string page_of_verb(const CLI::App& verb) {
    std::string page;
    begin(page, verb, verb.get_description());
    put(page, ".SH {}\n{}\n.SH {}\n", say("SYNOPSIS"), bold(usage_of(verb)), say("DESCRIPTION"));
    put(page, "{}.\n{}\n.SH {}\n", roff(verb.get_description()),
        say("The reference is docs/commands.md of the documentation."), say("OPTIONS"));
    for (const OptionText& option : options_of(verb)) add_option(page, option);
    for (const VerbMode& mode : modes_of(verb.get_name())) add_mode(page, mode, *verb.get_parent());
    for (const OptionText& option : options_of(verb)) {
        const ValueKind* const kind = value_kind(option.value);
        if (kind != nullptr && !kind->plural.empty())
            put(page, ".SH {}\n{}.\n", upper(kind->plural), roff(fmt::format("{}", fmt::join(kind->words, ", "))));
    }
    end(page, verb, ".BR alembert (1)");
    return page;
}

std::string page_of_program(const CLI::App& app) {
    std::string page, also;
    begin(page, app, say("derives, proves, emits and integrates equations of motion"));
    put(page, ".SH {}\n{} {} [{} ...]\n.SH {}\n{}\n", say("SYNOPSIS"), bold("alembert"), italic("VERB"),
        italic("OPTION"), say("DESCRIPTION"), roff(app.get_description()));
    put(page, ".SH {}\n", say("VERBS"));
    for (const CLI::App* verb : listed_verbs(app)) {
        put(page, ".TP\n{}\n{}.\n", bold(verb->get_name()), roff(verb->get_description()));
        put(also, "{}.BR {} (1)", also.empty() ? "" : ",\n", roff(page_name(*verb)));
    }
    put(page, ".SH {}\n", say("OPTIONS"));
    for (const VerbMode& mode : modes_of(""))
        put(page, ".TP\n{} {}\n{}.\n", bold(mode.option), italic(mode.kind),
            roff(app.get_subcommand(mode.earlier)->get_description()));
    for (const OptionText& option : options_of(app)) add_option(page, option);
    end(page, app, also);
    return page;
}

}  // namespace

void add_manual(CLI::App& app, Chosen& chosen) {
    const auto name = std::make_shared<std::string>();
    Verb verb = add_verb(app, {.name = "man",
                               .about = say("prints a page of the manual, of the program or of a verb"),
                               .example = "alembert --man simulate > alembert-simulate.1"});
    verb.add_option("verb", *name, say("whose page; without it that of the program")).type_name(values::verb);
    verb.callback([name, &app, &chosen] {
        chosen = {
            "man", [name, &app] {
                if (name->empty()) return show(page_of_program(app)), 0;
                std::vector<std::string> known;
                for (const CLI::App* one : app.get_subcommands({}))
                    if (one->get_name() == *name) return show(page_of_verb(*one)), 0;
                for (const CLI::App* one : listed_verbs(app)) known.push_back(one->get_name());
                throw ModelError(say("there is no verb '{}'; expected one of: {}", *name, fmt::join(known, ", ")));
            }};
    });
}

}  // namespace alembert
