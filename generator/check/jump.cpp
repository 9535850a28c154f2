// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/jump.hpp"

#include <algorithm>
#include <initializer_list>

#include "algebra/symbolic/impossible.hpp"
#include "analysis/exact/cells.hpp"
#include "analysis/exact/expression_of.hpp"
#include "check/in_print.hpp"
#include "check/vanishing.hpp"
#include "model/parameter_values.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;
using Key = RealState::Key;

namespace {

bool is_one_of(Op op, std::initializer_list<Op> list) {
    return std::find(list.begin(), list.end(), op) != list.end();
}

/// What is divided by in the nodes.
std::vector<int> divisors(const Program& p, const std::vector<int>& nodes) {
    std::vector<int> result;
    for (const int id : nodes)
        for (std::size_t k = 0; p[id].op == Op::product && k < p[id].args.size(); ++k)
            if (p[id].exponents[k] < 0) result.push_back(p[id].args[k]);
    return result;
}

/// Whether a node may have other limits from one side than from the other: signs, quotients of what has sides.
bool has_jumping_sides(const Program& p, int node) {
    const std::vector<int> needed = p.needed(std::vector<int>{node});
    const auto has = [&](std::initializer_list<Op> ops) {
        return std::any_of(needed.begin(), needed.end(), [&](int id) { return is_one_of(p[id].op, ops); });
    };
    return has({Op::sign}) || (has({Op::abs, Op::min, Op::max, Op::sqrt}) && !divisors(p, needed).empty());
}

/// Where bounded functions jump: atan(1/x) at x = 0, atan2(y, x) at y = 0.
std::vector<int> poles_below_bounded(const Program& p, int node) {
    std::vector<int> result;
    for (const int id : p.needed(std::vector<int>{node})) {
        if (p[id].op == Op::atan2) result.push_back(p[id].args[0]);
        if (!is_one_of(p[id].op, {Op::atan, Op::tanh, Op::exp})) continue;
        const std::vector<int> below = divisors(p, p.needed(std::vector<int>{p[id].args[0]}));
        result.insert(result.end(), below.begin(), below.end());
    }
    return result;
}

class Borders {
public:
    Borders(const Told& told, const Motions& motions, const Program& program, int node, const IsKept& is_kept)
        : told_(told),
          is_kept_(is_kept),
          motions_(motions),
          program_(program),
          node_(node),
          cells_(program_, std::vector<int>{node}) {}

    FoundJump find() {
        FoundJump result;
        for (const int pole : poles_below_bounded(program_, node_)) look_for(pole, false, result);
        if (!has_jumping_sides(program_, node_)) return result;
        for (const int side : cells_.sides()) look_for(side, true, result);
        return result;
    }

private:
    enum class Found { jumps, continuous, unknown };

    /// `must_know`: whether it is unknown what happens where the border is not reached.
    void look_for(int side, bool must_know, FoundJump& result) {
        if (result.shown) return;
        const auto written = expression_of(program_, side, told_.mechanism, told_.equations.lambda);
        if (written && is_kept_(*written)) return;
        const Found found = look(side, must_know);
        if (found == Found::jumps) {
            result.shown = shown_;
            if (written) result.border = in_print(*written, told_.mechanism);
        }
        if (must_know && found == Found::unknown && !(written && has_one_sign(*written))) result.is_unknown = true;
    }

    bool has_one_sign(const ex& side) const {
        const std::vector<GiNaC::symbol> above_zero = positive_parameters(told_.mechanism);
        return is_impossible({side}, above_zero) || is_impossible({-side}, above_zero);
    }

    /// The variables that one may change to reach the border.
    std::vector<Key> moved(int side) const {
        std::vector<Key> result;
        for (const int id : program_.needed(std::vector<int>{side})) {
            if (program_[id].op != Op::variable) continue;
            const Variable& v = program_[id].variable;
            const bool is_free = told_.mechanism.constraints.empty() || v.kind == Variable::Kind::time;
            if (is_free && (v.kind == Variable::Kind::time || v.kind == Variable::Kind::coordinate ||
                            v.kind == Variable::Kind::rate))
                result.emplace_back(v.kind, v.index);
        }
        return result;
    }

