// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The numbers of a mechanism: the scene's own, some of which may be replaced.
///
///     const Start start = start_of(mechanism, {{"theta1", 0.3}, {"theta1'", 1.0}, {"l1", 2.0}});
///
///     const Starts starts(mechanism, {"theta1", "l1"});      // the same names again and again
///     for (double angle : angles) starts.at({angle, 2.0});

#include <string>
#include <utility>
#include <vector>

#include "model/formalism/equations.hpp"
#include "model/formalism/obstacle.hpp"
#include "program/interpret.hpp"

namespace alembert {

struct Start {
    std::vector<double> parameters;  ///< the independent parameters, in the order of Program
    double t = 0;
    std::vector<double> q, qdot;
    std::vector<double> speeds;  ///< the scene's speeds, if the rates follow from them; else empty
    std::vector<double> states;  ///< the scene's first-order states
    double duration = 10;        ///< in s; 10 if the scene does not give it
    double tolerance = 1e-9, step = 0, sample = 0;
    double max_step = 0;  ///< in s; 0 means no bound

    /// The state in the order of a program in rates: the states of the scene stand behind q'.
    State<double> state() const {
        State<double> result{.parameters = parameters, .t = t, .q = q, .qdot = qdot, .qddot = {}};
        result.qdot.insert(result.qdot.end(), states.begin(), states.end());
        return result;
    }
};

using Overrides = std::vector<std::pair<std::string, double>>;

/// The state in the order of a program of these equations: (q, q'), or (q, u).
State<double> state_of(const Start& start, const Mechanism& mechanism, const Equations& equations);

/// Looks up the names and lowers the initial values once, for many sets of numbers. The arguments must outlive it.
class Starts {
public:
    /// Throws like start_of for wrong names.
    Starts(const Mechanism& mechanism, const std::vector<std::string>& names);

    /// Takes a value for each name. There is an obstacle if a value is not finite, whether given or computed from
    /// the given ones.
    Possible<Start> possible(const std::vector<double>& values) const;
    /// The same; throws like start_of for wrong values.
    Start at(const std::vector<double>& values) const { return possible(values).value(); }

private:
    enum class Part { t, parameter, q, qdot, speed, state };
    struct Spot {
        std::string name;
        Part part;
        std::size_t index;
    };
    Spot spot_of(const std::string& name) const;
    static double& place(const Spot& spot, Start& start);

    const Mechanism& m_;
    Start plain_;  ///< the scene's own parameters, and room for the other values
    std::vector<Spot> spots_;
    Program program_;
    std::vector<int> nodes_;  ///< q, q', speeds, states, then the scene's settings of the run
};

/// The nodes of what the scene says of the start, in parameters: for arithmetic of any kind.
struct StartNodes {
    std::vector<int> q, qdot, speeds, states;
    int t = 0, duration = 0;  ///< where the scene gives none, those of 0 and of 10 s
};
StartNodes lower_start(Program& program, const Mechanism& mechanism);

/// Initial values that depend on parameters are computed from the replaced ones. A name is a parameter's, a
/// coordinate's, a rate's (`theta1'`), a generalized speed's, a state's or `t`, or that of an input that has this
/// number already (`prepared`). Throws ModelError for any other, with the nearest known name, for a parameter that
/// is defined by others, and for a value that is not finite.
Start start_of(const Mechanism& mechanism, const Overrides& overrides = {});

}  // namespace alembert
