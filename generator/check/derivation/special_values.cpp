// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/special_values.hpp"

#include <algorithm>
#include <utility>

#include "check/written/sentences.hpp"
#include "check/written/words.hpp"

namespace alembert {

using GiNaC::ex;

void SpecialValues::hear(const std::string& words) {
    if (speaks_of_general_case(words)) all_.clear(), sentence_.clear();
}

void SpecialValues::hear_end(const std::string& words) {
    is_settled_ = is_settled_ || holds_sentence(words);
    begins_case_ = begins_case_ || ends_sentence(words) || words.find("- ") != std::string::npos;
}

void SpecialValues::state(const ex& name, const ex& value, From from) {
    const ex plain = value.subs(all_, GiNaC::subs_options::no_pattern);
    if (plain.has(name)) return;
    for (auto& [other, known] : all_) known = known.subs(name == plain, GiNaC::subs_options::no_pattern);
    all_[name] = plain;
    lines_since_ = 0;
    states_now_ = from == From::line;
    if (begins_case_) sentence_.clear();
    begins_case_ = false;
    const ex own = value.subs(sentence_, GiNaC::subs_options::no_pattern);
    for (auto& [other, known] : sentence_) known = known.subs(name == own, GiNaC::subs_options::no_pattern);
    if (!own.has(name)) sentence_[name] = own;
}

void SpecialValues::pass_line() {
    if (!std::exchange(states_now_, false)) ++lines_since_;
}

std::vector<const GiNaC::exmap*> SpecialValues::cases() const {
    std::vector<const GiNaC::exmap*> result;
    if (!all_.empty()) result.push_back(&all_);
    if (!sentence_.empty() && sentence_.size() != all_.size()) result.push_back(&sentence_);
    return result;
}

/// Whether all values are numbers other than zero, which hold for the page.
bool SpecialValues::are_data() const {
    return std::all_of(all_.begin(), all_.end(), [](const auto& item) {
        return GiNaC::is_a<GiNaC::numeric>(item.second) && !item.second.is_zero();
    });
}

bool SpecialValues::is_fresh(const std::string& words) const {
    constexpr std::size_t longest = 24;  // "and", "or, for the second,"
    constexpr int most_lines = 3;
    const bool goes_on = words.size() < longest && !ends_sentence(words) && !begins_sentence(words);
    return are_data() || lines_since_ == 0 || (lines_since_ < most_lines && goes_on);
}

bool SpecialValues::is_over(const std::string& words) const {
    return is_settled_ || !is_fresh(words);
}

}  // namespace alembert
