// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A sweep whose motions come in parts, so that their number is not bound by memory and several processes can
/// share them.
///
///     Sweeper sweeper(scene, grid, wishes);
///     sweeper.check();
///     sweeper.compile();
///     sweeper.run({.next = [&] { return more(); }, .done = [&](auto part, auto motions) { … }}, 0);
///
/// A motion does not depend on the part to which it belongs, nor on the number of threads, not even in the last
/// bit.

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "alembert/batch/ensemble.hpp"
#include "analysis/state/inertia_check.hpp"
#include "analysis/state/left_out.hpp"
#include "simulate/input_variants.hpp"
#include "simulate/phased_members.hpp"
#include "simulate/sweep.hpp"

namespace alembert {

/// Gives parts of a sweep and takes their motions. `next` and `done` are called by several threads, each by one at
/// a time.
struct SweepDesk {
    std::function<std::optional<SweepPart>()> next;  ///< nothing: there are no more. It may wait.
    std::function<void(SweepPart part, std::vector<SweptMotion> motions)> done;
    std::function<void()> breathe = {};                          ///< called now and then on the calling thread
    std::size_t most = std::numeric_limits<std::size_t>::max();  ///< how many motions come at the most
};

class Sweeper {
public:
    /// Derives and emits. Throws what `derived` throws; std::invalid_argument for numbers that no option can
    /// be and for a wrong grid (check_grid); ModelError for methods that do not run in sweeps. `along` is a list
    /// of min, max, mean.
    Sweeper(Scene scene, Grid grid, const RunOptions& wishes, std::vector<std::string> along = {});
    Sweeper(const Sweeper&) = delete;
    Sweeper& operator=(const Sweeper&) = delete;

    /// Throws IntegrationError if the mass matrix is singular; SceneError for the first of a million motions with
    /// an impossible mass or moment; a later one is told in its row. Warns of broken triangle inequalities, once
    /// for each body.
    void check();
    /// Compiles and loads. Throws CompileError.
    void compile();
    /// Integrates what the desk gives. `threads` is 0 for as many as there are cores. Throws what the desk throws.
    void run(const SweepDesk& desk, int threads);

    /// Everything except the motions.
    const Sweep& sweep() const { return s_; }
    Sweep& sweep() { return s_; }
    /// Tells this sweep from every other: scene, points, settings, equations and the version of the program.
    const std::string& key() const { return key_; }

private:
    /// A part of which some motions are not done yet.
    struct OpenPart {
        SweepPart part;
        std::vector<SweptMotion> motions;
        std::size_t left;
    };

    Options options_for();
    Options options_of_phased();
    void compile_smooth();
    void compile_phased();
    void make_key();
    std::optional<Member> next(const SweepDesk& desk);
    /// Nothing if the motion cannot begin; its row then says why.
    std::optional<Member> member(std::size_t k, const SweepDesk& desk);
    std::optional<std::string> impossible_body(const Start& start) const;
    SweptMotion motion_of(const Member& member, const Outcome& outcome, std::span<const double> state) const;
    SweptMotion refused(const std::string& why) const;
    void keep(std::size_t k, SweptMotion motion, const SweepDesk& desk);
    void note_ended(std::size_t k, const std::vector<EndedEvents::One>& ended);
    /// Warns of events whose expressions end, once of each.
    void tell_ended();

    Sweep s_;
    RunOptions wishes_;
    Program program_, constraints_;
    std::optional<LeftOut> left_out_;
    std::string source_;
    MethodChoice choice_;
    Options options_;
    bool is_assembled_ = false, has_varied_bodies_ = false;
    std::optional<Starts> starts_;
    std::optional<InertiaCheck> bodies_;
    std::optional<InputVariants> variants_;
    std::optional<PhasedMembers> phased_;  ///< if motions are not smooth
    std::optional<Ensemble> ensemble_;     ///< once it is compiled; without members
    std::string key_;
    std::map<int, std::pair<std::size_t, EndedEvents::One>> ended_;  ///< by event, in which motion first

    std::mutex taking_, giving_;
    SweepPart current_ = {};                ///< what is left of the part from which members are taken
    OpenPart* taken_ = nullptr;             ///< this part
    std::map<std::size_t, OpenPart> open_;  ///< by the first motion
};

}  // namespace alembert
