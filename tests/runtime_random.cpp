// SPDX-License-Identifier: MIT
// Numbers drawn at random: those of GNU's C++ library, which results of this program were made with, with any
// library.
#include <doctest/doctest.h>

#include "alembert/base/random.hpp"

namespace runtime_random {

using namespace alembert;

TEST_CASE("random: numbers of one engine are the same with every library") {
    std::mt19937_64 random(1);
    const UniformReal<> away(-1, 3);
    NormalReal normal;
    // From the engine's first four numbers, by its definition in Python with 60 digits: 4 n/2⁶⁴ − 1, and the polar
    // method.
    CHECK(away(random) == doctest::Approx(-0.4644934239498691).epsilon(1e-15));
    CHECK(away(random) == doctest::Approx(-0.454371854535211).epsilon(1e-15));
    CHECK(normal(random) == doctest::Approx(-0.3868317616210397).epsilon(1e-15));
    CHECK(normal(random) == doctest::Approx(-0.039399956754155266).epsilon(1e-15));
}

#if defined(__GLIBCXX__) && _GLIBCXX_RELEASE < 16  // whose distributions are others
TEST_CASE("random: distributions are those of GNU's C++ library, bit for bit") {
    std::mt19937_64 mine(7), other(7);
    const UniformReal<> unit(0, 1), wide(-3.7, 11.3);
    const UniformReal<long double> longer(-1.5L, 1.5L);
    std::uniform_real_distribution<double> its_unit, its_wide(-3.7, 11.3);
    std::uniform_real_distribution<long double> its_longer(-1.5L, 1.5L);
    NormalReal normal;
    std::normal_distribution<double> its_normal;
    int differences = 0;
    for (int k = 0; k < 1000; ++k) {
        differences += unit(mine) != its_unit(other) ? 1 : 0;
        differences += wide(mine) != its_wide(other) ? 1 : 0;
        differences += longer(mine) != its_longer(other) ? 1 : 0;
        for (int pair = 0; pair < 3; ++pair) differences += normal(mine) != its_normal(other) ? 1 : 0;
    }
    CHECK(differences == 0);
    CHECK(mine() == other());
}
#endif

}  // namespace runtime_random
