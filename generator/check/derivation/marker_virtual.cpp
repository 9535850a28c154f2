// SPDX-License-Identifier: GPL-2.0-or-later
// Lines with virtual displacements: δx = l cos θ δθ, δW = Σ Q δq, the general equation of dynamics.
#include <algorithm>
#include <set>

#include "base/language/say.hpp"
#include "check/derivation/marker.hpp"
#include "check/written/words.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

using Displacements = std::map<std::string, std::string>;

bool holds_variation(const Math& math) {
    return math.kind == Kind::variation || std::any_of(math.args.begin(), math.args.end(),
                                                       [](const MathPtr& arg) { return holds_variation(*arg); });
}

/// dx and no δx.
bool all_are_differentials(const Math& math) {
    return (math.kind != Kind::variation || math.text == "d") &&
           std::all_of(math.args.begin(), math.args.end(),
                       [](const MathPtr& arg) { return all_are_differentials(*arg); });
}

/// δW, or a sum of them.
bool is_virtual_work(const Math& math) {
    if (math.kind == Kind::call && math.text == "sum" && !math.args.empty()) return is_virtual_work(*math.args[0]);
    return math.kind == Kind::variation && math.args[0]->kind == Kind::letter &&
           (math.args[0]->letter.base == "W" || math.args[0]->letter.base == "A");
}

bool is_zero(const Math& math) {
    return math.kind == Kind::number && math.text == "0";
}

/// δq is 1 for this coordinate, and 0 for all others; −1 for none.
Displacements along(const Mechanism& m, int coordinate) {
    Displacements result;
    for (int j = 0; j < m.size(); ++j) result[m.q[j].get_name()] = j == coordinate ? "1" : "0";
    return result;
}

}  // namespace

/// A line with δ is one claim for each coordinate: that of the terms with its displacement. Returns whether it is
/// such a line.
bool Marker::judge_virtual(MarkedLine& line, const Math& lhs, const Math& rhs) {
    if (!holds_variation(lhs) && !holds_variation(rhs)) return false;
    if (is_zero(rhs) && !holds_rates(lhs)) heard_.assumed_rest = true;  // Σ F δr = 0
    try {
        judge_displacements(line, lhs, rhs);
    } catch (const NoMeaning& reason) {
        if (reason.unknown && bind_to_force(line, lhs, rhs, *reason.unknown)) return true;
        if (!reason.unknown || !find_place(line, lhs, rhs, *reason.unknown)) throw;
    }
    if (line.status == LineStatus::mistake || line.status == LineStatus::follows) take_in_displacement(lhs, rhs);
    return true;
}

/// δW = Q δθ: Q is the generalized force along θ from then on.
bool Marker::bind_to_force(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter) {
    if (!is_virtual_work(lhs) || rhs.kind != Kind::product || rhs.args.size() != 2) return false;
    const Math &force = *rhs.args[0], &displacement = *rhs.args[1];
    const bool is_form = force.kind == Kind::letter && force.letter == letter && force.dots == 0 &&
                         displacement.kind == Kind::variation && displacement.args[0]->kind == Kind::letter;
    const auto name = is_form ? letters_.name_of(displacement.args[0]->letter) : std::nullopt;
    const std::vector<std::string>& all = letters_.coordinates();
    if (!name || std::find(all.begin(), all.end(), *name) == all.end()) return false;
    letters_.bind(letter, "Q_" + *name);
    line.status = LineStatus::definition;
    line.claim = identifier_of(letter) + " = Q_" + *name;
    return true;
}

/// δx_2 of a place that the derivation has not stated: one of the scene's.
bool Marker::find_place(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter) {
    const Letters before = letters_;
    const LineNotes notes = notes_.back();
    std::optional<Binding> named;
    const bool is_number =
        !letter.index.empty() && letter.index.find_first_not_of("0123456789") == std::string::npos;
    const bool may_count_otherwise = is_number && !is_counted(system_.scene());  // y_1 of an end of the rod
    const auto judged_with = [&](const Binding& binding) {
        letters_ = before;
        notes_.back() = notes;
        const std::string name = bind(letter, truth_.value(binding.text));
        MarkedLine other = line;
        try {
            judge_displacements(other, lhs, rhs);
        } catch (const NoMeaning&) {  // another letter is not known either
            known_.erase(name);
            return false;
        }
        if (is_right(other.status) || (named && named->text == binding.text)) {
            line = other;
            return true;
        }
        known_.erase(name);
        return false;
    };
    for (const Binding& binding : bindings(letter)) {
        if (judged_with(binding)) return true;
        if (binding.named && !binding.reversed && !named && !may_count_otherwise) named = binding;
    }
    if (named && judged_with(*named)) return true;
    letters_ = before;
    notes_.back() = notes;
    return false;
}

