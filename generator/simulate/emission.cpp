// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/emission.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "codegen/emit/casadi.hpp"
#include "codegen/emit/dialect.hpp"
#include "codegen/emit/names.hpp"
#include "codegen/emit/standalone.hpp"
#include "codegen/emit/taken_file_names.hpp"
#include "program/event_places.hpp"
#include "program/known_knots.hpp"
#include "program/lower/frame_functions.hpp"
#include "program/lower/operational_space.hpp"
#include "program/lower/quick_times.hpp"
#include "program/lower/regressor.hpp"
#include "program/lower/robot_functions.hpp"
#include "scene/text.hpp"
#include "scene/used_places.hpp"
#include "simulate/corners.hpp"
#include "simulate/emit_command.hpp"
#include "simulate/mass_watch.hpp"
#include "simulate/narrow_places.hpp"
#include "simulate/wrenches.hpp"

namespace alembert {

namespace {

Start assembled(const Mechanism& m) {
    Start start = start_of(m);
    assemble(start, m, lower_constraints(m), {});
    return start;
}

/// (q, q'), or (q, u).
std::vector<double> state_in(const Start& start, const Emission& e) {
    const State<double> at = state_of(start, e.mechanism, e.equations);
    std::vector<double> state = at.q;
    state.insert(state.end(), at.qdot.begin(), at.qdot.end());
    return state;
}

/// The main program supports equations and constraints only.
SourceFile main_program(const Emission& e, const Program& program, const EmitOptions& options, int event_places) {
    const Mechanism& m = e.mechanism;
    if (m.has_modes())
        throw ModelError(
            say("a main program beside the equations follows no contacts, dry friction nor events that change the "
                "motion, and this scene has some; use 'alembert simulate', or the library"));
    const Start start = assembled(m);
    std::vector<StopEvent> stops;
    for (std::size_t k = 0; k < m.event_actions.size(); ++k)
        if (m.event_actions[k].stop) stops.push_back({static_cast<int>(k), m.event_actions[k].direction});
    const std::vector<std::string> masses = changing_masses(e.scene);
    for (std::size_t k = 0; k < masses.size(); ++k)
        stops[stops.size() - masses.size() + k].failure =
            fmt::format("nothing is left of the mass of '{}'", masses[k]);
    return standalone(
        program,
        {.t = start.t,
         .state = state_in(start, e),
         .duration = start.duration,
         .tolerance = start.tolerance,
         .quick_times = sudden_times(quick_times(program, start.parameters, start.t, start.t + start.duration)),
         .stops = stops,
         .event_places = event_places},
        options);
}

/// For a main program that ends at events: the function of where these may be zero for a short time. Gives the
/// number of its values.
int add_event_places(Emission& e, Program& program) {
    const auto& actions = e.mechanism.event_actions;
    const std::vector<int> events = program.nodes_of(Group::event);
    std::vector<int> stops;
    for (std::size_t k = 0; k < actions.size(); ++k)
        if (actions[k].stop) stops.push_back(events[k]);
    std::vector<int> places = event_places(program, stops);
    const auto count = static_cast<int>(places.size());
    if (count > 0)
        e.functions.push_back({.name = "event_places",
                               .about =
                                   "Events that end the motion may touch zero, or pass it and come back, where "
                                   "one of these is zero.",
                               .rows = count,
                               .nodes = std::move(places)});
    return count;
}

/// What the scene says of parameters, coordinates and speeds.
std::map<std::string, SceneNote> notes_of(const Emission& e) {
    std::map<std::string, SceneNote> notes;
    const auto add = [&](const auto& items) {
        for (const auto& item : items)
            notes[item.name.text] = {item.shown.unit.empty() ? "" : item.shown.value + " " + item.shown.unit,
                                     item.about};
    };
    add(e.scene.parameters);
    add(e.scene.coordinates);
    add(e.scene.speeds);
    add(e.scene.states);
    return notes;
}

/// Between what is left out the equations hold.
std::vector<std::string> left_out_of(const Mechanism& m) {
    std::vector<std::string> names;
    for (const Mechanism::Unilateral& contact : m.unilateral) names.push_back("the contact " + contact.gap.name);
    for (const Mechanism::Friction& friction : m.frictions) names.push_back("sticking of " + friction.name);
    if (m.has_kicks()) names.push_back("what events set and the impulses they give");
    return names;
}

/// The state of the calling example: coordinates that follow from the constraints with 12 digits in the C++
/// source, so that the same text is written everywhere, and with all in headers and data; none, which is told, if
/// the scene has no initial state, without which the equations hold too.
void add_example(EmitOptions& options, Emission& e) {
    const auto begin = [&] {
        const Start start = start_of(e.mechanism);
        const std::vector<double> given = state_in(start, e);
        std::vector<double> state = state_in(assembled(e.mechanism), e);
        options.t = start.t;
        options.initial = state;
        for (std::size_t i = 0; i < state.size(); ++i) {
            if (state[i] == given[i]) continue;
            if (i < e.mechanism.q.size()) options.notes[e.mechanism.q[i].get_name()].given.clear();
            if (options.language == CodeLanguage::cpp) state[i] = std::stod(fmt::format("{:.12g}", state[i]));
        }
        options.state = state;
    };
    const auto tell = [&](const std::string& why) {
        e.warn("left_out", say("warning: the code has no initial state: {}\n", why));
    };
    try {
        begin();
    } catch (const ModelError& mistake) {
        tell(mistake.what());
    } catch (const IntegrationError& mistake) {
        tell(mistake.what());
    }
}

std::string command_of(const Scene& scene, const EmissionOptions& options) {
    EmitCommand command(scene.file);
    command.add("-o", ".");
    if (options.language != CodeLanguage::cpp)
        command.add("--language", std::string(dialect_of(options.language).option));
    command.add("--name", options.name);
    command.flag("--standalone", options.standalone);
    command.flag("--casadi", options.casadi);
    command.flag("--fold", options.fold);
    command.flag("--jacobian", options.jacobian);
    command.add("--functions", fmt::format("{}", fmt::join(options.functions, ",")));
    for (const std::string& frame : options.frames) command.add("--frame", frame);
    for (const std::string& wrench : options.wrenches) command.add("--wrench", wrench);
    command.flag("--batch", options.batch);
    for (const std::string& value : options.at) command.add("--at", value);
    command.add("--by", options.by);
    return command.text;
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Throws for functions that do not exist, before any is made.
void check_functions(const Emission& e, const EmissionOptions& options) {
    if (!e.equations.speeds_are_rates())
        throw ModelError(say(
            "functions such as 'inverse' take coordinates and their rates, and the equations are in other speeds; "
            "leave out the table [speeds], and choose no formalism that has speeds of its own"));
    if (!e.mechanism.states.empty())
        throw ModelError(say(
            "functions such as 'inverse' take coordinates and their rates, and the scene has first-order states "
            "besides; leave out the table [states]"));
    const std::vector<std::string>& known = all_functions();
    const std::vector<std::string>& of_frames = functions_of_operational_space();
    for (const std::string& name : options.functions)
        if (!holds(known, name))
            throw ModelError(say("there is no function {} to emit; expected some of: {}", in_quotes(name),
                                 fmt::join(known, ", ")));
        else if (holds(of_frames, name) && options.frames.empty())
            throw ModelError(say("'{}' is that of a frame; say of which with --frame", name));
}

/// Adds the functions to `program`, each once.
std::vector<NamedFunction> named_functions(Program& program, const Emission& e, const EmissionOptions& options) {
    if (options.functions.empty() && options.frames.empty()) return {};
    check_functions(e, options);
    std::vector<NamedFunction> result;
    const auto is_there = [&](const std::string& name) {
        return std::any_of(result.begin(), result.end(), [&](const NamedFunction& f) { return f.name == name; });
    };
    const RobotFunctions dynamics(e.mechanism, options.fold);
    for (const std::string& name : options.functions) {
        if (is_there(name) || holds(functions_of_operational_space(), name)) continue;
        const FunctionProgram function =
            name == "regressor"                  ? regressor(e.scene, e.mechanism, options.fold).function
            : holds(functions_of_masses(), name) ? mass_function(e.scene, e.mechanism, name, options.fold)
                                                 : dynamics.dynamics(name);
        result.push_back(absorbed(program, function));
    }
    std::set<std::string> taken;
    if (e.derivatives) taken.insert({"jacobian", "parameter_jacobian"});
    for (const NamedFunction& function : result) taken.insert(function.name);
    const auto add = [&](const std::string& frame, const FunctionProgram& function) {
        if (!taken.insert(function.name).second)
            throw ModelError(
                say("'{}' would be a function of the frame {} and another one too; give that point another name, "
                    "or leave the other function out",
                    function.name, in_quotes(frame)));
        result.push_back(absorbed(program, function));
    };
    std::map<std::string, std::string> prefixes;
    for (const std::string& frame : options.frames) {
        const std::string prefix = ascii_identifier(frame);
        const auto [known, is_new] = prefixes.try_emplace(prefix, frame);
        if (!is_new && known->second != frame)
            throw ModelError(
                say("the functions of {} and {} would have the same names, '{}_pose' …; ask for them one by one",
                    in_quotes(known->second), in_quotes(frame), prefix));
        if (!is_new) continue;
        for (const FunctionProgram& f : frame_functions(e.scene, e.mechanism, frame, prefix, options.fold))
            add(frame, f);
        for (const std::string& name : functions_of_operational_space())
            if (holds(options.functions, name))
                add(frame, operational_function(e.scene, e.mechanism, frame, prefix, name, options.fold));
    }
    return result;
}

}  // namespace

const std::vector<std::string>& all_functions() {
    static const std::vector<std::string> known = [] {
        std::vector<std::string> names = RobotFunctions::of_dynamics();
        names.insert(names.end(), functions_of_masses().begin(), functions_of_masses().end());
        names.emplace_back("regressor");
        names.insert(names.end(), functions_of_operational_space().begin(),
                     functions_of_operational_space().end());
        return names;
    }();
    return known;
}

CodeLanguage language_of(std::string_view name) {
    const Dialect* const dialect = dialect_of(name);
    return dialect == nullptr ? CodeLanguage::cpp : dialect->language;
}

std::vector<SourceFile> files_of(const Emission& e) {
    std::vector<SourceFile> files = {{e.source.file, e.source.text}};
    for (const std::optional<SourceFile>* other : {&e.source.header, &e.main, &e.casadi})
        if (*other) files.push_back(**other);
    return files;
}

Emission emission(Scene scene, const EmissionOptions& options) {
    if (options.standalone && options.language > CodeLanguage::c)
        throw ModelError(say("a main program beside the equations is in C++ or C; leave out --standalone"));
    for (const std::string& place : options.frames) check_place(scene, place);
    are_used(scene, options.frames);
    are_used(scene, options.wrenches);
    if (!options.name.empty() && ascii_identifier(options.name) != options.name)
        throw ModelError(
            say("{} is no name for a file and a namespace; expected letters without accents, digits "
                "and _, the first of them a letter",
                in_quotes(options.name)));
    const std::string command = command_of(scene, options);
    for (const std::string& place : options.wrenches) with_wrench(scene, place, ascii_identifier(place));
    if (options.standalone) scene = with_masses_watched(std::move(scene));
    Emission e{derived(std::move(scene), {.by = options.by, .use = Use::run})};
    if (e.mechanism.has_modes())
        e.warn("left_out",
               say("warning: contacts, dry friction that sticks and what events set or give, which change the "
                   "motion, are left out of emitted functions, which hold between them; 'alembert "
                   "simulate' and the library follow them\n"));
    warn_of_corners(e);
    e.choice = lowered(e, options.fold);
    if (options.jacobian || options.casadi) {
        e.derivatives = derivatives_of(e, e.choice.program, {.parameters = true, .power = true}, options.fold);
        if (!e.derivatives && options.jacobian)
            throw ModelError(say(
                "the derivatives of the right-hand side are too long to be written out; leave the Jacobian out"));
    }
    Program& program = e.derivatives ? e.derivatives->program : e.choice.program;
    e.functions = named_functions(program, e, options);
    const std::vector<int> second =
        options.casadi && e.derivatives ? casadi_second_derivatives(program) : std::vector<int>();
    if (!options.name.empty()) program.name = options.name;
    if (is_taken_file_name(ascii_identifier(program.name), options.language)) program.name += "_scene";
    if (options.standalone || options.casadi)  // these have parameters alone, and nobody gives inputs
        for (Quantity& p : program.parameters) p.from_outside = false;
    const int places = options.standalone ? add_event_places(e, program) : 0;
    EmitOptions text{.batch = options.batch,
                     .language = options.language,
                     .functions = e.functions,
                     .jacobian_tangent = second,
                     .notes = notes_of(e),
                     .command = command,
                     .left_out = left_out_of(e.mechanism)};
    add_example(text, e);
    e.source = emit(program, text);
    if (options.standalone) {
        e.main = main_program(e, program, text, places);
        const Start start = start_of(e.mechanism);
        tell_narrow_places(e, program, Kinks::watched, start.state(), start.duration);
        for (const std::string& name : tables_with_close_knots(program))
            e.warn(
                "left_out",
                say("warning: the table '{}' has knots so close that steps of a program of its own may pass what "
                    "is between them; in 'alembert simulate' steps end at each knot\n",
                    name));
    }
    if (options.casadi) e.casadi = casadi_functions(program, text);
    return e;
}

}  // namespace alembert
