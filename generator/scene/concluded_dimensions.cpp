// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/concluded_dimensions.hpp"

#include "scene/meanings.hpp"
#include "scene/quaternions.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

class Conclusions {
public:
    explicit Conclusions(const Scene& scene) : scene_(scene), dimensions_(scene) {
        if (is_in_si(scene)) meanings_ = meanings_of(scene, dimensions_);
        for (const FrameQuaternion& quaternion : quaternions_of(scene))
            for (const Name& name : quaternion.e) dimensions_.learn(name.text, {});
    }

    std::vector<ConcludedDimension> all() {
        while (learn_once()) {
        }
        std::vector<ConcludedDimension> result;
        const auto add = [&](const std::string& name, const std::string& unit) {
            result.push_back({name, dimensions_.of_name(name), !unit.empty()});
        };
        for (const Coordinate& q : scene_.coordinates) add(q.name.text, q.unit);
        for (const Speed& u : scene_.speeds) add(u.name.text, u.unit);
        for (const FirstOrderState& z : scene_.states) add(z.name.text, z.unit);
        for (const ConstraintRule& c : scene_.constraints) {
            std::optional<Dimension> of_equation = dimensions_.of(c.equation.lhs);
            if (!of_equation || is_number(c.equation.lhs)) of_equation = dimensions_.of(c.equation.rhs);
            add_multiplier(result, c.name.text, of_equation, !c.holonomic);
        }
        for (const RollingRule& r : scene_.rolling)
            for (const char* axis : {"_x", "_y", "_z"})
                add_multiplier(result, r.name.text + axis, Dimension{{"m", 1}, {"s", -1}}, true);
        for (const UnilateralRule& u : scene_.unilateral)
            add_multiplier(result, u.name.text, dimensions_.of(u.gap), false);
        return result;
    }

private:
    static bool is_number(const Expression& e) { return e.tree && e.tree->kind == Tree::Kind::number; }

    void add_multiplier(std::vector<ConcludedDimension>& result, const std::string& constraint,
                        const std::optional<Dimension>& of_equation, bool is_of_rates) {
        std::optional<Dimension> own;
        if (const std::optional<Dimension> energy = energy_of_scene(); energy && of_equation)
            own = multiplied(is_of_rates ? over_time(*energy) : *energy, *of_equation, -1);
        result.push_back({"lambda_" + constraint, own});
    }

    std::optional<Dimension> energy_of_scene() {
        if (!scene_.particles.empty() || !scene_.bodies.empty())
            return is_in_si(scene_) ? std::optional(energy_dimension()) : std::nullopt;
        return dimensions_.of(scene_.kinetic ? scene_.kinetic : scene_.lagrangian);
    }

    bool learn_once() {
        bool is_new = false;
        const auto learn = [&](const Expression& e, const std::optional<Dimension>& wanted) {
            if (e.tree) is_new = dimensions_.learn(e, wanted) || is_new;
        };
        for (const ValueMeaning& meaning : meanings_) learn(*meaning.value, meaning.dimension);
        const std::optional<Dimension> energy = energy_of_scene();
        for (const Expression* e : {&scene_.kinetic, &scene_.potential, &scene_.lagrangian}) learn(*e, energy);
        learn(scene_.rayleigh, energy ? std::optional(over_time(*energy)) : std::nullopt);
        for (const ConstraintRule& c : scene_.constraints) {
            learn(c.equation.lhs, is_number(c.equation.rhs) ? std::nullopt : dimensions_.of(c.equation.rhs));
            learn(c.equation.rhs, is_number(c.equation.lhs) ? std::nullopt : dimensions_.of(c.equation.lhs));
        }
        for (const Speed& u : scene_.speeds) {
            learn(u.form, dimensions_.of_name(u.name.text));
            if (const auto own = dimensions_.of(u.form)) is_new = dimensions_.learn(u.name.text, *own) || is_new;
        }
        for (const FirstOrderState& z : scene_.states) {
            const std::optional<Dimension> own = dimensions_.of_name(z.name.text);
            learn(z.rate, own ? std::optional(over_time(*own)) : std::nullopt);
            if (const auto rate = dimensions_.of(z.rate); rate && z.rate.tree && !is_number(z.rate))
                is_new = dimensions_.learn(z.name.text, multiplied(*rate, {{"s", 1}}, 1)) || is_new;
        }
        for (const UnilateralRule& u : scene_.unilateral) learn(u.gap, {});
        for (const Definition& d : scene_.definitions) learn(d.value, dimensions_.of_name(d.name.text));
        for (const Parameter& p : scene_.parameters) learn(p.value, dimensions_.of_name(p.name.text));
        for (const Input& f : scene_.inputs) learn(f.value, dimensions_.of_name(f.name.text));
        for (const Coordinate& q : scene_.coordinates) learn(q.initial, dimensions_.of_name(q.name.text));
        return is_new;
    }

    const Scene& scene_;
    Dimensions dimensions_;
    std::vector<ValueMeaning> meanings_;
};

}  // namespace

std::vector<ConcludedDimension> concluded_dimensions(const Scene& scene) {
    return Conclusions(scene).all();
}

}  // namespace alembert
