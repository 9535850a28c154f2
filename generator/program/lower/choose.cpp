// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/choose.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "algebra/notation/readable.hpp"
#include "algebra/symbolic/distance.hpp"
#include "base/language/say.hpp"
#include "model/formalism/joint_tree.hpp"
#include "program/constants.hpp"
#include "program/flatten.hpp"
#include "program/share.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

// The most joints; for more, lowering the matrix costs more than it can gain.
constexpr std::size_t most_composite = 20;
// The factor by which another form must be faster than the textbook form.
constexpr double readability = 1.1;
// The least part of a form's time that remains after rewriting; measured over all scenes: 0.89.
constexpr double least_after = 0.85;
constexpr std::size_t many_joints = 6;  // with more joints, turning axes never win if there are parallel ones
constexpr double largest_tree = 50000;  // the most nodes; for more, expanding costs more than it can gain

std::optional<ex> form_in(ReadableWriter& write, const ex& e, const Mechanism& m, std::size_t budget = 400) {
    if (m.z->tree_size(e) > largest_tree) return std::nullopt;
    const std::optional<Fourier> normal = fourier(m.z->expand(e), *m.symbols, budget);
    if (!normal) return std::nullopt;
    return expression(write(*normal));
}

/// Writes all of `values` in readable form, or none of them.
bool make_readable(std::vector<ex*> values, const Mechanism& m, ReadableWriter& write) {
    for (ex* value : values) {
        const std::optional<ex> readable = form_in(write, *value, m);
        if (!readable) return false;
        *value = *readable;
    }
    return true;
}

/// The bodies, springs and loads that depend on coordinate i or its rate.
std::vector<std::string> sources_of_row(const Mechanism& m, int i) {
    std::vector<std::string> labels;
    const auto add = [&](const Origin& origin, const ex& value) {
        if (m.z->depends(value, {m.q[i], m.qdot[i]})) labels.push_back(label(origin));
    };
    for (const auto* parts : {&m.kinetic, &m.potential})
        for (const Part& part : *parts) add(part.origin, part.value);
    if (m.given_lagrangian) labels.push_back(label({Origin::Kind::given_lagrangian}));
    for (const Load& load : m.loads)
        for (const Load::Pair& pair : load.pairs) add(load.origin, pair.velocity);
    return labels;
}

/// Whether distances from places given in numbers would be multiplied out.
bool loses_digits(const Mechanism& m, const Equations& e) {
    const auto holds = [&](const ex& value) { return holds_distance_from_number(value, *m.z); };
    for (int i = 0; i < e.size(); ++i) {
        if (holds(e.forcing(i))) return true;
        for (int j = 0; j <= i; ++j)
            if (holds(e.M(i, j))) return true;
    }
    return std::any_of(e.gamma.begin(), e.gamma.end(), holds) || std::any_of(e.h.begin(), e.h.end(), holds) ||
           std::any_of(e.A.begin(), e.A.end(),
                       [&](const auto& row) { return std::any_of(row.begin(), row.end(), holds); });
}

std::optional<Equations> textbook_equations(const Mechanism& m, Equations equations, ReadableWriter& write) {
    double size = 0;
    for (int i = 0; i < equations.size(); ++i) {
        for (int j = 0; j <= i; ++j) size += m.z->tree_size(equations.M(i, j));
        size += m.z->tree_size(equations.forcing(i));
    }
    if (size > largest_tree || loses_digits(m, equations)) return std::nullopt;
    for (int i = 0; i < equations.size(); ++i) {
        for (int j = 0; j <= i; ++j) {
            if (!make_readable({&equations.M(i, j)}, m, write)) return std::nullopt;
            equations.M(j, i) = equations.M(i, j);
        }
        // One sum, so that terms of different parts cancel.
        equations.own[i] = equations.forcing(i);
        equations.applied[i] = equations.dissipative[i] = 0;
        if (!make_readable({&equations.own[i]}, m, write)) return std::nullopt;
        equations.row_sources.push_back(equations.speeds_are_rates() ? sources_of_row(m, i)
                                                                     : m.z->source_labels());
    }
    for (ex& rate : equations.h)
        if (!make_readable({&rate}, m, write)) return std::nullopt;
    for (std::size_t k = 0; k < equations.A.size(); ++k) {
        for (ex& entry : equations.A[k])
            if (!make_readable({&entry}, m, write)) return std::nullopt;
        if (!make_readable({&equations.gamma[k]}, m, write)) return std::nullopt;
    }
    equations.formalism += std::string(", ") + to_say("textbook form");
    return equations;
}

