// SPDX-License-Identifier: MIT
// The whole way from a scene to a motion with the installed libraries: prints the pendulum's period.
#include <alembert/compile.hpp>
#include <alembert/integrate.hpp>
#include <cstdio>

#include "emit/emit.hpp"
#include "formalism/lagrange.hpp"
#include "lower/choose.hpp"
#include "lower/start.hpp"

int main() {
    using namespace alembert;
    const Scene scene = parse_scene(R"toml(
[coordinates]
theta = { initial = 1.0 }
[energy]
kinetic = "theta'^2/2"
potential = "-cos(theta)"
[[event]]
name = "crossing"
when = "theta"
)toml", "pendulum.toml");
    const Mechanism mechanism = build(scene);
    const Program program = choose(mechanism, lagrange(mechanism)).program;
    const Module module = load(compile(emit(program).text, "pendulum", {}).object);
    const Trajectory motion = integrate(make_rhs(module), {1.0, 0.0}, {.duration = 6, .tolerance = 1e-12},
                                        make_events(module, {}, {false}));
    std::printf("%.10f\n", 2 * (motion.events.at(1).time - motion.events.at(0).time));
    return 0;
}
