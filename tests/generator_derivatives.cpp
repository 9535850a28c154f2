// SPDX-License-Identifier: MIT
// The differentiated program against dual numbers that go through the undifferentiated one, its solve included.
#include <doctest/doctest.h>

#include <map>

#include "alembert/error.hpp"
#include "dual.hpp"
#include "formalism/formalisms.hpp"
#include "lower/choose.hpp"
#include "lower/differentiate.hpp"
#include "lower/partials.hpp"
#include "scenes.hpp"
#include "symbolic/symbols.hpp"

using namespace alembert;
using test::Dual;

namespace {

/// q, then q' or u.
std::vector<double> flat(const State<double>& s) {
    std::vector<double> y = s.q;
    y.insert(y.end(), s.qdot.begin(), s.qdot.end());
    return y;
}

/// (q', u'), and the power last, with the derivatives along component j of the state, or of the parameters.
std::vector<Dual> along(const Program& p, const State<double>& s, bool parameter, std::size_t j) {
    State<Dual> at{.parameters = {s.parameters.begin(), s.parameters.end()}, .t = s.t, .q = {s.q.begin(), s.q.end()},
                   .qdot = {s.qdot.begin(), s.qdot.end()}, .qddot = {}};
    (parameter ? at.parameters[j] : j < s.q.size() ? at.q[j] : at.qdot[j - s.q.size()]).d = 1;
    std::vector<Dual> rates, value = interpret(p, at);
    if (p.speeds.empty()) rates = at.qdot;
    for (const int id : p.nodes_of("rate")) rates.push_back(value[static_cast<std::size_t>(id)]);
    for (const int id : p.nodes_of("acceleration")) rates.push_back(value[static_cast<std::size_t>(id)]);
    at.qddot.assign(rates.begin() + static_cast<std::ptrdiff_t>(s.q.size()), rates.end());
    value = interpret(p, at);
    rates.push_back(value[static_cast<std::size_t>(p.nodes_of("power")[0])]);
    return rates;
}

/// The largest difference over the largest entry, of a matrix whose columns are `along` and whose rows are roots; −1 where the
/// state has no finite rates.
double misfit(const Program& program, const Differentiated& d, const State<double>& s) {
    const std::vector<double> y = flat(s);
    State<double> at = s;
    std::vector<double> value = interpret(d.program, at);
    for (const int id : d.program.nodes_of("acceleration")) at.qddot.push_back(value[static_cast<std::size_t>(id)]);
    value = interpret(d.program, at);
    double worst = 0;
    const auto compare = [&](const char* group, const char* last, bool parameter, std::size_t columns) {
        const std::vector<int> nodes = d.program.nodes_of(group), tail = d.program.nodes_of(last);
        double difference = 0, largest = 1e-3;
        for (std::size_t j = 0; j < columns; ++j) {
            const std::vector<Dual> exact = along(program, s, parameter, j);
            for (std::size_t i = 0; i < y.size() + (tail.empty() ? 0 : 1); ++i) {
                const double ours = value[static_cast<std::size_t>(i < y.size() ? nodes[i * columns + j] : tail[j])];
                difference = std::max(difference, std::isfinite(exact[i].d) ? std::abs(ours - exact[i].d) : 0);
                largest = std::max(largest, std::abs(exact[i].d));
                if (!std::isfinite(exact[i].v)) return;
            }
        }
        worst = std::max(worst, difference / largest);
    };
    compare("jacobian", "power_gradient", false, y.size());
    if (!d.program.nodes_of("parameter_jacobian").empty()) compare("parameter_jacobian", "", true, s.parameters.size());
    return worst;
}

}  // namespace

TEST_CASE("derivatives: the Jacobians of the scenes are those of dual numbers") {
    std::mt19937_64 random(20240917);
    int checked = 0;
    for (const char* folder : {"scenes/textbook", "scenes/gallery"})
        for (const std::string& path : test::scenes_in(folder)) {
            const Mechanism m = build(read_scene(path));
            for (const Formalism& f : formalisms()) {
                if (f.name != std::string("routh") && f.name != std::string("kane")) continue;
                std::optional<Equations> derived;
                try {
                    derived = f.derive(m);
                } catch (const ModelError&) {
                    continue;  // it does not apply to this scene
                }
                const Equations& equations = *derived;
                const Program program = choose(m, equations).program;
                if (program.singular) continue;
                const auto d = differentiated(program, {.parameters = true, .power = true});
                REQUIRE(d);
                const Start start = start_of(m);
                State<double> s = state_of(start, m, equations);
                std::uniform_real_distribution<double> near(-0.3, 0.3);
                for (int k = 0; k < 4; ++k) {
                    INFO(path << " by " << f.name << ", seed 20240917, state " << k << ": " << d->route);
                    // Rounding: the accelerations' own, and that of the differences of large terms in their derivatives.
                    CHECK(misfit(program, *d, s) < 1e-10);
                    ++checked;
                    s.t += 0.1;
                    for (double& q : s.q) q += near(random);
                    for (double& u : s.qdot) u += near(random);
                }
                MESSAGE(path << " by " << f.name << ": " << program.count(program.right_hand_side()).total() << " -> "
                             << d->operations.total() << " by " << d->route);
            }
        }
    CHECK(checked > 100);
}
