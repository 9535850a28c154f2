// SPDX-License-Identifier: MIT
// Steps that would pass over a function of the state which is flat but for a small region (ode/quick_places.hpp).
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "alembert/ode/integrate.hpp"

namespace runtime_places {

using namespace alembert;

namespace {

using Op = EventInstruction::Op;

/// exp(−((x − at)/w)²), as a list of instructions; the parameters are at and w.
std::shared_ptr<const EventCode> hill() {
    EventCode code;
    code.events.push_back({{.op = Op::state, .index = 0},
                           {.op = Op::parameter, .index = 0},
                           {.op = Op::sum, .terms = {{.arg = 0}, {.arg = 1, .factor = -1}}},
                           {.op = Op::parameter, .index = 1},
                           {.op = Op::inverse, .terms = {{.arg = 3, .exponent = -1}}},
                           {.op = Op::product, .terms = {{.arg = 2, .exponent = 2}, {.arg = 4, .exponent = 2}}},
                           {.op = Op::sum, .terms = {{.arg = 5, .factor = -1}}},
                           {.op = Op::exp, .terms = {{.arg = 6}}}});
    return std::make_shared<const EventCode>(std::move(code));
}

/// x'' = F exp(−((x − at)/w)²).
System pushed(double F, double at, double w) {
    return {.rhs = make_rhs(2,
                            [=](double, const double* y, double* rate) {
                                const double z = (y[0] - at) / w;
                                rate[0] = y[1];
                                rate[1] = F * std::exp(-z * z);
                            }),
            .quick_places = {hill(), {at, w}}};
}

}  // namespace

// v² = 1 + 2 F w √π.
TEST_CASE("places: no method passes over a narrow force, and far from it steps stay long") {
    for (const Method method : {Method::dopri5, Method::dop853, Method::verner76, Method::verner98, Method::abm,
                                Method::bdf, Method::radau})
        for (const double w : {1e-5, 1e-3, 0.02, 0.3})
            for (const double at : {1.7, 3.3, 7.9}) {
                INFO(name(method));
                CAPTURE(w);
                CAPTURE(at);
                const double F = 0.5 / w, exact = std::sqrt(1 + 2 * F * w * std::sqrt(std::acos(-1.0)));
                const Trajectory motion = integrate(pushed(F, at, w), {0, 1}, {.method = method, .duration = 12});
                CHECK(!motion.failure);
                CHECK(std::abs(motion.final_state()[1] - exact) < 1e-6);
                const Trajectory away = integrate(pushed(F, at, w), {0, -1}, {.method = method, .duration = 12});
                CHECK(away.final_state()[1] == doctest::Approx(-1));
                const Trajectory alone =
                    integrate(System{.rhs = pushed(F, at, w).rhs}, {0, -1}, {.method = method, .duration = 12});
                CHECK(away.statistics.steps <= alone.statistics.steps + (w > 0.1 ? 2 : 0));
            }
}

TEST_CASE("intervals: what overflows has a bound, and what has no value anywhere is told") {
    const Bounds far = inverse(cosh(Bounds{{5000, 6000}, {}, {}}));
    CHECK(far.value.low >= -1e-300);
    CHECK(far.value.high <= 1e-300);
    CHECK(sqrt(Bounds{{-2, -1}, {}, {}}).nowhere);
    CHECK(!sqrt(Bounds{{-2, 1}, {}, {}}).nowhere);
    CHECK((2 * (log(Bounds{{-2, -1}, {}, {}}) + Bounds{{1, 1}, {}, {}})).nowhere);
    CHECK(exp(acos(Bounds{{1.1, 2}, {}, {}})).nowhere);
}

}  // namespace runtime_places
