// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/stability.hpp"

#include <cmath>

#include "report/linearization.hpp"
#include "report/page.hpp"

namespace alembert {

namespace {

const char* side_name(RootOf::Side side) {
    switch (side) {
        case RootOf::Side::left:
            return "left";
        case RootOf::Side::axis:
            return "on the axis";
        case RootOf::Side::right:
            return "right";
        case RootOf::Side::unclear:
            return "unclear";
    }
    return "";
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
        result["floquet"] = Json::array();
        for (const std::complex<double>& rho : s.multipliers)
            result["floquet"].push_back({rho.real(), rho.imag()});
        result["radii"] = s.radii;
        result["start"] = Json::object();
        for (std::size_t k = 0; k < s.states.size(); ++k) result["start"][s.states[k]] = s.periodic_start[k];
    }
    result["certain"] = s.certain;
    if (s.lyapunov)
        result["lyapunov"] = {
            {"function", s.lyapunov->function}, {"rate", s.lyapunov->rate},
            {"sign", s.lyapunov->sign},         {"rate_sign", s.lyapunov->rate_sign},
            {"set", s.lyapunov->set},           {"method", s.lyapunov->sampled ? "sampled" : "exact"},
            {"samples", s.lyapunov->samples}};
    result["conditions"] = s.conditions;
    result["conditions_for"] = s.conditions_for;
    if (!s.routh.empty()) result["routh"] = s.routh;
    if (s.near) {
        const Json linear = as_json(*s.near);
        for (const char* key : {"motion", "moving", "coordinates", "rates", "matrices"}) result[key] = linear[key];
        Json rows = Json::array();
        for (Eigen::Index i = 0; i < s.A.rows(); ++i) {
            rows.push_back(Json::array());
            for (Eigen::Index j = 0; j < s.A.cols(); ++j) rows.back().push_back(s.A(i, j) + 0.0);
        }
        result["matrices"]["A"] = std::move(rows);
    }
    return result;
}

std::string as_text(const Stability& s) {
    std::string page;
    if (!s.title.empty()) put(page, "{}\n\n", s.title);
    put(page, "{}: {}.\n", name_of(s.verdict), s.reason);
    if (s.theorem != StabilityTheorem::none) put(page, "By: {}\n", name_of(s.theorem));
    if (!s.states.empty())
        put(page, "With respect to {}{}\n", fmt::join(s.states, ", "),
            s.near && !s.near->matrices.cyclic.empty()
                ? fmt::format(" (not {}, which nothing depends on)", fmt::join(s.near->matrices.cyclic, ", "))
                : "");
    if (s.lyapunov) {
        put(page, "\nV = {}: {}\n", s.lyapunov->function, s.lyapunov->sign);
        put(page, "dV/dt{}: {}\n", s.lyapunov->rate.empty() ? "" : " = " + s.lyapunov->rate,
            s.lyapunov->rate_sign);
        if (!s.lyapunov->set.empty()) put(page, "dV/dt is zero where {}\n", s.lyapunov->set);
    }
    if (!s.multipliers.empty()) {
        put(page, "\nPeriod {:.16g} s, multipliers over it:\n\n{:>24}{:>24}{:>20}{:>12}\n", s.period, "real",
            "imaginary", "size", "radius");
        for (std::size_t k = 0; k < s.multipliers.size(); ++k)
            put(page, "{:>24.16g}{:>24.16g}{:>20.12g}{:>12.1e}\n", s.multipliers[k].real(),
                s.multipliers[k].imag() + 0.0, std::abs(s.multipliers[k]), s.radii[k]);
    }
    if (!s.eigenvalues.empty()) {
        put(page, "\n{:>24}{:>24}{:>12}   {}\n", "eigenvalue, real", "imaginary", "radius", "side of the axis");
        for (const RootOf& root : s.eigenvalues) {
            if (root.value.imag() < 0) continue;
            put(page, "{:>24.16g}{:>24}{:>12.1e}   {}\n", root.value.real() + 0.0,
                root.value.imag() == 0 ? "" : fmt::format("+-{:.16g}", root.value.imag()), root.radius,
                side_name(root.side));
        }
    }
    if (!s.conditions.empty()) {
        put(page, "\nConditions, for {}:\n", s.conditions_for);
        for (const std::string& condition : s.conditions) put(page, "  {}\n", condition);
    }
    if (!s.routh.empty()) {
        put(page, "\nRouth's array:\n");
        for (const std::string& row : s.routh) put(page, "  {}\n", row);
    }
    return page;
}

}  // namespace alembert
