// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/running_indices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/language/say.hpp"
#include "check/derivation/parts.hpp"

namespace alembert {

namespace {

using Kind = Math::Kind;

bool holds_sum(const Math& math) {
    return (math.kind == Kind::call && (math.text == "sum" || math.text == "prod")) ||
           std::any_of(math.args.begin(), math.args.end(), [](const MathPtr& arg) { return holds_sum(*arg); });
}

MathPtr with_index(const MathPtr& math, const std::string& index, const std::string& number) {
    Math copy = *math;
    for (MathPtr& arg : copy.args) arg = with_index(arg, index, number);
    if (copy.letter.index == index) copy.letter.index = number;
    return std::make_shared<const Math>(std::move(copy));
}

/// The numbers for which all of the letters with the index that the scene has with any number are its own.
std::vector<std::string> numbers_of(const std::map<Letter, int>& all, const std::string& index,
                                    const Letters& letters) {
    constexpr int most = 9;
    std::vector<std::string> result;
    const auto is_known = [&](Letter letter, int number) {
        letter.index = std::to_string(number);
        const auto name = letters.name_of(letter);
        return name && letters.is_of_scene(*name);
    };
    std::vector<Letter> of_scene;
    for (const auto& [letter, dots] : all) {
        if (letter.index != index) continue;
        if (const auto name = letters.name_of(letter); name && letters.is_of_scene(*name)) return {};  // l_i of it
        for (int n = 1; n <= most; ++n)
            if (is_known(letter, n)) {
                of_scene.push_back(letter);
                break;
            }
    }
    for (int n = 1; n <= most && !of_scene.empty(); ++n)
        if (std::all_of(of_scene.begin(), of_scene.end(), [&](const Letter& one) { return is_known(one, n); }))
            result.push_back(std::to_string(n));
    return result;
}

/// The index that runs in the statement, with its numbers; none if there is none, or if there are two.
std::pair<std::string, std::vector<std::string>> running_index(const WrittenStatement& statement,
                                                               const Letters& letters) {
    if (statement.sides.size() < 2) return {};
    std::map<Letter, int> all;
    for (const MathPtr& side : statement.sides) {
        if (holds_sum(*side)) return {};
        collect_letters(*side, all);
    }
    std::pair<std::string, std::vector<std::string>> result;
    for (const char* const index : {"i", "j", "k", "n"}) {
        const auto is_on = [&](const MathPtr& side) {
            std::map<Letter, int> there;
            collect_letters(*side, there);
            return there.empty() || std::any_of(there.begin(), there.end(),
                                                [&](const auto& item) { return item.first.index == index; });
        };
        if (!std::all_of(statement.sides.begin(), statement.sides.end(), is_on))
            continue;  // T = m_i v_i²/2: a sum
        std::vector<std::string> numbers = numbers_of(all, index, letters);
        if (numbers.size() < 2) continue;
        if (!result.first.empty()) return {};
        result = {index, std::move(numbers)};
    }
    const bool has_other = std::any_of(all.begin(), all.end(), [&](const auto& item) {  // θ_{i−1}, M_{ij}
        const std::string& index = item.first.index;
        return index.size() > 1 && index.find(result.first) != std::string::npos && !letters.name_of(item.first);
    });
    return has_other ? std::pair<std::string, std::vector<std::string>>{} : result;
}

}  // namespace

Written with_running_indices(Written written, const Letters& letters, std::vector<std::string>& remarks) {
    std::set<std::string> told;
    std::vector<WrittenStatement> statements;
    for (WrittenStatement& statement : written.statements) {
        const auto [index, numbers] = running_index(statement, letters);
        if (numbers.empty()) {
            statements.push_back(std::move(statement));
            continue;
        }
        if (told.insert(index).second)
            remarks.push_back(
                say("the index {} stands for {}", index, fmt::format("{}", fmt::join(numbers, ", "))));
        for (const std::string& number : numbers) {
            WrittenStatement copy = statement;
            copy.is_copy = number != numbers.front();
            for (MathPtr& side : copy.sides) side = with_index(side, index, number);
            statements.push_back(std::move(copy));
        }
    }
    written.statements = std::move(statements);
    return written;
}

void join_copies(std::vector<MarkedLine>& lines, const Written& written) {
    std::vector<MarkedLine> joined;
    std::vector<std::size_t> place(lines.size());  // in `joined`
    for (std::size_t k = 0; k < lines.size(); ++k) {
        std::size_t first = joined.size();
        if (written.statements[lines[k].statement].is_copy)
            for (std::size_t i = joined.size(); i-- > 0 && first == joined.size();)
                if (joined[i].offset == lines[k].offset && joined[i].length == lines[k].length) first = i;
        place[k] = first;
        if (lines[k].follows_from) lines[k].follows_from = place[*lines[k].follows_from];
        if (first == joined.size())
            joined.push_back(std::move(lines[k]));
        else if (is_worse(lines[k].status, joined[first].status))
            joined[first] = std::move(lines[k]);
    }
    lines = std::move(joined);
}

}  // namespace alembert
