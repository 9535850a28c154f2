// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/words.hpp"

#include <algorithm>

#include "check/written/languages.hpp"
#include "check/written/sentences.hpp"

namespace alembert {

bool speaks_of_consequence(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "therefore|hence|so|thus|consequently|it follows|implies|gives|yields|we get|we obtain|"
        "we find|results in|leads to|then|因此*|所以*|故*|得*|于是*|从而*|即*|also|folglich|daher|somit|"
        "deshalb|mithin|demnach|daraus folgt|es folgt|ergibt sich|erhalten wir|erhält man|damit folgt|"
        "donc|d'où|ainsi|par conséquent|par suite|il vient|on obtient|on en déduit|il s'ensuit|on trouve|alors|"
        "luego|por tanto|por lo tanto|por consiguiente|entonces|se obtiene|obtenemos|resulta|se sigue|de donde|"
        "quindi|dunque|perciò|pertanto|allora|si ottiene|ne segue|segue che|da cui|si ricava|otteniamo|risulta|"
        "portanto|assim|então|daí|obtemos|obtém-se|segue que|segue-se|por conseguinte|"
        "zatem|więc|stąd|otrzymujemy|dostajemy|wynika|skąd|wobec tego|"
        "alltså|således|härav|följaktligen|därmed|vi får|man får|det följer|följer att|"
        "следовательно|значит|поэтому|откуда|отсюда|тогда|итак|таким образом|получаем|получим|следует|тем самым|"
        "よって*|したがって*|従って*|ゆえに*|故に*|これより*|すると*|だから*|すなわち*|が得られ*|を得る*");
}

bool says_conserved_is(std::string_view words) {
    const std::string sentence = last_sentence(words);
    return has_phrase(
               sentence,
               "conserved is|conserved quantity|quantity that is conserved|constant of the motion|first integral|"
               "jacobi integral|jacobi's integral|jacobi's function|erhalten ist|erhaltungsgröße|se conserva|"
               "integral primera|intégrale première|守恒量*|首次积分*|第一积分*|"
               "erhalten bleibt|quantité conservée|constante du mouvement|intégrale du mouvement|intégrale de "
               "jacobi|"
               "cantidad conservada|magnitud conservada|constante del movimiento|integral de jacobi|si "
               "conserva|si conservano|"
               "quantità conservata|grandezza conservata|integrale primo|costante del moto|integrale di jacobi|"
               "quantidade conservada|grandeza conservada|constante de movimento|constante do movimento|"
               "wielkość zachowana|wielkością zachowaną|zachowana jest|zachowane jest|całka pierwsza|całką "
               "pierwszą|stała ruchu|"
               "stałą ruchu|bevaras|bevarad storhet|konserverad storhet|rörelsekonstant*|jacobis integral|"
               "сохраняется|сохраняющаяся величина|сохраняющейся величиной|первый интеграл|первым интегралом|"
               "интеграл движения|интегралом движения|интеграл "
               "якоби|保存量*|保存される*|保存する*|第一積分*|運動の定数*|"
               "運動の積分*|ヤコビ積分*") &&
           !has_phrase(sentence, "not|nicht|kein|keine|pas|non|não|nie|inte|ej|не|нет|不*|非*|ない*|ません*") &&
           !(has_phrase(sentence, "no") && !is_portuguese(sentence));
}

bool asserts(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "we have|we get|we find|we obtain|gives|yields|is|are|keep|keeps|hence|thus|therefore|it follows|"
        "gilt|ist|folgt|somit|erhalten wir|ergibt|on a|on trouve|on obtient|donc|il vient|tenemos|"
        "resulta|se obtiene|por tanto|es|si ha|quindi|得*|有|为*|所以*|故*|因此*|"
        "wir erhalten|erhält man|sind|folglich|daher|lautet|haben wir|beträgt|est|sont|d'où|ainsi|on en déduit|"
        "son|obtenemos|hallamos|luego|por lo tanto|se tiene|entonces|è|sono|abbiamo|otteniamo|si ottiene|si "
        "trova|dunque|"
        "risulta|ne segue|vale|dà|é|são|temos|obtemos|obtém-se|tem-se|portanto|segue que|jest|są|mamy|otrzymujemy|"
        "dostajemy|zatem|więc|stąd|wynosi|wynoszą|är|vi har|har vi|får vi|vi får|man "
        "får|alltså|således|därför|gäller|"
        "имеем|имеет вид|имеют "
        "вид|получаем|получим|находим|следовательно|значит|отсюда|откуда|равен|равна|равно|равны|"
        "есть|составляет|даёт|дает|тогда|である*|となる*|になる*|が成り立つ*|与えられ*|求まる*|求められ*|よって*|"
        "したがって*|"
        "従って*|ゆえに*|エネルギーは*|方程式は*|振動数は*|加速度は*|速度は*|張力は*|周期は*|運動量は*");
}

