// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/run.hpp"

#include <algorithm>

#include "alembert/native/registers.hpp"
#include "base/language/say.hpp"
#include "codegen/emit/layout.hpp"
#include "present/report/page.hpp"
#include "present/report/shown_unit.hpp"

namespace alembert {

const char* name_of(ContactEvent::Kind kind) {
    switch (kind) {
        case ContactEvent::Kind::impact:
            return to_say("impact");
        case ContactEvent::Kind::release:
            return to_say("release");
        default:
            return to_say("rest");
    }
}

namespace {

constexpr std::size_t most_lines = 20;

/// What event number `row` of the run records, by name.
std::vector<std::pair<std::string, double>> recorded_at(const Run& run, std::size_t row) {
    std::vector<std::pair<std::string, double>> result;
    const EventRecord& event = run.motion.events[row];
    for (const std::string& told : run.mechanism.event_actions[static_cast<std::size_t>(event.index)].record) {
        const auto& columns = run.event_rows.columns;
        const auto column = std::find(columns.begin(), columns.end(), told) - columns.begin();
        result.emplace_back(told, run.event_rows.at(row, static_cast<std::size_t>(column)));
    }
    return result;
}

Json json_of(const Run& run, std::size_t row) {
    const Mechanism& m = run.mechanism;
    const EventRecord& event = run.motion.events[row];
    const auto k = static_cast<std::size_t>(event.index);
    Json result{{"name", m.events[k].name}, {"time", event.time}};
    for (const auto& [name, value] : recorded_at(run, row)) result["record"][name] = value;
    if (event.impulse.empty()) return result;
    result["impulses"] = Json::object();
    const std::vector<GiNaC::ex>& given = m.event_actions[k].impulse;
    for (std::size_t i = 0; i < event.impulse.size(); ++i)
        if (given.empty() ? event.impulse[i] != 0 : !given[i].is_zero())
            result["impulses"][m.q[i].get_name()] = event.impulse[i];
    result["energy_gain"] = event.energy_gain;
    return result;
}

bool has_impulses(const Mechanism& m) {
    return std::any_of(m.event_actions.begin(), m.event_actions.end(), [](const Mechanism::EventAction& action) {
        return !action.impulse.empty() || !action.rates.empty();
    });
}

std::string text_of_events(const Run& run) {
    const std::vector<EventRecord>& events = run.motion.events;
    std::string text;
    for (std::size_t i = 0; i < events.size(); ++i) {
        if (i + 1 == most_lines && events.size() > most_lines) {
            text += say("… and {} more, then\n", events.size() - most_lines);
            i = events.size() - 1;
        }
        const EventRecord& event = events[i];
        std::string told = event.impulse.empty() ? "" : say(", energy gain {:.6g}", event.energy_gain);
        for (const auto& [name, value] : recorded_at(run, i)) told += fmt::format(", {} = {:.10g}", name, value);
        text += say("event {} at t = {:.15g}{}\n",
                    run.mechanism.events[static_cast<std::size_t>(event.index)].name, event.time, told);
    }
    return text;
}

Json json_of(const std::vector<ContactEvent>& events, const std::vector<std::string>& names) {
    Json list = Json::array();
    for (const ContactEvent& e : events)
        list.push_back({{"time", e.time},
                        {"name", names[static_cast<std::size_t>(e.contact)]},
                        {"event", name_of(e.kind)},
                        {"speed_before", e.speed_before},
                        {"speed_after", e.speed_after},
                        {"energy_loss", e.energy_loss},
                        {"reaction_impulse", e.impulse}});
    return list;
}

std::string text_of(const std::vector<ContactEvent>& events, const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < std::min(events.size(), most_lines); ++i) {
        const ContactEvent& e = events[i];
        text += say("contact {}: {} at t = {:.15g}", names[static_cast<std::size_t>(e.contact)],
                    translated(name_of(e.kind)), e.time);
        if (e.kind == ContactEvent::Kind::impact)
            text +=
                say(", speed {:.6g} -> {:.6g}, energy loss {:.6g}", e.speed_before, e.speed_after, e.energy_loss);
        text += "\n";
    }
    if (events.size() > most_lines) text += say("… and {} more\n", events.size() - most_lines);
    return text;
}

/// Impacts, releases, sticking and slipping in the order of time.
Json contacts_of(const Run& run) {
    std::vector<Json> list;
    for (Json& event : json_of(run.motion.contacts, run.contacts)) list.push_back(std::move(event));
    for (const Run::FrictionChange& change : run.friction_changes) {
        const Mechanism::Friction& friction = run.mechanism.frictions[static_cast<std::size_t>(change.friction)];
        list.push_back({{"time", change.time},
                        {"name", friction.name},
                        {"event", change.side == 0 ? "stick" : "slip"},
                        {"side", change.side}});
        if (friction.across && change.side != 0) list.back()["direction"] = change.direction;
    }
    std::stable_sort(list.begin(), list.end(), [](const Json& a, const Json& b) { return a["time"] < b["time"]; });
    return list;
}

std::string text_of(const std::vector<Run::FrictionChange>& changes, const Mechanism& m) {
    std::string text;
    for (std::size_t k = 0; k < std::min(changes.size(), most_lines); ++k) {
        const Mechanism::Friction& friction = m.frictions[static_cast<std::size_t>(changes[k].friction)];
        const auto& [first, second] = changes[k].direction;
        text += say("friction {}: {} at t = {:.15g}\n", friction.name,
                    changes[k].side == 0  ? say("sticks")
                    : friction.across     ? say("slips along ({:.6g}, {:.6g})", first, second)
                    : changes[k].side > 0 ? say("slips (+)")
                                          : say("slips (-)"),
                    changes[k].time);
    }
    if (changes.size() > most_lines) text += say("… and {} more\n", changes.size() - most_lines);
    return text;
}

/// A change of method in words: "radau from t = 0.31 on: …".
std::string described(const Switch& s) {
    if (s.why == Switch::Why::mild)
        return say("{} again from t = {:.6g} on: the system is not stiff there", s.method, s.time);
    if (s.why == Switch::Why::dear)
        return say("{} again from t = {:.6g} on: its steps cost less there", s.method, s.time);
    if (s.why == Switch::Why::stuck)
        return say("{} from t = {:.6g} on: the steps of the method before became very short there", s.method,
                   s.time);
    if (s.why == Switch::Why::cheaper)
        return say("{} from t = {:.6g} on: by the steps until then, it is predicted to take less time", s.method,
                   s.time);
    return say(
        "{} from t = {:.6g} on: the system is stiff there (an eigenvalue of size {:.3g}/s held the step at {:.3g} "
        "s)",
        s.method, s.time, s.largest_eigenvalue, s.step);
}

Json json_of(const Switch& s) {
    constexpr const char* reasons[] = {"stiff", "mild", "dear", "stuck", "cheaper"};
    return {{"time", s.time},
            {"method", s.method},
            {"largest_eigenvalue", s.largest_eigenvalue},
            {"step", s.step},
            {"why", reasons[static_cast<int>(s.why)]}};
}

Json json_of(const ErrorEstimate& e, const std::vector<std::string>& reasons) {
    const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
    Json result{
        {"value", number(e.value)},
        {"by", e.by},
        {"trustworthy", reasons.empty()},
        {"norm",
         say("value: at most max |error| / max(1, |y|) of coordinates, rates and speeds at the end; scaled: "
             "max |error| / how far components of "
             "that unit move in the run")},
        {"scaled", number(e.scaled)},
        {"reasons", reasons}};
    if (e.at_jump) result["at_jump"] = true;
    if (e.lyapunov) result["lyapunov_exponent"] = *e.lyapunov;
    if (e.horizon) result["no_digit_after"] = *e.horizon;
    return result;
}

std::string word(const Run::Side& side) {
    switch (side.kind) {
        case ModeChange::Kind::sliding:
            return side.is_knot ? say("stays at a knot") : say("stays zero");
        case ModeChange::Kind::leaving:
            return side.is_knot ? say("leaves a knot") : say("leaves zero");
        default:
            return side.is_knot ? say("passes a knot") : say("changes sign");
    }
}

const char* event_name(const Run::Side& side) {
    switch (side.kind) {
        case ModeChange::Kind::sliding:
            return "sliding";
        case ModeChange::Kind::leaving:
            return "leaving";
        default:
            return side.is_knot ? "knot" : "crossing";
    }
}

std::string text_of(const std::vector<Run::Side>& changes) {
    constexpr std::size_t most = 20;
    std::string page;
    for (std::size_t k = 0; k < std::min(most, changes.size()); ++k)
        put(page, "t = {:.15g}: {} {}\n", changes[k].time, changes[k].name, word(changes[k]));
    if (changes.size() > most) say_on(page, "… and {} such changes more\n", changes.size() - most);
    return page;
}

/// The reason why the result should not be trusted; empty if there is none.
std::string warning_of(const Run& run) {
    return run.distrust_reasons.empty() ? std::string()
                                        : say("NOT TRUSTWORTHY: {}", fmt::join(run.distrust_reasons, "; "));
}

/// " of 67 operations"; empty if all accelerations are constants.
std::string of_operations(const Run& run) {
    const int count = run.solver.operations;
    if (count == 0) return "";
    const bool varies = run.motion.phases.size() > 1 && !run.contacts.empty();
    return say(" of {}{}", varies ? say("at most ") : "", shown_count(count, to_say("operation")));
}

/// Adds the method, the end of the motion and the contacts that were closed then.
void add_motion(std::string& page, const Run& run, int digits) {
    const Statistics& s = run.motion.statistics;
    say_on(page, "{} with {}: {}, {} rejected, {}{}\n", translated_parts(run.solver.formulation), s.method,
           shown_count(s.steps, to_say("step")), s.rejected, shown_count(s.evaluations, to_say("evaluation")),
           of_operations(run));
    if (!run.why_method.empty()) put(page, "{}\n", say("method: {}, {}", s.method, run.why_method));
    if (run.is_regularized)
        say_on(page, "regularized: steps are those of a time of its own, short where the potential is deep\n");
    if (s.switched) put(page, "{}\n", described(*s.switched));
    constexpr std::size_t most_switches = 4;
    const std::size_t later = s.later_switches.size();
    for (std::size_t k = 0; k < std::min(later, most_switches); ++k)
        put(page, "{}\n", described(s.later_switches[k]));
    if (later > most_switches) say_on(page, "… and {} more changes of method\n", later - most_switches);
    if (run.solver.jacobian_operations)
        say_on(page, "the Jacobian is emitted: {} operations\n", *run.solver.jacobian_operations);
    page += text_of_events(run);
    page += text_of(run.motion.contacts, run.contacts);
    page += text_of(run.friction_changes, run.mechanism);
    for (std::size_t k = 0; k < std::min(run.chart_passes.size(), most_lines); ++k)
        say_on(page, "{}: by a quaternion from t = {:.15g} to {:.15g}, near gimbal lock\n", run.chart_frame,
               run.chart_passes[k].begin, run.chart_passes[k].end);
    if (run.chart_passes.size() > most_lines)
        say_on(page, "… and {} more\n", run.chart_passes.size() - most_lines);
    page += text_of(run.side_changes);
    say_on(page, "\nat t = {:.15g}\n", run.motion.final_time());
    const Mechanism& m = run.mechanism;
    std::vector<std::string> coordinates, speeds;
    for (std::size_t i = 0; i < run.coordinates.size(); ++i)
        coordinates.push_back(ShownUnit(m.shown_units[i]).label(run.coordinates[i]));
    for (std::size_t k = 0; k < run.speeds.size(); ++k)
        speeds.push_back(ShownUnit(m.speeds[k].shown).label(run.speeds[k]));
    std::vector<std::string> states;
    for (const Mechanism::State& z : m.states)
        states.push_back(ShownUnit(z.shown).label(z.derivative[0].get_name()));
    const std::size_t width = column_for(states, column_for(speeds, column_for(coordinates, 16)));
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
        const ShownUnit unit(m.shown_units[i]);
        say_on(page, "{:<{}}{:>{}.{}g}   rate {:>{}.{}g}\n", coordinates[i], width,
               unit.value(run.final_coordinates[i]), digits + 8, digits, unit.value(run.final_rates[i]),
               digits + 8, digits);
    }
    for (std::size_t k = 0; k < speeds.size(); ++k)
        put(page, "{:<{}}{:>{}.{}g}\n", speeds[k], width, ShownUnit(m.speeds[k].shown).value(run.final_speeds[k]),
            digits + 8, digits);
    for (std::size_t k = 0; k < states.size(); ++k)
        put(page, "{:<{}}{:>{}.{}g}\n", states[k], width, ShownUnit(m.states[k].shown).value(run.final_states[k]),
            digits + 8, digits);
    if (run.contacts.empty()) return;
    std::string closed;
    for (const int k : run.motion.phases.back().closed)
        closed += (closed.empty() ? "" : ", ") + run.contacts[static_cast<std::size_t>(k)];
    say_on(page, "closed: {}\n", closed.empty() ? say("no contact") : closed);
}

