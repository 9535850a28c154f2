// SPDX-License-Identifier: GPL-2.0-or-later
// Words for rest, impacts and motions of one kind.

#include "check/written/words.hpp"

#include "check/written/sentences.hpp"

namespace alembert {

namespace {

constexpr std::string_view special_motions =
    "steady motion*|steady precession|steady state|stationary motion*|regular precession|"
    "for steady rotation|in steady rotation|at a steady speed|at steady speed|stationär mit|"
    "im stationären zustand|relative equilibrium*|regelmäßige präzession|regelmäßiger "
    "präzession|regulärer präzession|reguläre "
    "präzession|stationäre rotation|稳定转动*|稳定运转*|匀速转动时*|相对平衡*|"
    "conical pendulum|conical motion|circular orbit*|circular motion|sleeping top|kreisbahn*|"
    "stationäre bewegung|kegelpendel|规则进动*|稳态*|定常*|圆锥摆*|圆轨道*|圆周运动*|"
    "movimiento estacionario|stationnaire*|horizontal circle*|uniform "
    "rotation|steady turn*|constant inclination|"
    "gleichförmige rotation|gleichförmige drehung|stationäre*|horizontalen kreis*|auf dem kreis|précession "
    "régulière|"
    "mouvement stationnaire|régime permanent|mouvement circulaire|pendule conique|orbite circulaire|precesión "
    "regular|precesión estacionaria|régimen permanente|movimiento circular|órbita circular|péndulo cónico|"
    "rotación uniforme|equilibrio relativo|équilibre relatif|relativen gleichgewicht*|relatives "
    "gleichgewicht|relative gleichgewichtslage*|匀速*|稳态进动*|"
    "stationären zustand*|kreisbewegung*|kreisförmige bahn*|kreisförmigen bahn*|kegelbewegung*|"
    "schlafender kreisel|schlafenden kreisel*|précession uniforme|"
    "orbites circulaires|toupie dormante|estado estacionario|precesión uniforme|"
    "órbitas circulares|rotación estacionaria|trompo dormido|peonza dormida|"
    "moto stazionario|moti stazionari|stato stazionario|regime stazionario|precessione regolare|"
    "precessione stazionaria|precessione uniforme|pendolo conico|orbita circolare|orbite circolari|moto circolare|"
    "rotazione stazionaria|equilibrio relativo|movimento estacionário|estado estacionário|"
    "regime estacionário|regime permanente|precessão regular|precessão estacionária|precessão uniforme|"
    "pêndulo cônico|pêndulo cónico|órbitas circulares|equilíbrio relativo|ruch ustalony|"
    "ruchu ustalonym|ruch stacjonarny|ruchu stacjonarnym|stan ustalony|stanie ustalonym|precesja regularna|"
    "precesji regularnej|precesję regularną|wahadło stożkowe|wahadła stożkowego|orbita kołowa|orbicie kołowej|"
    "orbity kołowe|orbity kołowej|ruch po okręgu|ruchu po okręgu|ruch kołowy|ruchu kołowym|"
    "równowaga względna|równowagi względnej|równowadze względnej|śpiący bąk|stationär rörelse|stationära rörelse*|"
    "stationärt tillstånd|stationära tillstånd*|fortvarighet*|regelbunden precession|reguljär precession|"
    "likformig precession|konisk pendel|koniska pendeln|cirkulär bana|cirkulära banor|cirkelbana*|cirkelrörelse*|"
    "relativ jämvikt|sovande snurra|установившемся режим*|установившийся режим|"
    "установившемся движени*|установившееся движени*|установившегося движени*|стационарное движени*|"
    "стационарном движени*|стационарного движени*|стационарные движени*|стационарных движени*|стационарный режим|"
    "стационарном режиме|стационарное вращени*|стационарном вращени*|регулярная прецесси*|регулярной прецесси*|"
    "регулярную прецесси*|конический маятник|конического маятника|коническим маятником|круговая орбит*|"
    "круговой орбит*|круговую орбит*|круговые орбит*|круговых орбит*|круговое движени*|круговом движени*|"
    "движение по окружности|движении по окружности|относительное равновеси*|"
    "относительного равновеси*|относительном равновеси*|спящий волчок|спящего волчка|"
    "規則歳差*|正則歳差*|定常歳差*|円錐振り子*|円錐振子*|円軌道*|円運動*|相対平衡*|相対的なつり合い*|眠りごま*|"
    "眠りコマ*";

/// "On the circle of radius r_0": of one motion, unless the centre of a body moves so in all of them.
bool is_on_circle(const std::string& text) {
    return has_phrase(text,
                      "circle of radius|kreis vom radius|kreis mit|on the circle|on a circle|circunferencia de "
                      "radio") &&
           !has_phrase(text, "centre|center|midpoint|mittelpunkt|schwerpunkt|centro|baricentro");
}

/// "circular:" alone before a formula.
bool is_label(std::string_view words) {
    const std::string sentence = trimmed_sentence(words);
    return sentence == "circular" || sentence == "steady";
}

}  // namespace

bool speaks_of_special_motion(std::string_view words) {
    const std::string sentence = last_sentence(words);
    return has_phrase(sentence, special_motions) || is_on_circle(sentence) || is_label(words);
}

bool mentions_special_motion(std::string_view words) {
    const std::string text = in_lower_case(words);
    return has_phrase(text, special_motions) || is_on_circle(text) || is_label(words);
}

namespace {

bool is_of_rest(const std::string& sentence) {
    const bool is_of_start = has_phrase(
        sentence,
        "start*|initially|released|remains|not at rest|from rest|desde el reposo|del reposo|du repos|aus der "
        "ruhe|let go|losgelassen|loslassen|soltar|suelta|lâch*|parte "
        "del|inicial*|initial*|由静止*|从静止*|静止开始*|初始*|冲击前*|碰撞前*|"
        "zu beginn|anfangs|au départ|abandonné*|partant du|suelto|se suelta|se libera|se abandona|dalla quiete|"
        "da fermo|inizial*|rilasciat*|lasciat*|parte da|do repouso|solto|solta|abandonad*|ze spoczynku|ze stanu "
        "spoczynku|"
        "początk*|puszczon*|puszczamy|rusza|från vila|ur vila|begynnelse*|släpps|från början|börjar|"
        "из состояния покоя|из покоя|начальн*|вначале|в начале|отпущен*|отпуска*|начина*|"
        "静止状態から*|静止から*|初め*|はじめ*|最初*|初期*|手を離*|手を放*|衝突前*");
    const bool is_of_place = has_phrase(
        sentence,
        "from the equilibrium*|from equilibrium|measured*|displacement from*|deviation*|about the "
        "equilibrium*|为原点*|起*|偏离*|gemessen*|auslenkung*|"
        "aus der gleichgewichtslage|mesuré*|à partir de la position d'équilibre|à partir de l'équilibre|écart*|"
        "par rapport à la position d'équilibre|par rapport à l'équilibre|autour de l'équilibre|"
        "autour de la position d'équilibre|medido desde|medida desde|medidos desde|desde la posición de "
        "equilibrio|"
        "desde el equilibrio|alrededor del equilibrio|alrededor de la posición de equilibrio|en torno al "
        "equilibrio|"
        "misurat*|dall'equilibrio|dalla posizione di equilibrio|scostament*|intorno all'equilibrio|"
        "attorno all'equilibrio|intorno alla posizione di equilibrio|attorno alla posizione di equilibrio|"
        "a partir do equilíbrio|a partir da posição de equilíbrio|em torno do equilíbrio|em torno da "
        "posição|desvio*|"
        "em relação à posição de equilíbrio|medido a partir|medida a partir|medidos a partir|od położenia "
        "równowagi|"
        "mierzon*|wychyleni*|odchyleni*|wokół położenia równowagi|względem położenia równowagi|från jämvikt*|mäts "
        "från|"
        "mätt från|avvikelse*|utslag*|kring jämvikt*|omkring jämvikt*|räknat från|räknas från|"
        "от положения равновесия|из положения равновесия|отклонени*|отсчит*|отсчёт*|около положения равновесия|"
        "вблизи положения равновесия|относительно положения равновесия|"
        "位置から*|平衡点から*|平衡点のまわり*|平衡点まわり*|平衡点の周り*|平衡位置のまわり*|からの変位*|"
        "からのずれ*|からの伸び*|を原点*|から測*");
    return !is_of_start && !is_of_place &&
           has_phrase(
               sentence,
               "at rest|rests|position of rest|positions of rest|equilibri*|equil|eqm|eq. pos*|rest "
               "position*|gleichgewicht|gleichgewichte|ggl|ruhelage|"
               "posición de equilibrio|en reposo|au repos|position d'équilibre|accelerations zero|principle of "
               "virtual work|静止*|平衡*|虚位移原理*|"
               "虚功原理*|加速度为零*|im gleichgewicht|gleichgewichtslage*|gleichgewichtsbedingung*|ruhelage*|"
               "équilibre|"
               "in ruhe|ruht|ruhelagen|prinzip der virtuellen arbeit|positions "
               "d'équilibre|équilibres|accélérations nulles|"
               "principe des travaux virtuels|aceleraciones nulas|principio de los trabajos virtuales|in quiete|"
               "posizione di riposo|principio dei lavori virtuali|accelerazioni nulle|equilíbrio*|em repouso|"
               "princípio dos trabalhos virtuais|acelerações nulas|równowag*|równowadze|w "
               "spoczynku|spoczywa|spoczywają|"
               "zasada prac przygotowanych|zasady prac przygotowanych|zasada prac wirtualnych|jämvikt*|i "
               "vila|vilar|viloläge*|"
               "virtuella arbetets princip|равновеси*|в покое|в состоянии покоя|покоится|покоятся|"
               "принцип возможных перемещений|принципу возможных перемещений|принципа возможных перемещений|"
               "принцип виртуальных перемещений|принципу виртуальных перемещений|принципа виртуальных перемещений|"
               "принцип виртуальных работ|つり合*|釣り合*|釣合*|つりあ*|仮想仕事の原理*|加速度がゼロ*|加速度が0*");
}

}  // namespace

bool speaks_of_rest(std::string_view words) {
    return is_of_rest(last_sentence(words));
}

bool mentions_rest(std::string_view words) {
    const std::string lower = in_lower_case(words);
    if (has_phrase(
            lower,
            "steady motion*|steady state|steady rotation|steadily|稳态*|stationären zustand|"
            "stationärer zustand|régime permanent|régime stationnaire|estado estacionario|régimen permanente|"
            "stato stazionario|regime stazionario|moto stazionario|estado estacionário|regime permanente|"
            "movimento estacionário|stan ustalony|stanie ustalonym|ruchu ustalonym|stationärt tillstånd|"
            "stationär rörelse|fortvarighet*|установившемся режим*|установившемся движени*|стационарном режиме|"
            "стационарном движении|定常状態*|定常運動*"))
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
        "初始静止*|开始静止*|初始时静止*|"
        "aus dem stillstand|anfangsgeschwindigkeit null|zu beginn in ruhe|ruht anfangs|vitesse initiale nulle|"
        "initialement au repos|velocidad inicial nula|inicialmente en reposo|dalla quiete|da fermo|"
        "senza velocità iniziale|velocità iniziale nulla|inizialmente in quiete|inizialmente ferm*|do repouso|"
        "sem velocidade inicial|inicialmente em repouso|inicialmente parad*|ze spoczynku|ze stanu spoczynku|"
        "bez prędkości początkowej|zerową prędkością początkową|zerowej prędkości początkowej|początkowo "
        "spoczywa*|"
        "från vila|ur vila|utan begynnelsehastighet|i vila från början|initialt i vila|ursprungligen i vila|"
        "из состояния покоя|из покоя|без начальной скорости|нулевой начальной скорост*|нулевыми начальными "
        "скорост*|"
        "вначале покоил*|первоначально покоил*|в начальный момент "
        "покоил*|初速度0*|初速度ゼロ*|初速0*|初速ゼロ*|初速度なし*|"
        "静止状態から*|静止した状態から*|静止から*|静かに放*|静かに離*|静かに手を*|はじめ静止*|初め静止*|最初静止*"
        "|最初は静止*|はじめは静止*");
}

