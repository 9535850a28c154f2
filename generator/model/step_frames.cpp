// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/step_frames.hpp"

#include <algorithm>
#include <set>

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double longest_step = 20000;  // nodes; longer ones are not taken apart

/// The operands of a sum, or of a product; or the expression alone.
template <typename Operation>
std::vector<ex> parts_of(const ex& e) {
    if (GiNaC::is_a<Operation>(e)) return {e.begin(), e.end()};
    return {e};
}

bool is_function(const ex& e, const char* name) {
    return GiNaC::is_a<GiNaC::function>(e) && GiNaC::ex_to<GiNaC::function>(e).get_name() == name;
}

}  // namespace

StepFrames::StepFrames(const Mechanism& m, TurningFrames turns)
    : m_(m), frames_found_(turns), frames_(m.skeleton.frames) {
    for (const GiNaC::symbol& s : m.moving()) moving_.insert(s.gethash());
    for (int i = 0; i < m.size(); ++i) place_of_[m.q[i].gethash()] = i;
}

bool StepFrames::moves(const ex& e) const {
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
        if (GiNaC::is_a<GiNaC::symbol>(*part) && moving_.count(part->gethash()) > 0) return true;
    return false;
}

auto StepFrames::taken_apart(const Skeleton::Step& step) -> std::optional<std::vector<Piece>> {
    Terms terms;
    for (int k = 0; k < 3; ++k) {
        if (m_.z->tree_size(step.offset[k]) > longest_step) return std::nullopt;
        for (const ex& product : parts_of<GiNaC::add>(m_.z->expand(step.offset[k]).expand())) {
            if (product.is_zero()) continue;
            const Terms found = terms_of(k, product);
            terms.insert(terms.end(), found.begin(), found.end());
        }
    }
    std::vector<Piece> pieces;
    take_apart(step.frame, std::move(terms), pieces);
    return pieces;
}

/// More than one term where an angle has a constant part: cos(θ + α) = cos α cos θ − sin α sin θ.
auto StepFrames::terms_of(int component, const ex& product) -> Terms {
    Terms terms{{component, 1, {}}};
    for (const ex& factor : parts_of<GiNaC::mul>(product)) {
        if (auto multiplied = times_function(terms, factor))
            terms = *std::move(multiplied);
        else
            for (Term& term : terms) term.factor *= factor;
    }
    return terms;
}

/// Nothing if it is no sine or cosine of a sum of coordinates.
auto StepFrames::times_function(const Terms& terms, const ex& function) -> std::optional<Terms> {
    const bool is_cosine = is_function(function, "cos");
    if (!is_cosine && !is_function(function, "sin")) return std::nullopt;
    const std::vector<int> coordinates = coordinates_in(function);
    if (coordinates.empty()) return std::nullopt;
    ex rest = function.op(0).expand();
    Angle angle{.slopes = {}, .value = 0};
    int sign = 0;
    for (const int i : coordinates) {
        const ex slope = rest.diff(m_.q[i]);
        if (!slope.info(GiNaC::info_flags::rational) || slope.is_zero()) return std::nullopt;
        if (sign == 0) sign = slope.info(GiNaC::info_flags::positive) ? 1 : -1;
        angle.slopes.emplace_back(i, GiNaC::ex_to<GiNaC::numeric>(sign * slope));
        angle.value += sign * slope * m_.q[i];
        rest = (rest - slope * m_.q[i]).expand();
    }
    ex constant = 0;
    for (const ex& part : parts_of<GiNaC::add>(rest)) (moves(part) ? angle.value : constant) += sign * part;
    const int number = number_of(angle);
    const ex c = cos(constant), s = sin(constant);
    Terms result;
    const auto add = [&](const Term& term, const ex& by, bool cosine) {
        if (by.is_zero()) return;
        result.push_back({term.component, term.factor * by, term.functions});
        result.back().functions.emplace_back(number, cosine);
    };
    for (const Term& term : terms) {
        add(term, is_cosine ? c : sign * s, true);
        add(term, is_cosine ? -s : sign * c, false);
    }
    return result;
}