bool speaks_of_other_system(std::string_view words) {
    const std::string sentence = last_sentence(words);
    if (has_phrase(sentence, "若*|如果*|假如*") && has_phrase(sentence, "改为*|换成*|换为*")) return true;
    const bool is_asked =
        has_phrase(sentence, "if|when|suppose|wenn|falls|man|si|s'il|se|om|jeśli|gdy|если|если бы");
    if (is_asked && has_phrase(sentence,
                               "is replaced|are replaced|ersetzt*|est remplac*|sont remplac*|se reemplaza*|se "
                               "sustituye*|viene sostituit*|è sostituit*|for substituíd*|é substituíd*|"
                               "zastąp*|ersätts|заменить|заменяется|заменён*"))
        return true;
    return has_phrase(
        sentence,
        "were replaced|than that of|longer than for|shorter than for|würde man|"
        "si l'on remplace|si se reemplaza|se si sostituisce|"
        "analogous|analogue|kepler problem|kepler-problem|keplerproblem|problème de kepler|problema de "
        "kepler|开普勒问题*|in contrast to|unlike|im gegensatz zu*|contrairement à|a diferencia de|"
        "kepler-probleme*|im unterschied zu*|anders als beim*|à la différence d*|contrairement au|contrairement "
        "aux|"
        "a diferencia del|en contraste con|problema di keplero|a differenza d*|diversamente da*|ao contrário d*|"
        "diferentemente d*|em contraste com|zagadnienie keplera|zagadnieniu keplera|zagadnienia keplera|"
        "w przeciwieństwie do|w odróżnieniu od|keplers problem|till skillnad från|i motsats till|"
        "задача кеплера|задаче кеплера|задачи кеплера|в отличие от|ケプラー問題*|とは異なり*|と違って*|とは違い*");
}

bool speaks_of_effective_potential(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "effective potential*|effective one-dimensional potential|effektive potential*|effektives "
        "potential|effektiven potential*|potentiel effectif|potencial efectivo|potentiel effective|"
        "有效势*|等效势*|"
        "effektives potenzial|effektive potenzial*|effektiven potenzial*|effektivpotential*|effektivpotenzial*|"
        "effektive potentielle energie|effektiver potential*|énergie potentielle effective|potentiel efficace|"
        "énergie potentielle efficace|potencial eficaz|energía potencial efectiva|energía potencial eficaz|"
        "potenziale efficace|potenziale effettivo|energia potenziale efficace|energia potenziale effettiva|"
        "potencial efetivo|energia potencial efetiva|potencjał efektywny|potencjału efektywnego|potencjałem "
        "efektywnym|"
        "potencjale efektywnym|efektywny potencjał|efektywnego potencjału|efektywna energia potencjalna|"
        "effektiv potential*|effektiva potential*|effektiv potentiell energi|effektiva potentiella energi*|"
        "эффективный потенциал|эффективного потенциала|эффективном потенциале|эффективным потенциалом|"
        "эффективная потенциальная энергия|эффективной потенциальной энерги*|эффективную потенциальную энергию|"
        "有効ポテンシャル*|実効ポテンシャル*|有効位置エネルギー*");
}

