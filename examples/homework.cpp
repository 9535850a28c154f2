// SPDX-License-Identifier: MIT
// Checks hand derivations of the pendulum on a cart, and says which term of a wrong one is wrong.
#include <alembert/check/check.hpp>
#include <alembert/scene/claims_file.hpp>
#include <cstdio>

int main() {
    using namespace alembert;
    const Scene scene = parse_scene(R"toml(
gravity = [0, "-g"]
[parameters]
M = 2
m = 1
l = 0.5
g = 9.81
[coordinates]
x = 0
theta = 0.3
[[particle]]
name = "cart"
mass = "M"
position = ["x", 0]
[[particle]]
name = "bob"
mass = "m"
position = ["x + l*sin(theta)", "-l*cos(theta)"]
)toml",
                                    "cart.toml");
    const char* const homework =
        "(M + m)*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta) = 0\n"
        "l*theta'' - x''*cos(theta) + g*sin(theta) = 0\n";

    const CheckedScene checked = check(with_claims(scene, homework, "homework.txt"));
    for (const CheckedClaim& claim : checked.checked.claims) {
        std::printf("%s", claim.verdict == Verdict::proved ? "proved" : "refuted");
        if (claim.likely) std::printf(": %s in %s", claim.likely->kind.c_str(), claim.likely->term.c_str());
        std::printf("\n");
    }
}
