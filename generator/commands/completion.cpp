// SPDX-License-Identifier: GPL-2.0-or-later
// Completion scripts, written from the tree of verbs and options. The values of options come from values.hpp.
// Names consist only of letters, digits and hyphens, because they are the program's own. Descriptions are quoted.
#include <fmt/format.h>

#include <fmt/ranges.h>
#include "base/language/say.hpp"
#include "commands/help.hpp"
#include "commands/modes.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "present/report/page.hpp"

namespace alembert {

namespace {

using Files = ValueKind::Files;

/// What may be typed as the first word, with the tree of what may follow: verbs, and the program's own options.
std::vector<std::pair<std::string, const CLI::App*>> first_words(const CLI::App& app) {
    std::vector<std::pair<std::string, const CLI::App*>> words;
    for (const CLI::App* verb : listed_verbs(app)) words.emplace_back(verb->get_name(), verb);
    for (const VerbMode& mode : modes_of("")) words.emplace_back(mode.option, app.get_subcommand(mode.earlier));
    return words;
}

/// The options of a verb and of its modes, each name once.
std::vector<OptionText> completed_options(const CLI::App& verb) {
    std::vector<OptionText> all = options_of(verb);
    for (const VerbMode& mode : modes_of(verb.get_name()))
        for (OptionText& option : options_of(*verb.get_parent()->get_subcommand(mode.earlier)))
            if (std::none_of(all.begin(), all.end(),
                             [&](const OptionText& one) { return one.names == option.names; }))
                all.push_back(std::move(option));
    return all;
}

/// The values that a positional argument or an option takes; for VERB, the verbs themselves.
ValueKind kind_of(const std::string& value, const CLI::App& app) {
    if (value == values::verb) {
        ValueKind kind{.name = value};
        for (const CLI::App* verb : listed_verbs(app)) kind.words.push_back(verb->get_name());
        return kind;
    }
    const ValueKind* const known = value_kind(value);
    return known == nullptr ? ValueKind{.name = value} : *known;
}

std::string bash_reply(const ValueKind& kind) {
    if (!kind.words.empty())
        return fmt::format("mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$cur\")", fmt::join(kind.words, " "));
    switch (kind.files) {
        case Files::any:
            return "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- \"$cur\")";
        case Files::folders:
            return "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- \"$cur\")";
        case Files::ending:
            return fmt::format(
                "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -X '!*.{}' -- \"$cur\"; "
                "compgen -d -- \"$cur\")",
                kind.ending);
        default:
            return ":";
    }
}

std::string bash(const CLI::App& app) {
    std::string options, positions, all, first;
    for (const auto& [word, verb] : first_words(app)) {
        std::string names;
        first += word + " ";
        int position = 0;
        for (const OptionText& option : completed_options(*verb)) {
            if (option.positional) {
                put(positions, "        {}.{}) {} ;;\n", word, position++,
                    bash_reply(kind_of(option.names[0], app)));
                continue;
            }
            for (const std::string& name : option.names) {
                names += (names.empty() ? "" : " ") + name;
                if (!option.value.empty())
                    put(options, "        {}.{}) {}; return ;;\n", word, name,
                        bash_reply(kind_of(option.value, app)));
            }
        }
        put(all, "            {}) words='{}' ;;\n", word, names);
    }
    return fmt::format(R"(# Completion of alembert for bash, written by 'alembert --completion bash'.
_alembert() {{
    local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD - 1]}} verb=${{COMP_WORDS[1]}} words='' position=0 i
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        mapfile -t COMPREPLY < <(compgen -W '{}--help --version' -- "$cur"; compgen -f -X '!*.toml' -- "$cur")
        return
    fi
    for ((i = 2; i < COMP_CWORD; ++i)); do
        if [[ ${{COMP_WORDS[i]}} != -* ]]; then position=$((position + 1)); fi
    done
    case $verb.$prev in
{}    esac
    if [[ $cur == -* ]]; then
        case $verb in
{}        esac
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
        return
    fi
    case $verb.$position in
{}    esac
}}
complete -F _alembert alembert
)",
                       first, options, all, positions);
}

/// The text in single quotes for a shell.
std::string quoted(std::string text) {
    for (std::size_t at = text.find('\''); at != std::string::npos; at = text.find('\'', at + 4))
        text.replace(at, 1, "'\\''");
    return "'" + text + "'";
}

/// A description inside a specification of _arguments.
std::string zsh_escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
        result += c;
    }
    return result;
}