bool speaks_of_turning_axes(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "rotating frame|rotating axes|turning axes|turning frame|moving axes|body axes|body-fixed|co-rotating|"
        "mitrotierend*|rotierenden system|drehenden achsen|körperfest*|repère tournant|référentiel "
        "tournant|axes mobiles|ejes móviles|ejes giratorios|sistema "
        "giratorio|转动参考系*|动坐标系*|动系*|随体*|连体*|"
        "mitbewegt*|rotierende system|rotierendes system|rotierenden bezugssystem*|rotierendes bezugssystem|"
        "drehende achsen|bewegten achsen|référentiel en rotation|repère en rotation|axes tournants|repère mobile|"
        "repère lié au|axes liés au|sistema rotante|ejes rotantes|ejes solidarios|sistema en rotación|ejes del "
        "cuerpo|"
        "ejes ligados al cuerpo|ejes fijos al cuerpo|riferimento rotante|assi mobili|assi rotanti|assi solidali|"
        "terna mobile|terna solidale|sistema mobile|referencial girante|referencial em rotação|sistema girante|"
        "sistema em rotação|eixos móveis|eixos girantes|eixos do corpo|solidários ao corpo|solidário ao corpo|"
        "układ obracając*|układzie obracając*|obracającym się układ*|układ wirujący|układzie wirującym|"
        "wirującym układzie|osie ruchome|osiach ruchomych|układ ruchomy|układzie ruchomym|związanym z ciałem|"
        "związane z ciałem|związany z ciałem|związanych z ciałem|roterande system*|roterande koordinat*|"
        "roterande referens*|medroterande|kroppsfast*|kroppsfix*|rörliga axlar|вращающейся систем*|вращающаяся "
        "систем*|"
        "вращающуюся систем*|вращающихся осях|вращающихся осей|вращающиеся оси|подвижной систем*|подвижная "
        "систем*|"
        "подвижные оси|подвижных осях|подвижных осей|связанных с телом|связанной с телом|связанные с телом|"
        "связанная с телом|回転系*|回転座標*|動座標*|運動座標系*|物体座標*|物体固定*|回転する座標*");
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
        "摩擦力的虚功*|阻尼力的虚功*|"
        "der federn|des dämpfers|der dämpfung|des motors|der reibungskr*|de la pesanteur|de la gravité|des "
        "ressorts|"
        "de l'amortisseur|du frottement|des frottements|du moteur|de la force de rappel|de la gravedad|del muelle|"
        "de los resortes|de los muelles|del amortiguador|del rozamiento|de la fricción|de la fuerza elástica|del "
        "motor|"
        "dei pesi|della gravità|della forza peso|della molla|delle molle|dello smorzatore|dell'attrito|"
        "della forza elastica|del motore|do peso|dos pesos|da gravidade|da força peso|da mola|das molas|"
        "do amortecedor|do atrito|da força elástica|do motor|praca siły ciężkości|praca sił ciężkości|"
        "pracę siły ciężkości|praca ciężaru|praca sprężyny|praca siły sprężystości|praca siły tarcia|praca tarcia|"
        "od siły ciężkości|od sprężyny|od "
        "tłumika|tyngdkraftens|tyngdernas|fjäderns|fjäderkraftens|fjädrarnas|dämparens|"
        "friktionens|friktionskraftens|av tyngdkraften|av fjädern|av friktionen|силы тяжести|сил тяжести|силы "
        "упругости|"
        "сил упругости|силы трения|сил трения|от пружины|от демпфера|работа веса|работа пружины|"
        "重力の仮想仕事*|重力の仕事*|重力による*|重力のする*|重力がする*|ばねの仮想仕事*|ばねの仕事*|ばねによる*|"
        "弾性力の仮想仕事*|弾性力の仕事*|"
        "弾性力による*|摩擦力の仕事*|摩擦力による*|摩擦による*|減衰力の仕事*|減衰力による*");
}

bool asserts_force_function(std::string_view words) {
    const std::string sentence = in_lower_case(last_sentence(words));
    if (denies(words) ||
        has_phrase(sentence,
                   "not|no|without|nicht|keine|pas|sans|non|senza|não|sem|nie|inte|не|без|不*|没有*|无*"))
        return false;
    return has_phrase(
        sentence,
        "force function|force-function|work function|kräftefunktion|kraftfunktion|fonction de force|"
        "fonction de forces|fonction des forces|función de fuerza|función de fuerzas|funzione delle forze|"
        "funzione di forza|função de força|função das forças|funkcja sił|kraftfunktionen|силовая функция|"
        "силовой функции|силовую функцию|力函数*|力関数*");
}

