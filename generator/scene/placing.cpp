// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/placing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "base/language/say.hpp"
#include "scene/joint_moves.hpp"
#include "scene/quaternions.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

class Placing {
public:
    Placing(Scene& scene, std::vector<Diagnostic>& diagnostics) : scene_(scene), diagnostics_(diagnostics) {
        for (Body& body : scene.bodies) bodies_.emplace(body.name.text, &body);
    }

    void place() {
        check_bodies();
        place_all();
        for (Joint* joint : usable_) {
            joint->closes_loop = !joint->places_child && is_placed(joint->parent.body);
            check_coordinates(*joint);
        }
        check_own_places();
        // Nothing is known about a joint whose table is wrong, so bodies without a place are reported only if all
        // tables are right.
        if (usable_.size() == scene_.joints.size()) tell_unplaced();
    }

private:
    Scene& scene_;
    std::vector<Diagnostic>& diagnostics_;
    std::unordered_map<std::string, Body*> bodies_;
    std::vector<Joint*> usable_;

    void complain(Place place, std::string message) { diagnostics_.push_back({place, std::move(message)}); }

    void check_bodies() {
        std::vector<std::string> known{"N"};
        for (const Body& body : scene_.bodies) known.push_back(body.name.text);
        for (Joint& joint : scene_.joints) {
            bool is_usable = joint.is_whole;
            for (const Joint::Side* side : {&joint.parent, &joint.child}) {
                const Name& name = side->body;
                if (name.place.line == 0 || name.text == "N" || bodies_.contains(name.text)) continue;
                const std::string meant = nearest(name.text, known);
                complain(name.place, say("unknown body {}{}", in_quotes(name.text),
                                         meant.empty() ? say("; a joint holds bodies, or a body and the ground, N")
                                                       : say("; did you mean '{}'?", meant)));
                is_usable = false;
            }
            if (is_usable && joint.parent.body.text == joint.child.body.text) {
                complain(joint.child.body.place,
                         say("joint {} goes from {} to itself; its parent and its child must be two bodies",
                             in_quotes(joint.name.text), in_quotes(joint.child.body.text)));
                is_usable = false;
            }
            if (is_usable) usable_.push_back(&joint);
        }
    }

    bool is_placed(const Name& name) const {
        if (name.text == "N") return true;
        const Body& body = *bodies_.at(name.text);
        return body.has_position || body.joint;
    }

    void place_all() {
        const auto next = [&](bool with_coordinates) -> Joint* {
            for (Joint* joint : usable_)
                if (is_placed(joint->parent.body) != is_placed(joint->child.body) &&
                    (!with_coordinates || coordinates_of(*joint) == 0 || !joint->coordinates.empty()))
                    return joint;
            return nullptr;
        };
        for (;;) {
            Joint* joint = next(true);
            if (!joint) joint = next(false);
            if (!joint) return;
            joint->places_child = is_placed(joint->parent.body);
            Body& body = *bodies_.at((*joint->places_child ? joint->child : joint->parent).body.text);
            body.joint = static_cast<std::size_t>(joint - scene_.joints.data());
        }
    }

    void check_coordinates(const Joint& joint) {
        const std::string name = in_quotes(joint.name.text);
        const JointMoves& moves = moves_of(joint.type);
        const std::size_t needed = coordinates_of(joint), given = joint.coordinates.size();
        if (!joint.places_child) {
            if (!joint.closes_loop) return;
            if (given > 0)
                complain(
                    joint.coordinates.front().place,
                    say("body {} is placed already, by {}: joint {} closes a loop and has no coordinates",
                        in_quotes(joint.child.body.text == "N" ? joint.parent.body.text : joint.child.body.text),
                        placed_by(joint), name));
            else if (locked_directions(joint.type) == 0)
                complain(joint.name.place, say("joint {} is between bodies that are placed already, and a free "
                                               "joint locks nothing; leave it out",
                                               name));
            return;
        }
        const Place place = given > 0 ? joint.coordinates.front().place : joint.name.place;
        const bool by_quaternion = moves.has(Move::Kind::turn_in_space) && joint.angles.empty();
        if (by_quaternion && given == moves.before_turn_in_space() + 3)
            complain(place, say("joint {} has three angles; say about which axes, in this order, with angles = "
                                "\"zxz\" (or another sequence)",
                                name));
        else if (given != needed)
            complain(place,
                     say("joint {} is {} and places body {}: it has {} coordinate{}; expected {}{}", name,
                         moves.name, in_quotes((*joint.places_child ? joint.child : joint.parent).body.text),
                         given, given == 1 ? "" : "s", needed, meaning_of_coordinates(joint)));
        else if (by_quaternion)
            check_quaternion(joint);
    }

