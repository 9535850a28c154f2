// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

#include "base/language/say.hpp"
#include "scene/advice.hpp"
#include "scene/check.hpp"
#include "scene/dimension_check.hpp"
#include "scene/file_names.hpp"
#include "scene/joints_file.hpp"
#include "scene/keys.hpp"
#include "scene/layout.hpp"
#include "scene/placing.hpp"
#include "scene/scene.hpp"
#include "scene/syntax.hpp"
#include "scene/tables.hpp"
#include "scene/text.hpp"
#include "scene/text_file.hpp"
#include "scene/typed_toml.hpp"
#include "scene/units.hpp"
#include "scene/warning_kinds.hpp"

namespace alembert {
namespace {

constexpr int most_syntax_mistakes = 10;

const std::vector<TableReader>& sections() {
    static const std::vector<TableReader> all = [] {
        std::vector<TableReader> result;
        for (const auto& some :
             {symbol_sections(), body_sections(), joint_sections(), load_sections(), run_sections()})
            result.insert(result.end(), some.begin(), some.end());
        return result;
    }();
    return all;
}

/// The place of a table's header; for a table written `x = { … }`, that of the key.
Place header_of(const Entry& entry) {
    const Place place = place_of(*entry.node);
    return place.line > 0 ? std::min(place, entry.place) : entry.place;
}

/// The table of the other form whose name is this one's in the plural or the singular: "force" for "forces".
std::string_view other_form(std::string_view name, TableKeys::Shape shape) {
    for (const TableKeys& one : table_keys)
        if (one.shape == shape && (one.table == std::string(name) + "s" || name == std::string(one.table) + "s"))
            return one.table;
    return {};
}

std::string list_given(std::string_view name) {
    const std::string_view list = other_form(name, TableKeys::Shape::list);
    return list.empty() ? say("there is one [{0}] in a scene, not a list; write [{0}]", name)
                        : say("there is one [{0}] in a scene, not a list; write [[{1}]] for each, or [{0}] for "
                              "values along coordinates",
                              name, list);
}

std::string table_given(std::string_view name) {
    const std::string_view one = other_form(name, TableKeys::Shape::one);
    return one.empty() ? say("there may be many of these in a scene; write [[{}]] for each", name)
                       : say("there may be many of these in a scene; write [[{}]] for each, or [{}] for values "
                             "along coordinates",
                             name, one);
}

void read_section(const Reading& reading, const TableReader& section, const Entry& entry, Scene& scene) {
    if (table_named(section.name).shape != TableKeys::Shape::list) {
        if (const toml::table* const table = entry.node->as_table())
            return section.read(Table(reading, *table, fmt::format("[{}]", section.name), header_of(entry)),
                                scene);
        return reading.complain(header_of(entry), entry.node->is_array_of_tables()
                                                      ? list_given(section.name)
                                                      : say("'{0}' is {1}; expected a table: [{0}]", section.name,
                                                            kind_of(*entry.node)));
    }
    const toml::array* const list = entry.node->as_array();
    if (!list) {
        return reading.complain(header_of(entry),
                                entry.node->is_table()
                                    ? table_given(section.name)
                                    : say("'{0}' is {1}; expected a list of tables: write [[{0}]] for each",
                                          section.name, kind_of(*entry.node)));
    }
    for (const toml::node& node : *list)
        if (const toml::table* const table = node.as_table())
            section.read(Table(reading, *table, fmt::format("[[{}]]", section.name), place_of(node)), scene);
        else
            reading.complain(place_of(node),
                             say("an element of '{0}' is {1}; expected a table: write [[{0}]] for each",
                                 section.name, kind_of(node)));
}

/// "; write [[body]]": what the word of another program is here.
std::string advice_on_table(const std::string& word) {
    const std::string_view meant = table_meant(word);
    if (meant.empty()) return {};
    if (meant == "gravity") return say("; gravity is a vector above the first table: gravity = [0, \"-g\"]");
    const TableKeys* const table = std::find_if(std::begin(table_keys), std::end(table_keys),
                                                [&](const TableKeys& one) { return one.table == meant; });
    if (table == std::end(table_keys)) return say("; write {} = \"…\"", meant);
    const bool is_list = table->shape == TableKeys::Shape::list;
    return is_list ? say("; write [[{}]] for each", meant) : say("; write [{}]", meant);
}

void refuse_unknown(const Reading& reading, const Entry& entry) {
    const std::span<const std::string_view> own = keys_of("");
    std::vector<std::string> known(own.begin(), own.end());
    for (const TableReader& section : sections()) known.emplace_back(section.name);
    known.emplace_back("scenery");
    const bool is_table = entry.node->is_table() || entry.node->is_array_of_tables();
    std::string advice = advice_on_table(entry.key);
    if (advice.empty())
        if (const std::string meant = nearest(entry.key, known); !meant.empty())
            advice = say("; did you mean '{}'?", meant);
    if (advice.empty() && !is_table)
        advice = say("; a key stands below the header of its table, such as [parameters]");
    reading.complain(header_of(entry),
                     say("unknown {} {}{}", is_table ? say("table") : say("key"), in_quotes(entry.key), advice));
}

void read_tables(const Reading& reading, const toml::table& root, Scene& scene) {
    const Table top(reading, root, say("the scene"), {1, 1});
    for (const Entry& entry : top.entries()) {
        const auto section = std::find_if(sections().begin(), sections().end(),
                                          [&](const TableReader& s) { return s.name == entry.key; });
        if (section != sections().end())
            read_section(reading, *section, entry, scene);
        else if (entry.key == "gravity")
            scene.gravity = top.vector("gravity");
        else if (entry.key != "scenery" && entry.key != "title" && entry.key != "source" && entry.key != "notes" &&
                 entry.key != "allow")
            refuse_unknown(reading, entry);
    }
    const Entry* const coordinates = top.find("coordinates");
    const bool is_other = coordinates && !coordinates->node->is_table();  // this has been reported already
    const bool has_polynomial = top.has("polynomial");
    if (has_polynomial && coordinates)
        reading.complain(
            header_of(*top.find("polynomial")),
            say("a scene has either [coordinates] or a [polynomial], which stands for a system without a "
                "mechanism; leave one out"));
    // Joints without coordinates weld bodies, and what they bear is asked for; states move without a mechanism.
    if (scene.coordinates.empty() && scene.joints.empty() && scene.states.empty() && !has_polynomial && !is_other)
        reading.complain(coordinates ? header_of(*coordinates) : Place{},
                         say("the scene has no [coordinates]; at least one is needed"));
    std::stable_sort(scene.coordinates.begin(), scene.coordinates.end(),
                     [](const Coordinate& a, const Coordinate& b) { return a.name.place < b.name.place; });
    scene.title = top.text("title");
    scene.source = top.text("source");
    scene.notes = top.text("notes");
    const std::vector<std::string> kinds(warning_kinds.begin(), warning_kinds.end());
    for (const Name& kind : top.names("allow")) {
        scene.allowed.push_back(kind.text);
        if (std::find(kinds.begin(), kinds.end(), kind.text) != kinds.end()) continue;
        const std::string meant = nearest(kind.text, kinds);
        reading.complain(kind.place, say("'allow' has the unknown kind of warning {}; {}", in_quotes(kind.text),
                                         meant.empty() ? say("there are {}", fmt::join(kinds, ", "))
                                                       : say("did you mean '{}'?", meant)));
    }
    if (!scene.simulation.start) scene.simulation.start = zero({});
}

/// Nothing if the file is not valid TOML. Its first mistakes are then reported; after each, the statement that has
/// it is removed and the rest is parsed again.
std::optional<toml::table> parse_toml(Layout layout, const SourceText& source, std::vector<Diagnostic>& mistakes) {
    bool is_valid = true;
    for (int k = 0; k < most_syntax_mistakes; ++k) try {
            toml::table root = toml::parse(layout.text);
            return is_valid ? std::optional(std::move(root)) : std::nullopt;
        } catch (const toml::parse_error& error) {
            is_valid = false;
            const toml::source_position at = error.source().begin;
            const Place place{static_cast<int>(at.line), static_cast<int>(at.column)};
            mistakes.push_back(syntax_mistake(error, layout, source));
            if (!drop_statement(layout, source.offset(place))) break;
        }
    return {};
}

/// Takes the warnings out of what was found.
std::vector<Diagnostic> warnings_of(std::vector<Diagnostic>& found) {
    const auto first = std::stable_partition(
        found.begin(), found.end(), [](const Diagnostic& one) { return one.severity == Severity::error; });
    std::vector<Diagnostic> warnings(first, found.end());
    found.erase(first, found.end());
    return warnings;
}

/// Numbers in SI units; what units contradict is warned of.
void take_units(Scene& scene, std::vector<Diagnostic>& mistakes) {
    std::vector<Diagnostic> found;
    convert_units(scene, found);
    for (Diagnostic& one : contradicting_dimensions(scene)) found.push_back(std::move(one));
    for (Diagnostic& one : found)
        (one.severity == Severity::error ? mistakes : scene.warnings).push_back(std::move(one));
}

/// The text in the form of a scene; `fill` reads its tables. Throws SceneError with all mistakes.
template <typename Fill>
Scene filled(std::string text, std::string file, const Fill& fill) {
    if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
    Scene scene;
    scene.file = std::move(file);
    scene.text = std::move(text);
    if (std::vector<Diagnostic> mistakes = check_bytes(scene.text); !mistakes.empty())
        fail(scene, std::move(mistakes));

    const std::string plain = with_plain_signs(scene.text);
    const SourceText source(plain);
    Layout layout = survey(source);
    std::vector<Diagnostic> mistakes = std::move(layout.mistakes);
    if (layout.is_too_deep) fail(scene, std::move(mistakes));
    const std::optional<toml::table> root = parse_toml(std::move(layout), source, mistakes);
    if (!root) fail(scene, std::move(mistakes));
    const KnownNames names = names_in(*root);
    fill(Reading{source, mistakes, root->contains("joint"), names}, *root, scene);
    if (!mistakes.empty()) fail(scene, std::move(mistakes));
    return scene;
}

}  // namespace

Scene parse_scene(std::string text, std::string file) {
    return filled(std::move(text), std::move(file),
                  [](const Reading& reading, const toml::table& root, Scene& scene) {
                      read_tables(reading, root, scene);
                      std::vector<Diagnostic> warnings = warnings_of(reading.diagnostics);
                      place_by_joints(scene, reading.diagnostics);
                      const Looks looks = read_looks(reading, root);
                      std::vector<Diagnostic> more = check_scene(scene, looks, warnings);
                      reading.diagnostics.insert(reading.diagnostics.end(), more.begin(), more.end());
                      scene.warnings = std::move(warnings);
                      if (reading.diagnostics.empty()) take_units(scene, reading.diagnostics);
                  });
}

Scene read_joints(const std::string& file) {
    return filled(text_of_file(file), file, [](const Reading& reading, const toml::table& root, Scene& scene) {
        const TableReader& joints = joint_sections().front();
        const Table top(reading, root, say("the file"), {1, 1});
        for (const Entry& entry : top.entries())
            if (entry.key == joints.name)
                read_section(reading, joints, entry, scene);
            else
                reading.complain(header_of(entry), say("{} has no place in a file of joints; expected [[joint]]",
                                                       in_quotes(entry.key)));
        for (const Joint& joint : scene.joints)
            if (!joint.coordinates.empty())
                reading.complain(joint.coordinates[0].place,
                                 say("joint {} closes a loop and has no coordinates", in_quotes(joint.name.text)));
    });
}

Looks looks_of(const Scene& scene) {
    Looks looks;
    const bool has_own = !scene.own_text.empty();
    filled(has_own ? scene.own_text : scene.text, has_own ? scene.own_file : scene.file,
           [&](const Reading& reading, const toml::table& root, Scene&) { looks = read_looks(reading, root); });
    return looks;
}

std::optional<double> value_of(const Expression& e) {
    const auto value = [](const auto& self, const Tree& tree) -> std::optional<double> {
        std::vector<double> args;
        for (const TreePtr& arg : tree.args) {
            const std::optional<double> part = self(self, *arg);
            if (!part) return std::nullopt;
            args.push_back(*part);
        }
        switch (tree.kind) {
            case Tree::Kind::number:
                return value_of_digits(tree.text);
            case Tree::Kind::name:
                return tree.text == "pi" ? std::optional(M_PI) : std::nullopt;
            case Tree::Kind::sum:
                return std::accumulate(args.begin(), args.end(), 0.);
            case Tree::Kind::product:
                return std::accumulate(args.begin(), args.end(), 1., std::multiplies<>());
            case Tree::Kind::negate:
                return -args[0];
            case Tree::Kind::reciprocal:
                return 1 / args[0];
            case Tree::Kind::power:
                return std::pow(args[0], args[1]);
            case Tree::Kind::call:
                return tree.text == "sqrt" ? std::optional(std::sqrt(args[0])) : std::nullopt;
            default:
                return std::nullopt;
        }
    };
    return e.tree ? value(value, *e.tree) : std::nullopt;
}

Scene read_scene(const std::string& file) {
    return parse_scene(text_of_file(file), file);
}

}  // namespace alembert