bool speaks_of_inertia(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "moment of inertia|moments of inertia|rotational inertia|inertia about|trägheitsmoment*|"
        "massenträgheit*|转动惯量*|惯性矩*|moment d'inertie|moments d'inertie|momento de inercia|momento "
        "d'inerzia|momento di inerzia|momento de inércia|moment bezwładności|tröghetsmoment*|момент "
        "инерции|моменты инерции|моментом инерции|慣性モーメント*");
}

bool speaks_of_solution(std::string_view words) {
    return has_phrase(last_sentence(words),
                      "solution*|lösung*|lösen|solución*|soluzion*|solução|soluções|решени*|rozwiązani*|lösning*|"
                      "解为*|特解*|通解*|的解*|解は*|特殊解*|一般解*");
}

bool speaks_of_angular_momentum(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "angular momentum|moment of momentum|drehimpuls*|角动量*|动量矩*|"
        "drall|dralls|drallsatz*|moment cinétique|moments cinétiques|momento angular|momento cinético|"
        "momento angolare|momenti angolari|momento della quantità di moto|quantidade de movimento angular|moment "
        "pędu|"
        "momentu pędu|momentem pędu|kręt|krętu|krętem|rörelsemängdsmoment*|impulsmoment*|момент импульса|"
        "момента импульса|моментом импульса|кинетический момент|кинетического момента|кинетическим моментом|"
        "момент количества движения|момента количества движения|角運動量*");
}

bool explains(std::string_view words) {
    return has_phrase(in_lower_case(words),
                      "where|with|and|wobei|mit|und|其中*|式中*|où|avec|et|donde|siendo|dove|onde|sendo|gdzie|"
                      "oraz|där|med|och|где|причём|и|ここで*|ここに*|ただし*");
}

namespace {

constexpr std::string_view verbs_of_energies[] = {"",
                                                  " is",
                                                  " becomes",
                                                  " of the system is",
                                                  " ist",
                                                  " lautet",
                                                  "为",
                                                  "是",
                                                  "：",
                                                  "等于",
                                                  " beträgt",
                                                  " des systems ist",
                                                  " est",
                                                  " vaut",
                                                  " s'écrit",
                                                  " du système est",
                                                  " du système",
                                                  " es",
                                                  " vale",
                                                  " del sistema es",
                                                  " del sistema",
                                                  " è",
                                                  " del sistema è",
                                                  " é",
                                                  " do sistema é",
                                                  " do sistema",
                                                  " wynosi",
                                                  " jest",
                                                  " ma postać",
                                                  " układu wynosi",
                                                  " układu",
                                                  " är",
                                                  " blir",
                                                  " systems är",
                                                  " равна",
                                                  " имеет вид",
                                                  " системы",
                                                  " системы равна",
                                                  " системы имеет вид",
                                                  "は",
                                                  "が"};
constexpr std::pair<std::string_view, const char*> names_of_energies[] = {{"kinetic energy", "T"},
                                                                          {"potential energy", "V"},
                                                                          {"lagrangian", "L"},
                                                                          {"kinetische energie", "T"},
                                                                          {"potentielle energie", "V"},
                                                                          {"potenzielle energie", "V"},
                                                                          {"动能", "T"},
                                                                          {"势能", "V"},
                                                                          {"拉格朗日函数", "L"},
                                                                          {"lagrangefunktion", "L"},
                                                                          {"lagrange-funktion", "L"},
                                                                          {"énergie cinétique", "T"},
                                                                          {"énergie potentielle", "V"},
                                                                          {"lagrangien", "L"},
                                                                          {"energía cinética", "T"},
                                                                          {"energía potencial", "V"},
                                                                          {"lagrangiano", "L"},
                                                                          {"lagrangiana", "L"},
                                                                          {"energia cinetica", "T"},
                                                                          {"energia potenziale", "V"},
                                                                          {"energia cinética", "T"},
                                                                          {"energia potencial", "V"},
                                                                          {"energia kinetyczna", "T"},
                                                                          {"energia potencjalna", "V"},
                                                                          {"lagranżjan", "L"},
                                                                          {"funkcja lagrange'a", "L"},
                                                                          {"kinetiska energin", "T"},
                                                                          {"rörelseenergin", "T"},
                                                                          {"potentiella energin", "V"},
                                                                          {"lägesenergin", "V"},
                                                                          {"lagrangefunktionen", "L"},
                                                                          {"кинетическая энергия", "T"},
                                                                          {"потенциальная энергия", "V"},
                                                                          {"лагранжиан", "L"},
                                                                          {"функция лагранжа", "L"},
                                                                          {"運動エネルギー", "T"},
                                                                          {"位置エネルギー", "V"},
                                                                          {"ポテンシャルエネルギー", "V"},
                                                                          {"ラグランジアン", "L"},
                                                                          {"ラグランジュ関数", "L"}};

/// "Las derivadas del lagrangiano": what is named there belongs to the noun before it.
bool is_genitive(std::string_view before) {
    static constexpr std::string_view of[] = {" del ",   " de la ", " de l'", " du ",
                                              " della ", " dell'",  " da ",   " do "};
    return std::any_of(std::begin(of), std::end(of), [&](std::string_view one) { return before.ends_with(one); });
}

}  // namespace

