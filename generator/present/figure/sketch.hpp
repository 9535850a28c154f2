// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The positions of a scene's points at some states, and what follows from them: which distances are constant,
/// which points a body carries, which coordinate turns what.
///
/// All questions are answered by numbers at random states (with zero rates), from the program's own expressions: a
/// distance is constant if it is the same at all of them. Only draw.cpp and the files beside it use this header.

#include <functional>
#include <optional>
#include <set>

#include "model/formulas.hpp"
#include "present/figure/drawing.hpp"
#include "program/lower/start.hpp"

namespace alembert {

/// A number of a figure for use in expressions: its first twelve digits.
GiNaC::ex exactly(double value);

class Sketch {
public:
    Sketch(const Scene& scene, const Mechanism& mechanism);

    /// A position or a direction, as three numbers at each sampled state.
    using Track = std::vector<Eigen::Vector3d>;
    /// Number of states with the scene's parameters; the first is the initial state.
    static constexpr int states = 6;
    static constexpr int at_one_time = 4;  ///< this many of the first states are at the initial time

    /// A named point of the scene.
    struct Site {
        enum class Of { origin, point, mass, joint } of;
        std::string name;
        int track;
        int mass = -1;     ///< position in Mechanism::masses
        std::string from;  ///< the point relative to which the scene gives it
    };

    /// Adds a position, given by expressions; its numbers are known after `sample`.
    int track(const Vector3& value);
    /// Adds a scalar, as the first component of a track.
    int scalar(const GiNaC::ex& value) { return track({value, 0, 0}); }
    void sample();
    /// The value of an expression at the initial state.
    double number(const GiNaC::ex& value) { return formulas.places().numbers_at_start({value})[0]; }
    Eigen::Vector3d numbers(const Vector3& value) {
        return {number(value[0]), number(value[1]), number(value[2])};
    }

    const Eigen::Vector3d& at(int state, int track) const { return numbers_[state][track]; }
    bool is_finite(int track) const;
    bool is_fixed(int track) const;
    bool is_driven(int track) const;                     ///< whether it moves with time only
    bool same(int a, int b) const;                       ///< whether the positions are the same at all states
    std::optional<double> distance(int a, int b) const;  ///< if it is constant
    /// Is the point fixed in the body with these axes (three tracks) and this mass centre?
    bool is_fixed_in(const std::array<int, 3>& axes, int centre, int place) const;
    /// f = sign·g + constant at all states, where f and g are functions of the number of the state. Returns sign
    /// and constant.
    std::optional<std::pair<double, double>> shifted(const std::function<double(int)>& f,
                                                     const std::function<double(int)>& g) const;
    double coordinate(int state, int k) const { return at_[state].q[k]; }
    /// The k-th independent parameter; it differs only in the last state, `states`.
    double parameter(int state, std::size_t k) const { return at_[state].parameters[k]; }
    /// The parameter that equals a distance, or half of it, for any values of the parameters; empty if there is
    /// none.
    std::string name_of_length(int a, int b) const;
    /// The value of a track at the initial state with coordinate k changed.
    Eigen::Vector3d with(int state, int track, int k, double value) const;

    /// The first of all sites at the same position.
    const Site& canonical(int track) const;
    const Site* site(const std::string& name) const;
    /// Adds a point that the scene does not name; `sample` must be called again before its numbers are used.
    void add_site(int track) { sites.push_back({Site::Of::point, "", track, -1, ""}); }
    /// A site of the scene: point, mass or origin.
    int place(const std::string& name) const { return site(name)->track; }

    void add(FigureElement element) { elements.push_back(std::move(element)); }
    int gravity() const { return gravity_; }
    /// An index into the poses of the drawing for a track.
    int spot(int track, int zeroed = -1, const Eigen::Vector3d& own_shift = {0, 0, 0});
    int track_of(int spot) const { return spot_tracks_[static_cast<std::size_t>(spot)]; }
    Drawing finished();

    const Scene& scene;
    const Mechanism& m;
    Formulas formulas;
    Start start;
    std::vector<Site> sites;
    std::vector<int> also;  ///< further tracks that say whether the figure is plane, and its size
    struct Frame3 {
        std::array<int, 3> axes;
        int centre;
        int mass;
        Eigen::Vector3d inertia{0, 0, 0};  ///< per unit of mass, if there is a mass
        double weight = 0;                 ///< its mass
        std::string name;
    };
    std::vector<Frame3> bodies;
    std::vector<int> free_track;  ///< tracks of mass centres, by position in Mechanism::masses
    std::vector<double> masses;   ///< the masses as numbers, by position in Mechanism::masses
    bool is_plane = false;
    int normal = 2;
    double scale = 1;  ///< the size of the figure
    std::vector<FigureElement> elements;
    std::vector<std::string> notes;
    /// Tracks that are drawn away from their positions: masses that move on one line are drawn apart.
    std::vector<std::pair<int, Eigen::Vector3d>> displaced;
    Eigen::Vector3d down{0, 0, 0};
    std::set<int> shown;  ///< masses that something else draws than their kind does
    /// Tracks of masses whose shape has its middle elsewhere, with the track of that middle.
    std::vector<std::pair<int, int>> middles;

private:
    void collect_sites();
    void collect_masses();
    void find_plane();

    std::vector<Vector3> values_;
    std::vector<State<double>> at_;  ///< `states`, then one with other parameters
    std::vector<Track> numbers_;     ///< the tracks at each state
    Program program_;
    std::vector<int> nodes_;
    std::vector<int> mass_tracks_;
    int gravity_ = -1;
    std::vector<Drawing::Spot> spots_;
    std::vector<int> spot_tracks_;
};

}  // namespace alembert
