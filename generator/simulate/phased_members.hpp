// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Motions of a sweep that are not smooth: contacts, dry friction, signs in the equations, impulses of events.
/// Each is followed as `simulate` follows it, by itself; all share the compiled contact modes.
///
///     if (is_phased(mechanism, program)) {
///         PhasedMembers members(derived, wishes, method, options, false);
///         ensemble.module = members.compile(first);
///         ensemble.by = [&](const Member& member, std::vector<double>& state) { return members(member, state); };
///     }
///
/// A motion depends neither on those before it nor on the number of threads.

#include "alembert/batch/ensemble.hpp"
#include "analysis/contact/contacts.hpp"
#include "analysis/contact/kicks.hpp"
#include "simulate/loaded_modes.hpp"
#include "simulate/mass_watch.hpp"

namespace alembert {

/// Whether a motion has to be followed piece by piece, or looked at after each step. Functions that only bend
/// (abs, min, max, short tables without close knots) are left to the control of the steps, unless velocities jump
/// there. `program` is that of the mechanism.
bool is_phased(const Mechanism& mechanism, const Program& program);

class PhasedMembers {
public:
    /// The arguments must outlive this object. `options` are those of all motions but for their starts and
    /// durations; with `along`, outcomes have extremes and means.
    PhasedMembers(const Derived& derived, const RunOptions& wishes, const MethodChoice& method,
                  const Options& options, bool along);

    /// Compiles the mode in which all contacts are open, and returns its solver. Throws CompileError.
    Module compile(const State<double>& first);

    /// The free mode; after `compile`.
    const CompiledMode& free() const { return *free_; }
    int operations() const { return compiled_.operations(); }
    /// Processor time of deriving, emitting and compiling the modes so far.
    double seconds_of_compiler() const {
        const CompiledModes::Seconds& s = compiled_.seconds();
        return s.derive + s.emit + s.compile;
    }

    /// To be held while expressions are touched on another thread than those that integrate.
    std::recursive_mutex& symbols() { return compiled_.symbols; }

    /// Why a motion cannot begin at this state: a gap that is negative. Under the lock `symbols`.
    std::optional<std::string> obstacle(const Start& start) const;

    /// `state` is that at the start, and then that at the end. A motion that cannot begin is an Outcome with a
    /// failure whose numbers are NaN.
    Outcome operator()(const Member& member, std::vector<double>& state);

private:
    Outcome followed(const Member& member, std::vector<double>& state);
    Contacts contacts_at(const Start& start);

    const Derived& derived_;
    const Options& options_;
    bool along_;
    Work work_;
    CompiledModes compiled_;
    const CompiledMode* free_ = nullptr;
    std::optional<ContactView> view_;
    std::optional<KickView> kicks_;
    std::shared_ptr<const InertiaCheck> bodies_;  ///< where masses change
    bool has_long_tables_ = false;
};

}  // namespace alembert