const char* spoken_energy(std::string_view words) {
    const std::string sentence = trimmed_sentence(words);
    for (const auto& [name, letter] : names_of_energies)
        for (const std::string_view verb : verbs_of_energies) {
            const std::string said = std::string(name) + std::string(verb);
            if (sentence.ends_with(said) &&
                !is_genitive(std::string_view(sentence).substr(0, sentence.size() - said.size())))
                return letter;
        }
    return nullptr;
}

bool speaks_of_conservation(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "conserved|conservation|conserves|energy integral|first integral|constant of the motion|constant of "
        "motion|integral of motion|integrating|integrate|integration gives|守恒*|积分*|erhalten|"
        "erhaltung*|erhaltungssatz|integration*|se conserva|conservación*|integrando|se conserve|"
        "energieintegral|energiesatz|drehimpulssatz|integrier*|conservé|conservée|conservés|conservées|se "
        "conservent|"
        "intégrale première|intégrale de l'énergie|intégrale du mouvement|constante du mouvement|en intégrant|"
        "intégration|se conservan|conservada|conservado|constante del movimiento|integral primera|integral de la "
        "energía|"
        "integramos|integración|si conserva|si conservano|conservazione|conservata|conservato|integrale primo|"
        "integrale dell'energia|costante del moto|integrazione|conserva-se|conservação|integral de energia|"
        "constante de movimento|constante do movimento|integração|zachowana|zachowany|zachowane|zachowania "
        "energii|"
        "zachowania pędu|zachowania krętu|zasada zachowania|zasady zachowania|całka pierwsza|całka "
        "energii|całkując|"
        "całkowani*|stała "
        "ruchu|bevaras|bevarad*|bevarande*|konserver*|energiintegral*|rörelsekonstant*|integrera*|"
        "сохраняется|сохраняются|сохранени*|сохраняющ*|интеграл энергии|первый интеграл|интеграл движения|"
        "интеграл площадей|интегрируя|интегрируем|интегрировани*|проинтегрир*|保存*|第一積分*|運動の定数*|積分*");
}

bool speaks_of_motion_of(std::string_view words, const std::string& name) {
    const std::string sentence = last_sentence(words), lower = in_lower_case(name);
    for (const char* const what :
         {"velocity", "speed", "position", "place", "coordinates", "coordinate", "acceleration"})
        for (const char* const the : {" of the ", " of "})
            if (sentence.find(what + (the + lower)) != std::string::npos) return true;
    for (const char* const what :
         {"geschwindigkeit", "lage",           "beschleunigung", "koordinaten",    "vitesse",     "position",
          "accélération",    "coordonnées",    "velocidad",      "posición",       "aceleración", "coordenadas",
          "velocità",        "posizione",      "accelerazione",  "coordinate",     "velocidade",  "posição",
          "aceleração",      "prędkość",       "położenie",      "przyspieszenie", "współrzędne", "hastigheten",
          "läget",           "accelerationen", "koordinaterna",  "скорость",       "положение",   "ускорение",
          "координаты"})
        for (const char* const the : {" ", " von ", " der ", " des ", " de ", " de la ", " du ", " de l'", " del ",
                                      " di ", " della ", " dell'", " do ", " da ", " av ", " för ", " hos "})
            if (has_phrase(sentence, what + (the + lower))) return true;
    for (const char* const what :
         {"的速度", "的位置", "的坐标", "的加速度", "の速度", "の位置", "の座標", "の加速度"})
        if (sentence.find(lower + what) != std::string::npos) return true;
    return has_phrase(sentence,
                      "the " + lower + " is at|the " + lower + " has the velocity|the " + lower + " moves with");
}

