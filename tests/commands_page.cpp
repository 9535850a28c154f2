// SPDX-License-Identifier: MIT
// The page of a scene: its contents, that it is well formed, and that nothing of a scene becomes markup or script.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "edits.hpp"
#include "present/report/html.hpp"
#include "present/report/page_plot.hpp"
#include "present/report/sha256.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_page {

using alembert::test::contents;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

std::string page_of(const std::string& scene, int code = 0, const std::vector<std::string>& more = {}) {
    const std::string file = temporary("page.html", "");
    std::vector<std::string> args{"report", scene, "-o", file};
    args.insert(args.end(), more.begin(), more.end());
    const auto result = run(args);
    CAPTURE(result.err);
    CHECK(result.exit == code);
    return contents(file);
}

/// The mistake in the nesting of the elements of a page or a picture; empty if there is none.
std::string nesting(const std::string& page, const std::set<std::string>& empty_elements) {
    std::vector<std::string> open;
    for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at)) {
        if (page[at + 1] == '!' || page[at + 1] == '?') {
            at = page.find('>', at);
            continue;
        }
        const bool closes = page[at + 1] == '/';
        std::size_t end = at + (closes ? 2 : 1);
        const std::size_t begin = end;
        while (end < page.size() && (std::isalnum(static_cast<unsigned char>(page[end])) != 0)) ++end;
        const std::string name = page.substr(begin, end - begin);
        if (name.empty()) return "a bare '<' at " + page.substr(at, 40);
        char quote = 0;
        for (; end < page.size() && (quote != 0 || page[end] != '>'); ++end) {
            if (quote != 0 && page[end] == quote)
                quote = 0;
            else if (quote == 0 && (page[end] == '"' || page[end] == '\''))
                quote = page[end];
            else if (quote == 0 && page[end] == '<')
                return "a '<' in the element " + name;
        }
        if (closes) {
            if (open.empty() || open.back() != name)
                return "</" + name + "> closes " + (open.empty() ? "nothing" : "<" + open.back() + ">");
            open.pop_back();
        } else if (page[end - 1] != '/' && !empty_elements.contains(name)) {
            open.push_back(name);
        }
        at = end;
        if (!closes && (name == "script" || name == "style")) at = page.find("</" + name, at);
    }
    return open.empty() ? "" : "<" + open.back() + "> is left open";
}

const std::set<std::string> html_empty{"meta", "input", "br", "link"};

Json data_of(const std::string& page) {
    const std::string begin = "<script type=\"application/json\" id=\"data\">";
    const std::size_t at = page.find(begin) + begin.size();
    return Json::parse(page.substr(at, page.find("</script>", at) - at));
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

/// The scripts that run.
std::vector<std::string> scripts_of(const std::string& page) {
    const std::string begin = "<script>";
    std::vector<std::string> list;
    for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
        at += begin.size();
        list.push_back(page.substr(at, page.find("</script>", at) - at));
    }
    return list;
}

}  // namespace

TEST_CASE(
    "page: a double pendulum's has its figure, equations, parameters, claims, plots, code, and no more than 2 "
    "MB") {
    const std::string page = page_of(source_path("scenes/textbook/double_pendulum.toml"), 0, {"--duration", "2"});
    CHECK(page.size() < 2'000'000);
    CHECK(nesting(page, html_empty) == "");
    for (const char* id :
         {"figure", "mechanism", "derivation", "claims", "agreement", "plots", "run", "code", "commands"})
        CHECK(count(page, "<section id=\"" + std::string(id) + "\"") == 1);
    CHECK(count(page, "<math") > 20);
    CHECK(page.find("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"figure\"") != std::string::npos);
    CHECK(page.find("default-src 'none'") != std::string::npos);
    CHECK(page.find("http://") == page.find("http://www.w3.org/2000/svg"));  // nothing is fetched
    CHECK(page.find("https://") == std::string::npos);
    CHECK(count(page, "<strong class=\"verdict\">proved</strong>") == 2);
    CHECK(count(page, "<figure class=\"plot\">") >= 5);
    const Json data = data_of(page);
    CHECK(data["copies"].size() >= 4);
    // The last frame of the second mass, on its grid of 1/16 of a pixel, is where the simulation ends.
    const Json& figure = data["figure"];
    const auto last =
        run({"simulate", source_path("scenes/textbook/double_pendulum.toml"), "--duration", "2", "--json"});
    const Json final = Json::parse(last.out)["final"]["coordinates"];
    const double theta1 = final["theta1"], theta2 = final["theta2"], scale = figure["scale"];
    const int mass = figure["traced"][1];
    const double x = figure["frames"].back()[2 * mass].get<double>() / (16 * scale),
                 y = figure["frames"].back()[2 * mass + 1].get<double>() / (16 * scale);
    CHECK(std::abs(x - std::sin(theta1) - 0.8 * std::sin(theta2)) < 1 / (16 * scale));
    CHECK(std::abs(y + std::cos(theta1) + 0.8 * std::cos(theta2)) < 1 / (16 * scale));  // up, where y is down
}

