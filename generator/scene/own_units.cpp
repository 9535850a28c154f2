// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/own_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/language/say.hpp"
#include "scene/scene.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr const char* expected_definition = to_say(
    "expected a number and a unit, as in furlong = \"201.168 m\", or \"base\" for a unit that is no multiple of "
    "others");

class DefiningUnits {
public:
    DefiningUnits(const std::vector<UnitDefinition>& definitions, const UnitComplaint& complain)
        : definitions_(definitions), complain_(complain) {}

    OwnUnits all() {
        std::vector<std::size_t> rest;
        for (std::size_t k = 0; k < definitions_.size(); ++k)
            if (is_free(k)) rest.push_back(k);
        for (std::size_t before = rest.size() + 1; before != rest.size() && !rest.empty();) {
            before = rest.size();
            std::erase_if(rest, [&](std::size_t k) { return define(k); });
        }
        for (const std::size_t k : rest) refuse_unknown(k);
        return std::move(known_);
    }

private:
    bool is_free(std::size_t k) const {
        const std::string& name = definitions_[k].name;
        if (!is_name(name)) return complain_(k, 0, say("{} is no word for a unit", in_quotes(name))), false;
        const UnitWord known = unit_word(name);
        if (!known.meaning || !known.meant.empty()) return true;
        complain_(k, 0, say("{} is a unit already; take another word", in_quotes(name)));
        return false;
    }

    /// Whether nothing more is to be done with it: it is defined, or its mistake is told.
    bool define(std::size_t k) {
        const auto& [name, value] = definitions_[k];
        if (value == "base") return known_.insert_or_assign(name, UnitMeaning{{{name, 1}}, 1, "", name}), true;
        const std::size_t begin = std::min(value.find_first_not_of(' '), value.size());
        double number = 1;
        const char* const first = value.data() + begin;
        const auto read = std::from_chars(first, value.data() + value.size(), number);
        const bool has_number = read.ec == std::errc{} && read.ptr != first && std::isfinite(number);
        const char* number_end = read.ptr;
        if (double below = 1;
            has_number && read.ptr != value.data() + value.size() && *read.ptr == '/') {  // 1/3 m
            const auto rest = std::from_chars(read.ptr + 1, value.data() + value.size(), below);
            if (rest.ec == std::errc{} && below > 0 && std::isfinite(number / below))
                number /= below, number_end = rest.ptr;
        }
        std::size_t unit_begin = has_number ? static_cast<std::size_t>(number_end - value.data()) : begin;
        unit_begin = std::min(value.find_first_not_of(" *", unit_begin), value.size());
        if (read.ec == std::errc::result_out_of_range || (has_number && number <= 0) || unit_begin == value.size())
            return complain_(k, begin, translated(expected_definition)), true;
        const UnitReading unit = read_unit(value.substr(unit_begin), known_);
        if (!unit.meaning)
            return complain_(k, unit_begin + static_cast<std::size_t>(unit.offset), unit.mistake), true;
        if (!unit.doubts.empty() && unit.doubts.front().mass.empty()) return false;
        UnitMeaning meaning = *unit.meaning;
        meaning.factor *= number;
        const std::string typed = has_number ? std::string(first, number_end) : "1";
        meaning.exact = meaning.exact.empty() ? typed : fmt::format("{}*({})", typed, meaning.exact);
        if (!(meaning.factor > 1e-250 && meaning.factor < 1e250))
            return complain_(k, begin, say("this unit is beyond the range of double precision")), true;
        known_.insert_or_assign(name, std::move(meaning));
        return true;
    }

    void refuse_unknown(std::size_t k) {
        const std::string& value = definitions_[k].value;
        const std::size_t begin = value.find_first_not_of(" +-.0123456789eE*");
        const std::size_t from = begin == std::string::npos ? 0 : begin;
        const UnitReading unit = read_unit(value.substr(from), known_);
        const UnitDoubt doubt = unit.doubts.empty() ? UnitDoubt{} : unit.doubts.front();
        const std::string near = doubt.meant.empty() ? nearest_unit(doubt.word) : doubt.meant;
        const std::string meant = near.empty() ? "" : say("; did you mean {}?", near);
        complain_(k, from,
                  say("the unit '{}' is not known, or refers to itself{}", escaped(doubt.word), meant) + "; " +
                      translated(expected_definition));
    }

    const std::vector<UnitDefinition>& definitions_;
    const UnitComplaint& complain_;
    OwnUnits known_;
};

}  // namespace

OwnUnits own_units(const std::vector<UnitDefinition>& definitions, const UnitComplaint& complain) {
    return DefiningUnits(definitions, complain).all();
}

}  // namespace alembert