/// Is there a power of a sum in `e` or in what its intermediate symbols stand for?
bool has_power_of_sum(const ex& e, const Intermediates& z) {
    if (GiNaC::is_a<GiNaC::symbol>(e)) {
        const Intermediates::Entry* entry = z.find(GiNaC::ex_to<GiNaC::symbol>(e));
        return entry != nullptr && has_power_of_sum(entry->definition, z);
    }
    if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::posint)) {
        const ex& base = e.op(0);
        const Intermediates::Entry* entry =
            GiNaC::is_a<GiNaC::symbol>(base) ? z.find(GiNaC::ex_to<GiNaC::symbol>(base)) : nullptr;
        if (GiNaC::is_a<GiNaC::add>(entry != nullptr ? entry->definition : base)) return true;
    }
    return std::any_of(e.begin(), e.end(), [&](const ex& part) { return has_power_of_sum(part, z); });
}

/// The parts of V that are not multiplied out: squares of small differences. ½ k (|r| − l)² as the sum of ½ k r²,
/// −k l |r| and ½ k l² would lose as many digits as a stiff spring is shorter in its extension than in its length.
/// Nothing if an extension is too long to be written.
std::optional<ex> potential_of_differences(const Mechanism& m) {
    ex result = 0;
    for (const Part& part : m.potential) {
        if (part.origin.kind == Origin::Kind::given_potential && has_power_of_sum(part.value, *m.z))
            result += part.value;
        if (part.origin.kind != Origin::Kind::spring) continue;
        const auto spring = std::find_if(m.springs.begin(), m.springs.end(), [&](const SpringElement& s) {
            return s.origin.index == part.origin.index;
        });
        if (spring == m.springs.end() || !spring->extension) continue;
        const std::optional<ex> d = readable_form(*spring->extension, m);
        if (!d) return std::nullopt;
        if (GiNaC::is_a<GiNaC::add>(*d)) result += spring->stiffness / 2 * pow(*d, 2);
    }
    return result;
}

Energy readable_energy(const Mechanism& m, const Energy& energy, ReadableWriter& write) {
    Energy result = energy;
    const bool same = !m.given_lagrangian && is_identically_zero(energy.energy - energy.jacobi, m);
    const std::optional<ex> kept = potential_of_differences(m);
    if (!kept) return energy;
    result.potential -= *kept;
    result.jacobi -= *kept;
    if (!make_readable({&result.kinetic, &result.potential, &result.jacobi, &result.power}, m, write))
        return energy;
    result.potential += *kept;
    result.jacobi += *kept;
    if (!m.given_lagrangian) result.energy = result.kinetic + result.potential;
    if (same) result.jacobi = result.energy;
    if (m.given_lagrangian) result.energy = result.jacobi;
    return result;
}

}  // namespace

std::optional<ex> readable_form(const ex& e, const Mechanism& m, std::size_t budget) {
    ReadableWriter write;
    return form_in(write, e, m, budget);
}

