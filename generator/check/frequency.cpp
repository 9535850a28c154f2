// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/frequency.hpp"

#include <algorithm>

#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"
#include "check/in_print.hpp"
#include "check/near_point.hpp"
#include "check/zero.hpp"
#include "model/formalism/routh.hpp"
#include "model/formulas.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t largest_matrix = 8;

/// N(s) at a state of a scene.
class Vibrations {
public:
    explicit Vibrations(const AtPoint& point)
        : m_(with_own_intermediates(point.mechanism)),
          e_(routh(m_)),
          formulas_(point.scene, m_, point.sheets),
          near_((m_.z->adopt(*e_.z), m_), e_, values(point.near)) {
        reason_ =
            m_.redundant.empty() && m_.unilateral.empty()
                ? near_.obstacle()
                : say("vibrations are decided without contacts and without constraints that follow from others");
        if (reason_.empty()) make();
    }

    const Mechanism& mechanism() const { return m_; }
    /// Why there is nothing to decide; empty if there is.
    const std::string& reason() const { return reason_; }
    bool is_no_equilibrium() const { return near_.is_no_equilibrium(); }
    const GiNaC::symbol& s() const { return s_; }
    std::size_t size() const { return matrix_.size(); }
    const std::vector<std::vector<ex>>& matrix() const { return matrix_; }

    ex read(const Expression& e) { return m_.z->expand(formulas_.value(e)); }

    /// det N, by powers of s.
    std::vector<ex> polynomial() const {
        const auto n = static_cast<unsigned>(size());
        GiNaC::matrix N(n, n);
        for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j < n; ++j) N(i, j) = matrix_[i][j];
        const ex det = N.determinant(GiNaC::determinant_algo::laplace).expand().collect(s_);
        std::vector<ex> result;
        for (int k = 0; k <= det.degree(s_); ++k) result.push_back(det.coeff(s_, k));
        return result;
    }

private:
    std::vector<std::pair<std::string, ex>> values(const std::vector<std::pair<std::string, Expression>>& list) {
        std::vector<std::pair<std::string, ex>> result;
        for (const auto& [name, value] : list) result.emplace_back(name, formulas_.value(value));
        return result;
    }

    void make() {
        const std::size_t n = m_.q.size(), all = n + e_.lambda.size();
        if (all > largest_matrix) {
            reason_ = say("vibrations are decided for at most {} coordinates and multipliers", largest_matrix);
            return;
        }
        for (const ex& row : near_.rows()) add(row);
        for (std::size_t k = 0; k < e_.A.size(); ++k) {
            const std::vector<ex>& bound = near_.bound();  // accelerations, rates, position of each constraint
            add(bound[3 * k + (m_.constraints[k].position ? 2 : 1)]);
        }
    }

    /// The row with a e^{st} for q and b e^{st} for λ.
    void add(const ex& row) {
        const std::vector<ex> slopes = near_.slopes_of(row);
        const std::size_t n = m_.q.size(), unknowns = n + e_.lambda.size();
        std::vector<ex> line(unknowns, 0);
        for (std::size_t i = 0; i < n; ++i) line[i] = slopes[i] * s_ * s_;
        for (std::size_t k = n; k < unknowns; ++k) line[k] = slopes[k];
        for (std::size_t v = 0; v < near_.small().size(); ++v)
            for (std::size_t i = 0; i < n; ++i) {
                if (near_.small()[v].variable == m_.q[i]) line[i] += slopes[unknowns + v];
                if (near_.small()[v].variable == m_.qdot[i]) line[i] += slopes[unknowns + v] * s_;
            }
        for (const GiNaC::symbol& q : m_.q)
            if (std::any_of(line.begin(), line.end(), [&](const ex& entry) { return entry.has(q); }))
                reason_ = say("say near which {} it vibrates", q.get_name());
        matrix_.push_back(std::move(line));
    }

    const Mechanism m_;
    const Equations e_;
    Formulas formulas_;
    NearPoint near_;
    GiNaC::symbol s_{"s"};
    std::string reason_;
    std::vector<std::vector<ex>> matrix_;
};

/// Σ cₖ sᵏ at s = iω: its real part, and its imaginary part divided by ω, in ω².
std::pair<ex, ex> at_frequency(const std::vector<ex>& c, const ex& square) {
    ex real = 0, imaginary = 0, power = 1;
    for (std::size_t k = 0; k < c.size(); ++k) {
        (k % 2 == 0 ? real : imaginary) += c[k] * power;
        if (k % 2 == 1) power *= -square;
    }
    return {real.expand(), imaginary.expand()};
}

