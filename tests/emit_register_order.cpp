// SPDX-License-Identifier: MIT
// The order of statements for registers: a permutation that respects what needs what, and how many values wait at
// once.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "codegen/emit/register_order.hpp"

namespace emit_register_order {

using namespace alembert;

namespace {

/// Each position once, after those that it needs.
bool is_in_order(const std::vector<Computation>& statements, const std::vector<int>& order) {
    std::vector<char> done(statements.size(), 0);
    for (const int id : order) {
        for (const int need : statements[static_cast<std::size_t>(id)].needs)
            if (done[static_cast<std::size_t>(need)] == 0) return false;
        if (done[static_cast<std::size_t>(id)]++ != 0) return false;
    }
    return order.size() == statements.size();
}

/// The largest number of values that are still needed after a statement.
int most_live(const std::vector<Computation>& statements, const std::vector<int>& order) {
    std::vector<int> uses(statements.size(), 0);
    for (const Computation& s : statements)
        for (const int need : s.needs) ++uses[static_cast<std::size_t>(need)];
    int live = 0, most = 0;
    for (const int id : order) {
        for (const int need : statements[static_cast<std::size_t>(id)].needs)
            if (--uses[static_cast<std::size_t>(need)] == 0) --live;
        if (uses[static_cast<std::size_t>(id)] > 0) most = std::max(most, ++live);
    }
    return most;
}

std::vector<int> as_given(std::size_t count) {
    std::vector<int> order(count);
    for (std::size_t k = 0; k < count; ++k) order[k] = static_cast<int>(k);
    return order;
}

}  // namespace

TEST_CASE("register order: 400 values that would wait for their partners fit in the registers") {
    std::vector<Computation> statements(400);
    for (int k = 0; k < 200; ++k) statements.push_back({.needs = {k, 399 - k}});
    CHECK(most_live(statements, as_given(statements.size())) == 400);
    const std::vector<int> order = register_order(statements);
    CHECK(is_in_order(statements, order));
    CHECK(most_live(statements, order) <= 32);
}

TEST_CASE("register order: a chain, for which only its length matters, is not changed") {
    std::vector<Computation> statements(1);
    for (int k = 0; k < 100; ++k) statements.push_back({.needs = {k}});
    CHECK(register_order(statements) == as_given(statements.size()));
}

TEST_CASE("register order: arguments come first in any order, which depends only on the statements") {
    std::mt19937 random(5);
    for (int round = 0; round < 50; ++round) {
        std::vector<Computation> statements;
        for (int k = 0; k < 300; ++k) {
            Computation s{.needs = {},
                          .operations = 1 + static_cast<int>(random() % 9),
                          .latency = 4 + static_cast<int>(random() % 20)};
            for (int j = 0; j < 3; ++j)
                if (k > 0 && random() % 3 != 0)
                    s.needs.push_back(static_cast<int>(random() % static_cast<unsigned>(k)));
            std::sort(s.needs.begin(), s.needs.end());
            s.needs.erase(std::unique(s.needs.begin(), s.needs.end()), s.needs.end());
            statements.push_back(std::move(s));
        }
        CAPTURE(round);
        const std::vector<int> order = register_order(statements);
        CHECK(is_in_order(statements, order));
        CHECK(order == register_order(statements));
    }
}

}  // namespace emit_register_order