/// Adds ∂(end)/∂(start, parameters).
void add_sensitivity(std::string& page, const Sensitivity& s, int digits) {
    const std::string steps = shown_count(s.steps, to_say("step"));
    if (s.adjoint)
        say_on(page, "\nderivatives at t = {:.15g} (adjoint equations, {})\n", s.time, steps);
    else
        say_on(page, "\nderivatives at t = {:.15g} ({})\n", s.time, steps);
    std::vector<std::string> by;
    for (const std::string& name : s.by) by.push_back(say("by {}", name));
    const bool down = s.by.size() > s.of.size();  // the longer list goes down the page
    const std::vector<std::string>&rows = down ? by : s.of, &columns = down ? s.of : by;
    const std::size_t width = column_for(rows, 16);
    put(page, "{:<{}}", "", width);
    for (const std::string& name : columns) put(page, "{:>{}}", name, digits + 8);
    page += '\n';
    for (std::size_t i = 0; i < rows.size(); ++i) {
        put(page, "{:<{}}", rows[i], width);
        for (std::size_t k = 0; k < columns.size(); ++k)
            put(page, "{:>{}.{}g}", down ? s.values[k][i] : s.values[i][k], digits + 8, digits);
        page += '\n';
    }
}

/// Adds the accuracy of the numbers.
void add_account(std::string& page, const Run& run) {
    if (run.estimate && run.estimate->value) {
        const ErrorEstimate& e = *run.estimate;
        say_on(page, "\nestimated error {:.1e} ({:.1e} of the motion's size), by {}\n", *e.value, *e.scaled, e.by);
        if (e.at_jump)
            say_on(page,
                   "the run ends at the instant of an impact or impulse: its end may be on either side of it\n");
        if (e.lyapunov)
            say_on(
                page,
                "neighbouring motions part by a factor e each {:.3g} s; no digit is left after about t = {:.4g}\n",
                1 / *e.lyapunov, *e.horizon);
    }
    const EnergyAccount& energy = run.energy;
    if (energy.impact_loss != 0) say_on(page, "\nlost in impacts {:.10g}", energy.impact_loss);
    if (has_impulses(run.mechanism)) say_on(page, "\ngained by impulses {:.10g}", energy.impulse_work);
    if (energy.set_change) say_on(page, "\nchanged by values that events set {:.10g}", *energy.set_change);
    if (energy.conserved)
        say_on(page, "\nenergy drift {:.2e}\n", energy.drift);
    else
        say_on(page, "\nenergy is not conserved; work balance {:.2e}\n", energy.balance);
    if (energy.jacobi_conserved) say_on(page, "T2 - T0 + V is; its drift {:.2e}\n", energy.jacobi_drift);
    if (run.is_constrained()) say_on(page, "constraint drift {:.2e}\n", run.constraint_drift);
    for (const std::string& line : run.adjusted) say_on(page, "adjusted at the start: {}\n", line);
    const std::string code = run.solver.code == CodeKind::memory ? say(" (in memory, {})", name_of(registers()))
                             : run.solver.code == CodeKind::both ? say(" (in memory, then by the compiler)")
                             : run.solver.from_cache             ? say(" (cached)")
                                                                 : "";
    say_on(page, "seconds: derive {:.4f}, emit {:.4f}, compile {:.4f}{}, integrate {:.4f}\n", run.timings.derive,
           run.timings.emit, run.timings.compile, code, run.timings.integrate);
}

}  // namespace

