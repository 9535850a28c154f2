// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The engine of the check: is left − right of a claim zero at every state of which the claim speaks?
///
///     decide(now, {0, 2, 3});        // writes now.verdicts[0], [2] and [3]
///
/// States are those of motions, of rest, in the pose of an impact, near a point or along a motion in closed form;
/// they lie on branches of the constraints and in cells of what signs depend on. Each way to decide such a
/// question is a function from the question to a verdict. They stand in one table, and the first that answers has
/// decided. What they prove is held against the doubts of a second table.

#include <functional>

#include "check/asked_together.hpp"

namespace alembert {

class Question {
public:
    Question(AskedTogether& together, std::size_t claim) : Question(together, claim, together.now.forms[claim]) {}
    /// Of another form of the claim, a repair that is tried; `form` must outlive it.
    Question(AskedTogether& together, std::size_t claim, const ClaimForm& form);
    Question(const Question&) = delete;
    Question& operator=(const Question&) = delete;

    /// After the form has become another.
    void lower();
    const ClaimForm& form() const { return form_; }
    const Program& program() const { return program_; }
    /// Of left − right.
    int root() const { return root_; }

    /// In exact arithmetic, at states of all branches; nothing if that cannot be decided.
    std::optional<bool> is_zero();
    double failure() const { return failure_; }  ///< then log₂ of the probability of an error
    /// Where a claim that holds on some branches only is decided: at states of the scene's own branch alone.
    bool is_of_own_branch() { return now.on_own_branch != nullptr && is_zero() == false; }
    /// These, or those of all branches if exact arithmetic has none of them.
    ExactStates& here();

    Comparison& now;
    AskedTogether& together;
    const std::size_t claim;
    CheckedClaim found = {};               ///< so far
    ExactStates* explained_at = nullptr;   ///< where it was refuted, if exact arithmetic may tell what is wrong
    std::function<void()> tell_last = {};  ///< adds to what was found

private:
    const ClaimForm& form_;
    Program program_;
    int root_ = 0;
    bool is_asked_ = false;
    std::optional<bool> zero_;
    double failure_ = 0;
};

/// Nothing if this way does not decide it.
using Way = std::optional<CheckedClaim> (*)(Question&);

CheckedClaim proved(double failure);
CheckedClaim refuted(const Counterexample& shown);
CheckedClaim undecided(std::string reason);

/// `claims`: those of one `now.at` that have the law of `now`.
void decide(Comparison& now, const std::vector<std::size_t>& claims);

}  // namespace alembert
