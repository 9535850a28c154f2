// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/judged_equilibria.hpp"

#include <sstream>

#include "stability/stability.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// A value in the parameters as a constant that `--at` reads; nothing if something else is left in it.
std::optional<std::string> constant_text(const Mechanism& m, const Overrides& at, ex value) {
    GiNaC::exmap numbers;
    for (const Mechanism::Parameter& p : m.parameters) {
        numbers[p.symbol] = p.value;
        for (const auto& [name, number] : at)
            if (name == p.symbol.get_name()) numbers[p.symbol] = GiNaC::numeric(cln::rational(cln::cl_DF(number)));
    }
    for (std::size_t round = 0; round <= m.parameters.size(); ++round)
        value = value.subs(numbers, GiNaC::subs_options::no_pattern);
    value = value.normal();
    if (!value.info(GiNaC::info_flags::rational)) return std::nullopt;
    std::ostringstream text;
    text << value;
    return text.str();
}

/// The state as `stability` takes it.
std::optional<StabilityOptions> state_of(const Equilibria& found, const Equilibrium& one,
                                         const EquilibriumOptions& options) {
    const Mechanism& m = found.mechanism;
    StabilityOptions result{.by = options.by, .at = options.at};
    for (const auto& [name, number] : options.at) result.exact_at.emplace_back(name, fmt::format("{}", number));
    for (int i = 0; i < m.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        const std::optional<std::string> text = constant_text(m, options.at, one.exact->value[k]);
        if (!text || one.start.qdot[k] != 0) return std::nullopt;
        const std::string name = m.q[k].get_name();
        for (const std::string& given : {name, name + "'"}) {
            std::erase_if(result.at, [&](const auto& item) { return item.first == given; });
            std::erase_if(result.exact_at, [&](const auto& item) { return item.first == given; });
        }
        result.at.emplace_back(name, one.start.q[k]);
        result.exact_at.emplace_back(name, *text);
        if (!m.speeds.empty()) continue;
        result.at.emplace_back(name + "'", 0);
        result.exact_at.emplace_back(name + "'", "0");
    }
    return result;
}

void judge_exactly(Equilibrium& one, const Scene& scene, const StabilityOptions& state) try {
    const Stability is = stability(scene, state);
    if (is.verdict == StabilityVerdict::undecided) return;
    one.judgement.stable = is.verdict == StabilityVerdict::unstable ? Stable::no : Stable::yes;
    one.judgement.because = is.reason;
    one.judgement.assumed = is.assumed;
} catch (const ModelError&) {  // the first judgement stands
} catch (const IntegrationError&) {
}

}  // namespace

Equilibria judged_equilibria(const Scene& scene, const EquilibriumOptions& options) {
    Equilibria found = equilibria(scene, options);
    for (Equilibrium& one : found.list)
        if (one.judgement.meets && one.exact)
            if (const auto state = state_of(found, one, options)) judge_exactly(one, scene, *state);
    return found;
}

}  // namespace alembert
