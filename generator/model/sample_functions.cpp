// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/sample_functions.hpp"

#include <algorithm>

#include "algebra/symbolic/unspecified.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

/// Fractions between 1/7 and 2, of either sign, which are the same in every run.
class Coefficients {
public:
    explicit Coefficients(int function) : state_(static_cast<std::uint64_t>(function) + 1) {}
    numeric next() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        const auto drawn = static_cast<int>((state_ >> 33) % 28);
        return numeric(drawn < 14 ? drawn + 1 : 13 - drawn) / 7;
    }

private:
    std::uint64_t state_;
};

/// A cubic in the arguments, differentiated as the call is.
ex sample(const UnspecifiedCall& call, int function) {
    Coefficients c(function);
    std::vector<GiNaC::symbol> x(call.arguments.size());
    ex value = c.next();
    for (std::size_t i = 0; i < x.size(); ++i) {
        value += c.next() * x[i] + c.next() * pow(x[i], 2) / 2 + c.next() * pow(x[i], 3) / 6;
        for (std::size_t j = 0; j < i; ++j) value += c.next() * x[i] * x[j];
    }
    GiNaC::exmap at;
    for (std::size_t i = 0; i < x.size(); ++i) {
        value = value.diff(x[i], static_cast<unsigned>(call.orders[i]));
        at[x[i]] = call.arguments[i];
    }
    return value.subs(at, GiNaC::subs_options::no_pattern);
}

}  // namespace

bool constraints_are_open(const Mechanism& m) {
    const std::vector<GiNaC::symbol> functions = m.open_functions();
    if (functions.empty()) return false;
    const auto is_open = [&](const ex& e) { return m.z->depends(e, functions); };
    const auto row_is_open = [&](const auto& row) { return std::any_of(row.begin(), row.end(), is_open); };
    for (const auto* list : {&m.constraints, &m.redundant})
        for (const Mechanism::Constraint& c : *list)
            if ((c.position && is_open(*c.position)) || is_open(c.offset) || row_is_open(c.row)) return true;
    for (const Mechanism::Rolling& rolling : m.rollings)
        for (const Mechanism::Constraint& c : rolling.along)
            if (is_open(c.offset) || row_is_open(c.row)) return true;
    return std::any_of(m.speeds.begin(), m.speeds.end(),
                       [&](const Mechanism::Speed& s) { return is_open(s.offset) || row_is_open(s.row); });
}

Mechanism with_sample_functions(const Mechanism& mechanism) {
    if (!constraints_are_open(mechanism)) return mechanism;
    Mechanism m = mechanism;
    m.z = std::make_shared<Intermediates>(*mechanism.z);
    m.z->redefine([&](const ex& definition) -> std::optional<ex> {
        const auto call = unspecified_call(definition);
        if (!call || m.table_of(call->function) != nullptr) return std::nullopt;
        return sample(*call, m.symbols->info(GiNaC::ex_to<GiNaC::symbol>(call->function)).index);
    });
    m.q_is_guess.assign(m.q.size(), true);
    m.qdot_is_guess.assign(m.q.size(), true);
    return m;
}

}  // namespace alembert
