// SPDX-License-Identifier: GPL-2.0-or-later
// A piece is described by the cubic polynomial through its values at 0, 1/3, 2/3 and 1, which is compared with the
// values at 1/6, 1/2 and 5/6 and with all other known values in the piece.
#include "program/lower/quick_times.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "program/known_knots.hpp"
#include "program/tape.hpp"

namespace alembert {

namespace {

constexpr int first_pieces = 2039;  // a prime, so that no period of an input is likely to be a multiple of a piece
constexpr double fit_tolerance = 0.02;  // relative to a value's range
constexpr double pieces_a_step = 2;
// A piece is sudden if it is this many times shorter than the one before.
constexpr double sudden = 3;
constexpr double shortest = 1e-11;          // relative to the run
constexpr long most_evaluations = 300'000;  // about 20 ms
constexpr std::size_t most_marks = 4096;    // zeros and turning points
constexpr int halvings = 44;                // enough to get from one of the first pieces to the last digit of t

/// The nodes of the right-hand side and of events that depend only on t and parameters, without t itself.
std::vector<int> inputs_of(const Program& program) {
    std::vector<int> roots = program.right_hand_side();
    const std::vector<int> events = program.nodes_of(Group::event);
    roots.insert(roots.end(), events.begin(), events.end());
    std::vector<int> inputs;
    for (const int id : program.needed(roots)) {
        const unsigned depends = program[id].depends, time = bit(Variable::Kind::time);
        if ((depends & time) != 0 && (depends & ~(time | bit(Variable::Kind::parameter))) == 0 &&
            program[id].op != Op::variable)
            inputs.push_back(id);
    }
    return inputs;
}

/// The nodes that contain a call of a table whose knots are known, and the calls.
struct KnownCalls {
    explicit KnownCalls(const Program& program) {
        std::vector<int> roots = program.right_hand_side();
        const std::vector<int> events = program.nodes_of(Group::event);
        roots.insert(roots.end(), events.begin(), events.end());
        for (const int id : program.needed(roots)) {
            const Node& node = program[id];
            bool contains =
                std::any_of(node.args.begin(), node.args.end(), [this](int arg) { return above.contains(arg); });
            if (node.op == Op::unspecified && program.table_of(node) != nullptr) {
                const Program::TableCall call = program.table_call(node);
                for (std::size_t k = 0; k < call.arguments; ++k)
                    if (has_known_knots(program, *program.table_of(node), call, k)) {
                        calls.push_back({program.shared_table_of(node), call.argument[k], k});
                        contains = true;
                    }
            }
            if (contains) above.insert(id);
        }
    }

