// SPDX-License-Identifier: GPL-2.0-or-later
// Words for what is small, left out, or exact.

#include "check/written/words.hpp"

#include "check/written/languages.hpp"
#include "check/written/sentences.hpp"

namespace alembert {

bool speaks_of_exact_motion(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "exact equation*|the exact|exactly|full equation*|for arbitrary|arbitrary angles|arbitrary motion*|"
        "for large|large motion*|large angle*|large amplitude*|no approximation*|精确*|任意角*|大角度*|"
        "大幅*|exakte*|beliebig*|任意*|große auslenkung*|große winkel*|exacta*|"
        "exakt|exakten|exakter|großen auslenkung*|großer auslenkung*|großen winkel*|ohne näherung*|keine näherung|"
        "équation exacte|équations exactes|exactement|angle quelconque|angles quelconques|mouvement quelconque|"
        "grandes amplitudes|grands angles|sans approximation*|exacto|exactos|exactamente|ángulo arbitrario|"
        "ángulos arbitrarios|ángulo cualquiera|grandes oscilaciones|ángulos grandes|sin aproximar|sin "
        "aproximacion*|"
        "equazione esatta|equazioni esatte|esattamente|angolo qualsiasi|angoli qualsiasi|angoli arbitrari|"
        "grandi oscillazioni|grandi angoli|grandi ampiezze|senza approssimazion*|"
        "equação exata|equações exatas|exatamente|ângulo qualquer|grandes oscilações|ângulos grandes|"
        "ângulos arbitrários|sem aproximaç*|dokładne równani*|dokładnego równania|dokładnych równań|dokładnie|"
        "dowolnego kąta|dowolnych kątów|dużych kątów|dużych wychyleń|dużych amplitud|bez przybliżeń|"
        "exakta|godtycklig vinkel|godtyckliga vinklar|stora vinklar|stora utslag|stora amplituder|utan "
        "approximation*|"
        "точное уравнени*|точного уравнени*|точные уравнени*|точных уравнени*|в точности|произвольных угл*|"
        "произвольном угл*|произвольного угл*|любых угл*|больших угл*|больших отклонени*|больших амплитуд*|"
        "большие колебани*|без приближени*|без "
        "линеаризац*|厳密*|正確な式*|大振幅*|大きな角*|大きい角*|大きな振幅*|近似なし*|近似せず*");
}