TEST_CASE(
    "page: a motion with contacts, dry friction or impacts is played, and the page says why it has no sliders") {
    for (const char* const scene :
         {"scenes/textbook/bouncing_ball.toml", "scenes/friction/stick_slip.toml", "scenes/gallery/clock.toml"}) {
        CAPTURE(scene);
        const std::string page = page_of(source_path(scene), 0, {"--duration", "1"});
        CHECK(scripts_of(page).size() == 1);
        CHECK(page.find("<details class=\"live\"") == std::string::npos);
        CHECK(page.find("has no sliders, because it does not follow contacts") != std::string::npos);
    }
}

TEST_CASE("page: a scene with equations beyond 400 kB of JavaScript is played alone; smaller ones have sliders") {
    const std::string large = page_of(source_path("scenes/gallery/stewart.toml"), 0, {"--duration", "0.01"});
    CHECK(large.find("has no sliders, because its equations are") != std::string::npos);
    CHECK(scripts_of(large).size() == 1);
    for (const char* const scene : {"scenes/textbook/chaplygin_sleigh_in_speeds.toml",
                                    "scenes/textbook/free_body_quaternion.toml", "scenes/gallery/rssr.toml"}) {
        CAPTURE(scene);
        const std::string page = page_of(source_path(scene), 0, {"--duration", "0.1"});
        REQUIRE(scripts_of(page).size() == 3);
        CHECK(scripts_of(page)[0].size() < 410'000);
        const Json live = data_of(page)["live"];
        const std::size_t size = live["coordinates"].get<std::size_t>() + live["speeds"].get<std::size_t>();
        CHECK(live["state"].size() == size);
        CHECK(live["guessed"].size() == size);
        CHECK(count(page, "data-kind=\"state\"") == size);
    }
}

TEST_CASE("page: nothing of a hostile scene becomes markup or script") {
    const std::string hostile = source_path("tests/browser/hostile.toml");
    const std::string page = page_of(hostile);
    CHECK(nesting(page, html_empty) == "");
    const std::vector<std::string> scripts = scripts_of(page);
    CHECK(scripts.size() == 3);  // the equations, what integrates them, what draws
    CHECK(count(page, "<script") == scripts.size() + 1);
    CHECK(count(page, "</script") == scripts.size() + 1);
    for (const std::string& script : scripts) {
        CHECK(page.find("'sha256-" + alembert::sha256_base64(script) + "'") != std::string::npos);
        CHECK(count(script, "alert") == 0);
        CHECK(count(script, "eval(") == 0);
        CHECK(count(script, "Function(") == 0);
    }
    CHECK(scripts[0].find("function rhs(t, state, par, rate)") != std::string::npos);
    CHECK(std::all_of(scripts[0].begin(), scripts[0].end(), [](unsigned char c) { return c < 0x80; }));
    CHECK(count(scripts[0], "//") == 0);  // comments hold units, which are texts of the scene
    CHECK(count(page, "<style") == 1);
    CHECK(count(page, "<img") == 0);
    CHECK(count(page, "<b ") == 0);
    CHECK(count(page, "\xE2\x80\xA8") == count(page.substr(0, page.find("id=\"data\"")), "\xE2\x80\xA8"));
    CHECK(data_of(page)["copies"].back().get<std::string>() == contents(hostile));
    CHECK(count(page, "<mrow class=\"wrong\">") == 1);  // the wrong sign of its first claim
    const std::string picture = temporary("figure.svg", "");
    REQUIRE(run({"derive", hostile, "--draw", picture}).exit == 0);
    const std::string svg = contents(picture);
    CHECK(nesting(svg, {}) == "");
    CHECK(count(svg, "<script") == 0);
    CHECK(count(svg, "<title ") == 1);
    for (const std::string& written : {page, svg}) {  // XML has no control characters; one reverses what follows
        CHECK(std::none_of(written.begin(), written.end(),
                           [](unsigned char c) { return c < 0x20 && c != '\n' && c != '\t'; }));
        CHECK(count(written, "\xE2\x80\xAE") == 0);
    }
}

TEST_CASE("page: an input from outside has a slider and stands among the given functions") {
    const std::string scene = temporary("outside.toml", R"toml([parameters]
m = 2
[inputs]
u = { value = 0.4, given = "outside", unit = "N", about = "the drive" }
w = { value = 1, given = "outside" }
[coordinates]
x = 1
[[particle]]
name = "P"
mass = "m"
position = ["x", 0]
[forces]
x = "u - w*x"
)toml");
    const std::string page = page_of(scene, 0);
    CHECK(page.find("the drive") != std::string::npos);
    CHECK(page.find("id=\"live-par-2\"") != std::string::npos);
}

TEST_CASE("page: a scene that cannot be read has a page with the mistake, and the exit code 3") {
    const std::string scene =
        temporary("wrong.toml", "title = \"<script>alert(1)</script>\"\n[coordinates]\nq = \"z<b>\"\n");
    const std::string page = page_of(scene, 3);
    CHECK(nesting(page, html_empty) == "");
    CHECK(count(page, "<script") == 0);
    CHECK(page.find("wrong.toml:3") != std::string::npos);
    CHECK(page.find("role=\"alert\"") != std::string::npos);
}

TEST_CASE("page: a step that fails is replaced by its message, and the rest is complete") {
    // Half of the scene has no inertia, so that its equations can be derived but not run.
    const std::string scene =
        temporary("singular.toml",
                  "[coordinates]\nx = 1\ny = 1\n[parameters]\nm = 1\n[[particle]]\nname = \"P\"\n"
                  "mass = \"m\"\nposition = [\"x + y\", 0]\n");
    const std::string page = page_of(scene);
    CHECK(nesting(page, html_empty) == "");
    CHECK(page.find("class=\"problem\"") != std::string::npos);
    CHECK(count(page, "<section id=\"derivation\"") == 1);
    CHECK(count(page, "<math") > 2);
}

TEST_CASE(
    "page: scenes of energies alone say that they have no figure; contacts are told with their time and place") {
    const std::string plain = page_of(
        temporary("plain.toml",
                  alembert::test::without(
                      alembert::test::contents(source_path("scenes/stability/henon_heiles.toml")), "[[scenery]]")),
        0, {"--duration", "0.5"});
    CHECK(plain.find("The scene gives energies and no geometry") != std::string::npos);
    CHECK(plain.find("<figure class=\"plot\">") != std::string::npos);
    const std::string ball = page_of(source_path("scenes/textbook/bouncing_ball.toml"), 0, {"--duration", "1"});
    const Json happenings = data_of(ball)["happenings"];
    REQUIRE(happenings.size() >= 1);
    CHECK(happenings[0]["text"] == "impact floor");
    CHECK(happenings[0]["t"].get<double>() == doctest::Approx(std::sqrt(2 / 9.81)));
    CHECK(happenings[0]["point"].get<int>() >= 0);
}

TEST_CASE("page: a script's hash is SHA-256 in base 64, and JSON in a script cannot end it") {
    // FIPS 180-4's examples, encoded by RFC 4648.
    CHECK(alembert::sha256_base64("") == "47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=");
    CHECK(alembert::sha256_base64("abc") == "ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=");
    CHECK(alembert::sha256_base64("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "JI1qYdIGOLjlwCaTDD5gOaM85Flk/yFn9uzt1BnbBsE=");
    CHECK(alembert::script_json("</script>\xE2\x80\xA8&") == "\"\\u003c/script\\u003e\\u2028\\u0026\"");
    CHECK(alembert::html("<a href='x'>&\"") == "&lt;a href=&#39;x&#39;&gt;&amp;&quot;");
}

TEST_CASE("page: equilibria with their verdicts and eigenvalues, and a section of Poincare that is asked for") {
    const std::string hoop = source_path("scenes/textbook/rotating_hoop.toml");
    const std::string page = page_of(hoop, 0, {"--duration", "20", "--poincare", "theta = 0"});
    const std::size_t at = page.find("<section id=\"stability\""), end = page.find("</section>", at);
    REQUIRE(at != std::string::npos);
    const std::string section = page.substr(at, end - at);
    // Of four equilibria the lower one is unstable beyond the pitchfork, the two aside are stable, the upper one
    // is not.
    const auto count = [&](const std::string& what) {
        std::size_t found = 0;
        for (std::size_t k = section.find(what); k != std::string::npos; k = section.find(what, k + 1)) ++found;
        return found;
    };
    CHECK(count(">stable</strong>") == 2);
    CHECK(count(">unstable</strong>") == 2);
    CHECK(section.find("Eigenvalues") != std::string::npos);
    CHECK(section.find("acos(") != std::string::npos);
    CHECK(page.find("<section id=\"poincare\"") != std::string::npos);
    CHECK(page.find("<section id=\"bench\"") == std::string::npos);
    const std::string file = temporary("page.html", "");
    const auto refused = run({"report", hoop, "-o", file, "--poincare", "theta"});
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("expected an equation of the state") != std::string::npos);
}

TEST_CASE("page: without --output it is named after the scene, in the current folder") {
    const std::filesystem::path scene = source_path("scenes/textbook/rotating_hoop.toml"),
                                folder = std::filesystem::path(temporary("unused", "")).parent_path();
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder);
    const auto result = run({"report", scene.string(), "--no-motion"});
    std::filesystem::current_path(before);
    CHECK(result.exit == 0);
    CHECK(result.out == "wrote rotating_hoop.html\n");
    CHECK(contents((folder / "rotating_hoop.html").string()).find("<section id=\"figure\"") != std::string::npos);
}

TEST_CASE("simulate: --poincare lists the states at which the motion crosses a section") {
    // x = cos t grows through 0 at t = 3π/2 + 2πk, where x' = 1.
    const std::string scene = temporary("spring.toml", R"toml(
[coordinates]
x = { initial = 1 }
[[particle]]
name = "mass"
mass = 1
position = ["x", 0]
[[spring]]
along = "x"
stiffness = 1
)toml");
    const std::vector<std::string> args{"simulate", scene, "--duration", "12", "--poincare", "2*x = 0"};
    std::vector<std::string> in_json = args;
    in_json.emplace_back("--json");
    const Json section = Json::parse(run(in_json).out)["poincare"];
    CHECK(section["equation"] == "2*x = 0");
    REQUIRE(section["crossings"].size() == 2);
    for (int k = 0; k < 2; ++k) {
        const Json& one = section["crossings"][static_cast<std::size_t>(k)];
        CHECK(one["time"].get<double>() == doctest::Approx((1.5 + 2 * k) * 3.14159265358979).epsilon(1e-8));
        CHECK(one["rates"]["x"].get<double>() == doctest::Approx(1).epsilon(1e-7));
    }
    const auto shown = run(args);
    CHECK(shown.out.find("section of Poincare 2*x = 0, from less to more: 2 crossings") != std::string::npos);
    CHECK(shown.out.find("section_of") == std::string::npos);
    CHECK(run({"simulate", scene, "--poincare", "x"}).exit == 3);
}

TEST_CASE("page: letters of a figure do not cover each other, and lie inside it") {
    struct Letter {
        double x, y, half;
    };
    for (const char* name : {"cart_pole", "planetary_gear", "hoop_pendulum", "coin", "belt_drive", "snakeboard"}) {
        CAPTURE(name);
        const std::string file = temporary("figure.svg", "");
        REQUIRE(
            run({"derive", source_path("scenes/textbook/" + std::string(name) + ".toml"), "--draw", file}).exit ==
            0);
        const std::string svg = contents(file);
        std::vector<Letter> letters;
        for (std::size_t at = svg.find("<text "); at != std::string::npos; at = svg.find("<text ", at + 1)) {
            const std::size_t x = svg.find(" x=\"", at) + 4, y = svg.find(" y=\"", at) + 4,
                              end = svg.find('>', at);
            if (svg.substr(at, end - at).find("visibility=\"hidden\"") != std::string::npos) continue;
            std::string shown;
            const std::size_t stop = svg.find("</text>", end);
            for (std::size_t k = end; k < stop; k = svg.find('>', k + 1))
                shown += svg.substr(k + 1, std::min(svg.find('<', k + 1), stop) - k - 1);
            const auto characters =
                std::count_if(shown.begin(), shown.end(), [](char c) { return (c & 0xc0) != 0x80; });
            letters.push_back(
                {std::stod(svg.substr(x)), std::stod(svg.substr(y)), 3.0 * static_cast<double>(characters)});
        }
        CHECK(letters.size() >= 4);
        for (std::size_t i = 0; i < letters.size(); ++i) {
            CHECK(letters[i].x > 5);
            CHECK(letters[i].y > 8);
            for (std::size_t j = 0; j < i; ++j) {
                const bool covers = std::abs(letters[i].x - letters[j].x) < letters[i].half + letters[j].half &&
                                    std::abs(letters[i].y - letters[j].y) < 9;
                CHECK_FALSE(covers);
            }
        }
    }
}

TEST_CASE("page: numbers along an axis that differ after many digits count from a round number in its name") {
    const std::string page = page_of(temporary("slow.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
x = { initial = 1.5, unit = "m" }
[[particle]]
name = "bead"
mass = 1
position = ["x", "1 + x"]
[simulation]
duration = 1e-3
)toml"));
    const std::size_t plots = page.find("<section id=\"plots\"");
    bool has_base = false;
    for (std::size_t at = page.find("class=\"tick\"", plots); at != std::string::npos;
         at = page.find("class=\"tick\"", at + 1)) {
        const std::size_t begin = page.find('>', at) + 1;
        CHECK(page.find('<', begin) - begin <= 8);
    }
    for (std::size_t at = page.find("class=\"axis-label\"", plots); at != std::string::npos;
         at = page.find("class=\"axis-label\"", at + 1))
        has_base = has_base || page.substr(at, page.find("</text>", at) - at).find(" − ") != std::string::npos;
    CHECK(has_base);
}

TEST_CASE(
    "page: the number along an axis at its base is 0, even where values differ by little more than rounding") {
    for (const double middle : {3.64779682149, 1.1, 2.6}) {
        const std::string plot =
            alembert::page_plot({"Energies", "t", "s", "E", "J"}, {0, 1, 2},
                                {{.name = "E", .y = {middle, middle + 1e-11, middle + 2e-11}}});
        CHECK(plot.find(">0</text>") != plot.rfind(">0</text>"));  // on both axes
        CHECK(plot.find("-16<") == std::string::npos);
    }
}

TEST_CASE("page: a force that acts later is drawn pale until then") {
    const auto pushed = [](const std::string& inputs, const std::string& force) {
        return page_of(
            temporary("pushed.toml", inputs +
                                         "[coordinates]\nx = 0\n[[particle]]\nname = \"block\"\n"
                                         "mass = 1\nposition = [\"x\", 0]\n[[force]]\nat = \"block\"\nvector = [" +
                                         force + ", 0]\n[simulation]\nduration = 2\n"));
    };
    const std::string pale = "class=\"waiting\"";
    CHECK(pushed("[inputs]\nF = \"2*(1 + sign(t - 1))\"\n", "\"F\"").find(pale) != std::string::npos);
    CHECK(pushed("", "3").find(pale) == std::string::npos);
}

TEST_CASE("report: where the motion breaks off the page has what there is, and the exit code is that of the run") {
    const std::string scene = temporary("cliff.toml", R"toml([coordinates]
x = 1
[energy]
kinetic = "x'^2/2"
potential = "-x^4"
)toml"),
                      file = temporary("cliff.html", "");
    const auto broken = run({"report", scene, "-o", file, "--duration", "100"});
    CHECK(broken.exit == 4);
    CHECK(broken.err.find("step size underflow at t = 0.927") != std::string::npos);
    CHECK(contents(file).find("step size underflow at t = 0.927") != std::string::npos);
    CHECK(run({"report", scene, "-o", file, "--duration", "0.5"}).exit == 0);
    const auto run_of = run({"simulate", scene, "--duration", "100"});
    CHECK(run_of.exit == 4);
    const std::size_t last = run_of.out.rfind("the motion broke off: step size underflow at t = 0.927");
    REQUIRE(last != std::string::npos);
    CHECK(run_of.out.find('\n', last) == run_of.out.size() - 1);
}

}  // namespace commands_page