bool speaks_of_start(std::string_view words) {
    return speaks_of_start_from_rest(words) ||
           has_phrase(
               in_lower_case(words),
               "starts at|started at|is started|released|release|let go|thrown|initially|at the start|at "
               "the beginning|losgelassen|anfangs|anfänglich*|am anfang|zu beginn|lâché*|abandonné*|"
               "initialement|au départ|se suelta|inicialmente|al principio|lasciat*|rilasciat*|inizialmente|"
               "largad*|solt*|no início|puszczon*|początkowo|na początku|släpps|释放*|初始*|开始时*|起始*|"
               "отпуск*|отпущ*|начальн*|в начале|放す*|放した*|初め*|はじめ*|最初*");
}

bool speaks_of_impact(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "after the impact|after impact|right after|impulse gives|blow gives|impact gives|after the "
        "collision|after the blow|after the impulse|just after|"
        "immediately after|juste après|aussitôt après|immédiatement après|après la percussion|après le choc|justo "
        "después|inmediatamente después|tras el impacto|tras la percusión|después del "
        "choque|碰撞结束*|碰撞后*|撞击后*|冲击后*|打击后*|碰撞完*|nach dem stoß|nach dem stoss|"
        "unmittelbar nach|"
        "nach dem aufprall|nach dem schlag|nach dem zusammenstoß|nach der kollision|après l'impact|après la "
        "collision|"
        "après l'impulsion|tras el choque|tras la colisión|tras el golpe|después del impacto|después de la "
        "colisión|"
        "después de la percusión|después del golpe|dopo l'urto|dopo la percussione|dopo l'impatto|dopo la "
        "collisione|"
        "subito dopo|immediatamente dopo|após o choque|após o impacto|após a colisão|após a percussão|após o "
        "impulso|"
        "depois do choque|depois do impacto|depois da colisão|logo após|imediatamente após|po zderzeniu|po "
        "uderzeniu|"
        "tuż po|bezpośrednio po|efter stöten|efter kollisionen|efter slaget|efter impulsen|efter sammanstötningen|"
        "omedelbart efter|strax efter|после удара|после соударения|после столкновения|после толчка|сразу после|"
        "непосредственно после|тотчас "
        "после|衝突後*|衝突直後*|衝突の直後*|衝突の後*|打撃後*|打撃直後*|衝撃後*|撃力の直後*|撃力を受けた直後*|"
        "直後*");
}

