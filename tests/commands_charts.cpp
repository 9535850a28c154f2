// SPDX-License-Identifier: MIT
// stability --vary and --exponents as a user types them: files, pictures and refusals. The numbers are
// held in stability_charts.cpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "program.hpp"
#include "scenes.hpp"

namespace commands_charts {

using namespace alembert::test;

namespace {

const std::string ziegler = source_path("scenes/stability/ziegler.toml");

std::string contents(const std::string& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("charts: files have a row for each node and value, and pictures their legend") {
    const std::string svg = temporary("chart.svg", ""), csv = temporary("chart.csv", "");
    const Run drawn = run({"stability", source_path("scenes/stability/mathieu.toml"), "--over", "a=-1:3:9",
                           "--over", "q=0:2:5", "-o", csv, "--svg", svg});
    CHECK(drawn.exit == 0);
    CHECK(drawn.out.find("boundary line") != std::string::npos);
    const std::string table = contents(csv), picture = contents(svg);
    CHECK(table.starts_with("part,a,q,kind,beyond\nnode,-1,0,divergence,"));
    CHECK(std::count(table.begin(), table.end(), '\n') > 46);
    CHECK(picture.find("critical: on the circle") != std::string::npos);
    CHECK(picture.find("unstable: beyond -1") != std::string::npos);
    const Run followed = run({"stability", ziegler, "--locus", "P=0:3:11", "-o", csv, "--svg", svg, "--json"});
    CHECK(followed.exit == 0);
    CHECK(contents(csv).starts_with("P,re_1,im_1,re_2,im_2"));
    CHECK(contents(svg).find("P = 2.08579") != std::string::npos);
}

TEST_CASE("charts: what cannot be drawn is refused, each with its reason") {
    const auto refused = [](const std::vector<std::string>& options, const std::string& with) {
        std::vector<std::string> all{"stability", ziegler};
        all.insert(all.end(), options.begin(), options.end());
        const Run ran = run(all);
        CAPTURE(ran.err);
        CHECK(ran.exit == 3);
        CHECK(ran.err.find(with) != std::string::npos);
    };
    refused({"--vary", "P=0:1", "--vary", "c=1:2", "--vary", "a=1:2"}, "expected --vary twice");
    refused({"--over", "P=0:1", "--over", "P=0:2"}, "P is varied twice");
    refused({"--over", "P=0:1", "--over", "a=0:2"}, "a cannot be varied");
    refused({"--over", "P=0:1", "--over", "nothing=0:2"}, "nothing");
    refused({"--over", "P=0:1", "--over", "c=1:1"}, "two different numbers");
    refused({"--locus", "P=0"}, "expected NAME=FROM:TO");
    refused({"--locus", "P=0:1", "--at", "P=2"}, "cannot be held");
    refused({"--locus", "P=0:1", "--exponents", "1"}, "expected one of them");
    refused({"--svg", "x.svg"}, "expected --vary with it");
    refused({"--exponents", "0"}, "expected how many");
    refused({"--exponents", "9"}, "has 4 dimensions");
    refused({"--duration", "3"}, "--duration belongs to --exponents");
}

}  // namespace commands_charts
