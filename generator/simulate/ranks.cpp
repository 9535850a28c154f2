// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/ranks.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "alembert/base/error.hpp"
#include "alembert/native/module.hpp"
#include "alembert/native/process.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

long number_in(const char* variable) {
    const char* const text = std::getenv(variable);
    return text == nullptr ? 0 : std::strtol(text, nullptr, 10);
}

/// How many processes a launcher of MPI started: Open MPI, MPICH and its relatives, srun with PMIx. The last says
/// the number by SLURM alone.
long launched() {
    const long known = std::max(number_in("OMPI_COMM_WORLD_SIZE"), number_in("PMI_SIZE"));
    if (known > 0) return known;
    return std::getenv("PMIX_RANK") != nullptr ? std::max(1L, number_in("SLURM_STEP_NUM_TASKS")) : 1;
}

}  // namespace

std::unique_ptr<Ranks> ranks_of_launcher() {
    const long count = launched(), tasks = number_in("SLURM_STEP_NUM_TASKS");
    if (count <= 1 && tasks > 1)
        throw CompileError(say(
            "srun started {} tasks without MPI, so that each would do the whole sweep; give srun --mpi=pmix, or "
            "what 'srun --mpi=list' has",
            tasks));
    if (count <= 1) return nullptr;
    const std::filesystem::path beside = beside_this_program("alembert-mpi.so");
    if (beside.empty())
        throw CompileError(say(
            "{} processes were started together, and this program was built without MPI, so that each would do "
            "the whole sweep; install libopenmpi-dev (Debian) and build again, or start one process with "
            "--threads",
            count));
    static const ObjectFile file(beside);
    const auto begin = reinterpret_cast<decltype(&alembert_mpi)>(file.find("alembert_mpi"));
    if (begin == nullptr)
        throw CompileError(
            say("{} belongs to another version of this program; build both again", beside.string()));
    auto ranks = std::make_unique<Ranks>();
    if (!begin(*ranks)) throw CompileError(say("MPI does not begin; its own message says why"));
    if (ranks->size > 1) return ranks;
    if (count > 1)
        throw CompileError(say(
            "the launcher started {} processes, and for MPI this one is alone; the launcher belongs to another "
            "MPI than the one with which this program was built",
            count));
    return nullptr;
}

void Nap::take() {
    usleep(microseconds_);
    microseconds_ = std::min(2 * microseconds_, most);
}

}  // namespace alembert