int StepFrames::number_of(const Angle& angle) {
    std::vector<int> coordinates;
    for (const auto& [i, slope] : angle.slopes) coordinates.push_back(i);
    std::vector<int>& known = angles_of_[coordinates];
    for (const int a : known)
        if ((angles_[a].value - angle.value).expand().is_zero()) return a;
    angles_.push_back(angle);
    known.push_back(static_cast<int>(angles_.size()) - 1);
    return known.back();
}

/// Those that stand in the terms: the first coordinates first, which is the same order in every run.
std::vector<int> StepFrames::angles_in(const Terms& terms) const {
    std::vector<int> result;
    for (const Term& term : terms)
        for (const auto& [angle, is_cosine] : term.functions) result.push_back(angle);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    std::sort(result.begin(), result.end(), [&](int a, int b) {
        const auto &x = angles_[a].slopes, &y = angles_[b].slopes;
        return std::lexicographical_compare(
            x.begin(), x.end(), y.begin(), y.end(), [](const auto& s, const auto& t) {
                return s.first != t.first ? s.first < t.first : s.second.compare(t.second) > 0;
            });
    });
    return result;
}

void StepFrames::take_apart(int frame, Terms terms, std::vector<Piece>& pieces) {
    for (bool any = frames_found_ == TurningFrames::found; any;) {
        any = false;
        for (const int angle : angles_in(terms)) any = take_turn(frame, angle, terms, pieces) || any;
    }
    add_plain(frame, terms, pieces);
}

/// Takes the terms in an angle, R_n(φ) c, out of `terms`, and out of those along n the ones that c moves with.
bool StepFrames::take_turn(int frame, int angle, Terms& terms, std::vector<Piece>& pieces) {
    Vector3 c{0, 0, 0}, s{0, 0, 0};
    Terms inner, others;
    bool any = false;
    for (const Term& term : terms) {
        const auto function = std::find_if(term.functions.begin(), term.functions.end(),
                                           [&](const auto& f) { return f.first == angle; });
        if (function == term.functions.end()) {
            others.push_back(term);
            continue;
        }
        any = true;
        Term factor = term;
        factor.functions.erase(factor.functions.begin() + (function - term.functions.begin()));
        if (std::any_of(factor.functions.begin(), factor.functions.end(),
                        [&](const auto& f) { return f.first == angle; }))
            return false;
        (function->second ? c : s)[term.component] += whole(factor);
        if (function->second) inner.push_back(std::move(factor));
    }
    if (!any) return false;
    const auto is_zero = [](const ex& e) { return e.expand().is_zero(); };
    for (const int axis : {2, 1, 0})
        for (const int sign : {1, -1}) {
            const int a = (axis + 1) % 3, b = (axis + 2) % 3;
            if (!is_zero(c[axis]) || !is_zero(s[axis]) || !is_zero(s[a] + sign * c[b]) ||
                !is_zero(s[b] - sign * c[a]))
                continue;
            const auto [turning, before] = turned(frame, axis, sign, angle);
            if (!before.is_zero()) {  // R_n(−before)
                Terms back;
                for (const Term& term : inner) {
                    const bool first = term.component == a;
                    const ex cosine = cos(before), sine = sin(before);
                    back.push_back(term);
                    back.back().factor *= cosine;
                    back.push_back({first ? b : a, (first ? -sine : sine) * term.factor, term.functions});
                }
                inner = std::move(back);
            }
            const std::vector<int> with = moved_by(inner);
            Terms left;
            for (const Term& term : others) {
                const std::vector<int> by = term.component == axis ? moved_by({term}) : std::vector<int>();
                const bool goes_along =
                    std::find_first_of(by.begin(), by.end(), with.begin(), with.end()) != by.end();
                (goes_along ? inner : left).push_back(term);
            }
            take_apart(turning, std::move(inner), pieces);
            terms = std::move(left);
            return true;
        }
    return false;
}

