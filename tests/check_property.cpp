// SPDX-License-Identifier: MIT
// Random right and wrong claims about every scene: there is no false proof and no false refutation, and almost
// nothing is undecided. ALEMBERT_CLAIMS sets the number of each for a scene (2; tests/bench/claims.sh asks
// for 500), ALEMBERT_SCENE picks one scene.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "analysis/state/prepared.hpp"
#include "branch_scenes.hpp"
#include "check/check.hpp"
#include "model/formalism/routh.hpp"
#include "oracle.hpp"
#include "rewritings.hpp"
#include "scene/claims_file.hpp"
#include "scenes.hpp"
#include "slips.hpp"

namespace check_property {

using namespace alembert;
using namespace alembert::test;

namespace {

struct Counts {
    int proved = 0, refuted = 0, undecided = 0, false_proofs = 0, false_refutations = 0;
    double seconds = 0;
};

class Trial {
public:
    Trial(Scene scene, unsigned seed)
        : scene_(std::move(scene)),
          m_(prepared(scene_).mechanism),
          e_(routh(m_)),
          oracle_(scene_, m_, e_, seed),
          rewritings_(scene_, m_, e_),
          random_(seed) {
        REQUIRE(oracle_.states() == 3);
    }

    bool readable() const { return rewritings_.readable(); }

    void right(int count) {
        for (int k = 0; k < count; ++k) ask(rewritings_.claim(random_), true);
    }

    /// One term is changed, in an original or in a rewritten equation.
    void wrong(int count) {
        for (int k = 0; k < count;) {
            std::vector<std::string> equations = rewritings_.right();
            std::size_t chosen = random_() % equations.size();
            if (random_() % 2 == 0) {
                equations.push_back(rewritings_.claim(random_));
                chosen = equations.size() - 1;
            }
            const std::vector<StudentSlip> slips = slips_of(scene_, equations, m_.q.size(), chosen, random_, 1);
            if (slips.empty()) continue;
            k += ask(slips[random_() % slips.size()].equation, false) ? 1 : 0;
        }
    }

    /// The verdicts on all claims asked, in one call: the states at which they are held are found once.
    Counts judged() const {
        Counts counts;
        std::string lines;
        for (const auto& [claim, holds] : asked_) lines += claim + "\n";
        const auto start = std::chrono::steady_clock::now();
        const Checked checked = check(with_claims(scene_, lines, "random"), m_);
        counts.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        REQUIRE(checked.claims.size() == asked_.size());
        for (std::size_t k = 0; k < asked_.size(); ++k) {
            const CheckedClaim& result = checked.claims[k];
            const auto& [claim, holds] = asked_[k];
            counts.proved += result.verdict == Verdict::proved;
            counts.refuted += result.verdict == Verdict::refuted;
            counts.undecided += result.verdict == Verdict::undecided || result.verdict == Verdict::vacuous;
            counts.false_proofs += result.verdict == Verdict::proved && !holds;
            counts.false_refutations += result.verdict == Verdict::refuted && holds;
            CAPTURE(claim);
            INFO(result.reason);
            CHECK(result.verdict != (holds ? Verdict::refuted : Verdict::proved));
            if (result.verdict == Verdict::undecided) MESSAGE("undecided: " << claim << ": " << result.reason);
        }
        return counts;
    }

private:
    /// Nothing is asked, and false given, where the evaluation in many digits does not find what was meant.
    bool ask(const std::string& claim, bool meant_right) {
        std::vector<Diagnostic> mistakes;
        const Equality equation = parse_equality(claim, {}, mistakes);
        CAPTURE(claim);
        REQUIRE(mistakes.empty());
        const auto holds = oracle_.holds(equation);
        if (meant_right) CHECK(holds == true);
        if (holds != meant_right) return false;
        asked_.emplace_back(claim, *holds);
        return true;
    }

    const Scene scene_;
    const Mechanism m_;
    const Equations e_;
    const Oracle oracle_;
    const Rewritings rewritings_;
    std::mt19937 random_;
    std::vector<std::pair<std::string, bool>> asked_;
};

}  // namespace

TEST_CASE(
    "check: random right claims are proved, random wrong ones refuted, at most one in a hundred is undecided") {
    const char* const wanted = std::getenv("ALEMBERT_CLAIMS");
    const int count = wanted != nullptr ? std::atoi(wanted) : 2;
    constexpr unsigned seed = 1918;
    for (const std::string& file : every_third(scenes_in("scenes/textbook"), 1)) {
        CAPTURE(file);
        CAPTURE(seed);
        if (const char* const only = std::getenv("ALEMBERT_SCENE");
            only != nullptr && file.find(only) == std::string::npos)
            continue;
        const Mechanism m = prepared(read_scene(file)).mechanism;
        if (!m.unilateral.empty()) continue;  // the oracle does not support contacts
        Trial trial(read_scene(file), seed);
        if (!trial.readable()) continue;
        trial.right(count);
        trial.wrong(count);
        const Counts c = trial.judged();
        CHECK(c.proved + c.refuted + c.undecided == 2 * count);
        CHECK(100 * c.undecided <= 2 * count);
        if (wanted != nullptr)
            fmt::print(
                "{:<24} proved {:4}  refuted {:4}  undecided {:3}  false proofs {}  false refutations {}  {:.3f} "
                "s\n",
                file.substr(file.rfind('/') + 1), c.proved, c.refuted, c.undecided, c.false_proofs,
                c.false_refutations, c.seconds);
    }
}

TEST_CASE("check: random claims on the scene's own branch are judged right where the constraints have others") {
    const char* const wanted = std::getenv("ALEMBERT_CLAIMS");
    const int count = wanted != nullptr ? std::atoi(wanted) : 3;
    constexpr unsigned seed = 1799;
    for (const BranchScene& scene : branch_scenes()) {
        CAPTURE(scene.text);
        CAPTURE(seed);
        Trial trial(scene.scene(), seed);
        trial.right(count);
        trial.wrong(count);
        const Counts c = trial.judged();
        CHECK(100 * c.undecided <= 2 * count);
        if (wanted != nullptr)
            fmt::print(
                "{:<24} proved {:4}  refuted {:4}  undecided {:3}  false proofs {}  false refutations {}  {:.3f} "
                "s\n",
                scene.name, c.proved, c.refuted, c.undecided, c.false_proofs, c.false_refutations, c.seconds);
    }
}

}  // namespace check_property
