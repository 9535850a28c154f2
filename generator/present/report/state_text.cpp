// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/state_text.hpp"

#include <cln/integer_io.h>
#include <cln/rational.h>
#include <cln/rational_io.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>
#include <string_view>

namespace alembert {

namespace {

bool is_number(std::string_view value) {
    return !value.empty() && value.find_first_not_of("-+0123456789/.e") == std::string_view::npos;
}

bool is_fraction(const std::string& value) {
    return value.find_first_of(".e") == std::string::npos;
}

double number_of(const std::string& value) {
    return is_fraction(value) ? cln::double_approx(cln::cl_RA(value.c_str())) : std::stod(value);
}

/// "1.234e+812" of a number beyond the range of double precision.
std::string four_digits_of_large(const std::string& value) {
    const cln::cl_RA number = value.c_str();
    std::ostringstream written;
    written << cln::round1(cln::abs(number));
    const std::string digits = written.str();
    return fmt::format("{}{}.{}e+{}", cln::minusp(number) ? "-" : "", digits[0], digits.substr(1, 3),
                       digits.size() - 1);
}

/// "1.05" of 21/20.
WrittenNumber four_digits(const std::string& value) {
    const bool is_whole = value.find_first_of("./e") == std::string::npos;
    const std::size_t short_enough = is_whole ? 12 : 7;
    if (value.size() <= short_enough && value.find('/') == std::string::npos) return {value};
    const double number = number_of(value);
    if (!std::isfinite(number) && is_fraction(value)) return {four_digits_of_large(value), false};
    const std::string text = fmt::format("{:.4g}", number);
    if (!is_fraction(value) || !is_fraction(text.substr(text.find('.') + 1))) return {text, false};
    const std::size_t point = text.find('.');
    const std::size_t decimals = point == std::string::npos ? 0 : text.size() - point - 1;
    std::string digits = text;
    if (point != std::string::npos) digits.erase(point, 1);
    const cln::cl_I whole = digits.c_str();
    return {text, cln::cl_RA(value.c_str()) == whole / cln::expt(cln::cl_RA(10), static_cast<long>(decimals))};
}

/// "2*pi/3" of a float that is such a multiple to all its digits; empty if it is none.
std::string multiple_of_pi(const std::string& value) {
    if (is_fraction(value)) return "";
    constexpr int parts = 12;  // of a half turn
    const double ratio = number_of(value) * parts / std::numbers::pi;
    if (std::abs(ratio) > 100 * parts || std::abs(ratio - std::round(ratio)) > 1e-14 * std::abs(ratio)) return "";
    const int count = static_cast<int>(std::lround(ratio)), shared = std::gcd(count, parts);
    if (count == 0) return "";
    const int above = count / shared, below = parts / shared;
    const std::string times = above == 1 ? "" : above == -1 ? "-" : fmt::format("{}*", above);
    return fmt::format("{}pi{}", times, below == 1 ? "" : fmt::format("/{}", below));
}

}  // namespace

WrittenNumber written_number(const std::string& name, const std::string& value) {
    constexpr std::string_view angle = "2*atan(";
    if (is_number(value)) {
        const std::string turns = multiple_of_pi(value);
        return turns.empty() ? four_digits(value) : WrittenNumber{turns};
    }
    if (!value.starts_with(angle) || !value.ends_with(')')) return {value};
    const std::string tangent = value.substr(angle.size(), value.size() - angle.size() - 1);
    if (!is_number(tangent)) return {value};
    const double half = std::atan(number_of(tangent));
    if (name == "t") return {fmt::format("{:.4g}", 2 * half), false};
    const double degrees = half * 360 / std::numbers::pi;
    return {fmt::format("{:.4g}°", degrees), tangent == "1" || tangent == "-1"};
}

std::string as_written(const std::string& name, const std::string& value) {
    const WrittenNumber number = written_number(name, value);
    return fmt::format("{} {} {}", name, number.is_exact ? "=" : "≈", number.text);
}

std::string text_of_state(const std::vector<std::pair<std::string, std::string>>& values) {
    std::string text;
    for (const auto& [name, value] : values) text += (text.empty() ? "" : ", ") + as_written(name, value);
    return text;
}

std::string text_of_state(std::vector<std::pair<std::string, std::string>> values, const std::string& claim) {
    const auto is_shown = [&](const std::string& name) {
        return std::any_of(values.begin(), values.end(), [&](const auto& one) { return one.first == name; });
    };
    const auto is_claimed = [&](const std::string& name) {
        const auto is_of_name = [&](std::size_t at) {
            return at < claim.size() && (std::isalnum(static_cast<unsigned char>(claim[at])) != 0 ||
                                         claim[at] == '_' || claim[at] == '\'');
        };
        for (std::size_t at = claim.find(name); at != std::string::npos; at = claim.find(name, at + 1))
            if ((at == 0 || !is_of_name(at - 1)) && !is_of_name(at + name.size())) return true;
        return false;
    };
    bool in_speeds = false;
    std::vector<std::string> motions;  // rates and accelerations of coordinates
    for (const auto& [name, value] : values) {
        const bool is_coordinate = is_shown(name + "''");
        if (is_coordinate) motions.insert(motions.end(), {name + "'", name + "''"});
        if (!is_coordinate && !name.ends_with("'") && is_shown(name + "'"))
            in_speeds = in_speeds || is_claimed(name) || is_claimed(name + "'");
    }
    if (in_speeds && std::none_of(motions.begin(), motions.end(), is_claimed))
        std::erase_if(values, [&](const auto& one) {
            return std::find(motions.begin(), motions.end(), one.first) != motions.end();
        });
    return text_of_state(values);
}

}  // namespace alembert
