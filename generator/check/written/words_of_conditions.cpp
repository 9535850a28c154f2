// SPDX-License-Identifier: GPL-2.0-or-later
// Words for conditions and cases.

#include "check/written/words.hpp"

#include <algorithm>
#include <cctype>

#include "check/written/languages.hpp"
#include "check/written/sentences.hpp"

namespace alembert {

bool begins_condition(std::string_view words) {
    const std::string lower = in_lower_case(words);
    for (const std::string_view word :
         {"if",       "for",      "when",  "whenever", "otherwise", "provided", "as long as", "while",
          "wenn",     "für",      "falls", "sofern",   "solange",   "sonst",    "pour",       "lorsque",
          "quand",    "tant que", "sinon", "para",     "cuando",    "mientras", "quando",     "altrimenti",
          "purché",   "enquanto", "jeśli", "jeżeli",   "gdy",       "kiedy",    "dla",        "när",
          "så länge", "если",     "когда", "при",      "для",       "пока",     "иначе"})
        if (lower.starts_with(word) &&
            (lower.size() == word.size() || lower[word.size()] == ' ' || lower[word.size()] == ','))
            return true;
    // Words that mean something else at the beginning of a sentence: "si ha", "se tiene", "om axeln"
    return ends_with_word(words, {"si", "se", "om", "för", "per"}) && trimmed_sentence(words).size() < 5;
}

bool says_held(std::string_view words) {
    const std::string sentence = last_sentence(words);
    const bool is_denied =
        denies(sentence) ||
        has_phrase(
            sentence,
            "not|no longer|never|isn't|aren't|cannot|can't|nothing|was|were|before|once|let go|free|freed|"
            "nicht|nie|niemals|war|waren|wurde|vorher|n'est|plus|jamais|était|no|nunca|ya no|era|estaba|non|"
            "mai|più|não|nie|już|inte|aldrig|не|больше|никогда|был|была|было|未*|不固定*|没有*|不再*|曾*|松开*");
    if (is_denied) return false;
    // "Sanity check: block clamped"
    constexpr std::ptrdiff_t most_words = 5;
    const bool is_note = std::count(sentence.begin(), sentence.end(), ' ') < most_words;
    const bool is_conditional =
        is_note || begins_condition_of_state(sentence) ||
        has_phrase(
            sentence,
            "let|assume|assuming|with|mit|angenommen|soit|avec|con|sea|sia|com|seja|z|med|设*|令*|时*|とき*");
    return is_conditional &&
           has_phrase(sentence,
                      "is fixed|is held|are held|clamp*|locked|blocked|held fast|does not move|does not turn|"
                      "festgehalten|fixiert|arretiert|blockiert|eingespannt|不动*|固定*|夹住*|锁定*|"
                      "est fixe|est fixé*|maintenu*|bloque|bloqué*|immobilis*|está fij*|bloquead*|no se mueve|"
                      "è fiss*|bloccat*|não se move|travad*|fixad*|unieruchomion*|nie porusza się|hålls fast|låst|"
                      "закреплён*|закреплен*|неподвижн*|удержива*|固定され*|動かない*");
}

bool states_condition(std::string_view words) {
    const std::string sentence = last_sentence(words);
    const bool is_conditional = has_phrase(
        sentence,
        "if|when|whenever|suppose|for|with|in the limit|in the case|falls|wenn|bei|für|若*|如果*|假设*|当|"
        "si|lorsque|quand|pour|cuando|para|se|quando|per|jeśli|jeżeli|gdy|dla|przy|om|när|för|если|когда|при|"
        "場合*|とき*|ならば*|すれば*|すると*");
    const bool holds_something = has_phrase(
        sentence,
        "is fixed|held|held fast|does not move|does not turn|is at rest|is "
        "stationary|vanishes|at the constant rate|"
        "festgehalten|ruht|steht still|不动*|固定*|保持静止*|为零*|"
        "ist fest|fest ist|unbewegt|fixiert|in ruhe ist|in ruhe bleibt|verschwindet|"
        "est fixe|est fixé*|maintenu*|est bloqué*|ne bouge pas|ne tourne pas|est immobile|est au repos|s'annule|"
        "está fij*|se mantiene fij*|no se mueve|no gira|está en reposo|está quiet*|está bloquead*|se anula|"
        "è fiss*|è ferm*|tenuto fermo|tenuta ferma|è bloccat*|non si muove|non ruota|è in quiete|si annulla|"
        "está fix*|é fix*|mantido fixo|mantida fixa|não se move|não gira|está em repouso|está parad*|está travad*|"
        "jest nieruchom*|jest unieruchomion*|nie porusza się|nie obraca się|spoczywa|jest w spoczynku|znika|"
        "hålls fast|hålls stilla|är fix|är fixerad|är låst|rör sig inte|inte rör sig|roterar inte|är i vila|"
        "står stilla|försvinner|закреплён*|закреплен*|неподвижен|неподвижна|неподвижно|неподвижны|не движется|"
        "не вращается|покоится|находится в покое|удержива*|обращается в нуль|обращается в ноль|заторможен*|"
        "動かない*|静止している*|静止していれば*|回らない*|回転しない*|止まって*|0になる*");
    const bool is_holding =
        has_phrase(sentence, "hold the|being held|being blocked|being clamped|hält man|wird*festgehalten") ||
        (has_phrase(sentence,
                    "holding|keeping") &&  // "keeping all terms" and "the springs holding it" hold nothing
         has_phrase(sentence, "fixed|fast|constant|still|at rest|at zero|clamped|locked|in place"));
    return is_holding || (is_conditional && holds_something);
}

bool is_conditional(std::string_view words) {
    std::string sentence = last_sentence(words);
    sentence.erase(0, std::min(sentence.find_first_not_of(" *#>-(,"), sentence.size()));
    for (const std::string_view joining :
         {"but ", "and ", "now ", "also ", "in particular ", "und ", "aber ", "mais ", "et ", "pero ", "ma ",
          "mas ", "ale ", "men ", "och ", "но ", "а ", "и "})
        if (sentence.starts_with(joining)) sentence.erase(0, joining.size());
    static constexpr std::string_view beginnings[] = {
        "if ",          "when ",        "whenever ",      "as long as ", "wenn ",    "falls ",
        "solange ",     "sobald ",      "sofern ",        "si ",         "lorsque ", "lorsqu'",
        "quand ",       "tant que ",    "dès que ",       "s'il ",       "cuando ",  "mientras ",
        "siempre que ", "quando ",      "finché ",        "qualora ",    "mentre ",  "se il ",
        "se lo ",       "se l'",        "se gli ",        "se i ",       "se non ",  "se invece ",
        "se entrambi ", "se entrambe ", "enquanto ",      "caso o ",     "caso a ",  "se o ",
        "se a ",        "se os ",       "se as ",         "se um ",      "se uma ",  "se não ",
        "se ambos ",    "jeśli ",       "jeżeli ",        "gdy ",        "kiedy ",   "dopóki ",
        "o ile ",       "om ",          "när ",           "så länge ",   "ifall ",   "если ",
        "когда ",       "пока ",        "в случае, если "};
    const auto* const begun =
        std::find_if(std::begin(beginnings), std::end(beginnings), [&](std::string_view beginning) {
            return sentence.starts_with(beginning) && !(beginning == "si " && !is_si_for_if(sentence));
        });
    const bool is_chinese = has_phrase(sentence, "当*时*|若*|如果*|假如*|假定*");
    const bool is_supposed = has_phrase(
        sentence,
        "would|until|wäre|hätte|würde|aurait|serait|jusqu'à|sería|serían|tendría|hasta|"
        "sarebbe|avrebbe|fino a|の場合*|のとき*|ならば*|直到*|"
        "seria|teria|até que|byłby|byłaby|byłoby|miałby|miałaby|skulle|vore|tills|был бы|была бы|было бы|были бы|"
        "до тех пор|であれば*|とすれば*|のときは*|ときには*|場合は*|場合には*|限りは*|している間*");
    // "In the elastic mode the discs move against each other"
    const bool is_of_mode =
        has_phrase(sentence,
                   "mode|eigenform|eigenschwingung|振型*|mode propre|modo normal|modo propio|"
                   "modo normale|modo proprio|modo próprio|postaci drgań|svängningsmod*|egenmod*|egensvängning*|"
                   "нормальном колебании|главном колебании|форме колебаний|振動モード*|固有モード*|基準振動*") &&
        has_phrase(
            sentence,
            "in the|in this|in each|in der|in dieser|en el|en este|dans le|dans ce|在*|"
            "in dem|in jeder|en cada|dans chaque|nel|in questo|neste|em cada|w tej|w każdej|i den|i denna|i varje|"
            "в|в каждом|では*|において*|で*");
    if (is_of_mode) return true;
    if (begun == std::end(beginnings) && !is_chinese && !is_supposed) return false;
    // "If we substitute this, we get" is no condition of the mechanism's
    static constexpr std::string_view operations =
        "substitut*|insert*|differentiat*|derivative|plug*|combine*|combining|eliminat*|multipl*|divid*|expand*|"
        "simplif*|rearrang*|compar*|add|adding|subtract*|equat*|use|using|apply|applying|write|writing|collect*|"
        "einsetz*|einges*|ableit*|abgeleitet|differenzier*|multipliz*|umform*|addier*|subtrahier*|eliminier*|"
        "verwend*|代入*|求导*|微分*|整理*|展开*|相加*|相减*|消去*|sustitu*|deriv*|dériv*|rempla*|"
        "multipli*|élimin*|simplifi*|"
        "einsetzen|setzt man|setzen wir|integrier*|vergleich*|substitu*|développ*|soustra*|appliqu*|utilis*|écri*|"
        "introdui*|intègr*|desarroll*|simplific*|sumamos|sumando|aplic*|usamos|usando|utiliz*|escrib*|introduc*|"
        "sostitu*|inseri*|svilupp*|semplific*|moltiplic*|sommiamo|sommando|sottra*|confront*|usiamo|scriv*|"
        "raccogl*|"
        "desenvolv*|somamos|somarmos|usarmos|escrev*|introduz*|podstaw*|wstaw*|różniczk*|pochodn*|uproś*|mnoż*|"
        "pomnoż*|dzieląc|podziel*|dodaj*|dodam*|odejm*|wyelimin*|porówn*|zastosuj*|skorzysta*|użyj*|zapisz*|"
        "napisz*|"
        "sätter vi in|sätter man in|insätt*|utveckl*|förenkl*|adder*|jämför*|använd*|tillämp*|skriv*|"
        "подстав*|дифференцир*|продифференцир*|производн*|разлож*|упрост*|упрощ*|умнож*|раздел*|слож*|вычит*|вычт*"
        "|"
        "исключ*|сравн*|примен*|использ*|воспольз*|запис*|запиш*|введ*|введём|перейд*|перейт*|"
        "微分*|加え*|引いて*|引くと*|掛け*|割ると*|割れば*|割って*|用い*|使う*|使えば*|使って*|書け*|書く*|"
        "まとめ*";
    return !has_phrase(sentence, operations) && !speaks_of_motion(sentence);
}

bool speaks_of_constant_value(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "constant|constants|konstant|konstante|konstanter|konstantem|constante|constantes|be constant|"
        "stays constant|恒定*|不变*|保持常*|circle of radius|kreis vom radius|cercle de rayon|círculo de radio|"
        "konstanten|konstantes|circonférence de rayon|circunferencia de radio|costante|costanti|"
        "circonferenza di raggio|cerchio di raggio|círculo de raio|circunferência de raio|"
        "stały|stała|stałe|stałym|stałą|stałej|stałego|okrąg o promieniu|okręgu o promieniu|konstanta|cirkel med "
        "radie*|"
        "постоянн*|постоянен|постоянна|постоянно|постоянны|неизменн*|окружность радиуса|окружности радиуса|"
        "一定で*|一定の*|一定と*|一定に*|一定値*|は一定*|が一定*");
}

