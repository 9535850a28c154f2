// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/check.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "base/language/say.hpp"
#include "scene/check_claim.hpp"
#include "scene/names.hpp"
#include "scene/quantity.hpp"
#include "scene/quaternions.hpp"
#include "scene/references.hpp"
#include "scene/sticking.hpp"
#include "scene/tables.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

bool has_names(const Tree& tree) {
    return (tree.kind == Tree::Kind::name && tree.text != "pi") ||
           std::any_of(tree.args.begin(), tree.args.end(), [](const TreePtr& arg) { return has_names(*arg); });
}

class Checker {
public:
    Checker(const Scene& scene, std::vector<Diagnostic>& diagnostics)
        : scene_(scene),
          diagnostics_(diagnostics),
          names_(declare(scene, diagnostics)),
          quantities_(names_, diagnostics) {}

    void check() {
        describe_definitions();
        check_speeds();
        check_states();
        check_values();
        check_geometry();
        check_joints();
        check_masses();
        check_loads();
        check_impulses();
        check_energy();
        check_constraints();
        check_frictions();
        check_runs();
        for (const Claim& claim : scene_.claims) check_claim(claim, {scene_, names_, quantities_, diagnostics_});
    }

    void check(const Looks& looks) {
        const Legal size{.subject = say("a size")},
            place{.subject = say("a place"), .order = 0, .input_order = 0, .time = true};
        for (const auto& looked : looks.shapes) {
            const auto& name = looked.first;  // no bindings: closures of clang 14 cannot hold them
            const auto& shape = looked.second;
            check(shape, place);
            const bool counts = std::any_of(scene_.bodies.begin(), scene_.bodies.end(), [&](const Body& body) {
                return body.name.text == name.text && body.inertia && !body.inertia->planar &&
                       body.inertia->tensor[2].place() == shape.place;  // "from shape"
            });
            check_sizes(shape, counts, scene_, diagnostics_);
        }
        for (const Scenery& one : looks.scenery) {
            const auto is_pulley = [&](const std::string& name) {
                return std::any_of(looks.scenery.begin(), looks.scenery.end(), [&](const Scenery& other) {
                    return other.kind == Scenery::Kind::pulley && other.name && other.name->text == name;
                });
            };
            for (const Scenery::Spot& spot : one.spots)
                if (!spot.name)
                    check(spot.position, place);
                else if (!is_pulley(spot.name->text))
                    quantities_.check_point(*spot.name);
            check(one.shape, place);
            if (one.kind == Scenery::Kind::solid) check_sizes(one.shape, false, scene_, diagnostics_);
            quantities_.check(one.from, size);
            quantities_.check(one.to, size);
            if (one.over) check_coordinate(*one.over);
        }
    }

    /// After `check`.
    std::vector<Diagnostic> warnings() const {
        std::vector<Diagnostic> found = quantities_.warnings();
        const auto unused = [&](const Name& name, Declared::Kind kind, const std::string& what) {
            if (quantities_.is_used(kind, name.text) || name.place.line == 0) return;
            std::string message = say("{} {} is not used", what, in_quotes(name.text));
            if (name.text == "g" && kind == Declared::Kind::parameter && !scene_.gravity && !scene_.lagrangian)
                message +=
                    say(", and the scene has no gravity; write gravity = [0, \"-g\"] above the first table");
            found.push_back({name.place, std::move(message), Severity::warning, "unused", name.text});
        };
        for (const Parameter& p : scene_.parameters) unused(p.name, Declared::Kind::parameter, say("parameter"));
        for (const Input& i : scene_.inputs) unused(i.name, Declared::Kind::input, say("input"));
        for (const Definition& d : scene_.definitions)
            if (!d.is_motion) unused(d.name, Declared::Kind::definition, say("definition"));
        if (!scene_.particles.empty() ||
            !scene_.bodies.empty()) {  // else frames and points are what the scene is about
            for (const Frame& f : scene_.frames) unused(f.name, Declared::Kind::frame, say("frame"));
            for (const Point& p : scene_.points) unused(p.name, Declared::Kind::point, say("point"));
        }
        warn_of_still_inertia(found);
        return found;
    }

