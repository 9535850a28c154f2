// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/first_order.hpp"

#include <algorithm>
#include <stdexcept>

#include "check/slip.hpp"
#include "model/energy.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double longest = 20000;
constexpr int most_changes = 100;  // of a line that are tried

}  // namespace

bool holds_letters_only(const std::set<std::string>& names, const Scene& scene) {
    return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
        return name == "pi" || std::any_of(scene.parameters.begin(), scene.parameters.end(),
                                           [&](const Parameter& p) { return p.name.text == name; });
    });
}

Expression parsed(const std::string& text) {
    std::vector<Diagnostic> mistakes;
    return parse_expression(text, {}, mistakes);
}

std::vector<std::pair<std::string, Expression>> parsed(const BaseState& base) {
    std::vector<std::pair<std::string, Expression>> result;
    for (const auto& [name, value] : base.values) result.emplace_back(name, parsed(value));
    return result;
}

std::vector<BaseState> base_states(const Scene& scene) {
    BaseState zero, start;
    bool differ = false;
    for (const Coordinate& c : scene.coordinates) {
        const std::string initial = c.initial.text.empty() ? "0" : c.initial.text;
        zero.values.emplace_back(c.name.text, "0");
        start.values.emplace_back(c.name.text, initial);
        differ = differ || initial != "0";
    }
    std::vector<BaseState> result{zero};
    if (differ) result.push_back(start);
    for (BaseState& base : result)
        for (const auto& [name, value] : base.values)
            base.text += (base.text.empty() ? "" : ", ") + name + " = " + value;
    return result;
}

namespace {

/// The expression along deviations of this size, of all coordinates or of these.
ex along_deviations(const ex& residual, const BaseState& base, const GiNaC::symbol& small,
                    const DerivedSystem& system, const std::vector<GiNaC::symbol>* only = nullptr) {
    const Mechanism& m = system.mechanism();
    World world(system.scene(), m, system.sheets());
    GiNaC::exmap near;
    for (int i = 0; i < m.size(); ++i) {
        if (only != nullptr && std::find(only->begin(), only->end(), m.q[i]) == only->end()) continue;
        ex value = 0;
        for (const auto& [name, text] : base.values)
            if (name == m.q[i].get_name()) value = m.z->expand(world.value(text));
        near[m.q[i]] = value + small * m.q[i];
        near[m.qdot[i]] = small * m.qdot[i];
        near[m.qddot[i]] = small * m.qddot[i];
    }
    return m.z->expand(residual).subs(near, GiNaC::subs_options::no_pattern);
}

}  // namespace

bool may_rest(const BaseState& base, const DerivedSystem& system) {
    const Mechanism& m = system.mechanism();
    if (!system.equations().A.empty() || !system.scene().inputs.empty()) return true;
    const GiNaC::symbol small("small");
    for (const ex& force : system.conditions_of_rest()) {
        if (m.z->tree_size(force) > longest || m.z->depends(force, {m.t})) continue;
        const ex there =
            along_deviations(force, base, small, system).subs(small == 0, GiNaC::subs_options::no_pattern);
        if (!is_identically_zero(there, m)) return false;
    }
    return true;
}

bool is_small(const ex& residual, const BaseState& base, int order, bool up_to_constant,
              const DerivedSystem& system) {
    const Mechanism& m = system.mechanism();
    if (m.z->tree_size(residual) > longest) return false;
    const GiNaC::symbol small("small");
    ex along = along_deviations(residual, base, small, system);
    for (int k = 0; k <= order; ++k) {
        const ex at = along.subs(small == 0, GiNaC::subs_options::no_pattern);
        if ((k > 0 || !up_to_constant) && !is_identically_zero(at, m)) return false;
        if (k < order) along = along.diff(small);
    }
    return true;
}