Json as_json(const Run& run) {
    const Statistics& s = run.motion.statistics;
    const EnergyAccount& energy = run.energy;
    Json result;
    if (const std::string warning = warning_of(run); !warning.empty()) result["warning"] = warning;
    result["final"] = {{"time", run.motion.final_time()},
                       {"coordinates", by_name(run.coordinates, run.final_coordinates)},
                       {"rates", by_name(run.coordinates, run.final_rates)}};
    if (!run.speeds.empty()) result["final"]["speeds"] = by_name(run.speeds, run.final_speeds);
    for (std::size_t k = 0; k < run.final_states.size(); ++k)
        result["final"]["states"][run.mechanism.states[k].derivative[0].get_name()] = run.final_states[k];
    if (Json units = si_units(run.mechanism); !units.empty()) result["units"] = std::move(units);
    result["method"] = s.method;
    if (!run.why_method.empty()) result["method_why"] = run.why_method;
    if (run.is_regularized) result["regularized"] = true;
    if (s.switched) result["switched"] = json_of(*s.switched);
    for (const Switch& later : s.later_switches) result["switched_later"].push_back(json_of(later));
    if (run.solver.jacobian_operations) result["jacobian_operations"] = *run.solver.jacobian_operations;
    result["formulation"] = run.solver.formulation;
    result["code"] = name_of(run.solver.code);
    result["instructions"] = name_of(registers());
    result["steps"] = s.steps;
    result["rejected"] = s.rejected;
    result["evaluations"] = s.evaluations;
    result["energy_drift"] = energy.conserved ? Json(energy.drift) : Json(nullptr);
    if (!energy.conserved) result["work_balance"] = energy.balance;
    if (energy.jacobi_conserved) result["jacobi_drift"] = energy.jacobi_drift;
    result["constraint_drift"] = run.constraint_drift;
    if (run.estimate) result["error_estimate"] = json_of(*run.estimate, run.distrust_reasons);
    if (run.sensitivity)
        result["sensitivity"] = {{"time", run.sensitivity->time},
                                 {"of", run.sensitivity->of},
                                 {"by", run.sensitivity->by},
                                 {"values", run.sensitivity->values},
                                 {"adjoint", run.sensitivity->adjoint},
                                 {"steps", run.sensitivity->steps},
                                 {"evaluations", run.sensitivity->evaluations}};
    if (run.sensitivity && !run.sensitivity->rows.empty()) {
        result["sensitivity"]["times"] = run.sensitivity->times;
        result["sensitivity"]["rows"] = run.sensitivity->rows;
    }
    if (!run.adjusted.empty()) result["adjusted"] = run.adjusted;
    result["events"] = Json::array();
    for (std::size_t row = 0; row < run.motion.events.size(); ++row) result["events"].push_back(json_of(run, row));
    if (run.mechanism.has_kicks()) result["impulse_work"] = energy.impulse_work;
    if (energy.set_change) result["set_change"] = *energy.set_change;
    for (const Run::Side& change : run.side_changes)
        result["switches"].push_back(
            {{"time", change.time}, {"name", change.name}, {"event", event_name(change)}});
    for (const ChartPass& pass : run.chart_passes)
        result["charts"].push_back({{"frame", run.chart_frame}, {"begin", pass.begin}, {"end", pass.end}});
    if (!run.contacts.empty() || !run.mechanism.frictions.empty()) result["contacts"] = contacts_of(run);
    if (!run.contacts.empty()) result["impact_loss"] = energy.impact_loss;
    result["seconds"] = {{"derive", run.timings.derive},
                         {"emit", run.timings.emit},
                         {"compile", run.timings.compile},
                         {"integrate", run.timings.integrate},
                         {"estimate", run.timings.estimate}};
    result["completed"] = run.motion.ending != Ending::failed;
    return result;
}