namespace {

// "We do not linearize yet", "small oscillations are treated later"
constexpr std::string_view denials_of_first_order =
    "not|without|later|before|will follow|next section|next chapter|in contrast|unlike|nicht|kein*|ohne|"
    "später|bevor|不必*|无需*|不作*|不用*|以后*|未*|尚未*|之前*|下一节*|"
    "pas encore|plus tard|chapitre suivant|section suivante|sans linéaris*|sans approximation*|todavía|aún no|"
    "más adelante|sin linealiz*|sin aproxim*|non lineariz*|non si lineariz*|ancora non|non ancora|più avanti|"
    "senza lineariz*|senza approssim*|ainda não|não lineariz*|não se lineariz*|não são pequen*|não é pequen*|mais "
    "adiante|sem lineariz*|sem aproxim*|jeszcze nie|"
    "nie lineariz*|nie lineary*|nie są małe|nie zakład*|później|bez lineary*|bez przybliż*|inte|ännu|senare|"
    "utan linear*|utan linjär*|utan approximation*|не линеариз*|ещё не|еще не|пока не|не мал*|не предполаг*|"
    "не счита*|позже|в следующ*|без линеаризац*|без приближени*|まだ*|線形化しない*|線形化せず*|近似しない*|"
    "近似せず*|後で*|次節*|次章*|小さくない*";
constexpr std::string_view phrases_of_first_order =
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
    "pequeñas*|ángulos pequeños|"
    "kleinen winkel*|kleiner winkel*|kleinen schwingung*|kleiner schwingung*|kleine amplitude*|kleinen amplitude*|"
    "kleine bewegung*|kleinen bewegung*|kleine störung*|kleinen störung*|kleinwinkel*|in erster ordnung|"
    "terme erster ordnung|glieder erster ordnung|höherer ordnung|lineare näherung|linearer näherung|"
    "nahe der gleichgewichtslage|um die gleichgewichtslage|"
    "au premier ordre|ordre supérieur|ordres supérieurs|approximation linéaire|faible amplitude|"
    "faibles amplitudes|faibles oscillations|au voisinage de l'équilibre|près de l'équilibre|"
    "autour de l'équilibre|autour de la position d'équilibre|"
    "pequeños movimientos|pequeños desplazamientos|pequeña amplitud|amplitud pequeña|a primer orden|primer orden "
    "en|"
    "términos de primer orden|orden superior|órdenes superiores|cerca del equilibrio|alrededor del equilibrio|"
    "alrededor de la posición de equilibrio|en torno al equilibrio|desplazamientos pequeños|"
    "oscillazioni piccole|piccoli angoli|angoli piccoli|piccole rotazioni|piccoli spostamenti|piccoli moti|"
    "piccola ampiezza|piccole ampiezze|piccole perturbazioni|piccole deviazioni|piccoli scostamenti|"
    "al primo ordine|ordine superiore|ordini superiori|approssimazione lineare|vicino all'equilibrio|"
    "intorno all'equilibrio|attorno all'equilibrio|intorno alla posizione di equilibrio|"
    "attorno alla posizione di equilibrio|nell'intorno dell'equilibrio|"
    "oscilações pequenas|pequenos ângulos|ângulos pequenos|pequenos movimentos|pequenos deslocamentos|"
    "pequena amplitude|pequenas amplitudes|pequenos desvios|pequenas vibrações|pequenas perturbações|"
    "em primeira ordem|até primeira ordem|ordem superior|ordens superiores|aproximação linear|"
    "em torno do equilíbrio|em torno da posição de equilíbrio|próximo ao equilíbrio|"
    "małe drgania|małych drgań|małe oscylacje|małych oscylacji|małe kąty|małych kątów|małego kąta|małe wychylenia|"
    "małych wychyleń|małych ruchów|małych amplitud|małej amplitud*|kąt jest mały|kąty są małe|dla małych|"
    "przy małych|lineary*|zlineary*|przybliżeniu liniowym|przybliżenie liniowe|wyrazy pierwszego rzędu|"
    "do pierwszego rzędu|wyższego rzędu|wyższych rzędów|w pobliżu położenia równowagi|blisko położenia równowagi|"
    "små svängningar*|små vinklar*|liten vinkel|litet utslag|små utslag*|små rörelser*|små avvikelser*|"
    "små vibrationer*|små störningar*|små förskjutningar*|liten amplitud|små amplituder|för små|vid små|linjäris*|"
    "till första ordning*|högre ordning*|linjär approximation|nära jämvikt*|kring jämvikt*|omkring jämvikt*|"
    "малые колебани*|малых колебани*|малым колебани*|малыми колебани*|малые угл*|малых угл*|малыми угл*|"
    "малым угл*|малые отклонени*|малых отклонени*|малым отклонени*|малых смещени*|малых амплитуд*|"
    "малой амплитуд*|малые движени*|малых движени*|малых возмущени*|угол мал|углы малы|малости|при малых|"
    "при малом|при малой|для малых|считая малым*|линеариз*|линейном приближени*|линейное приближени*|"
    "первом приближени*|с точностью до первого порядка|члены первого порядка|членов первого порядка|"
    "высших порядков|высшего порядка|около положения равновесия|вблизи положения равновесия|вблизи равновесия|"
    "в окрестности положения равновесия|"
    "が小さい*|が小さく*|十分小さ*|小さな振動*|小さい振動*|小さな角*|小さい角*|線形化*|線型化*|線形近似*|線型近似*"
    "|1次近似*|一次の項*|1次の項*|"
    "一次の微小*|1次まで*|一次まで*|高次の*|2次以上*|二次以上*|平衡点の近く*|平衡点近傍*|平衡点の近傍*";

}  // namespace

namespace {

/// "Small θ:", "Now small theta (cos θ ~ 1)", with a letter and no thing behind it.
bool is_small_alone(const std::string& sentence) {
    constexpr std::size_t longest_letter = 7;  // "theta1"
    static constexpr std::string_view words[] = {"small",   "kleine",  "kleines", "petit", "petits", "pequeño",
                                                 "piccolo", "piccoli", "małe",    "малые", "малое",  "små"};
    std::string head = sentence.substr(0, sentence.find('('));
    head.erase(head.find_last_not_of(" :,") + 1);
    const std::size_t last = head.rfind(' ');
    const std::string before = last == std::string::npos ? "" : head.substr(0, last);
    const bool has_letter = head.size() - (last == std::string::npos ? 0 : last + 1) <= longest_letter;
    return std::any_of(std::begin(words), std::end(words), [&](std::string_view word) {
        const auto ends_so = [&](const std::string& text) {
            return text == word || text.ends_with(' ' + std::string(word));
        };
        return ends_so(head) || (has_letter && ends_so(before));
    });
}

}  // namespace

