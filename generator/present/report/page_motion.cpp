// SPDX-License-Identifier: GPL-2.0-or-later
/// Plots of the motion, its computation, the C++, and the commands.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/language/say.hpp"
#include "present/report/page_parts.hpp"
#include "present/report/page_plot.hpp"
#include "present/report/run.hpp"
#include "present/report/shown_unit.hpp"
#include "scene/unit_text.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

constexpr std::size_t lines_in_plot = 6, plots_of_a_kind = 4, portraits = 4;

class Plots {
public:
    Plots(PageParts& page, const Overview& all, const WatchedMotion& motion)
        : page_(page), all_(all), motion_(motion), rows_(motion.run.rows), si_(is_in_si(all.scene)) {
        times_ = column(0);
        page_.data["values"] = Json::array();
        Json times = Json::array();
        for (const double t : times_) times.push_back(rounded(t));
        page_.data["times"] = std::move(times);
    }

    void all() {
        const Mechanism& m = all_.mechanism;
        const std::size_t n = m.q.size();
        put(page_.body, "<div class=\"plots\">\n");
        by_unit(
            say("Coordinates"), 0, n, [&](std::size_t k) { return m.q[k].get_name(); },
            [&](std::size_t k) { return shown(k).text(m.units[k]); }, 1);
        by_unit(
            say("Rates"), 0, n, [&](std::size_t k) { return m.q[k].get_name() + "'"; },
            [&](std::size_t k) { return shown_rate(k); }, 1 + n);
        energies();
        named(say("Multipliers"), 1 + 2 * n, energy_column(), "");
        named(say("Outputs and speeds"), energy_column() + 1, rows_.columns.size(), "");
        residuals();
        phase_portraits();
        put(page_.body, "</div>\n");
    }

private:
    ShownUnit shown(std::size_t coordinate) const { return ShownUnit(all_.mechanism.shown_units[coordinate]); }
    std::string shown_rate(std::size_t coordinate) const {
        return shown(coordinate).text(si_ ? all_.mechanism.units[coordinate] : "", 1);
    }

    std::string time_unit() const { return si_ ? "s" : ""; }

    std::size_t energy_column() const {
        const auto at =
            std::find(rows_.columns.begin() + static_cast<std::ptrdiff_t>(1 + 2 * all_.mechanism.q.size()),
                      rows_.columns.end(), "energy");
        return static_cast<std::size_t>(at - rows_.columns.begin());
    }

    /// In the units that the scene has for coordinates.
    std::vector<double> column(std::size_t k) const {
        const std::size_t n = all_.mechanism.q.size();
        const ShownUnit unit = k >= 1 && k <= 2 * n ? shown((k - 1) % n) : ShownUnit({});
        std::vector<double> values;
        for (std::size_t row = 0; row < rows_.rows(); ++row) values.push_back(unit.value(rows_.at(row, k)));
        return values;
    }

    static Json rounded(double v) {
        return std::isfinite(v) ? Json(std::stod(fmt::format("{:.6g}", v))) : Json(nullptr);
    }

    PagePlotLine line(const std::string& name, std::vector<double> values) {
        Json list = Json::array();
        for (const double v : values) list.push_back(rounded(v));
        const int index = static_cast<int>(page_.data["values"].size());
        page_.data["values"].push_back(std::move(list));
        return {name, std::move(values), index};
    }

    void show(const std::string& title, const std::string& unit, const std::vector<PagePlotLine>& lines) {
        page_.body += page_plot({.title = title,
                                 .x_name = "t",
                                 .x_unit = time_unit(),
                                 .y_name = lines.size() == 1 ? lines[0].name : "",
                                 .y_unit = unit_text(unit)},
                                times_, lines);
    }