bool ends_with_condition(std::string_view words) {
    return ends_with_word(words, {"when",
                                  "if",
                                  "provided",
                                  "provided that",
                                  "only if",
                                  "wenn",
                                  "falls",
                                  "sofern",
                                  "si",
                                  "cuando",
                                  "lorsque",
                                  "quand",
                                  "only for",
                                  "solange",
                                  "sobald",
                                  "nur für",
                                  "nur wenn",
                                  "tant que",
                                  "seulement si",
                                  "seulement pour",
                                  "siempre que",
                                  "sólo si",
                                  "solo si",
                                  "sólo para",
                                  "solo para",
                                  "se",
                                  "quando",
                                  "purché",
                                  "qualora",
                                  "solo se",
                                  "solo per",
                                  "caso",
                                  "enquanto",
                                  "somente se",
                                  "somente para",
                                  "apenas para",
                                  "jeśli",
                                  "jeżeli",
                                  "gdy",
                                  "o ile",
                                  "tylko gdy",
                                  "tylko dla",
                                  "om",
                                  "när",
                                  "då",
                                  "endast om",
                                  "endast för",
                                  "bara om",
                                  "bara för",
                                  "если",
                                  "когда",
                                  "при условии",
                                  "при условии, что",
                                  "только если",
                                  "только при",
                                  "лишь при"});
}