    void check_quaternion(const Joint& joint) {
        const auto is_free = [&](const Name& name) {
            return std::any_of(scene_.coordinates.begin(), scene_.coordinates.end(),
                               [&](const Coordinate& c) { return c.name.text == name.text; });
        };
        const std::vector<Name> e = quaternion_of(joint);
        const auto given = std::find_if_not(e.begin(), e.end(), is_free);
        if (given == e.end() || std::none_of(e.begin(), e.end(), is_free)) return;
        complain(
            given->place,
            say("the motion of joint {} prescribes {} alone of its quaternion; prescribe all four or none, or "
                "give three angles, angles = \"zxz\"",
                in_quotes(joint.name.text), in_quotes(given->text)));
    }

    std::string placed_by(const Joint& joint) const {
        const Body& body =
            *bodies_.at(joint.child.body.text == "N" ? joint.parent.body.text : joint.child.body.text);
        return body.joint ? say("joint {}", in_quotes(scene_.joints[*body.joint].name.text))
                          : say("its own position");
    }

    /// Checks that a body that a joint places has no frame of its own and no incomplete position.
    void check_own_places() {
        for (Body& body : scene_.bodies) {
            if (!body.joint) continue;
            const auto refuse = [&](const Name& name, const char* key) {
                if (name.place.line > 0)
                    complain(name.place,
                             say("body {} is placed by joint {}, and its frame bears its name; leave out "
                                 "'{}', or give the body a position of its own",
                                 in_quotes(body.name.text), in_quotes(scene_.joints[*body.joint].name.text), key));
            };
            refuse(body.frame, "frame");
            refuse(body.position.from, "from");
            refuse(body.position.axes, "axes");
            body.frame = {body.name.text, {}};
        }
    }

    void tell_unplaced() {
        std::unordered_map<std::string, std::string> parents;  // of bodies that were not placed
        for (const Joint* joint : usable_)
            if (!is_placed(joint->child.body)) parents.emplace(joint->child.body.text, joint->parent.body.text);
        std::unordered_set<std::string> told;
        for (const Body& body : scene_.bodies) {
            if (body.has_position || body.joint) continue;
            std::vector<std::string> path;
            std::string at = body.name.text;
            while (std::find(path.begin(), path.end(), at) == path.end() && !told.contains(at)) {
                path.push_back(at);
                const auto up = parents.find(at);
                if (up == parents.end()) break;
                at = up->second;
            }
            const bool is_new =
                std::none_of(path.begin(), path.end(), [&](const auto& name) { return told.contains(name); }) &&
                !told.contains(at);
            for (const std::string& name : path) told.insert(name);
            if (!is_new) continue;
            if (parents.contains(at)) {
                path.erase(path.begin(), std::find(path.begin(), path.end(), at));
                complain(
                    bodies_.at(at)->name.place,
                    say("joints in a circle: {} → {}; none of these bodies hangs on the ground, N, or on a body "
                        "with a position",
                        fmt::join(path, " → "), at));
            } else {
                complain(
                    bodies_.at(at)->name.place,
                    say("body {} is nowhere: it has neither 'at' nor 'position', and no joint reaches it from the "
                        "ground, N",
                        in_quotes(at)));
            }
        }
    }
};

}  // namespace

void place_by_joints(Scene& scene, std::vector<Diagnostic>& diagnostics) {
    if (!scene.joints.empty()) Placing(scene, diagnostics).place();
}

}  // namespace alembert
