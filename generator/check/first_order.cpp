// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/first_order.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "check/zero.hpp"
#include "language/say.hpp"
#include "notation/readable.hpp"
#include "notation/text.hpp"
#include "symbolic/fourier.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int most_coordinates = 4;

class FirstOrder {
public:
    FirstOrder(const Claim& claim, Claims& read)
        : m_(read.mechanism()), e_(read.equations()), residual_(m_.z->expand(read.read(claim).residual)) {
        for (int i = 0; i < m_.size(); ++i) {
            base_[m_.qdot[i]] = 0;
            base_[m_.qddot[i]] = 0;
            small_.push_back({m_.qdot[i], 0});
        }
        for (const Mechanism::Input& input : m_.inputs)
            for (const GiNaC::symbol& derivative : input.derivative) {
                base_[derivative] = 0;
                small_.push_back({derivative, 0});
            }
        for (const auto& [name, value] : claim.near) {
            const ex at = m_.z->expand(read.read(value));
            for (int i = 0; i < m_.size(); ++i) {
                if (name.text == m_.q[i].get_name()) small_.push_back({m_.q[i], at}), base_[m_.q[i]] = at;
                if (name.text != m_.q[i].get_name() + "'") continue;
                base_[m_.qdot[i]] = at;
                for (Small& small : small_)
                    if (small.variable == m_.qdot[i]) small.value = at;
            }
        }
    }

    void settle(CheckedClaim& result) {
        if (!m_.constraints.empty() || !m_.redundant.empty() || !m_.unilateral.empty() ||
            m_.size() > most_coordinates) {
            result.reason =
                say("claims to first order are decided for scenes of at most {} coordinates without constraints",
                    most_coordinates);
            return;
        }
        for (int i = 0; i < m_.size(); ++i) {
            GiNaC::exvector terms{-e_.forcing(i)};
            for (int j = 0; j < m_.size(); ++j) terms.push_back(e_.M(i, j) * m_.qddot[j]);
            const ex row = GiNaC::add(std::move(terms));
            if (m_.z->tree_size(row) > longest_tested) {
                result.reason = say("the equations of motion are too long for a first approximation in symbols");
                return;
            }
            rows_.push_back(m_.z->expand(row));
            if (const ZeroTest here = zero_test(at_base(rows_.back()), m_); here.zero != true) {
                result.reason =
                    say("what it is held near is no equilibrium and no steady motion: the equation of {} does not "
                        "hold "
                        "there",
                        m_.q[i].get_name());
                return;
            }
        }
        std::vector<ZeroTest> tests{zero_test(at_base(residual_), m_)};
        if (tests[0].zero == false) result.reason = say("it does not even hold at the point itself");
        const std::vector<ex> slopes = eliminated();
        for (const ex& slope : slopes) tests.push_back(zero_test(slope, m_));
        const std::string reason = result.reason;
        settle_by(tests, result);
        if (!reason.empty()) result.reason = reason;
        if (result.verdict != Verdict::refuted) return;
        if (reason.empty()) result.difference = written(slopes);
        result.nearest = nearest();
    }

private:
    struct Small {
        GiNaC::symbol variable;
        ex value;  ///< the value from which the variable differs little
    };

    ex at_base(const ex& e) const { return e.subs(base_, GiNaC::subs_options::no_pattern); }

    /// The derivatives of the claim with respect to each small quantity, with the accelerations of the equations
    /// inserted: r_v − r_q'' M⁻¹ R_v.
    std::vector<ex> eliminated() const {
        const auto n = static_cast<unsigned>(m_.size()), count = static_cast<unsigned>(small_.size());
        GiNaC::matrix M(n, n), S(n, count), by(1, n);
        for (unsigned i = 0; i < n; ++i) {
            for (unsigned j = 0; j < n; ++j) M(i, j) = at_base(rows_[i].diff(m_.qddot[j]));
            for (unsigned v = 0; v < count; ++v) S(i, v) = at_base(rows_[i].diff(small_[v].variable));
            by(0, i) = at_base(residual_.diff(m_.qddot[i]));
        }
        const GiNaC::matrix part = by.mul(M.inverse()).mul(S);
        std::vector<ex> result;
        for (unsigned v = 0; v < count; ++v)
            result.push_back((at_base(residual_.diff(small_[v].variable)) - part(0, v)).normal());
        return result;
    }

    ex deviation(const Small& small) const { return small.variable - small.value; }

    std::string in_print(const ex& e) const {
        const auto f = fourier(e, *m_.symbols);
        return f ? text(readable(*f)) : "";
    }

    std::string written(const std::vector<ex>& slopes) const {
        ex sum = 0;
        for (std::size_t v = 0; v < slopes.size(); ++v) sum += slopes[v] * deviation(small_[v]);
        return in_print(sum);
    }

    /// The linear equation of the first coordinate whose acceleration the claim contains, multiplied so that its
    /// scale is that of the claim.
    std::string nearest() const {
        for (int i = 0; i < m_.size(); ++i) {
            const ex own = at_base(residual_.diff(m_.qddot[i]));
            if (own.is_zero()) continue;
            const ex scale = (own / at_base(rows_[i].diff(m_.qddot[i]))).normal();
            ex sum = 0;
            for (const GiNaC::symbol& acceleration : m_.qddot)
                sum += at_base(rows_[i].diff(acceleration)) * acceleration;
            for (const Small& small : small_) sum += at_base(rows_[i].diff(small.variable)) * deviation(small);
            const auto f = fourier((scale * sum).expand(), *m_.symbols);
            if (!f) return "";
            const ReadableEquation row = readable_equation(*f, Fourier());
            return text(row.lhs) + " = " + text(row.rhs);
        }
        return "";
    }

    const Mechanism& m_;
    const Equations& e_;
    const ex residual_;
    GiNaC::exmap base_;
    std::vector<Small> small_;
    std::vector<ex> rows_;
};

}  // namespace

void check_first_order(const Claim& claim, Claims& read, CheckedClaim& result) {
    FirstOrder(claim, read).settle(result);
}

}  // namespace alembert
