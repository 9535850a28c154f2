// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/help.hpp"

#include <fmt/format.h>

#include <fmt/ranges.h>
#include <algorithm>
#include <sstream>

#include "commands/values.hpp"
#include "scene/scene.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr std::size_t columns = 79, lines_of_a_screen = 24, widest_name = 26;

OptionText text_of(const CLI::Option& option) {
    OptionText text{.names = {},
                    .value = {},
                    .about = option.get_description(),
                    .positional = option.get_positional(),
                    .required = option.get_required(),
                    .repeated = option.get_expected_max() > 1};
    const std::string type = option.get_type_name();
    if (text.positional) {
        text.names.push_back(type);
        return text;
    }
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
    if (option.get_items_expected_max() > 0) text.value = type;
    return text;
}

std::string name_of(const OptionText& option) {
    std::string text = fmt::format("{}", fmt::join(option.names, ", "));
    if (!option.value.empty()) text += " " + option.value + (option.repeated ? "…" : "");
    return text;
}

/// An entry " name description", whose description is continued in its own column.
std::vector<std::string> entry(const std::string& name, const std::string& about, std::size_t indent) {
    std::vector<std::string> lines;
    const bool is_long = name.size() + 3 > indent;
    if (is_long) lines.push_back("  " + name);
    for (const std::string& part : filled(about, columns - indent)) {
        const bool is_first = lines.empty();
        lines.push_back(fmt::format("{:<{}}{}", is_first ? "  " + name : "", indent, part));
    }
    return lines;
}

