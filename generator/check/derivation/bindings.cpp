// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/bindings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "check/derivation/letters.hpp"
#include "scene/body_points.hpp"

namespace alembert {

namespace {

/// A thing that a letter may speak of, and the point where it is: of a body, its mass centre.
struct Place3 {
    std::string name;
    bool named = false;
    std::string point = name;
};

/// x_C, y_G, r_{cm}: of a mass centre.
bool is_of_mass_centre(const std::string& index) {
    static constexpr const char* indices[] = {"C", "G", "S", "cm", "CM", "com", "COM"};
    return std::find(std::begin(indices), std::end(indices), index) != std::end(indices);
}

/// Does the index name the k-th thing of this name?
bool names(const std::string& index, const std::string& name, std::size_t k) {
    const std::string word = plain_word(index);
    if (word.empty()) return false;
    const std::string full = plain_word(name);
    const bool is_initial = !full.empty() && full.substr(0, 1) == word && !is_of_mass_centre(index);
    return word == full || word == std::to_string(k + 1) || is_initial ||
           (full.size() > 1 && full.substr(1) == word);
}

/// A, B, P: more often the end of a rod than a thing whose name begins so.
bool is_letter_of_point(const std::string& index) {
    return index.size() == 1 && std::isupper(static_cast<unsigned char>(index[0])) != 0 &&
           !is_of_mass_centre(index);
}

/// The things of the scene, those that the index names alone if there are any. `is_open`: a number may also mean
/// another one.
std::vector<Place3> matching(const std::vector<std::string>& things, const std::string& index, bool is_open) {
    std::vector<Place3> result;
    for (const bool exactly : {true, false}) {
        for (std::size_t k = 0; k < things.size(); ++k)
            if (exactly ? plain_word(index) == plain_word(things[k]) : names(index, things[k], k))
                result.push_back({things[k], exactly || !is_letter_of_point(index)});
        if (!result.empty()) break;
    }
    const bool is_number = is_count(index);
    if (!result.empty() && (!is_number || !is_open)) return result;
    for (const std::string& thing : things)  // an author counts in an order of his own
        if (result.empty() || thing != result[0].name)
            result.push_back({thing, things.size() == 1 && !is_letter_of_point(index)});
    return result;
}

std::vector<std::string> masses_of(const Scene& scene) {
    std::vector<std::string> result;
    for (const Particle& p : scene.particles) result.push_back(p.name.text);
    for (const Body& b : scene.bodies) result.push_back(b.name.text);
    return result;
}

/// Each mass that is a parameter alone, with what has it, where only one has.
std::map<std::string, std::string> masses_with_parameters(const Scene& scene) {
    std::map<std::string, std::string> result;
    std::set<std::string> several;
    const auto take = [&](const Expression& mass, const Name& name) {
        if (!result.emplace(mass.text, name.text).second) several.insert(mass.text);
    };
    for (const Particle& p : scene.particles) take(p.mass, p.name);
    for (const Body& b : scene.bodies) take(b.mass, b.name);
    for (const std::string& mass : several) result.erase(mass);
    return result;
}

std::vector<Place3> points_for(const std::string& index, const Scene& scene) {
    for (const Point& point : scene.points)  // C of a circle, where the scene has a point of this name
        if (point.name.text == index) return {{index, true}};
    const std::vector<std::string> masses = masses_of(scene);
    std::vector<Place3> result = matching(masses, index, !is_counted(scene));
    for (const auto& [mass, thing] : masses_with_parameters(scene))  // v_M of the cart, whose mass is M
        if (mass == index) result = {{thing, true}};
    for (Place3& place : result) place.point = centre_of(scene, place.name);
    const bool named = !result.empty() && result[0].named;
    if (named && !plain_word(index).empty()) return result;
    std::vector<std::string> points;
    for (const Point& p : scene.points) points.push_back(p.name.text);
    std::vector<Place3> others = matching(points, index, false);
    for (Place3& other : others)  // a point that has a body's name is not that mass
        if (centre_of(scene, other.name) != other.name) other.name.clear();
    const bool is_named =
        std::any_of(points.begin(), points.end(),
                    [&, k = std::size_t{0}](const auto& name) mutable { return names(index, name, k++); });
    if (is_named) return others;
    for (Place3 other : others) {
        other.named = false;
        result.push_back(other);
    }
    return result;
}

/// v_r, v_φ, v_ξ, a_t: of a component, along axes that the author knows.
bool is_component(const std::string& index) {
    static constexpr const char* indices[] = {"r",  "rho", "phi",  "varphi",   "theta", "t",   "n",   "tau", "s",
                                              "xi", "eta", "zeta", "parallel", "perp",  "rad", "tan", "h",   "v"};
    std::string plain = index;
    std::erase(plain, '\\');
    return std::find(std::begin(indices), std::end(indices), plain) != std::end(indices);
}

/// "x" of an index "x" or "1x": the component that it speaks of, and the rest of it. No component where the whole
/// index is the name of one of the things: "cylinder".
std::pair<int, std::string> component_in(const std::string& index, const std::vector<std::string>& things) {
    if (std::any_of(things.begin(), things.end(),
                    [&](const std::string& thing) { return plain_word(thing) == plain_word(index); }) ||
        is_component(index))
        return {-1, index};
    std::string rest = index;
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t at = rest.find("xyz"[axis]);
        if (at == std::string::npos) continue;
        rest.erase(at, 1);
        while (!rest.empty() && (rest.back() == ',' || rest.back() == ' ')) rest.pop_back();
        if (!rest.empty() && rest.front() == ',') rest.erase(0, 1);
        return {axis, rest};
    }
    return {-1, index};
}

constexpr const char* axis_names[] = {"ex", "ey", "ez"};

void add_component(std::vector<Binding>& to, const Place3& point, const char* vector, int axis) {
    const std::string text = fmt::format("dot({}({}),{}(N))", vector, point.point, axis_names[axis]);
    to.push_back({.text = text, .named = point.named, .reversed = false, .point = point.name});
    to.push_back({.text = "-" + text, .named = point.named, .reversed = true, .point = point.name});
}

/// ω_x^{body A}, the component along an axis of the body.
std::vector<Binding> angular_velocity_named(const Letter& letter, const Scene& scene) {
    const std::size_t axis =
        letter.index.size() == 1 ? std::string("xyz").find(letter.index[0]) : std::string::npos;
    if (letter.base != "omega" || axis == std::string::npos) return {};
    const std::string word = plain_word(letter.raised);
    for (const Body& body : scene.bodies)
        if (word == plain_word(body.name.text) || word == plain_word("body " + body.name.text))
            return {{.text = fmt::format("dot(omega({0}),{1}({0}))", body.name.text, axis_names[axis]),
                     .named = true}};
    return {};
}

}  // namespace

