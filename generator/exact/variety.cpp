// SPDX-License-Identifier: GPL-2.0-or-later
// f is evaluated at four values of one unknown; if it is quadratic, the third difference vanishes. In τ = tan(v/2)
// a function that is linear in cos v and sin v is a quadratic over 1 + τ².
#include "exact/variety.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "exact/angle_sum.hpp"
#include "exact/square_points.hpp"

namespace alembert {

namespace {

using Key = std::pair<Variable::Kind, int>;

enum class How {
    plain,  ///< a coordinate outside angles, a parameter, t
    sum,    ///< a coordinate inside angles that is a sum of whole multiples of variables
    turn,   ///< the angle of a coordinate, not the coordinate itself
};

struct Unknown {
    Key key;
    How how = How::plain;
    AngleSum sum = {};  ///< the terms of a sum
};

/// An equation and the unknown for which it is solved.
struct Step {
    int position;
    Unknown unknown;
    std::optional<Key> spare = {};  ///< a variable of this equation that does not occur in those solved before it
    double degree = 1;
};

class Solving {
public:
    Solving(const Program& program, const std::vector<int>& positions, const std::vector<int>& others,
            const std::map<Key, Prime>& given, bool turns)
        : program_(program), positions_(positions), all_(positions), given_(given), turns_(turns) {
        all_.insert(all_.end(), others.begin(), others.end());
        for (const int f : positions_) depends_.push_back(variables_of({f}));
        std::vector<int> arguments;
        for (const int id : program.needed(all_))
            if (const Op op = program[id].op; op >= Op::sin && op != Op::sqrt && op != Op::abs)
                arguments.insert(arguments.end(), program[id].args.begin(), program[id].args.end());
        inside_ = variables_of(arguments);
        halvings_ = halvings(program_, all_);
        plan();
        std::set<Key> solved;
        for (const Step& step : steps_) solved.insert(step.unknown.key);
        usable_.emplace(std::vector{SquarePoints::Part{&program_, all_}}, solved);
    }

    Variety go(int count) {
        Variety result;
        constexpr std::uint64_t trials = 400;
        result.on_variety = solvable_;
        if (!solvable_) steps_.clear();
        for (std::uint64_t seed = 1; seed < trials && static_cast<int>(result.points.size()) < count; ++seed)
            if (auto point = solved(seed)) result.points.push_back(std::move(*point));
        for (const Step& step : steps_) {
            result.degree *= 1 + step.degree;
            result.conditions += 1;
        }
        return result;
    }

private:
    std::set<Key> variables_of(const std::vector<int>& roots) const {
        std::set<Key> result;
        for (const int id : program_.needed(roots))
            if (program_[id].op == Op::variable)
                result.emplace(program_[id].variable.kind, program_[id].variable.index);
        return result;
    }

    ModularPoint start(std::uint64_t seed) const {
        return {.seed = seed,
                .given = given_,
                .given_angles = {},
                .halves = halves_,
                .finer = std::max(0, halvings_ - halves_)};
    }

    static void set(ModularPoint& point, const Unknown& unknown, Prime value) {
        if (unknown.how == How::turn)
            point.given_angles[point.variable({unknown.key.first, unknown.key.second})] =
                PrimeTurn::rational(value);
        else
            point.given[unknown.key] = value;
    }

    /// Coefficients of f (times 1 + τ² for a turn) as a polynomial in the unknown; nothing if it is not quadratic.
    std::optional<std::array<Prime, 3>> quadratic(int f, const Unknown& unknown, ModularPoint point,
                                                  double* degree) const {
        std::array<Prime, 4> value;
        for (int k = 0; k < 4; ++k) {
            set(point, unknown, k);
            const auto at = evaluate_mod(program_, point, std::array{f});
            if (!at || !at->exact) return std::nullopt;
            value[k] = at->value[f] * (unknown.how == How::turn ? Prime(1 + k * k) : Prime(1));
            if (degree != nullptr) *degree = at->degree[f];
        }
        if (!(value[3] - 3 * value[2] + 3 * value[1] - value[0]).is_zero()) return std::nullopt;
        const Prime second = (value[2] - 2 * value[1] + value[0]) * Prime(2).inverse();
        return std::array{value[0], value[1] - value[0] - second, second};
    }

