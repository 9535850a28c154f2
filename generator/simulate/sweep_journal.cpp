// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/sweep_journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

#include "alembert/base/error.hpp"
#include "base/archive/zip.hpp"
#include "base/language/say.hpp"
#include "simulate/byte_text.hpp"

namespace alembert {

namespace {

constexpr std::string_view format_line = "alembert sweep 1\n";

/// What stands before the bytes of a record.
struct RecordHead {
    std::uint64_t first, count, size, checksum;
};

std::uint64_t checksum_of(const RecordHead& head, std::string_view bytes) {
    std::string before;
    for (const std::uint64_t number : {head.first, head.count, head.size}) put_bytes(before, number);
    return std::uint64_t{crc32_of(before)} << 32U | crc32_of(bytes);
}

std::string head_of(SweepPart part, std::string_view bytes) {
    RecordHead head{part.first, part.count, bytes.size(), 0};
    head.checksum = checksum_of(head, bytes);
    std::string text;
    put_bytes(text, head);
    return text;
}

/// Nothing if so many bytes are not there.
std::optional<std::string> read_at(int file, std::uint64_t place, std::uint64_t size) {
    std::string bytes(size, '\0');
    for (std::uint64_t done = 0; done < size;) {
        const ssize_t count = pread(file, bytes.data() + done, size - done, static_cast<off_t>(place + done));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return {};
        done += static_cast<std::uint64_t>(count);
    }
    return bytes;
}

}  // namespace

SweepJournal::SweepJournal(std::string path, const std::string& key, Begin begin)
    : path_(std::move(path)), head_(std::string(format_line) + key + "\n") {
    file_ = opened(path_, O_CREAT);
    const std::optional<std::string> head = read_at(file_, 0, head_.size());
    if (begin == Begin::anew || lseek(file_, 0, SEEK_END) == 0) {
        begin_anew();
    } else if (head == head_) {
        read_records();
    } else {
        close(file_);
        throw ModelError(
            say("--resume: {} belongs to another sweep (another scene, other options, or another version of this "
                "program); give the same command as before, or leave --resume out to begin anew",
                path_));
    }
}

SweepJournal::~SweepJournal() {
    close(file_);
}

int SweepJournal::opened(const std::string& path, int flags) const {
    const int file = open(path.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC | flags, 0666);
    if (file < 0) fail();
    if (flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(file);
        throw ModelError(say("{} is in use: another sweep is writing the same table", path));
    }
    return file;
}

void SweepJournal::fail() const {
    throw CompileError(say("cannot write '{}': {}", path_, std::strerror(errno)));
}

void SweepJournal::begin_anew() {
    if (ftruncate(file_, 0) != 0) fail();
    end_ = 0;
    write(head_);
}

void SweepJournal::read_records() {
    const auto size = static_cast<std::uint64_t>(lseek(file_, 0, SEEK_END));
    end_ = head_.size();
    while (const std::optional<std::string> before = read_at(file_, end_, sizeof(RecordHead))) {
        const auto head = ByteReader(*before).take<RecordHead>();
        const std::uint64_t place = end_ + sizeof head;
        if (head.size > size - place) break;
        const std::optional<std::string> bytes = read_at(file_, place, head.size);
        if (!bytes || checksum_of(head, *bytes) != head.checksum) break;
        records_.push_back(
            {{static_cast<std::size_t>(head.first), static_cast<std::size_t>(head.count)}, place, head.size});
        end_ = place + head.size;
    }
    if (ftruncate(file_, static_cast<off_t>(end_)) != 0) fail();
}

void SweepJournal::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(end_));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail();
        end_ += static_cast<std::uint64_t>(count);
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
}

void SweepJournal::add(SweepPart part, std::string_view bytes) {
    write(head_of(part, bytes));
    write(bytes);
    records_.push_back({part, end_ - bytes.size(), bytes.size()});
}

void SweepJournal::replace(std::string_view bytes) {
    const std::string beside = path_ + ".new";
    const int before = file_;
    file_ = opened(beside, O_CREAT | O_TRUNC);
    close(before);
    records_.clear();
    end_ = 0;
    write(head_);
    add({}, bytes);
    if (rename(beside.c_str(), path_.c_str()) != 0) fail();
}

std::string SweepJournal::bytes(const Record& record) const {
    const std::optional<std::string> bytes = read_at(file_, record.place, record.size);
    if (!bytes) throw CompileError(say("cannot read '{}': {}", path_, std::strerror(errno)));
    return *bytes;
}

void SweepJournal::remove() {
    unlink(path_.c_str());
}

}  // namespace alembert
