// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/swept_store.hpp"

#include <algorithm>

#include "simulate/byte_text.hpp"

namespace alembert {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto between_writings = std::chrono::milliseconds(500);  // of a reduction
constexpr int most_of_time = 50;                                   // a writing takes at most a 50th

}  // namespace

std::string packed_part(const Sweep& sweep, const std::vector<Statistic>& statistics, SweepPart part,
                        const std::vector<SweptMotion>& motions) {
    if (statistics.empty()) return bytes_of(motions);
    SweepReduction reduction(sweep, statistics);
    reduction.add(part.first, motions);
    return reduction.bytes();
}

SweptStore::SweptStore(const Sweep& sweep, std::vector<Statistic> statistics, SweepJournal* journal)
    : s_(sweep), journal_(journal), next_writing_(Clock::now() + between_writings) {
    if (!statistics.empty()) reduction_.emplace(sweep, std::move(statistics));
    if (journal_ != nullptr) read_journal();
}

void SweptStore::read_journal() {
    if (!reduction_) {
        for (const SweepJournal::Record& record : journal_->records()) kept_ += record.part.count;
    } else if (!journal_->records().empty()) {
        const std::string bytes = journal_->bytes(journal_->records().back());
        ByteReader in(bytes);
        for (const SweepPart& part : in.list<SweepPart>()) {
            parts_[part.first] = part.count;
            kept_ += part.count;
        }
        reduction_->set(in.rest());
    }
    safe_ = kept_;
}

std::vector<SweepPart> SweptStore::parts() const {
    std::vector<SweepPart> list;
    if (!reduction_ && journal_ != nullptr)
        for (const SweepJournal::Record& record : journal_->records()) list.push_back(record.part);
    for (const auto& [first, count] : parts_) list.push_back({first, count});
    return list;
}

void SweptStore::keep(SweepPart part, std::string bytes) {
    kept_ += part.count;
    if (reduction_) {
        reduce(part, bytes);
    } else if (journal_ != nullptr) {
        journal_->add(part, bytes);
        safe_ = kept_;
    } else {
        memory_[part.first] = {part, std::move(bytes)};
        for (auto next = memory_.begin(); rows_ && next != memory_.end() && next->first == given_;
             next = memory_.erase(next)) {
            const auto& [which, rows] = next->second;
            rows_(motions_of(rows, s_, which));
            given_ += which.count;
        }
    }
}

void SweptStore::reduce(SweepPart part, std::string_view bytes) {
    SweepReduction more(s_, reduction_->statistics());
    more.set(bytes);
    reduction_->add(more);
    auto at = parts_.emplace(part.first, part.count).first;
    if (at != parts_.begin()) {
        const auto before = std::prev(at);
        if (before->first + before->second == at->first) {
            before->second += at->second;
            parts_.erase(at);
            at = before;
        }
    }
    const auto after = std::next(at);
    if (after != parts_.end() && at->first + at->second == after->first) {
        at->second += after->second;
        parts_.erase(after);
    }
    if (journal_ != nullptr && Clock::now() > next_writing_) write_reduction();
}

void SweptStore::write_reduction() {
    const Clock::time_point begin = Clock::now();
    std::string record;
    put_list(record, parts());
    journal_->replace(record + reduction_->bytes());
    safe_ = kept_;
    const Clock::time_point end = Clock::now();
    next_writing_ = end + std::max<Clock::duration>(between_writings, most_of_time * (end - begin));
}

void SweptStore::each(const Rows& rows) const {
    for (const auto& [first, kept] : memory_) rows(motions_of(kept.second, s_, kept.first));
    if (journal_ == nullptr) return;
    std::vector<SweepJournal::Record> records = journal_->records();
    std::sort(records.begin(), records.end(),
              [](const auto& a, const auto& b) { return a.part.first < b.part.first; });
    for (const SweepJournal::Record& record : records) rows(motions_of(journal_->bytes(record), s_, record.part));
}

}  // namespace alembert
