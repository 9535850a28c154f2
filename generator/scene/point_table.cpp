// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/point_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {

std::vector<std::string> fields_in_line(std::string line, bool at_blanks) {
    constexpr std::string_view around = " \t\r\"";
    if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    line = line.substr(0, line.find('#'));
    while (!line.empty() && std::string_view(" \t\r").find(line.back()) != std::string_view::npos) line.pop_back();
    if (line.find_first_not_of(" \t") == std::string::npos) return {};
    const bool has_signs = line.find_first_of(",;") != std::string::npos;
    std::vector<std::string> fields(1);
    for (const char c : line) {
        const bool is_blank = c == ' ' || c == '\t';
        const bool divides = has_signs ? c == ',' || c == ';' : at_blanks && is_blank;
        if (!divides)
            fields.back() += c;
        else if (has_signs || !fields.back().empty())
            fields.emplace_back();
    }
    for (std::string& field : fields) {
        field.erase(0, std::min(field.find_first_not_of(around), field.size()));
        field.erase(field.find_last_not_of(around) + 1);
    }
    return fields;
}

namespace {

constexpr double closes_to = 1e-12;  // relative to a period or to the largest value

std::optional<double> number_in(const std::string& field) {
    if (field.empty()) return std::nullopt;
    std::istringstream stream(field);
    stream.imbue(std::locale::classic());
    double value = 0;
    stream >> value;
    if (!stream.eof() || stream.fail()) return std::nullopt;
    return value;
}

/// No number, nor a slip in one: 1x, -, nothing.
bool is_name_of_column(const std::string& field) {
    return !field.empty() && !number_in(field) &&
           std::string_view("0123456789+-.").find(field[0]) == std::string_view::npos;
}

PointRows refused(std::string mistake) {
    return {.rows = {}, .mistake = std::move(mistake), .are_lines = true};
}

/// Of a map, whose first line has the second argument.
bool begins_map(const std::vector<std::string>& fields, std::size_t arguments) {
    return arguments == 2 && fields.size() > 2 && !number_in(fields[0]) &&
           std::all_of(fields.begin() + 1, fields.end(),
                       [](const std::string& f) { return number_in(f).has_value(); });
}

class Reader {
public:
    Reader(const std::string& text, std::size_t arguments) : text_(text), arguments_(arguments) {}

    PointRows rows() {
        std::istringstream text(text_);
        int line = 0;
        bool is_first = true;
        for (std::string typed; std::getline(text, typed);) {
            ++line;
            const std::vector<std::string> fields = fields_in_line(typed, true);
            if (fields.empty()) continue;
            if (std::exchange(is_first, false)) {
                if (begins_map(fields, arguments_)) {
                    for (std::size_t k = 1; k < fields.size(); ++k) along_.push_back(*number_in(fields[k]));
                    continue;
                }
                if (fields.size() == arguments_ + 1 &&
                    std::all_of(fields.begin(), fields.end(), is_name_of_column))
                    continue;
            }
            if (const std::string mistake = take(fields, line, typed); !mistake.empty()) return refused(mistake);
            if (result_.rows.size() > most_table_points)
                return refused(say("there are more than {} points, the limit for a table", most_table_points));
        }
        result_.are_lines = true;
        return std::move(result_);
    }

private:
    std::string take(const std::vector<std::string>& fields, int line, const std::string& typed) {
        const std::size_t expected = along_.empty() ? arguments_ + 1 : along_.size() + 1;
        std::vector<double> numbers;
        for (const std::string& field : fields)
            if (const auto value = number_in(field)) numbers.push_back(*value);
        if (fields.size() != expected || numbers.size() != expected) {
            const bool has_decimal_commas =
                typed.find(';') != std::string::npos && typed.find(',') != std::string::npos;
            return say("line {} is {}; expected {} numbers with commas between, as the other lines have", line,
                       in_quotes(typed.substr(0, 60)), expected) +
                   (has_decimal_commas ? say("; the decimal sign is a point") : "");
        }
        if (const auto bad =
                std::find_if(numbers.begin(), numbers.end(), [](double x) { return !std::isfinite(x); });
            bad != numbers.end())
            return say("line {} has a value that is not finite", line);
        if (along_.empty())
            result_.rows.push_back({.numbers = std::move(numbers), .line = line});
        else
            for (std::size_t k = 0; k < along_.size(); ++k)
                result_.rows.push_back({.numbers = {numbers[0], along_[k], numbers[k + 1]}, .line = line});
        return {};
    }

    const std::string& text_;
    std::size_t arguments_;
    std::vector<double> along_;
    PointRows result_;
};

/// Where in messages: "line 5", "point 3".
std::string place_in(const PointRows& rows, std::size_t k) {
    return rows.are_lines ? say("line {}", rows.rows[k].line) : say("point {}", rows.rows[k].line);
}

class Making {
public:
    Making(PointRows rows, const TableWishes& wishes) : rows_(std::move(rows)), wishes_(wishes) {
        made_.mistake = rows_.mistake;
        points_.interpolation = wishes.interpolation;
        points_.outside = wishes.outside;
    }