    void check_claims() {
        describe_definitions();
        for (const Claim& claim : scene_.claims) check_claim(claim, {scene_, names_, quantities_, diagnostics_});
    }

private:
    const Scene& scene_;
    std::vector<Diagnostic>& diagnostics_;
    const NameSpaces names_;
    Quantities quantities_;

    /// A moment of inertia along the axes of N belongs to a body that never turns.
    void warn_of_still_inertia(std::vector<Diagnostic>& found) const {
        for (const Body& body : scene_.bodies) {
            if (!body.inertia || body.joint || body.frame.text != "N") continue;
            found.push_back(
                {body.inertia->place,
                 say("body {} never turns, so that its moment of inertia has no effect: its axes are those of "
                     "N; give it the frame that turns with it, frame = \"…\", a [[frame]] with rotate",
                     in_quotes(body.name.text)),
                 Severity::warning, "no_effect", body.name.text});
        }
    }

    void describe_definitions() {
        for (const auto& [kind, k] : follow(scene_, diagnostics_).definitions)
            if (kind == Declared::Kind::speed)
                quantities_.describe(scene_.speeds[k]);
            else
                quantities_.describe(scene_.definitions[k]);
    }

    void complain(Place place, std::string message) { diagnostics_.push_back({place, std::move(message)}); }

    void check(const Vector& vector, const Legal& legal) {
        for (const Expression& component : vector.component) quantities_.check(component, legal);
    }

    void check_values() {
        const Legal parameter{.subject = say("a parameter"), .definitions = false};
        const Legal input{.subject = say("an input"), .input_order = 2, .time = true, .definitions = false};
        const Legal initial{.subject = say("an initial value"), .definitions = false};
        for (const Parameter& p : scene_.parameters) quantities_.check(p.value, parameter);
        for (const Input& i : scene_.inputs) {
            quantities_.check(i.value, input);
            if (i.from_outside && i.value && has_names(*i.value.tree))
                complain(i.value.place(),
                         say("the value of '{}', which is given from outside, is what it has where "
                             "nobody gives it: expected a number",
                             i.name.text));
        }
        for (const Coordinate& c : scene_.coordinates) {
            quantities_.check(c.initial, initial);
            quantities_.check(c.rate, initial);
        }
    }

    void check_states() {
        const Legal initial{.subject = say("an initial value"), .definitions = false},
            rate{.subject = say("the rate of a state"), .order = 1, .input_order = 2, .time = true};
        for (const FirstOrderState& state : scene_.states) {
            quantities_.check(state.initial, initial);
            quantities_.check(state.rate, rate);
        }
    }

    void check_speeds() {
        const Legal initial{.subject = say("an initial value"), .definitions = false};
        const Speed* first = nullptr;
        for (const Speed& speed : scene_.speeds) {
            quantities_.check(speed.initial, initial);
            if (!first && speed.initial) first = &speed;
        }
        if (!first) return;
        for (const Coordinate& c : scene_.coordinates)
            if (c.rate_given)
                complain(*c.rate_given,
                         say("the rates follow from the speeds here: {} has 'initial' (line {}); leave out "
                             "the rate of {}, or the initial values of the speeds",
                             in_quotes(first->name.text), first->name.place.line, in_quotes(c.name.text)));
    }

    void check_geometry() {
        const Legal angle{.subject = say("an angle"), .order = 0, .input_order = 0, .time = true};
        const Legal axis{.subject = say("an axis")};
        std::unordered_map<std::string, std::string> taken;  // coordinate → frame
        for (const FrameQuaternion& quaternion : quaternions_of(scene_))
            for (const Name& name : quaternion.e) check_quaternion(name, quaternion.of.text, taken);
        for (const Frame& frame : scene_.frames) {
            quantities_.check_frame(frame.parent);
            for (const Rotation& rotation : frame.rotations) {
                quantities_.check(rotation.angle, angle);
                quantities_.doubt_rotation(rotation.angle);
                check(rotation.axis, axis);
            }
        }
        for (const Point& point : scene_.points) check(point.position);
    }