bool is_count(const std::string& index) {
    return !index.empty() && index.find_first_not_of("0123456789") == std::string::npos;
}

bool is_counted(const Scene& scene) {
    const auto ends_with_number = [](const std::string& name) {
        return !name.empty() && name.back() >= '0' && name.back() <= '9';
    };
    return std::any_of(
               scene.parameters.begin(), scene.parameters.end(),
               [&](const Parameter& p) { return p.name.text[0] == 'm' && ends_with_number(p.name.text); }) ||
           std::any_of(scene.coordinates.begin(), scene.coordinates.end(),
                       [&](const Coordinate& c) { return ends_with_number(c.name.text); }) ||
           std::any_of(scene.particles.begin(), scene.particles.end(),
                       [&](const Particle& p) { return ends_with_number(p.name.text); });
}

std::vector<Binding> bindings_of(const Letter& letter, const Scene& scene) {
    if (!letter.raised.empty()) return angular_velocity_named(letter, scene);
    std::vector<Binding> result;
    const std::string& base = letter.base;
    const std::size_t axis = base.size() == 1 ? std::string("xyz").find(base[0]) : std::string::npos;
    const std::size_t capital = base.size() == 1 ? std::string("XYZ").find(base[0]) : std::string::npos;
    if (axis != std::string::npos || capital != std::string::npos)
        for (const Place3& point : points_for(letter.index, scene))
            add_component(result, point, "pos", static_cast<int>(axis != std::string::npos ? axis : capital));
    std::vector<std::string> things = masses_of(scene);
    for (const Point& p : scene.points) things.push_back(p.name.text);
    const auto [component, rest] = component_in(letter.index, things);
    if (base == "v" || base == "a" || base == "r")
        for (Place3 point : points_for(component < 0 ? letter.index : rest, scene)) {
            if (component < 0 && is_component(letter.index)) point.named = false;
            const char* const vector = base == "v" ? "vel" : base == "a" ? "acc" : "pos";
            if (component >= 0)
                add_component(result, point, vector, component);
            else
                result.push_back({.text = fmt::format("sqrt(dot({0}({1}),{0}({1})))", vector, point.point),
                                  .named = point.named,
                                  .point = point.name});
        }
    std::vector<std::string> bodies;
    for (const Body& b : scene.bodies) bodies.push_back(b.name.text);
    if (base == "omega" || base == "Omega")
        for (const Place3& body : matching(bodies, component < 0 ? letter.index : rest, !is_counted(scene))) {
            const std::string text =
                fmt::format("dot(omega({0}),{1}({2}))", body.name, axis_names[component < 0 ? 2 : component],
                            component < 0 ? "N" : body.name);
            const std::string size =
                component < 0 ? fmt::format("sqrt(dot(omega({0}),omega({0})))", body.name) : "";
            result.push_back({.text = text, .named = body.named, .size = size});
            result.push_back({.text = "-" + text, .named = body.named, .reversed = true});
        }
    return result;
}

std::vector<Binding> other_axes_of(const Letter& letter, const Scene& scene) {
    std::vector<Binding> result;
    if (letter.base.size() != 1 || std::string("xyzXYZ").find(letter.base[0]) == std::string::npos) return result;
    std::vector<std::string> frames{"N"};
    for (const Frame& frame : scene.frames) frames.push_back(frame.name.text);
    for (const Place3& point : points_for(letter.index, scene))
        for (const std::string& frame : frames)
            for (const char* const axis : axis_names)
                result.push_back({.text = fmt::format("dot(pos({}),{}({}))", point.point, axis, frame)});
    return result;
}

std::vector<VectorBinding> vector_bindings_of(const Letter& letter, const Scene& scene) {
    std::vector<VectorBinding> result;
    const std::string& base = letter.base;
    const char* const vector = base == "r" || base == "R" || base == "x" || base == "p" || base == "OP" ? "pos"
                               : base == "v" || base == "V"                                             ? "vel"
                               : base == "a"                                                            ? "acc"
                                                                                                        : nullptr;
    if (vector == nullptr) return result;
    for (const Place3& point : points_for(letter.index, scene)) {
        VectorBinding binding{.component = {}, .named = point.named, .point = point.name};
        for (int axis = 0; axis < 3; ++axis)
            binding.component[axis] = fmt::format("dot({}({}),{}(N))", vector, point.point, axis_names[axis]);
        result.push_back(std::move(binding));
    }
    return result;
}

}  // namespace alembert
