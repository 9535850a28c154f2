// SPDX-License-Identifier: GPL-2.0-or-later
// Messages about mistakes, with their places: `file:line:column: message`, the line itself, a caret.

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/language/say.hpp"
#include "scene/scene.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

constexpr std::size_t most_told = 20;
constexpr int window = 100;  // columns of a long line that are shown around the caret

/// One character of a line in the form in which it is shown.
struct Cell {
    std::string text;
    int width;
};

std::vector<Cell> cells(std::string_view line) {
    std::vector<Cell> result;
    for (std::size_t i = 0; i < line.size();) {
        const char32_t c = decode(line, i);
        if (c == U'\t')
            result.push_back({" ", 1});
        else if (is_disturbing(c))
            result.push_back({"\uFFFD", 1});
        else
            result.push_back({encode(c), width(c)});
    }
    return result;
}

/// The beginning of each line of the text.
std::vector<std::size_t> line_starts(std::string_view text) {
    std::vector<std::size_t> starts{0};
    for (std::size_t i = text.find('\n'); i != std::string_view::npos; i = text.find('\n', i + 1))
        starts.push_back(i + 1);
    return starts;
}

/// The line and the caret below it; a long line is cut to a window around the caret.
std::string excerpt(std::string_view line, int column) {
    while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.remove_suffix(1);
    const std::vector<Cell> all = cells(line);
    const int count = static_cast<int>(all.size());
    const int caret = std::clamp(column - 1, 0, count);
    const auto cost = [&](int i) { return all[static_cast<std::size_t>(i)].width; };
    int first = caret, last = caret, used = 0;  // [first, last) is shown
    for (bool grown = true; grown && used < window;) {
        grown = false;
        if (last < count) used += cost(last++), grown = true;
        if (first > 0 && used < window) used += cost(--first), grown = true;
    }
    std::string shown = first > 0 ? "…" : "", below(first > 0 ? 1 : 0, ' ');
    for (int i = first; i < last; ++i) {
        shown += all[static_cast<std::size_t>(i)].text;
        if (i < caret) below.append(static_cast<std::size_t>(cost(i)), ' ');
    }
    if (last < count) shown += "…";
    return "    " + shown + "\n    " + below + "^\n";
}

/// Damerau-Levenshtein distance (neighbours swapped count one), up to `most`; more gives most + 1.
int distance(const std::u32string& a, const std::u32string& b, int most) {
    const int n = static_cast<int>(a.size()), m = static_cast<int>(b.size());
    if (std::abs(n - m) > most) return most + 1;
    std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
    const auto at = [&](int i, int j) -> int& {
        return d[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    };
    for (int i = 0; i <= n; ++i) at(i, 0) = i;
    for (int j = 0; j <= m; ++j) at(0, j) = j;
    for (int i = 1; i <= n; ++i)
        for (int j = 1; j <= m; ++j) {
            const auto x = static_cast<std::size_t>(i - 1), y = static_cast<std::size_t>(j - 1);
            at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + (a[x] != b[y])});
            if (i > 1 && j > 1 && a[x] == b[y - 1] && a[x - 1] == b[y])
                at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
        }
    return at(n, m);
}

std::u32string lower(std::string_view word) {
    std::u32string result;
    for (std::size_t i = 0; i < word.size();) {
        const char32_t c = decode(word, i);
        result += c >= U'A' && c <= U'Z' ? c + 32 : c;
    }
    return result;
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    const std::u32string wanted = lower(word);
    if (wanted.size() > 40) return {};
    const int most = wanted.size() < 2 ? 0 : wanted.size() < 5 ? 1 : 2;
    int best = most + 1;
    std::string result;
    for (const std::string& candidate : known) {
        if (candidate == word || candidate.size() > 200) continue;
        const int d = distance(wanted, lower(candidate), most);
        if (d < best) best = d, result = candidate;
    }
    return result;
}

std::string describe(const Scene& scene, const std::vector<Diagnostic>& diagnostics) {
    std::string result;
    for (std::size_t k = 0; k < diagnostics.size() && k < most_told; ++k) {
        const auto& [place, message, severity, kind, name] = diagnostics[k];
        const bool is_warning = severity == Severity::warning, is_own = is_warning && !scene.own_text.empty();
        const std::string& text = is_own ? scene.own_text : scene.text;
        result += escaped(is_own ? scene.own_file : scene.file, 400);
        if (place.line > 0) result += fmt::format(":{}:{}", place.line, place.column);
        result += fmt::format(": {}{}\n", is_warning ? say("warning: ") : "", message);
        const std::vector<std::size_t> starts = line_starts(text);
        const auto line = static_cast<std::size_t>(place.line);
        if (line == 0 || line > starts.size()) continue;
        const std::size_t end = line < starts.size() ? starts[line] : text.size();
        result += excerpt(std::string_view(text).substr(starts[line - 1], end - starts[line - 1]), place.column);
    }
    if (diagnostics.size() > most_told)
        result += say("{}: and {} more\n", escaped(scene.file, 400), diagnostics.size() - most_told);
    return result;
}

void fail(const Scene& scene, std::vector<Diagnostic> diagnostics) {
    std::stable_sort(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& a, const Diagnostic& b) { return a.place < b.place; });
    const std::string text = describe(scene, diagnostics);
    throw SceneError(text, std::move(diagnostics));
}

}  // namespace alembert