    void check_joints() {
        const Legal constant{.subject = say("the place of a joint in its body")}, pitch{.subject = say("a pitch")};
        std::unordered_map<std::string, Place> known;
        for (const Joint& joint : scene_.joints) {
            for (const Joint::Side* side : {&joint.parent, &joint.child}) {
                check(side->point, constant);
                for (const Rotation& rotation : side->rotate) {
                    quantities_.check(rotation.angle, constant);
                    quantities_.doubt_rotation(rotation.angle);
                    check(rotation.axis, {.subject = say("an axis")});
                }
            }
            check(joint.axis.axis, {.subject = say("an axis")});
            quantities_.check(joint.pitch, pitch);
            if (joint.name.place.line == 0 || !need_name(joint.name, diagnostics_)) continue;
            const auto [first, is_new] = known.emplace(joint.name.text, joint.name.place);
            if (!is_new)
                complain(joint.name.place, say("the name {} is taken: a joint has it on line {}",
                                               in_quotes(joint.name.text), first->second.line));
        }
    }

    void check_quaternion(const Name& name, const std::string& frame,
                          std::unordered_map<std::string, std::string>& taken) {
        check_coordinate(name);
        const auto [first, is_new] = taken.emplace(name.text, frame);
        if (!is_new)
            complain(name.place,
                     say("the coordinate {} is in the quaternion of frame {} already; each has four of its own",
                         in_quotes(name.text), in_quotes(first->second)));
    }

    void check(const Position& position) {
        quantities_.check_point(position.from);
        quantities_.check_frame(position.axes);
        check(position.offset, {.subject = say("a position"), .order = 0, .input_order = 0, .time = true});
    }

    void check_masses() {
        const Legal mass{
            .subject = say("a mass"),
            .if_changing =
                say("; a body whose mass changes is no closed system, and its equation depends on the "
                    "velocity of what leaves or joins it: with kinetic = \"(m0 - k*t)*x'^2/2\" in [energy] "
                    "that has no velocity, (m x')' = F; otherwise say with leaves = [x, y] of a [[particle]] the "
                    "velocity of what leaves relative to it")},
            moment{.subject = say("a moment of inertia")};
        if (scene_.gravity) check(*scene_.gravity, {.subject = say("gravity"), .input_order = 2, .time = true});
        const Legal changing{.subject = say("a mass"), .order = 0, .input_order = 0, .time = true};
        for (const Particle& particle : scene_.particles) {
            quantities_.check(particle.mass, particle.leaves ? changing : mass);
            if (particle.leaves) {
                check(*particle.leaves,
                      {.subject = say("the velocity of what leaves"), .order = 1, .input_order = 2, .time = true});
                quantities_.check_frame(particle.along);
            }
            check(particle.position);
        }
        for (const Body& body : scene_.bodies) {
            quantities_.check(body.mass, mass);
            quantities_.check_frame(body.frame);
            check(body.position);
            if (body.about) quantities_.check_point(*body.about);
            if (!body.inertia) continue;
            if (body.inertia->planar) quantities_.check(*body.inertia->planar, moment);
            for (const Expression& element : body.inertia->tensor) quantities_.check(element, moment);
        }
    }

    void check(const Shape& shape, const Legal& size) {
        for (const Expression& one : shape.sizes) quantities_.check(one, size);
        check(shape.middle, size);
        quantities_.check(shape.turn, size);
        if (shape.axes) quantities_.check_frame(*shape.axes);
    }

    void check_loads() {
        const Legal force{.subject = say("a force"), .order = 1, .input_order = 2, .time = true};
        const Legal torque{.subject = say("a torque"), .order = 1, .input_order = 2, .time = true};
        for (const Force& f : scene_.forces) {
            quantities_.check_point(f.at);
            quantities_.check_frame(f.axes);
            if (f.reaction) quantities_.check_point(*f.reaction);
            if (f.on) quantities_.check_frame(*f.on);
            check(f.vector, force);
        }
        for (const Torque& t : scene_.torques) {
            quantities_.check_frame(t.on);
            quantities_.check_frame(t.axes);
            if (t.reaction) quantities_.check_frame(*t.reaction);
            check(t.vector, torque);
        }
        for (const Link& spring : scene_.springs)
            check(spring, {.subject = say("a stiffness"), .order = 0, .input_order = 2, .time = true});
        for (const Link& damper : scene_.dampers)
            check(damper, {.subject = say("a damping"), .order = 1, .input_order = 2, .time = true});
        for (const GeneralizedForce& f : scene_.generalized_forces) {
            check_coordinate(f.coordinate);
            quantities_.check(f.value, force);
        }
        for (const Armature& rotor : scene_.armatures)
            quantities_.check(rotor.inertia, {.subject = say("the inertia of a rotor")});
    }