std::string as_text(const Run& run, const Ink& ink, int digits) {
    std::string page;
    if (const std::string warning = warning_of(run); !warning.empty())
        put(page, "{}{}{}\n", ink.bad, warning, ink.end);
    add_motion(page, run, digits);
    if (run.sensitivity) add_sensitivity(page, *run.sensitivity, digits);
    add_account(page, run);
    if (run.failure) put(page, "{}{}{}", ink.bad, say("the motion broke off: {}\n", *run.failure), ink.end);
    return page;
}

Json as_json(const SectionOfRun& section, const Run& run) {
    Json result{{"equation", section.equation}, {"crossings", Json::array()}};
    const std::size_t n = run.coordinates.size();
    const std::vector<std::string>& rates = run.speeds.empty() ? run.coordinates : run.speeds;
    for (const EventRecord& e : section.crossings) {
        const auto middle = e.state.begin() + static_cast<std::ptrdiff_t>(n);
        result["crossings"].push_back(
            {{"time", e.time},
             {"coordinates", by_name(run.coordinates, std::vector<double>(e.state.begin(), middle))},
             {run.speeds.empty() ? "rates" : "speeds",
              by_name(rates, std::vector<double>(middle, middle + static_cast<std::ptrdiff_t>(rates.size())))}});
    }
    return result;
}

