// SPDX-License-Identifier: MIT
#include "random_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <vector>

namespace alembert::test {

namespace {

class Composition {
public:
    explicit Composition(unsigned seed) : random_(seed) {}

    std::string text() {
        const int n = 1 + one_of(3);
        const std::vector<std::string> names{"x", "y", "phi"};
        q_.assign(names.begin(), names.begin() + n);
        std::shuffle(q_.begin(), q_.end(), random_);
        std::string scene = "title = \"random\"\n";
        const bool has_particles = one_of(3) > 0;
        if (has_particles && often())
            scene += pick({"gravity = [0, \"-g\"]\n", "gravity = [\"g\", 0]\n", "gravity = [0, 9.81]\n"});
        scene += "[parameters]\nm = 2\nM = 3\nJ = 1.5\nk = 40\nc = 0.3\nl = 1.25\np = 0.7\ns = 0.4\ng = 9.81\n";
        has_input_ = one_of(4) == 0;
        if (has_input_) scene += "[inputs]\nF = \"" + pick({"p*sin(3*t)", "p", "k*t - p"}) + "\"\n";
        scene += "[coordinates]\n";
        for (const std::string& q : q_)
            scene += fmt::format("{} = {{ guess = 0.{}, rate_guess = 0.{} }}\n", q, 2 + one_of(7), 1 + one_of(8));
        const bool is_constrained = n > 1 && one_of(4) == 0;
        if (!is_constrained && one_of(6) == 0) scene += speeds();
        scene += has_particles ? particles() : "";
        scene += energy(!has_particles);
        if (often()) scene += "[forces]\n" + q() + " = \"" + load() + "\"\n";
        if (has_particles && one_of(5) == 0)
            scene += "[dissipation]\nrayleigh = \"c*(" + difference("'") + ")^2/2\"\n";
        if (is_constrained) scene += constraint();
        if (one_of(8) == 0)
            scene += "[[unilateral]]\nname = \"stop\"\ngap = \"" + pick({"l - ", "s + ", "2 - "}) + q() + "\"\n";
        if (one_of(4) == 0) scene += "[outputs]\nwork = \"" + load() + "\"\nplain = \"" + parameter() + "\"\n";
        if (one_of(8) == 0) scene += "[[event]]\nname = \"zero\"\nwhen = \"" + q() + " - " + parameter() + "\"\n";
        return scene;
    }

private:
    int one_of(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    bool often() { return one_of(2) == 0; }
    std::string pick(const std::vector<std::string>& list) {
        return list[static_cast<std::size_t>(one_of(static_cast<int>(list.size())))];
    }
    std::string q() { return pick(q_); }
    std::string parameter() { return pick({"p", "s", "l", "k", "g", "m"}); }
    std::string signed_parameter() { return (often() ? "-" : "") + parameter(); }

    /// "x - y", "y + x"; with ' of the rates.
    std::string difference(const std::string& prime) {
        const std::string a = q(), b = q();
        return a == b ? a + prime : fmt::format("{}{} {} {}{}", a, prime, often() ? "-" : "+", b, prime);
    }

    std::string load() {
        switch (one_of(has_input_ ? 9 : 8)) {
            case 0:
            case 1:
                return signed_parameter();
            case 2:
                return "-k*(" + difference("") + ")";
            case 3:
                return "-c*" + q() + "'";
            case 4:
                return parameter() + "*cos(" + q() + ") - " + parameter();
            case 5:
                return fmt::format("max({}, {}) - abs({})", q(), signed_parameter(), q());
            case 6:
                return fmt::format("{}*sqrt({} + {}^2)", signed_parameter(), parameter(), q());
            case 7:
                return fmt::format("{}*{}' - {}", signed_parameter(), q(), parameter());
            default:
                return often() ? "F" : "-F";
        }
    }

    /// Along x; every coordinate moves one of the particles alone or with others.
    std::string place(const std::string& q) {
        if (q == "phi")
            return pick({"[\"l*sin(phi)\", \"-l*cos(phi)\"]", "[\"s + l*cos(phi)\", \"l*sin(phi)\"]",
                         "[\"p*phi\", \"s\"]"});
        return pick({"[\"" + q + "\", 0]", "[0, \"" + q + " - s\"]", "[\"" + q + " - p\", \"s\"]",
                     "[\"" + difference("") + "\", \"" + q + "\"]"});
    }

    std::string particles() {
        std::string text;
        for (std::size_t i = 0; i < q_.size(); ++i)
            text += fmt::format("[[particle]]\nname = \"P{}\"\nmass = {}\nposition = {}\n", i,
                                pick({"\"m\"", "\"M\"", "\"m + M\"", "1", "\"p\""}), place(q_[i]));
        const std::string last = fmt::format("P{}", one_of(static_cast<int>(q_.size())));
        for (int k = one_of(3); k > 0; --k) {
            text +=
                "[[force]]\nat = \"P0\"\nvector = [\"" + load() + "\", " + pick({"0", "\"-p\"", "\"s\""}) + "]\n";
            if (last != "P0" && often()) text += "reaction = \"" + last + "\"\n";
        }
        if (one_of(3) == 0)
            text += "[[spring]]\nalong = \"" + difference("") + "\"\nstiffness = \"k\"\nlength = \"" +
                    pick({"l", "s"}) + "\"\n";
        if (one_of(3) == 0 && last != "P0")
            text += "[[spring]]\nbetween = [\"P0\", \"" + last + "\"]\nstiffness = \"k\"\nlength = \"l\"\n";
        if (one_of(4) == 0) text += "[[damper]]\nalong = \"" + q() + "\"\ndamping = \"c\"\n";
        return text;
    }

    std::string energy(bool has_kinetic) {
        std::string text = "[energy]\n", kinetic;
        if (has_kinetic) {
            for (const std::string& q : q_)
                kinetic += (kinetic.empty() ? "" : " + ") + pick({"J", "m", "1", "p"}) + "*" + q + "'^2/2";
            for (int k = one_of(3); k > 0; --k)
                kinetic += " + " + pick({"M", "J", "s", "l^2"}) + "*(" + difference("'") + ")^2/2";
            text += "kinetic = \"" + kinetic + "\"\n";
        }
        const std::string a = q();
        return text + "potential = \"" +
               pick({"p*" + a, "-p*" + a + " + k*(" + difference("") + ")^2/2", "s*cos(" + a + ")",
                     "k*" + a + "^2/2 - g*" + a, "0"}) +
               "\"\n";
    }

    std::string constraint() {
        const std::string a = q_[0], b = q_[1];
        return "[[constraint]]\nname = \"row\"\n" +
               pick({fmt::format("holonomic = \"{} - {} - s\"\n", a, b),
                     fmt::format("holonomic = \"{} - p*{}\"\n", a, b),
                     fmt::format("holonomic = \"{}^2 + {}^2 - l^2\"\n", a, b),
                     fmt::format("nonholonomic = \"{}' - s*{}'\"\n", a, b),
                     fmt::format("nonholonomic = \"{0}'*sin({1}) - {1}'*s\"\n", a, b),
                     fmt::format("nonholonomic = \"{}' + {}' - p\"\n", a, b)});
    }

    std::string speeds() {
        std::string text = "[speeds]\n";
        for (std::size_t i = 0; i < q_.size(); ++i)
            text += fmt::format("u{} = \"{}{}'{}\"\n", i, pick({"", "2*", "p*"}), q_[i],
                                i > 0 ? pick({"", " + " + q_[0] + "'", " - s*" + q_[0] + "'"}) : "");
        return text;
    }

    std::mt19937 random_;
    std::vector<std::string> q_;
    bool has_input_ = false;
};

}  // namespace

std::string random_scene(unsigned seed) {
    return Composition(seed).text();
}

}  // namespace alembert::test