    void check_impulses() {
        const Legal impulse{.subject = say("an impulse"), .order = 0, .input_order = 2, .time = true};
        for (const Impulse& i : scene_.impulses) {
            quantities_.check_point(i.at);
            quantities_.check_frame(i.axes);
            check(i.vector, impulse);
        }
        for (const GeneralizedForce& i : scene_.generalized_impulses) {
            check_coordinate(i.coordinate);
            quantities_.check(i.value, impulse);
        }
    }

    void check(const Link& link, const Legal& constant) {
        if (link.between) {
            quantities_.check_point(link.between->first);
            quantities_.check_point(link.between->second);
            if (link.between->first.text == link.between->second.text)
                complain(
                    link.between->second.place,
                    say("both ends are at {}, so that there is no direction between them; expected two points",
                        in_quotes(link.between->second.text)));
        }
        const Legal length{.subject = say("a length"), .order = 0, .input_order = 0, .time = true};
        quantities_.check(link.along, length);
        quantities_.check(link.length, length);
        quantities_.check(link.constant, constant);
    }

    void check_coordinate(const Name& name) {
        const Declared* const declared = NameSpaces::find(names_.values, name.text);
        if (declared && declared->kind == Declared::Kind::coordinate) return;
        std::vector<std::string> coordinates;
        for (const Coordinate& c : scene_.coordinates) coordinates.push_back(c.name.text);
        complain(name.place,
                 declared ? say("{} is {}; expected a coordinate", in_quotes(name.text), described(declared->kind))
                          : say("unknown coordinate {}{}", in_quotes(name.text),
                                quantities_.suggestion(name.text, coordinates)));
    }

    void check_energy() {
        const std::string advice = say("; a potential that depends on rates belongs in 'lagrangian'");
        quantities_.check(scene_.kinetic,
                          {.subject = say("the kinetic energy"), .order = 1, .input_order = 1, .time = true});
        quantities_.check(
            scene_.potential,
            {.subject = say("the potential"), .order = 0, .input_order = 2, .time = true, .advice = advice});
        quantities_.check(scene_.lagrangian,
                          {.subject = say("the Lagrangian"), .order = 1, .input_order = 1, .time = true});
        quantities_.check(scene_.rayleigh,
                          {.subject = say("the dissipation"), .order = 1, .input_order = 2, .time = true});
        if (!scene_.lagrangian) return;
        const auto refuse = [&](const std::string& what, Place place) {
            complain(place,
                     say("{} beside a 'lagrangian' (line {}), which stands for the whole energy; leave one out",
                         what, scene_.lagrangian.place().line));
        };
        if (scene_.gravity) refuse("'gravity'", scene_.gravity->place);
        if (!scene_.particles.empty()) refuse(say("a [[particle]]"), scene_.particles.front().name.place);
        if (!scene_.bodies.empty()) refuse(say("a [[body]]"), scene_.bodies.front().name.place);
        if (!scene_.springs.empty()) refuse(say("a [[spring]]"), scene_.springs.front().place);
    }

