// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "scene/concluded_dimensions.hpp"
#include "scene/dimensions.hpp"
#include "scene/known_names.hpp"
#include "scene/text.hpp"
#include "scene/typed.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

namespace {

/// (text)*(factor)
Expression times(const Expression& e, const std::string& factor, const KnownNames& names,
                 std::vector<Diagnostic>& found) {
    std::vector<Place> places;
    if (!e.places.empty()) {
        places.assign(1, e.places.front());
        places.insert(places.end(), e.places.begin(), e.places.end());
        places.insert(places.end(), factor.size() + 4, e.places.back());
    }
    return parse_expression(fmt::format("({})*({})", e.text, factor), std::move(places), found, &names);
}

class Converting {
public:
    Converting(Scene& scene, std::vector<Diagnostic>& found) : scene_(scene), names_(scene), found_(found) {}

    void convert() {
        for (Parameter& p : scene_.parameters) convert(p, {&p.value});
        for (Input& f : scene_.inputs) convert(f, {&f.value});
        for (Coordinate& q : scene_.coordinates) convert(q, {&q.initial, &q.rate});
        for (Speed& u : scene_.speeds) convert(u, {&u.initial});
        for (FirstOrderState& z : scene_.states) convert(z, {&z.initial});
    }

private:
    template <typename Item>
    void convert(Item& item, const std::vector<Expression*>& values) {
        if (item.unit.empty()) return;
        std::string plain = item.unit;
        std::vector<Place> none;
        write_plainly(plain, none);
        const UnitReading unit = read_unit(plain, scene_.units);
        for (const UnitDoubt& doubt : unit.doubts) tell(doubt, item);
        const std::optional<UnitMeaning>& meaning = unit.meaning;
        if (!meaning || meaning->exact.empty()) return;
        item.shown = {item.unit, meaning->factor, meaning->exact, values[0]->text};
        for (Expression* value : values)
            if (*value && is_in_unit(*value, *meaning, item))
                *value = times(*value, meaning->exact, names_, found_);
        item.unit = meaning->si;
    }

