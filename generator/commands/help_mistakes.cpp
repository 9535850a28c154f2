// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/help_mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>

#include "base/language/say.hpp"
#include "commands/help.hpp"
#include "commands/modes.hpp"
#include "commands/values.hpp"
#include "commands/words_meant.hpp"
#include "scene/advice.hpp"
#include "scene/scene.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

std::string did_you_mean(const std::string& word) {
    return word.empty() ? "" : say("; did you mean {}?", word);
}

bool is_among(const std::vector<std::string>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::string about_verb(const CLI::App& verb) {
    return say("'alembert {} --help' lists its options", title_of(verb.get_name()));
}

std::vector<std::string> names_of_options(const CLI::App& verb) {
    std::vector<std::string> names;
    for (const OptionText& option : options_of(verb))
        if (!option.positional) names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

/// The option that is meant by one that the verb does not have: of another program, a beginning, or misspelled.
std::string option_meant(const std::string& typed, const std::vector<std::string>& known) {
    const std::string stem = typed.substr(std::min(typed.find_first_not_of('-'), typed.size()));
    if (is_among(known, "--" + stem)) return "--" + stem;
    const std::string_view other = option_meant_by(bare(stem));
    if (!other.empty() && is_among(known, other)) return std::string(other);
    std::string whole;
    int begun = 0;
    for (const std::string& name : known)
        if (stem.size() > 1 && name.starts_with("--" + stem)) whole = name, ++begun;
    return begun == 1 ? whole : nearest("--" + stem, known);
}

/// Dashes that a word processor has made long are read as two.
std::string with_plain_dash(std::string word) {
    for (const std::string_view dash : {"—", "–", "−"})
        if (word.starts_with(dash)) return "--" + word.substr(dash.size());
    return word;
}

/// A value that is empty, or given to an option that has none: CLI11 reads `--steps=false` as if it were not
/// there.
std::string mistake_in_value(const CLI::App& verb, const std::vector<std::string>& words, std::size_t k) {
    const std::size_t equals = words[k].find('=');
    const std::string name = words[k].substr(0, equals);
    const CLI::Option* const option = option_of(verb, name);
    if (option == nullptr) return {};
    const bool takes_none = option->get_expected_max() == 0;
    if (takes_none) return equals == std::string::npos ? "" : say("{} takes no value", name);
    const bool is_empty =
        equals != std::string::npos ? equals + 1 == words[k].size() : k + 1 < words.size() && words[k + 1].empty();
    return is_empty ? say("{} is given an empty value; leave it out, or give one", name) : "";
}

std::string mistake_in_options(const CLI::App& verb, const std::vector<std::string>& words) {
    const std::vector<std::string> known = names_of_options(verb);
    for (std::size_t k = 1; k < words.size() && words[k] != "--"; ++k) {
        if (const std::string mistake = mistake_in_value(verb, words, k); !mistake.empty())
            return mistake + "\n" + about_verb(verb) + "\n";
        const std::string typed = words[k].substr(0, words[k].find('=')), name = with_plain_dash(typed);
        const bool is_long = name.starts_with("--") && name.size() > 2;
        const bool is_short_for_long =
            !is_long && name.starts_with('-') && name.size() > 2 && option_of(verb, "-" + name) != nullptr;
        if (!is_short_for_long && (!is_long || (name == typed && option_of(verb, name) != nullptr))) continue;
        return say("{} has no option {}{}\n", title_of(verb.get_name()), in_quotes(typed),
                   did_you_mean(option_meant(name, known))) +
               about_verb(verb) + "\n";
    }
    return {};
}

/// An option as its help shows it: "--tolerance NUMBER".
std::string shown(const OptionText& option) {
    return option.names.back() + (option.value.empty() || option.positional ? "" : " " + option.value);
}

/// The option that a message of CLI11 names at its beginning or after a mark; nothing if it names none.
std::optional<OptionText> option_named(const CLI::App& verb, const std::string& name) {
    for (const CLI::Option* const option : verb.get_options({})) {
        if (option->get_name(false, true) != name && option->get_name() != name) continue;
        for (OptionText& text : options_of(verb)) {
            const bool is_it =
                text.positional ? text.names[0] == option->get_type_name() : option->check_name(text.names.back());
            if (is_it && text.positional == option->get_positional()) return std::move(text);
        }
    }
    return {};
}

/// What stands in a text between two parts of it; nothing if it is not of this form.
std::optional<std::string> between(std::string_view text, std::string_view before, std::string_view after) {
    const std::size_t begin = text.find(before);
    if (begin == std::string_view::npos) return {};
    const std::size_t from = begin + before.size();
    const std::size_t end = after.empty() ? text.size() : text.find(after, from);
    if (end == std::string_view::npos) return {};
    return std::string(text.substr(from, end - from));
}

std::string as_in(const CLI::App& verb) {
    return say("as in: {}", verb.get_footer());
}

std::string missing(const CLI::App& verb, const std::string& name) {
    const std::optional<OptionText> option = option_named(verb, name);
    if (!option) return say("something is missing, {}", as_in(verb));
    return say("{} needs {}: {}, {}", title_of(verb.get_name()), shown(*option), option->about, as_in(verb));
}

std::string not_convertible(const CLI::App& verb, const std::string& name, const std::string& value) {
    const std::optional<OptionText> option = option_named(verb, name);
    const bool is_whole = option && option->value == values::count;
    // In WebAssembly `long` has 32 bits.
    const std::size_t sign = value.substr(0, 1) == "-" || value.substr(0, 1) == "+" ? 1 : 0;
    if (is_whole && value.size() > sign && value.find_first_not_of("0123456789", sign) == std::string::npos)
        return say("{}: expected a whole number from {} to {}", name + " " + value, 1,
                   std::numeric_limits<long>::max());
    return say("{} {}: expected {}", name, escaped(value), is_whole ? say("a whole number") : say("a number"));
}

/// What CLI11 says is recognized by its class and taken apart; its own words are never shown.
std::string mistake_of(const CLI::App& verb, const CLI::Error& error) {
    const std::string text = error.what(), kind = error.get_name();
    if (kind == "RequiredError")
        if (const auto name = between(text, "", " is required")) return missing(verb, *name);
    if (const auto words = between(text, " not expected: ", ""))
        return say("{} is not expected here; write: {}", in_quotes(*words), usage_of(verb));
    if (kind == "ConversionError") {
        const auto name = between(text, "Could not convert: ", " = "), value = between(text, " = ", "");
        if (name && value) return not_convertible(verb, *name, *value);
    }
    if (kind == "ValidationError")
        if (const auto name = between(text, "", ": ")) return *name + " " + text.substr(name->size() + 2);
    if (kind == "RequiresError")
        if (const auto name = between(text, "", " requires "))
            return say("{} goes with {}; give both", *name, *between(text, " requires ", ""));
    if (kind == "ExcludesError")
        if (const auto name = between(text, "", " excludes "))
            return say("{} does not go with {}; give one of them", *name, *between(text, " excludes ", ""));
    if (kind == "ArgumentMismatch") {
        const auto name = between(text, "", ":");
        const std::optional<OptionText> option = name ? option_named(verb, *name) : std::nullopt;
        if (option && text.find("missing") != std::string::npos)
            return say("{} needs a value: {}", *name, shown(*option));
        if (option && text.find("At Most") != std::string::npos)
            return say("{} is given more than once; give it once", *name);
    }
    if (const auto name = between(text, "", " was given")) return say("{} takes no value", *name);
    if (const auto name = between(text, "", ": "); name && option_named(verb, *name))
        return say("{} takes no value", *name);
    return say("these words are not understood; write: {}", usage_of(verb));
}

/// The first word is no verb.
std::string mistake_in_verb(const CLI::App& app, const std::string& typed) {
    if (typed.starts_with('-'))
        return say("{} stands where a verb is expected, as in: {}\n'alembert' alone lists the verbs\n",
                   in_quotes(typed), app.get_footer());
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
    std::string meant(verb_meant_by(bare(typed)));
    if (meant.empty()) meant = is_among(verbs, bare(typed)) ? bare(typed) : nearest(typed, verbs);
    return say("unknown verb {}{}\n'alembert' alone lists the verbs\n", in_quotes(typed),
               did_you_mean(title_of(meant)));
}

}  // namespace

std::string mistake_in(const CLI::App& app, const std::vector<std::string>& words) {
    if (words[0] == "--help" || words[0] == "-h" || words[0] == "--version") return {};
    for (const CLI::App* verb : app.get_subcommands({}))
        if (verb->get_name() == words[0]) return mistake_in_options(*verb, words);
    return mistake_in_verb(app, words[0]);
}

std::string failure_message(const CLI::App* app, const CLI::Error& error) {
    const std::vector<CLI::App*> chosen = app->get_subcommands();
    const CLI::App& verb = chosen.empty() ? *app : *chosen[0];
    return mistake_of(verb, error) + "\n" +
           (chosen.empty() ? say("'alembert' alone lists the verbs") : about_verb(verb)) + "\n";
}

}  // namespace alembert
