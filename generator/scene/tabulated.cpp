// SPDX-License-Identifier: GPL-2.0-or-later
// [tables]: f = { arguments = ["x"], points = [[0, 0], [1, 2.5]] }, or file = "map.csv" in place of points.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/language/say.hpp"
#include "scene/plain_number.hpp"
#include "scene/point_table.hpp"
#include "scene/tables.hpp"
#include "scene/text.hpp"
#include "scene/text_file.hpp"

namespace alembert {

namespace {

namespace fs = std::filesystem;

/// One of the words that a key takes, by its position; the first one if the key is missing.
std::size_t word_of(const Table& keys, std::string_view key, std::initializer_list<std::string_view> words) {
    const std::string typed = keys.text(key);
    if (typed.empty()) return 0;
    const auto found = std::find(words.begin(), words.end(), typed);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    std::string known;
    for (const std::string_view word : words) known += (known.empty() ? "\"" : ", \"") + std::string(word) + "\"";
    const std::string meant = nearest(typed, {words.begin(), words.end()});
    keys.complain(key, say("{} is {}; expected one of {}{}", keys.what(key), in_quotes(typed), known,
                           meant.empty() ? "" : say("; did you mean '{}'?", meant)));
    return 0;
}

class TableOfPoints {
public:
    TableOfPoints(const Table& keys, Scene& scene, std::vector<Name> arguments)
        : keys_(keys), scene_(scene), arguments_(std::move(arguments)) {
        for (const Name& one : arguments_) wishes_.arguments.push_back(one.text);
    }

    void fill(UnspecifiedFunction& function) {
        using Interpolation = TabulatedFunction::Interpolation;
        using Outside = TabulatedFunction::Outside;
        const std::size_t before = keys_.reading().mistakes();
        constexpr Interpolation ways[] = {Interpolation::linear, Interpolation::cubic, Interpolation::pchip};
        constexpr Outside ends[] = {Outside::error, Outside::hold, Outside::line};
        wishes_.interpolation = ways[word_of(keys_, "interpolation", {"linear", "cubic", "pchip"})];
        wishes_.outside = ends[word_of(keys_, "outside", {"error", "hold", "line"})];
        if (wishes_.interpolation == Interpolation::pchip && arguments_.size() > 1)
            keys_.complain("interpolation",
                           say("'pchip' is for one argument; of two take \"linear\" or \"cubic\""));
        read_periods();
        read_units(function);
        function.about = keys_.text("about");
        PointRows rows = keys_.has("file") ? rows_of_file() : rows_of_points();
        if (keys_.reading().mistakes() > before) return;
        MadeTable made = table_of(std::move(rows), wishes_);
        if (made.table) {
            function.table = std::move(made.table);
            // Behind the text, by which an interrupted sweep knows its scene again.
            if (keys_.has("file"))
                scene_.text += fmt::format("\n# {}: {}", function.name.text, function.table->fingerprint());
            return;
        }
        const bool has_point = made.row < places_.size();
        keys_.reading().complain(
            has_point ? places_[made.row] : place_of_data(),
            keys_.has("file") ? fmt::format("{}: {}", keys_.text("file"), made.mistake) : made.mistake);
    }

private:
    Place place_of_data() const {
        const Entry* const entry = keys_.find(keys_.has("file") ? "file" : "points");
        return entry ? place_of(*entry->node) : keys_.place();
    }

    /// A number, in the unit of the argument, or an expression of numbers and pi; of two arguments a list.
    void read_periods() {
        const Entry* const entry = keys_.find("period");
        if (!entry) return;
        const toml::array* const list = entry->node->as_array();
        if (!list && arguments_.size() > 1)
            return keys_.complain("period", say("a table of two arguments has a period for each, as in period = "
                                                "[\"2*pi\", 0] with 0 for none"));
        if (list && list->size() != arguments_.size())
            return keys_.complain("period",
                                  say("there are {} periods for {} arguments", list->size(), arguments_.size()));
        for (std::size_t k = 0; k < arguments_.size(); ++k) {
            const toml::node& node = list ? *list->get(k) : *entry->node;
            const Expression typed = read_expression(keys_.reading(), node, keys_.what("period"));
            const std::optional<double> value = plain_number(typed, scene_);
            if (typed && (!value || !(*value >= 0) || !std::isfinite(*value)))
                keys_.reading().complain(place_of(node),
                                         say("expected a period, a number such as 360 or \"2*pi\" in "
                                             "the unit of the argument"));
            wishes_.periods.push_back(value.value_or(0));
            if (wishes_.periods.back() > 0 && keys_.has("outside") && arguments_.size() == 1)
                keys_.complain("outside", say("a table with a period has values everywhere; leave out 'outside'"));
        }
    }

    double size_of(const std::string& unit) const {
        const UnitReading reading = read_unit(unit, keys_.reading().names.units());
        return reading.meaning ? reading.meaning->factor : 1;
    }
    std::string si_of(const std::string& unit) const {
        const UnitReading reading = read_unit(unit, keys_.reading().names.units());
        return reading.meaning ? reading.meaning->si : std::string();
    }

