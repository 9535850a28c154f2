// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/words.hpp"

#include <algorithm>
#include <cctype>

#include "check/written/sentences.hpp"

namespace alembert {

bool begins_condition(std::string_view words) {
    const std::string lower = in_lower_case(words);
    for (const std::string_view word :
         {"if", "for", "when", "whenever", "otherwise", "provided", "as long as", "while", "wenn", "für", "falls"})
        if (lower.starts_with(word) &&
            (lower.size() == word.size() || lower[word.size()] == ' ' || lower[word.size()] == ','))
            return true;
    return false;
}

bool speaks_of_consequence(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "therefore|hence|so|thus|consequently|it follows|implies|gives|yields|we get|we obtain|"
        "we find|results in|leads to|then|因此*|所以*|故*|得*|于是*|从而*|即*|also|folglich|daher|somit");
}

bool speaks_of_exact_motion(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "exact equation*|the exact|exactly|full equation*|for arbitrary|arbitrary angles|arbitrary motion*|"
        "for large|large motion*|large angle*|large amplitude*|no approximation*|精确*|任意角*|大角度*|"
        "大幅*|exakte*|beliebig*|任意*|große auslenkung*|große winkel*|exacta*");
}

bool speaks_of_first_order(std::string_view words) {
    // "We do not linearize yet", "small oscillations are treated later"
    static constexpr std::string_view denials =
        "not|no|without|later|before|will follow|next section|next chapter|in contrast|unlike|nicht|kein*|ohne|"
        "später|bevor|不必*|无需*|不作*|不用*|以后*|未*|尚未*|之前*|下一节*";
    static constexpr std::string_view phrases =
        "small turn*|small swing*|small rotation*|small rock*|small libration*|small heading|small "
        "deviation*|kleine "
        "drehung*|kleine pendel*|petits mouvements|petites rotations|pequeños giros|small angle*|small "
        "oscillation*|small-angle*|small displacement*|small motion*|small amplitude*|"
        "small deflection*|small vibration*|small perturbation*|for small*|lineari*|first order|first-order|"
        "near equilibrium|near the equilibrium|nearly at rest|about the equilibrium|higher order|higher-order|"
        "second order terms|quadratic "
        "terms|小角*|微小*|微振动*|微幅*|很小*|略去高阶*|高阶小量*|一次近似*|小振动*|小摆*|线性化*|小幅*|一阶近似*"
        "|kleine winkel*|"
        "kleine auslenkung*|kleine schwingung*|für kleine|fuer kleine|kleiner auslenkung*|kleinen "
        "auslenkung*|kleine "
        "ausschl*|kleinen ausschl*|kleiner ausschl*|linearisier*|oscilaciones pequeñas|pequeñas "
        "oscilaciones|pequeño|"
        "pequeños ángulos|ángulos pequeños|aproximación lineal|linealiz*|petites oscillations|petits angles|"
        "linéaris*|solução linear|pequenas oscilações|perto da origem|perto do equilíbrio|piccole "
        "oscillazioni|linearizz*|near theta|near the bottom|near the vertex|near the top|near the lowest|near the "
        "origin|close "
        "to the equilibrium|close to equilibrium|small angles|petit*|"
        "pequeñas*|ángulos pequeños";
    const std::string lower = in_lower_case(words);
    for (std::size_t begin = 0; begin < lower.size();) {
        const std::size_t end = end_of_first_sentence(lower, begin);
        const std::string sentence = lower.substr(begin, end - begin);
        if (has_phrase(sentence, phrases) && !has_phrase(sentence, denials)) return true;
        begin = end;
    }
    return false;
}

