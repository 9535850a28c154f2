// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Emitted and compiled functions of a scene, for one state or for many at once.
///
///     const CompiledSystem system(load(compile(text, "pendulum", {}).object), text);
///     system.rhs(0, state, rate);        // state: coordinates, then speeds; rate: their derivatives
///     system.rhs_of_many({0}, states, 1000, rates);      // 1000 states, row by row; packs of eight, all cores
///
/// A time for each state, or one for all. A copy is cheap, and shares what neither changes: a call that works
/// while another thread sets parameters takes one first, and so has the same parameters throughout.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "alembert/native/module.hpp"

namespace alembert {

class CompiledSystem {
public:
    CompiledSystem(Module module, std::string source);

    int dimension() const { return n_ + s_; }
    int coordinate_count() const { return n_; }
    int speed_count() const { return s_; }
    const std::vector<double>& parameter_values() const { return parameters_->values; }
    const std::string& source() const { return *source_; }

    /// Throws std::invalid_argument for a number of values that is not that of the parameters.
    void set_parameters(const std::vector<double>& values);

    /// Which of the parameters are inputs from outside: the first of them, and how many. Nothing that `prepare`
    /// computes depends on them.
    void take_inputs(std::size_t first, std::size_t count) { inputs_ = {first, count}; }
    std::pair<std::size_t, std::size_t> inputs() const { return inputs_; }
    /// The same system with these values of its inputs. Throws std::invalid_argument for another number of values.
    CompiledSystem with_inputs(const std::vector<double>& values) const;

    void rhs(double t, const double* state, double* rate) const { module_.table().rhs(t, state, par(), rate); }
    void rhs_of_many(const std::vector<double>& times, const double* states, std::size_t count,
                     double* rates) const;
    /// Row by row: count × dimension². Throws std::invalid_argument where the file has no derivatives.
    void jacobian_of_many(const std::vector<double>& times, const double* states, std::size_t count,
                          double* values) const;
    /// count × speeds²; `forcing` count × speeds or null. Throws std::invalid_argument where M is not emitted.
    void mass_of_many(const std::vector<double>& times, const double* states, std::size_t count, double* mass,
                      double* forcing) const;
    /// T, V and E: count × 3.
    void energy_of_many(const std::vector<double>& times, const double* states, std::size_t count,
                        double* energies) const;

    /// Functions for robots that were emitted (program/lower/robot_functions.hpp,
    /// program/lower/frame_functions.hpp).
    std::vector<std::string> function_names() const;
    const alembert_named_function& function(int which) const { return module_.functions()->list[which]; }
    /// q, v, a: count × coordinates; rates and accelerations that are null are zero.
    struct StateRows {
        const double *q, *v, *a;
    };
    /// values: count × the matrix.
    void function_of_many(const alembert_named_function& f, const std::vector<double>& times,
                          const StateRows& states, std::size_t count, double* values) const;

private:
    void rhs_of_range(const std::vector<double>& times, const double* states, std::size_t from, std::size_t to,
                      double* rates) const;

    void function_of_range(const alembert_named_function& f, const std::vector<double>& times,
                           const StateRows& states, std::size_t from, std::size_t to, double* values) const;

    struct Parameters {
        std::vector<double> values, prepared;
    };
    const double* par() const { return parameters_->prepared.data(); }

    Module module_;
    std::shared_ptr<const std::string> source_;
    int n_, s_;
    std::pair<std::size_t, std::size_t> inputs_ = {0, 0};
    std::shared_ptr<const Parameters> parameters_;
};

}  // namespace alembert
