// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/letters.hpp"

#include <cctype>

#include "algebra/notation/lettering.hpp"

namespace alembert {

std::string letters_of(const std::string& expression,
                       const std::function<std::string(const std::string& index, bool is_last)>& index) {
    std::string result;
    const auto is_letter = [&](std::size_t k) {
        const auto c = static_cast<unsigned char>(expression[k]);
        return std::isalnum(c) != 0 || c == '_' || c >= 0x80;
    };
    for (std::size_t i = 0; i < expression.size();) {
        const auto c = static_cast<unsigned char>(expression[i]);
        if (is_letter(i) && std::isdigit(c) == 0) {
            std::size_t end = i;
            while (end < expression.size() && is_letter(end)) ++end;
            const Lettering letters = lettering(expression.substr(i, end - i));
            result += xml_escaped(letters.stem);
            for (; end < expression.size() && expression[end] == '\''; ++end) result += "′";
            if (!letters.index.empty()) result += index(xml_escaped(letters.index), end == expression.size());
            i = end;
        } else {
            result += c == '*' ? std::string("\u2009") : xml_escaped(std::string(1, expression[i]));
            ++i;
        }
    }
    return result;
}

}  // namespace alembert