bool states_condition(std::string_view words) {
    const std::string sentence = last_sentence(words);
    const bool is_conditional = has_phrase(
        sentence,
        "if|when|whenever|suppose|for|with|in the limit|in the case|falls|wenn|bei|für|若*|如果*|假设*|当");
    const bool holds_something = has_phrase(sentence,
                                            "is fixed|held|held fast|does not move|does not turn|is at rest|is "
                                            "stationary|vanishes|at the constant rate|"
                                            "festgehalten|ruht|steht still|不动*|固定*|保持静止*|为零*");
    return is_conditional && holds_something;
}

bool is_conditional(std::string_view words) {
    std::string sentence = last_sentence(words);
    sentence.erase(0, std::min(sentence.find_first_not_of(" *#>-(,"), sentence.size()));
    for (const std::string_view joining : {"but ", "and ", "now ", "also ", "in particular ", "und ", "aber "})
        if (sentence.starts_with(joining)) sentence.erase(0, joining.size());
    static constexpr std::string_view beginnings[] = {"if ",      "when ",  "whenever ", "as long as ",
                                                      "wenn ",    "falls ", "solange ",  "si ",
                                                      "lorsque ", "quand ", "cuando ",   "mientras "};
    const auto* const begun =
        std::find_if(std::begin(beginnings), std::end(beginnings),
                     [&](std::string_view beginning) { return sentence.starts_with(beginning); });
    const bool is_chinese = has_phrase(sentence, "当*时*|若*|如果*|假如*|假定*");
    const bool is_supposed =
        has_phrase(sentence,
                   "would|until|wäre|hätte|würde|aurait|serait|jusqu'à|sería|serían|tendría|hasta|"
                   "sarebbe|avrebbe|fino a|の場合*|のとき*|ならば*|直到*");
    // "In the elastic mode the discs move against each other"
    const bool is_of_mode =
        has_phrase(sentence, "mode|eigenform|eigenschwingung|振型*|mode propre|modo normal|modo propio") &&
        has_phrase(sentence, "in the|in this|in each|in der|in dieser|en el|en este|dans le|dans ce|在*");
    if (is_of_mode) return true;
    if (begun == std::end(beginnings) && !is_chinese && !is_supposed) return false;
    // "If we substitute this, we get" is no condition of the mechanism's
    static constexpr std::string_view operations =
        "substitut*|insert*|differentiat*|derivative|plug*|combine*|combining|eliminat*|multipl*|divid*|expand*|"
        "simplif*|rearrang*|compar*|add|adding|subtract*|equat*|use|using|apply|applying|write|writing|collect*|"
        "einsetz*|einges*|ableit*|abgeleitet|differenzier*|multipliz*|umform*|addier*|subtrahier*|eliminier*|"
        "verwend*|代入*|求导*|微分*|整理*|展开*|相加*|相减*|消去*|sustitu*|deriv*|dériv*|rempla*|"
        "multipli*|élimin*|simplifi*";
    return !has_phrase(sentence, operations) && !speaks_of_motion(sentence);
}

bool speaks_of_nearness(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "near|nearly|close to|in the vicinity of|in the neighbourhood of|nahe|in der nähe*|cerca de*|près d*|"
        "perto d*|vicino a*|附近*");
}

bool says_conserved_is(std::string_view words) {
    const std::string sentence = last_sentence(words);
    return has_phrase(
               sentence,
               "conserved is|conserved quantity|quantity that is conserved|constant of the motion|first integral|"
               "jacobi integral|jacobi's integral|jacobi's function|erhalten ist|erhaltungsgröße|se conserva|"
               "integral primera|intégrale première|守恒量*|首次积分*|第一积分*") &&
           !has_phrase(sentence, "not|no|nicht|kein|keine|pas|不*|非*");
}

bool asserts(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "we have|we get|we find|we obtain|gives|yields|is|are|keep|keeps|hence|thus|therefore|it follows|"
        "gilt|ist|folgt|somit|erhalten wir|ergibt|on a|on trouve|on obtient|donc|il vient|tenemos|"
        "resulta|se obtiene|por tanto|es|si ha|quindi|得*|有|为*|所以*|故*|因此*");
}

