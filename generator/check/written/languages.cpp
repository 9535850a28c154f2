// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/languages.hpp"

#include "check/written/sentences.hpp"

namespace alembert {

bool is_portuguese(const std::string& sentence) {
    return has_phrase(sentence,
                      "é|não|em|ao|aos|são|uma|numa|pelo|pela|ângulo|ângulos|oscilações|pequenos|pequenas|"
                      "equilíbrio|posição|equação|equações");
}

bool is_si_for_if(const std::string& sentence) {
    static constexpr std::string_view italian =
        "è|di|della|dello|dei|degli|delle|dell|nel|nella|nell|nello|gli|che|alla|allo|sono|più|perché|quindi|"
        "dunque|sull|sulla|dal|dalla|moto|pendolo|si ha|si hanno|si ottiene|si ottengono|si trova|si ricava|"
        "si può|si possono|si conserva|si conservano|si pone|si assume|si suppone|si considera|si noti|si vede|"
        "si riduce|si annulla|si muove|si muovono|si scrive|si calcola|si introduce|si linearizza";
    return has_phrase(sentence, "si") && !has_phrase(sentence, italian) &&
           !has_phrase(sentence, "entre si|em si|por si só|si mesmo");
}

}  // namespace alembert
