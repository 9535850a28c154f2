// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/constants.hpp"

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;

GivenConstants::GivenConstants(const Scene& scene, Claims& claims, std::vector<ClaimForm>& forms) {
    const auto of_motion = [&](std::size_t k) { return scene.claims[k].at == Claim::At::motion; };
    const auto open = [&](int o) { return claims.open()[static_cast<std::size_t>(o)]; };
    std::map<int, std::size_t> by;  // open name → the claim that gives it
    std::vector<std::size_t> nonlinear;
    for (std::size_t k = 0; k < forms.size(); ++k) {
        if (forms[k].linear || !of_motion(k)) continue;
        nonlinear.push_back(k);
        for (const int o : forms[k].open)
            for (std::size_t j = 0; j < forms.size() && open(o).constant; ++j)
                if (forms[j].linear && forms[j].open == std::vector<int>{o} && of_motion(j)) by.emplace(o, j);
    }
    Intermediates& z = *claims.mechanism().z;
    for (const auto& [o, j] : by) {
        const GiNaC::symbol constant = open(o).symbol;
        const ex slope = z.pull_back({{forms[j].residual, 1}}, {constant})[0];
        const ex rest = substitute(z, {forms[j].residual}, {{constant, 0}})[0];
        claims.define(constant, z.name(-rest / slope));
    }
    for (const std::size_t k : nonlinear) {
        for (const int o : forms[k].open)
            if (by.contains(o)) rests_on_[k].push_back(by.at(o));
        if (rests_on_.contains(k)) forms[k] = claims.read(scene.claims[k]);
    }
}

void GivenConstants::withdraw(const Scene& scene, std::vector<CheckedClaim>& verdicts) const {
    for (const auto& [k, claims] : rests_on_)
        for (const std::size_t j : claims)
            if (verdicts[j].verdict != Verdict::proved) {
                verdicts[k] = {};
                verdicts[k].reason =
                    say("it is not linear in a constant that only '{}' gives, which is not proved",
                        text_of(scene.claims[j].equation));
            }
}

}  // namespace alembert