bool speaks_of_other_system(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "analogous|analogue|kepler problem|kepler-problem|keplerproblem|problème de kepler|problema de "
        "kepler|开普勒问题*|in contrast to|unlike|im gegensatz zu*|contrairement à|a diferencia de");
}

bool speaks_of_effective_potential(std::string_view words) {
    return has_phrase(last_sentence(words),
                      "effective potential*|effective one-dimensional potential|effektive potential*|effektives "
                      "potential|effektiven potential*|potentiel effectif|potencial efectivo|potentiel effective|"
                      "有效势*|等效势*");
}

bool speaks_of_constant_value(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "constant|constants|konstant|konstante|konstanter|konstantem|constante|constantes|be constant|"
        "stays constant|恒定*|不变*|保持常*|circle of radius|kreis vom radius|cercle de rayon|círculo de radio");
}

bool neglects_terms(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "at the critical*|critical load|im kritischen*|kritischen last|charge critique|carga "
        "crítica|临界*|neglect*|negligible|drop the|dropping|ignore|ignoring|left aside|disregard*|are small|is "
        "small|replaced by "
        "the linear*|fast top|rapid*|vernachlässig*|vernachlaessig*|klein gegen|néglig*|négliger|petit devant|"
        "desprecia*|despreciable*|略去*|忽略*|远小于*|远大于*|很快时*|高速*");
}

bool speaks_of_turning_axes(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "rotating frame|rotating axes|turning axes|turning frame|moving axes|body axes|body-fixed|co-rotating|"
        "mitrotierend*|rotierenden system|drehenden achsen|körperfest*|repère tournant|référentiel "
        "tournant|axes mobiles|ejes móviles|ejes giratorios|sistema "
        "giratorio|转动参考系*|动坐标系*|动系*|随体*|连体*");
}

bool ends_with_condition(std::string_view words) {
    return ends_with_word(words, {"when", "if", "provided", "provided that", "only if", "wenn", "falls", "sofern",
                                  "si", "cuando", "lorsque", "quand", "only for"});
}

bool neglects_gravity(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "without gravity|no gravity|neglecting gravity|neglect gravity|ignoring gravity|in the absence of "
        "gravity|weightless*|ohne schwerkraft|ohne gewichtskraft|schwerelos*|不计重力*|无重力*|忽略重力*|"
        "失重*|sans pesanteur|sans gravité|sin gravedad|en ausencia de gravedad");
}

bool neglects_resistance(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "without damping|without friction|without drag|without resistance|undamped|no damping|no friction|"
        "no drag|neglecting friction|neglecting damping|neglecting the friction|neglecting the damping|"
        "neglect friction|neglect damping|ignoring friction|ignoring damping|frictionless|if friction is "
        "neglected|if damping is neglected|ohne dämpfung|ohne reibung|ungedämpft*|reibungsfrei*|reibungslos*|"
        "无阻尼*|不计阻尼*|不计摩擦*|无摩擦*|忽略摩擦*|忽略阻尼*|sans frottement*|sans amortissement|"
        "non amorti*|sin fricción|sin rozamiento|sin amortiguamiento|no amortiguad*");
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

bool names_part_of_forces(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "of the weight|of the weights|of the two weights|of gravity|of the gravity|of gravitational forces|by "
        "gravity|"
        "gravity does|gravity contributes|weight contributes|"
        "of the spring|of the springs|by the spring|of the damper|of the dampers|of friction|of the drag|"
        "of the motor|of the torque|der gewichte|der gewichtskr*|der schwerkraft|der federkr*|der feder|"
        "der reibung|des gewichts|du poids|des poids|du ressort|del peso|de los pesos|del resorte|"
        "重力的虚功*|重力所作*|重力所做*|重力作*|重力做*|弹簧力的虚功*|弹性力的虚功*|弹簧力所*|弹性力所*|"
        "摩擦力的虚功*|阻尼力的虚功*");
}

