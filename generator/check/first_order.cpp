// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "base/language/say.hpp"
#include "check/in_print.hpp"
#include "check/near_point.hpp"
#include "check/quantities.hpp"
#include "check/total_derivative.hpp"
#include "check/ways.hpp"
#include "check/zero.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int most_coordinates = 6, most_unknowns = 9;  // with the multipliers

std::vector<std::pair<std::string, ex>> values_near(const Claim& claim, Claims& read) {
    std::vector<std::pair<std::string, ex>> result;
    for (const auto& [name, value] : claim.near) result.emplace_back(name.text, read.read(value));
    return result;
}

class FirstOrder {
public:
    FirstOrder(const Claim& claim, Claims& read, NearPoint::Inputs inputs)
        : m_(read.mechanism()),
          e_(read.equations()),
          near_(m_, e_, values_near(claim, read), inputs),
          residual_(near_.read(m_.z->expand(read.read(claim).residual))),
          spoken_(letters_in(claim, read)) {}

    CheckedClaim settle() {
        const int size = m_.size() + static_cast<int>(e_.A.size());
        if (!m_.redundant.empty() || !m_.unilateral.empty() || m_.size() > most_coordinates ||
            size > most_unknowns)
            return undecided(
                say("claims to first order are decided for scenes of at most {} coordinates, and {} with the "
                    "multipliers, without contacts and without constraints that follow from others",
                    most_coordinates, most_unknowns));
        if (const std::string obstacle = near_.obstacle(); !obstacle.empty()) return undecided(obstacle);
        if (spoken_.constant || spoken_.derivative || spoken_.kinetic) return settle_energy();
        std::vector<CheckedClaim> tests{zero_test(near_.at(residual_), m_)};
        const bool fails_there = tests[0].verdict == Verdict::refuted;
        const auto slopes = eliminated();
        if (!slopes) return undecided(say("the equations do not determine the accelerations there"));
        for (const ex& slope : *slopes) tests.push_back(zero_test(slope, m_));
        CheckedClaim result = all_of(tests);
        if (result.verdict != Verdict::refuted) return result;
        if (fails_there)
            result.reason = say("it does not even hold at the point itself");
        else
            result.difference = written(*slopes);
        result.nearest = nearest();
        return result;
    }

private:
    using Small = NearPoint::Small;

    /// Energies are held to second order, because the linear equations follow from their quadratic parts.
    CheckedClaim settle_energy() {
        if (!e_.A.empty())
            return undecided(say("energies near a state are decided where the coordinates are independent"));
        const ex constant = near_.at(residual_);
        ex quadratic = 0;
        std::vector<CheckedClaim> tests;
        for (const Small& a : near_.small()) {
            const ex slope = residual_.diff(a.variable);
            tests.push_back(zero_test(near_.at(slope), m_));
            quadratic += near_.at(slope) * deviation(a);
            for (const Small& b : near_.small()) {
                const ex second = near_.at(slope.diff(b.variable));
                tests.push_back(zero_test(second, m_));
                quadratic += second * deviation(a) * deviation(b) / 2;
            }
        }
        const CheckedClaim own = zero_test(constant, m_);
        if (spoken_.kinetic) tests.push_back(own);
        CheckedClaim result = all_of(tests);
        if (result.verdict == Verdict::proved && own.verdict != Verdict::proved)
            result.up_to = UpTo{.kind = UpTo::Kind::constant};
        if (result.verdict == Verdict::refuted && spoken_.derivative && is_void(quadratic)) {
            result = proved(0);
            result.normal_form = true;
            result.up_to = UpTo{.kind = UpTo::Kind::derivative};
        }
        if (result.verdict == Verdict::refuted) result.difference = in_print(constant + quadratic);
        if (result.up_to)
            result.reason =
                result.up_to->kind == UpTo::Kind::constant
                    ? say("right to second order and up to a constant")
                    : say("right to second order and up to a time derivative, which changes no equation "
                          "of motion");
        return result;
    }

    /// Whether this part of a Lagrangian changes no equation of motion.
    bool is_void(const ex& part) const {
        for (const ex& equation : euler_operator(m_.z->name(part), m_))
            if (!is_zero(m_.z->expand(equation), m_)) return false;
        return true;
    }

