// SPDX-License-Identifier: MIT
// The reader of scenes, and what builds a mechanism from one that it accepts.
#include "alembert/base/error.hpp"
#include "model/mechanism.hpp"
#include "target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        alembert::build(alembert::parse_scene(alembert::fuzz::text(data, size), "scene.toml"));
    } catch (const alembert::SceneError&) {
    } catch (const alembert::ModelError&) {
    }
    return 0;
}