bool begins_condition_of_state(std::string_view words) {
    return has_phrase(last_sentence(words),
                      "if|when|whenever|suppose|falls|wenn|si|cuando|lorsque|quand|若*|如果*|假设*") ||
           ends_with_word(words, {"at", "for", "bei", "für", "para", "pour", "en", "在", "对于", "当"});
}

bool speaks_of_special_case(std::string_view words) {
    return begins_condition_of_state(words) ||
           has_phrase(
               last_sentence(words),
               "si|cuando|caso particular|casos particulares|cas particulier|dans le cas|en el "
               "caso|pour|para|spezialfall|"
               "case 1|case 2|case 3|case 4|case a|case b|case i|case ii|fall 1|fall 2|fall 3|cas 1|cas 2|caso "
               "1|caso 2|"
               "resonance|resonanz|resonancia|résonance|特例*|特别地*|情形*|情况*|共振*|sonderfälle|special "
               "cases|limiting case*|grenzfall*|cas limite|caso límite|"
               "special case|in the case|in case|provided|only for|only if|sonderfall|特殊情形*|特例*|当且仅当*");
}

namespace {

constexpr std::string_view special_motions =
    "steady motion*|steady precession|steady state|stationary motion*|regular precession|"
    "for steady rotation|in steady rotation|at a steady speed|at steady speed|stationär mit|"
    "im stationären zustand|relative equilibrium*|regelmäßige präzession|regelmäßiger "
    "präzession|regulärer präzession|reguläre "
    "präzession|stationäre rotation|稳定转动*|稳定运转*|匀速转动时*|相对平衡*|"
    "conical pendulum|conical motion|circular orbit*|circular motion|sleeping top|kreisbahn*|"
    "stationäre bewegung|kegelpendel|规则进动*|稳态*|定常*|圆锥摆*|圆轨道*|圆周运动*|"
    "movimiento estacionario|stationnaire*|circle of radius|kreis vom radius|kreis mit|on the circle|on a "
    "circle|horizontal circle*|uniform "
    "rotation|steady turn*|constant inclination|"
    "gleichförmige rotation|gleichförmige drehung|stationäre*|horizontalen kreis*|auf dem kreis|précession "
    "régulière|"
    "mouvement stationnaire|régime permanent|mouvement circulaire|pendule conique|orbite circulaire|precesión "
    "regular|precesión estacionaria|régimen permanente|movimiento circular|órbita circular|péndulo cónico|"
    "rotación uniforme|equilibrio relativo|équilibre relatif|relativen gleichgewicht*|relatives "
    "gleichgewicht|relative gleichgewichtslage*|匀速圆周*|稳态进动*|匀速转动*";

/// "circular:" alone before a formula.
bool is_label(std::string_view words) {
    const std::string sentence = trimmed_sentence(words);
    return sentence == "circular" || sentence == "steady";
}

}  // namespace

bool speaks_of_special_motion(std::string_view words) {
    return has_phrase(last_sentence(words), special_motions) || is_label(words);
}

bool mentions_special_motion(std::string_view words) {
    return has_phrase(in_lower_case(words), special_motions) || is_label(words);
}

namespace {

bool is_of_rest(const std::string& sentence) {
    const bool is_of_start = has_phrase(
        sentence,
        "start*|initially|released|remains|not at rest|from rest|desde el reposo|del reposo|du repos|aus der "
        "ruhe|let go|losgelassen|loslassen|soltar|suelta|lâch*|parte "
        "del|inicial*|initial*|由静止*|从静止*|静止开始*|初始*|冲击前*|碰撞前*");
    const bool is_of_place =
        has_phrase(sentence,
                   "from the equilibrium*|from equilibrium|measured*|displacement from*|deviation*|about the "
                   "equilibrium*|为原点*|起*|偏离*|gemessen*|auslenkung*");
    return !is_of_start && !is_of_place &&
           has_phrase(
               sentence,
               "at rest|rests|position of rest|positions of rest|equilibri*|equil|eqm|eq. pos*|rest "
               "position*|gleichgewicht|gleichgewichte|ggl|ruhelage|"
               "posición de equilibrio|en reposo|au repos|position d'équilibre|accelerations zero|principle of "
               "virtual work|静止*|平衡*|虚位移原理*|"
               "虚功原理*|加速度为零*|im gleichgewicht|gleichgewichtslage*|gleichgewichtsbedingung*|ruhelage*|"
               "équilibre");
}

}  // namespace

