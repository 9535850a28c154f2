// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"
#include "present/report/formula_page.hpp"
#include "present/report/kinematics.hpp"
#include "present/report/page.hpp"

namespace alembert {

namespace {

constexpr std::size_t widest = 96;  // letters of a vector on one line

bool is_zero(const KinematicVector& v) {
    return std::all_of(v.begin(), v.end(),
                       [](const KinematicEntry& entry) { return entry.formula && entry.formula->is_number(0); });
}

bool is_known(const KinematicVector& v) {
    return std::all_of(v.begin(), v.end(), [](const KinematicEntry& entry) { return entry.formula.has_value(); });
}

bool is_short(const KinematicVector& v) {
    std::size_t letters = 0;
    for (const KinematicEntry& entry : v) letters += entry.formula ? text(*entry.formula).size() : widest + 1;
    return letters <= widest;
}

bool is_same(const KinematicVector& a, const KinematicVector& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (!a[k].formula || !b[k].formula || text(*a[k].formula) != text(*b[k].formula)) return false;
    return true;
}

/// With 0 for what is rounding beside the other components.
std::string value_of(const KinematicVector& v) {
    double size = 0;
    for (const KinematicEntry& entry : v) size = std::max(size, std::abs(entry.value));
    const auto plain = [size](double x) {
        return !std::isfinite(x) ? "?" : fmt::format("{:.10g}", std::abs(x) <= 1e-14 * size ? 0.0 : x);
    };
    return fmt::format("({}, {}, {})", plain(v[0].value), plain(v[1].value), plain(v[2].value));
}

class Writing {
public:
    Writing(const SceneKinematics& s, const Notation& n, bool with_values, bool steps)
        : s_(s), n_(n), with_values_(with_values), steps_(steps) {}

    std::vector<Block> blocks() {
        for (const FrameKinematics& f : s_.frames) frame(f);
        for (const PointKinematics& p : s_.points) point(p);
        if (too_long_)
            tell(with_values_ ? say("What is not written is too long to be read; its value is told.")
                              : say("What is not written is too long to be read."));
        return std::move(blocks_);
    }

private:
    void tell(std::string words) { blocks_.push_back({std::move(words), {}}); }

    void add(const std::string& left, const std::string& right) {
        blocks_.back().equalities.emplace_back(left, right);
    }

    std::string left(const std::string& letter, const std::string& of) const {
        return n_.left({Statement::Kind::energy, letter, of, {}, {}});
    }

    void entry(const std::string& letter, const std::string& of, const KinematicEntry& value) {
        if (value.formula)
            add(left(letter, of), n_.phrase(*value.formula));
        else
            too_long_ = true;
    }

    /// As a row, or line by line where that is long. Components that are too long are left out.
    void vector(const std::string& letter, const std::string& of, const KinematicVector& v) {
        if (is_short(v))
            return add(left(letter, of), n_.phrase(phrases::tuple({*v[0].formula, *v[1].formula, *v[2].formula})));
        const char* const mark = letter.find('_') == std::string::npos ? "_" : ",";
        for (std::size_t k = 0; k < 3; ++k) entry(fmt::format("{}{}{}", letter, mark, "xyz"[k]), of, v[k]);
    }

    /// Its axes one by one, or where they are long each direction cosine: C_xy between the x of N and its own y.
    void cosines(const FrameKinematics& f) {
        if (std::all_of(f.axes.begin(), f.axes.end(), is_short)) {
            for (std::size_t k = 0; k < 3; ++k) vector(fmt::format("e_{}", "xyz"[k]), f.name, f.axes[k]);
            return;
        }
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                entry(fmt::format("C_{}{}", "xyz"[i], "xyz"[k]), f.name, f.axes[k][i]);
    }

    void part(const std::string& letter, const std::string& of, const KinematicVector& v) {
        if (!is_zero(v)) vector(letter, of, v);
    }

    std::string turns_in_words(const FrameKinematics& f) const {
        std::vector<std::string> words;
        for (const TurnStep& turn : f.turns) {
            const bool is_readable = turn.angle && is_known(turn.axis);
            if (!is_readable) {
                words.emplace_back(turn.angle ? say("a turn") : say("a quaternion"));
                continue;
            }
            const Phrase axis =
                phrases::tuple({*turn.axis[0].formula, *turn.axis[1].formula, *turn.axis[2].formula});
            words.push_back(say("{} about {}", n_.inline_phrase(*turn.angle), n_.inline_phrase(axis)));
        }
        return fmt::format("{}", fmt::join(words, ", "));
    }

    void frame(const FrameKinematics& f) {
        const std::string what = f.is_body ? say("Body") : say("Frame");
        if (!f.same_as.empty() &&
            (f.same_as == "N" || std::any_of(s_.frames.begin(), s_.frames.end(),
                                             [&](const FrameKinematics& o) { return o.name == f.same_as; })))
            return tell(say("{} {} has the axes of {}.", what, f.name, f.same_as));
        std::string words = fmt::format("{} {}", what, f.name);
        if (!f.turns.empty())
            words += say(", turned against {} by {}", f.parent, turns_in_words(f));
        else
            words += say(", at rest in {}", f.parent);
        tell(say("{}; along N:", words));
        cosines(f);
        vector("omega", f.name, f.omega.along_N);
        vector("alpha", f.name, f.alpha.along_N);
        if (!is_same(f.omega.along_N, f.omega.own) || !is_same(f.alpha.along_N, f.alpha.own)) {
            tell(say("Along {} itself:", f.name));
            vector("omega", f.name, f.omega.own);
            vector("alpha", f.name, f.alpha.own);
        }
        if (steps_) steps(f);
        if (!with_values_) return;
        const auto turned = [](const Turn<double>& t) {
            return say(", turned by {:.10g} about ({:.10g}, {:.10g}, {:.10g})", t.angle, t.axis[0], t.axis[1],
                       t.axis[2]);
        };
        tell(say("{} at the state{}:", f.name, f.turn ? turned(*f.turn) : ""));
        add(left("omega", f.name), value_of(f.omega.along_N));
        add(left("alpha", f.name), value_of(f.alpha.along_N));
    }

