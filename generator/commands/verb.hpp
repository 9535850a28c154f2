// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verbs of the command line. Each registers itself with its options; when it is chosen, it calls the library
/// once and shows the result, for people or, with --json, for programs.
///
///     CLI::App app;
///     Chosen chosen;
///     add_verbs(app, chosen);
///     app.parse(argc, argv);
///     const int code = chosen.action();
///
/// Mistakes are thrown as exceptions, which main turns into messages and the exit codes of docs/commands.md.

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "commands/options.hpp"
#include "program/lower/start.hpp"
#include "scene/scene.hpp"
#include "stability/interval/point.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace alembert {

/// The verb that the command line has chosen.
struct Chosen {
    std::string subject;          ///< the file that messages name, which is the scene
    std::function<int()> action;  ///< does the work and returns the exit code
};

/// What verbs take in place of values of the scene, as typed; inputs by those that integrate.
struct GivenValues {
    std::vector<std::string> at = {}, inputs = {};
};

/// The options that every verb takes, and those that many take.
struct SceneOptions {
    std::string scene;
    bool json = false;
    bool full = false;  ///< whether a page may exceed two screens
    std::string by;     ///< a formalism; if empty, the program chooses
    GivenValues given = {};
};

void add_agree(CLI::App& app, Chosen& chosen);
void add_audit(CLI::App& app, Chosen& chosen);
void add_bench(CLI::App& app, Chosen& chosen);
void add_check(CLI::App& app, Chosen& chosen);
void add_derive(CLI::App& app, Chosen& chosen);
void add_emit(CLI::App& app, Chosen& chosen);
void add_equilibrium(CLI::App& app, Chosen& chosen);
void add_eval(CLI::App& app, Chosen& chosen);
void add_fmu(CLI::App& app, Chosen& chosen);
void add_identify(CLI::App& app, Chosen& chosen);
void add_impact(CLI::App& app, Chosen& chosen);
void add_import(CLI::App& app, Chosen& chosen);
void add_inertia(CLI::App& app, Chosen& chosen);
void add_inverse(CLI::App& app, Chosen& chosen);
void add_kinematics(CLI::App& app, Chosen& chosen);
void add_linearize(CLI::App& app, Chosen& chosen);
void add_new(CLI::App& app, Chosen& chosen);
void add_report(CLI::App& app, Chosen& chosen);
void add_simulate(CLI::App& app, Chosen& chosen);
void add_stability(CLI::App& app, Chosen& chosen);
void add_sweep(CLI::App& app, Chosen& chosen);
void add_watch(CLI::App& app, Chosen& chosen);
void add_completion(CLI::App& app, Chosen& chosen);
void add_manual(CLI::App& app, Chosen& chosen);

/// Adds all verbs in the order in which --help shows them.
void add_verbs(CLI::App& app, Chosen& chosen);

/// --at NAME=VALUE, any number of times. Throws ModelError for anything that is not of this form.
/// Numbers are in the unit that the scene gives for the name.
Overrides overrides_of(const std::vector<std::string>& at, const Scene& scene);

/// The scene with the values of --at and the functions of --input (analysis/state/given_values.hpp).
Scene with_given(Scene scene, const GivenValues& given);

/// The scene of the file, with what is given for it.
Scene scene_of(const SceneOptions& options);

/// The same as typed, as expressions in SI units.
ExactOverrides exact_overrides_of(const std::vector<std::string>& at, const Scene& scene);

/// Names, or an expression, in the words of the scene: "theta1'" for "θ1dot" (scene/typed_words.hpp).
std::string in_words_of(const Scene& scene, const std::string& text);

/// A number as typed, or an expression of numbers and pi (model/constant.hpp). Throws ModelError for anything
/// else.
double number_of(const std::string& text);

/// An option that was just added to a verb, for setting its further properties.
class AddedOption {
public:
    explicit AddedOption(CLI::Option* option) : option_(option) {}
    /// The kind of its value, one of commands/values.hpp. Where that has all words that may be given, the value is
    /// checked against them; a word that differs from one in capitals and dashes is taken for that one.
    AddedOption& type_name(const char* kind);
    /// Kind and range of a row of the table; nothing of a flag.
    AddedOption& as(const SharedOption& shared);
    AddedOption& silent();  ///< not shown: an earlier name
    AddedOption& required();
    AddedOption& positive();  ///< requires a number above zero; CLI11's own check accepts NaN
    AddedOption& nonnegative();
    AddedOption& between(int least, int most);

private:
    CLI::Option* option_;
};

/// A verb while its options are added. CLI11 is included only in the few files that go through all verbs and not
/// here, because it adds three seconds of compile time to every file that includes it.
class Verb {
public:
    explicit Verb(CLI::App& app) : app_(&app) {}
    /// The value is not changed if the option is not given. T: std::string, double, int, std::size_t, an
    /// std::optional of these, std::vector<std::string>.
    template <typename T>
    AddedOption add_option(const std::string& names, T& value, const std::string& about);
    AddedOption add_flag(const std::string& names, bool& value, const std::string& about);
    /// Adds an option, or for a bool a flag, that the table of shared options has (commands/options.hpp).
    template <typename T>
    AddedOption take(const char* name, T& value, const std::string& about = {}) {
        const SharedOption& shared = shared_option(name);
        const std::string& words = about.empty() ? shared.about : about;
        if constexpr (std::is_same_v<T, bool>)
            return add_flag(shared.names, value, words);
        else
            return add_option(shared.names, value, words).as(shared);
    }
    /// Sets the function that is called when the verb has been chosen and its options have been read.
    void callback(std::function<void()> chosen);

private:
    CLI::App* app_;
};

/// --at, of verbs that take the scene as it then is.
void add_given_state(Verb& verb, GivenValues& given);

/// --at, --input.
void add_given_values(Verb& verb, GivenValues& given);

/// SCENE, --json, --strict.
void add_scene_options(Verb& verb, SceneOptions& options);

/// The text of `--help` for a verb. The example is a command line that works in the folder of the repository.
struct VerbText {
    const char* name;
    std::string about;
    const char* example;
};
Verb add_verb(CLI::App& app, const VerbText& text);

/// Adds a verb on a scene. `Options` derives from SceneOptions; `more` adds the verb's own options; `run` does the
/// work and returns the exit code.
template <typename Options>
void add_scene_verb(CLI::App& app, Chosen& chosen, const VerbText& text, int (*run)(const Options&),
                    const std::function<void(Verb&, Options&)>& more = {}) {
    const auto options = std::make_shared<Options>();
    Verb verb = add_verb(app, text);
    add_scene_options(verb, *options);
    if (more) more(verb, *options);
    verb.callback([options, run, &chosen] {
        chosen = {options->scene, [options, run] { return run(*options); }};
    });
}

}  // namespace alembert
