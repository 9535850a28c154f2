// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/modes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/language/say.hpp"
#include "present/report/page.hpp"

namespace alembert {

namespace {

bool is_rate(const std::string& state) {
    return state.ends_with('\'');
}

/// The shape of a mode whose coordinates all pass zero together: their amplitudes with signs, the largest 1.
std::optional<std::vector<double>> real_shape(const LinearMode& mode, const std::vector<std::string>& states) {
    std::complex<double> largest = 0;
    for (std::size_t k = 0; k < states.size(); ++k) {
        const std::complex<double> x = mode.vector[static_cast<Eigen::Index>(k)];
        if (!is_rate(states[k]) && std::abs(x) > std::abs(largest) * (1 + 1e-9)) largest = x;
    }
    if (largest == 0.0) return {};
    constexpr double in_phase = 1e-9;
    std::vector<double> shape;
    for (std::size_t k = 0; k < states.size(); ++k) {
        if (is_rate(states[k])) continue;
        const std::complex<double> x = mode.vector[static_cast<Eigen::Index>(k)] / largest;
        if (std::abs(x.imag()) > in_phase) return {};
        shape.push_back(std::abs(x.real()) <= in_phase ? 0 : x.real());
    }
    return shape;
}

}  // namespace

Json as_json(const std::vector<LinearMode>& modes, const std::vector<std::string>& states) {
    Json result = Json::array();
    for (const LinearMode& mode : modes) {
        Json vector = Json::object();
        for (std::size_t k = 0; k < states.size(); ++k) {
            const std::complex<double> x = mode.vector[static_cast<Eigen::Index>(k)];
            vector[states[k]] = {x.real() + 0.0, x.imag() + 0.0};
        }
        Json one = {{"eigenvalue", {mode.eigenvalue.real() + 0.0, mode.eigenvalue.imag() + 0.0}},
                    {"vector", std::move(vector)}};
        if (const auto shape = real_shape(mode, states)) {
            std::size_t next = 0;
            for (const std::string& state : states)
                if (!is_rate(state)) one["shape"][state] = (*shape)[next++];
        }
        result.push_back(std::move(one));
    }
    return result;
}

std::string as_text(const std::vector<LinearMode>& modes, const std::vector<std::string>& states) {
    std::string page = say("Modes: x = Re(v e^(eigenvalue t)), the largest element of v is 1\n");
    const auto is_real = [&](const LinearMode& m) { return m.eigenvalue.imag() != 0 && real_shape(m, states); };
    if (std::any_of(modes.begin(), modes.end(), is_real))
        page += say("(of coordinates that pass zero together, their shape alone)\n");
    for (const LinearMode& mode : modes) {
        const bool turns = mode.eigenvalue.imag() != 0;
        say_on(page, "\n  eigenvalue {:.8g}{}\n", mode.eigenvalue.real() + 0.0,
               turns ? fmt::format(" +- {:.8g}i", mode.eigenvalue.imag()) : "");
        if (const auto shape = turns ? real_shape(mode, states) : std::nullopt) {
            std::size_t next = 0;
            for (const std::string& state : states)
                if (!is_rate(state)) put(page, "    {:<12}{:>16.8g}\n", state, (*shape)[next++]);
            continue;
        }
        for (std::size_t k = 0; k < states.size(); ++k) {
            const std::complex<double> x = mode.vector[static_cast<Eigen::Index>(k)];
            if (turns)
                say_on(page, "    {:<12}{:>16.8g}{:>12.4f} deg\n", states[k], std::abs(x),
                       std::arg(x) * 180 / M_PI + 0.0);
            else
                put(page, "    {:<12}{:>16.8g}\n", states[k], x.real() + 0.0);
        }
    }
    return page;
}

}  // namespace alembert