    void steps(const FrameKinematics& f) {
        if (f.turns.size() + (f.carried ? 1 : 0) < 2) return;
        tell(say("Angular velocity, turn by turn along {}: each adds its rate along its axis;", f.parent));
        if (f.carried) vector("omega", f.parent, (*f.carried)[0]);
        for (std::size_t k = 0; k < f.turns.size(); ++k)
            vector(fmt::format("omega_{}", k + 1), f.name, f.turns[k].omega);
        tell(say(
            "angular acceleration: its second rate, and omega x omega, since the turns before it take its axis "
            "along:"));
        if (f.carried) {
            part("alpha", f.parent, (*f.carried)[1]);
            part("omega x omega", say("{} in {}", f.name, f.parent), (*f.carried)[2]);
        }
        for (std::size_t k = 0; k < f.turns.size(); ++k) {
            part(fmt::format("alpha_{}", k + 1), f.name, f.turns[k].alpha);
            part(fmt::format("omega x omega_{}", k + 1), f.name, f.turns[k].turning);
        }
    }

    void point(const PointKinematics& p) {
        tell(say("Point {}, along N:", p.name));
        vector("r", p.name, p.position.along_N);
        vector("v", p.name, p.velocity.along_N);
        vector("a", p.name, p.acceleration.along_N);
        if (!p.along.empty()) {
            tell(say("{} along {}:", p.name, p.along));
            vector("r", p.name, p.position.own);
            vector("v", p.name, p.velocity.own);
            vector("a", p.name, p.acceleration.own);
        }
        if (steps_)
            for (const PlaceStep& step : p.places) steps(p, step);
        if (!with_values_) return;
        tell(say("{} at the state:", p.name));
        add(left("r", p.name), value_of(p.position.along_N));
        add(left("v", p.name), value_of(p.velocity.along_N));
        add(left("a", p.name), value_of(p.acceleration.along_N));
    }

    void steps(const PointKinematics& p, const PlaceStep& step) {
        if (!step.turns) return;
        const std::string along = step.frame.empty() ? say("the axes of the joint") : step.frame;
        tell(say("{}, reached from {} along {}: beside the velocity of {} it has omega x r + v_relative,", p.name,
                 p.from, along, p.from));
        part("r", p.name, step.offset);
        part("omega x r", p.name, step.turning_velocity);
        part("v_relative", p.name, step.relative_velocity);
        tell(
            say("and beside the acceleration of {} the tangential alpha x r, the centripetal omega x (omega x "
                "r), Coriolis's 2 omega x v_relative and the relative one:",
                p.from));
        part("a_tangential", p.name, step.tangential);
        part("a_centripetal", p.name, step.centripetal);
        part("a_Coriolis", p.name, step.coriolis);
        part("a_relative", p.name, step.relative);
    }

    const SceneKinematics& s_;
    const Notation& n_;
    const bool with_values_, steps_;
    std::vector<Block> blocks_;
    bool too_long_ = false;
};

}  // namespace

std::string as_page(const SceneKinematics& s, const std::string& format, bool steps) {
    const bool is_text = format == "text";
    const Notation n = notation_of(format);
    std::vector<Block> blocks = Writing(s, n, is_text, steps).blocks();
    if (!is_text) return n.page(blocks);
    if (!s.scene.title.empty()) blocks.insert(blocks.begin(), {s.scene.title, {}});
    if (!s.no_accelerations.empty())
        blocks.push_back({say("There are no accelerations at the state: {}", s.no_accelerations), {}});
    return n.page(blocks);
}

std::string jacobian_page(const SceneKinematics& s) {
    std::string page;
    const auto row = [&](const std::string& name, const std::vector<double>& values) {
        put(page, "  {:<8}", name);
        for (const double x : values) put(page, "{:>18.10g}", x == 0 ? 0.0 : x);
        page += "\n";
    };
    const auto matrix = [&](const std::vector<std::vector<double>>& rows) {
        const char* const names[] = {"v_x", "v_y", "v_z", "omega_x", "omega_y", "omega_z"};
        for (std::size_t i = 0; i < rows.size(); ++i) row(names[i], rows[i]);
    };
    for (const auto& [name, found] : s.jacobians) {
        page += "\n";
        say_on(page, "Jacobian of {}, along N; columns by the rates of {}:\n", name,
               fmt::join(s.coordinates, ", "));
        matrix(found.jacobian);
        row("J' q'", found.bias);
    }
    if (!s.mass_centre) return page;
    page += "\n";
    say_on(page, "Mass centre, along N; columns by the rates of {}:\n", fmt::join(s.coordinates, ", "));
    matrix(s.mass_centre->jacobian);
    row("r", s.mass_centre->position);
    say_on(page, "momentum, and angular momentum about the mass centre:\n");
    row("p", s.mass_centre->linear_momentum);
    row("L", s.mass_centre->angular_momentum);
    return page;
}

}  // namespace alembert
