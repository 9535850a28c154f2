// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/language/say.hpp"
#include "check/ways.hpp"
#include "check/zero.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_choices = 64;

class Motion {
public:
    Motion(const Scene& scene, Claims& read, const std::vector<std::size_t>& which)
        : m_(read.mechanism()), e_(read.equations()) {
        for (const Mechanism::Input& input : m_.inputs) inputs_[input.derivative[0]] = m_.z->expand(input.value);
        for (const Mechanism::Input& input : m_.inputs) {
            const ex value = in_time(input.derivative[0]);
            for (int order = 1; order < 3; ++order)
                inputs_[input.derivative[static_cast<std::size_t>(order)]] =
                    value.diff(m_.t, static_cast<unsigned>(order));
        }
        for (const std::size_t k : which) {
            const std::string& name = scene.claims[k].equation.lhs.tree->text;
            const ex value = in_time(m_.z->expand(read.read(scene.claims[k].equation.rhs)));
            for (int i = 0; i < m_.size(); ++i)
                if (m_.q[i].get_name() == name) give(i, value);
            for (const auto* list : {&m_.constraints, &m_.redundant})
                for (const Mechanism::Constraint& c : *list)
                    if (c.multiplier.get_name() == name) at_[c.multiplier] = value;
        }
    }

    /// The expressions that must vanish: those of the equations of motion, then those of the constraints.
    std::vector<ex> rows() const {
        std::vector<ex> result;
        for (int i = 0; i < e_.size(); ++i) {
            GiNaC::exvector terms{-e_.forcing(i)};
            for (int j = 0; j < e_.size(); ++j) terms.push_back(e_.M(i, j) * e_.udot[j]);
            for (std::size_t k = 0; k < e_.A.size(); ++k) terms.push_back(-e_.A[k][i] * e_.lambda[k]);
            result.push_back(GiNaC::add(std::move(terms)));
        }
        for (const Mechanism::Constraint& c : m_.constraints) {
            GiNaC::exvector terms{c.offset};
            for (int i = 0; i < m_.size(); ++i) terms.push_back(c.row[i] * m_.qdot[i]);
            result.push_back(c.position ? *c.position : ex(GiNaC::add(std::move(terms))));
        }
        return result;
    }

    bool is_readable(const ex& row) const { return m_.z->tree_size(row) <= longest_tested; }

    /// The value of `row` along the motion that the claims give.
    ex along(const ex& row) const { return in_time(m_.z->expand(row)).subs(at_, GiNaC::subs_options::no_pattern); }

    /// The multipliers that remain in `along`: no claim gives them.
    std::vector<GiNaC::symbol> open_multipliers(const ex& along) const {
        std::vector<GiNaC::symbol> result;
        for (const GiNaC::symbol& multiplier : e_.lambda)
            if (along.has(multiplier)) result.push_back(multiplier);
        return result;
    }

    /// Coordinates that remain in `along`: the claims would have to give them as well.
    std::vector<std::string> missing(const ex& along) const {
        std::vector<std::string> names;
        for (int i = 0; i < m_.size(); ++i)
            if (along.has(m_.q[i]) || along.has(m_.qdot[i]) || along.has(m_.qddot[i]))
                names.push_back(m_.q[i].get_name());
        return names;
    }

    bool speaks_of(const ex& row, const std::string& name) const {
        const ex whole = m_.z->expand(row);
        for (int i = 0; i < m_.size(); ++i)
            if (m_.q[i].get_name() == name)
                return whole.has(m_.q[i]) || whole.has(m_.qdot[i]) || whole.has(m_.qddot[i]);
        return std::any_of(e_.lambda.begin(), e_.lambda.end(), [&](const GiNaC::symbol& multiplier) {
            return multiplier.get_name() == name && whole.has(multiplier);
        });
    }

    std::string name_of(std::size_t row) const {
        const auto n = static_cast<std::size_t>(e_.size());
        return row < n ? say("the equation of motion of {}", m_.q[row].get_name())
                       : say("constraint '{}'", m_.constraints[row - n].name);
    }

    const Mechanism& mechanism() const { return m_; }

private:
    /// `e` with the inputs written out. An input may contain another one, therefore the substitution is repeated.
    ex in_time(ex e) const {
        for (std::size_t k = 0; k < m_.inputs.size(); ++k) e = e.subs(inputs_, GiNaC::subs_options::no_pattern);
        return e;
    }

    void give(int i, const ex& value) {
        at_[m_.q[i]] = value;
        at_[m_.qdot[i]] = value.diff(m_.t);
        at_[m_.qddot[i]] = value.diff(m_.t, 2);
    }

    const Mechanism& m_;
    const Equations& e_;
    GiNaC::exmap inputs_, at_;
};

/// An equation into which the motion has been put.
struct Put {
    ex left;
    std::vector<std::string> names;  ///< of the equations from which it comes
    std::set<std::size_t> spoken;    ///< the claims of whose names they speak
};

/// Eliminates multipliers that no claim gives: where one equation determines such a multiplier, the others must
/// hold with it.
void eliminate_open_multipliers(std::vector<Put>& rows, const Motion& motion) {
    for (;;) {
        auto pivot = rows.end();
        GiNaC::symbol open;
        ex size;
        for (auto row = rows.begin(); row != rows.end(); ++row) {
            if (!motion.missing(row->left).empty()) continue;
            for (const GiNaC::symbol& multiplier : motion.open_multipliers(row->left)) {
                const ex slope = row->left.diff(multiplier);
                const bool is_better = pivot == rows.end() || slope.nops() < size.nops();
                if (!is_better || zero_test(slope, motion.mechanism()).verdict != Verdict::refuted) continue;
                pivot = row;
                open = multiplier;
                size = slope;
            }
        }
        if (pivot == rows.end()) return;
        const Put used = *pivot;
        rows.erase(pivot);
        const ex value = open - used.left / size;
        for (Put& row : rows) {
            if (!row.left.has(open)) continue;
            row.left = (row.left.subs(open == value, GiNaC::subs_options::no_pattern) * size).expand();
            for (const std::string& name : used.names)
                if (std::find(row.names.begin(), row.names.end(), name) == row.names.end())
                    row.names.push_back(name);
            row.spoken.insert(used.spoken.begin(), used.spoken.end());
        }
    }
}

