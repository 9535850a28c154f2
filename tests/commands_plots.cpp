// SPDX-License-Identifier: MIT
// Pictures of motions, sweeps and measurements: the drawn values are read back from the SVG and compared with the
// closed form of the motion.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>

#include "present/report/plot.hpp"
#include "present/report/work_precision.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_plots {

using namespace alembert;
using alembert::test::contents;
using alembert::test::run;
using alembert::test::temporary;

namespace {

constexpr const char* oscillator =
    "title = \"An oscillator\"\n[parameters]\nk = 4\n[coordinates]\nx = { initial = 1, unit = \"m\" }\n[energy]\n"
    "kinetic = \"x'^2/2\"\npotential = \"k*x^2/2\"\n";

/// The picture that a verb writes.
std::string picture(std::vector<std::string> words, const std::string& option) {
    const std::string file = temporary("picture.svg", "");
    words.insert(words.end(), {option, file});
    const auto result = run(words);
    INFO(result.err);
    REQUIRE(result.exit == 0);
    return contents(file);
}

/// Every tag is closed in turn, and no text has a bare & or <: as drawing programs require.
bool is_well_formed(const std::string& svg) {
    static const std::regex token(
        "<(/?)([a-z]+)((?:\\s+[\\w:-]+='[^'<&]*')*)\\s*(/?)>|&(?:lt|gt|amp|quot);|[^<&]");
    std::vector<std::string> open;
    auto at = svg.cbegin();
    for (std::smatch found; at != svg.cend(); at = found.suffix().first) {
        if (!std::regex_search(at, svg.cend(), found, token, std::regex_constants::match_continuous)) return false;
        if (!found[2].matched || found[4].length() > 0) continue;
        if (found[1].length() == 0) {
            open.push_back(found[2]);
        } else {
            if (open.empty() || open.back() != found[2]) return false;
            open.pop_back();
        }
    }
    return open.empty();
}

double number_of(std::string text) {
    if (text.starts_with("−")) text = "-" + text.substr(std::string("−").size());
    return std::stod(text);
}

/// Numbers beside the vertical axis, with their places; of the first chart.
std::vector<std::pair<double, double>> vertical_ticks(const std::string& svg) {
    static const std::regex tick("<text x='[^']*' y='([^']*)' fill='#222' text-anchor='end'>([^<]*)</text>");
    std::vector<std::pair<double, double>> ticks;
    for (std::sregex_iterator it(svg.begin(), svg.end(), tick), end; it != end; ++it)
        ticks.emplace_back(std::stod((*it)[1]) - 4, number_of((*it)[2]));
    return ticks;
}

PlotPoints first_line(const std::string& svg) {
    std::smatch found;
    REQUIRE(std::regex_search(svg, found, std::regex("<path d='([ML0-9. ]+)' fill='none' stroke='#0072B2'")));
    std::istringstream path(std::regex_replace(found[1].str(), std::regex("[ML]"), " "));
    PlotPoints points;
    for (double x = 0, y = 0; path >> x >> y;) points.emplace_back(x, y);
    return points;
}

}  // namespace

TEST_CASE("plot: ticks are round numbers inside the range, at least two and not more than requested") {
    for (const auto& [low, high] :
         {std::pair{-0.83, 1.02}, {0.0, 10.0}, {-6.1, 4.3}, {1e-9, 3.1e-9}, {-2e7, 5e7}, {99.99, 100.01}})
        for (const int most : {3, 5, 9}) {
            const PlotScale scale = linear_scale(low, high, 0, 100);
            const std::vector<PlotTick> ticks = scale.ticks(most);
            CAPTURE(low);
            CAPTURE(most);
            REQUIRE(ticks.size() >= 2);
            CHECK(ticks.size() <= static_cast<std::size_t>(most));
            for (const PlotTick& tick : ticks) {
                CHECK(scale.at(tick.value) > -1e-6);
                CHECK(scale.at(tick.value) < 100 + 1e-6);
            }
            const double step = ticks[1].value - ticks[0].value;
            const double digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
            CHECK(std::min({std::abs(digit - 1), std::abs(digit - 2), std::abs(digit - 5)}) < 1e-4);
        }
    CHECK(plot_number(0.30000000000000004, 0.1) == "0.3");
    CHECK(plot_number(-2.5, 0.5) == "−2.5");
    CHECK(plot_number(2e-9, 1e-9) == "2·10⁻⁹");
    CHECK(plot_number(1e6, 1e6) == "10⁶");
    CHECK(plot_number(1e-20, 1) == "0");
    CHECK(linear_scale(3, 3, 0, 1).low < 3);
    CHECK(linear_scale(NAN, 3, 0, 1).ticks(5).size() >= 2);
}

