// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/stability.hpp"

#include <cmath>

#include "base/language/say.hpp"
#include "present/report/linearization.hpp"
#include "present/report/modes.hpp"
#include "present/report/page.hpp"

namespace alembert {

namespace {

const char* side_name(RootOf::Side side) {
    switch (side) {
        case RootOf::Side::left:
            return to_say("left");
        case RootOf::Side::axis:
            return to_say("on the axis");
        case RootOf::Side::right:
            return to_say("right");
        case RootOf::Side::unclear:
            return to_say("unclear");
    }
    return "";
}

std::vector<LinearMode> modes_near(const Stability& s) {
    std::vector<std::complex<double>> values;
    for (const RootOf& root : s.eigenvalues) values.push_back(root.value);
    return modes_of(s.A, values);
}

}  // namespace

Json as_json(const Stability& s) {
    Json result;
    result["verdict"] = name_of(s.verdict);
    result["theorem"] = name_of(s.theorem);
    result["reason"] = s.reason;
    result["states"] = s.states;
    result["eigenvalues"] = Json::array();
    result["radii"] = Json::array();
    for (const RootOf& root : s.eigenvalues) {
        result["eigenvalues"].push_back({root.value.real() + 0.0, root.value.imag() + 0.0});
        result["radii"].push_back(root.radius);
    }
    if (s.period > 0) {
        result["period"] = s.period;
        result["period_found"] = s.is_own_period;
        result["floquet"] = Json::array();
        for (const std::complex<double>& rho : s.multipliers)
            result["floquet"].push_back({rho.real(), rho.imag()});
        result["radii"] = s.radii;
        result["start"] = Json::object();
        for (const auto& [name, value] : s.periodic_start) result["start"][name] = value;
    }
    if (s.near) result["modes"] = as_json(modes_near(s), s.states);
    result["certain"] = s.certain;
    if (s.state) result["state"] = name_of(*s.state);
    result["assumed"] = Json::array();
    for (const Assumption& one : s.assumed)
        result["assumed"].push_back({{"kind", name_of(one.kind)}, {"text", one.text}});
    if (s.lyapunov)
        result["lyapunov"] = {
            {"function", s.lyapunov->function}, {"rate", s.lyapunov->rate},
            {"sign", s.lyapunov->sign},         {"rate_sign", s.lyapunov->rate_sign},
            {"set", s.lyapunov->set},           {"method", s.lyapunov->sampled ? "sampled" : "exact"},
            {"samples", s.lyapunov->samples}};
    result["conditions"] = s.conditions;
    result["conditions_for"] = s.conditions_for;
    result["coefficients"] = s.coefficients;
    if (!s.routh.empty()) result["routh"] = s.routh;
    if (s.near) {
        const Json linear = as_json(*s.near);
        for (const char* key : {"motion", "moving", "reached", "coordinates", "rates", "matrices"})
            if (linear.contains(key)) result[key] = linear[key];
        Json rows = Json::array();
        for (Eigen::Index i = 0; i < s.A.rows(); ++i) {
            rows.push_back(Json::array());
            for (Eigen::Index j = 0; j < s.A.cols(); ++j) rows.back().push_back(s.A(i, j) + 0.0);
        }
        result["matrices"]["A"] = std::move(rows);
    }
    return result;
}

std::string as_text(const Stability& s, bool with_modes) {
    std::string page;
    if (!s.title.empty()) put(page, "{}\n\n", s.title);
    if (s.near) page += words_of_reached(*s.near);
    say_on(page, "{}: {}.\n", translated(name_of(s.verdict)), s.reason);
    if (s.theorem != StabilityTheorem::none) say_on(page, "By: {}\n", translated(name_of(s.theorem)));
    for (const Assumption& one : s.assumed) say_on(page, "Not proved: {}\n", one.text);
    if (!s.states.empty())
        say_on(page, "With respect to {}{}\n", fmt::join(s.states, ", "),
               s.near && !s.near->matrices.cyclic.empty()
                   ? say(" (not {}, which nothing depends on)", fmt::join(s.near->matrices.cyclic, ", "))
                   : "");
    if (s.lyapunov) {
        put(page, "\nV = {}: {}\n", s.lyapunov->function, translated(s.lyapunov->sign));
        say_on(page, "dV/dt{}: {}\n", s.lyapunov->rate.empty() ? "" : " = " + s.lyapunov->rate,
               translated(s.lyapunov->rate_sign));
        if (!s.lyapunov->set.empty()) say_on(page, "dV/dt is zero where {}\n", s.lyapunov->set);
    }
    if (s.is_own_period) page += say("The period follows from the sines and cosines of t in the equations.\n");
    if (!s.multipliers.empty()) {
        say_on(page, "\nPeriod {:.16g} s, multipliers over it:\n\n{:>24}{:>24}{:>20}{:>12}\n", s.period,
               say("real"), say("imaginary"), say("size"), say("radius"));
        for (std::size_t k = 0; k < s.multipliers.size(); ++k)
            put(page, "{:>24.16g}{:>24.16g}{:>20.12g}{:>12.1e}\n", s.multipliers[k].real(),
                s.multipliers[k].imag() + 0.0, std::abs(s.multipliers[k]), s.radii[k]);
    }
    if (!s.eigenvalues.empty()) {
        put(page, "\n{:>24}{:>24}{:>12}   {}\n", say("eigenvalue, real"), say("imaginary"), say("radius"),
            say("side of the axis"));
        for (const RootOf& root : s.eigenvalues) {
            if (root.value.imag() < 0) continue;
            put(page, "{:>24.16g}{:>24}{:>12.1e}   {}\n", root.value.real() + 0.0,
                root.value.imag() == 0 ? "" : fmt::format("+-{:.16g}", root.value.imag()), root.radius,
                translated(side_name(root.side)));
        }
    }
    if (with_modes && s.near) page += "\n" + as_text(modes_near(s), s.states);
    if (!s.conditions.empty()) {
        say_on(page, "\nConditions, for {}:\n", s.conditions_for);
        for (const std::string& condition : s.conditions) put(page, "  {}\n", condition);
        if (!s.coefficients.empty())
            say_on(page, "with the coefficients of the characteristic polynomial, highest power first:\n");
        for (const std::string& coefficient : s.coefficients) put(page, "  {}\n", coefficient);
    }
    if (!s.routh.empty()) {
        say_on(page, "\nRouth's array:\n");
        for (const std::string& row : s.routh) put(page, "  {}\n", row);
    }
    return page;
}

}  // namespace alembert
