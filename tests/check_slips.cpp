// SPDX-License-Identifier: MIT
// Slips of students over a third of the scenes: each that is wrong by an evaluation in 60 digits is refuted, and
// most are named rightly, with a correct equation that is proved. An eighth of the slips are tried; ALEMBERT_SLIPS
// sets how many slips every equation gets.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cstdlib>
#include <map>

#include "analysis/state/prepared.hpp"
#include "check/check.hpp"
#include "model/formalism/routh.hpp"
#include "oracle.hpp"
#include "rewritings.hpp"
#include "scene/claims_file.hpp"
#include "scenes.hpp"
#include "slips.hpp"

namespace check_slips {

using namespace alembert;
using namespace alembert::test;

TEST_CASE(
    "check: slips made on the equations of textbook scenes are refuted, nine of ten named, and set right by "
    "equations that are proved") {
    constexpr unsigned seed = 20240607;
    const char* const wanted = std::getenv("ALEMBERT_SLIPS");
    const std::size_t each = wanted != nullptr ? static_cast<std::size_t>(std::atoi(wanted)) : 1;
    std::mt19937 random(seed);
    std::map<std::string, std::map<std::string, int>> named;  // the kind that was made → the kind that was named
    std::string misnamed;
    for (const std::string& file : every_third(scenes_in("scenes/textbook"), 0)) {
        CAPTURE(file);
        const Scene scene = read_scene(file);
        const Mechanism m = prepared(scene).mechanism;
        const Equations e = routh(m);
        const Oracle oracle(scene, m, e, seed);
        REQUIRE(oracle.states() == 3);
        const std::vector<std::string> right = Rewritings(scene, m, e).right();
        std::string claims;
        std::vector<StudentSlip> slips;
        for (std::size_t k = 0; k < right.size(); ++k)
            for (const StudentSlip& slip :
                 slips_of(scene, right, static_cast<std::size_t>(e.size()), k, random, each)) {
                std::vector<Diagnostic> mistakes;
                const Equality equation = parse_equality(slip.equation, {}, mistakes);
                CAPTURE(slip.equation);
                REQUIRE(mistakes.empty());
                if (wanted == nullptr && slip.kind != "wrong_row" && random() % 8 != 0) continue;
                if (oracle.holds(equation) != false) continue;
                slips.push_back(slip);
                claims += slip.equation + "\n";
            }
        if (slips.empty()) continue;  // there is no readable equation
        const Scene wrong = with_claims(scene, claims, "slips");
        const Checked result = check(wrong, m);
        std::string repairs;
        for (std::size_t k = 0; k < slips.size(); ++k) {
            const CheckedClaim& c = result.claims[k];
            CAPTURE(slips[k].equation);
            CHECK(c.verdict == Verdict::refuted);
            const std::string kind = c.likely ? c.likely->kind : "unknown";
            ++named[slips[k].kind][kind];
            if (c.likely && !c.likely->repair.empty()) repairs += c.likely->repair + "\n";
            if (kind != slips[k].kind)
                misnamed += fmt::format("{} named {}: {} | {} | {}\n", slips[k].kind, kind, wrong.file,
                                        slips[k].equation, c.likely ? c.likely->repair : std::string());
        }
        if (repairs.empty()) continue;
        const Scene corrected = with_claims(scene, repairs, "corrected");
        const Checked again = check(corrected, m);
        for (std::size_t k = 0; k < again.claims.size(); ++k) {
            CAPTURE(text_of(corrected.claims[k].equation));
            CHECK(again.claims[k].verdict == Verdict::proved);
        }
    }
    std::string table;
    int all = 0, right = 0;
    for (const auto& [kind, as] : named) {
        int sum = 0;
        for (const auto& [name, count] : as) sum += count;
        all += sum;
        right += as.contains(kind) ? as.at(kind) : 0;
        table += fmt::format("{:<15} {:4} made, {:3.0f} % named rightly;", kind, sum,
                             100.0 * (as.contains(kind) ? as.at(kind) : 0) / sum);
        for (const auto& [name, count] : as)
            if (name != kind) table += fmt::format(" {} {}", name, count);
        table += "\n";
    }
    INFO("seed " << seed << "\n" << misnamed << table << right << " of " << all);
    CHECK(named.size() == 9);
    for (const auto& entry : named) {
        const std::string& kind = entry.first;
        int sum = 0;
        for (const auto& [name, count] : entry.second) sum += count;
        CAPTURE(kind);
        CHECK(10 * (entry.second.contains(kind) ? entry.second.at(kind) : 0) >= 6 * sum);
    }
    CHECK(10 * right >= 9 * all);
    CHECK(all >= at_least(200));
}

// The contact forces of the wheels are multipliers that the equations of motion do not hold.
TEST_CASE("check: a slip beside multipliers that the equations leave open is named") {
    const Scene scene = read_scene(source_path("scenes/gallery/bicycle.toml"));
    const CheckedScene found = check(
        with_claims(scene,
                    "(mB*dot(vel(frame), ex(N)) + mR*dot(vel(rear_wheel), ex(N)) + mH*dot(vel(fork), ex(N)) - "
                    "mF*dot(vel(front_wheel), ex(N)))' = lambda_rear_rolls_x + lambda_front_rolls_x\n",
                    "slips"));
    const CheckedClaim& claim = found.checked.claims[0];
    REQUIRE(claim.verdict == Verdict::refuted);
    REQUIRE(claim.likely);
    CHECK(words_of(*claim.likely) == "the sign of mF*dot(vel(front_wheel), ex(N))");
}

}  // namespace check_slips
