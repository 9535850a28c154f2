// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which long dashes of a line are minus signs, as scanned books have them: those within brackets, those behind a
/// relation or an opening bracket, and those before another term. A remark, a name or an equation's number behind
/// a dash is none: "= 0 — (1)", "= 0 — sin θ dropped".
///
///     LongDashes(tokens, source).is_minus(3)      // true of "r² — m g r cos θ = E", if it is the fourth token

#include <functional>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "check/written/tokens.hpp"

namespace alembert {

class LongDashes {
public:
    using Kind = WrittenToken::Kind;
    using Source = std::function<std::string_view(std::size_t)>;  ///< of a token, by its position
    LongDashes(const std::vector<WrittenToken>& tokens, Source source)
        : tokens_(tokens), source_(std::move(source)) {}

    bool is_minus(std::size_t token) const;

private:
    bool is_dash(std::size_t token) const;
    bool is_any_of(std::size_t token, std::initializer_list<Kind> kinds) const;
    int depth_before(std::size_t token) const;
    std::ptrdiff_t count_relations(std::size_t from, std::size_t to) const;
    bool is_term_from(std::size_t from) const;

    const std::vector<WrittenToken>& tokens_;
    Source source_;
};

}  // namespace alembert