    /// Each word once.
    template <typename Item>
    void tell(const UnitDoubt& doubt, const Item& item) {
        if (!told_.insert(doubt.word).second) return;
        if (!doubt.mass.empty()) {
            found_.push_back(
                {item.unit_place, advice_on_mass(doubt), Severity::warning, "unknown_unit", item.name.text});
            return;
        }
        const std::string word = escaped(doubt.word);
        const std::string near = doubt.meant.empty() ? nearest_unit(doubt.word) : doubt.meant;
        const std::string meant = near.empty() ? "" : say("; did you mean {}?", near);
        found_.push_back(
            {item.unit_place,
             doubt.is_known
                 ? say("'{}' in the unit of {} is read with the prefix of the SI that it begins with{}", word,
                       in_quotes(item.name.text), meant)
                 : say("the unit '{0}' of {1} is not known, and numbers in it stay as they are{2}; if it is a "
                       "unit "
                       "of your own, write in a table [units] what it is worth, as in {0} = \"2.5 m\", or "
                       "{0} = \"base\" where it is no multiple of others",
                       word, in_quotes(item.name.text), meant),
             Severity::warning, "unknown_unit", item.name.text});
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
    const KnownNames names_;
    std::vector<Diagnostic>& found_;
    std::set<std::string> told_;
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
    return are(scene.parameters) && are(scene.inputs) && are(scene.coordinates) && are(scene.speeds) &&
           are(scene.states);
}

UnitOfName unit_of_name(const Scene& scene, const std::string& name) {
    const bool is_rate = name.ends_with('\'');
    const std::string stem = name.substr(0, name.find('\''));
    const auto in = [&](const auto& items) -> std::optional<UnitOfName> {
        for (const auto& item : items) {
            if (item.name.text != stem) continue;
            UnitOfName found{.unit = item.unit};
            if (!item.shown.unit.empty()) found = {item.shown.unit, item.shown.size, item.shown.exact};
            if (is_rate) found.unit = per_second(found.unit);
            return found;
        }
        return {};
    };
    if (const auto found = in(scene.coordinates)) return *found;
    if (const auto found = in(scene.states)) return *found;
    if (is_rate) return {};
    if (const auto found = in(scene.speeds)) return *found;
    if (const auto found = in(scene.parameters)) return *found;
    if (const auto found = in(scene.inputs)) return *found;
    return {.unit = name == "t" ? "s" : ""};
}

namespace {

/// Each quantity in an expression, "3 ft", as the number times the factor of its unit.
std::string without_units(const Expression& e, const OwnUnits& own) {
    std::vector<const Tree*> quantities;
    const auto collect = [&](const auto& self, const Tree& tree) -> void {
        if (!tree.unit.empty()) return quantities.push_back(&tree);
        for (const TreePtr& arg : tree.args) self(self, *arg);
    };
    collect(collect, *e.tree);
    std::string result;
    std::size_t from = 0;
    for (const Tree* const quantity : quantities) {
        const std::size_t begin = static_cast<std::size_t>(quantity->offset);
        const std::size_t end = begin + static_cast<std::size_t>(quantity->length);
        const std::string& number = quantity->args[0]->text;
        const std::string text = e.text.substr(begin + number.size(), end - begin - number.size());
        const std::string exact = read_unit(text, own).meaning.value_or(UnitMeaning{}).exact;
        result +=
            e.text.substr(from, begin - from) + (exact.empty() ? number : fmt::format("({}*({}))", number, exact));
        from = end;
    }
    return result + e.text.substr(from);
}

std::string unit_in_si(const Scene& scene, const std::string& name) {
    std::string unit = name == "t" ? "s" : "";
    const auto look = [&](const auto& items) {
        for (const auto& item : items)
            if (item.name.text == name) unit = item.unit;
    };
    look(scene.parameters), look(scene.inputs), look(scene.coordinates), look(scene.speeds);
    look(scene.states);
    return unit;
}

/// An angle has the dimension of a number.
std::string shown(Dimension dimension, const std::string& unit) {
    if (unit == "rad") dimension[unit] = 1;
    return dimension.empty() ? say("1 (a number or an angle)") : text_of(dimension);
}

/// Throws where the units in a value make another dimension than the name has.
void refuse_other_unit(const Scene& scene, const std::string& name, const Expression& value) {
    Dimensions dimensions(scene, Dimensions::Numbers::pure);
    const std::optional<Dimension> made = dimensions.of(value);
    const std::string stem = name.substr(0, name.find('\''));
    const std::string unit = unit_in_si(scene, stem);
    std::optional<Dimension> own = dimension_of_unit(unit);
    if (made && !own)
        for (const ConcludedDimension& one : concluded_dimensions(scene))
            if (one.name == stem) own = one.dimension;
    if (!made || !own) return;
    own = over_time(*std::move(own), static_cast<int>(name.size() - stem.size()));
    if (*made == *own) return;
    throw ModelError(say("{} is in {}, and its value {} is in {}", in_quotes(name), shown(*own, unit),
                         in_quotes(value.text), shown(*made, "")));
}

}  // namespace

std::string in_si(const Scene& scene, const std::string& name, const std::string& value) {
    const UnitOfName unit = unit_of_name(scene, name);
    std::vector<Diagnostic> mistakes;
    KnownNames names;
    names.set_units(scene.units);
    const Expression typed = parse_expression(value, {}, mistakes, &names);
    if (!typed) return value;
    if (has_quantities(*typed.tree)) {
        refuse_other_unit(scene, name, typed);
        return scene.units.empty() ? value : without_units(typed, scene.units);
    }
    return unit.exact.empty() ? value : fmt::format("({})*({})", value, unit.exact);
}

}  // namespace alembert
