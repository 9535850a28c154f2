// SPDX-License-Identifier: MIT
// Wrong claims as people write them: one slip in a textbook equation. What was written rightly before the slip is
// known, so that the words for it are known, too. The correct equation is judged by a check of its own.
#include <doctest/doctest.h>

#include <sstream>

#include "check/check.hpp"
#include "checked.hpp"
#include "scene/claims_file.hpp"
#include "scenes.hpp"

namespace check_named_slips {

using namespace alembert;
using namespace alembert::test;

const char* const pendulum = R"---(title = "Pendulum"
gravity = [0, "-g"]
[parameters]
m = { value = 1.0, unit = "kg" }
l = { value = 1.0, unit = "m" }
g = { value = 9.81, unit = "m/s^2" }
[coordinates]
theta = { initial = 0.5, unit = "rad" }
[[particle]]
name = "bob"
mass = "m"
position = ["l*sin(theta)", "-l*cos(theta)"]
)---";

const char* const satellite = R"---(title = "Satellite of an oblate planet"
[parameters]
m = { value = 1.0, unit = "kg" }
mu = { value = 1.0, unit = "m^3/s^2" }
J2 = { value = 0.01 }
R = { value = 1.0, unit = "m" }
[coordinates]
r = { initial = 1.5, rate = 0.1, unit = "m" }
beta = { initial = 0.3, rate = 0.2, unit = "rad" }
phi = { initial = 0, rate = 0.5, unit = "rad" }
[[particle]]
name = "satellite"
mass = "m"
position = ["r*cos(beta)*cos(phi)", "r*cos(beta)*sin(phi)", "r*sin(beta)"]
[energy]
potential = "-mu*m/r*(1 - J2*(R/r)^2*(3*sin(beta)^2 - 1)/2)"
)---";

