// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What is done of a sweep, in a file, so that the sweep can go on after it was interrupted.
///
///     SweepJournal journal("table.csv.unfinished", sweeper.key(), SweepJournal::Begin::resume);
///     for (const SweepJournal::Record& record : journal.records()) … journal.bytes(record) …
///     journal.add({128, 64}, bytes);
///     journal.remove();                                 // when the table is written
///
/// The file has a line of its format, the key of the sweep, and records: first motion, count, size, checksum
/// (CRC-32), bytes. A record that was cut short when the process ended is dropped when the file is opened again,
/// and so is what follows it. The file is locked while it is open.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "simulate/sweep.hpp"

namespace alembert {

class SweepJournal {
public:
    enum class Begin { anew, resume };
    struct Record {
        SweepPart part;
        std::uint64_t place, size;
    };

    /// With `anew`, and where there is no file, an empty one is made. Throws ModelError if the file is in use, or
    /// belongs to another sweep; CompileError if it cannot be written or read.
    SweepJournal(std::string path, const std::string& key, Begin begin);
    SweepJournal(const SweepJournal&) = delete;
    SweepJournal& operator=(const SweepJournal&) = delete;
    ~SweepJournal();

    void add(SweepPart part, std::string_view bytes);
    /// Puts one record in the place of all, in one step.
    void replace(std::string_view bytes);
    const std::vector<Record>& records() const { return records_; }
    std::string bytes(const Record& record) const;
    void remove();
    const std::string& path() const { return path_; }

private:
    /// Opens and locks. Does not follow links.
    int opened(const std::string& path, int flags) const;
    void begin_anew();
    void read_records();
    void write(std::string_view bytes);
    [[noreturn]] void fail() const;

    std::string path_, head_;
    int file_ = -1;
    std::uint64_t end_ = 0;
    std::vector<Record> records_;
};

}  // namespace alembert