bool mentions_impact(std::string_view words) {
    return speaks_of_impact(words) ||
           has_phrase(in_lower_case(words),
                      "impact*|impulse*|collision*|blow|struck|冲击*|冲量*|碰撞*|撞击*|打击*|stoß*|kraftstoß|"
                      "aufprall*|zusammenstoß*|kollision*|schlag|choc|chocs|percussion*|heurt*|choque*|percusión*|"
                      "golpe*|impacto*|"
                      "colisión|colisiones|urto|urti|impatto|impatti|collisione|collisioni|colpit*|colisão|"
                      "colisões|percussão|"
                      "zderze*|zderzy*|uderze*|uderzy*|uderza*|stöt|stöten|stötar|stötens|sammanstöt*|удар|удара|"
                      "удару|ударом|ударе|"
                      "ударяет*|соударен*|столкнов*|толчок|толчка|толчком|толчке|衝突*|撃力*|力積*|衝撃*|打撃*");
}

bool speaks_of_motion(std::string_view words) {
    return has_phrase(
               last_sentence(words),
               "moves|move|moving|motion|swing|swings|later times|afterwards|then on|sinks|rises|accelerat*|"
               "bewegung|bewegt|schwingung|schwingt|anschließend*|danach|运动时|运动中|运动方程*|摆动*|此后*|"
               "movimiento|mouvement|"
               "bewegen|bewegungen|pendelt|pendeln|beschleunigt|se déplace|se meut|se "
               "déplacent|oscille|oscillent|accélère|"
               "se mueve|se mueven|oscila|oscilan|acelera|aceleran|moto|si muove|si "
               "muovono|oscilla|oscillano|accelera|"
               "move-se|se move|se movem|movimento|oscilam|aceleram|porusza się|poruszają "
               "się|ruch|ruchu|ruchem|kołysze się|drga|"
               "drgają|przyspiesza|rör sig|rörelse|rörelsen|rörelseekvation*|svänger|pendlar|accelererar|därefter|"
               "движется|движутся|движени*|колеблется|колеблются|качается|качаются|опускается|поднимается|"
               "ускоряется|"
               "運動する*|運動方程式*|運動中*|運動の間*|動く*|動き*|振れる*|振動する*|揺れる*|その後*|上昇*") &&
           !mentions_rest(last_sentence(words));
}

