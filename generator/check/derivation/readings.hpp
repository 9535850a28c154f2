// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the letters of a derivation may mean, where that can be more than one thing.
///
///     Letters letters = with_authors_letters(chosen, written);          // q = theta: q is the author's
///     const Readings readings(system, written);
///     readings.settle(letters)                                         // x = r - l0: his, as the next lines show
///
/// A letter that an author defines is his, before anything that is guessed of it. Where his definition is false of
/// what the letter was taken for, both readings are tried on the lines that follow: that with which they are right
/// counts. Where none of them speaks of it, the line is not judged.

#include <set>
#include <string>
#include <vector>

#include "check/derivation/letters.hpp"
#include "check/derivation/marked.hpp"
#include "check/derivation/system.hpp"

namespace alembert {

/// The letters that stand for general coordinates in books, u, q and Q, where the author says what they are.
Letters with_authors_letters(Letters letters, const Written& written);

class Readings {
public:
    Readings(DerivedSystem& system, const Written& written) : system_(system), written_(written) {}

    /// The letters with those that are the author's own, as the lines that follow their definitions show.
    Letters settle(Letters letters, const std::set<Letter>& given) const;
    /// A mistake that is one under one of two readings only is not judged.
    void withhold(std::vector<MarkedLine>& lines, const Letters& letters, const std::set<Letter>& given) const;

private:
    /// What the lines that follow line `k` and speak of the letter are.
    struct Uses {
        int right = 0, all = 0;
    };
    Uses uses(const std::vector<MarkedLine>& lines, std::size_t k, const Letter& letter) const;
    /// The letter that the line, a mistake, may define; nothing if it is none that may be the author's.
    std::optional<Letter> perhaps_defined(const std::vector<MarkedLine>& lines, std::size_t k,
                                          const Letters& letters, const std::set<Letter>& given) const;
    std::vector<MarkedLine> marked_with(const Letters& letters) const;
    bool has_sines_of_two_angles(const Letters& letters) const;

    DerivedSystem& system_;
    const Written& written_;
};

}  // namespace alembert
