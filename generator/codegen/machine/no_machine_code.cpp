// SPDX-License-Identifier: GPL-2.0-or-later
// In place of the files that need xbyak, where it is not there: every solver is compiled.
#include "codegen/machine/can_run.hpp"
#include "codegen/machine/memory_series.hpp"
#include "codegen/machine/memory_series_packs.hpp"
#include "codegen/machine/memory_solver.hpp"

namespace alembert {

bool machine::can_run(int) {
    return false;
}

int machine::lanes_of_processor() {
    return 4;
}

int machine::registers_of_processor() {
    return 16;
}

std::optional<MemorySolver> memory_solver(const Program&, bool, std::optional<int>, std::optional<int>) {
    return std::nullopt;
}

std::optional<MemorySeries> memory_series(const Program&, bool) {
    return std::nullopt;
}

std::shared_ptr<const PackSeries> memory_series_packs(const Program&, bool, std::optional<int>) {
    return nullptr;
}

}  // namespace alembert
