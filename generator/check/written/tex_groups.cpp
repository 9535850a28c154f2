// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/tex_groups.hpp"

#include "check/written/parser.hpp"

namespace alembert {

namespace {

using GroupKind = WrittenToken::Kind;
using Tokens = std::vector<WrittenToken>;

/// Whether a group that begins behind these tokens is what a command or a power takes.
bool is_argument(const Tokens& before) {
    const std::vector<std::size_t> partner = partners(before);
    std::size_t end = before.size(), groups = 0;
    while (end > 0 && before[end - 1].kind == GroupKind::end_group && partner[end - 1] != no_partner) {
        end = partner[end - 1];
        ++groups;
    }
    if (end == 0) return false;
    const WrittenToken& taker = before[end - 1];
    if (taker.kind == GroupKind::index || taker.kind == GroupKind::power) return groups == 0;
    return taker.kind == GroupKind::command && groups < (taker.text == "frac" || taker.text == "binom" ? 2U : 1U);
}

class FractionWriter {
public:
    explicit FractionWriter(const Tokens& tokens) : tokens_(tokens), partner_(partners(tokens)) {}

    Tokens written() {
        write(0, tokens_.size());
        return std::move(out_);
    }

private:
    const Tokens& tokens_;
    const std::vector<std::size_t> partner_;
    Tokens out_;

    void add(GroupKind kind, const WrittenToken& at, const char* text) {
        out_.push_back(at);
        out_.back().kind = kind;
        out_.back().text = text;
    }

    /// The sign \over that stands directly in a group; its end if none does.
    std::size_t over_in(std::size_t begin, std::size_t end) const {
        for (std::size_t i = begin; i < end; ++i) {
            if (tokens_[i].kind == GroupKind::command && tokens_[i].text == "over") return i;
            if (partner_[i] != no_partner && partner_[i] > i && partner_[i] < end) i = partner_[i];
        }
        return end;
    }

    void write(std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const bool is_group = tokens_[i].kind == GroupKind::begin_group && partner_[i] != no_partner;
            const std::size_t close = is_group ? partner_[i] : i;
            const std::size_t over = is_group ? over_in(i + 1, close) : close;
            if (over < close) {
                const bool keeps_group = is_argument(out_);
                if (keeps_group) out_.push_back(tokens_[i]);
                add(GroupKind::command, tokens_[over], "frac");
                add(GroupKind::begin_group, tokens_[i], "{");
                write(i + 1, over);
                add(GroupKind::end_group, tokens_[over], "}");
                add(GroupKind::begin_group, tokens_[over], "{");
                write(over + 1, close);
                out_.push_back(tokens_[close]);
                if (keeps_group) out_.push_back(tokens_[close]);
                i = close;
            } else if (is_group && !out_.empty() && out_.back().kind == GroupKind::partial) {
                write(i + 1, close);
                i = close;
            } else {
                out_.push_back(tokens_[i]);
            }
        }
    }
};

}  // namespace

std::vector<WrittenToken> with_fractions(std::vector<WrittenToken> tokens) {
    bool has_any = false;
    for (std::size_t i = 0; i < tokens.size() && !has_any; ++i)
        has_any = (tokens[i].kind == GroupKind::command && tokens[i].text == "over") ||
                  (tokens[i].kind == GroupKind::partial && i + 1 < tokens.size() &&
                   tokens[i + 1].kind == GroupKind::begin_group);
    return has_any ? FractionWriter(tokens).written() : std::move(tokens);
}

}  // namespace alembert