    void read_units(UnspecifiedFunction& function) {
        const std::vector<Name> units = keys_.names("units");
        if (!units.empty() && units.size() != arguments_.size())
            keys_.complain("units", say("there are {} units for {} arguments", units.size(), arguments_.size()));
        for (const Name& unit : units) {
            if (!unit.text.empty() && !read_unit(unit.text, keys_.reading().names.units()).meaning)
                keys_.reading().complain(unit.place,
                                         say("{} is no unit, such as \"mm\" or \"deg\"", in_quotes(unit.text)));
            function.units.push_back(unit.text.empty() ? "" : si_of(unit.text));
            wishes_.sizes.push_back(unit.text.empty() ? 1 : size_of(unit.text));
        }
        wishes_.sizes.resize(arguments_.size(), 1);
        const std::string own = keys_.unit("unit", function.unit_place);
        function.unit = own.empty() ? "" : si_of(own);
        wishes_.sizes.push_back(own.empty() ? 1 : size_of(own));
    }

    PointRows rows_of_points() {
        PointRows rows;
        const Entry* const entry = keys_.find("points");
        if (!entry) return keys_.complain("points", say("{} needs 'points' or a 'file'", keys_.title())), rows;
        const toml::array* const list = entry->node->as_array();
        const std::size_t numbers = arguments_.size() + 1;
        const std::string form = numbers == 2 ? "[x, y]" : "[x, y, value]";
        if (!list) {
            keys_.complain("points", say("{} is {}; expected a list of points {}", keys_.what("points"),
                                         kind_of(*entry->node), form));
            return rows;
        }
        for (const toml::node& node : *list) {
            const toml::array* const point = node.as_array();
            PointRow row{.numbers = {}, .line = static_cast<int>(rows.rows.size()) + 1};
            for (std::size_t k = 0; point && k < point->size(); ++k)
                if (const auto value = point->get(k)->value<double>(); value && std::isfinite(*value))
                    row.numbers.push_back(*value);
            if (!point || point->size() != numbers || row.numbers.size() != numbers) {
                keys_.reading().complain(
                    place_of(node), say("point {} is no list of {} finite numbers, {}", row.line, numbers, form));
                return rows;
            }
            rows.rows.push_back(std::move(row));
            places_.push_back(place_of(node));
        }
        return rows;
    }

    /// In the folder of the scene or below.
    PointRows rows_of_file() {
        const std::optional<Name> name = keys_.name("file");
        if (!name) return {};
        if (keys_.has("points"))
            keys_.complain("file", say("{} has both 'points' and 'file'; give one", keys_.title()));
        const auto refuse = [&](std::string why) {
            keys_.reading().complain(name->place, std::move(why));
            return PointRows{};
        };
        std::error_code error;
        const fs::path folder = fs::path(scene_.file).parent_path();
        const fs::path root = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error),
                       whole = fs::weakly_canonical((folder.empty() ? fs::path(".") : folder) / name->text, error);
        const auto end = std::mismatch(root.begin(), root.end(), whole.begin(), whole.end()).first;
        if (error || fs::path(name->text).is_absolute() || end != root.end())
            return refuse(
                say("the file {} is not in the folder of the scene or below; expected a name such as "
                    "\"drag.csv\" or \"data/drag.csv\"",
                    in_quotes(name->text)));
        if (!fs::is_regular_file(whole, error)) return refuse(say("there is no file {}", in_quotes(name->text)));
        if (fs::file_size(whole, error) > most_point_bytes || error)
            return refuse(say("the file {} has more than {} bytes, the limit for a table", in_quotes(name->text),
                              most_point_bytes));
        return rows_in_text(text_of_file(whole.string(), most_point_bytes), arguments_.size());
    }

    const Table& keys_;
    Scene& scene_;
    std::vector<Name> arguments_;
    TableWishes wishes_;
    std::vector<Place> places_;  ///< of the points
};

}  // namespace

void read_point_tables(Table table, Scene& scene) {
    for (const Entry& entry : table.entries()) {
        const std::string what = labelled(say("table"), entry.key);
        const toml::table* const inner = entry.node->as_table();
        if (!inner) {
            table.reading().complain(entry.place,
                                     say("{0} is {1}; expected its arguments and its points: {2} = {{ "
                                         "arguments = [\"x\"], points = [[0, 0], [1, 2.5]] }}",
                                         what, kind_of(*entry.node), entry.key));
            continue;
        }
        const Table keys(table.reading(), *inner, what, entry.place);
        keys.allow("tables.*");
        std::vector<Name> arguments = keys.names("arguments");
        if (arguments.empty() || arguments.size() > 2)
            keys.complain("arguments",
                          say("{} has {} arguments; expected one or two names, as in arguments = [\"x\"]", what,
                              arguments.size()));
        UnspecifiedFunction function{.name = {entry.key, entry.place}, .arguments = arguments};
        if (!arguments.empty() && arguments.size() <= 2)
            TableOfPoints(keys, scene, std::move(arguments)).fill(function);
        scene.functions.push_back(std::move(function));
    }
}

}  // namespace alembert