namespace {

/// A form after lowering.
struct Candidate {
    Program program;
    std::shared_ptr<const JointTree> tree = {};  ///< of a recursion
};

/// Lowers each form that these equations can take.
void add_forms(std::vector<Candidate>& programs, const Mechanism& mechanism, const Equations& equations,
               const Energy& energy, const LowerOptions& options, ReadableWriter& write) {
    const Mechanism m = in_terms_of(equations, mechanism);
    const std::size_t before = programs.size();
    const bool is_free = equations.tree && norms_alone(*equations.tree, m);
    if (!is_free) {
        Equations intermediate = equations;
        intermediate.formalism += std::string(", ") + to_say("intermediate symbols");
        programs.push_back({lower(m, intermediate, energy, options)});
    }
    const bool has_matrix = equations.M.rows() > 0;
    // The directions of friction in planes are long when expanded.
    const bool is_readable =
        has_matrix && std::none_of(m.frictions.begin(), m.frictions.end(),
                                   [](const Mechanism::Friction& f) { return f.across.has_value(); });
    if (const std::optional<Equations> textbook =
            is_readable ? textbook_equations(m, equations, write) : std::nullopt) {
        LowerOptions as_in_book = options;
        as_in_book.is_textbook = true;
        programs.push_back({lower(m, *textbook, readable_energy(m, energy, write), as_in_book)});
    }
    if (!equations.tree) return;
    const bool parallel = has_parallel_axes(*equations.tree);
    using Solve = RecursionForm::Solve;
    for (const Solve solve : {Solve::matrix, Solve::articulated, Solve::both_ends})
        for (const LinkAxes axes : {LinkAxes::own, LinkAxes::still}) {
            const RecursionForm form{axes, solve};
            if (axes == LinkAxes::still && !parallel) continue;
            if (axes == LinkAxes::own && parallel && equations.tree->joints.size() > many_joints) continue;
            if (solve == Solve::matrix && !has_matrix) continue;
            if (solve == Solve::both_ends && (axes == LinkAxes::own || !is_planar_chain(*equations.tree)))
                continue;
            // The cost of LDLᵀ grows with the cube of the size; recursions without a matrix give no multipliers.
            if (solve != Solve::matrix ? !is_free : equations.tree->joints.size() > most_composite && is_free)
                continue;
            Equations recursive = equations;
            recursive.formalism += ", " + form.text();
            LowerOptions by = options;
            by.recursion = form;
            try {
                programs.push_back({lower(m, recursive, energy, by), equations.tree});
            } catch (const std::domain_error&) {
                // If a joint has no inertia, a recursion divides by zero. The forms with a matrix report which
                // rates these are.
            }
        }
    if (programs.size() == before && !has_matrix && equations.size() > 0)
        throw ModelError(
            say("no inertia resists some motion of the joints; give every body a mass and moments of inertia"));
    if (programs.size() == before) programs.push_back({lower(m, equations, energy, options)});
}

/// Rewrites the programs that may still win, and the second best, which is reported.
std::vector<Candidate> contenders(std::vector<Candidate> candidates) {
    std::vector<double> times;
    double best = std::numeric_limits<double>::infinity();
    for (const Candidate& c : candidates) {
        times.push_back(cost_of(c.program).time());
        if (!c.program.singular) best = std::min(best, times.back());
    }
    std::vector<double> sorted = times;
    std::sort(sorted.begin(), sorted.end());
    const double second = sorted[std::min<std::size_t>(1, sorted.size() - 1)];
    std::vector<Candidate> programs;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        Candidate& c = candidates[k];
        const double least = times[k] * least_after / (c.program.is_textbook ? readability : 1);
        if (c.program.singular || least <= best || times[k] <= second)
            programs.push_back(
                {with_simple_constants(shared(c.tree ? flattened(c.program) : std::move(c.program))), c.tree});
    }
    return programs;
}

}  // namespace

Choice choose(const Mechanism& mechanism, const std::vector<Equations>& equations, const LowerOptions& options) {
    const Energy energy = energy_of(in_terms_of(equations.at(0), mechanism));  // in the names that they have
    const Mechanism m = in_terms_of(energy, mechanism);
    std::vector<Candidate> candidates;
    ReadableWriter write;
    for (const Equations& e : equations) add_forms(candidates, m, e, energy, options, write);
    std::vector<Candidate> programs = contenders(std::move(candidates));
    std::vector<Cost> costs;
    for (const Candidate& candidate : programs) costs.push_back(cost_of(candidate.program));
    std::vector<std::size_t> order(programs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto rank = [&](std::size_t k) {
        const bool readable = programs[k].program.is_textbook;  // equally good, and easier to read
        return std::make_pair(programs[k].program.singular && !readable,
                              costs[k].time() * (readable ? 1 : readability));
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    Choice choice{.program = without_swallowed_constants(programs[order[0]].program),
                  .cost = costs[order[0]],
                  .runner_up = {},
                  .tree = programs[order[0]].tree};
    if (order.size() > 1) choice.runner_up = RunnerUp{programs[order[1]].program.formulation, costs[order[1]]};
    return choice;
}

Choice choose(const Mechanism& m, const Equations& equations, const LowerOptions& options) {
    return choose(m, std::vector<Equations>{equations}, options);
}

}  // namespace alembert