std::vector<std::string> letters_that_are_zero(std::string_view words) {
    std::vector<std::string> result;
    const auto is_of_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t sign = words.find('='); sign != std::string_view::npos; sign = words.find('=', sign + 1)) {
        const std::size_t zero = words.find_first_not_of(' ', sign + 1);
        if (zero == std::string_view::npos || words[zero] != '0' ||
            (zero + 1 < words.size() &&
             (is_of_letter(words[zero + 1]) || words.substr(zero + 1).starts_with(".0") ||
              (words[zero + 1] == '.' && zero + 2 < words.size() && is_of_letter(words[zero + 2])))))
            continue;
        std::size_t end = sign;
        while (end > 0 && words[end - 1] == ' ') --end;
        std::size_t begin = end;
        while (begin > 0 && is_of_letter(words[begin - 1])) --begin;
        const bool is_alone = begin == 0 || words[begin - 1] == ' ' || words[begin - 1] == '(';
        if (begin < end && is_alone && std::isalpha(static_cast<unsigned char>(words[begin])) != 0)
            result.emplace_back(words.substr(begin, end - begin));
    }
    return result;
}

bool begins_condition_of_state(std::string_view words) {
    const std::string sentence = last_sentence(words);
    return is_si_for_if(sentence) ||
           has_phrase(sentence,
                      "if|when|whenever|suppose|falls|wenn|cuando|lorsque|quand|若*|如果*|假设*|sofern|supposons|"
                      "supongamos|quando|qualora|supponiamo|suponhamos|jeśli|jeżeli|gdy|kiedy|o "
                      "ile|när|ifall|antag att|если|"
                      "когда|предположим|ならば*|のとき*|の場合*") ||
           ends_with_word(words, {"at", "for", "bei", "für",  "para", "pour", "en", "在", "对于", "当", "per",
                                  "se", "em",  "dla", "przy", "för",  "vid",  "om", "då", "при",  "для"});
}