    void check_constraints() {
        std::unordered_map<std::string, Place> known;
        for (const ConstraintRule& rule : scene_.constraints) {
            const Legal position{.subject = say("a holonomic constraint"),
                                 .order = 0,
                                 .input_order = 0,
                                 .time = true,
                                 .advice = say("; a relation between rates is 'nonholonomic'")};
            const Legal rates{.subject = say("a constraint"), .order = 1, .input_order = 1, .time = true};
            quantities_.check(rule.equation.lhs, rule.holonomic ? position : rates);
            quantities_.check(rule.equation.rhs, rule.holonomic ? position : rates);
            check_constraint_name(rule.name, known);
        }
        for (const FrameQuaternion& quaternion : quaternions_of(scene_))
            check_constraint_name(quaternion.of, known);
        for (const RollingRule& rule : scene_.rolling) {
            check_body(rule.body, false);
            check_body(rule.on, true);
            if (rule.body.text == rule.on.text && rule.body.place.line > 0)
                complain(rule.on.place,
                         say("{} cannot roll on itself; 'on' is another body, or left out for the ground",
                             in_quotes(rule.on.text)));
            quantities_.check_frame(rule.axes);
            check(rule.contact, {.subject = say("a contact"), .order = 0, .input_order = 0, .time = true});
            for (const char* axis : {"_x", "_y", "_z"})
                check_constraint_name({rule.name.text + axis, rule.name.place}, known);
        }
        for (const UnilateralRule& rule : scene_.unilateral) {
            quantities_.check(rule.gap, {.subject = say("a gap"), .order = 0, .input_order = 0, .time = true});
            quantities_.check(rule.restitution, {.subject = say("a restitution")});
            check_constraint_name(rule.name, known);
        }
    }

    void check_frictions() {
        std::unordered_map<std::string, Place> known;
        std::unordered_map<std::string, const FrictionRule*> forces;
        const Legal rates{.subject = say("a sliding velocity"), .order = 1, .input_order = 1, .time = true};
        for (const FrictionRule& rule : scene_.frictions) {
            for (const auto& [value, subject] : {std::pair{&rule.coefficient, say("a coefficient of friction")},
                                                 std::pair{&rule.resting, say("a static coefficient of friction")},
                                                 std::pair{&rule.normal, say("a normal force")}})
                quantities_.check(*value, {.subject = subject, .order = 1, .input_order = 2, .time = true});
            quantities_.check(rule.sliding_velocity, rates);
            quantities_.check(rule.across, rates);
            quantities_.check(rule.restitution, {.subject = say("a restitution")});
            if (rule.name.place.line == 0 || !need_name(rule.name, diagnostics_)) continue;
            const auto [first, is_new] = known.emplace(rule.name.text, rule.name.place);
            if (!is_new)
                complain(rule.name.place, say("the name {} is taken: a friction has it on line {}",
                                              in_quotes(rule.name.text), first->second.line));
            else
                check_forces(rule, forces);
        }
    }

    /// While they stick, frictions `a` in a plane and `a_1` would have a force of one name.
    void check_forces(const FrictionRule& rule, std::unordered_map<std::string, const FrictionRule*>& forces) {
        for (const std::string& force : sticking_forces(rule)) {
            const auto [first, is_new] = forces.emplace(force, &rule);
            if (is_new) continue;
            complain(
                rule.name.place,
                say("while friction {} sticks, its force is called {}, and so is one of friction {} on line {}; "
                    "give one of the two another name",
                    in_quotes(rule.name.text), in_quotes(force), in_quotes(first->second->name.text),
                    first->second->name.place.line));
            return;
        }
    }

    void check_body(const Name& name, bool or_ground) {
        if (name.place.line == 0 || (or_ground && name.text == "N")) return;
        const Declared* const declared = NameSpaces::find(names_.frames, name.text);
        if (declared && declared->kind == Declared::Kind::body) return;
        std::vector<std::string> bodies;
        for (const Body& b : scene_.bodies) bodies.push_back(b.name.text);
        complain(name.place,
                 declared
                     ? say("{} is {}; expected a body", in_quotes(name.text), described(declared->kind))
                     : say("unknown body {}{}", in_quotes(name.text), quantities_.suggestion(name.text, bodies)));
    }

    void check_constraint_name(const Name& name, std::unordered_map<std::string, Place>& known) {
        if (name.place.line == 0 || !need_name(name, diagnostics_)) return;
        const auto [first, is_new] = known.emplace(name.text, name.place);
        if (!is_new)
            complain(name.place, say("the name {} is taken: a constraint has it on line {}", in_quotes(name.text),
                                     first->second.line));
    }

