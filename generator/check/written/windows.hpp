// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the parser reads a part of its tokens by itself, and how deep it may go.

#include "base/language/say.hpp"
#include "check/written/parser.hpp"

namespace alembert {

/// While it lives, the parser sees the tokens from `begin` to `end` alone.
struct MathParser::Window {
    Window(MathParser& parser, std::size_t begin, std::size_t end)
        : parser_(parser), at_(parser.at_), end_(parser.end_), bars_(parser.bars_), is_bare_(parser.is_bare_) {
        parser.at_ = begin;
        parser.end_ = end;
        parser.bars_ = 0;
        parser.is_bare_ = false;
    }
    Window(const Window&) = delete;
    ~Window() {
        parser_.at_ = at_;
        parser_.end_ = end_;
        parser_.bars_ = bars_;
        parser_.is_bare_ = is_bare_;
    }

private:
    MathParser& parser_;
    const std::size_t at_, end_;
    const int bars_;
    const bool is_bare_;
};

struct MathParser::Depth {
    explicit Depth(MathParser& parser) : parser_(parser) {
        if (++parser.depth_ > 3 * most_written_nesting)
            throw BeyondLimit{parser.now().offset,
                              say("the formula is nested more than {} levels deep", most_written_nesting)};
    }
    Depth(const Depth&) = delete;
    ~Depth() { --parser_.depth_; }

private:
    MathParser& parser_;
};

}  // namespace alembert