/// Terms that stay along the axes of the frame, together where the same coordinates move them.
void StepFrames::add_plain(int frame, const Terms& terms, std::vector<Piece>& pieces) const {
    const auto first = static_cast<std::ptrdiff_t>(pieces.size());
    for (const Term& term : terms) {
        Piece piece{frame, moved_by({term}), false, {0, 0, 0}};
        piece.offset[term.component] = whole(term);
        piece.prescribed = piece.by.empty() && moves(piece.offset[term.component]);
        for (auto other = pieces.begin() + first; other != pieces.end();) {
            const bool together = piece.by.empty()
                                      ? other->by.empty() && other->prescribed == piece.prescribed
                                      : std::find_first_of(other->by.begin(), other->by.end(), piece.by.begin(),
                                                           piece.by.end()) != other->by.end();
            if (!together) {
                ++other;
                continue;
            }
            std::vector<int> all;
            std::set_union(other->by.begin(), other->by.end(), piece.by.begin(), piece.by.end(),
                           std::back_inserter(all));
            piece.by = std::move(all);
            for (int k = 0; k < 3; ++k) piece.offset[k] += other->offset[k];
            other = pieces.erase(other);
        }
        pieces.push_back(std::move(piece));
    }
}

std::vector<int> StepFrames::coordinates_in(const ex& e) const {
    std::set<int> result;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
        if (!GiNaC::is_a<GiNaC::symbol>(*part)) continue;
        const auto found = place_of_.find(part->gethash());
        if (found != place_of_.end()) result.insert(found->second);
    }
    return {result.begin(), result.end()};
}

std::vector<int> StepFrames::moved_by(const Terms& terms) const {
    std::set<int> result;
    for (const Term& term : terms) {
        for (const int i : coordinates_in(term.factor)) result.insert(i);
        for (const auto& [angle, is_cosine] : term.functions)
            for (const auto& [i, slope] : angles_[angle].slopes) result.insert(i);
    }
    return {result.begin(), result.end()};
}

ex StepFrames::whole(const Term& term) const {
    ex result = term.factor;
    for (const auto& [angle, is_cosine] : term.functions)
        result *= is_cosine ? cos(angles_[angle].value) : sin(angles_[angle].value);
    return result;
}

/// The angle by which `to` turns against `from` about that axis; nothing if there are turns about others.
std::optional<ex> StepFrames::turn_between(int from, int to, int axis) {
    if (to == from) return ex(0);
    if (to == 0 || frames_[to].by_quaternion) return std::nullopt;
    const auto known = between_.find({from, to, axis});
    if (known != between_.end()) return known->second;
    const Skeleton::Turn turn = frames_[to];
    std::optional<ex> result;
    if (const ex& along = turn.axis[axis]; along.is_equal(1) || along.is_equal(-1))
        if (const auto before = turn_between(from, turn.parent, axis))
            result = (*before + along * m_.z->expand(turn.angle)).expand();
    return between_[{from, to, axis}] = result;
}

std::pair<int, ex> StepFrames::turned(int frame, int axis, int sign, int angle) {
    const auto known = turned_.find({frame, axis, sign, angle});
    if (known != turned_.end()) return known->second;
    std::pair<int, ex>& result = turned_[{frame, axis, sign, angle}];
    const ex by = sign * angles_[angle].value;
    for (int f = 1; f < static_cast<int>(frames_.size()); ++f)
        if (const auto found = turn_between(frame, f, axis); found && f != frame)
            if (const ex before = (*found - by).expand(); !moves(before)) return result = {f, before};
    Skeleton::Turn turn{.parent = frame, .axis = {0, 0, 0}, .angle = by};
    turn.axis[axis] = 1;
    frames_.push_back(std::move(turn));
    return result = {static_cast<int>(frames_.size()) - 1, 0};
}

}  // namespace alembert
