// SPDX-License-Identifier: GPL-2.0-or-later
// alembert-mpi.so: see simulate/ranks.hpp.
#include <mpi.h>

#include <cstdlib>
#include <string>

#include "simulate/ranks.hpp"

namespace {

bool is_over = false;

/// The other processes would wait for ever for one that has ended with an error.
void end_all(int status, void* /*nothing*/) {
    if (!is_over) MPI_Abort(MPI_COMM_WORLD, status);
}

void send(int to, const std::string& message) {
    MPI_Send(message.data(), static_cast<int>(message.size()), MPI_BYTE, to, 0, MPI_COMM_WORLD);
}

bool receive(int& from, std::string& message) {
    int is_there = 0, size = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &is_there, &status);
    if (is_there == 0) return false;
    MPI_Get_count(&status, MPI_BYTE, &size);
    from = status.MPI_SOURCE;
    message.resize(static_cast<std::size_t>(size));
    MPI_Recv(message.data(), size, MPI_BYTE, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return true;
}

void finish() {
    is_over = true;
    MPI_Finalize();
}

}  // namespace

extern "C" bool alembert_mpi(alembert::Ranks& ranks) {
    int level = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS) return false;
    on_exit(end_all, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &ranks.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks.size);
    ranks.send = send;
    ranks.receive = receive;
    ranks.finish = finish;
    return level >= MPI_THREAD_FUNNELED;
}