bool speaks_of_frequency(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "frequenc*|mode|modes|频率*|frequenz*|kreisfrequenz*|eigenfrequenz*|eigenkreisfrequenz*|"
        "frecuencia*|fréquence*|pulsation*|"
        "eigenschwingung*|eigenform*|winkelfrequenz*|resonanzfrequenz*|pulsación*|pulsaciones|modo normal|"
        "modos normales|modo propio|modos propios|pulsazion*|modo normale|modi normali|frequência*|modos normais|"
        "częstoś*|częstotliwoś*|drgania własne|drgań własnych|pulsacj*|frekvens*|egenfrekvens*|vinkelfrekvens*|"
        "egenvinkelfrekvens*|resonansfrekvens*|egensvängning*|egenmod*|частот*|нормальные колебани*|"
        "нормальных колебани*|собственные колебани*|собственных "
        "колебани*|振動数*|角振動数*|周波数*|基準振動*|固有振動*|"
        "固有モード*|振動モード*");
}

bool speaks_of_period(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "period*|周期*|schwingungsdauer|periodo|período|période|"
        "periodendauer|schwingungszeit|umlaufzeit*|umlaufdauer|périodes|períodos|okres|okresu|okresem|okresie|"
        "svängningstid*|omloppstid*|период*");
}

bool speaks_of_axes(std::string_view words) {
    return has_phrase(in_lower_case(words),
                      "axis|axes|achse*|eje|ejes|axe|koordinatenachse*|asse|assi|eixo|eixos|oś|osi|osie|osią|"
                      "osiami|axel|axeln|axlar|axlarna|ось|оси|осью|осей|осям|осями|осях") ||
           words.find("轴") != std::string_view::npos || words.find("坐标系") != std::string_view::npos ||
           words.find("軸") != std::string_view::npos || words.find("座標系") != std::string_view::npos;
}

bool speaks_of_constraint(std::string_view words) {
    return has_phrase(
        last_sentence(words),
        "constraint*|constrained|rolls|rolling|without slipping|without sliding|bound by|约束*|纯滚动*|"
        "无滑动*|zwangsbedingung*|bindung*|rollbedingung*|"
        "rollt|rollen|abrollen|ohne zu gleiten|ohne gleiten|ohne schlupf|schlupffrei*|reines rollen|liaison*|"
        "roule|roulent|roulement sans|sans glisser|sans glissement|ligadura*|vínculo*|rueda sin*|ruedan "
        "sin*|rodadura|"
        "sin deslizar|sin deslizamiento|sin resbalar|vincol*|rotola|rotolano|rotolamento|senza strisciare|"
        "senza strisciamento|senza scivolare|rola sem*|rolamento sem*|rolamento puro|sem deslizar|sem "
        "deslizamento|"
        "sem escorregar|restrição|restrições|więzy|więzów|więzami|równanie więz*|toczy się|toczą się|toczeni*|"
        "bez poślizgu|tvång*|rullar|rullning*|rullvillkor*|utan att glida|utan glidning|уравнение связ*|уравнения "
        "связ*|"
        "уравнений связ*|условие связ*|условия связ*|наложена связь|наложены связи|катится|катятся|качени*|"
        "без скольжения|без "
        "проскальзывания|голономн*|неголономн*|拘束*|束縛*|転がり*|転がる*|滑らず*|すべらず*|滑りなし*|"
        "すべりなし*");
}

