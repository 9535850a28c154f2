// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/dimension_check.hpp"

#include <algorithm>
#include <utility>

#include "language/say.hpp"
#include "scene/dimensions.hpp"
#include "scene/text.hpp"
#include "scene/unit_text.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

/// Holds the values of a scene against what the language says that they are.
class DimensionCheck {
public:
    explicit DimensionCheck(const Scene& scene) : scene_(scene), dimensions_(scene) {}

    std::vector<Diagnostic> contradictions() {
        if (!dimensions_.are_useful()) return {};
        check_given();
        check_sums();
        if (is_si()) check_meanings();
        std::vector<Diagnostic> all = dimensions_.contradictions();
        all.insert(all.end(), found_.begin(), found_.end());
        const auto is_before = [](const Diagnostic& a, const Diagnostic& b) {
            return std::pair(a.place, a.message) < std::pair(b.place, b.message);
        };
        std::sort(all.begin(), all.end(), is_before);
        all.erase(std::unique(all.begin(), all.end(),
                              [&](const auto& a, const auto& b) { return !is_before(a, b) && !is_before(b, a); }),
                  all.end());
        return all;
    }

private:
    /// Whether all units of the scene are of the SI; else its lengths need not be metres.
    bool is_si() const {
        const auto are = [](const auto& items) {
            return std::all_of(items.begin(), items.end(), [](const auto& item) {
                const auto meaning = meaning_of_unit(item.unit);
                return !meaning || meaning->is_si();
            });
        };
        return are(scene_.parameters) && are(scene_.inputs) && are(scene_.coordinates) && are(scene_.speeds);
    }

    void is(const Expression& e, const Dimension& wanted, const std::string& what) {
        const std::optional<Dimension> known = dimensions_.of(e);
        if (!known || *known == wanted || is_number(e)) return;
        // The position cos(theta) is on a circle of radius 1: lengths, masses and times of 1 are not always
        // written.
        if (known->empty() && e.tree->kind != Tree::Kind::name) return;
        found_.push_back({e.place(),
                          say("{} is in {}, but its units make {}", what, text_of(wanted), text_of(*known)),
                          Severity::warning, "unit_mismatch"});
    }

    void is(const Vector& v, const Dimension& wanted, const std::string& what) {
        for (const Expression& component : v.component) is(component, wanted, what);
    }

    static bool is_number(const Expression& e) { return e.tree && !has_quantities(*e.tree); }

    template <typename Item>
    void matches(const Item& item, const Expression& value, int per_second = 0) {
        std::optional<Dimension> own = dimension_of_unit(item.unit);
        if (!own || !value.tree || is_number(value)) return;
        is(value, multiplied(*std::move(own), {{"s", 1}}, -per_second),
           say("the value of {}", in_quotes(item.name.text)));
    }

    void check_given() {
        for (const Parameter& p : scene_.parameters) matches(p, p.value);
        for (const Input& f : scene_.inputs) matches(f, f.value);
        for (const Coordinate& q : scene_.coordinates) matches(q, q.initial), matches(q, q.rate, 1);
        for (const Speed& u : scene_.speeds) matches(u, u.form), matches(u, u.initial);
    }

    void check_sums() {
        for (const Expression* e : {&scene_.kinetic, &scene_.potential, &scene_.lagrangian, &scene_.rayleigh})
            dimensions_.of(*e);
        for (const GeneralizedForce& g : scene_.generalized_forces) dimensions_.of(g.value);
        for (const Definition& d : scene_.definitions) dimensions_.of(d.value);
        for (const ConstraintRule& c : scene_.constraints) dimensions_.hold(c.equation);
        for (const UnilateralRule& u : scene_.unilateral) dimensions_.of(u.gap);
        for (const EventRule& e : scene_.events) dimensions_.of(e.when);
        for (const Output& o : scene_.outputs) dimensions_.of(o.value);
        for (const FrictionRule& f : scene_.frictions) dimensions_.of(f.slip);
    }

