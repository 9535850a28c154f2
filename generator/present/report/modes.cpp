// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/modes.hpp"

#include <cmath>

#include "base/language/say.hpp"
#include "present/report/page.hpp"

namespace alembert {

Json as_json(const std::vector<LinearMode>& modes, const std::vector<std::string>& states) {
    Json result = Json::array();
    for (const LinearMode& mode : modes) {
        Json vector = Json::object();
        for (std::size_t k = 0; k < states.size(); ++k) {
            const std::complex<double> x = mode.vector[static_cast<Eigen::Index>(k)];
            vector[states[k]] = {x.real() + 0.0, x.imag() + 0.0};
        }
        result.push_back({{"eigenvalue", {mode.eigenvalue.real() + 0.0, mode.eigenvalue.imag() + 0.0}},
                          {"vector", std::move(vector)}});
    }
    return result;
}

std::string as_text(const std::vector<LinearMode>& modes, const std::vector<std::string>& states) {
    std::string page = say("Modes: x = Re(v e^(eigenvalue t)), the largest element of v is 1\n");
    for (const LinearMode& mode : modes) {
        const bool turns = mode.eigenvalue.imag() != 0;
        say_on(page, "\n  eigenvalue {:.8g}{}\n", mode.eigenvalue.real() + 0.0,
               turns ? fmt::format(" +- {:.8g}i", mode.eigenvalue.imag()) : "");
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