bool limits_a_condition(std::string_view before, std::string_view behind) {
    static constexpr std::string_view limits =
        "not|never|only|no|cannot|in general|always|because|since|so|hence|thus|therefore|nicht|nie|nur|kein*|"
        "jamais|seulement|ne|no|nunca|solo|sólo|non|mai|não|nie|inte|aldrig|не|никогда|только|不*|没有*|只有*|"
        "并非*|"
        "因为*|所以*|故*|ない*|だけ*";
    const std::string first = in_lower_case(behind.substr(0, end_of_first_sentence(behind, 0)));
    return has_phrase(last_sentence(before), limits) ||
           has_phrase(first, "only|never|not|in general|nur|nie|seulement|jamais|solo|sólo|nunca|только|只*|不*");
}

bool sets_a_condition_behind(std::string_view behind) {
    std::string words = in_lower_case(behind.substr(0, end_of_first_sentence(behind, 0)));
    words.erase(0, std::min(words.find_first_not_of(" ,$"), words.size()));
    static constexpr std::string_view beginnings[] = {
        "gives ", "yields ", "requires ", "happens ", "liefert ", "ergibt ", "donne ", "da ",    "dà ",
        "dá ",    "daje ",   "ger ",      "даёт ",    "дает ",    "得",      "时",     "すると", "より"};
    return std::any_of(std::begin(beginnings), std::end(beginnings),
                       [&](std::string_view beginning) { return words.starts_with(beginning); });
}

bool asks(std::string_view before, std::string_view behind) {
    const std::size_t end = end_of_first_sentence(behind, 0);
    const std::size_t mark = std::min(behind.find('?'), behind.find("？"));
    if (mark >= end + 1) return false;
    std::string sentence = last_sentence(before);
    if (const std::size_t last = sentence.find_last_of("?!"); last != std::string::npos)
        sentence.erase(0, last + 1);
    sentence.erase(0, std::min(sentence.find_first_not_of(" *#>-("), sentence.size()));
    sentence += ' ';
    static constexpr std::string_view beginnings[] = {"does ",       "do ",   "is ",     "are ",
                                                      "can ",        "gilt ", "gelten ", "vale ",
                                                      "est-ce que ", "czy ",  "gäller ", "是否"};
    return std::any_of(std::begin(beginnings), std::end(beginnings),
                       [&](std::string_view beginning) { return sentence.starts_with(beginning); }) ||
           has_phrase(sentence, "and does the|but does the") || ends_with_word(before, {"whether", "ob", "是否"});
}

bool denies(std::string_view words) {
    if (ends_with_word(words, {"not", "nicht", "而不是", "并非", "et non", "y no", "e non", "e não", "a nie",
                               "och inte", "а не"}))
        return true;
    return has_phrase(
        last_sentence(words),
        "not true that|not correct that|not right that|wrong to write|wrong to say|it is wrong that|"
        "a common mistake*|a frequent mistake*|one might think that|wrongly write*|并不是*|误写*|错写*|"
        "错误地写*|es gilt nicht|nicht richtig|fälschlich*|"
        "häufiger fehler|typischer fehler|irrtümlich*|man könnte meinen|falsch wäre|nicht wahr|"
        "n'est pas vrai que|il est faux|erreur fréquente|erreur courante|on pourrait croire|no es cierto que|es "
        "falso que|"
        "no es correcto|error común|error frecuente|erróneamente|se podría pensar|non è vero che|è sbagliato|"
        "non è corretto|errore comune|errore frequente|erroneamente|si potrebbe pensare|não é verdade que|é "
        "errado|"
        "não é correto|erro comum|erro frequente|erroneamente|nie jest prawdą|nieprawdą jest|błędnie|częsty błąd|"
        "częstym błędem|nieprawidłowo|det är fel att|inte sant att|inte riktigt att|vanligt fel|vanligt misstag|"
        "felaktigt|неверно, что|неверно писать|неправильно писать|ошибочно|распространённая "
        "ошибка|распространенная ошибка|"
        "частая ошибка|типичная ошибка|можно было бы подумать|誤って*|よくある間違い*|よくある誤り*|正しくない*");
}

}  // namespace alembert