bool speaks_of_rest(std::string_view words) {
    return is_of_rest(last_sentence(words));
}

bool mentions_rest(std::string_view words) {
    const std::string lower = in_lower_case(words);
    if (has_phrase(lower, "steady motion*|steady state|steady rotation|steadily|稳态*|stationären zustand"))
        return true;
    for (std::size_t begin = 0; begin < lower.size();) {
        const std::size_t end = end_of_first_sentence(lower, begin);
        if (is_of_rest(lower.substr(begin, end - begin))) return true;
        begin = end;
    }
    return false;
}

bool speaks_of_start_from_rest(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "from rest|desde el reposo|del reposo|du repos|sans vitesse initiale|sin velocidad inicial|ohne "
        "anfangsgeschwindigkeit|由静止*|无初速*|at rest initially|initially at rest|aus der ruhe|anfangs in "
        "ruhe|静止开始*|从静止*|"
        "初始静止*|开始静止*|初始时静止*");
}

bool speaks_of_impact(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "after the impact|after impact|right after|impulse gives|blow gives|impact gives|after the "
        "collision|after the blow|after the impulse|just after|"
        "immediately after|juste après|aussitôt après|immédiatement après|après la percussion|après le choc|justo "
        "después|inmediatamente después|tras el impacto|tras la percusión|después del "
        "choque|碰撞结束*|碰撞后*|撞击后*|冲击后*|打击后*|碰撞完*|nach dem stoß|nach dem stoss|"
        "unmittelbar nach");
}

bool mentions_impact(std::string_view words) {
    return speaks_of_impact(words) ||
           has_phrase(in_lower_case(words),
                      "impact*|impulse*|collision*|blow|struck|冲击*|冲量*|碰撞*|撞击*|打击*|stoß*|kraftstoß");
}

bool speaks_of_angular_momentum(std::string_view words) {
    return has_phrase(last_sentence(words), "angular momentum|moment of momentum|drehimpuls*|角动量*|动量矩*");
}

bool explains(std::string_view words) {
    return has_phrase(in_lower_case(words), "where|with|and|wobei|mit|und|其中*|式中*");
}

const char* spoken_energy(std::string_view words) {
    const std::string sentence = trimmed_sentence(words);
    static constexpr std::string_view verbs[] = {
        "", " is", " becomes", " of the system is", " ist", " lautet", "为", "是", "：", "等于"};
    static constexpr std::pair<std::string_view, const char*> names[] = {{"kinetic energy", "T"},
                                                                         {"potential energy", "V"},
                                                                         {"lagrangian", "L"},
                                                                         {"kinetische energie", "T"},
                                                                         {"potentielle energie", "V"},
                                                                         {"potenzielle energie", "V"},
                                                                         {"动能", "T"},
                                                                         {"势能", "V"},
                                                                         {"拉格朗日函数", "L"}};
    for (const auto& [name, letter] : names)
        for (const std::string_view verb : verbs)
            if (sentence.ends_with(std::string(name) + std::string(verb))) return letter;
    return nullptr;
}

bool speaks_of_conservation(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "conserved|conservation|conserves|energy integral|first integral|constant of the motion|constant of "
        "motion|integral of motion|integrating|integrate|integration gives|守恒*|积分*|erhalten|"
        "erhaltung*|erhaltungssatz|integration*|se conserva|conservación*|integrando|se conserve");
}

