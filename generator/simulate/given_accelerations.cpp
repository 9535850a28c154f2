// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/given_accelerations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alembert/base/argument.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

bool is_acceleration(const std::pair<std::string, double>& item) {
    return item.first.ends_with("''");
}

}  // namespace

std::vector<std::optional<double>> given_accelerations(const Overrides& at, const Mechanism& m) {
    std::vector<std::optional<double>> given(m.q.size());
    std::vector<std::string> known;
    for (const GiNaC::symbol& q : m.q) known.push_back(q.get_name() + "''");
    for (const auto& [name, value] : at) {
        if (!is_acceleration({name, value})) continue;
        const auto found = std::find(known.begin(), known.end(), name);
        if (found == known.end()) {
            const std::string meant = nearest(name, known);
            throw ModelError(say("no coordinate has the acceleration {}{}", name,
                                 meant.empty() ? "" : say("; did you mean '{}'?", meant)));
        }
        argument::need_finite(name, value);
        given[static_cast<std::size_t>(found - known.begin())] = value;
    }
    return given;
}

Overrides without_accelerations(Overrides at) {
    std::erase_if(at, is_acceleration);
    return at;
}

}  // namespace alembert
