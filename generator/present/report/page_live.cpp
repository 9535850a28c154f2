// SPDX-License-Identifier: GPL-2.0-or-later
/// The part of the page that lives: the equations and the figure as JavaScript, and sliders for what they start
/// from. What is done with them is in templates/page_live.js and templates/page_integrator.js.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "base/language/say.hpp"
#include "codegen/emit/emit.hpp"
#include "present/report/page_files.hpp"
#include "present/report/page_parts.hpp"
#include "present/report/shown_unit.hpp"
#include "program/lower/quick_times.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

constexpr std::size_t longest_module = 400'000;  // in bytes

/// A module without comments, as an expression for its exports.
std::string inlined(const std::string& module) {
    static constexpr std::string_view exports = "export ";
    std::string text, names;
    std::istringstream lines(module);
    for (std::string line; std::getline(lines, line);) {
        line.erase(0, line.find_first_not_of(' '));
        if (line.starts_with("//") || line.empty()) continue;
        if (const std::size_t comment = line.find("; //"); comment != std::string::npos) line.erase(comment + 1);
        if (line.starts_with(exports)) {
            line.erase(0, exports.size());
            const std::size_t begin = line.find(' ') + 1;
            names += (names.empty() ? "" : ", ") + line.substr(begin, line.find_first_of("( ", begin) - begin);
        }
        text += line + "\n";
    }
    return "(() => {\n" + text + "return { " + names + " };\n})()";
}

/// Why there are no sliders; empty if there are.
std::string obstacle(const Overview& all) {
    if (!all.emitted.value) return all.emitted.problem;
    const Mechanism& m = all.mechanism;
    if (m.has_modes())
        return say(
            "The page plays this motion as it was calculated and has no sliders, because it does not follow "
            "contacts, "
            "dry friction and events that change the motion.");
    return "";
}

std::string too_long(std::size_t bytes) {
    return say(
        "The page plays this motion as it was calculated and has no sliders, because its equations are {} kB "
        "long.",
        bytes / 1000);
}

/// A number that a slider changes.
struct Knob {
    std::string kind = {};  ///< "par" or "state", in which it has the place `index`
    std::size_t index = 0;
    std::string label = {};  ///< HTML
    std::string name = {}, unit = {};
    double value = 0, low = -1, high = 1;  ///< in SI units
    double factor = 1;                     ///< what one of the shown unit is in SI units
};

double factor_of(const ShownUnit& unit) {
    const double one = unit.value(1);
    return one != 0 && std::isfinite(one) ? 1 / one : 1;
}

class LiveSection {
public:
    LiveSection(PageParts& page, const Overview& all, const std::set<int>& grabs, std::size_t points)
        : page_(page),
          all_(all),
          m_(all.mechanism),
          e_(*all.emitted.value),
          p_(e_.choice.program),
          drawing_(*all.drawing.value),
          grabs_(grabs),
          points_(points) {
        Start start = start_of(e_.mechanism);
        start.t = all.start.t;
        start.q = all.start.q;
        const auto states = all.start.qdot.begin() + static_cast<std::ptrdiff_t>(start.qdot.size());
        start.qdot.assign(all.start.qdot.begin(), states);
        start.states.assign(states, all.start.qdot.end());
        start.speeds.clear();
        const State<double> at = state_of(start, e_.mechanism, e_.equations);
        state_ = at.q;
        state_.insert(state_.end(), at.qdot.begin(), at.qdot.end());
        t_ = start.t;
    }

    void add() {
        const std::string scene = module_of(p_), figure = module_of(drawing_.program);
        if (scene.size() + figure.size() > longest_module) {
            put(page_.body, "<p class=\"hint\">{}</p>\n", html(too_long(scene.size() + figure.size())));
            return;
        }
        add_data();
        add_markup();
        page_.scripts.push_back("\"use strict\";\nconst alembertModules = { scene: " + scene +
                                ",\nfigure: " + figure + " };\n");
        page_.scripts.emplace_back(page_live_script);
    }

private:
    std::string module_of(const Program& program) const {
        return inlined(
            emit(program,
                 {.language = CodeLanguage::javascript, .longest_function = 400, .t = t_, .state = state_})
                .text);
    }

    std::size_t n() const { return m_.q.size(); }