bool denies_limit(std::string_view sentence) {
    return has_phrase(
        in_lower_case(sentence),
        "no approximation*|without approximation*|without any approximation*|no assumption*|not assume*|not made|"
        "need not be|not necessarily|even as|even for|even if|ohne näherung*|ohne eine näherung|keine näherung*|"
        "nicht voraus*|nicht angenommen|sans approximation*|sans hypothèse*|sin aproxim*|senza approssim*|"
        "sem aproxim*|bez przybliż*|utan approximation*|utan antagande*|без приближени*|近似しない*|近似せず*|"
        "不作近似*|不作任何近似*|无需近似*|没有近似*|未作近似*");
}

bool speaks_of_first_order(std::string_view words) {
    const std::string lower = in_lower_case(words);
    for (std::size_t begin = 0; begin < lower.size();) {
        const std::size_t end = end_of_first_sentence(lower, begin);
        const std::string sentence = lower.substr(begin, end - begin);
        const bool is_denied = has_phrase(sentence, denials_of_first_order) ||
                               (has_phrase(sentence, "no") && !is_portuguese(sentence));
        if (has_phrase(sentence, phrases_of_first_order) && !is_denied) return true;
        if (is_small_alone(trimmed_sentence(sentence))) return true;
        begin = end;
    }
    return false;
}

bool speaks_of_nearness(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "near|nearly|close to|in the vicinity of|in the neighbourhood of|nahe|in der nähe*|cerca de*|près d*|"
        "perto d*|vicino a*|附近*|"
        "in der umgebung*|au voisinage d*|proche d*|en las proximidades d*|cercano a*|in prossimità "
        "d*|nell'intorno d*|"
        "próximo a*|próximo d*|nas proximidades d*|na vizinhança d*|w pobliżu|blisko|w otoczeniu|nära|i närheten "
        "av|"
        "вблизи|близко к|близок к|близки к|близка к|в окрестности|近傍*|近く*|付近*");
}

bool neglects_terms(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "at the critical*|critical load|im kritischen*|kritischen last|charge critique|carga "
        "crítica|临界*|neglect*|negligible|drop the|dropping|ignore|ignoring|left aside|disregard*|are small|is "
        "small|replaced by "
        "the linear*|fast top|rapid*|vernachlässig*|vernachlaessig*|klein gegen|néglig*|négliger|petit devant|"
        "desprecia*|despreciable*|略去*|忽略*|远小于*|远大于*|很快时*|高速*|"
        "klein gegenüber|klein im vergleich|kritische last|kritischer last|petits devant|petite devant|petites "
        "devant|"
        "faible devant|faibles devant|despreci*|pequeño frente a|trascur*|piccolo rispetto a|piccola rispetto a|"
        "piccoli rispetto a|carico critico|negligenci*|desprez*|pequeno comparado|pequena "
        "comparada|pomij*|pominię*|"
        "pomiń*|zaniedb*|małe w porównaniu|mały w porównaniu|mała w porównaniu|siła krytyczna|obciążenie "
        "krytyczne|"
        "försumm*|försumbar*|bortse från|bortser från|bortser vi från|liten jämfört|litet jämfört|små jämfört|"
        "kritisk last|kritiska last*|snabb snurra|пренебре*|отбрасыв*|отбросим|отбросив|мал по сравнению|"
        "мала по сравнению|мало по сравнению|малы по сравнению|критическая нагрузка|критической нагрузк*|"
        "быстрый волчок|быстрого волчка|быстро "
        "вращающ*|無視*|に比べて小さ*|に比べて十分小さ*|臨界荷重*|高速で回*");
}

