// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/help.hpp"

#include <fmt/format.h>

#include <fmt/ranges.h>
#include <algorithm>

#include "base/language/say.hpp"
#include "commands/modes.hpp"
#include "commands/values.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr std::size_t columns = 79, lines_of_a_screen = 24, widest_name = 26;

OptionText text_of(const CLI::Option& option) {
    OptionText text{.names = {},
                    .earlier = {},
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
    const std::vector<std::string>&letters = option.get_snames(), &words = option.get_lnames();
    for (const std::string& letter : letters)  // one that begins the word: -o, --output
        (words[0].starts_with(letter) ? text.names : text.earlier).push_back("-" + letter);
    for (const std::string& word : words) (&word == &words[0] ? text.names : text.earlier).push_back("--" + word);
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
    std::string text = say("Exit codes:");
    for (const auto& [code, meaning] : exit_codes())
        text += fmt::format("{} {} {}", code > 0 ? say(";") : "", code, meaning);
    return filled(say("{}.", text), columns);
}

std::vector<std::string> entries_of(const CLI::App& app) {
    std::vector<OptionText> options = options_of(app);
    std::erase_if(options, [](const OptionText& option) { return option.value == values::reading; });  // of all
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
            append(lines, filled(say("{}: {}.", kind->plural, fmt::join(kind->words, ", ")), columns));
    }
    if (lines.empty() || lines_until_now + lines.size() <= lines_of_a_screen) return lines;
    return {say("All formalisms and methods: alembert --man {}", app.get_name())};
}

/// What stays together on a line: a word between blanks, or a Chinese character with the punctuation after it.
struct Piece {
    std::string text;
    std::size_t columns = 0;
    bool after_space = false, is_wide = false;
};

std::vector<Piece> pieces_of(const std::string& words) {
    constexpr std::u32string_view closing = U"，。；：、）！？”’》";
    std::vector<Piece> pieces;
    bool space = true;
    for (std::size_t i = 0; i < words.size();) {
        const std::size_t begin = i;
        const char32_t c = decode(words, i);
        if (c == U' ' || c == U'\n') {
            space = true;
            continue;
        }
        const bool is_wide = width(c) == 2, is_closing = closing.find(c) != closing.npos;
        if (pieces.empty() || space || (!is_closing && (is_wide || pieces.back().is_wide)))
            pieces.push_back({.text = {}, .after_space = space && !pieces.empty(), .is_wide = is_wide});
        pieces.back().text += words.substr(begin, i - begin);
        pieces.back().columns += static_cast<std::size_t>(width(c));
        pieces.back().is_wide = is_wide;
        space = false;
    }
    return pieces;
}

std::string joined(const std::vector<std::string>& lines) {
    return fmt::format("{}\n", fmt::join(lines, "\n"));
}

/// Where the options of the verb's modes are told, such as those of `eval --inverse`.
std::vector<std::string> about_modes(const CLI::App& verb) {
    const std::vector<VerbMode> modes = modes_of(verb.get_name());
    if (modes.empty()) return {};
    std::vector<std::string> names;
    for (const VerbMode& mode : modes) names.emplace_back(mode.option);
    const std::string first = fmt::format("alembert {} {}", verb.get_name(), names[0]);
    return filled(say("More options go with {}: see '{} --help'.", fmt::join(names, ", "), first), columns);
}

std::string help_of_verb(const CLI::App& verb) {
    std::vector<std::string> lines{say("Example: {}", verb.get_footer()), ""};
    append(lines, filled(usage_of(verb), columns));
    append(lines, filled(say("{}.", verb.get_description()), columns));
    append(lines, entries_of(verb));
    append(lines, about_modes(verb));
    const std::vector<std::string> codes = about_exit_codes();
    if (lines.size() + codes.size() + 1 > lines_of_a_screen) lines.erase(lines.begin() + 1);  // the empty line
    append(lines, lists_of(verb, lines.size() + codes.size()));
    append(lines, codes);
    return joined(lines);
}

/// One screen: the verbs in their groups.
std::string help_of_program(const CLI::App& app) {
    std::vector<std::string> lines{say("Example: {}", app.get_footer())};
    std::string group;
    for (const CLI::App* verb : listed_verbs(app)) {
        if (verb->get_group() != group) lines.push_back(group = verb->get_group());
        append(lines, entry(verb->get_name(), verb->get_description(), 14));
    }
    append(lines,
           filled(say("alembert new pendulum.toml writes a first scene, alembert pendulum.toml its page. Options: "
                      "VERB --help, --man [VERB], --completion SHELL, --language zh (Chinese), --version."),
                  columns));
    append(lines, about_exit_codes());
    return joined(lines);
}

}  // namespace

std::vector<OptionText> options_of(const CLI::App& app) {
    std::vector<OptionText> positional, named, help;
    for (const CLI::Option* option : app.get_options({})) {
        if (option->get_group().empty()) continue;
        OptionText text = text_of(*option);
        const bool is_help = !text.positional && text.names.back() == "--help";
        if (is_help) text.about = say("this");
        (text.positional ? positional : is_help ? help : named).push_back(std::move(text));
    }
    for (const auto* more : {&named, &help}) positional.insert(positional.end(), more->begin(), more->end());
    return positional;
}

std::vector<CLI::App*> listed_verbs(const CLI::App& app) {
    return const_cast<CLI::App&>(app).get_subcommands([](CLI::App* verb) { return !verb->get_group().empty(); });
}

const CLI::Option* option_of(const CLI::App& verb, const std::string& name) {
    return name.starts_with('-') ? verb.get_option_no_throw(name) : nullptr;
}

std::string usage_of(const CLI::App& app) {
    const VerbMode* const mode = mode_that_was(app.get_name());
    std::string text = "alembert " + (mode == nullptr ? app.get_name() : std::string(mode->verb));
    if (mode != nullptr && *mode->verb == '\0') text += mode->option;
    for (const OptionText& option : options_of(app)) {
        const std::string word = option.positional ? option.names[0]
                                 : option.required ? option.names.back() + " " + option.value
                                                   : std::string();
        if (!word.empty()) text += option.required ? " " + word : " [" + word + "]";
    }
    if (mode != nullptr && *mode->verb != '\0' && mode->kind == nullptr) text += fmt::format(" {}", mode->option);
    return text + " [OPTION…]";
}

const std::vector<std::pair<int, std::string>>& exit_codes() {
    static const std::vector<std::pair<int, std::string>> all{
        {0, say("done, or proved")},    {1, say("refuted")},
        {2, say("undecided")},          {3, say("the input is wrong")},
        {4, say("the numbers failed")}, {5, say("the environment failed")}};
    return all;
}

std::string help_of(const CLI::App& app) {
    return app.get_parent() == nullptr ? help_of_program(app) : help_of_verb(app);
}

void set_help(CLI::App& app) {
    app.formatter_fn([](const CLI::App* asked, std::string, CLI::AppFormatMode) { return help_of(*asked); });
}

std::vector<std::string> filled(const std::string& words, std::size_t width) {
    std::vector<std::string> lines;
    std::size_t used = 0;
    for (const Piece& piece : pieces_of(words)) {
        const std::size_t gap = piece.after_space ? 1 : 0;
        if (lines.empty() || used + gap + piece.columns > width) {
            lines.push_back(piece.text);
            used = piece.columns;
        } else {
            lines.back() += (gap > 0 ? " " : "") + piece.text;
            used += gap + piece.columns;
        }
    }
    return lines;
}

}  // namespace alembert