    void add_data() {
        Json& live = page_.data["live"];
        live = {{"coordinates", n()},
                {"speeds", state_.size() - n()},
                {"state", state_},
                {"conserved", all_.motion.value->run.energy.conserved},
                {"spots", drawing_.spots.size()},
                {"points", points_},
                {"grabs", grabs_},
                {"unit", is_in_si(all_.scene) ? " J" : ""},
                {"length", std::max(1e-6, size_of_figure())}};
        Json& holonomic = live["holonomic"] = Json::array();
        for (const Mechanism::Constraint& c : e_.mechanism.constraints)
            holonomic.push_back(c.position.has_value());
        live["redundant"] = e_.mechanism.redundant.size();
        live["own_speeds"] = !p_.speeds.empty();
        live["quick"] = quick();
        for (std::size_t k = 0; k < state_.size(); ++k)
            live["guessed"].push_back(k < n() ? m_.q_is_guess[k]
                                              : !p_.speeds.empty() || m_.qdot_is_guess[k - n()]);
        for (const Drawing::Spot& spot : drawing_.spots) {
            live["zeroed"].push_back(spot.zeroed);
            live["shifts"].push_back({spot.shift[0], spot.shift[1], spot.shift[2]});
        }
        for (std::size_t k = 0; k < n(); ++k)
            live["scales"].push_back(m_.units[k] == "m" ? std::max(1e-6, size_of_figure()) : 1.0);
        live["words"] = {
            {"energy", say("energy")},
            {"drift", say("energy drift")},
            {"error", say("estimated error")},
            {"infinite", say("There is no motion with these numbers: a rate is not finite.")},
            {"dependent",
             say("The motion ends here: the constraints depend on each other in this pose, and the page "
                 "does not pass it. 'alembert simulate' does.")},
            {"small", say("The motion ends here: the steps have become too small.")},
            {"long", say("The motion ends here: it has become too long for a page.")},
            {"apart", say("With this number the constraints cannot be obeyed.")}};
    }

    /// The sudden times of inputs, the parameters that they follow, and the longest step where these have others.
    Json quick() const {
        const double duration =
            all_.motion.value->run.rows.rows() > 0
                ? all_.motion.value->run.rows.at(all_.motion.value->run.rows.rows() - 1, 0) - t_
                : 0;
        const std::vector<double> parameters = start_of(e_.mechanism).parameters;
        Json result{{"rows", Json::array()}, {"follow", Json::array()}, {"least", 0}};
        double least = HUGE_VAL;
        for (const InputTimeScale& q : sudden_times(quick_times(p_, parameters, t_, t_ + duration))) {
            result["rows"].push_back({q.from, q.to, q.enter, q.step});
            least = std::min(least, q.step);
        }
        constexpr double most_steps = 2e4;  // a page answers in a second
        if (std::isfinite(least)) result["least"] = std::max(least, duration / most_steps);
        const std::vector<bool> follow = parameters_of_inputs(p_, parameters.size());
        for (std::size_t k = 0; k < follow.size(); ++k)
            if (follow[k]) result["follow"].push_back({k, parameters[k]});
        return result;
    }

    double size_of_figure() const {
        double size = 0;
        for (const Pose& pose : all_.motion.value->poses)
            for (const int k : drawing_.traced)
                for (const int other : grabs_)
                    size = std::max(
                        size, (pose[static_cast<std::size_t>(k)] - pose[static_cast<std::size_t>(other)]).norm());
        return size > 0 ? size : 1;
    }

    /// The range of a column of the motion.
    std::pair<double, double> range(std::size_t column) const {
        const MotionTable& rows = all_.motion.value->run.rows;
        double low = rows.at(0, column), high = low;
        for (std::size_t row = 1; row < rows.rows(); ++row) {
            const double x = rows.at(row, column);
            if (!std::isfinite(x)) continue;
            low = std::min(low, x);
            high = std::max(high, x);
        }
        return {low, high};
    }

    std::vector<Knob> parameters() const {
        std::vector<Knob> knobs;
        std::size_t index = 0;
        for (const Mechanism::Parameter& given : m_.parameters) {
            if (!given.independent) continue;
            const ShownUnit unit(given.shown);
            const double v = p_.parameters[index].value, factor = factor_of(unit);
            Knob knob{.kind = "par",
                      .index = index,
                      .label = symbol_of(given.symbol),
                      .name = p_.parameters[index].name,
                      .unit = unit.text(given.unit),
                      .value = v,
                      .low = v == 0 ? -factor : std::min(0.1 * v, 3 * v),
                      .high = v == 0 ? factor : std::max(0.1 * v, 3 * v),
                      .factor = factor};
            ++index;
            knobs.push_back(std::move(knob));
        }
        return knobs;
    }

    std::vector<Knob> start() const {
        std::vector<Knob> knobs;
        const double turn = std::numbers::pi;
        for (std::size_t k = 0; k < n(); ++k) {
            const ShownUnit unit(m_.shown_units[k]);
            const double v = state_[k];
            auto [low, high] = range(1 + k);
            const bool is_angle = m_.units[k] == "rad";
            const double room =
                is_angle ? 0 : 0.5 * std::max({high - low, 0.2 * std::abs(v), 0.2 * size_of_figure()});
            knobs.push_back({.kind = "state",
                             .index = k,
                             .label = symbol_of(m_.q[k]),
                             .name = m_.q[k].get_name(),
                             .unit = unit.text(m_.units[k]),
                             .value = v,
                             .low = is_angle ? std::min({low, v, -turn}) : std::min(low, v) - room,
                             .high = is_angle ? std::max({high, v, turn}) : std::max(high, v) + room,
                             .factor = factor_of(unit)});
        }
        for (std::size_t k = 0; k + n() < state_.size(); ++k) knobs.push_back(speed(k));
        return knobs;
    }

