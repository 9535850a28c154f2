// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/sweep_queue.hpp"

#include <algorithm>

namespace alembert {

std::vector<SweepPart> parts_left(std::size_t size, std::vector<SweepPart> done) {
    std::sort(done.begin(), done.end(), [](const SweepPart& a, const SweepPart& b) { return a.first < b.first; });
    done.push_back({size, 0});
    std::vector<SweepPart> left;
    std::size_t next = 0;
    for (const SweepPart& part : done) {
        if (part.first > next) left.push_back({next, part.first - next});
        next = std::max(next, part.first + part.count);
    }
    return left;
}

SweepQueue::SweepQueue(std::vector<SweepPart> left, const QueueOptions& options)
    : left_(std::move(left)), options_(options) {
    std::reverse(left_.begin(), left_.end());
    for (const SweepPart& part : left_) waiting_ += part.count;
}

std::size_t SweepQueue::length() const {
    if (options_.fixed > 0) return options_.fixed;
    const std::size_t fair = waiting_ / (2 * options_.takers) + 1;
    if (ended_ == 0) return std::min(options_.first, fair);
    const double seconds = std::chrono::duration<double>(Clock::now() - *begin_).count(),
                 wished = options_.seconds * static_cast<double>(ended_) /
                          (seconds * static_cast<double>(options_.takers));
    const auto most = static_cast<double>(std::min(options_.most, fair));
    return static_cast<std::size_t>(std::clamp(wished, 1.0, most));
}

std::optional<SweepPart> SweepQueue::next() {
    const std::lock_guard lock(mutex_);
    if (left_.empty()) return {};
    if (!begin_) begin_ = Clock::now();
    SweepPart& rest = left_.back();
    const SweepPart part{rest.first, std::min(length(), rest.count)};
    rest.first += part.count;
    rest.count -= part.count;
    if (rest.count == 0) left_.pop_back();
    waiting_ -= part.count;
    given_ += part.count;
    return part;
}

void SweepQueue::done(const SweepPart& part) {
    const std::lock_guard lock(mutex_);
    ended_ += part.count;
}

void SweepQueue::close() {
    const std::lock_guard lock(mutex_);
    left_.clear();
}

bool SweepQueue::is_done() const {
    const std::lock_guard lock(mutex_);
    return left_.empty() && ended_ == given_;
}

double SweepQueue::fraction(std::size_t all) const {
    const std::lock_guard lock(mutex_);
    const std::size_t open = waiting_ + given_ - ended_;
    return static_cast<double>(all - open) / static_cast<double>(all);
}

}  // namespace alembert