std::string zsh_action(const ValueKind& kind) {
    if (!kind.words.empty()) return fmt::format(":{}:({})", kind.name, fmt::join(kind.words, " "));
    switch (kind.files) {
        case Files::any:
            return fmt::format(":{}:_files", kind.name);
        case Files::folders:
            return fmt::format(":{}:_files -/", kind.name);
        case Files::ending:
            return fmt::format(":{}:_files -g \"*.{}\"", kind.name, kind.ending);
        default:
            return fmt::format(":{}: ", zsh_escaped(kind.name));
    }
}

std::string zsh(const CLI::App& app) {
    std::string described, cases;
    for (const auto& [word, verb] : first_words(app)) {
        put(described, "        {}\n", quoted(word + ":" + zsh_escaped(verb->get_description())));
        put(cases, "        {})\n            _arguments", word);
        for (const OptionText& option : completed_options(*verb)) {
            if (option.positional) {
                put(cases, " \\\n                {}",
                    quoted((option.required ? "" : ":") + zsh_action(kind_of(option.names[0], app))));
                continue;
            }
            for (const std::string& name : option.names)
                put(cases, " \\\n                {}",
                    quoted(fmt::format("{}{}[{}]{}", option.repeated ? "*" : "", name, zsh_escaped(option.about),
                                       option.value.empty() ? "" : zsh_action(kind_of(option.value, app)))));
        }
        cases += "\n            ;;\n";
    }
    return fmt::format(R"(#compdef alembert
# Completion of alembert for zsh, written by 'alembert --completion zsh'.
_alembert() {{
    local -a verbs=(
{}    )
    if ((CURRENT == 2)); then
        _describe verb verbs
        _files -g "*.toml"
        return
    fi
    local verb=$words[2]
    shift words
    ((CURRENT--))
    case $verb in
{}    esac
}}
if [ "$funcstack[1]" = _alembert ]; then _alembert "$@"; else compdef _alembert alembert; fi
)",
                       described, cases);
}

std::string fish_arguments(const ValueKind& kind) {
    if (!kind.words.empty()) return fmt::format(" -a {}", quoted(fmt::format("{}", fmt::join(kind.words, " "))));
    switch (kind.files) {
        case Files::any:
            return " -F";
        case Files::folders:
            return " -a '(__fish_complete_directories)'";
        case Files::ending:
            return fmt::format(" -k -a '(__fish_complete_suffix .{})'", kind.ending);
        default:
            return "";
    }
}

std::string fish(const CLI::App& app) {
    std::string text =
        "# Completion of alembert for fish, written by 'alembert --completion fish'.\ncomplete -c alembert -f\n";
    for (const CLI::App* verb : listed_verbs(app))
        put(text, "complete -c alembert -n __fish_use_subcommand -a {} -d {}\n", verb->get_name(),
            quoted(verb->get_description()));
    for (const VerbMode& mode : modes_of(""))
        put(text, "complete -c alembert -n __fish_use_subcommand -l {} -x{} -d {}\n", mode.option + 2,
            fish_arguments(kind_of(mode.kind, app)), quoted(app.get_subcommand(mode.earlier)->get_description()));
    put(text, "complete -c alembert -n __fish_use_subcommand{}\n", fish_arguments(kind_of(values::scene, app)));
    for (const CLI::App* verb : listed_verbs(app)) {
        const std::string start =
            fmt::format("complete -c alembert -n '__fish_seen_subcommand_from {}'", verb->get_name());
        for (const OptionText& option : completed_options(*verb)) {
            const ValueKind kind = kind_of(option.positional ? option.names[0] : option.value, app);
            if (option.positional) {
                if (const std::string arguments = fish_arguments(kind); !arguments.empty())
                    put(text, "{}{}\n", start, arguments);
                continue;
            }
            text += start;
            for (const std::string& name : option.names)
                text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.value.empty()) text += " -r" + fish_arguments(kind);
            put(text, " -d {}\n", quoted(option.about));
        }
    }
    return text;
}

}  // namespace

void add_completion(CLI::App& app, Chosen& chosen) {
    const auto shell = std::make_shared<std::string>();
    Verb verb = add_verb(app, {.name = "completion",
                               .about = say("prints a script with which a shell completes commands"),
                               .example = "alembert --completion bash > alembert.bash"});
    verb.add_option("shell", *shell, say("bash, zsh or fish")).type_name(values::shell).required();
    verb.callback([shell, &app, &chosen] {
        chosen = {"completion", [shell, &app] {
                      show(*shell == "bash" ? bash(app) : *shell == "zsh" ? zsh(app) : fish(app));
                      return 0;
                  }};
    });
}

}  // namespace alembert
