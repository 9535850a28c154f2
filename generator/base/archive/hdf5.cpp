// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/archive/hdf5.hpp"

#include <filesystem>

#include "alembert/base/error.hpp"
#include "alembert/native/module.hpp"
#include "alembert/native/process.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

/// It stays loaded until the end.
decltype(&alembert_hdf5) library() {
    const std::filesystem::path beside = beside_this_program("alembert-hdf5.so");
    if (beside.empty())
        throw CompileError(
            say("tables in HDF5 need its library, with which this program was not built; install libhdf5-dev "
                "(Debian) and build again, or write NAME.npz or NAME.csv"));
    static const ObjectFile file(beside);
    const auto function = reinterpret_cast<decltype(&alembert_hdf5)>(file.find("alembert_hdf5"));
    if (function == nullptr)
        throw CompileError(
            say("{} belongs to another version of this program; build both again", beside.string()));
    return function;
}

}  // namespace

void need_hdf5() {
    library();
}

std::string as_hdf5(const StoredTable& table) {
    std::string bytes;
    if (!library()(table, bytes)) throw CompileError(say("HDF5 cannot make a file of this table"));
    return bytes;
}

}  // namespace alembert
