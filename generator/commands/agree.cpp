// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/agree.hpp"

#include <fmt/format.h>

#include <chrono>
#include <iostream>

#include "analysis/redundancy.hpp"
#include "analysis/speeds.hpp"
#include "commands/pipeline.hpp"

namespace alembert {

int agree(const Request& request) {
    const auto start = std::chrono::steady_clock::now();
    const Scene scene = read_scene(request.scene);
    if (!scene.warnings.empty()) std::cerr << describe(scene, scene.warnings);
    Mechanism mechanism = build(scene);
    check_bodies(scene, mechanism, {});
    if (!mechanism.speeds.empty()) mechanism = without_constraints(mechanism, redundant_constraints(mechanism));
    if (const std::optional<Diagnostic> mistake = mistake_in_speeds(mechanism)) fail(scene, {*mistake});
    const Derivations all = derive_all(mechanism);
    const Agreement result = agree(all.equations, mechanism);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    const int verdict = static_cast<int>(result.verdict);
    const char* const word = std::array{"proved", "refuted", "undecided"}[verdict];
    const bool proved = result.verdict == Agreement::Verdict::proved;
    if (request.json) {
        Json json;
        json["formalisms"] = Json::array();
        for (const Equations& e : all.equations) json["formalisms"].push_back(e.formalism);
        json["verdict"] = word;
        json["method"] = result.normal_form ? "proved" : "sampled";
        json["points"] = result.points;
        json["failure_bound_log2"] = result.failure;
        json["refused"] = Json::object();
        for (const auto& [name, reason] : all.refused) json["refused"][name] = reason;
        if (!result.reason.empty()) json["reason"] = result.reason;
        json["seconds"] = seconds;
        std::cout << as_text(json);
        return verdict;
    }
    std::string names;
    for (const Equations& e : all.equations) names += (names.empty() ? "" : ", ") + e.formalism;
    std::cout << fmt::format("{}: {}\n", names, word);
    if (proved)
        std::cout << fmt::format(
            "{} at {} random points modulo 2^61 - 1{}\n",
            result.normal_form ? "The normal forms of all entries of M and f are equal; so are the accelerations"
                               : "The accelerations are equal",
            result.points,
            result.normal_form ? "" : fmt::format("; the chance that a difference was missed is below 2^{:.0f}", result.failure));
    else
        std::cout << result.reason << "\n";
    for (const auto& [name, reason] : all.refused) std::cout << fmt::format("{} does not apply: {}\n", name, reason);
    std::cout << fmt::format("{:.3f} s\n", seconds);
    return verdict;
}

}  // namespace alembert
