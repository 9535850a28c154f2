// SPDX-License-Identifier: GPL-2.0-or-later
// y = g(q, u, t, e, u', λ):   δy = g_(q,u,t,e) δ(q,u,t,e) + g_u' δu' + g_λ δλ.
#include "stability/linear/outputs.hpp"

#include "program/lower/lower.hpp"

namespace alembert {

using Index = Eigen::Index;

OutputProgram::OutputProgram(const Mechanism& m, const Equations& e, const Residuals& residuals) {
    first_multiplier_ = 3 * static_cast<int>(m.inputs.size());
    std::vector<std::pair<GiNaC::symbol, int>> given;
    for (int i = 0; i < e.size(); ++i) given.emplace_back(e.u[i], program_.variable({Variable::Kind::rate, i}));
    for (const int k : residuals.inputs)
        given.emplace_back(m.inputs[static_cast<std::size_t>(k / 3)].derivative[static_cast<std::size_t>(k % 3)],
                           program_.variable({Variable::Kind::unknown, k}));
    for (std::size_t k = 0; k < e.lambda.size(); ++k)
        given.emplace_back(e.lambda[k],
                           program_.variable({Variable::Kind::unknown, first_multiplier_ + static_cast<int>(k)}));
    if (!e.speeds_are_rates()) {
        const std::vector<int> rates = lower_expressions(program_, m, e.h, given);
        for (int i = 0; i < m.size(); ++i) given.emplace_back(m.qdot[i], rates[i]);
    }
    constexpr unsigned acceleration = 1U << static_cast<unsigned>(Variable::Kind::acceleration);
    for (const Mechanism::Definition& output : m.outputs) {
        bool known = true;
        int node = 0;
        try {
            node = lower_expressions(program_, m, {output.value}, given)[0];
            known = e.speeds_are_rates() || (program_[node].depends & acceleration) == 0;
        } catch (const std::runtime_error&) {  // a multiplier that the equations do not have
            known = false;
        }
        (known ? names_ : left_out_).push_back(output.name);
        if (known) nodes_.push_back(node);
    }
}

template <typename Real>
MatrixOf<Real> OutputProgram::by(const Residuals& r, const Instant<Real>& at, const Tangent<Real>& here) const {
    const std::size_t direct = at.q.size() + at.u.size() + 1 + r.inputs.size(), s = at.u.size(),
                      width = direct + s + static_cast<std::size_t>(here.lambda.size());
    Varied<Real> varied(r, at, static_cast<std::size_t>(first_multiplier_ + here.lambda.size()));
    State<Jet<Real>>& state = varied.state;
    for (Index i = 0; i < here.udot.size(); ++i) state.qddot.push_back(varied.next(here.udot[i]));
    for (Index k = 0; k < here.lambda.size(); ++k)
        state.unknown[static_cast<std::size_t>(first_multiplier_ + k)] = varied.next(here.lambda[k]);
    const std::vector<Jet<Real>> value = interpret(program_, state);
    MatrixOf<Real> g(static_cast<Index>(nodes_.size()), static_cast<Index>(width));
    for (std::size_t i = 0; i < nodes_.size(); ++i)
        for (std::size_t k = 0; k < width; ++k)
            g(static_cast<Index>(i), static_cast<Index>(k)) = value[nodes_[i]].derivative(k);
    const Index d = static_cast<Index>(direct), n = static_cast<Index>(s);
    return g.leftCols(d) * here.along + g.middleCols(d, n) * here.udot_by +
           g.rightCols(here.lambda.size()) * here.lambda_by;
}

template MatrixOf<double> OutputProgram::by(const Residuals&, const Instant<double>&,
                                            const Tangent<double>&) const;
template MatrixOf<long double> OutputProgram::by(const Residuals&, const Instant<long double>&,
                                                 const Tangent<long double>&) const;

}  // namespace alembert
