// SPDX-License-Identifier: MIT
// The whole way from a scene to its equations and its motion with the installed library, in a program of somebody
// else: a ball that bounces. Prints the equation of motion in LaTeX, the times of the first two impacts and the
// estimated error.
#include <alembert/algebra/notation/latex.hpp>
#include <alembert/analysis/derive/derive.hpp>
#include <alembert/simulate/simulate.hpp>
#include <cstdio>

int main() {
    using namespace alembert;
    const Scene scene = parse_scene(R"toml(
gravity = [0, "-g"]
[parameters]
m = 2
g = 10
[coordinates]
y = 5
[[particle]]
name = "ball"
mass = "m"
position = [0, "y"]
[[unilateral]]
name = "floor"
gap = "y"
restitution = 0.5
)toml",
                                    "ball.toml");

    const DerivedScene d = derive(scene);
    const ReadableEquation& equation = d.shown.equations.at(0);
    std::printf("%s = %s\n", latex(equation.lhs).c_str(), latex(equation.rhs).c_str());

    const Run run = simulate(scene, {.method = "dop853", .duration = 2.4, .tolerance = 1e-10});
    for (const ContactEvent& event : run.motion.contacts) std::printf("impact at %.9f\n", event.time);
    std::printf("the estimated error is %s\n", *run.estimate->value < 1e-8 ? "below 1e-8" : "too large");
    return run.distrust_reasons.empty() ? 0 : 1;
}
