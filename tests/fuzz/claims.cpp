// SPDX-License-Identifier: MIT
// Files of claims about a small scene: the reader, and the claims as programs.
#include "check/claims.hpp"
#include "alembert/base/error.hpp"
#include "model/formalism/formalisms.hpp"
#include "model/translate.hpp"
#include "scene/claims_file.hpp"
#include "target.hpp"

using namespace alembert;

namespace {

const char* const pendulum = R"toml(
gravity = [0, "g"]
[parameters]
m = 1
l = 2
g = 9.81
[coordinates]
theta = 0.3
x = 0.1
[[particle]]
name = "P"
mass = "m"
position = ["x + l*sin(theta)", "l*cos(theta)"]
)toml";

struct Known {
    Scene scene = parse_scene(pendulum, "pendulum.toml");
    Mechanism mechanism = build(scene);
    Equations equations = formalism("lagrange").derive(mechanism);
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Known known;
    try {
        const Scene scene = with_claims(known.scene, fuzz::text(data, size), "claims.txt");
        Claims claims(scene, known.mechanism, known.equations);
        for (const Claim& claim : scene.claims) claims.read(claim);
    } catch (const SceneError&) {
    } catch (const SceneMistake&) {
    } catch (const ModelError&) {
    }
    return 0;
}