std::string as_text(const SectionOfRun& section, const Run& run) {
    std::string page = say("\nsection of Poincare {}, from less to more: {}\n", section.equation,
                           shown_count(static_cast<long>(section.crossings.size()), to_say("crossing")));
    if (section.crossings.empty()) return page;
    put(page, "{:>24}", "t");
    for (const std::string& name : run.coordinates) put(page, "{:>24}", name);
    for (const std::string& name : run.coordinates)
        if (run.speeds.empty()) put(page, "{:>24}", name + "'");
    for (const std::string& name : run.speeds) put(page, "{:>24}", name);
    page += '\n';
    for (std::size_t k = 0; k < std::min(section.crossings.size(), most_lines); ++k) {
        const EventRecord& e = section.crossings[k];
        put(page, "{:>24.15g}", e.time);
        const std::size_t numbers =
            run.coordinates.size() + (run.speeds.empty() ? run.coordinates : run.speeds).size();
        for (std::size_t i = 0; i < std::min(numbers, e.state.size()); ++i) put(page, "{:>24.15g}", e.state[i]);
        page += '\n';
    }
    if (section.crossings.size() > most_lines)
        say_on(page, "… and {} more; --json gives all\n", section.crossings.size() - most_lines);
    return page;
}

std::string as_csv(const MotionTable& table) {
    std::string text = fmt::format("{}\n", fmt::join(table.columns, ","));
    for (std::size_t row = 0; row < table.rows(); ++row)
        for (std::size_t column = 0; column < table.columns.size(); ++column)
            text +=
                fmt::format("{:.17g}{}", table.at(row, column), column + 1 < table.columns.size() ? ',' : '\n');
    return text;
}

}  // namespace alembert
