// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/meanings.hpp"

#include <algorithm>
#include <optional>

#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

const Dimension metre{{"m", 1}}, kilogram{{"kg", 1}}, force{{"kg", 1}, {"m", 1}, {"s", -2}},
    energy{{"kg", 1}, {"m", 2}, {"s", -2}}, moment_of_inertia{{"kg", 1}, {"m", 2}};

class Meanings {
public:
    Meanings(const Scene& scene, Dimensions& dimensions) : scene_(scene), dimensions_(dimensions) {}

    std::vector<ValueMeaning> all() {
        add_places();
        add_loads();
        add_energies();
        if (scene_.gravity) add(*scene_.gravity, {{"m", 1}, {"s", -2}}, say("gravity"));
        const Simulation& s = scene_.simulation;
        for (const Expression* time : {&s.start, &s.duration, &s.step, &s.max_step, &s.sample, &s.period})
            add(*time, {{"s", 1}}, say("a time"));
        return std::move(all_);
    }

private:
    void add(const Expression& e, const Dimension& dimension, std::string what) {
        if (e.tree) all_.push_back({&e, dimension, std::move(what)});
    }
    void add(const Vector& v, const Dimension& dimension, const std::string& what) {
        for (const Expression& component : v.component) add(component, dimension, what);
    }

    void add_places() {
        for (const Point& p : scene_.points)
            add(p.position.offset, metre, say("the offset of {}", in_quotes(p.name.text)));
        for (const Particle& p : scene_.particles) {
            add(p.position.offset, metre, say("the position of {}", in_quotes(p.name.text)));
            add(p.mass, kilogram, say("the mass of {}", in_quotes(p.name.text)));
        }
        for (const Body& b : scene_.bodies) {
            add(b.position.offset, metre, say("the position of {}", in_quotes(b.name.text)));
            add(b.mass, kilogram, say("the mass of {}", in_quotes(b.name.text)));
            if (!b.inertia) continue;
            const std::string inertia = say("the inertia of {}", in_quotes(b.name.text));
            if (b.inertia->planar) add(*b.inertia->planar, moment_of_inertia, inertia);
            for (const Expression& element : b.inertia->tensor) add(element, moment_of_inertia, inertia);
        }
        for (const Frame& f : scene_.frames)
            for (const Rotation& r : f.rotations) add(r.angle, {}, say("the angle of {}", in_quotes(f.name.text)));
    }

    void add_loads() {
        for (const Force& f : scene_.forces) add(f.vector, force, say("a force"));
        for (const Torque& t : scene_.torques) add(t.vector, energy, say("a torque"));
        for (const Impulse& i : scene_.impulses)
            add(i.vector, multiplied(force, {{"s", 1}}, 1), say("an impulse"));
        for (const Link& s : scene_.springs) {
            const std::optional<Dimension> d = extension_of(s);
            if (!d) continue;
            add(s.constant, multiplied(energy, *d, -2), say("a stiffness"));
            add(s.length, *d, say("a length"));
        }
        for (const Link& damper : scene_.dampers)
            if (const std::optional<Dimension> d = extension_of(damper))
                add(damper.constant, multiplied(over_time(energy, -1), *d, -2), say("a damping"));
        for (const FrictionRule& f : scene_.frictions) {
            add(f.coefficient, {}, say("a coefficient of friction"));
            add(f.resting, {}, say("a coefficient of friction"));
            if (const std::optional<Dimension> sliding_velocity = dimensions_.of(f.sliding_velocity);
                sliding_velocity && has_masses() && is_told(*sliding_velocity, f.sliding_velocity))
                add(f.normal, multiplied(over_time(energy), *sliding_velocity, -1), say("a normal force"));
        }
        for (const RollingRule& r : scene_.rolling)
            add(r.contact, metre, say("the contact of {}", in_quotes(r.name.text)));
        if (!has_masses()) return;
        for (const GeneralizedForce& g : scene_.generalized_forces)
            for (const Coordinate& q : scene_.coordinates)
                if (q.name.text == g.coordinate.text)
                    if (const auto own = dimension_of_unit(q.unit))
                        add(g.value, multiplied(energy, *own, -1),
                            say("the force along {}", in_quotes(q.name.text)));
    }

    void add_energies() {
        Dimension whole = energy;
        if (!has_masses()) {
            const std::optional<Dimension> kinetic = dimensions_.of(scene_.kinetic);
            if (!kinetic) return;
            whole = *kinetic;
        }
        add(scene_.kinetic, whole, say("a kinetic energy"));
        add(scene_.potential, whole, say("a potential energy"));
        add(scene_.rayleigh, over_time(whole), say("Rayleigh's function"));
    }

    /// What a spring or damper is stretched by; nothing where its units do not tell.
    std::optional<Dimension> extension_of(const Link& link) {
        if (link.between) return metre;
        if (!has_masses()) return std::nullopt;
        std::optional<Dimension> d = dimensions_.of(link.along);
        return d && is_told(*d, link.along) ? d : std::nullopt;
    }

    /// A number may be an angle, or a length of which a radius of 1 is not written: only names and their sums
    /// tell.
    static bool is_told(const Dimension& dimension, const Expression& e) {
        return (dimension != Dimension{} && dimension != Dimension{{"s", -1}}) || !has_calls(*e.tree);
    }
    static bool has_calls(const Tree& tree) {
        return tree.kind == Tree::Kind::call ||
               std::any_of(tree.args.begin(), tree.args.end(), [](const TreePtr& arg) { return has_calls(*arg); });
    }

    bool has_masses() const { return !scene_.particles.empty() || !scene_.bodies.empty(); }

    const Scene& scene_;
    Dimensions& dimensions_;
    std::vector<ValueMeaning> all_;
};

}  // namespace

std::vector<ValueMeaning> meanings_of(const Scene& scene, Dimensions& dimensions) {
    return Meanings(scene, dimensions).all();
}

const Dimension& energy_dimension() {
    return energy;
}

}  // namespace alembert
