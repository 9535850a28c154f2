// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/motion_plot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/language/say.hpp"
#include "present/report/page.hpp"
#include "present/report/plot_panels.hpp"
#include "present/report/shown_unit.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

namespace {

/// The kind of the numbers in a column. Outputs may have any meaning, so each is a group of its own, from the last
/// number on.
enum Group { coordinate, rate, multiplier, energy, speed, reaction, output };

/// All columns except the time, in the order of row_columns, without their points.
std::vector<PlottedLine> columns_of(const Run& run) {
    const Mechanism& m = run.mechanism;
    std::vector<PlottedLine> result;
    const auto add = [&](int group, const std::string& unit) {
        result.push_back(
            {.name = run.rows.columns[result.size() + 1], .unit = unit, .group = group, .points = {}});
    };
    for (const std::string& unit : m.units) add(coordinate, unit);
    for (const std::string& unit : m.units) add(rate, per_second(unit));
    for (const Mechanism::State& z : m.states) add(speed, z.unit);
    for (std::size_t k = 0; k < m.constraints.size() + m.redundant.size() + m.unilateral.size(); ++k)
        add(multiplier, "");
    add(energy, "J");
    for (std::size_t k = 0; k < m.outputs.size(); ++k) add(output + static_cast<int>(k), "");
    for (const Mechanism::Speed& u : m.speeds) add(speed, u.unit);
    while (result.size() + 1 < run.rows.columns.size()) {  // JOINT.fx …, three forces and three moments
        const std::string& name = run.rows.columns[result.size() + 1];
        add(reaction, name[name.rfind('.') + 1] == 'f' ? "N" : "N m");
    }
    return result;
}

/// The unit in which a column is drawn.
ShownUnit shown_unit(const Mechanism& m, std::size_t column, const MotionTable& rows) {
    const std::size_t n = m.units.size();
    if (column <= 2 * n) return ShownUnit(m.shown_units[(column - 1) % n]);
    for (const Mechanism::Speed& u : m.speeds)
        if (u.u.get_name() == rows.columns[column]) return ShownUnit(u.shown);
    for (const Mechanism::State& z : m.states)
        if (z.derivative[0].get_name() == rows.columns[column]) return ShownUnit(z.shown);
    return ShownUnit({});
}

/// "event strike at t = 1.2 and 3 more; contact floor: 12 impacts, 1 rest", for the caption.
std::string account_of(const Run& run) {
    std::string text;
    const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
    const std::vector<EventRecord>& events = run.motion.events;
    for (std::size_t k = 0; k < run.mechanism.events.size(); ++k) {
        const auto happens = [k](const EventRecord& e) { return e.index == static_cast<int>(k); };
        const auto first = std::find_if(events.begin(), events.end(), happens);
        if (first == events.end()) continue;
        const auto count = std::count_if(events.begin(), events.end(), happens);
        add(say("event {} at t = {:.4g}{}", run.mechanism.events[k].name, first->time,
                count > 1 ? say(" and {} more", count - 1) : ""));
    }
    for (std::size_t k = 0; k < run.contacts.size(); ++k) {
        std::string counts;
        for (const auto& [kind, name] : {std::pair{ContactEvent::Kind::impact, to_say("impact")},
                                         {ContactEvent::Kind::rest, to_say("rest")},
                                         {ContactEvent::Kind::release, to_say("release")}}) {
            const auto count = std::count_if(run.motion.contacts.begin(), run.motion.contacts.end(),
                                             [&, kind = kind](const ContactEvent& e) {
                                                 return e.contact == static_cast<int>(k) && e.kind == kind;
                                             });
            if (count > 0) counts += (counts.empty() ? "" : ", ") + shown_count(count, name);
        }
        if (!counts.empty()) add(say("contact {}: {}", run.contacts[k], counts));
    }
    return text;
}

/// Marks behind the lines: grey while a contact is closed, thin lines at impacts, dashed lines at events.
std::string happenings(const Run& run, const PlotArea& area) {
    std::string svg, impacts, events;
    const double top = area.y.end, height = area.y.begin - area.y.end;
    for (const Phase& phase : run.motion.phases) {
        if (phase.closed.empty()) continue;
        const double from = area.x.at(phase.motion.times.front()), to = area.x.at(phase.motion.times.back());
        svg += fmt::format("<rect x='{:.1f}' y='{:g}' width='{:.1f}' height='{:g}' fill='#f0f0f0'/>", from, top,
                           to - from, height);
    }
    double last = -1;
    for (const ContactEvent& e : run.motion.contacts) {
        const double x = area.x.at(e.time);
        if (e.kind != ContactEvent::Kind::impact || x - last < 1) continue;
        last = x;
        impacts += fmt::format("M{:.1f} {:g}v{:g}", x, top, height);
    }
    for (const EventRecord& e : run.motion.events)
        events += fmt::format("M{:.1f} {:g}v{:g}", area.x.at(e.time), top, height);
    if (!impacts.empty()) svg += fmt::format("<path d='{}' stroke='#bbb' fill='none'/>", impacts);
    if (!events.empty())
        svg += fmt::format("<path d='{}' stroke='#777' stroke-dasharray='2 3' fill='none'/>", events);
    return svg + "\n";
}

}  // namespace

std::vector<PlottedLine> lines_of(const Run& run, const std::vector<std::string>& names) {
    std::vector<PlottedLine> all = columns_of(run), result;
    const MotionTable& rows = run.rows;
    for (std::size_t column = 1; column < rows.columns.size(); ++column) {
        const ShownUnit unit = shown_unit(run.mechanism, column, rows);
        PlottedLine& line = all[column - 1];
        line.unit = line.group == rate ? unit.text(run.mechanism.units[column - 1 - run.mechanism.units.size()], 1)
                                       : unit.text(line.unit);
        for (std::size_t row = 0; row < rows.rows(); ++row)
            line.points.emplace_back(rows.at(row, 0), unit.value(rows.at(row, column)));
    }
    if (names.empty()) {
        std::erase_if(all, [](const PlottedLine& line) { return line.group == reaction; });
        return all;
    }
    for (const std::string& name : names)
        for (const PlottedLine& one : all)
            if (one.name == name) result.push_back(one);
    return result;
}

std::vector<std::string> column_units(const Run& run) {
    std::vector<std::string> units{"s"};
    for (const PlottedLine& line : columns_of(run)) units.push_back(line.unit);
    return units;
}

std::string motion_plot(const Run& run, const std::vector<std::string>& columns) {
    PlotSheet sheet{.title = run.mechanism.title.empty() ? run.mechanism.name : run.mechanism.title,
                    .about = say("Charts over the time until {:.6g} s.", run.motion.final_time())};
    if (const std::string account = account_of(run); !account.empty()) sheet.captions.push_back(account);
    if (run.failure) sheet.captions.emplace_back(say("The motion broke off: the numbers failed."));
    for (const std::string& caption : sheet.captions) sheet.about += " " + caption;
    return plot_panels(sheet, lines_of(run, columns), say("t in s"),
                       [&run](const PlotArea& area) { return happenings(run, area); });
}

}  // namespace alembert