bool speaks_of_special_case(std::string_view words) {
    return begins_condition_of_state(words) ||
           has_phrase(
               last_sentence(words),
               "cuando|caso particular|casos particulares|cas particulier|dans le cas|en el "
               "caso|pour|para|spezialfall|"
               "case 1|case 2|case 3|case 4|case a|case b|case i|case ii|fall 1|fall 2|fall 3|cas 1|cas 2|caso "
               "1|caso 2|"
               "resonance|resonanz|resonancia|résonance|特例*|特别地*|情形*|情况*|共振*|sonderfälle|special "
               "cases|limiting case*|grenzfall*|cas limite|caso límite|"
               "special case|in the case|in case|provided|only for|only if|sonderfall|特殊情形*|特例*|当且仅当*|"
               "im fall|im falle|spezialfälle|nur für|nur wenn|resonanzfall|cas particuliers|cas limites|cas "
               "spécial|"
               "seulement si|seulement pour|caso especial|casos especiales|sólo si|solo si|sólo para|en caso de|"
               "caso particolare|casi particolari|caso speciale|casi limite|nel caso|risonanza|solo se|solo per|"
               "casos especiais|no caso|caso limite|casos limite|ressonância|somente se|somente para|apenas para|"
               "przypadek szczególny|przypadku szczególnym|szczególny przypadek|szczególnym przypadku|przypadek "
               "graniczny|"
               "przypadku granicznym|w przypadku|przypadek 1|przypadek 2|rezonans*|tylko dla|tylko gdy|"
               "specialfall*|gränsfall*|i fallet|resonans*|endast för|endast om|bara för|bara om|"
               "частный случай|частном случае|частные случаи|частных случа*|частным случаем|предельный случай|"
               "предельном случае|особый случай|в случае|случай 1|случай 2|случай 3|резонанс*|только при|только "
               "если|лишь при|"
               "特別な場合*|特殊な場合*|特に*|場合に*|共鳴*|共振*|に限り*|のときのみ*");
}