    /// A table of the motion has columns of these names already; that of x = "x" is the same.
    void check_column(const Output& of) {
        const Name& output = of.name;
        if (of.value.tree && of.value.tree->kind == Tree::Kind::name && of.value.tree->text == output.text) return;
        const Declared* const declared = NameSpaces::find(names_.values, output.text);
        using Kind = Declared::Kind;
        const bool is_column = declared && (declared->kind == Kind::coordinate || declared->kind == Kind::speed ||
                                            declared->kind == Kind::multiplier);
        if (is_column || output.text == "t" || output.text == "energy")
            complain(output.place,
                     say("the output {0} cannot have this name: tables of the motion have a column {0} "
                         "already, that of {1}",
                         in_quotes(output.text),
                         is_column            ? described(declared->kind)
                         : output.text == "t" ? say("the time")
                                              : say("the energy")));
    }

    void check_changes(const EventRule& event) {
        for (const GeneralizedForce& one : event.set) {
            check_state(one.coordinate);
            quantities_.check(
                one.value, {.subject = say("the value of a state"), .order = 1, .input_order = 2, .time = true});
        }
        for (const GeneralizedForce& one : event.rates) {
            check_coordinate(one.coordinate);
            quantities_.check(one.value, {.subject = say("a rate"), .order = 1, .input_order = 2, .time = true});
        }
    }

    void check_state(const Name& name) {
        const Declared* const declared = NameSpaces::find(names_.values, name.text);
        if (declared && declared->kind == Declared::Kind::state) return;
        std::vector<std::string> states;
        for (const FirstOrderState& z : scene_.states) states.push_back(z.name.text);
        complain(name.place, declared ? say("{} is {}; an event sets a state: declare it in [states]",
                                            in_quotes(name.text), described(declared->kind))
                                      : say("unknown state {}{}; declare it in [states]", in_quotes(name.text),
                                            quantities_.suggestion(name.text, states)));
    }

    void check_runs() {
        Legal anything{
            .subject = say("an output"), .order = 2, .input_order = 2, .time = true, .multipliers = true};
        for (const Output& output : scene_.outputs) {
            need_name(output.name, diagnostics_);
            check_column(output);
            quantities_.check(output.value, anything);
        }
        std::unordered_map<std::string, Place> events;
        for (const EventRule& event : scene_.events) {
            quantities_.check(
                event.when,
                {.subject = say("an event"), .order = 1, .input_order = 2, .time = true, .multipliers = true});
            check_changes(event);
            for (const GeneralizedForce& i : event.impulses) {
                check_coordinate(i.coordinate);
                quantities_.check(i.value,
                                  {.subject = say("an impulse"), .order = 1, .input_order = 2, .time = true});
            }
            if (event.name.place.line == 0 || !need_name(event.name, diagnostics_)) continue;
            const auto [first, is_new] = events.emplace(event.name.text, event.name.place);
            if (!is_new)
                complain(event.name.place, say("the name {} is taken: an event has it on line {}",
                                               in_quotes(event.name.text), first->second.line));
        }
        const Legal constant{.subject = say("a setting of the simulation"), .definitions = false};
        if (scene_.polynomial)
            for (const Expression& coefficient : scene_.polynomial->coefficients)
                quantities_.check(coefficient,
                                  {.subject = say("a coefficient of a polynomial"), .definitions = false});
        const Simulation& s = scene_.simulation;
        for (const Expression* value :
             {&s.start, &s.duration, &s.tolerance, &s.step, &s.max_step, &s.sample, &s.period})
            quantities_.check(*value, constant);
    }
};

}  // namespace

std::vector<Diagnostic> check_scene(const Scene& scene, const Looks& looks, std::vector<Diagnostic>& warnings) {
    std::vector<Diagnostic> diagnostics;
    Checker checker(scene, diagnostics);
    checker.check();
    checker.check(looks);
    for (Diagnostic& one : checker.warnings()) warnings.push_back(std::move(one));
    return diagnostics;
}

std::vector<Diagnostic> check_claims(const Scene& scene) {
    std::vector<Diagnostic> diagnostics;
    Checker(scene, diagnostics).check_claims();
    return diagnostics;
}

}  // namespace alembert
