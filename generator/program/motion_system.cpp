// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/motion_system.hpp"

namespace alembert {

std::size_t speeds_of(const Program& p) {
    return p.speeds.empty() ? p.coordinates.size() : p.speeds.size();
}

MotionSystem motion_system(Program& p) {
    MotionSystem s{.K = p.nodes_of(Group::mass), .b = p.nodes_of(Group::forcing)};
    s.speeds = s.size();
    const std::vector<int> rows = p.nodes_of(p.speeds.empty() ? Group::row : Group::speed_row),
                           gamma = p.nodes_of(Group::gamma);
    for (int k = 0; const int c : p.kept_constraints()) {
        for (int i = 0; i < s.speeds; ++i) s.K.push_back(rows[static_cast<std::size_t>(c * s.speeds + i)]);
        s.K.insert(s.K.end(), static_cast<std::size_t>(++k), p.number(0));
    }
    s.b.insert(s.b.end(), gamma.begin(), gamma.end());
    const std::vector<int> tied = p.nodes_of(Group::tied_row), tie = p.nodes_of(Group::tie),
                           tied_gamma = p.nodes_of(Group::tied_gamma);
    for (std::size_t k = 0; k < tied_gamma.size(); ++k) {
        const auto row = tied.begin() + static_cast<std::ptrdiff_t>(k) * s.speeds;
        s.K.insert(s.K.end(), row, row + s.speeds);
        s.K.insert(s.K.end(), gamma.size() + k + 1, p.number(0));
    }
    s.b.insert(s.b.end(), tied_gamma.begin(), tied_gamma.end());
    for (std::size_t k = 0, at = 0; at < tie.size(); ++k)
        for (std::size_t j = 0; j <= k; ++j) {
            const std::size_t i = static_cast<std::size_t>(s.speeds) + k;
            s.K[i * (i + 1) / 2 + static_cast<std::size_t>(s.speeds) + j] = tie[at++];
        }
    return s;
}

int row_times(Program& p, const MotionSystem& system, int i, const std::vector<int>& z) {
    std::vector<Program::Term> terms;
    for (std::size_t j = 0; j < z.size(); ++j)
        terms.emplace_back(1, p.product(1, {{system.entry(i, static_cast<int>(j)), 1}, {z[j], 1}}));
    return p.sum(0, terms);
}

}  // namespace alembert
