// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/options.hpp"

#include "alembert/base/argument.hpp"

namespace alembert {

void check_numbers(const RunOptions& wishes) {
    using namespace argument;
    if (wishes.duration) need_nonnegative("duration", *wishes.duration);
    for (const auto& [name, value] : {std::pair("tolerance", wishes.tolerance), std::pair("step", wishes.step),
                                      std::pair("sample", wishes.sample), std::pair("max_step", wishes.max_step)})
        if (value) need_positive(name, *value);
    need_positive("budget", static_cast<double>(wishes.budget));
}

}  // namespace alembert
