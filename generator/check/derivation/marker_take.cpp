// SPDX-License-Identifier: GPL-2.0-or-later
// What a line states is from then on so in the world of the derivation itself.
#include "check/derivation/marker.hpp"

#include <algorithm>

#include "base/language/say.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

bool is_false(LineStatus status) {
    return status == LineStatus::mistake || status == LineStatus::follows;
}

}  // namespace

void Marker::take_in(std::size_t s, std::size_t k) {
    const std::vector<MathPtr>& sides = written_.statements[s].sides;
    const MarkedLine& line = lines.back();
    if (line.status == LineStatus::definition || sides[0]->kind == Kind::variation) return;
    try {
        for (std::size_t j = 0; j <= k; ++j) take_in_as(*sides[j], *sides[k + 1]);
        if (k == 0) take_in_as(*sides[1], *sides[0]);
        const Sides both = sides_of(*sides[k], *sides[k + 1]);
        MotionRow own = system_.rows().row(own_residual(both));
        if (system_.rows().is_identity(own) == true) return;
        const Mechanism& m = system_.mechanism();
        if (is_false(line.status) && !m.z->depends(own.residual, m.qddot))
            own_.add_relation(own.residual, lines.size() - 1);
        own_.add_equation(std::move(own), lines.size() - 1, is_false(line.status),
                          line.status == LineStatus::right_near || heard_.small);
    } catch (const NoMeaning&) {          // a side that has no meaning of its own states nothing
    } catch (const std::domain_error&) {  // nor does one that is divided by zero
    } catch (const std::overflow_error&) {
    }
}

/// L = T − V: the law itself, which states no value.
bool Marker::repeats_law(const Math& value) const {
    std::map<Letter, int> letters;
    collect_letters(value, letters);
    return !letters.empty() && std::all_of(letters.begin(), letters.end(), [&](const auto& item) {
        const auto name = letters_.name_of(item.first);
        return name && quantity_of(item.first) && !letters_.is_of_scene(*name);
    });
}

/// Records what a lone quantity, or a derivative of one, has been said to be.
void Marker::take_in_as(const Math& what, const Math& value) {
    const bool is_name = (what.kind == Kind::letter && what.dots == 0) || what.kind == Kind::applied;
    const bool is_step =
        what.kind == Kind::rate || what.kind == Kind::partial || (what.kind == Kind::letter && what.dots > 0);
    if (!is_name && !is_step) return;
    const ClaimText name = claim_text(what, as_written());
    if (is_name && !known_.contains(name.text)) return;
    if (is_name && quantity_of(what.letter) && repeats_law(value)) return;
    if (what.kind == Kind::letter && is_step && letters_.is_of_scene(*letters_.name_of(what.letter))) return;
    const ClaimText text = claim_text(value, as_derived());
    if (text.names.contains(name.text)) return;
    const ex stated = own_.value(text.text);
    const LineStatus status = lines.back().status;
    const bool up_to = status == LineStatus::right_up_to_constant ||
                       status == LineStatus::right_up_to_derivative || status == LineStatus::right_near;
    MotionRows& rows = system_.rows();
    const ex truth = truth_.value(name.text);
    const bool differs = !up_to && rows.is_identity(rows.row(stated - truth)) != true;
    if (differs && status == LineStatus::right) return;      // d/dt ∂L/∂q' = ∂L/∂q is the law
    if (differs && what.kind != Kind::partial && is_step) {  // p' = Q is an equation of motion, and no step
        const Mechanism& m = system_.mechanism();
        if (!is_false(status) || m.z->depends(truth, m.qddot) != m.z->depends(stated, m.qddot)) return;
    }
    if (is_step && !differs && own_.is_wrong_step(name.text)) return;  // θ' = ∂H/∂p is the law; his H is wrong
    std::optional<std::size_t> wrong;
    if (differs) {
        wrong = is_false(status) ? std::optional(lines.size() - 1) : own_.wrong_in(text.names);
        if (!wrong) wrong = own_.wrong_in({name.text});
        if (!wrong) wrong = lines.size() - 1;
    }
    if (is_name) {
        const ex before = own_.value(name.text);  // J θ'' = b T has determined it, T = m (g + b θ'') states it
        if (differs && is_false(status) && system_.mechanism().z->depends(before, system_.mechanism().qddot))
            own_.add_equation(rows.row(before - stated), lines.size() - 1, true, heard_.small);
        own_.state(name.text, stated, wrong);
        if (what.kind == Kind::letter && what.letter.base == "H")
            hold_momenta(name.text, claim_text(value, as_written()), text, wrong);
    } else
        own_.state_step(name.text, stated, wrong);
    if (differs) count_velocity(what.letter, what.dots, name.text);
    if (what.kind == Kind::rate && what.dots == 1)
        own_.state_rate(own_.value(claim_text(*what.args[0], {.letters = letters_, .steps = &own_.steps()}).text),
                        stated, wrong);
}

}  // namespace alembert