bool names_state_or_mode(std::string_view words) {
    return has_phrase(
        in_lower_case(words),
        "about the top|upright|inverted|off the axis|relative equilibrium*|in phase|out of phase|antiphase|"
        "in-phase|mode in which|symmetric mode|antisymmetric*|schräge*|gegenphasig*|gleichphasig*|obere*|"
        "偏离*|倒立*|同相*|反相*|最高*|"
        "aufrechte lage|aufrechten lage|in gegenphase|antisymmetrisch*|symmetrische mode|symmetrische "
        "schwingung|en phase|"
        "en opposition de phase|antisymétrique*|mode symétrique|équilibre relatif|en fase|en oposición de fase|"
        "en contrafase|antisimétric*|modo simétrico|equilibrio relativo|in fase|in opposizione di fase|in "
        "controfase|"
        "capovolt*|rovesciat*|antisimmetric*|modo simmetrico|em fase|em oposição de "
        "fase|antissimétric*|equilíbrio relativo|"
        "w fazie|w przeciwfazie|odwrócon*|antysymetryczn*|górne położeni*|górnym położeni*|górnego położeni*|"
        "i fas|i motfas|upprättstående|antisymmetrisk*|symmetrisk mod|övre läge*|övre jämvikt*|relativ jämvikt*|"
        "в фазе|в противофазе|перевёрнут*|перевернут*|опрокинут*|антисимметричн*|кососимметричн*|"
        "относительное равновеси*|относительного равновеси*|верхнее положени*|верхнем положени*|верхнего "
        "положени*|"
        "同位相*|逆位相*|逆相*|反対称*|対称モード*|最高点*|逆さ*");
}

bool ends_at_place(std::string_view words) {
    return ends_with_word(words, {"lowest point",
                                  "highest point",
                                  "bottom",
                                  "top",
                                  "punto más bajo",
                                  "punto más alto",
                                  "tiefsten punkt",
                                  "höchsten punkt",
                                  "最低点",
                                  "最高点",
                                  "point le plus bas",
                                  "point le plus haut",
                                  "untersten punkt",
                                  "obersten punkt",
                                  "au sommet",
                                  "punto più basso",
                                  "punto più alto",
                                  "ponto mais baixo",
                                  "ponto mais alto",
                                  "najniższym punkcie",
                                  "najwyższym punkcie",
                                  "najniższym położeniu",
                                  "najwyższym położeniu",
                                  "lägsta punkten",
                                  "högsta punkten",
                                  "lägsta läget",
                                  "högsta läget",
                                  "нижней точке",
                                  "верхней точке",
                                  "низшей точке",
                                  "высшей точке",
                                  "нижнем положении",
                                  "верхнем положении",
                                  "最下点",
                                  "最下点で",
                                  "最下点では",
                                  "最高点",
                                  "最高点で",
                                  "最高点では",
                                  "最低点",
                                  "頂点で",
                                  "頂点では"});
}

}  // namespace alembert
