// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/fold.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "base/language/say.hpp"
#include "base/language/screens.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_rows = lines_of_two_screens, columns = 100, longest_line = 10 * columns;

struct FoldedLine {
    std::string text;
    std::size_t rows = 1;
};

using Paragraph = std::vector<FoldedLine>;

FoldedLine line_of(std::string text) {
    const std::size_t rows = 1 + text.size() / columns;
    return {std::move(text), rows};
}

std::size_t rows_of(const Paragraph& paragraph) {
    return std::accumulate(paragraph.begin(), paragraph.end(), std::size_t{0},
                           [](std::size_t sum, const FoldedLine& line) { return sum + line.rows; });
}

/// With the empty lines between them.
std::size_t rows_of(const std::vector<Paragraph>& paragraphs) {
    return std::accumulate(paragraphs.begin(), paragraphs.end(), paragraphs.size(),
                           [](std::size_t sum, const Paragraph& one) { return sum + rows_of(one); });
}

std::vector<Paragraph> paragraphs_of(std::string_view text) {
    std::vector<Paragraph> result(1);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        if (end > 0)
            result.back().push_back(line_of(std::string(text.substr(0, end))));
        else if (!result.back().empty())
            result.emplace_back();
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (result.back().empty()) result.pop_back();
    return result;
}

/// The beginning of a line that nobody reads to its end, cut between words.
void shorten(FoldedLine& line) {
    if (line.text.size() <= longest_line) return;
    const std::size_t at = line.text.rfind(' ', longest_line / 2);
    if (at == std::string::npos || at < longest_line / 4) return;
    line = line_of(line.text.substr(0, at) + say(" ... ({} letters more)", line.text.size() - at));
}

FoldedLine missing(const Paragraph& among, std::size_t lines) {
    const std::string& model = among.back().text;
    const std::string indent(std::min(model.find_first_not_of(' '), model.size()), ' ');
    return line_of(indent + say("... ({} lines more)", lines));
}

/// The first lines and the last, of no more than `most` rows.
Paragraph shortened(const Paragraph& whole, std::size_t most) {
    if (rows_of(whole) <= most || whole.size() < 4) return whole;
    std::size_t rows = 1 + whole.back().rows, kept = 0;
    while (kept + 1 < whole.size() && (kept == 0 || rows + whole[kept].rows <= most)) rows += whole[kept++].rows;
    const std::size_t lines = whole.size() - 1 - kept;
    if (lines < 2) return whole;
    Paragraph result(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(kept));
    result.push_back(missing(result, lines));
    result.push_back(whole.back());
    return result;
}

/// Without those that come before the last one and do not fit; `whole`: the same before they were shortened.
std::vector<Paragraph> first_of(std::vector<Paragraph> all, const std::vector<Paragraph>& whole) {
    std::size_t rows = 2 + rows_of(all.back()), kept = 0;
    while (kept + 1 < all.size() && (kept == 0 || rows + rows_of(all[kept]) + 1 <= most_rows))
        rows += rows_of(all[kept++]) + 1;
    std::size_t lines = 0;
    for (std::size_t k = kept; k + 1 < whole.size(); ++k) lines += whole[k].size();
    if (lines == 0) return all;
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(kept), end = all.end() - 1;
    *begin = {line_of(say("... ({} lines in {} paragraphs more)", lines, end - begin))};
    all.erase(begin + 1, end);
    return all;
}

}  // namespace

std::string folded(std::string_view text) {
    const std::vector<Paragraph> whole = paragraphs_of(text);
    if (rows_of(whole) <= most_rows) return std::string(text);
    std::vector<Paragraph> shown = whole;
    for (Paragraph& one : shown) std::for_each(one.begin(), one.end(), shorten);
    const std::vector<Paragraph> lines_cut = shown;
    for (const std::size_t most : std::array{60, 40, 25, 15, 9}) {
        if (rows_of(shown) <= most_rows) break;
        std::transform(lines_cut.begin(), lines_cut.end(), shown.begin(),
                       [most](const Paragraph& one) { return shortened(one, most); });
    }
    if (rows_of(shown) > most_rows) shown = first_of(std::move(shown), whole);
    std::string result;
    for (const Paragraph& one : shown) {
        for (const FoldedLine& line : one) result += line.text + "\n";
        result += "\n";
    }
    return result + say("(Shortened because of the length: --full prints everything, and --json has it.)\n");
}

}  // namespace alembert