/// scene | claims | the slip in the last of them
const char* const slips = R"---(pendulum | l*theta'' - g*sin(theta) = 0 | the sign of g*sin(theta)
free_body | I1*w1' = 0 | a missing term -(I2-I3)*w2*w3
pendulum | m*l^2*theta'' + m*g*l*cos(theta) = 0 | cos for sin in m*g*l*cos(theta)
pendulum | m*l^2*theta'' + m*g*sin(theta) = 0 | a missing factor l on m*g*sin(theta)
pendulum | m*l*theta'' + m*g*l*sin(theta) = 0 | a wrong power in m*l*theta'': l for l^2
pendulum | constants E; m*l^2*theta'^2 - m*g*l*cos(theta) = E | a factor 2 on m*l^2*theta'^2
pendulum | constants E; m*l^2*theta'^2/2 + m*g*l*cos(theta) = E | the sign of m*g*l*cos(theta)
pendulum | p_theta = m*l*theta' | a wrong power in m*l*theta': l for l^2
pendulum | (l*theta'^2 - g*cos(theta))' = 0 | a missing factor 2 on g*cos(theta)
cart_pole | (M+m)*x'' + m*l*theta''*cos(theta) + m*l*theta'^2*sin(theta) = F - b*x' | the sign of m*l*theta'^2*sin(theta)
cart_pole | (M+m)*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta) = F | a missing term b*x'
cart_pole | M*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta) = F - b*x' | a missing term m in M*x''
cart_pole | (M+m)*x'' + m*l*theta''*sin(theta) - m*l*theta'^2*sin(theta) = F - b*x' | sin for cos in m*l*theta''*sin(theta)
cart_pole | (M+m)*x'' + m*l*theta''*cos(theta) - m*l*theta'*sin(theta) = F - b*x' | a wrong power in m*l*theta'*sin(theta): theta' for theta'^2
cart_pole | (M+m)*x'' + m*l*theta''*cos(theta) - m*l^2*theta'^2*sin(theta) = F - b*x' | a wrong power in m*l^2*theta'^2*sin(theta): l^2 for l
cart_pole | (M+m)*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta) = -b*x' | a missing term F
cart_pole | l*theta'' + x'' - g*sin(theta) = 0 | a missing factor cos(theta) on x''
cart_pole | p_x = M*x' + m*l*theta'*cos(theta) | a missing term m in M*x'
cart_pole | p_theta = m*l^2*theta' | a missing term m*l*x'*cos(theta)
cart_pole | p_theta = m*l^2*theta' + 2*m*l*x'*cos(theta) | a factor 2 on 2*m*l*x'*cos(theta)
double_pendulum | (m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) - m2*l2*theta2'^2*sin(theta1-theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta1) | the sign of m2*l2*theta2'^2*sin(theta1-theta2)
double_pendulum | (m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + m1*g*sin(theta1) = F*cos(theta1) | a missing term m2 in m1*g*sin(theta1)
double_pendulum | (m1+m2)*l1*theta1'' + m2*l1*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta1) | l1 for l2 in m2*l1*theta2''*cos(theta1-theta2)
double_pendulum | m2*l1*theta1''*cos(theta1-theta2) + m2*l2*theta2'' - m2*l1*theta1'^2*sin(theta1-theta2) + m2*g*sin(theta1) = F*cos(theta2) | sin(theta1) for sin(theta2) in m2*g*sin(theta1)
double_pendulum | m2*l1*theta1''*cos(theta1-theta2) + m2*l2*theta2'' - m2*l1*theta1'*theta2'*sin(theta1-theta2) + m2*g*sin(theta2) = F*cos(theta2) | theta2' for theta1' in m2*l1*theta1'*theta2'*sin(theta1-theta2)
double_pendulum | l1*theta1''*cos(theta1-theta2) + l2*theta2'' - l1*theta1'^2*sin(theta1-theta2) + g*sin(theta2) = F*cos(theta2) | a missing factor 1/m2 on F*cos(theta2)
double_pendulum | p_theta2 = m2*l2^2*theta2' + m2*l1*l2*theta1' | a missing factor cos(theta1-theta2) on m2*l1*l2*theta1'
double_pendulum | p_theta1 = (m1+m2)*l1^2*theta1' + m2*l1*l2*theta2'*sin(theta1-theta2) | sin for cos in m2*l1*l2*theta2'*sin(theta1-theta2)
rotating_hoop | R*theta'' - R*Omega^2*sin(theta) + g*sin(theta) = 0 | a missing factor cos(theta) on R*Omega^2*sin(theta)
rotating_hoop | R*theta'' - R*Omega*sin(theta)*cos(theta) + g*sin(theta) = 0 | a wrong power in R*Omega*sin(theta)*cos(theta): Omega for Omega^2
rotating_hoop | R*theta'' + R*Omega^2*sin(theta)*cos(theta) + g*sin(theta) = 0 | the sign of R*Omega^2*sin(theta)*cos(theta)
rotating_hoop | R*theta'' + g*sin(theta) = 0 | a missing term -R*Omega^2*sin(theta)*cos(theta)
rotating_hoop | (R*theta'^2 + R*Omega^2*sin(theta)^2 - 2*g*cos(theta))' = 0 | the sign of R*Omega^2*sin(theta)^2
rotating_hoop | rest; sin(theta)*(R*Omega*cos(theta) - g) = 0 | a wrong power in R*Omega*cos(theta): Omega for Omega^2
spherical_pendulum | l*theta'' - l*phi'^2*sin(theta) + g*sin(theta) = 0 | a missing factor cos(theta) on l*phi'^2*sin(theta)
spherical_pendulum | l*theta'' - l*phi'^2*sin(theta)*cos(theta) - g*sin(theta) = 0 | the sign of g*sin(theta)
spherical_pendulum | phi''*sin(theta) + phi'*theta'*cos(theta) = 0 | a missing factor 2 on phi'*theta'*cos(theta)
spherical_pendulum | phi''*sin(theta)^2 + 2*phi'*theta'*cos(theta) = 0 | a missing factor sin(theta) on 2*phi'*theta'*cos(theta)
spherical_pendulum | p_phi = m*l^2*phi'*sin(theta) | a missing factor sin(theta) on m*l^2*phi'*sin(theta)
spherical_pendulum | p_phi = m*l^2*phi' | a missing factor sin(theta)^2 on m*l^2*phi'
spherical_pendulum | constants E; m*l^2*(theta'^2 + phi'^2*sin(theta))/2 - m*g*l*cos(theta) = E | a missing factor sin(theta) on phi'^2*sin(theta)
spherical_pendulum | constants h; l^2*phi'*cos(theta)^2 = h | cos for sin in l^2*phi'*cos(theta)^2
swinging_atwood | m*r'' - m*r*theta'^2 + M*g - m*g*cos(theta) = 0 | a missing term M in m*r''
swinging_atwood | (m+M)*r'' + m*r*theta'^2 + M*g - m*g*cos(theta) = 0 | the sign of m*r*theta'^2
swinging_atwood | r*theta'' + g*sin(theta) = 0 | a missing term 2*r'*theta'
swinging_atwood | r*theta'' + r'*theta' + g*sin(theta) = 0 | a missing factor 2 on r'*theta'
swinging_atwood | (m+M)*r'' - m*r*theta'^2 + M*g - m*g = 0 | a missing factor cos(theta) on m*g
swinging_atwood | (m+M)*r'' - m*r*theta'^2 + M*g - M*g*cos(theta) = 0 | M for m in M*g*cos(theta)
elastic_pendulum | m*r'' - m*r*theta'^2 - m*g*cos(theta) + k*r = 0 | a missing term -k*l0
elastic_pendulum | m*r'' - m*g*cos(theta) + k*(r - l0) = 0 | a missing term -m*r*theta'^2
elastic_pendulum | m*r'' - m*r*theta'^2 - m*g*cos(theta) - k*(r - l0) = 0 | the sign of k*(r - l0)
elastic_pendulum | r*theta'' + 2*r'*theta' + g*cos(theta) = 0 | cos for sin in g*cos(theta)
elastic_pendulum | constants E; m*r'^2/2 + m*r^2*theta'^2/2 - m*g*r*cos(theta) + k*(r - l0)^2 = E | a factor 2 on k*(r - l0)^2
cylinder_on_wedge | m*r*phi'' = -F | a missing factor 2 on F
cylinder_on_wedge | 2*m*r/5*phi'' = -F | 2*m*r/5*phi'', which should be m*r/2*phi''
cylinder_on_wedge | m*s'' = m*g*sin(alpha) + F | a missing term m*X''*cos(alpha)
cylinder_on_wedge | m*s'' + m*X''*cos(alpha) = m*g*cos(alpha) + F | cos for sin in m*g*cos(alpha)
cylinder_on_wedge | M*X'' + m*s''*cos(alpha) = 0 | a missing term m in M*X''
cylinder_on_wedge | s'' = 2*(M+m)*g*sin(alpha)/(3*M + m + m*sin(alpha)^2) | a missing factor 2 on m*sin(alpha)^2
satellite | r'' - r*beta'^2 - r*phi'^2*cos(beta)^2 = -mu/r^2 | a missing term -9*J2*mu*R^2*cos(beta)^2/(2*r^4)+3*J2*mu*R^2/r^4
satellite | r'' - r*beta'^2 - r*phi'^2*cos(beta)^2 = -mu/r^2 - mu*J2*R^2*(3*sin(beta)^2 - 1)/(2*r^4) | mu*J2*R^2*(3*sin(beta)^2 - 1)/(2*r^4), which should be 3*mu*J2*R^2*(3*sin(beta)^2-1)/(2*r^4)
satellite | r'' - r*beta'^2 - r*phi'^2*cos(beta)^2 = -mu/r^2 + 3*mu*J2*R^2*(1 - 3*sin(beta)^2)/(2*r^4) | the sign of 3*mu*J2*R^2*(1 - 3*sin(beta)^2)/(2*r^4)
satellite | r'' - r*beta'^2 - r*phi'^2*cos(beta) = -mu/r^2 + 3*mu*J2*R^2*(3*sin(beta)^2 - 1)/(2*r^4) | a missing factor cos(beta) on r*phi'^2*cos(beta)
satellite | p_phi = m*r^2*phi'*cos(beta) | a missing factor cos(beta) on m*r^2*phi'*cos(beta)
satellite | (r^2*beta')' = -r^2*phi'^2*sin(beta)*cos(beta) - 3*mu*R^2*sin(beta)*cos(beta)/r^3 | a missing factor J2 on 3*mu*R^2*sin(beta)*cos(beta)/r^3
satellite | (r^2*beta')' = -r^2*phi'^2*sin(beta)*cos(beta) | a missing term -3*J2*mu*R^2*sin(beta)*cos(beta)/r^3
satellite | constants E; m*(r'^2 + r^2*beta'^2 + r^2*phi'^2)/2 - mu*m/r*(1 - J2*(R/r)^2*(3*sin(beta)^2 - 1)/2) = E | a missing factor cos(beta)^2 on r^2*phi'^2
heavy_top | p_psi = C*psi' | a missing term phi'*cos(theta) in C*psi'
heavy_top | p_phi = A*phi'*sin(theta)^2 + C*(psi' + phi'*cos(theta)) | a missing factor cos(theta) on C*(psi' + phi'*cos(theta))
heavy_top | A*theta'' = A*phi'^2*sin(theta)*cos(theta) - C*(psi' + phi'*cos(theta))*phi'*sin(theta) - m*g*l*sin(theta) | the sign of m*g*l*sin(theta)
cylinder_in_cylinder | 2*(R-a)*phi'' + 2*g*sin(phi) = 0 | 2*(R-a)*phi'', which should be 3*(R-a)*phi''
cylinder_in_cylinder | 3*(R+a)*phi'' + 2*g*sin(phi) = 0 | the sign of a
cylinder_in_cylinder | 7/5*(R-a)*phi'' + g*sin(phi) = 0 | 7/5*(R-a)*phi'', which should be 3/2*(R-a)*phi''
cylinder_in_cylinder | F = 2*m*g*sin(phi)/3 | a factor 2 on 2*m*g*sin(phi)/3
central_force | m*r'' - m*r*phi'^2 + k/r = 0 | a wrong power in k/r: r for r^2
central_force | m*r'' - m*r^2*phi'^2 + k/r^2 = 0 | a wrong power in m*r^2*phi'^2: r^2 for r
central_force | m*r'' - m*r*phi'^2 - k/r^2 = 0 | the sign of k/r^2
central_force | r*phi'' + r'*phi' = 0 | a missing factor 2 on r'*phi'
central_force | constants h; r*phi' = h | a wrong power in r*phi': r for r^2
central_force | constants E; m*(r'^2 + r*phi'^2)/2 - k/r = E | a wrong power in r*phi'^2: r for r^2
central_force | (m*(r'^2 + r^2*phi'^2)/2 + k/r)' = 0 | the sign of k/r
double_atwood | (m1+m2+m3)*x'' - (m2-m3)*y'' = (m1-m2+m3)*g | the sign of m3
double_atwood | (m1+m2)*x'' - (m2-m3)*y'' = (m1-m2-m3)*g | a missing term m3 in (m1+m2)*x''
double_atwood | x'' = (m1*(m2+m3) - 4*m2*m3)*g/(m1*(m2+m3) + 2*m2*m3) | a missing factor 2 on 2*m2*m3
foucault_pendulum | x'' + g/l*x = 2*Omega*cos(lat)*y' | cos for sin in 2*Omega*cos(lat)*y'
foucault_pendulum | y'' + g/l*y = 2*Omega*sin(lat)*x' | the sign of 2*Omega*sin(lat)*x'
foucault_pendulum | x'' + g/l*x = Omega*sin(lat)*y' | a missing factor 2 on Omega*sin(lat)*y'
)---";

Scene scene_named(const std::string& name) {
    if (name == "pendulum") return parse_scene(pendulum, "pendulum.toml");
    if (name == "satellite") return parse_scene(satellite, "satellite.toml");
    return read_scene(source_path("scenes/textbook/" + name + ".toml"));
}

std::vector<std::string> split(const std::string& text, const std::string& by) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find(by, begin)) != std::string::npos; begin = end + by.size())
        parts.push_back(text.substr(begin, end - begin));
    parts.push_back(text.substr(begin));
    return parts;
}