    /// Plots values in groups of the same unit, with a few lines in each plot.
    template <typename Name, typename Unit>
    void by_unit(const std::string& title, std::size_t from, std::size_t to, const Name& name, const Unit& unit,
                 std::size_t first_column) {
        std::vector<std::pair<std::string, std::vector<std::size_t>>> groups;
        for (std::size_t k = from; k < to; ++k) {
            auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) {
                return g.first == unit(k) && g.second.size() < lines_in_plot;
            });
            if (group == groups.end()) group = groups.insert(groups.end(), {unit(k), {}});
            group->second.push_back(k);
        }
        for (std::size_t g = 0; g < std::min(groups.size(), plots_of_a_kind); ++g) {
            std::vector<PagePlotLine> lines;
            for (const std::size_t k : groups[g].second) {
                lines.push_back(line(name(k), column(first_column + k)));
                columns_[first_column + k] = lines.back().column;
            }
            show(title, groups[g].first, lines);
        }
        if (groups.size() > plots_of_a_kind)
            put(page_.body, "<p class=\"hint\">{}</p>\n",
                say("{}: the first {} of {} are shown.", title, plots_of_a_kind * lines_in_plot, to - from));
    }

    void named(const std::string& title, std::size_t from, std::size_t to, const std::string& unit) {
        if (to <= from) return;
        by_unit(
            title, 0, to - from, [&](std::size_t k) { return rows_.columns[from + k]; },
            [&](std::size_t) { return unit; }, from);
    }

    void energies() {
        const std::string unit = si_ ? "J" : "";
        std::vector<PagePlotLine> lines;
        if (!motion_.kinetic.empty()) {
            lines.push_back(line("T", motion_.kinetic));
            lines.push_back(line("V", motion_.potential));
        }
        std::vector<double> energy = column(energy_column());
        lines.push_back(line("E", energy));
        show(say("Energies"), unit, lines);
        if (!motion_.run.energy.conserved || energy.empty()) return;
        const double start = energy[0];
        for (double& e : energy) e -= start;
        show(say("Change of the energy"), unit, {line("E - E0", energy)});
    }

    void residuals() {
        const auto show_all = [&](const std::string& title, const std::vector<std::vector<double>>& values) {
            std::vector<PagePlotLine> lines;
            for (std::size_t k = 0; k < std::min(values.size(), lines_in_plot); ++k)
                lines.push_back(line(motion_.constraints[k], values[k]));
            if (!lines.empty()) show(title, say("residual"), lines);
        };
        show_all(say("Residuals of the constraints"), motion_.position);
        show_all(say("Residuals of their rates"), motion_.velocity);
    }

    void phase_portraits() {
        const Mechanism& m = all_.mechanism;
        const std::size_t n = m.q.size();
        for (std::size_t k = 0; k < std::min(n, portraits); ++k) {
            if (!columns_.contains(1 + k) || !columns_.contains(1 + n + k)) continue;
            const std::string name = m.q[k].get_name();
            page_.body +=
                page_plot({.title = say("Phase portrait"),
                           .x_name = name,
                           .x_unit = unit_text(shown(k).text(m.units[k])),
                           .y_name = name + "'",
                           .y_unit = unit_text(shown_rate(k))},
                          column(1 + k), {{name + "'", column(1 + n + k), columns_[1 + n + k]}}, columns_[1 + k]);
        }
    }

    PageParts& page_;
    const Overview& all_;
    const WatchedMotion& motion_;
    const MotionTable& rows_;
    bool si_;
    std::vector<double> times_;
    std::map<std::size_t, int> columns_;  ///< column of the table → column of the page
};

/// The point of the figure at which a contact happens: that of its floor or string.
int point_of_contact(const Overview& all, const std::string& name) {
    if (!all.drawing.value) return -1;
    for (const FigureElement& e : all.drawing.value->elements) {
        if (e.label != name) continue;
        if (e.kind == FigureElement::Kind::floor) return e.points[3];
        if (e.kind == FigureElement::Kind::string) return e.points[1];
    }
    return -1;
}

}  // namespace

void add_plots(PageParts& page, const Overview& all) {
    page.section("plots", say("Plots"));
    if (all.motion.value && all.motion.value->run.rows.rows() > 1)
        Plots(page, all, *all.motion.value).all();
    else
        page.problem(all.motion.problem.empty() ? say("There is no motion to plot.") : all.motion.problem);
    page.end();
}