    /// Decides for which unknown each constraint is solved, beginning with the one solved last (whose unknown no
    /// other constraint needs).
    void plan() {
        std::set<int> left;
        for (std::size_t k = 0; k < positions_.size(); ++k) left.insert(static_cast<int>(k));
        while (!left.empty() && solvable_) {
            solvable_ = false;
            for (const How how : {How::plain, How::sum, How::turn})
                for (const auto kind :
                     {Variable::Kind::coordinate, Variable::Kind::parameter, Variable::Kind::time})
                    for (const int k : left)
                        if (!solvable_ && possible(how, kind) && give(k, kind, how, left)) {
                            solvable_ = true;
                            left.erase(k);
                            break;
                        }
        }
        std::reverse(steps_.begin(), steps_.end());
        std::set<Key> held;
        for (Step& step : steps_) {
            const auto k = std::find(positions_.begin(), positions_.end(), step.position) - positions_.begin();
            for (const Key& key : depends_[k])
                if (key != step.unknown.key && held.count(key) == 0 && given_.count(key) == 0) step.spare = key;
            held.insert(depends_[k].begin(), depends_[k].end());
        }
    }

    bool possible(How how, Variable::Kind kind) const {
        return how == How::plain || (kind == Variable::Kind::coordinate && (how == How::sum || turns_));
    }

    bool give(int k, Variable::Kind kind, How how, const std::set<int>& left) {
        for (const Key& key : depends_[k]) {
            if (key.first != kind || given_.count(key) != 0 || (inside_.count(key) != 0) != (how != How::plain))
                continue;
            if (std::any_of(left.begin(), left.end(),
                            [&](int j) { return j != k && depends_[j].count(key) != 0; }))
                continue;
            Step step{.position = positions_[k], .unknown = {.key = key, .how = how}};
            if (how == How::sum) {
                const auto sum = angle_sum(program_, step.position, {key.first, key.second});
                if (!sum) continue;
                step.unknown.sum = *sum;
            }
            const int former = halves_;
            if (how == How::turn) halves_ = 0;  // sin(v/2) with a given v would then make every point unusable
            for (std::uint64_t seed = 1; seed <= 3; ++seed)
                if (const auto c = quadratic(step.position, step.unknown, start(seed), &step.degree);
                    c && !((*c)[1].is_zero() && (*c)[2].is_zero())) {
                    steps_.push_back(step);
                    return true;
                }
            halves_ = former;
        }
        return false;
    }

    std::optional<ModularPoint> solved(std::uint64_t seed) const {
        constexpr std::uint64_t most_turns = 40;
        auto chosen = usable_->at(start(seed));
        if (!chosen) return std::nullopt;
        ModularPoint point = std::move(*chosen);
        for (const Step& step : steps_) {
            std::optional<Prime> root = root_of(step, point, seed);
            // If the number is no square, the variable that the steps before do not contain gets another value.
            for (std::uint64_t turn = 1; !root && step.spare && turn < most_turns; ++turn) {
                point.given[*step.spare] = point.random(400, static_cast<std::uint64_t>(step.position), turn);
                root = root_of(step, point, seed);
            }
            if (!root) return std::nullopt;
            set(point, step.unknown, *root);
            if (step.unknown.how == How::sum) set_angle(point, step.unknown.sum, *root);
        }
        const auto at = evaluate_mod(program_, point, all_);
        if (!at) return std::nullopt;
        for (const int f : positions_)
            if (solvable_ && !at->value[f].is_zero()) return std::nullopt;
        return point;
    }

    std::optional<Prime> root_of(const Step& step, const ModularPoint& point, std::uint64_t seed) const {
        const auto c = quadratic(step.position, step.unknown, point, nullptr);
        if (!c) return std::nullopt;
        const auto [low, middle, high] = *c;
        if (high.is_zero()) return middle.is_zero() ? std::nullopt : std::optional(-low * middle.inverse());
        const Prime under = middle * middle - 4 * low * high;
        if (!under.is_square()) return std::nullopt;
        return (seed % 2 == 0 ? under.root() - middle : -under.root() - middle) * (2 * high).inverse();
    }

    const Program& program_;
    std::vector<int> positions_, all_;
    std::map<Key, Prime> given_;
    std::vector<std::set<Key>> depends_;
    std::set<Key> inside_;  ///< variables inside angles, exponents and similar functions
    std::vector<Step> steps_;
    bool turns_, solvable_ = true;
    int halves_ = 2, halvings_ = 0;
    std::optional<SquarePoints> usable_;
};

}  // namespace

Variety variety_points(const Program& program, const std::vector<int>& positions, const std::vector<int>& others,
                       int count, const std::map<std::pair<Variable::Kind, int>, Prime>& given) {
    for (const bool turns : {true, false})
        if (Variety found = Solving(program, positions, others, given, turns).go(count);
            found.on_variety && static_cast<int>(found.points.size()) == count)
            return found;
    std::vector<int> all = positions;
    all.insert(all.end(), others.begin(), others.end());
    Variety beside = Solving(program, {}, all, given, false).go(count);
    beside.on_variety = positions.empty();
    return beside;
}

}  // namespace alembert
