// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/marked.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "check/derivation/choose_letters.hpp"
#include "check/derivation/glued.hpp"
#include "check/derivation/marker.hpp"
#include "check/derivation/own_functions.hpp"
#include "check/derivation/readings.hpp"
#include "check/derivation/running_indices.hpp"

namespace alembert {

const char* name_of(LineStatus status) {
    switch (status) {
        case LineStatus::right:
            return "right";
        case LineStatus::right_near:
            return "right_near";
        case LineStatus::right_up_to_constant:
            return "right_up_to_constant";
        case LineStatus::right_up_to_derivative:
            return "right_up_to_derivative";
        case LineStatus::definition:
            return "definition";
        case LineStatus::mistake:
            return "mistake";
        case LineStatus::follows:
            return "follows";
        case LineStatus::unfounded:
            return "unfounded";
        case LineStatus::undecided:
            return "undecided";
        case LineStatus::not_understood:
            return "not_understood";
        case LineStatus::not_about_scene:
            return "not_about_scene";
    }
    return "undecided";
}

bool is_right(LineStatus status) {
    return status == LineStatus::right || status == LineStatus::right_near ||
           status == LineStatus::right_up_to_constant || status == LineStatus::right_up_to_derivative;
}

bool is_worse(LineStatus status, LineStatus than) {
    static constexpr LineStatus from_worst[] = {LineStatus::mistake, LineStatus::undecided, LineStatus::unfounded,
                                                LineStatus::follows};
    const auto rank = [&](LineStatus one) {
        return std::find(std::begin(from_worst), std::end(from_worst), one) - std::begin(from_worst);
    };
    return rank(status) < rank(than);
}

Marked mark(Scene scene, Written written, const MarkOptions& options) {
    DerivedSystem derived{std::move(scene), options.by};
    return mark(derived, std::move(written), options);
}

Marked mark(DerivedSystem& system, Written written, const MarkOptions& options) {
    Marked result{.written = std::move(written)};
    std::map<std::string, std::string> letters = options.letters;
    for (const WrittenLetter& letter : system.scene().letters)
        letters.emplace(letter.written.text, letter.name.text);
    const Letters plain(system.scene());
    std::vector<std::string> remarks;
    result.written = with_products(std::move(result.written), plain);
    result.written = with_running_indices(std::move(result.written), plain, remarks);
    result.written = with_own_functions(std::move(result.written), plain, remarks);
    const ChosenLetters chosen = choose_letters(system, result.written, letters);
    const Readings readings(system, result.written);
    Marker marker(system, result.written, readings.settle(chosen.letters, chosen.given));
    const Letters settled = marker.letters();
    marker.run();
    marker.verify();
    readings.withhold(marker.lines, settled, chosen.given);
    result.missing = marker.missing();
    result.complete = result.missing.empty();
    result.lines = std::move(marker.lines);
    join_copies(result.lines, result.written);
    result.letters = chosen.told;
    result.remarks = std::move(remarks);
    result.remarks.insert(result.remarks.end(), chosen.remarks.begin(), chosen.remarks.end());
    for (std::string& remark : marker.remarks()) result.remarks.push_back(std::move(remark));
    for (const Letter& letter : settled.authors())
        result.remarks.push_back(say("{} is read as a letter of the author's own", identifier_of(letter)));
    const auto first = std::find_if(result.lines.begin(), result.lines.end(),
                                    [](const MarkedLine& line) { return line.status == LineStatus::mistake; });
    if (first != result.lines.end()) result.first_mistake = static_cast<std::size_t>(first - result.lines.begin());
    return result;
}

}  // namespace alembert
