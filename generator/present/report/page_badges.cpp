// SPDX-License-Identifier: GPL-2.0-or-later
/// What was found, in one line of verdicts at the head of the page; each leads to its section.
#include <algorithm>

#include "base/language/say.hpp"
#include "present/report/agree.hpp"
#include "present/report/page_parts.hpp"

namespace alembert {

namespace {

void badge(std::string& body, const char* section, const std::string& verdict, const std::string& words) {
    put(body, "<li><a class=\"badge {}\" href=\"#{}\">{}</a></li>\n", verdict, section, html(words));
}

void add_freedom(std::string& body, const Overview& all) {
    if (!all.derived.value) return;
    const int freedom = all.derived.value->shown.degrees_of_freedom;
    badge(body, "mechanism", "", say("{} degree{} of freedom", freedom, freedom == 1 ? "" : "s"));
}

void add_claim_count(std::string& body, const Overview& all) {
    if (!all.checked.value) return;
    const std::vector<CheckedClaim>& claims = all.checked.value->checked.claims;
    const auto count = [&](Verdict verdict) {
        return std::count_if(claims.begin(), claims.end(),
                             [&](const CheckedClaim& c) { return c.verdict == verdict; });
    };
    const auto total = static_cast<long>(claims.size());
    if (total == 0) return;
    const long refuted = count(Verdict::refuted), proved = count(Verdict::proved);
    if (refuted > 0)
        badge(body, "claims", "refuted", say("{} of {} claims refuted", refuted, total));
    else if (proved == total)
        badge(body, "claims", "proved",
              total == 1 ? say("the claim is proved") : say("all {} claims proved", total));
    else
        badge(body, "claims", "undecided", say("{} of {} claims proved", proved, total));
}

void add_agreement_of_formalisms(std::string& body, const Overview& all) {
    if (!all.agreed.value || all.agreed.value->derivations.equations.size() < 2) return;
    const Agreement& agreement = all.agreed.value->agreement;
    badge(body, "agreement", name_of(agreement.verdict),
          say("{} formalisms: agreement {}", all.agreed.value->derivations.equations.size(),
              translated(name_of(agreement.verdict))));
}

void add_energy(std::string& body, const Overview& all) {
    if (!all.motion.value || all.motion.value->run.failure) return;
    const Run& run = all.motion.value->run;
    if (run.energy.conserved) badge(body, "run", "proved", say("energy kept to {:.1g}", run.energy.drift));
}

}  // namespace

void add_badges(PageParts& page, const Overview& all) {
    page.body += "<ul class=\"badges\">\n";
    add_freedom(page.body, all);
    add_claim_count(page.body, all);
    add_agreement_of_formalisms(page.body, all);
    add_energy(page.body, all);
    page.body += "</ul>\n";
}

}  // namespace alembert
