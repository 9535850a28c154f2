// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace alembert::test {

/// A pendulum on a spring whose four parameters and two coordinates have these names, with all elementary
/// functions. The fourth is a parameter, or an input from outside.
inline std::string spring_scene(const std::vector<std::string>& names, const std::string& text,
                                bool from_outside) {
    return fmt::format(R"toml(title = """{6}"""
gravity = [0, "-{0}"]
[parameters]
"{0}" = {{ value = 9.81, unit = "m", about = """{6}""" }}
"{1}" = 2.5
"{2}" = 0.7
{7}
[coordinates]
"{4}" = {{ initial = 0.4, unit = "m", about = """{6}""" }}
"{5}" = {{ initial = 0.1, rate = 0.3 }}
[[particle]]
name = "bob"
mass = "{1}"
position = ["({2} + {5})*sin({4})", "-({2} + {5})*cos({4})"]
[forces]
"{5}" = "-{3}*{5} - abs({5})*{1} + min({5}, {2}) - max({4}, {5}) + sqrt({3} + {5}^2) + 0.1*atan2({5}, {0}) + pi*sign({5})"
"{4}" = "exp(-{4}) - log({0} + {4}) + tanh({5}) + sinh({5}/{0}) - cosh({4}/3) + tan({5}/4) + asin({5}/{1}) - acos({4}/{0}) + atan({4}) + ({0} + {5})^({2}/3) + sqrt({4} - 0.2)"
)toml",
                       names[0], names[1], names[2], names[3], names[4], names[5], text,
                       from_outside
                           ? fmt::format("[inputs]\n\"{}\" = {{ value = 40, given = \"outside\" }}", names[3])
                           : fmt::format("\"{}\" = 40", names[3]));
}

}  // namespace alembert::test