void append(std::vector<std::string>& lines, std::vector<std::string> more) {
    lines.insert(lines.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::vector<std::string> about_exit_codes() {
    std::string text = "Exit codes:";
    for (const auto& [code, meaning] : exit_codes())
        text += fmt::format("{} {} {}", code > 0 ? ";" : "", code, meaning);
    return filled(text + ".", columns);
}

std::vector<std::string> entries_of(const CLI::App& app) {
    const std::vector<OptionText> options = options_of(app);
    std::size_t indent = 0;
    for (const OptionText& option : options)
        if (name_of(option).size() <= widest_name) indent = std::max(indent, name_of(option).size() + 4);
    std::vector<std::string> lines;
    for (const OptionText& option : options) append(lines, entry(name_of(option), option.about, indent));
    return lines;
}

/// All words that options of the verb take, if the help still fits on one screen.
std::vector<std::string> lists_of(const CLI::App& app, std::size_t lines_until_now) {
    std::vector<std::string> lines;
    for (const OptionText& option : options_of(app)) {
        const ValueKind* const kind = value_kind(option.value);
        if (kind != nullptr && !kind->plural.empty())
            append(lines, filled(fmt::format("{}: {}.", kind->plural, fmt::join(kind->words, ", ")), columns));
    }
    if (lines.empty() || lines_until_now + lines.size() <= lines_of_a_screen) return lines;
    return {fmt::format("All formalisms and methods: alembert man {}", app.get_name())};
}

std::string joined(const std::vector<std::string>& lines) {
    return fmt::format("{}\n", fmt::join(lines, "\n"));
}

std::string help_of_verb(const CLI::App& verb) {
    std::vector<std::string> lines{"Example: " + verb.get_footer(), ""};
    append(lines, filled(usage_of(verb), columns));
    append(lines, filled(verb.get_description() + ".", columns));
    append(lines, entries_of(verb));
    const std::vector<std::string> codes = about_exit_codes();
    append(lines, lists_of(verb, lines.size() + codes.size()));
    append(lines, codes);
    return joined(lines);
}

std::string help_of_program(const CLI::App& app) {
    std::vector<std::string> lines{"Example: " + app.get_footer(), ""};
    append(lines, filled(app.get_description(), columns));
    lines.emplace_back("Verbs:");
    for (const CLI::App* verb : app.get_subcommands({}))
        append(lines, entry(verb->get_name(), verb->get_description(), 14));
    lines.emplace_back("'alembert VERB --help' has the options of a verb, --version prints the version.");
    append(lines, about_exit_codes());
    return joined(lines);
}

std::string meant(const std::string& word, const std::vector<std::string>& known) {
    const std::string near = nearest(word, known);
    return near.empty() ? "" : fmt::format("; did you mean {}?", near);
}

std::string mistake_in_options(const CLI::App& verb, const std::vector<std::string>& words) {
    std::vector<std::string> known;
    for (const OptionText& option : options_of(verb))
        if (!option.positional) known.insert(known.end(), option.names.begin(), option.names.end());
    for (std::size_t k = 1; k < words.size(); ++k) {
        const std::string name = words[k].substr(0, words[k].find('='));
        if (name == "--") break;
        if (!name.starts_with("--") || std::find(known.begin(), known.end(), name) != known.end()) continue;
        return fmt::format("{} has no option {}{}\n'alembert {} --help' lists its options\n", verb.get_name(),
                           in_quotes(name), meant(name, known), verb.get_name());
    }
    return {};
}

}  // namespace

std::vector<OptionText> options_of(const CLI::App& app) {
    std::vector<OptionText> positional, named, help;
    for (const CLI::Option* option : app.get_options({})) {
        OptionText text = text_of(*option);
        const bool is_help = !text.positional && text.names.back() == "--help";
        if (is_help) text.about = "this";
        (text.positional ? positional : is_help ? help : named).push_back(std::move(text));
    }
    for (const auto* more : {&named, &help}) positional.insert(positional.end(), more->begin(), more->end());
    return positional;
}

std::string usage_of(const CLI::App& app) {
    std::string text = "alembert " + app.get_name();
    for (const OptionText& option : options_of(app)) {
        const std::string word = option.positional ? option.names[0]
                                 : option.required ? option.names.back() + " " + option.value
                                                   : std::string();
        if (!word.empty()) text += option.required ? " " + word : " [" + word + "]";
    }
    return text + " [OPTION…]";
}

const std::vector<std::pair<int, std::string>>& exit_codes() {
    static const std::vector<std::pair<int, std::string>> all{
        {0, "done, or proved"},    {1, "refuted"},
        {2, "undecided"},          {3, "the input is wrong"},
        {4, "the numbers failed"}, {5, "the environment failed"}};
    return all;
}

std::string help_of(const CLI::App& app) {
    return app.get_parent() == nullptr ? help_of_program(app) : help_of_verb(app);
}

void set_help(CLI::App& app) {
    app.formatter_fn([](const CLI::App* asked, std::string, CLI::AppFormatMode) { return help_of(*asked); });
}

std::string failure_message(const CLI::App* app, const CLI::Error& error) {
    const std::vector<CLI::App*> chosen = app->get_subcommands();
    return fmt::format("{}\n'alembert {}--help' says more\n", error.what(),
                       chosen.empty() ? "" : chosen[0]->get_name() + " ");
}

std::string mistake_in(const CLI::App& app, const std::vector<std::string>& words) {
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
    if (words.empty())
        return fmt::format("expected a verb, as in: {}\n'alembert --help' lists the verbs\n", app.get_footer());
    if (words[0].starts_with('-')) return {};
    for (const CLI::App* verb : app.get_subcommands({}))
        if (verb->get_name() == words[0]) return mistake_in_options(*verb, words);
    return fmt::format("unknown verb {}{}\n'alembert --help' lists the verbs\n", in_quotes(words[0]),
                       meant(words[0], verbs));
}

std::vector<std::string> filled(const std::string& words, std::size_t width) {
    std::vector<std::string> lines;
    std::istringstream stream(words);
    for (std::string word; stream >> word;) {
        if (lines.empty() || lines.back().size() + 1 + word.size() > width)
            lines.push_back(word);
        else
            lines.back() += " " + word;
    }
    return lines;
}

}  // namespace alembert
