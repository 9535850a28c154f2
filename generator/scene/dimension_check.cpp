// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/dimension_check.hpp"

#include <algorithm>
#include <utility>

#include "base/language/say.hpp"
#include "scene/dimensions.hpp"
#include "scene/meanings.hpp"
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
        if (is_in_si(scene_)) check_meanings();
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
        for (const FirstOrderState& z : scene_.states) matches(z, z.rate, 1), matches(z, z.initial);
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
        for (const FrictionRule& f : scene_.frictions)
            dimensions_.of(f.sliding_velocity), dimensions_.of(f.normal);
        for (const Speed& u : scene_.speeds) dimensions_.of(u.form);
        for (const FirstOrderState& z : scene_.states) dimensions_.of(z.rate);
        for (const Link& s : scene_.springs) dimensions_.of(s.along);
        for (const Link& d : scene_.dampers) dimensions_.of(d.along);
    }

    void check_meanings() {
        for (const ValueMeaning& meaning : meanings_of(scene_, dimensions_))
            is(*meaning.value, meaning.dimension, meaning.what);
    }

    const Scene& scene_;
    Dimensions dimensions_;
    std::vector<Diagnostic> found_;
};

}  // namespace

std::vector<Diagnostic> contradicting_dimensions(const Scene& scene) {
    return DimensionCheck(scene).contradictions();
}

}  // namespace alembert