    Knob speed(std::size_t k) const {
        const double v = state_[n() + k];
        Knob knob{.kind = "state", .index = n() + k, .value = v};
        double most = std::max(2 * std::abs(v), 1.0);
        if (p_.speeds.empty()) {
            const ShownUnit unit(m_.shown_units[k]);
            const auto [low, high] = range(1 + n() + k);
            most = std::max({1.5 * std::abs(low), 1.5 * std::abs(high), 2 * std::abs(v)});
            knob.label = symbol_of(m_.qdot[k]);
            knob.name = m_.q[k].get_name() + "'";
            knob.unit = unit.text(m_.units[k], 1);
            knob.factor = factor_of(unit);
            if (!(most > 0)) most = knob.factor;
        } else {
            const Quantity& u = p_.speeds[k];
            knob.name = u.name;
            knob.label = "<span class=\"letters\">" + html_letters(u.name) + "</span>";
            knob.unit = u.unit;
        }
        knob.low = -most;
        knob.high = most;
        return knob;
    }

    std::string symbol_of(const GiNaC::symbol& s) const {
        return inline_math(phrases::symbol(s, m_.symbols->info(s)));
    }

    void add_knobs(const std::string& legend, const std::vector<Knob>& knobs) {
        if (knobs.empty()) return;
        std::string& body = page_.body;
        put(body, "<fieldset><legend>{}</legend><div class=\"knobs\">\n", html(legend));
        for (const Knob& knob : knobs) {
            const std::string id = fmt::format("live-{}-{}", knob.kind, knob.index);
            put(body,
                "<div class=\"knob\" data-kind=\"{}\" data-index=\"{}\" data-factor=\"{:.17g}\"><label "
                "for=\"{}\">{}</label>"
                "<input type=\"range\" id=\"{}\" min=\"{:.6g}\" max=\"{:.6g}\" step=\"any\" value=\"{:.17g}\">"
                "<input type=\"number\" step=\"any\" value=\"{:.6g}\" aria-label=\"{}\"><span "
                "class=\"unit\">{}</span></div>\n",
                knob.kind, knob.index, knob.factor, id, knob.label, id, knob.low / knob.factor,
                knob.high / knob.factor, knob.value / knob.factor, knob.value / knob.factor, html(knob.name),
                html(unit_text(knob.unit)));
        }
        put(body, "</div></fieldset>\n");
    }

    void add_markup() {
        std::string& body = page_.body;
        put(body, "<details class=\"live\" id=\"live\"><summary>{}</summary>\n<p class=\"hint\">{}</p>\n",
            say("Change parameters and start, or drag a body"),
            say("The page then integrates the equations itself. Plots and tables stay those of the scene as it is "
                "written."));
        add_knobs(say("Parameters"), parameters());
        add_knobs(say("Start"), start());
        put(body,
            "<div class=\"live-row\"><label><input type=\"checkbox\" id=\"live-compare\"> {}</label>\n"
            "<button type=\"button\" id=\"live-back\">{}</button></div>\n"
            "<p id=\"live-told\" class=\"live-told\" role=\"status\"></p></details>\n",
            say("Keep this motion as a pale ghost, to compare"), say("Back to the scene"));
    }

    PageParts& page_;
    const Overview& all_;
    const Mechanism& m_;
    const Emission& e_;
    const Program& p_;
    const Drawing& drawing_;
    const std::set<int>& grabs_;
    std::size_t points_;
    std::vector<double> state_;
    double t_ = 0;
};

/// The points by which somebody takes the figure: masses, and the ends of what moves.
std::set<int> grabs_of(const Drawing& drawing, const std::vector<Pose>& poses) {
    using Kind = FigureElement::Kind;
    std::set<int> points(drawing.traced.begin(), drawing.traced.end());
    for (const FigureElement& e : drawing.elements)
        if (e.kind == Kind::bar || e.kind == Kind::rod || e.kind == Kind::plate)
            points.insert(e.points.begin(), e.points.end());
    std::erase_if(points, [&](int k) {
        const auto at = static_cast<std::size_t>(k);
        return std::all_of(poses.begin(), poses.end(),
                           [&](const Pose& pose) { return (pose[at] - poses[0][at]).norm() < 1e-9; });
    });
    std::set<int> apart;  // of several points at one place one is enough
    for (const int k : points)
        if (std::none_of(apart.begin(), apart.end(), [&](int other) {
                return std::all_of(poses.begin(), poses.end(), [&](const Pose& pose) {
                    return (pose[static_cast<std::size_t>(k)] - pose[static_cast<std::size_t>(other)]).norm() <
                           1e-9;
                });
            }))
            apart.insert(k);
    return apart;
}

}  // namespace

void add_live(PageParts& page, const Overview& all, std::size_t points) {
    if (const std::string why = obstacle(all); !why.empty()) {
        put(page.body, "<p class=\"hint\">{}</p>\n", html(why));
        return;
    }
    LiveSection(page, all, grabs_of(*all.drawing.value, all.motion.value->poses), points).add();
}

}  // namespace alembert
