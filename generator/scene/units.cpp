// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "base/language/say.hpp"
#include "scene/dimensions.hpp"
#include "scene/text.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

namespace {

/// (text)*(factor)
Expression times(const Expression& e, const std::string& factor) {
    std::vector<Place> places;
    if (!e.places.empty()) {
        places.assign(1, e.places.front());
        places.insert(places.end(), e.places.begin(), e.places.end());
        places.insert(places.end(), factor.size() + 4, e.places.back());
    }
    std::vector<Diagnostic> none;
    return parse_expression(fmt::format("({})*({})", e.text, factor), std::move(places), none);
}

class Converting {
public:
    Converting(Scene& scene, std::vector<Diagnostic>& found) : scene_(scene), found_(found) {}

    void convert() {
        for (Parameter& p : scene_.parameters) convert(p, {&p.value});
        for (Input& f : scene_.inputs) convert(f, {&f.value});
        for (Coordinate& q : scene_.coordinates) convert(q, {&q.initial, &q.rate});
        for (Speed& u : scene_.speeds) convert(u, {&u.initial});
    }

private:
    template <typename Item>
    void convert(Item& item, const std::vector<Expression*>& values) {
        if (item.unit.empty()) return;
        if (is_no_multiple(item.unit)) {
            found_.push_back(
                {item.name.place, say("the unit of {} is '{}', which has a zero of its own or is a logarithm; "
                                      "a quantity is a multiple of its unit: write it in K, or as a ratio",
                                      in_quotes(item.name.text), item.unit)});
            return;
        }
        const std::optional<UnitMeaning> meaning = meaning_of_unit(item.unit);
        if (!meaning || meaning->exact.empty()) return;
        item.shown = {item.unit, meaning->factor, values[0]->text};
        for (Expression* value : values)
            if (*value && is_in_unit(*value, *meaning, item)) *value = times(*value, meaning->exact);
        item.unit = meaning->si;
    }

    /// Whether the value is a number of that unit, and no quantity in SI units.
    template <typename Item>
    bool is_in_unit(const Expression& value, const UnitMeaning& meaning, const Item& item) {
        if (!has_quantities(*value.tree)) return true;
        Dimension wanted = meaning.exponents;
        wanted.erase("rad");
        const std::optional<Dimension> known = Dimensions(scene_, Dimensions::Numbers::pure).of(value);
        if (wanted.empty() || (known && !known->empty())) return false;
        if (known) return true;
        found_.push_back(
            {value.place(),
             say("this value of {} is taken as it is, in SI units, and not in '{}': the units of what is in it do "
                 "not tell; give them units, or write quantities such as \"2 mm\"",
                 in_quotes(item.name.text), item.unit),
             Severity::warning, "unit_mismatch", item.name.text});
        return false;
    }

    Scene& scene_;
    std::vector<Diagnostic>& found_;
};

}  // namespace

bool has_quantities(const Tree& tree) {
    if (tree.kind == Tree::Kind::name) return tree.text != "pi" && tree.text != "t";
    return !tree.unit.empty() || std::any_of(tree.args.begin(), tree.args.end(),
                                             [](const TreePtr& arg) { return has_quantities(*arg); });
}

void convert_units(Scene& scene, std::vector<Diagnostic>& found) {
    Converting(scene, found).convert();
}

bool is_in_si(const Scene& scene) {
    const auto are = [](const auto& items) {
        return std::all_of(items.begin(), items.end(), [](const auto& item) {
            const auto meaning = meaning_of_unit(item.unit);
            return !meaning || meaning->is_si();
        });
    };
    return are(scene.parameters) && are(scene.inputs) && are(scene.coordinates) && are(scene.speeds);
}

UnitOfName unit_of_name(const Scene& scene, const std::string& name) {
    const bool is_rate = name.ends_with('\'');
    const std::string stem = name.substr(0, name.find('\''));
    const auto in = [&](const auto& items) -> std::optional<UnitOfName> {
        for (const auto& item : items) {
            if (item.name.text != stem) continue;
            UnitOfName found{.unit = item.unit};
            if (!item.shown.unit.empty())
                found = {item.shown.unit, item.shown.size, meaning_of_unit(item.shown.unit)->exact};
            if (is_rate && !found.unit.empty()) found.unit += "/s";
            return found;
        }
        return {};
    };
    if (const auto found = in(scene.coordinates)) return *found;
    if (is_rate) return {};
    if (const auto found = in(scene.speeds)) return *found;
    if (const auto found = in(scene.parameters)) return *found;
    return {.unit = name == "t" ? "s" : ""};
}

std::string in_si(const Scene& scene, const std::string& name, const std::string& value) {
    const UnitOfName unit = unit_of_name(scene, name);
    if (unit.exact.empty()) return value;
    std::vector<Diagnostic> mistakes;
    const Expression typed = parse_expression(value, {}, mistakes);
    if (!typed || has_quantities(*typed.tree)) return value;
    return fmt::format("({})*({})", value, unit.exact);
}

}  // namespace alembert