TEST_CASE("plot: as many styles differ as there are, and names beside lines do not touch each other") {
    std::set<std::pair<std::string, std::string>> styles;
    for (std::size_t k = 0; k < plot_styles; ++k) styles.emplace(plot_style(k).colour, plot_style(k).dashes);
    CHECK(styles.size() == plot_styles);
    std::vector<PlotLabel> labels;
    for (std::size_t k = 0; k < 8; ++k)
        labels.push_back({100, 50 + 0.1 * static_cast<double>(k), "line", plot_style(k)});
    const std::string svg = plot_labels(labels, 130, 0, 120);
    static const std::regex place("<text x='130.0' y='([^']*)'");
    std::vector<double> rows;
    for (std::sregex_iterator it(svg.begin(), svg.end(), place), end; it != end; ++it)
        rows.push_back(std::stod((*it)[1]));
    REQUIRE(rows.size() == 8);
    for (std::size_t k = 1; k < rows.size(); ++k) CHECK(rows[k] - rows[k - 1] > 12);
}

TEST_CASE("simulate: the line that --plot draws is the motion, read back by its axes") {
    const std::string svg =
        picture({"simulate", temporary("oscillator.toml", oscillator), "--duration", "3"}, "--plot");
    CHECK(is_well_formed(svg));
    CHECK(svg.find("<title>An oscillator</title>") != std::string::npos);
    CHECK(svg.find(">x in m<") != std::string::npos);
    CHECK(svg.find(">x' in m/s<") != std::string::npos);
    CHECK(svg.find(">t in s<") != std::string::npos);
    CHECK(svg.find(">energy − 2 in J<") != std::string::npos);  // it changes only by rounding
    const auto ticks = vertical_ticks(svg);
    REQUIRE(ticks.size() > 2);
    const double scale = (ticks[1].second - ticks[0].second) / (ticks[1].first - ticks[0].first);
    const PlotPoints line = first_line(svg);
    REQUIRE(line.size() > 100);
    for (const auto& [x, y] : line) {
        const double t = 3 * (x - line.front().first) / (line.back().first - line.front().first);
        // Places are drawn to a tenth of a pixel, which is 0.002 m here.
        CHECK(std::abs(ticks[0].second + scale * (y - ticks[0].first) - std::cos(2 * t)) < 0.006);
    }
}