bool speaks_of_motion_of(std::string_view words, const std::string& name) {
    const std::string sentence = last_sentence(words), lower = in_lower_case(name);
    for (const char* const what :
         {"velocity", "speed", "position", "place", "coordinates", "coordinate", "acceleration"})
        for (const char* const the : {" of the ", " of "})
            if (sentence.find(what + (the + lower)) != std::string::npos) return true;
    return has_phrase(sentence,
                      "the " + lower + " is at|the " + lower + " has the velocity|the " + lower + " moves with");
}

bool speaks_of_frequency(std::string_view words) {
    return has_phrase(in_lower_case(words),
                      "frequenc*|mode|modes|频率*|frequenz*|kreisfrequenz*|eigenfrequenz*|eigenkreisfrequenz*|"
                      "frecuencia*|fréquence*|pulsation*");
}

bool speaks_of_period(std::string_view words) {
    return has_phrase(in_lower_case(words), "period*|周期*|schwingungsdauer|periodo|período|période");
}

bool speaks_of_motion(std::string_view words) {
    return has_phrase(
               last_sentence(words),
               "moves|move|moving|motion|swing|swings|later times|afterwards|then on|sinks|rises|accelerat*|"
               "bewegung|bewegt|schwingung|schwingt|anschließend*|danach|运动时|运动中|运动方程*|摆动*|此后*|"
               "movimiento|mouvement") &&
           !mentions_rest(last_sentence(words));
}

bool names_state_or_mode(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "about the top|upright|inverted|off the axis|relative equilibrium*|in phase|out of phase|antiphase|"
        "in-phase|mode in which|symmetric mode|antisymmetric*|schräge*|gegenphasig*|gleichphasig*|obere*|"
        "偏离*|倒立*|同相*|反相*|最高*");
}

bool speaks_of_axes(std::string_view words) {
    return has_phrase(in_lower_case(words), "axis|axes|achse*|eje|ejes|axe") ||
           words.find("轴") != std::string_view::npos || words.find("坐标系") != std::string_view::npos;
}

bool speaks_of_general_case(std::string_view words) {
    return words.find('#') != std::string_view::npos ||
           has_phrase(
               in_lower_case(words),
               "in general|in the general case|general case|from now on|now let|for all values|different "
               "again|unequal|without "
               "this assumption|for any|ohne diese annahme|verschieden*|一般情况*|若*不同|不同*|一般情形*|一般地*|"
               "allgemein*|im allgemeinen|en general|en général");
}

bool ends_at_place(std::string_view words) {
    return ends_with_word(words,
                          {"lowest point", "highest point", "bottom", "top", "punto más bajo", "punto más alto",
                           "tiefsten punkt", "höchsten punkt", "最低点", "最高点", "point le plus bas"});
}

bool sets_value(std::string_view words) {
    return ends_with_word(words, {"set", "setting", "let", "put", "putting", "with", "mit", "setze", "man setzt",
                                  "haciendo", "poniendo", "en posant", "avec", "con", "令", "设", "取", "and"});
}

bool speaks_of_constraint(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "constraint*|constrained|rolls|rolling|without slipping|without sliding|bound by|约束*|纯滚动*|"
        "无滑动*|zwangsbedingung*|bindung*|rollbedingung*");
}

bool denies(std::string_view words) {
    if (ends_with_word(words, {"not", "nicht", "而不是", "并非"})) return true;
    return has_phrase(
        last_sentence(words),
        "not true that|not correct that|not right that|wrong to write|wrong to say|it is wrong that|"
        "a common mistake*|a frequent mistake*|one might think that|wrongly write*|并不是*|误写*|错写*|"
        "错误地写*|es gilt nicht|nicht richtig|fälschlich*");
}

}  // namespace alembert