    static numeric get(const RealState& state, const Key& key) {
        const auto angle = state.angle.find(key);
        return angle != state.angle.end() ? angle->second.tangent : state.value.at(key);
    }
    static void put(RealState& state, const Key& key, const numeric& x) {
        if (state.angle.contains(key))
            put_angle(state, key, {.tangent = x});
        else
            state.value[key] = x;
    }

    std::optional<numeric> value(RealState& state, const Key& key, const numeric& x, int node) const {
        put(state, key, x);
        const auto found = evaluate(program_, state, {node});
        return found ? std::optional((*found)[0]) : std::nullopt;
    }

    /// Where the side is zero on the line through the state; by secants.
    std::optional<numeric> zero(RealState state, const Key& key, int side) const {
        const numeric close = GiNaC::pow(numeric(10), numeric(-40));
        numeric x = get(state, key), next = x + 1;
        auto at_x = value(state, key, x, side);
        for (int round = 0; round < 80 && at_x; ++round) {
            const auto at_next = value(state, key, next, side);
            if (!at_next) return std::nullopt;
            if (GiNaC::abs(*at_next) < close) return next;
            if (*at_next == *at_x) return std::nullopt;
            numeric step = *at_next * (next - x) / (*at_next - *at_x);
            if (round > 1) step = GiNaC::ex_to<numeric>(ex(step).evalf());  // fractions do not grow without end
            x = next, at_x = at_next, next = next - step;
        }
        return std::nullopt;
    }

    /// Whether it is a rate without acceleration: no motion crosses the border there.
    static bool rests(const RealState& state, const Key& key) {
        const auto acceleration = state.value.find({Variable::Kind::acceleration, key.second});
        return key.first == Variable::Kind::rate && acceleration != state.value.end() &&
               acceleration->second.is_zero();
    }

    Found look(int side, bool must_know) {
        constexpr unsigned tries = 80;
        const int enough = must_know ? 4 : 24;  // an angle jumps on one half of its border alone
        const FiftyDigits digits;
        const numeric apart = GiNaC::pow(numeric(10), numeric(-20)), small = GiNaC::pow(numeric(10), numeric(-7));
        int reached = 0;
        for (unsigned seed = 0; seed < tries && reached < enough; ++seed) {
            const auto state = real_state(motions_, program_, {node_, side}, seed);
            if (!state) continue;
            for (const Key& key : moved(side)) {
                if (!state->value.contains(key) || rests(*state, key)) continue;
                const auto border = zero(*state, key, side);
                if (!border) continue;
                RealState here = *state;
                const auto above = value(here, key, *border + apart, node_),
                           below = value(here, key, *border - apart, node_);
                if (!above || !below) continue;
                ++reached;
                const numeric height = *above - *below;
                if (GiNaC::abs(height) < small * (1 + GiNaC::abs(*above))) continue;
                put(here, key, *border);
                std::erase_if(here.value, [](const auto& item) {
                    return item.first.first == Variable::Kind::acceleration ||
                           item.first.first == Variable::Kind::unknown;
                });
                shown_ = described(told_, here, height);
                return Found::jumps;
            }
        }
        return reached > 0 ? Found::continuous : Found::unknown;
    }

    const Told& told_;
    const IsKept& is_kept_;
    const Motions& motions_;
    Program program_;
    int node_;
    Cells cells_;
    std::optional<Counterexample> shown_;
};

}  // namespace

IsKept is_kept(Comparison& now, ExactStates& states) {
    return [&](const ex& value) {
        if (now.m.z->depends(value, now.m.qddot) || now.m.z->depends(value, now.e.lambda)) return false;
        Program p;
        const int root = now.claims.lower(p, {now.m.time_derivative({value})[0]})[0];
        double failure = 0;
        return p.is_zero(root) || vanishes_at(states, p, root, failure) == true;
    };
}

FoundJump find_jump(const Told& told, const Motions& motions, const Program& program, int node,
                    const IsKept& is_kept) {
    return Borders(told, motions, program, node, is_kept).find();
}

}  // namespace alembert