    void check_meanings() {
        check_places();
        check_loads();
        check_energies();
        if (scene_.gravity) is(*scene_.gravity, {{"m", 1}, {"s", -2}}, say("gravity"));
        for (const Expression* time :
             {&scene_.simulation.start, &scene_.simulation.duration, &scene_.simulation.step,
              &scene_.simulation.max_step, &scene_.simulation.sample, &scene_.simulation.period})
            is(*time, {{"s", 1}}, say("a time"));
    }

    /// Beside masses they are energies. By themselves they may have been divided by a constant, which all share.
    void check_energies() {
        Dimension whole = energy;
        if (scene_.particles.empty() && scene_.bodies.empty()) {
            const std::optional<Dimension> kinetic = dimensions_.of(scene_.kinetic);
            if (!kinetic) return;
            whole = *kinetic;
        }
        is(scene_.kinetic, whole, say("a kinetic energy"));
        is(scene_.potential, whole, say("a potential energy"));
        is(scene_.rayleigh, multiplied(whole, {{"s", 1}}, -1), say("Rayleigh's function"));
    }

    void check_places() {
        const Dimension metre{{"m", 1}};
        for (const Point& p : scene_.points)
            is(p.position.offset, metre, say("the offset of {}", in_quotes(p.name.text)));
        for (const Particle& p : scene_.particles) {
            is(p.position.offset, metre, say("the position of {}", in_quotes(p.name.text)));
            is(p.mass, {{"kg", 1}}, say("the mass of {}", in_quotes(p.name.text)));
        }
        for (const Body& b : scene_.bodies) {
            is(b.position.offset, metre, say("the position of {}", in_quotes(b.name.text)));
            is(b.mass, {{"kg", 1}}, say("the mass of {}", in_quotes(b.name.text)));
            if (!b.inertia) continue;
            const Dimension moment{{"kg", 1}, {"m", 2}};
            if (b.inertia->planar)
                is(*b.inertia->planar, moment, say("the inertia of {}", in_quotes(b.name.text)));
            for (const Expression& element : b.inertia->tensor)
                is(element, moment, say("the inertia of {}", in_quotes(b.name.text)));
        }
        for (const Frame& f : scene_.frames)
            for (const Rotation& r : f.rotations) is(r.angle, {}, say("the angle of {}", in_quotes(f.name.text)));
    }

    void check_loads() {
        for (const Force& f : scene_.forces) is(f.vector, force, say("a force"));
        for (const Torque& t : scene_.torques) is(t.vector, energy, say("a torque"));
        for (const Link& s : scene_.springs) {
            if (!s.between) continue;
            is(s.constant, multiplied(force, {{"m", 1}}, -1), say("a stiffness"));
            is(s.length, {{"m", 1}}, say("a length"));
        }
        for (const Link& d : scene_.dampers)
            if (d.between) is(d.constant, {{"kg", 1}, {"s", -1}}, say("a damping"));
        for (const FrictionRule& f : scene_.frictions) is(f.coefficient, {}, say("a coefficient of friction"));
        if (scene_.particles.empty() && scene_.bodies.empty()) return;
        for (const GeneralizedForce& g : scene_.generalized_forces)
            for (const Coordinate& q : scene_.coordinates)
                if (q.name.text == g.coordinate.text)
                    if (const auto own = dimension_of_unit(q.unit))
                        is(g.value, multiplied(energy, *own, -1),
                           say("the force along {}", in_quotes(q.name.text)));
    }

    const Dimension force{{"kg", 1}, {"m", 1}, {"s", -2}}, energy{{"kg", 1}, {"m", 2}, {"s", -2}};
    const Scene& scene_;
    Dimensions dimensions_;
    std::vector<Diagnostic> found_;
};

}  // namespace

std::vector<Diagnostic> contradicting_dimensions(const Scene& scene) {
    return DimensionCheck(scene).contradictions();
}

}  // namespace alembert
