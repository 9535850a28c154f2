// SPDX-License-Identifier: MIT
#pragma once

/// For clang before 16, in which a lambda cannot capture a structured binding, as those of doctest's INFO, CAPTURE
/// and CHECK_MESSAGE do: what they say is put together at once there.

#include <doctest/doctest.h>

#include <sstream>
#include <string>

namespace alembert::test {

class Told : public doctest::detail::MessageBuilder {
public:
    Told() : MessageBuilder("", 0, doctest::assertType::is_warn) { m_stream = &text_; }
    static std::string text(MessageBuilder& told) { return static_cast<Told&>(told).text_.str(); }

private:
    std::ostringstream text_;
};

}  // namespace alembert::test

#undef DOCTEST_INFO
#define DOCTEST_INFO(...)                                                                                   \
    auto DOCTEST_ANONYMOUS(told_) = doctest::detail::MakeContextScope(                                      \
        [text = alembert::test::Told::text((alembert::test::Told() * __VA_ARGS__))](std::ostream* stream) { \
            *stream << text;                                                                                \
        })
