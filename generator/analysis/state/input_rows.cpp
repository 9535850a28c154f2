// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/input_rows.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "scene/lists.hpp"
#include "scene/text_file.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_rows = 500;

std::string trimmed(const std::string& text) {
    constexpr const char* blank = " \t\r";
    const std::size_t first = text.find_first_not_of(blank);
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// The field as a whole; nothing if it is no number.
std::optional<double> number_in(const std::string& field) {
    const char *begin = field.data(), *const end = begin + field.size();
    if (begin != end && *begin == '+') ++begin;
    double value = 0;
    const auto [last, error] = std::from_chars(begin, end, value);
    if (error == std::errc::result_out_of_range && last == end) return HUGE_VAL;
    if (error != std::errc{} || last != end || (begin != end && begin != field.data() && *begin == '-')) return {};
    return value;
}

/// Names of two columns, neither of which begins as a number does.
bool is_header(const std::vector<std::string>& fields) {
    if (fields.size() != 2) return false;
    for (const std::string& field : fields)
        if (field.empty() || std::string("+-.0123456789").find(field.front()) != std::string::npos) return false;
    return true;
}

}  // namespace

std::vector<InputRow> input_rows(const std::string& file) {
    std::vector<InputRow> rows;
    std::istringstream text(text_of_file(file));
    std::size_t count = 0;
    const auto refuse = [&](const std::string& found) {
        throw ModelError(say("{}, line {}: {}", file, count, found));
    };
    for (std::string line; std::getline(text, line);) {
        ++count;
        if (trimmed(line).empty()) continue;
        std::vector<std::string> fields = at_commas(line);
        for (std::string& field : fields) field = trimmed(field);
        if (count == 1 && is_header(fields)) continue;
        if (fields.size() != 2)
            refuse(say("found '{}'; expected a time and a value, with one comma between", trimmed(line)));
        std::vector<double> row;
        for (const std::string& field : fields) {
            const std::optional<double> value = number_in(field);
            if (!value || !std::isfinite(*value))
                refuse(say("found '{}'; expected a finite number such as -1.5e-3", field));
            row.push_back(*value);
        }
        if (!rows.empty() && !(row[0] > rows.back().first))
            refuse(say("found the time {:.10g} after {:.10g}; expected a later one", row[0], rows.back().first));
        rows.emplace_back(row[0], row[1]);
        if (rows.size() > most_rows)
            refuse(say("found more than {} rows; leave out those between which the input is nearly linear",
                       most_rows));
    }
    if (rows.empty()) throw ModelError(say("{}: there is no row; expected a time and a value in each line", file));
    return rows;
}

}  // namespace alembert
