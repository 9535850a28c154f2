// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One function of a solver as a list of lines, each an instruction or a call, between a Program and its machine
/// code.
///
///     const Lines lines = lines_of(program, words, readiness, mass_forcing(program));
///     lines.list[0];          // value 7 = value 2 · value 5 + value 3
///
/// A value that stands in memory anyway has a home: what a function takes from its arrays, constants, and in a
/// block of its own sines and cosines, which are computed for all angles of the same depth in one call. Products
/// that are used once are part of the sums that use them, and reciprocals part of the products. Signs are carried
/// along until a value is used that must have one.

#include <array>
#include <span>
#include <vector>

#include "codegen/emit/function.hpp"
#include "program/readiness.hpp"

namespace alembert::machine {

struct Home {
    enum class Kind : unsigned char { none, time, argument, constant, block };
    Kind kind = Kind::none;
    int argument = 0;   ///< position among the arrays of the function
    int place = 0;      ///< in the array, or in the block
    double number = 0;  ///< of a constant
    int numbers = 1;    ///< side by side in the value, for each system: 1, 2 or 4 (side_by_side.hpp)
};

struct Line {
    enum class Kind : unsigned char {
        add,
        subtract,
        multiply,
        divide,
        root,
        absolute,
        negative,
        shift_left,   ///< by `place` bits
        shift_right,  ///< likewise; the sign moves in
        larger_size,  ///< the larger of of[0] ≥ 0 and |of[1]|; of[0] where the latter is not a number
        select,       ///< of[1] where the bits of of[2] are set, else of[0]; with four lanes its highest bits tell
        turn_sign,    ///< of[0] with its sign turned where that of of[1] is set
        fused,        ///< ± of[0]·of[1] ± of[2]
        call,         ///< function(of[0]), or function(of[0], of[1]), or function of all three
        sines,        ///< the group `place`
        store,        ///< of[0] to the array `argument` at `place`
        pair,         ///< of[0] and of[1] side by side
        join,         ///< the pairs of[0] and of[1] side by side
        repeat,       ///< of[0] in all places
        keep          ///< of[0] to the block at `place`
    };
    Kind kind;
    int to = -1;                           ///< a value; −1 if there is none
    std::array<int, 3> of = {-1, -1, -1};  ///< values
    bool minus_product = false, minus_rest = false;
    const void* function = nullptr;
    int argument = 0, place = 0;
};

/// How packs compute sines and cosines: by instructions between the others, which is faster, or by calls, which
/// take angles of any size. All else is the same in both.
enum class Sines : unsigned char { inside, called };

/// Angles stand at place, place + 1 … in the block, then their sines, then their cosines; with one lane
/// each of the three lists is filled up to a multiple of four.
struct SineGroup {
    std::vector<int> angles;
    int place;
    int size;
};

struct Lines {
    int lanes = 1;            ///< 1, or systems side by side: 4 or 8
    std::vector<Home> homes;  ///< of each value
    std::vector<Line> list;
    std::vector<SineGroup> groups;
    int block = 0;  ///< its length
    int arrays = 0;
    bool takes_time = false;  ///< whether the first argument is t
    int largest = -1;         ///< the value that holds the largest angle of sines inside
};

Lines lines_of(const Program& program, const Vocabulary& words, const Readiness& ready, const FunctionTask& task);
/// `lanes`: 4 or 8.
Lines lines_of_packs(const Program& program, const Vocabulary& words, const Readiness& ready,
                     const FunctionTask& task, Sines sines, int lanes);

/// The function that computes the constants after the parameters.
Lines lines_of_constants(const Program& program, const Vocabulary& words, const Readiness& ready);
Lines lines_of_constants_in_packs(const Program& program, const Vocabulary& words, const Readiness& ready,
                                  int lanes);

}  // namespace alembert::machine