std::optional<WrittenOrder> agree_to_written_order(const ex& left, const ex& right, const BaseState& base,
                                                   const std::vector<GiNaC::symbol>& small,
                                                   const DerivedSystem& system, bool up_to_constant) {
    constexpr int most = 4;
    const Mechanism& m = system.mechanism();
    if (small.empty() || m.z->tree_size(left - right) > longest) return std::nullopt;
    const GiNaC::symbol size("small");
    const auto parts_of = [&](const ex& side) {
        std::vector<ex> parts;
        ex along = along_deviations(side, base, size, system, &small);
        for (int k = 0; k <= most + 1; ++k, along = along.diff(size))
            parts.push_back(along.subs(size == 0, GiNaC::subs_options::no_pattern));
        return parts;
    };
    const std::vector<ex> of_left = parts_of(left), of_right = parts_of(right);
    int order = most + 1;
    while (order > 0 && is_identically_zero(of_right[static_cast<std::size_t>(order)], m)) --order;
    if (order == 0 || order > most) return std::nullopt;
    ex polynomial = 0;
    for (int k = order; k >= 0; --k)
        polynomial += of_left[static_cast<std::size_t>(k)] / GiNaC::factorial(GiNaC::numeric(k));
    for (std::size_t k = up_to_constant ? 1 : 0; k <= static_cast<std::size_t>(order); ++k)
        if (!is_identically_zero(of_left[k] - of_right[k], m)) return WrittenOrder{order, false, polynomial};
    return WrittenOrder{order, true, polynomial};
}

std::optional<ex> linear_part(const ex& residual, const BaseState& base, const DerivedSystem& system) {
    const Mechanism& m = system.mechanism();
    if (m.z->tree_size(residual) > longest) return std::nullopt;
    const GiNaC::symbol small("small");
    const ex along = along_deviations(residual, base, small, system);
    return along.diff(small).subs(small == 0, GiNaC::subs_options::no_pattern);
}

std::optional<ex> part_of_first_order(const ex& residual, const BaseState& base, const DerivedSystem& system) {
    const Mechanism& m = system.mechanism();
    if (m.z->tree_size(residual) > longest) return std::nullopt;
    const GiNaC::symbol small("small");
    const ex along = along_deviations(residual, base, small, system);
    const auto at_base = [&](const ex& e) { return e.subs(small == 0, GiNaC::subs_options::no_pattern); };
    return at_base(along) + at_base(along.diff(small));
}

std::optional<CheckedClaim> checked_near(const LineClaim& line, const BaseState& base, const DerivedSystem& system,
                                         const std::map<std::string, ex>& known) {
    LineClaim near = line;
    near.near = base.values;
    try {
        std::vector<CheckedClaim> verdicts = system.check({near}, known);
        if (verdicts.empty() || verdicts[0].verdict == Verdict::undecided) return std::nullopt;
        return std::move(verdicts[0]);
    } catch (const std::exception&) {  // it divides by zero, there or with a letter for another
        return std::nullopt;
    }
}

std::optional<Slip> slip_near(const LineClaim& line, const BaseState& base, const DerivedSystem& system,
                              const std::map<std::string, ex>& known) {
    std::vector<Diagnostic> mistakes;
    Claim claim;
    claim.equation = parse_equality(line.lhs + " = " + line.rhs, {}, mistakes);
    if (!claim.equation.lhs || !claim.equation.rhs) return std::nullopt;
    int left = most_changes;
    const EquationTerms terms = equation_terms(system.mechanism(), system.equations());
    const Judge judge{.is_right =
                          [&](const Claim& changed) {
                              if (--left < 0) return false;
                              const LineClaim other{.lhs = changed.equation.lhs.text,
                                                    .rhs = changed.equation.rhs.text};
                              const auto checked = checked_near(other, base, system, known);
                              return checked && checked->verdict == Verdict::proved;
                          },
                      .vanishes = [](const Expression&) { return false; },
                      .terms = [&]() -> const EquationTerms& { return terms; },
                      .missing = [] { return std::vector<MissingTerm>(); }};
    const auto repair = likely_slip(claim, 0, system.mechanism(), system.equations(), judge);
    return repair ? std::optional(repair->slip) : std::nullopt;
}

}  // namespace alembert