    MadeTable make() {
        if (!made_.mistake.empty()) return made_;
        for (std::size_t k = 0; k < count(); ++k) points_.axes.push_back({.at = {}, .period = period(k)});
        if (count() == 1 ? !along_line() : !on_grid()) return made_;
        for (std::size_t k = 0; k < count(); ++k)
            if (points_.axes[k].at.size() < 2) {
                refuse(0, say("there is one value of {}; a table needs two points or more along it",
                              wishes_.arguments[k]));
                return made_;
            }
        for (std::size_t k = 0; k < count(); ++k)
            if (period(k) > 0 && !close(k)) return made_;
        for (std::size_t k = 0; k < count(); ++k) {
            for (double& x : points_.axes[k].at) x *= size(k);
            points_.axes[k].period *= size(k);
        }
        for (double& y : points_.values) y *= size(count());
        made_.table = std::make_shared<const TabulatedFunction>(std::move(points_));
        const std::vector<double>& c = made_.table->coefficients();
        if (!std::all_of(c.begin(), c.end(), [](double x) { return std::isfinite(x); })) {
            made_.table = nullptr;
            refuse(0,
                   say("slopes between the points are too large for double precision; give values or distances of "
                       "a usual size"));
        }
        return made_;
    }

private:
    std::size_t count() const { return wishes_.arguments.size(); }
    double period(std::size_t k) const { return k < wishes_.periods.size() ? wishes_.periods[k] : 0; }
    double size(std::size_t k) const { return k < wishes_.sizes.size() ? wishes_.sizes[k] : 1; }

    bool refuse(std::size_t row, std::string mistake) {
        made_.mistake = std::move(mistake);
        made_.row = row;
        return false;
    }

    bool along_line() {
        if (rows_.rows.size() < 2)
            return refuse(0, say("there are fewer than two points; a table needs two or more"));
        for (std::size_t k = 0; k < rows_.rows.size(); ++k) {
            const double x = rows_.rows[k].numbers[0];
            std::vector<double>& at = points_.axes[0].at;
            if (!at.empty() && !(x > at.back()))
                return refuse(k, say("{}: {} is {} after {}; expected growing values", place_in(rows_, k),
                                     wishes_.arguments[0], x, at.back()));
            at.push_back(x);
            points_.values.push_back(rows_.rows[k].numbers[1]);
        }
        return true;
    }

    bool on_grid() {
        std::map<std::pair<double, double>, std::size_t> known;
        for (std::size_t k = 0; k < rows_.rows.size(); ++k) {
            const std::vector<double>& n = rows_.rows[k].numbers;
            if (!known.try_emplace({n[0], n[1]}, k).second)
                return refuse(k, say("{}: there is a value for {} = {}, {} = {} already", place_in(rows_, k),
                                     wishes_.arguments[0], n[0], wishes_.arguments[1], n[1]));
            points_.axes[0].at.push_back(n[0]);
            points_.axes[1].at.push_back(n[1]);
        }
        for (TableAxis& axis : points_.axes) {
            std::sort(axis.at.begin(), axis.at.end());
            axis.at.erase(std::unique(axis.at.begin(), axis.at.end()), axis.at.end());
        }
        for (const double x : points_.axes[0].at)
            for (const double y : points_.axes[1].at) {
                const auto found = known.find({x, y});
                if (found == known.end())
                    return refuse(0,
                                  say("there is no value for {} = {}, {} = {}; expected one at each crossing of "
                                      "the grid",
                                      wishes_.arguments[0], x, wishes_.arguments[1], y));
                points_.values.push_back(rows_.rows[found->second].numbers.back());
            }
        return true;
    }

    /// The last point is the first one, a period later; it is added where it is missing.
    bool close(std::size_t k) {
        TableAxis& axis = points_.axes[k];
        const double end = axis.at.front() + axis.period, far = closes_to * axis.period;
        if (axis.at.back() > end + far)
            return refuse(rows_.rows.size() - 1,
                          say("the points extend over {} along {}, more than its period {}",
                              axis.at.back() - axis.at.front(), wishes_.arguments[k], axis.period));
        std::size_t columns = 1, rows = 1;
        for (std::size_t j = k + 1; j < count(); ++j) columns *= points_.axes[j].at.size();
        for (std::size_t j = 0; j < k; ++j) rows *= points_.axes[j].at.size();
        const std::size_t length = axis.at.size();
        const bool is_closed = axis.at.back() >= end - far;
        std::vector<double> values;
        double largest = 0;
        for (const double y : points_.values) largest = std::max(largest, std::abs(y));
        for (std::size_t r = 0; r < rows; ++r) {
            const auto at = [&](std::size_t i, std::size_t c) {
                return points_.values[(r * length + i) * columns + c];
            };
            for (std::size_t i = 0; i < length - (is_closed ? 1 : 0); ++i)
                for (std::size_t c = 0; c < columns; ++c) values.push_back(at(i, c));
            for (std::size_t c = 0; c < columns; ++c) {
                if (is_closed && std::abs(at(length - 1, c) - at(0, c)) > closes_to * largest)
                    return refuse(
                        rows_.rows.size() - 1,
                        say("the value a period after the first point is {}, and that of the first point is "
                            "{}; expected the same",
                            at(length - 1, c), at(0, c)));
                values.push_back(at(0, c));
            }
        }
        if (is_closed)
            axis.at.back() = end;
        else
            axis.at.push_back(end);
        points_.values = std::move(values);
        return true;
    }

    PointRows rows_;
    const TableWishes& wishes_;
    TabulatedFunction::Points points_;
    MadeTable made_;
};

}  // namespace

PointRows rows_in_text(const std::string& text, std::size_t arguments) {
    return Reader(text, arguments).rows();
}

MadeTable table_of(PointRows rows, const TableWishes& wishes) {
    return Making(std::move(rows), wishes).make();
}

}  // namespace alembert