/// The claims give each coordinate and multiplier once.
void check_motion(const Scene& scene, Claims& read, const std::vector<std::size_t>& which,
                  std::vector<CheckedClaim>& claims) {
    const Motion motion(scene, read, which);
    std::vector<std::vector<CheckedClaim>> tests(which.size());
    std::vector<Put> rows;
    const std::vector<ex> all = motion.rows();
    const auto tell = [&](const std::set<std::size_t>& spoken, const std::string& reason) {
        for (const std::size_t i : spoken) {
            tests[i].push_back({});
            claims[which[i]].reason = reason;
        }
    };
    for (std::size_t r = 0; r < all.size(); ++r) {
        const bool is_readable = motion.is_readable(all[r]);
        std::set<std::size_t> spoken;
        for (std::size_t i = 0; i < which.size(); ++i)
            if (!is_readable || motion.speaks_of(all[r], scene.claims[which[i]].equation.lhs.tree->text))
                spoken.insert(i);
        if (!is_readable)
            tell(spoken, say("{} is too long to put a motion into", motion.name_of(r)));
        else
            rows.push_back({motion.along(all[r]), {motion.name_of(r)}, std::move(spoken)});
    }
    eliminate_open_multipliers(rows, motion);
    for (const Put& row : rows) {
        if (row.spoken.empty()) continue;
        std::string name = row.names[0];
        for (std::size_t k = 1; k < row.names.size(); ++k) name = say("{} and {}", name, row.names[k]);
        if (const auto missing = motion.missing(row.left); !missing.empty()) {
            tell(row.spoken, say("{} holds {} too, of which no claim at \"solution\" gives the value", name,
                                 fmt::join(missing, ", ")));
            continue;
        }
        if (!motion.open_multipliers(row.left).empty()) {
            tell(row.spoken, say("it could not be decided whether {} gives a multiplier", name));
            continue;
        }
        const CheckedClaim test = zero_test(row.left, motion.mechanism());
        for (const std::size_t i : row.spoken) {
            tests[i].push_back(test);
            if (test.verdict == Verdict::refuted && claims[which[i]].reason.empty())
                claims[which[i]].reason = say("put into {}, it leaves what does not vanish", name);
        }
    }
    for (std::size_t i = 0; i < which.size(); ++i) {
        CheckedClaim& claim = claims[which[i]];
        const std::string reason = claim.reason;
        if (tests[i].empty()) {
            claim.reason = say("no equation of motion and no constraint holds this coordinate or multiplier");
            continue;
        }
        claim = all_of(tests[i]);
        if (!reason.empty()) claim.reason = reason;
    }
}

/// All choices of one claim for each name.
std::vector<std::vector<std::size_t>> choices(const Scene& scene, const std::vector<std::size_t>& which) {
    std::map<std::string, std::vector<std::size_t>> of_name;
    for (const std::size_t k : which) of_name[scene.claims[k].equation.lhs.tree->text].push_back(k);
    std::vector<std::vector<std::size_t>> result{{}};
    for (const auto& [name, claims] : of_name) {
        std::vector<std::vector<std::size_t>> longer;
        for (const std::vector<std::size_t>& before : result)
            for (const std::size_t k : claims) {
                longer.push_back(before);
                longer.back().push_back(k);
            }
        result = std::move(longer);
        if (result.size() > most_choices) return {};
    }
    for (std::vector<std::size_t>& one : result) std::sort(one.begin(), one.end());
    return result;
}

int strength(Verdict verdict) {
    return verdict == Verdict::proved ? 2 : verdict == Verdict::refuted ? 0 : 1;
}

/// `which`: the positions of the claims at "solution", which together describe one motion; each has the name of a
/// coordinate or a multiplier on its left side.
std::vector<CheckedClaim> check_solutions(const Scene& scene, Claims& read,
                                          const std::vector<std::size_t>& which) {
    std::vector<CheckedClaim> claims(scene.claims.size());
    const std::vector<std::vector<std::size_t>> all = choices(scene, which);
    for (const std::size_t k : which)
        if (all.empty())
            claims[k] =
                undecided(say("coordinates have so many values at \"solution\" that their combinations are more "
                              "than {}",
                              most_choices));
    std::set<std::size_t> judged;
    for (const std::vector<std::size_t>& choice : all) {
        std::vector<CheckedClaim> found(claims.size());
        check_motion(scene, read, choice, found);
        // A claim is right if it is part of a motion, whatever stands beside it.
        for (const std::size_t k : choice)
            if (judged.insert(k).second || strength(found[k].verdict) > strength(claims[k].verdict))
                claims[k] = std::move(found[k]);
    }
    return claims;
}

}  // namespace

std::optional<CheckedClaim> along_a_solution(Question& q) {
    if (q.now.at != Claim::At::solution) return std::nullopt;
    std::vector<CheckedClaim>& all = q.together.solutions;
    if (all.empty()) all = check_solutions(q.now.scene, q.now.claims, q.together.claims);
    return all[q.claim];
}

}  // namespace alembert