bool speaks_of_general_case(std::string_view words) {
    return words.find('#') != std::string_view::npos ||
           has_phrase(
               in_lower_case(words),
               "in general|in the general case|general case|from now on|now let|for all values|different "
               "again|unequal|without "
               "this assumption|for any|ohne diese annahme|verschieden*|一般情况*|若*不同|不同*|一般情形*|一般地*|"
               "allgemein*|im allgemeinen|en general|en général|"
               "dans le cas général|désormais|pour tout|pour toute|sans cette hypothèse|en el caso general|caso "
               "general|"
               "en adelante|para cualquier|sin esta hipótesis|in generale|nel caso generale|caso generale|d'ora "
               "in poi|"
               "per ogni|per qualsiasi|per qualunque|senza questa ipotesi|em geral|no caso geral|caso geral|daqui "
               "em diante|"
               "para qualquer|sem essa hipótese|w ogólności|ogólnie|w ogólnym przypadku|w przypadku "
               "ogólnym|odtąd|dla dowolnego|"
               "dla dowolnych|dla dowolnej|bez tego założenia|i allmänhet|i det allmänna fallet|allmänna "
               "fallet|hädanefter|"
               "för alla|för varje|för godtyckliga|utan detta antagande|в общем случае|общий случай|в общем "
               "виде|вообще говоря|"
               "отныне|для любых|для любого|для любой|при любых|при любом|для произвольн*|при произвольн*|"
               "без этого предположения|一般に*|一般には*|一般の場合*|一般的に*|この仮定なし*");
}

bool sets_value(std::string_view words) {
    return ends_with_word(
        words,
        {"set",       "setting",   "let",        "put",        "putting",    "with",    "mit",          "setze",
         "man setzt", "haciendo",  "poniendo",   "en posant",  "avec",       "con",     "令",           "设",
         "取",        "and",       "setzen wir", "setzt man",  "wir setzen", "sei",     "seien",        "posons",
         "on pose",   "soit",      "soient",     "en prenant", "sea",        "sean",    "tomando",      "pongamos",
         "poniamo",   "ponendo",   "si pone",    "sia",        "siano",      "seja",    "sejam",        "fazendo",
         "pondo",     "com",       "niech",      "przyjmijmy", "przyjmując", "kładąc",  "podstawiając", "oznaczmy",
         "sätt",      "sätter vi", "vi sätter",  "låt",        "med",        "положим", "полагая",      "положив",
         "пусть",     "примем",    "принимая",   "приняв",     "обозначим"});
}

}  // namespace alembert
