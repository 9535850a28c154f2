// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/typed.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "scene/text.hpp"

namespace alembert {

namespace {

const std::map<char32_t, std::string_view> meanings{
    {U'·', "*"},      {U'×', "*"},     {U'⋅', "*"},      {U'∗', "*"},       {U'∙', "*"},      {U'•', "*"},
    {U'−', "-"},      {U'–', "-"},     {U'—', "-"},      {U'‐', "-"},       {U'‑', "-"},      {U'÷', "/"},
    {U'∕', "/"},      {U'⁄', "/"},     {U'′', "'"},      {U'’', "'"},       {U'‘', "'"},      {U'´', "'"},
    {U'`', "'"},      {U'″', "''"},    {U'⁻', "^-"},     {U'½', "(1/2)"},   {U'⅓', "(1/3)"},  {U'¼', "(1/4)"},
    {U'¾', "(3/4)"},  {U'⅔', "(2/3)"}, {U'\u0307', "'"}, {U'\u0308', "''"}, {U'\u00A0', " "}, {U'\u2009', " "},
    {U'\u202F', " "}, {U'\u3000', " "}};

constexpr char32_t raised[] = {U'⁰', U'¹', U'²', U'³', U'⁴', U'⁵', U'⁶', U'⁷', U'⁸', U'⁹'};

/// The full-width form of a character of ASCII as that character.
std::optional<std::string> narrow(char32_t c) {
    if (c < U'！' || c > U'～') return {};
    return std::string(1, static_cast<char>(c - 0xFEE0));
}

class Writing {
public:
    Writing(std::string& text, std::vector<Place>& places) : text_(text), places_(places) {}

    void write() {
        if (std::all_of(text_.begin(), text_.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }) &&
            text_.find("**") == std::string::npos)
            return;
        while (at_ < text_.size()) next();
        if (!places_.empty()) new_places_.push_back(places_[std::min(at_, places_.size() - 1)]);
        text_ = std::move(plain_);
        places_ = std::move(new_places_);
    }

private:
    void put(std::string_view words, std::size_t from) {
        plain_ += words;
        if (!places_.empty())
            new_places_.insert(new_places_.end(), words.size(), places_[std::min(from, places_.size() - 1)]);
    }

    void next() {
        const std::size_t begin = at_;
        if (text_.compare(at_, 2, "**") == 0) {
            at_ += 2;
            return put("^", begin);
        }
        const char32_t c = decode(text_, at_);
        if (const auto digit = std::find(std::begin(raised), std::end(raised), c); digit != std::end(raised)) {
            if (!is_raised_ && !plain_.ends_with("^-")) put("^", begin);
            is_raised_ = true;
            return put(std::string(1, static_cast<char>('0' + (digit - std::begin(raised)))), begin);
        }
        is_raised_ = false;
        if (c >= U'₀' && c <= U'₉') return put(std::string(1, static_cast<char>('0' + (c - U'₀'))), begin);
        if (c == U'√' && is_call()) return put("sqrt", begin);
        if (const auto known = meanings.find(c); known != meanings.end()) return put(known->second, begin);
        if (const auto ascii = narrow(c)) return put(*ascii, begin);
        for (std::size_t k = begin; k < at_; ++k) put(std::string_view(text_).substr(k, 1), k);
    }

    /// Whether a parenthesis follows.
    bool is_call() const {
        std::size_t at = text_.find_first_not_of(' ', at_);
        return at != std::string::npos && (text_[at] == '(' || text_.compare(at, 3, "（") == 0);
    }

    std::string& text_;
    std::vector<Place>& places_;
    std::string plain_;
    std::vector<Place> new_places_;
    std::size_t at_ = 0;
    bool is_raised_ = false;
};

}  // namespace

void write_plainly(std::string& text, std::vector<Place>& places) {
    Writing(text, places).write();
}

std::string plain_name(const std::string& name) {
    std::string plain = name;
    std::vector<Place> none;
    write_plainly(plain, none);
    return is_name(plain) ? plain : name;
}

}  // namespace alembert