    /// What remains of the claim's derivatives with respect to each small quantity when the accelerations and
    /// multipliers, and what the constraints determine, are eliminated. Nothing if the equations leave
    /// accelerations or multipliers open.
    std::optional<std::vector<ex>> eliminated() {
        reduced_.clear();
        for (const auto* list : {&near_.rows(), &near_.bound()})
            for (const ex& row : *list) reduced_.push_back(near_.slopes_of(row));
        const std::size_t unknowns = m_.qddot.size() + e_.lambda.size();
        const auto pivots = near_.reduce(reduced_, unknowns + near_.small().size());
        if (!pivots || pivots->size() < unknowns || (*pivots)[unknowns - 1] != unknowns - 1) return std::nullopt;
        std::vector<ex> claim = near_.slopes_of(residual_);
        for (std::size_t r = 0; r < pivots->size(); ++r) {
            const ex factor = claim[(*pivots)[r]];
            if (factor.is_zero()) continue;
            for (std::size_t k = 0; k < claim.size(); ++k)
                claim[k] = (claim[k] - factor * reduced_[r][k]).normal();
        }
        return std::vector<ex>(claim.begin() + static_cast<std::ptrdiff_t>(unknowns), claim.end());
    }

    ex deviation(const Small& small) const { return small.variable - small.value; }

    std::string in_print(const ex& e) const { return alembert::in_print(e, m_); }

    std::string written(const std::vector<ex>& slopes) const {
        ex sum = 0;
        for (std::size_t v = 0; v < slopes.size(); ++v) sum += slopes[v] * deviation(near_.small()[v]);
        return in_print(sum);
    }

    /// The linear equation of the first coordinate whose acceleration the claim contains, multiplied so that its
    /// scale is that of the claim.
    std::string nearest() const {
        for (int i = 0; i < m_.size(); ++i) {
            const ex own = near_.at(residual_.diff(m_.qddot[i]));
            if (own.is_zero()) continue;
            ex scale = own, sum = 0;
            if (e_.A.empty()) {
                scale = (own / near_.at(near_.rows()[i].diff(m_.qddot[i]))).normal();
                for (const GiNaC::symbol& acceleration : m_.qddot)
                    sum += near_.at(near_.rows()[i].diff(acceleration)) * acceleration;
                for (const Small& small : near_.small())
                    sum += near_.at(near_.rows()[i].diff(small.variable)) * deviation(small);
            } else {
                const std::vector<ex>& row = reduced_[static_cast<std::size_t>(i)];
                sum = m_.qddot[i];
                for (std::size_t v = 0; v < near_.small().size(); ++v)
                    sum += row[m_.qddot.size() + e_.lambda.size() + v] * deviation(near_.small()[v]);
            }
            const auto f = fourier((scale * sum).expand(), *m_.symbols);
            if (!f) return "";
            const ReadableEquation row = readable_equation(*f, Fourier());
            return text(row.lhs) + " = " + text(row.rhs);
        }
        return "";
    }

    const Mechanism& m_;
    const Equations& e_;
    NearPoint near_;
    const ex residual_;
    const SpokenLetters spoken_;
    std::vector<std::vector<ex>> reduced_;  ///< the linear equations of all of them, solved
};

/// Inputs that change with time.
std::vector<std::string> moving_inputs(const Mechanism& m) {
    std::vector<std::string> names;
    for (const Mechanism::Input& input : m.inputs)
        if (m.z->depends(input.value, {m.t})) names.push_back(input.derivative[0].get_name());
    return names;
}

}  // namespace

std::optional<CheckedClaim> to_first_order(Question& q) {
    if (q.now.at != Claim::At::near) return std::nullopt;
    Claims& read = q.now.claims;
    const Claim& claim = q.now.scene.claims[q.claim];
    CheckedClaim result = FirstOrder(claim, read, NearPoint::Inputs::small).settle();
    const std::vector<std::string> inputs = moving_inputs(q.now.m);
    if (inputs.empty()) return result;
    // Whatever the inputs are: cos(w*t)*theta, a support that shakes, is small then, and so is theta.
    CheckedClaim in_time = FirstOrder(claim, read, NearPoint::Inputs::in_time).settle();
    const bool writes_time = q.now.m.z->depends(read.read(claim).residual, {q.now.m.t});
    if (in_time.verdict == Verdict::proved || (in_time.verdict == Verdict::refuted && writes_time)) return in_time;
    if (result.verdict == Verdict::proved)
        result.assumed.push_back(
            {Assumption::Kind::small, say("{} is small, as the deviations are", fmt::join(inputs, ", ")), false});
    return result;
}

}  // namespace alembert