void Marker::judge_displacements(MarkedLine& line, const Math& lhs, const Math& rhs) {
    if (is_virtual_work(lhs) && is_zero(rhs)) {
        line.status = LineStatus::not_about_scene;
        line.reason = say("a law in general coordinates");
        return;
    }
    if (is_virtual_work(lhs)) {
        judge_work(line, lhs, rhs);
        return;
    }
    if (all_are_differentials(lhs) && all_are_differentials(rhs)) {
        notes_.back().differentials_are_rates = true;
        judge_pair(line, lhs, rhs);
        return;
    }
    if (!system_.equations().A.empty()) return judge_admissible(line, lhs, rhs);
    const Mechanism& m = system_.mechanism();
    std::optional<MarkedLine> told;
    LineNotes notes;
    try {
        for (int i = 0; i < m.size(); ++i) {
            const Displacements displacements = along(m, i);
            displacements_ = &displacements;
            MarkedLine part = line;
            judge_pair(part, lhs, rhs);
            displacements_ = nullptr;
            if (told && !is_worse(part.status, told->status)) continue;
            told = part;
            notes = notes_.back();
        }
    } catch (...) {
        displacements_ = nullptr;
        throw;
    }
    line = *told;
    notes_.back() = std::move(notes);
}

/// δx of a place as the author has it, from a line that is wrong.
void Marker::take_in_displacement(const Math& lhs, const Math& rhs) {
    const bool is_of_place = lhs.kind == Kind::variation && !is_virtual_work(lhs) && !all_are_differentials(lhs);
    if (!is_of_place || !system_.equations().A.empty()) return;
    const Mechanism& m = system_.mechanism();
    MotionRows& rows = system_.rows();
    for (int i = 0; i < m.size(); ++i) {
        const Displacements displacements = along(m, i);
        const ClaimWriting own{.letters = letters_, .steps = &own_.steps(), .displacements = &displacements};
        const ClaimText place = claim_text(lhs, {.letters = letters_, .displacements = &displacements});
        const ex stated = own_.value(claim_text(rhs, own).text);
        if (rows.is_identity(rows.row(stated - truth_.value(place.text))) != true)
            own_.state_step(place.text, stated, lines.size());
    }
}

/// Where constraints bind the displacements, what stands before them may differ by Σ λ ∂f/∂q.
void Marker::judge_admissible(MarkedLine& line, const Math& lhs, const Math& rhs) {
    const Mechanism& m = system_.mechanism();
    std::vector<ex> factors;
    for (int i = -1; i < m.size(); ++i) {
        const Displacements displacements = along(m, i);
        const ClaimWriting writing{.letters = letters_, .displacements = &displacements};
        const ex value = truth_.value(claim_text(lhs, writing).text) - truth_.value(claim_text(rhs, writing).text);
        if (i >= 0)
            factors.push_back(m.z->name(value));
        else if (!m.z->name(value).is_zero())
            throw NoMeaning{.reason = say("each term holds one virtual displacement")};
    }
    const std::optional<bool> holds = system_.rows().is_bound(factors);
    line.status = !holds ? LineStatus::undecided : *holds ? LineStatus::right : LineStatus::mistake;
    line.reason = holds ? say("for displacements that the constraints allow") : say("it could not be evaluated");
}

/// The generalized forces of each load, without those that have a potential in the scene.
std::vector<std::vector<ex>> Marker::forces_of_loads() const {
    std::vector<std::vector<ex>> result;
    for (const Load& load : system_.mechanism().loads) {
        Mechanism alone = system_.mechanism();
        alone.loads = {load};
        const std::vector<ex> of_potential = alone.generalized_forces(false);
        result.push_back(alone.generalized_forces(true));
        for (std::size_t i = 0; i < of_potential.size(); ++i) result.back()[i] += of_potential[i];
    }
    return result;
}

/// Whether the forces are those of some of the parts.
bool Marker::is_sum_of(const std::vector<std::vector<ex>>& parts, const std::vector<ex>& forces) {
    constexpr std::size_t most = 5;
    if (parts.size() > most) return false;
    MotionRows& rows = system_.rows();
    for (unsigned set = 1; set < 1U << parts.size(); ++set) {
        bool is_this = true;
        for (std::size_t i = 0; is_this && i < forces.size(); ++i) {
            ex rest = forces[i];
            for (std::size_t k = 0; k < parts.size(); ++k)
                if ((set >> k & 1U) != 0) rest -= parts[k][i];
            is_this = rows.is_identity(rows.row(system_.mechanism().z->name(rest))) == true;
        }
        if (is_this) return true;
    }
    return false;
}

