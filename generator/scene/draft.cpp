// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/draft.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace alembert {

namespace {

/// A string of TOML; what is no printable character is escaped.
std::string in_toml(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            result += fmt::format("\\{}", c);
        else if (code < 0x20 || code == 0x7F)
            result += fmt::format("\\u{:04X}", code);
        else
            result += c;
    }
    return result + "\"";
}

std::string key_in_toml(const std::string& key) {
    const auto is_bare = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    return !key.empty() && std::all_of(key.begin(), key.end(), is_bare) ? key : in_toml(key);
}

std::string list_in_toml(const auto& list) {
    std::string result;
    for (const DraftValue& value : list) result += (result.empty() ? "" : ", ") + value.text();
    return "[" + result + "]";
}

}  // namespace

/// The shortest that reads back the same. "nan" and "inf" are words of TOML; the reader refuses them with the name
/// of what they were given to.
DraftValue::DraftValue(double number) : text_(fmt::format("{}", number)) {
    if (text_.find_first_not_of("-0123456789") == std::string::npos) text_ += ".0";
}
DraftValue::DraftValue(int number) : text_(std::to_string(number)) {}
DraftValue::DraftValue(bool flag) : text_(flag ? "true" : "false") {}
DraftValue::DraftValue(const char* text) : text_(in_toml(text)) {}
DraftValue::DraftValue(const std::string& text) : text_(in_toml(text)) {}
DraftValue::DraftValue(std::initializer_list<DraftValue> list) : text_(list_in_toml(list)) {}
DraftValue::DraftValue(const std::vector<DraftValue>& list) : text_(list_in_toml(list)) {}
DraftValue::DraftValue(const DraftTable& table) : text_("{ " + table.text(", ") + " }") {}

DraftTable& DraftTable::set(const std::string& key, const DraftValue& value) {
    keys_.emplace_back(key_in_toml(key), value.text());
    return *this;
}

std::string DraftTable::text(const std::string& between) const {
    std::string result;
    for (const auto& [key, value] : keys_) result += (result.empty() ? "" : between) + key + " = " + value;
    return result;
}

SceneDraft& SceneDraft::set(const std::string& key, const DraftValue& value) {
    top_.set(key, value);
    return *this;
}

DraftTable& SceneDraft::table(const std::string& name) {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& entry) { return !entry.is_list && entry.name == name; });
    return found != entries_.end()
               ? found->table
               : entries_.emplace_back(Entry{.name = name, .is_list = false, .table = {}}).table;
}

DraftTable& SceneDraft::add(const std::string& name) {
    return entries_.emplace_back(Entry{.name = name, .is_list = true, .table = {}}).table;
}

std::string SceneDraft::text() const {
    std::string result = top_.text("\n") + "\n";
    for (const Entry& entry : entries_)
        result += fmt::format("\n{}{}{}\n{}\n", entry.is_list ? "[[" : "[", key_in_toml(entry.name),
                              entry.is_list ? "]]" : "]", entry.table.text("\n"));
    return result;
}

Scene SceneDraft::scene(const std::string& name) const {
    return parse_scene(text(), name);
}

}  // namespace alembert