    struct One {
        std::shared_ptr<const TabulatedFunction> table;
        int argument;
        std::size_t axis;
    };
    std::vector<One> calls;
    std::set<int> above;
};

struct TimesOfKnots {
    std::vector<double> times = {};  ///< in order
    double longest = HUGE_VAL;       ///< of steps, where there are too many times
};

/// The times between at which one of the calls is at a knot. Of calls with millions of them no step passes two.
TimesOfKnots times_of_knots(const Program& program, const KnownCalls& known, const std::vector<double>& parameters,
                            double start, double end) {
    constexpr double most = 1e6;
    TimesOfKnots result;
    std::vector<double>& times = result.times;
    for (const KnownCalls::One& one : known.calls) {
        Tape<double> tape(program, {one.argument}, parameters);
        double first = 0, last = 0;
        tape(start, nullptr, nullptr, &first);
        tape(end, nullptr, nullptr, &last);
        const TableAxis& axis = one.table->axes()[one.axis];
        const double low = std::min(first, last), high = std::max(first, last);
        const auto turn_of = [&](double x) { return std::floor((x - axis.at.front()) / axis.period); };
        const double turns = axis.period > 0 ? turn_of(high) - turn_of(low) + 1 : 1;
        if (!(high > low)) continue;
        if (!(turns * static_cast<double>(axis.kinks.size()) < most)) {
            for (std::size_t k = 1; k < axis.kinks.size(); ++k) {
                const double gap = axis.at[static_cast<std::size_t>(axis.kinks[k])] -
                                   axis.at[static_cast<std::size_t>(axis.kinks[k - 1])];
                result.longest = std::min(result.longest, gap * (end - start) / (high - low));
            }
            continue;
        }
        for (double turn = 0; turn < turns; ++turn)
            for (const int kink : axis.kinks) {
                double x = axis.at[static_cast<std::size_t>(kink)];
                if (axis.period > 0) x += (turn_of(low) + turn) * axis.period;
                const double t = start + (end - start) * ((x - first) / (last - first));
                if (t > start && t < end) times.push_back(t);
            }
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return result;
}

/// No step is longer than this.
std::vector<InputTimeScale> with_longest(std::vector<InputTimeScale> quick, double longest, double start,
                                         double end) {
    if (!(longest < end - start)) return quick;
    std::vector<InputTimeScale> result;
    const auto until = [&](double to) {
        if (start < to) result.push_back({.from = start, .to = to, .enter = longest, .step = longest});
    };
    for (InputTimeScale q : quick) {
        until(q.from);
        if (q.from < q.to && !q.is_switch)
            q.step = std::min(q.step, longest), q.enter = std::min(q.enter, longest);
        result.push_back(q);
        start = std::max(start, q.to);
    }
    until(end);
    return result;
}

/// A step that begins earlier ends at each of these times, also where they lie in intervals that are quick.
std::vector<InputTimeScale> with_ends_at(std::vector<InputTimeScale> quick, const std::vector<double>& times) {
    if (times.empty()) return quick;
    std::vector<InputTimeScale> result;
    auto next = times.begin();
    const auto until = [&](double end) {
        for (; next != times.end() && *next < end; ++next)
            result.push_back({.from = *next, .to = *next, .is_switch = true});
    };
    for (InputTimeScale q : quick) {
        until(q.from);
        for (; next != times.end() && *next < q.to; ++next) {
            if (*next == q.from) continue;
            InputTimeScale before = q;
            before.to = *next;
            result.push_back(before);
            q.from = *next, q.enter = 0;
        }
        result.push_back(q);
    }
    until(HUGE_VAL);
    return result;
}

/// Functions that may be quick although the table in them is not, as exp(−((u(t) − a)/w)²), and what they take.
struct QuickOfTables {
    QuickOfTables(const Program& program, const std::vector<int>& inputs, const std::set<int>& above_tables) {
        for (const int id : inputs) {
            const Node& node = program[id];
            const bool is_function = node.op != Op::sum && node.op != Op::product && node.op != Op::unspecified;
            if (!above_tables.contains(id) || !is_function) continue;
            functions.push_back(id);
            for (const int arg : node.args)
                if (above_tables.contains(arg)) arguments.push_back(arg);
        }
    }
    std::vector<int> functions, arguments;
};

class Search {
public:
    /// `marks` are looked at for zeros and turning points alone.
    Search(const Program& program, std::vector<int> inputs, const std::vector<int>& marks,
           const std::vector<double>& parameters, double start, double end)
        : ranges_(inputs.size()),
          tape_(program, joined(std::move(inputs), marks), parameters),
          start_(start),
          end_(end) {}

    /// Nothing if it would take too long.
    std::optional<std::vector<InputTimeScale>> go() {
        for (int i = 0; i <= first_pieces; ++i) known_.push_back(at(start_ + (end_ - start_) * i / first_pieces));
        mark();
        std::sort(known_.begin(), known_.end(), [](const Sample& a, const Sample& b) { return a.t < b.t; });
        measure_ranges();
        divide(start_, end_);
        if (is_over_budget()) return std::nullopt;
        join();
        std::vector<InputTimeScale> result;
        double before = 0;
        for (const Piece& piece : pieces_) {
            const double length = piece.to - piece.from, reach = pieces_a_step * length;
            // In a long step all stages but the last ones lie before the piece in which it ends. Therefore it must
            // not end inside a pulse that happens to be zero there.
            const bool is_sudden = piece.is_switch || before > sudden * length;
            before = length;
            if (reach >= end_ - start_) continue;
            result.push_back({.from = piece.from,
                              .to = piece.to,
                              .enter = is_sudden ? 0 : reach,
                              .step = piece.is_switch ? length : reach,
                              .is_switch = piece.is_switch});
        }
        if (is_over_budget()) return std::nullopt;
        return result;
    }

private:
    static std::vector<int> joined(std::vector<int> list, const std::vector<int>& more) {
        list.insert(list.end(), more.begin(), more.end());
        return list;
    }

    struct Sample {
        double t;
        std::vector<double> values;
    };
    struct Piece {
        double from, to;
        bool is_switch;
    };

    bool is_over_budget() const { return evaluations_ > most_evaluations; }

    Sample at(double t) {
        Sample sample{.t = t, .values = std::vector<double>(tape_.size())};
        tape_(t, nullptr, nullptr, sample.values.data());
        ++evaluations_;
        return sample;
    }
    double value(std::size_t k, double t) { return at(t).values[k]; }

    /// Adds the instants at zeros and turning points of all values, and close to them.
    void mark() {
        const std::size_t count = known_.size();
        std::vector<double> marks;
        for (std::size_t k = 0; k < tape_.size(); ++k)
            for (std::size_t i = 0; i + 1 < count && marks.size() < most_marks; ++i) {
                const double a = known_[i].values[k], b = known_[i + 1].values[k];
                if ((a < 0 && b > 0) || (a > 0 && b < 0))
                    marks.push_back(zero(k, known_[i].t, known_[i + 1].t, a));
                if (i == 0) continue;
                const double before = known_[i - 1].values[k];
                if ((a - before) * (b - a) < 0)
                    marks.push_back(turn(k, known_[i - 1].t, known_[i + 1].t, a > before ? 1 : -1));
                if (a == 0 && before != 0) marks.push_back(known_[i].t);
            }
        std::sort(marks.begin(), marks.end());
        const double piece = (end_ - start_) / first_pieces;
        marks.erase(
            std::unique(marks.begin(), marks.end(), [&](double a, double b) { return b - a < 1e-9 * piece; }),
            marks.end());
        for (const double t : marks) {
            known_.push_back(at(t));
            for (double away = piece / 4; away > shortest * (end_ - start_); away /= 4)
                for (const double beside : {t - away, t + away})
                    if (beside > start_ && beside < end_ && beside != t) known_.push_back(at(beside));
        }
    }

    double zero(std::size_t k, double left, double right, double g_left) {
        for (int i = 0; i < halvings; ++i) {
            const double middle = (left + right) / 2, g = value(k, middle);
            if (g == 0) return middle;
            ((g > 0) == (g_left > 0) ? left : right) = middle;
        }
        return (left + right) / 2;
    }

    /// Golden-section search, as far as rounding permits to distinguish a parabola from a line.
    double turn(std::size_t k, double left, double right, int side) {
        constexpr double golden = 0.6180339887498949;
        double a = right - golden * (right - left), b = left + golden * (right - left);
        double g_a = side * value(k, a), g_b = side * value(k, b);
        for (int i = 0; i < halvings; ++i) {
            if (g_a > g_b) {
                right = b, b = a, g_b = g_a;
                g_a = side * value(k, a = right - golden * (right - left));
            } else {
                left = a, a = b, g_a = g_b;
                g_b = side * value(k, b = left + golden * (right - left));
            }
        }
        return (left + right) / 2;
    }

    void measure_ranges() {
        std::fill(ranges_.begin(), ranges_.end(), 0);
        for (std::size_t k = 0; k < ranges_.size(); ++k) {
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (const Sample& sample : known_) {
                if (!std::isfinite(sample.values[k])) continue;
                low = std::min(low, sample.values[k]);
                high = std::max(high, sample.values[k]);
            }
            // A value that is constant except for rounding has no range.
            if (high - low > 1e-12 * std::max(std::abs(low), std::abs(high))) ranges_[k] = high - low;
        }
    }

    bool is_cubic(double from, double to) {
        std::array<Sample, 4> fixed;
        for (std::size_t i = 0; i < fixed.size(); ++i)
            fixed[i] = at(from + (to - from) * static_cast<double>(i) / 3);
        const auto fits = [&](const Sample& sample) {
            const double s = 3 * (sample.t - from) / (to - from);
            const std::array<double, 4> weight = {-(s - 1) * (s - 2) * (s - 3) / 6, s * (s - 2) * (s - 3) / 2,
                                                  -s * (s - 1) * (s - 3) / 2, s * (s - 1) * (s - 2) / 6};
            for (std::size_t k = 0; k < ranges_.size(); ++k) {
                if (ranges_[k] == 0) continue;
                double cubic = 0;
                for (std::size_t i = 0; i < fixed.size(); ++i) cubic += weight[i] * fixed[i].values[k];
                if (std::abs(cubic - sample.values[k]) > fit_tolerance * ranges_[k]) return false;
            }
            return true;
        };
        for (const double place : {1. / 6, 0.5, 5. / 6})
            if (!fits(at(from + (to - from) * place))) return false;
        const auto first = std::lower_bound(known_.begin(), known_.end(), from,
                                            [](const Sample& sample, double t) { return sample.t < t; });
        for (auto sample = first; sample != known_.end() && sample->t <= to; ++sample)
            if (!fits(*sample)) return false;
        return true;
    }

    void divide(double from, double to) {
        if (is_over_budget()) return;
        const double least = std::max(shortest * (end_ - start_), 256 * std::numeric_limits<double>::epsilon() *
                                                                      std::max(std::abs(from), std::abs(to)));
        const bool is_short = to - from <= least, fits = is_cubic(from, to);
        if (fits || is_short) {
            pieces_.push_back({from, to, !fits});
            return;
        }
        divide(from, (from + to) / 2);
        divide((from + to) / 2, to);
    }

    /// Halving leaves pieces that are shorter than necessary, especially next to a switch; these are joined. Two
    /// pieces of equal length are not, because little would be gained.
    void join() {
        std::vector<Piece> joined;
        for (const Piece& piece : pieces_) {
            Piece* const last = joined.empty() ? nullptr : &joined.back();
            const bool is_uneven = last && std::abs((last->to - last->from) / (piece.to - piece.from) - 1) > 0.1;
            const bool is_one =
                last && (piece.is_switch ? last->is_switch
                                         : !last->is_switch && is_uneven && is_cubic(last->from, piece.to));
            if (is_one)
                last->to = piece.to;
            else
                joined.push_back(piece);
        }
        pieces_ = std::move(joined);
    }

    std::vector<double> ranges_;  ///< of the inputs
    Tape<double> tape_;
    double start_, end_;
    std::vector<Sample> known_;
    std::vector<Piece> pieces_;
    long evaluations_ = 0;
};

}  // namespace

std::vector<InputTimeScale> quick_times(const Program& program, const std::vector<double>& parameters,
                                        double start, double end) {
    if (!(end > start) || !std::isfinite(end - start)) return {};
    std::vector<int> inputs = inputs_of(program);
    const KnownCalls known(program);
    const QuickOfTables quick(program, inputs, known.above);
    std::erase_if(inputs, [&](int id) { return known.above.contains(id); });
    std::optional<std::vector<InputTimeScale>> found;
    if (!quick.functions.empty()) {
        std::vector<int> all = inputs;
        all.insert(all.end(), quick.functions.begin(), quick.functions.end());
        found = Search(program, std::move(all), quick.arguments, parameters, start, end).go();
    }
    if (!found && !inputs.empty()) found = Search(program, std::move(inputs), {}, parameters, start, end).go();
    const TimesOfKnots knots = times_of_knots(program, known, parameters, start, end);
    return with_longest(with_ends_at(std::move(found).value_or(std::vector<InputTimeScale>()), knots.times),
                        knots.longest, start, end);
}

std::vector<InputTimeScale> sudden_times(const std::vector<InputTimeScale>& quick) {
    constexpr int shown_after = 8;
    std::vector<InputTimeScale> result;
    int left = 0;
    for (const InputTimeScale& q : quick) {
        left = q.enter == 0 ? shown_after : left - 1;
        if (left > 0) result.push_back(q);
    }
    return result;
}

std::vector<bool> parameters_of_inputs(const Program& program, std::size_t count) {
    std::vector<bool> used(count);
    for (const int id : program.needed(inputs_of(program)))
        if (program[id].op == Op::variable && program[id].variable.kind == Variable::Kind::parameter)
            used[static_cast<std::size_t>(program[id].variable.index)] = true;
    return used;
}

}  // namespace alembert
