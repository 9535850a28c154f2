// SPDX-License-Identifier: MIT
// The catalogue of translations: its reader, and whether each translation takes the values of its English text.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cctype>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/language/catalogue.hpp"
#include "base/language/say.hpp"
#include "commands/language.hpp"
#include "program.hpp"
#include "tools.hpp"

namespace commands_language {

using namespace alembert;

/// The places of values in a format: their numbers and how they are written, "0" and ":>24.16g".
class Places {
public:
    static std::set<std::pair<int, std::string>> of(const std::string& format) {
        Places places(format);
        while (places.at_ < format.size()) places.step();
        return places.found_;
    }

private:
    explicit Places(const std::string& format) : text_(format) {}

    void step() {
        const bool is_double = at_ + 1 < text_.size() && text_[at_] == text_[at_ + 1];
        if (text_[at_] == '{' && !is_double) {
            place();
        } else {
            at_ += is_double && (text_[at_] == '{' || text_[at_] == '}') ? 2 : 1;
        }
    }

    /// From a brace to the one that closes it; gives the number of the value.
    int place() {
        ++at_;
        std::string digits, how;
        while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0)
            digits += text_[at_++];
        const int number = digits.empty() ? next_++ : std::stoi(digits);
        while (at_ < text_.size() && text_[at_] != '}')
            if (text_[at_] == '{')
                how += fmt::format("{{{}}}", place());
            else
                how += text_[at_++];
        ++at_;
        found_.emplace(number, how);
        return number;
    }

    const std::string& text_;
    std::size_t at_ = 0;
    int next_ = 0;
    std::set<std::pair<int, std::string>> found_;
};

/// A catalogue as msgfmt would write it: a header of seven numbers, two tables of lengths and places, the texts.
std::string compiled(const std::vector<std::pair<std::string, std::string>>& entries) {
    std::string numbers, texts;
    const auto add = [&](std::size_t n) {
        const auto value = static_cast<std::uint32_t>(n);
        numbers.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    const std::size_t count = entries.size(), tables = 28, begin = tables + 16 * count;
    for (const std::size_t n : {std::size_t{0x950412de}, std::size_t{0}, count, tables, tables + 8 * count,
                                std::size_t{0}, std::size_t{0}})
        add(n);
    const auto table = [&](auto side) {
        for (const auto& entry : entries) {
            add((entry.*side).size());
            add(begin + texts.size());
            texts += entry.*side + '\0';
        }
    };
    table(&std::pair<std::string, std::string>::first);
    table(&std::pair<std::string, std::string>::second);
    return numbers + texts;
}

TEST_CASE(
    "language: texts are translated with their values, and stay English where the translation asks for others") {
    const std::string file = compiled({{"a body", "刚体"}, {"{} of {}", "{1} 的 {0}"}, {"{} steps", "{1} 步"}});
    const MessageCatalogue catalogue(file);
    use_catalogue(&catalogue);
    CHECK(translated("a body") == "刚体");
    CHECK(translated("a frame") == "a frame");
    CHECK(translated_parts("a body, a frame") == "刚体, a frame");
    CHECK(say("{} of {}", "T", "M1") == "M1 的 T");
    CHECK(say("{} steps", 3) == "3 steps");
    CHECK(say("{:.2f} s", 0.125) == "0.12 s");
    use_catalogue(nullptr);
    CHECK(translated("a body") == "a body");
    CHECK_THROWS_AS(MessageCatalogue("no catalogue at all, but long enough"), std::invalid_argument);
    CHECK_THROWS_AS(MessageCatalogue(std::string_view(file).substr(0, 40)), std::invalid_argument);
}

TEST_CASE("language: each translation holds values of its English text, written in the same way") {
    if (!test::is_provided(!chinese_catalogue.empty(), "gettext")) return;
    const MessageCatalogue chinese(chinese_catalogue);
    CHECK(chinese.entries().size() > 1000);
    for (const auto& [english, translation] : chinese.entries()) {
        if (english.empty()) continue;
        const auto wanted = Places::of(std::string(english)), used = Places::of(std::string(translation));
        CAPTURE(english);
        CAPTURE(translation);
        CHECK(std::includes(wanted.begin(), wanted.end(), used.begin(), used.end()));
    }
}

TEST_CASE("language: what the reader of TOML finds is said in Chinese too") {
    for (const char* text : {"a = [1 2]", "= 1", "a = \"\\q\"", "a = 1\n[a]", "a = 10:99:00", "a = 1__0",
                             "a = [1,,2]", "a..b = 1", "a b = 1", "a = {b = 1}\na.c = 2"}) {
        CAPTURE(text);
        const auto result = test::run({"derive", "--language", "zh", test::temporary("mistake.toml", text)});
        CHECK(result.exit == 3);
        const std::size_t begin = result.err.find(": ");
        REQUIRE(begin != std::string::npos);
        std::string message = result.err.substr(begin + 2, result.err.find('\n') - begin - 2);
        if (const std::size_t name = message.find("TOML"); name != std::string::npos) message.erase(name, 4);
        CHECK_FALSE(message.empty());
        int letters = 0;  // one after the other
        for (const char c : message) {
            letters = std::isalpha(static_cast<unsigned char>(c)) != 0 ? letters + 1 : 0;
            CHECK(letters < 3);
        }
    }
}

}  // namespace commands_language
