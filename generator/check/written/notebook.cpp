// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/notebook.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "scene/text.hpp"

namespace alembert {

namespace {

struct Literal {
    std::size_t begin, end;  // without its quotes
};

/// Goes through JSON that is known to be well-formed, and notes where the sources of cells stand.
class Cells {
public:
    explicit Cells(const std::string& json) : json_(json), shown_(json.size(), ' ') {}

    std::string markdown() {
        value(0, "");
        return std::move(shown_);
    }

private:
    const std::string& json_;
    std::string shown_;
    std::size_t at_ = 0;
    std::vector<Literal> source_;
    bool is_markdown_ = false;

    void skip() {
        while (at_ < json_.size() && (std::isspace(static_cast<unsigned char>(json_[at_])) != 0 ||
                                      json_[at_] == ',' || json_[at_] == ':'))
            ++at_;
    }

    Literal literal() {
        const std::size_t begin = ++at_;
        while (json_[at_] != '"') at_ += json_[at_] == '\\' ? 2 : 1;
        return {begin, at_++};
    }

    std::string_view text(const Literal& of) const {
        return std::string_view(json_).substr(of.begin, of.end - of.begin);
    }

    /// `depth`: brackets around it; a cell is an object in the list `cells` of the outermost one.
    void value(int depth, std::string_view key) {
        skip();
        const char c = json_[at_];
        if (c == '"') return scalar(depth, key, literal());
        if (c != '{' && c != '[') {
            while (at_ < json_.size() && std::string_view(",]} \n\r\t").find(json_[at_]) == std::string_view::npos)
                ++at_;
            return;
        }
        const bool is_object = c == '{', is_cell = is_object && depth == 2 && key == "cells";
        const std::size_t begin = at_++;
        if (is_cell) source_.clear(), is_markdown_ = false;
        for (skip(); json_[at_] != '}' && json_[at_] != ']'; skip()) {
            const std::string_view name = is_object ? text(literal()) : key;
            value(depth + 1, name);
        }
        ++at_;
        if (!is_cell || !is_markdown_) return;
        shown_[begin] = shown_[begin + 1] = '\n';  // cells are paragraphs
        for (const Literal& part : source_) show(part);
    }

    void scalar(int depth, std::string_view key, const Literal& of) {
        if (depth == 3 && key == "cell_type") is_markdown_ = text(of) == "markdown";
        if ((depth == 3 || depth == 4) && key == "source") source_.push_back(of);
    }

    void put(std::size_t end, std::string_view what) {
        std::copy(what.begin(), what.end(), shown_.begin() + static_cast<std::ptrdiff_t>(end - what.size()));
    }

    /// What an escape stands for ends where the escape does; backslashes that follow each other stay together.
    void show(const Literal& of) {
        for (std::size_t i = of.begin; i < of.end;) {
            if (json_[i] != '\\') {
                shown_[i] = json_[i];
                ++i;
                continue;
            }
            std::size_t run = i;
            while (run + 1 < of.end && json_[run] == '\\' && json_[run + 1] == '\\') run += 2;
            if (run > i) {
                put(run, std::string((run - i) / 2, '\\'));
                i = run;
            } else {
                i = show_escape(i);
            }
        }
    }

    std::size_t show_escape(std::size_t i) {
        const char c = json_[i + 1];
        if (c != 'u') {
            put(i + 2, c == 'n' ? "\n" : c == 't' || c == 'r' ? " " : std::string_view(&json_[i + 1], 1));
            return i + 2;
        }
        const auto unit = [&](std::size_t at) {
            return static_cast<char32_t>(std::stoul(json_.substr(at + 2, 4), nullptr, 16));
        };
        char32_t character = unit(i);
        std::size_t end = i + 6;
        if (character >= 0xD800 && character < 0xDC00 && json_.compare(end, 2, "\\u") == 0) {
            character = 0x10000 + ((character - 0xD800) << 10) + (unit(end) - 0xDC00);
            end += 6;
        }
        put(end, encode(character));
        return end;
    }
};

}  // namespace

std::string cells_of_notebook(const std::string& json) {
    const nlohmann::json page = nlohmann::json::parse(json, nullptr, false);
    const bool is_notebook = page.is_object() && page.contains("cells") && page["cells"].is_array();
    return is_notebook ? Cells(json).markdown() : "";
}

}  // namespace alembert
