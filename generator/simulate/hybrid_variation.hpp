// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations of motion with columns of derivatives, through all that a motion passes.
///
///     HybridVariation variation(run, program, by, start);
///     variation.begin(run.instants);
///     variation.go(0, 1.5, y, {.tolerance = 1e-12});     // y: the state, then columns Φ; both at the end then
///
/// Between two instants the variational equations are integrated by dop853, with the sides of all functions held;
/// at each the columns jump (saltation.hpp). Where derivatives do not exist, or are not known to, IntegrationError
/// says so: what is only grazed or nearly so, two instants at one instant, contacts that stay closed, functions
/// that stay at their zero, and what is at its zero where the motion begins and is moved by what a column varies.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "alembert/ode/integrate.hpp"
#include "analysis/derive/derived.hpp"
#include "program/differentiate.hpp"
#include "program/jump_watch.hpp"
#include "program/lower/start.hpp"
#include "program/switches.hpp"
#include "program/variation.hpp"
#include "simulate/saltation.hpp"

namespace alembert {

class HybridVariation {
public:
    /// `program` is that of `derived`. Of each of the first columns `by` has the position of its parameter, or −1.
    /// Throws ModelError for what derivatives cannot be carried through, and where there are none.
    HybridVariation(const Derived& derived, const Program& program, std::vector<int> by, const Start& start,
                    DerivativeWishes wishes = {.parameters = true});

    /// Whether derivatives jump somewhere along motions of this system.
    static bool is_needed(const Mechanism& mechanism, const Program& program, const std::vector<int>& by);

    /// With the derivatives of its right-hand side; the signs of functions are its last parameters.
    const Program& program() const { return program_; }
    /// With the sides of now.
    const std::vector<double>& parameters() const { return parameters_; }

    struct Wishes {
        double tolerance = 1e-10;
        long budget = 10'000'000;
        double longest_step = 0;
        bool finds_pulses = true;                 ///< false where pieces are short anyhow
        std::vector<std::string> names = {};      ///< of the components of y
        std::function<void(double t)> tell = {};  ///< may be empty
    };
    /// `y` is the state at the start with its columns.
    void begin(const JumpInstants& instants, double t, const std::vector<double>& y, const Wishes& wishes);
    void go(double from, double until, std::vector<double>& y, const Wishes& wishes);

    /// Those at which derivatives may jump.
    const std::vector<JumpInstant>& instants() const { return instants_; }

    /// f, of coordinates, then speeds.
    std::vector<double> rate_at(double t, const std::vector<double>& state) const;
    /// f, then all values whose zeros change the motion.
    std::vector<double> all_at(double t, const std::vector<double>& state) const;

    long steps() const { return steps_; }
    long evaluations() const { return evaluations_; }

private:
    struct Seen {
        double value = 0, speed = 0;
    };
    void integrate_to(double from, double until, std::vector<double>& y, const Wishes& wishes);
    bool passes_smoothly(const JumpInstant& instant, const std::vector<double>& y);
    void pass(const JumpInstant& instant, std::vector<double>& y, const Wishes& wishes);
    bool is_grazed(const JumpInstant& instant, const Saltation::At& at, const std::vector<double>& state,
                   const std::vector<double>& f, double tolerance) const;
    /// How far h is known, and the sum of the sizes of its terms.
    double size_of(const Jet<double>& value, const std::vector<double>& state) const;
    /// Whether f is another beyond the zero of this function, where the state is at it or very near.
    bool jumps_at(const JumpInstant& side, double t, const std::vector<double>& state) const;
    std::vector<JumpInstant> watched() const;
    void look_for_grazing(double t, std::span<const double> y, std::span<const double> rate, const Wishes& wishes);
    void look_between(const JumpInstant& instant, double t, const std::vector<double>& state,
                      const Wishes& wishes);
    void take_sides(double t, const std::vector<double>& state);
    [[noreturn]] void refuse(const std::string& why, double t, const std::vector<double>& y) const;

    Program program_;
    std::shared_ptr<const Switched> switched_;
    std::vector<std::string> side_names_;
    std::vector<int> by_;
    std::size_t size_, first_side_ = 0;
    std::vector<double> parameters_;
    std::optional<Saltation> saltation_;
    std::vector<JumpInstant> instants_;
    std::size_t next_ = 0;
    std::optional<JumpInstant> last_;
    long steps_ = 0, evaluations_ = 0;
    double before_time_ = 0;
    std::vector<double> before_state_;
    std::vector<Seen> before_;
};

}  // namespace alembert
