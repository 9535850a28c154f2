// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/unit_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <utility>

namespace alembert {

namespace {

const double degree = std::acos(-1.0) / 180;

class UnitText {
public:
    explicit UnitText(const std::string& text) : text_(text) {}

    std::optional<UnitMeaning> meaning() {
        UnitMeaning result = product();
        return bad_ || at_ < text_.size() ? std::nullopt : std::optional(std::move(result));
    }

private:
    bool take(char c) {
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    UnitMeaning product() {
        UnitMeaning result;
        bool divides = false;
        while (at_ < text_.size() && text_[at_] != ')' && !bad_) {
            if (take(' ') || take('*') || take('.')) continue;
            if (take('/')) {
                divides = true;
                continue;
            }
            const bool in_brackets = take('(');
            const UnitMeaning factor = in_brackets ? product() : word();
            bad_ = bad_ || (in_brackets && !take(')'));
            const double power = (divides ? -1 : 1) * exponent();
            result.exponents = multiplied(std::move(result.exponents), factor.exponents, power);
            result.factor *= std::pow(factor.factor, power);
            divides = false;
        }
        return result;
    }

    double exponent() {
        if (!take('^')) return 1;
        const bool minus = take('-');
        int value = 0;
        const std::size_t start = at_;
        while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0)
            value = std::min(1000, 10 * value + (text_[at_++] - '0'));
        bad_ = bad_ || at_ == start || value > 99;
        return minus ? -value : value;
    }

    UnitMeaning word() {
        static const std::map<std::string, UnitMeaning> derived{
            {"1", {}},
            {"deg", {{{"rad", 1}}, degree}},
            {"N", {{{"kg", 1}, {"m", 1}, {"s", -2}}}},
            {"J", {{{"kg", 1}, {"m", 2}, {"s", -2}}}},
            {"W", {{{"kg", 1}, {"m", 2}, {"s", -3}}}},
            {"Pa", {{{"kg", 1}, {"m", -1}, {"s", -2}}}},
            {"Hz", {{{"s", -1}}}},
            {"C", {{{"A", 1}, {"s", 1}}}},
            {"V", {{{"kg", 1}, {"m", 2}, {"s", -3}, {"A", -1}}}},
            {"T", {{{"kg", 1}, {"s", -2}, {"A", -1}}}},
        };
        const std::size_t start = at_;
        while (at_ < text_.size() && std::string(" *./^()").find(text_[at_]) == std::string::npos) ++at_;
        const std::string name = text_.substr(start, at_ - start);
        bad_ = bad_ || name.empty();
        const auto found = derived.find(name);
        return found != derived.end() ? found->second : UnitMeaning{{{name, 1}}};
    }

    const std::string& text_;
    std::size_t at_ = 0;
    bool bad_ = false;
};

}  // namespace

UnitExponents multiplied(UnitExponents a, const UnitExponents& b, double exponent) {
    for (const auto& [base, power] : b)
        if ((a[base] += exponent * power) == 0) a.erase(base);
    return a;
}

bool UnitMeaning::is_si() const {
    static const std::set<std::string> bases{"kg", "m", "s", "A", "K", "mol", "cd", "rad"};
    return std::all_of(exponents.begin(), exponents.end(),
                       [](const auto& entry) { return bases.contains(entry.first); });
}

std::optional<UnitMeaning> meaning_of_unit(const std::string& text) {
    return UnitText(text).meaning();
}

}  // namespace alembert