TEST_CASE("simulate: --plot - draws the motion into the text, and each dot is where the motion is") {
    const std::string scene = temporary("cosine.toml",
                                        "title = \"cos\"\n[coordinates]\nx = 1\n[energy]\n"
                                        "kinetic = \"x'^2/2\"\npotential = \"x^2/2\"\n"
                                        "[simulation]\nduration = 6.283185307179586\n");
    const std::string text = run({"simulate", scene, "--plot", "-"}).out;
    const std::size_t begin = text.find("\nx\n");
    REQUIRE(begin != std::string::npos);
    std::istringstream lines(text.substr(begin + 3));
    std::vector<std::pair<int, int>> dots;  // from the left, from above
    std::string line;
    int row = 0, across = 0;
    for (; row < 4 && std::getline(lines, line); ++row) {
        const std::size_t bar = line.find("│");
        REQUIRE(bar != std::string::npos);
        if (row == 0) CHECK(std::stod(line.substr(0, bar)) == doctest::Approx(1).epsilon(1e-3));
        if (row == 3) CHECK(std::stod(line.substr(0, bar)) == doctest::Approx(-1).epsilon(1e-3));
        across = 0;
        for (std::size_t at = bar + 3; at + 3 <= line.size(); at += 3, ++across) {
            const int bits = (line[at + 1] & 0x3f) << 6 | (line[at + 2] & 0x3f);  // of U+2800 + bits, in UTF-8
            constexpr int of_dots[2][4] = {{0x01, 0x02, 0x04, 0x40}, {0x08, 0x10, 0x20, 0x80}};
            for (int x = 0; x < 2; ++x)
                for (int y = 0; y < 4; ++y)
                    if ((bits & 0xff & of_dots[x][y]) != 0) dots.emplace_back(2 * across + x, 4 * row + y);
        }
    }
    REQUIRE(row == 4);
    std::set<int> columns;
    for (const auto& [x, y] : dots) {
        columns.insert(x);
        double nearest = 1e9;  // a dot belongs to some time within its column
        for (int k = -60; k <= 60; ++k) {
            const double t = 2 * M_PI * (x + k / 100.0) / (2 * across - 1);
            nearest = std::min(nearest, std::abs((1 - std::cos(t)) / 2 * 15 - y));
        }
        CHECK(nearest <= 0.75);
    }
    CHECK(columns.size() == static_cast<std::size_t>(2 * across));
    const std::string digits = run({"simulate", scene, "--digits"}).out;
    CHECK(std::regex_search(digits, std::regex("x +(1|0\\.9999999[0-9]{6,})")));
    CHECK(digits.find("│") == std::string::npos);  // not on a terminal, and not asked for
}

TEST_CASE("simulate: --show chooses what is drawn; impacts and closed contacts are marked") {
    const std::string ball = alembert::test::source_path("scenes/textbook/bouncing_ball.toml");
    const std::string svg = picture({"simulate", ball, "--show", "y', energy"}, "--plot");
    CHECK(is_well_formed(svg));
    CHECK(svg.find(">y' in m/s<") != std::string::npos);
    CHECK(svg.find(">energy in J<") != std::string::npos);
    CHECK(svg.find(">y in m<") == std::string::npos);
    CHECK(svg.find("contact floor: 40 impacts, 1 rest") != std::string::npos);
    CHECK(svg.find("fill='#f0f0f0'") != std::string::npos);
    const auto wrong = run({"simulate", ball, "--plot", temporary("wrong.svg", "old"), "--show", "enrgy"});
    CHECK(wrong.exit == 3);
    CHECK(wrong.err.find("did you mean 'energy'?") != std::string::npos);
    CHECK(run({"simulate", ball, "--show", "y"}).exit == 3);  // there is no picture to show it in
    CHECK(run({"simulate", ball, "--plot", temporary("wrong.svg", "old"), "--show", "y,,y'"}).exit == 3);
}

TEST_CASE("simulate, sweep: nothing of a scene becomes markup in a picture") {
    const std::string scene = temporary("hostile.toml",
                                        "title = \"</title><script>alert(1)</script><b "
                                        "onload='x'>&lt;'\\\"\\u0007\"\n[parameters]\nk = 1\n[coordinates]\n"
                                        "x = { initial = 1, unit = \"m\" }\n[energy]\nkinetic = \"x'^2/2\"\n"
                                        "potential = \"k*x^2/2\"\n[simulation]\nduration = 0.1\n");
    for (const std::string& svg :
         {picture({"simulate", scene}, "--plot"), picture({"sweep", scene, "--vary", "x=0:1:3"}, "--svg"),
          picture({"sweep", scene, "--vary", "x=0:1:3", "k=1:2:2"}, "--svg")}) {
        CHECK(is_well_formed(svg));
        CHECK(svg.find("<script") == std::string::npos);
        CHECK(svg.find("<b") == std::string::npos);
        CHECK(svg.find('\a') == std::string::npos);
        CHECK(svg.find("&lt;script&gt;") != std::string::npos);
    }
}