TEST_CASE("check: a slip in a textbook equation is named, and the correct equation is proved") {
    std::istringstream lines(slips);
    int count = 0;
    for (std::string line; std::getline(lines, line);) {
        const std::vector<std::string> row = split(line, " | ");
        CAPTURE(line);
        REQUIRE(row.size() == 3);
        const Scene scene = scene_named(row[0]);
        std::vector<std::string> claims = split(row[1], "; ");
        const auto judged = [&] {
            std::string text;
            for (const std::string& claim : claims) text += claim + "\n";
            return checked(with_claims(scene, text, "claims.txt")).claims.back();
        };
        const CheckedClaim wrong = judged();
        REQUIRE(wrong.verdict == Verdict::refuted);
        REQUIRE(wrong.likely);
        CHECK(words_of(*wrong.likely) == row[2]);
        CHECK(wrong.nearest == wrong.likely->repair);
        claims.back() = wrong.nearest;
        CHECK(judged().verdict == Verdict::proved);
        ++count;
    }
    CHECK(count >= 80);
}

TEST_CASE("check: the power of a tangent that stands in a term is a slip that is named") {
    const Scene cone = parse_scene(R"toml(
[parameters]
m = 0.1
g = 9.81
alpha = 0.5
[coordinates]
z = 0.4
phi = { initial = 0, rate = 8 }
[energy]
kinetic = "m*(1 + tan(alpha)^2)*z'^2/2 + m*z^2*tan(alpha)^2*phi'^2/2"
potential = "m*g*z"
)toml",
                                   "cone.toml");
    for (const auto& [claim, words] :
         {std::pair("p_phi = m*z^2*tan(alpha)*phi'", "a missing factor tan(alpha) on m*z^2*tan(alpha)*phi'"),
          std::pair("p_z = m*(1 + tan(alpha))*z'", "a missing factor tan(alpha) on tan(alpha)")}) {
        CAPTURE(claim);
        const CheckedClaim wrong = checked(with_claims(cone, claim, "claims.txt")).claims[0];
        REQUIRE(wrong.verdict == Verdict::refuted);
        REQUIRE(wrong.likely);
        CHECK(words_of(*wrong.likely) == words);
        CHECK(checked(with_claims(cone, wrong.likely->repair, "claims.txt")).claims[0].verdict == Verdict::proved);
    }
}

}  // namespace check_named_slips
