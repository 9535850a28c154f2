// SPDX-License-Identifier: MIT
#pragma once

/// Scenes whose constraints have several branches, each started on one of them. Their claims hold on the branch of
/// the start; most fail on another.

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace alembert::test {

struct BranchScene {
    std::string name, text;
    Scene scene() const { return parse_scene(text, name + ".toml"); }
};

inline std::string claims_of(const std::vector<std::string>& equations) {
    std::string text;
    for (const std::string& equation : equations) text += "[[claim]]\nequation = \"" + equation + "\"\n";
    return text;
}

/// sin a + sin(a + b) = 0: b = π, or b = −2a.
inline BranchScene straight_angle(const std::string& b, const std::vector<std::string>& claims) {
    return {"straight_angle",
            "[coordinates]\na = { initial = 0.3, rate = 1 }\nb = { initial = \"" + b +
                "\", rate_guess = 0 }\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"cos(a)\", \"b\"]\n"
                "[[constraint]]\nname = \"z\"\nholonomic = \"sin(a) + sin(a+b) = 0\"\n" +
                claims_of(claims)};
}

/// Two cranks L and a coupler b between bearings that are b apart: a parallelogram, or crossed.
inline BranchScene parallelogram(const std::string& q2, const std::string& q3,
                                 const std::vector<std::string>& claims) {
    return {"parallelogram",
            "[parameters]\nL = 0.5\nb = 0.8\nm = 1\n[coordinates]\nq1 = { initial = 0.3, rate = 0.7 }\nq2 = { "
            "guess = " +
                q2 + ", rate_guess = 0 }\nq3 = { guess = " + q3 + R"toml(, rate_guess = 0 }
[[particle]]
name = "P"
mass = "m"
position = ["L*sin(q1)", "-L*cos(q1)"]
[[particle]]
name = "Q"
mass = "2*m"
position = ["b+L*sin(q2)", "-L*cos(q2)"]
[[constraint]]
name = "x"
holonomic = "L*sin(q1) + b*cos(q3) - L*sin(q2) - b"
[[constraint]]
name = "y"
holonomic = "-L*cos(q1) + b*sin(q3) + L*cos(q2)"
)toml" + claims_of(claims)};
}

/// A particle on one of the two walls x² = l².
inline BranchScene walls(const std::string& x, const std::vector<std::string>& claims) {
    return {"walls", "[parameters]\nm = 1\nl = 2\n[coordinates]\nx = { initial = " + x +
                         ", rate = 0 }\ny = { initial = 1, rate = 0.5 }\n[energy]\nkinetic = \"m*(x'^2+y'^2)/2\"\n"
                         "potential = \"m*y^2\"\n[[constraint]]\nname = \"wall\"\nholonomic = \"x^2 - l^2\"\n" +
                         claims_of(claims)};
}

/// Two sliders on the same irrational slopes, x² = 2 y² and z² = 2 y²: x = z, or x = −z.
inline BranchScene two_legs(const std::string& z, const std::vector<std::string>& claims) {
    return {"two_legs",
            "[parameters]\nm = 1\n[coordinates]\ny = { initial = 1, rate = 0.5 }\nx = { guess = 1.4, rate_guess = "
            "0 }\nz = { guess = " +
                z +
                ", rate_guess = 0 }\n[energy]\nkinetic = \"m*(x'^2+y'^2+3*z'^2)/2\"\npotential = \"m*y\"\n"
                "[[constraint]]\nname = \"one\"\nholonomic = \"x^2 - 2*y^2\"\n[[constraint]]\nname = \"other\"\n"
                "holonomic = \"z^2 - 2*y^2\"\n" +
                claims_of(claims)};
}

/// A slider-crank of joints whose rod is as long as the crank: with the rod folded back on the crank the slider
/// stands still, otherwise it is at x = 2 r cos φ.
inline BranchScene folded_slider_crank(bool folded, const std::vector<std::string>& claims) {
    return {"folded_slider_crank",
            std::string(R"(gravity = [0, "-g"]
[parameters]
r = 0.2
m1 = 0.4
m2 = 0.2
m3 = 0.8
g = 9.81
[[body]]
name = "crank"
mass = "m1"
inertia = "m1*r^2/12"
[[body]]
name = "rod"
mass = "m2"
inertia = "m2*r^2/12"
[[body]]
name = "slider"
mass = "m3"
[[joint]]
name = "shaft"
type = "revolute"
parent = "N"
child = "crank"
child_point = ["-r/2", 0]
coordinates = { phi = { initial = 0.6, rate = 2 } }
[[joint]]
name = "pin"
type = "revolute"
parent = "crank"
child = "rod"
parent_point = ["r/2", 0]
child_point = ["-r/2", 0]
coordinates = { psi = { guess = )") +
                (folded ? "3.1" : "-1.2") +
                ", rate_guess = 0 } }\n[[joint]]\nname = \"guide\"\ntype = \"prismatic\"\nparent = \"N\"\n"
                "child = \"slider\"\naxis = \"x\"\ncoordinates = { x = { guess = " +
                (folded ? "0.01" : "0.33") +
                ", rate_guess = 0 } }\n[[joint]]\nname = \"piston_pin\"\ntype = \"revolute\"\n"
                "parent = \"rod\"\nchild = \"slider\"\nparent_point = [\"r/2\", 0]\n" +
                claims_of(claims)};
}

/// A slider-crank in θ and x, which starts at rest; its velocity holds a root.
inline BranchScene with_root(const std::string& x, const std::vector<std::string>& claims) {
    return {
        "with_root",
        "[parameters]\nr = 1\nl = 3\nm = 1\n[coordinates]\ntheta = { initial = 0.3, rate = 0 }\nx = { guess = " +
            x +
            ", rate_guess = 0 }\n[energy]\nkinetic = \"m*(x'^2 + theta'^2)/2\"\n[[constraint]]\nname = \"rod\"\n"
            "holonomic = \"(x - r*cos(theta))^2 + r^2*sin(theta)^2 = l^2\"\n" +
            claims_of(claims)};
}

/// One of each kind, with claims that hold.
inline std::vector<BranchScene> branch_scenes() {
    return {
        straight_angle("pi", {"b' = 0", "sin(a)^2*a'' + sin(a)*cos(a)*a'^2 = 0", "lambda_z*cos(a) = 0"}),
        straight_angle("-0.6", {"b' = -2*a'", "b'' + 2*a'' = 0"}),
        parallelogram("0.3", "0", {"q3' = 0", "q1' = q2'", "q1'' - q2'' = 0", "sin(q3) = 0"}),
        parallelogram("-2.1776", "1.2643", {}),
        walls("2", {"x = l", "x' = 0", "2*m*l*lambda_wall = 0"}),
        walls("-2", {"x = -l", "m*y'' + 2*m*y = 0"}),
        two_legs("1.4", {"x = z", "x' - z' = 0", "9*m*y'' + m = 0"}),
        two_legs("-1.4", {"x + z = 0", "x'' = -z''"}),
        folded_slider_crank(true, {"x = 0", "psi' = 0", "x'' = 0"}),
        folded_slider_crank(false, {"x = 2*r*cos(phi)", "x' = -2*r*sin(phi)*phi'", "psi' = -2*phi'"}),
        with_root("3.9",
                  {"x = r*cos(theta) + sqrt(l^2 - r^2*sin(theta)^2)",
                   "x' = -r*sin(theta)*theta' - r^2*sin(theta)*cos(theta)*theta'/sqrt(l^2 - r^2*sin(theta)^2)"}),
        with_root("-2", {"x = r*cos(theta) - sqrt(l^2 - r^2*sin(theta)^2)"})};
}

}  // namespace alembert::test