// x = x0 + v0 t, drawn over both: the brightest cell is where both are largest, and cells with the same sum have
// the same colour.
TEST_CASE("sweep: --svg draws a map over two varied quantities, whose colours are the final values") {
    const std::string scene = temporary("free.toml",
                                        "[coordinates]\nx = { initial = 0, rate = 0 }\n[energy]\n"
                                        "kinetic = \"x'^2/2\"\n[simulation]\nduration = 1\n");
    const std::string svg = picture({"sweep", scene, "--vary", "x=0:3:4", "x'=0:2:3"}, "--svg");
    CHECK(is_well_formed(svg));
    CHECK(svg.find(">initial x<") != std::string::npos);
    CHECK(svg.find(">final x<") != std::string::npos);
    std::map<std::string, std::set<std::pair<int, int>>> places;
    static const std::regex path("<path fill='(#[0-9a-f]{6})' d='([^']*)'"), cell("M([0-9]+) ([0-9]+)h1v1h-1z");
    for (std::sregex_iterator it(svg.begin(), svg.end(), path), end; it != end; ++it) {
        const std::string cells = (*it)[2];
        for (std::sregex_iterator one(cells.begin(), cells.end(), cell); one != end; ++one)
            places[(*it)[1]].emplace(std::stoi((*one)[1]), std::stoi((*one)[2]));
    }
    REQUIRE(places.size() == 6);  // sums from 0 to 5
    for (const auto& [colour, cells] : places)
        for (const auto& [i, j] : cells) CHECK(i + j == cells.begin()->first + cells.begin()->second);
    const std::set<std::pair<int, int>> corner{{3, 2}};
    CHECK(std::any_of(places.begin(), places.end(), [&](const auto& one) {
        return one.second == corner && one.first.starts_with("#f");  // yellow
    }));
    const auto refused = run({"sweep", temporary("oscillator.toml", oscillator), "--vary", "x=0:1:2", "x'=0:1:2",
                              "k=1:2:2", "--svg", temporary("map.svg", "")});
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("one or two varied quantities") != std::string::npos);
}

TEST_CASE("sweep: --svg draws lines over one varied quantity") {
    const std::string svg = picture({"sweep", temporary("oscillator.toml", oscillator), "--vary", "x=-1:1:21",
                                     "--duration", "1", "--show", "x,x'"},
                                    "--svg");
    CHECK(is_well_formed(svg));
    CHECK(svg.find(">initial x in m<") != std::string::npos);
    const PlotPoints line = first_line(svg);  // x(1) = x(0) cos 2: straight, and falling as y goes down the page
    REQUIRE(line.size() == 21);
    for (std::size_t k = 1; k < line.size(); ++k) {
        CHECK(line[k].first - line[k - 1].first == doctest::Approx(line[1].first - line[0].first).epsilon(1e-3));
        CHECK(line[k].second - line[k - 1].second ==
              doctest::Approx(line[1].second - line[0].second).epsilon(0.02));
    }
    CHECK(line.back().second > line.front().second);
}

TEST_CASE("bench: each method has a style of its own, and the fastest at some error are drawn strongly") {
    std::vector<Curve> curves;
    for (int k = 0; k < 17; ++k) {
        Curve one{.name = "method" + std::to_string(k), .points = {}};
        for (int d = 1; d < 12; ++d) one.points.emplace_back(std::pow(10, -d), 1e-5 * (k + 1) * d);
        curves.push_back(one);
    }
    curves[16].points.emplace_back(1e-13, 1);  // the only curve there, and so the fastest
    const std::string svg = work_precision(curves, "seventeen");
    CHECK(is_well_formed(svg));
    static const std::regex line(
        "<path d='[^']*' fill='none' stroke='(#[0-9A-F]{6})' stroke-width='(2.4|1.2)' "
        "stroke-linejoin='round'( stroke-dasharray='[^']*')?");
    std::set<std::string> styles;
    int strong = 0;
    for (std::sregex_iterator it(svg.begin(), svg.end(), line), end; it != end; ++it) {
        styles.insert((*it)[1].str() + (*it)[3].str());
        strong += (*it)[2] == "2.4";
    }
    CHECK(styles.size() == 17);
    CHECK(strong == 2);
    CHECK(std::regex_search(svg, std::regex("font-weight='bold'>method0<")));
    CHECK(std::regex_search(svg, std::regex("font-weight='bold'>method16<")));
    CHECK(!std::regex_search(svg, std::regex("font-weight='bold'>method1<")));
    CHECK(is_well_formed(work_precision({}, "none")));
}

}  // namespace commands_plots
