// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A step of the skeleton as steps along the axes of frames, some of which turn with angles in the step.
///
///     StepFrames frames(mechanism);
///     frames.taken_apart({.offset = {x + l sin θ, −l cos θ, 0}});   // by x along N; (0, −l, 0) in a new frame
///     frames.all();                                                 // the scene's, and that one, turned by θ
///
/// See links.hpp.

#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

/// Whether angles turn frames, or all steps remain along the axes that the scene gives.
enum class TurningFrames { found, none };

class StepFrames {
public:
    StepFrames(const Mechanism& mechanism, TurningFrames turns);

    struct Piece {
        int frame;
        std::vector<int> by;  ///< the coordinates that move it together
        bool prescribed;      ///< whether time alone moves it
        Vector3 offset;
    };
    /// Nothing if the step is too long.
    std::optional<std::vector<Piece>> taken_apart(const Skeleton::Step& step);

    const std::vector<Skeleton::Turn>& all() const { return frames_; }

private:
    /// A sum of coordinates with rational factors, the first of which is positive, and time.
    struct Angle {
        std::vector<std::pair<int, GiNaC::numeric>> slopes;  ///< by coordinate, without zeros
        GiNaC::ex value;
    };
    /// A product in one component: trigonometric functions of coordinates, and what remains.
    struct Term {
        int component;
        GiNaC::ex factor;
        std::vector<std::pair<int, bool>> functions;  ///< angle, and whether it is the cosine
    };
    using Terms = std::vector<Term>;

    Terms terms_of(int component, const GiNaC::ex& product);
    std::optional<Terms> times_function(const Terms& terms, const GiNaC::ex& function);
    int number_of(const Angle& angle);
    void take_apart(int frame, Terms terms, std::vector<Piece>& pieces);
    bool take_turn(int frame, int angle, Terms& terms, std::vector<Piece>& pieces);
    void add_plain(int frame, const Terms& terms, std::vector<Piece>& pieces) const;
    std::vector<int> angles_in(const Terms& terms) const;
    std::vector<int> coordinates_in(const GiNaC::ex& e) const;
    std::vector<int> moved_by(const Terms& terms) const;
    GiNaC::ex whole(const Term& term) const;
    /// The frame that turns against `frame` by the angle, except for a constant one, which is returned, too.
    std::pair<int, GiNaC::ex> turned(int frame, int axis, int sign, int angle);
    std::optional<GiNaC::ex> turn_between(int from, int to, int axis);
    bool moves(const GiNaC::ex& e) const;

    const Mechanism& m_;
    const TurningFrames frames_found_;
    std::unordered_set<unsigned> moving_;         // hashes, which correspond one to one to symbols
    std::unordered_map<unsigned, int> place_of_;  // hash of a coordinate → its place in Mechanism::q
    std::vector<Skeleton::Turn> frames_;
    std::vector<Angle> angles_;
    std::map<std::vector<int>, std::vector<int>> angles_of_;          // by the coordinates in them
    std::map<std::array<int, 3>, std::optional<GiNaC::ex>> between_;  // from, to, axis
    std::map<std::array<int, 4>, std::pair<int, GiNaC::ex>> turned_;  // frame, axis, sign, angle
};

}  // namespace alembert