std::vector<ex> differentiated(const std::vector<ex>& c) {
    std::vector<ex> result;
    for (std::size_t k = 1; k < c.size(); ++k) result.push_back(static_cast<int>(k) * c[k]);
    return result;
}

/// ω² of all frequencies, if det N is of at most second degree in s² and has no odd powers.
std::vector<std::string> squares_of(const std::vector<ex>& c, const Mechanism& m) {
    std::vector<ex> even;
    for (std::size_t k = 0; k < c.size(); ++k) {
        if (k % 2 == 0)
            even.push_back(k % 4 == 0 ? c[k] : -c[k]);
        else if (!is_zero(c[k], m))
            return {};
    }
    while (!even.empty() && is_zero(even.back(), m)) even.pop_back();
    std::vector<std::string> result;
    if (even.size() == 2) result = {in_print((-even[0] / even[1]).normal(), m)};
    if (even.size() == 3) {
        const ex half = (-even[1] / (2 * even[2])).normal(), square = (half * half - even[0] / even[2]).normal();
        for (const int sign : {-1, 1}) result.push_back(in_print(half + sign * sqrt(square), m));
    }
    if (std::any_of(result.begin(), result.end(), [](const std::string& text) { return text.empty(); })) return {};
    return result;
}

}  // namespace

CheckedClaim check_equilibrium(const AtPoint& point) {
    const Vibrations near(point);
    CheckedClaim result;
    if (near.reason().empty()) {
        result.verdict = Verdict::proved;
        result.normal_form = true;
    } else {
        result.verdict = near.is_no_equilibrium() ? Verdict::refuted : Verdict::undecided;
        result.reason = near.reason();
    }
    return result;
}

CheckedFrequency check_frequency(const AtPoint& point, const Expression& square) {
    Vibrations near(point);
    CheckedFrequency result;
    result.reason = near.reason();
    if (!result.reason.empty()) return result;
    const ex claimed = near.read(square);
    std::vector<ex> c = near.polynomial();
    result.squares = squares_of(c, near.mechanism());
    const auto tests = [&] {
        const auto [real, imaginary] = at_frequency(c, claimed);
        return std::vector{zero_test(real, near.mechanism()), zero_test(imaginary, near.mechanism())};
    };
    static_cast<CheckedClaim&>(result) = all_of(tests());
    // s = 0 is counted once for each of ±ω.
    const int halves = is_zero(claimed, near.mechanism()) ? 2 : 1;
    int roots = 0;
    for (; !c.empty() && all_of(tests()).verdict == Verdict::proved; c = differentiated(c)) ++roots;
    result.multiplicity = roots / halves;
    if (result.verdict != Verdict::refuted || result.squares.empty()) return result;
    std::string all;
    for (const std::string& one : result.squares) all += (all.empty() ? "omega^2 = " : ", omega^2 = ") + one;
    result.nearest = all;
    return result;
}

CheckedClaim check_mode(const AtPoint& point, const std::vector<std::pair<std::string, Expression>>& amplitudes,
                        const std::optional<Expression>& square) {
    Vibrations near(point);
    const Mechanism& m = near.mechanism();
    CheckedClaim result;
    result.reason = near.reason();
    if (!result.reason.empty()) return result;
    std::vector<ex> a(m.q.size(), 0);
    for (const auto& [name, value] : amplitudes) a[coordinate_index(name, m)] = near.read(value);
    if (near.size() > m.q.size()) {
        result.reason = say("modes are decided where the coordinates are independent");
        return result;
    }
    std::vector<ex> even, odd;  // of N a, at s² = −ω²
    const GiNaC::symbol w("w");
    for (const std::vector<ex>& row : near.matrix()) {
        ex sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += row[i] * a[i];
        sum = sum.expand();
        even.push_back(sum.coeff(near.s(), 0) - sum.coeff(near.s(), 2) * w);
        odd.push_back(sum.coeff(near.s(), 1));
    }
    ex value = square ? near.read(*square) : ex(0);
    for (std::size_t i = 0; !square && i < even.size(); ++i)
        if (const ex slope = even[i].diff(w); zero_test(slope, m).verdict == Verdict::refuted) {
            value = (-even[i].subs(w == 0) / slope).normal();
            break;
        }
    std::vector<CheckedClaim> tests;
    for (const ex& e : even) tests.push_back(zero_test(e.subs(w == value), m));
    for (const ex& e : odd) tests.push_back(zero_test(e, m));
    result = all_of(tests);
    if (result.verdict == Verdict::proved && !square)
        if (const std::string found = in_print(value, m); !found.empty())
            result.reason = say("a mode with omega^2 = {}", found);
    return result;
}

}  // namespace alembert
