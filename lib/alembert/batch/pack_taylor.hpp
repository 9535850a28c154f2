// SPDX-License-Identifier: MIT
#pragma once

/// One step of Taylor's method (taylor.hpp) for eight systems side by side, each with its own time and step
/// length.
///
///     PackTaylor step(module, series, dimension, extra, tolerance);
///     step.put(lane, t, state, rate, par);     // for each lane; its first step has no length
///     step.end = ...;                          // a time in each lane
///     step.attempt();
///     step.error_norm[lane];                   // the last term; infinite if something is not finite
///     step.finish();                           // the series at the ends
///     step.error_norm[lane];                   // infinite where the rate at the end is not the foreseen one
///     step.advance(accepted);                  // bit i: the end of lane i becomes its start
///     step.next_length(lane);                  // by the series there
///
/// The step of no length with which a lane begins computes the series at its start together with those of the
/// other lanes' ends.

#include <vector>

#include "alembert/batch/pack_series.hpp"
#include "alembert/batch/packs.hpp"
#include "alembert/ode/series_length.hpp"

namespace alembert {

class PackTaylor {
public:
    static constexpr bool has_fixed_step = false;
    static constexpr int most_evaluations = 2;

    PackTaylor(const Module& module, const PackSeries& series, int dimension, int extra, double tolerance);

    void put(int lane, double t, const double* state, const double* rate, const std::vector<double>& par);
    bool is_new(int lane) const { return (new_ >> lane & 1U) != 0; }

    void attempt();
    void finish();
    void advance(unsigned accepted);

    /// How many series were computed in an attempt.
    static int evaluations(bool was_finished) { return was_finished ? 1 : 0; }
    bool foresees_end(int lane) const { return (unforeseen_ >> lane & 1U) == 0; }
    double next_length(int lane) const;
    /// Whether the series at the start of a lane tells how far it holds (Taylor::decays), with its next length.
    bool decays(int lane, double length) const;
    double shorter_length(double h, double ratio) const;

    double state(int component, int lane) const { return y_[place(component)][lane]; }
    double rate(int component, int lane) const { return series_now()[dimension_ + component][lane]; }
    void energies(Lanes (&energy)[5]) const;
    /// The state at h after the start of the lane's last accepted step.
    void within(int lane, double h, std::vector<double>& state) const;

    Lanes time{}, end{}, error_norm{};

private:
    template <int width>
    struct Work;
    struct Compiled;

    static std::size_t place(int i) { return static_cast<std::size_t>(i); }
    const Lanes* series_now() const { return coefficients_.data(); }
    double size(int k, int lane) const { return sizes_[k + 7 - order_][lane]; }
    double most_of(int first, int end, double ratio, int lane) const;

    const alembert_pack_table& pack_;
    const PackSeries& series_;
    int dimension_, controlled_, order_, parameters_;
    bool has_widest_;
    double most_missed_;
    SeriesLength lengths_;
    std::vector<Lanes> y_, rest_, next_, next_rest_, slopes_, par_, series_par_, coefficients_, next_coefficients_,
        work_;
    Lanes sizes_[8];  ///< of the last terms, the last one last
    unsigned new_ = 0, unforeseen_ = 0;
};

}  // namespace alembert