bool neglects_gravity(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "without gravity|no gravity|neglecting gravity|neglect gravity|ignoring gravity|in the absence of "
        "gravity|weightless*|ohne schwerkraft|ohne gewichtskraft|schwerelos*|不计重力*|无重力*|忽略重力*|"
        "失重*|sans pesanteur|sans gravité|sin gravedad|en ausencia de gravedad|"
        "ohne gravitation|ohne schwerefeld|schwerefrei*|en l'absence de pesanteur|en l'absence de gravité|"
        "en apesanteur|en négligeant la pesanteur|en négligeant la gravité|sin la gravedad|despreciando la "
        "gravedad|"
        "senza gravità|senza la gravità|in assenza di gravità|trascurando la gravità|sem gravidade|sem a "
        "gravidade|"
        "na ausência de gravidade|ausência da gravidade|desprezando a gravidade|bez grawitacji|bez siły ciężkości|"
        "przy braku grawitacji|w nieważkości|pomijając grawitację|zaniedbując grawitację|pomijając siłę ciężkości|"
        "utan tyngdkraft|utan gravitation|tyngdlös*|försumma tyngdkraften|tyngdkraften försummas|"
        "без силы тяжести|без тяжести|без гравитации|в отсутствие силы тяжести|в отсутствие тяжести|"
        "в отсутствие гравитации|при отсутствии силы тяжести|в невесомости|пренебрегая силой тяжести|"
        "без учёта силы тяжести|без учета силы "
        "тяжести|重力がない*|重力のない*|重力なし*|無重力*|無重量*|重力を無視*");
}

bool neglects_resistance(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "without damping|without friction|without drag|without resistance|undamped|no damping|no friction|"
        "no drag|neglecting friction|neglecting damping|neglecting the friction|neglecting the damping|"
        "neglect friction|neglect damping|ignoring friction|ignoring damping|frictionless|if friction is "
        "neglected|if damping is neglected|ohne dämpfung|ohne reibung|ungedämpft*|reibungsfrei*|reibungslos*|"
        "无阻尼*|不计阻尼*|不计摩擦*|无摩擦*|忽略摩擦*|忽略阻尼*|sans frottement*|sans amortissement|"
        "non amorti*|sin fricción|sin rozamiento|sin amortiguamiento|no amortiguad*|"
        "ohne widerstand|ohne luftwiderstand|dämpfungsfrei*|ohne dämpfer|reibung vernachlässigt|"
        "bei vernachlässigung der reibung|bei vernachlässigung der dämpfung|sans résistance|en l'absence de "
        "frottement*|"
        "en l'absence d'amortissement|en négligeant le frottement|en négligeant les frottements|"
        "en négligeant l'amortissement|sin resistencia|sin amortiguación|despreciando la fricción|"
        "despreciando el rozamiento|despreciando el amortiguamiento|ausencia de fricción|ausencia de rozamiento|"
        "ausencia de amortiguamiento|senza smorzamento|senza attrito|senza attriti|senza resistenza|non smorzat*|"
        "privo di attrito|trascurando l'attrito|trascurando gli attriti|trascurando lo smorzamento|assenza di "
        "attrito|"
        "assenza di smorzamento|sem atrito|sem amortecimento|sem resistência|não amortecid*|desprezando o atrito|"
        "desprezando o amortecimento|ausência de atrito|ausência de amortecimento|bez tarcia|bez tłumienia|bez "
        "oporu|"
        "bez oporów|nietłumion*|pomijając tarcie|pomijając tłumienie|zaniedbując tarcie|zaniedbując tłumienie|"
        "przy braku tarcia|przy braku tłumienia|utan dämpning|utan friktion|utan motstånd|utan "
        "luftmotstånd|odämpad*|"
        "friktionsfri*|friktionslös*|försumma friktion*|försummas friktion*|friktionen försummas|dämpningen "
        "försummas|"
        "без трения|без затухания|без демпфирования|без сопротивления|незатухающ*|недемпфирован*|пренебрегая "
        "трением|"
        "пренебрегая затуханием|пренебрегая сопротивлением|без учёта трения|без учета трения|без учёта "
        "сопротивления|"
        "без учета сопротивления|в отсутствие трения|в отсутствие затухания|в отсутствие сопротивления|"
        "при отсутствии трения|при отсутствии затухания|при отсутствии сопротивления|"
        "減衰がない*|減衰のない*|減衰なし*|無減衰*|非減衰*|不減衰*|減衰を無視*|摩擦がない*|摩擦のない*|摩擦なし*|"
        "摩擦を無視*|抵抗を無視*|抵抗がない*");
}

}  // namespace alembert