void add_motion(PageParts& page, const Overview& all) {
    if (!all.motion.value) return;
    const Run& run = all.motion.value->run;
    page.section("run", say("How the motion was made"));
    if (run.failure) page.problem(*run.failure);
    for (const std::string& doubt : run.distrust_reasons)
        put(page.body, "<p class=\"warning\">{}</p>\n", html(doubt));
    put(page.body, "<dl class=\"facts\">");
    const auto fact = [&](const std::string& name, const std::string& value) {
        put(page.body, "<div><dt>{}</dt><dd>{}</dd></div>\n", name, html(value));
    };
    const Statistics& s = run.motion.statistics;
    fact(say("equations"), translated_parts(run.solver.formulation));
    fact(say("method"), s.method + (run.why_method.empty() ? "" : " (" + run.why_method + ")"));
    fact(say("steps"), say("{} accepted, {} rejected, {} evaluations of {} operations", s.steps, s.rejected,
                           s.evaluations, run.solver.operations));
    if (run.estimate && run.estimate->value)
        fact(say("estimated error at the end"), say("{:.2g}, by a second run", *run.estimate->value));
    if (run.energy.conserved)
        fact(say("drift of the energy"), say("{:.2g} of its size", run.energy.drift));
    else
        fact(say("work balance"), say("{:.2g} of the energy's size", run.energy.balance));
    if (run.is_constrained())
        fact(say("largest residual of a constraint"), fmt::format("{:.2g}", run.constraint_drift));
    put(page.body, "</dl>\n");

    Json& happenings = page.data["happenings"] = Json::array();
    struct Happening {
        double time;
        std::string text;
        int point;
    };
    std::vector<Happening> list;
    for (const ContactEvent& e : run.motion.contacts) {
        const std::string& name = run.contacts[static_cast<std::size_t>(e.contact)];
        list.push_back({e.time, translated(name_of(e.kind)) + " " + name, point_of_contact(all, name)});
    }
    for (const EventRecord& e : run.motion.events)
        list.push_back({e.time, say("event {}", e.name) + (e.impulse.empty() ? "" : say(", with an impulse")),
                        e.impulse.empty() || !all.drawing.value || all.drawing.value->traced.empty()
                            ? -1
                            : all.drawing.value->traced[0]});
    std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    constexpr std::size_t most = 200;
    if (!list.empty()) {
        put(page.body,
            "<details><summary>{}</summary><div class=\"scroll\"><table><thead><tr>"
            "<th scope=\"col\">{}</th><th scope=\"col\">{}</th></tr></thead><tbody>\n",
            say("{} contact{} and event{}", list.size(), list.size() == 1 ? "" : "s", list.size() == 1 ? "" : "s"),
            say("time"), say("what"));
        for (std::size_t k = 0; k < std::min(list.size(), most); ++k)
            put(page.body, "<tr><td>{:.9g}</td><td>{}</td></tr>\n", list[k].time, html(list[k].text));
        if (list.size() > most)
            put(page.body, "<tr><td></td><td>{}</td></tr>\n", say("… and {} more", list.size() - most));
        put(page.body, "</tbody></table></div></details>\n");
    }
    for (std::size_t k = 0; k < std::min(list.size(), most); ++k)
        happenings.push_back({{"t", list[k].time}, {"text", list[k].text}, {"point", list[k].point}});
    page.end();
}

void add_code(PageParts& page, const Overview& all) {
    page.section("code", "C++");
    if (!all.emitted.value) {
        page.problem(all.emitted.problem);
        page.end();
        return;
    }
    const std::string& code = all.emitted.value->source.text;
    constexpr std::size_t most = 200'000;
    put(page.body, "<p>{}</p>\n",
        say("The right-hand side of the equations as C++ that needs no library: {} operations.",
            all.emitted.value->source.operations.total()));
    if (code.size() > most) {
        put(page.body, "<p>{}</p>\n",
            say("It is {} kB long and left out here; {} writes it.", code.size() / 1000,
                "<code>alembert emit</code>"));
        page.end();
        return;
    }
    page.copy("C++", code);
    put(page.body, "<details><summary>{}</summary><pre class=\"code\"><code>{}</code></pre></details>\n",
        html(all.emitted.value->source.file), html(code));
    page.end();
}

void add_commands(PageParts& page, const Overview& all, const std::string& by) {
    page.section("commands", say("How to make this page"));
    std::string file = all.scene.file;
    if (const std::size_t slash = file.rfind('/'); slash != std::string::npos) file.erase(0, slash + 1);
    std::string quoted = "'";
    for (const char c : file) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    quoted += "'";
    if (file.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-") ==
        std::string::npos)
        quoted = file;
    const std::string with = by.empty() ? "" : " --by " + by;
    std::string lines;
    for (const char* const verb : {"report", "derive --steps", "check", "agree", "audit", "simulate", "emit"}) {
        if (std::string(verb) == "check" && all.scene.claims.empty()) continue;
        const std::string name(verb);
        lines += "alembert " + name.substr(0, name.find(' ')) + " " + quoted +
                 (name.find(' ') == std::string::npos ? "" : name.substr(name.find(' '))) + with +
                 (name == "report" ? " -o page.html"
                  : name == "emit" ? " -o ."
                                   : "") +
                 "\n";
    }
    put(page.body,
        "<pre>{}</pre>\n<details><summary>{}</summary><pre class=\"code\"><code>{}</code></pre></details>\n",
        html(lines), say("The scene"), html(all.scene.text));
    page.copy(say("scene"), all.scene.text);
    page.end();
}

}  // namespace alembert