/// Whether these are the generalized forces of some of the loads: of the weights, of one force.
bool Marker::is_work_of_part(const std::vector<ex>& stated) {
    const Mechanism& m = system_.mechanism();
    std::vector<std::vector<ex>> parts = forces_of_loads();
    for (const Part& part : m.potential) {
        parts.push_back(m.z->pull_back({{part.value, 1}}, m.q));
        for (ex& force : parts.back()) force = -force;
    }
    return is_sum_of(parts, stated);
}

/// δW = Σ Q_q δq: one claim for each coordinate.
void Marker::judge_work(MarkedLine& line, const Math& lhs, const Math& rhs) {
    const Mechanism& m = system_.mechanism();
    std::vector<std::string> texts;
    std::vector<ex> own, truth;
    std::set<std::string> names;
    for (int i = -1; i < m.size(); ++i) {  // −1: without displacements there is no work
        const Displacements displacements = along(m, i);
        const ClaimText text = claim_text(rhs, {.letters = letters_, .displacements = &displacements});
        if (i < 0) {
            if (!truth_.value(text.text).is_zero())
                throw NoMeaning{.reason = say("each term holds one virtual displacement")};
            continue;
        }
        texts.push_back(text.text);
        truth.push_back(truth_.value(text.text));
        const ClaimText derived =
            claim_text(rhs, {.letters = letters_, .steps = &own_.steps(), .displacements = &displacements});
        own.push_back(own_.value(derived.text));
        names.insert(derived.names.begin(), derived.names.end());
    }
    MotionRows& rows = system_.rows();
    const auto wrong_ones = [&](bool all) {
        const std::vector<ex> forces = system_.forces(all);
        std::set<std::size_t> result;
        for (std::size_t i = 0; i < truth.size(); ++i)
            if (rows.is_identity(rows.row(truth[i] - forces[i])) != true) result.insert(i);
        return result;
    };
    std::set<std::size_t> wrong_here = wrong_ones(all_forces_), wrong_otherwise = wrong_ones(!all_forces_);
    if (wrong_otherwise.size() < wrong_here.size()) {
        use_all_forces(!all_forces_);
        std::swap(wrong_here, wrong_otherwise);
    }
    std::optional<std::size_t> wrong;
    for (const std::size_t i : wrong_here)  // rather one that is wrong in both readings
        if (!wrong || (!wrong_otherwise.contains(*wrong) && wrong_otherwise.contains(i))) wrong = i;
    const Math& work = *lhs.args[0];  // δW_g
    const bool is_named = work.kind == Kind::letter && !work.letter.index.empty();
    if (wrong && is_work_of_part(truth)) {
        line.status = LineStatus::undecided;
        line.reason =
            say("it is the virtual work of a part of the forces; whether of that which is meant is not judged");
        return;
    }
    if (wrong && (is_named || names_part_of_forces(heard_.around))) {
        line.status = LineStatus::not_about_scene;
        line.reason = say("the words speak of a part of the forces");
        return;
    }
    const auto is_own = [&](std::size_t i) {
        const std::string force = "Q_" + m.q[static_cast<int>(i)].get_name();
        return own_.wrong_in({force}) && rows.is_identity(rows.row(own[i] - own_.value(force))) == true;
    };
    line.status = wrong ? LineStatus::mistake : LineStatus::right;
    if (wrong && std::all_of(wrong_here.begin(), wrong_here.end(), is_own)) {
        line.status = LineStatus::follows;
        line.follows_from = own_.wrong_in({"Q_" + m.q[static_cast<int>(*wrong)].get_name()});
        line.reason = say("it follows from line {}", lines[*line.follows_from].line);
    }
    const std::string name = "Q_" + m.q[wrong ? static_cast<int>(*wrong) : 0].get_name();
    const std::string& text = texts[wrong.value_or(0)];
    line.claim = name + " = " + text;
    if (!wrong || wrong_otherwise.contains(*wrong)) notes_.back().claim = {.lhs = name, .rhs = text};
    for (std::size_t i = 0; i < own.size(); ++i) {
        const std::string force = "Q_" + m.q[i].get_name();
        const bool same = rows.is_identity(rows.row(own[i] - truth_.value(force))) == true;
        std::optional<std::size_t> from = own_.wrong_in(names);
        if (!from) from = line.follows_from;
        if (!from || line.status == LineStatus::mistake) from = lines.size();
        own_.state(force, own[i], same ? std::nullopt : from);
    }
}

}  // namespace alembert
