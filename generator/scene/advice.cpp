// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/advice.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "base/language/greek.hpp"
#include "base/language/say.hpp"
#include "scene/functions.hpp"
#include "scene/keys.hpp"

namespace alembert {

namespace {

struct Meaning {
    std::string_view typed, meant;
};

template <std::size_t count>
std::string_view found_in(const Meaning (&table)[count], std::string_view word) {
    const auto found =
        std::find_if(std::begin(table), std::end(table), [&](const Meaning& m) { return m.typed == word; });
    return found == std::end(table) ? std::string_view() : found->meant;
}

constexpr Meaning typed_functions[] = {
    {"ln", "log"},    {"arcsin", "asin"},   {"arccos", "acos"}, {"arctan", "atan"}, {"arctg", "atan"},
    {"tg", "tan"},    {"arctan2", "atan2"}, {"sgn", "sign"},    {"signum", "sign"}, {"fabs", "abs"},
    {"asen", "asin"}, {"sen", "sin"},       {"sh", "sinh"},     {"ch", "cosh"},     {"th", "tanh"}};

/// Functions that the language does not have, by what gives their value.
constexpr Meaning instead_of_functions[] = {{"cot", "1/tan(x)"},
                                            {"ctg", "1/tan(x)"},
                                            {"cotan", "1/tan(x)"},
                                            {"sec", "1/cos(x)"},
                                            {"csc", "1/sin(x)"},
                                            {"pow", "x^n"},
                                            {"power", "x^n"},
                                            {"square", "x^2"},
                                            {"sq", "x^2"},
                                            {"cube", "x^3"},
                                            {"cbrt", "x^(1/3)"},
                                            {"root", "x^(1/n)"},
                                            {"hypot", "sqrt(x^2 + y^2)"},
                                            {"log10", "log(x)/log(10)"},
                                            {"lg", "log(x)/log(10)"},
                                            {"log2", "log(x)/log(2)"},
                                            {"coth", "1/tanh(x)"},
                                            {"asinh", "log(x + sqrt(x^2 + 1))"},
                                            {"arcsinh", "log(x + sqrt(x^2 + 1))"},
                                            {"acosh", "log(x + sqrt(x^2 - 1))"},
                                            {"arsinh", "log(x + sqrt(x^2 + 1))"},
                                            {"arcosh", "log(x + sqrt(x^2 - 1))"},
                                            {"arccosh", "log(x + sqrt(x^2 - 1))"},
                                            {"artanh", "log((1 + x)/(1 - x))/2"},
                                            {"arctanh", "log((1 + x)/(1 - x))/2"},
                                            {"atanh", "log((1 + x)/(1 - x))/2"},
                                            {"heaviside", "(1 + sign(x))/2"},
                                            {"step", "(1 + sign(x))/2"},
                                            {"sind", "sin(x*pi/180)"},
                                            {"cosd", "cos(x*pi/180)"},
                                            {"tand", "tan(x*pi/180)"},
                                            {"radians", "30 deg"},
                                            {"deg2rad", "30 deg"},
                                            {"rad2deg", "x*180/pi"},
                                            {"degrees", "x*180/pi"},
                                            {"sinc", "sin(x)/x"},
                                            {"versin", "1 - cos(x)"}};

constexpr Meaning typed_names[] = {
    {"e", "exp(1)"}, {"E", "exp(1)"}, {"Math_PI", "pi"}, {"M_PI", "pi"}, {"time", "t"}};

constexpr Meaning typed_tables[] = {{"bodies", "body"},
                                    {"rigidbody", "body"},
                                    {"rigidbodies", "body"},
                                    {"link", "body"},
                                    {"links", "body"},
                                    {"particles", "particle"},
                                    {"mass", "particle"},
                                    {"masses", "particle"},
                                    {"pointmass", "particle"},
                                    {"pointmasses", "particle"},
                                    {"points", "point"},
                                    {"frames", "frame"},
                                    {"joints", "joint"},
                                    {"hinge", "joint"},
                                    {"hinges", "joint"},
                                    {"pin", "joint"},
                                    {"torques", "torque"},
                                    {"moment", "torque"},
                                    {"moments", "torque"},
                                    {"loads", "force"},
                                    {"load", "force"},
                                    {"springs", "spring"},
                                    {"dampers", "damper"},
                                    {"damping", "damper"},
                                    {"dashpot", "damper"},
                                    {"constraints", "constraint"},
                                    {"rollings", "rolling"},
                                    {"contact", "unilateral"},
                                    {"contacts", "unilateral"},
                                    {"frictions", "friction"},
                                    {"events", "event"},
                                    {"claims", "claim"},
                                    {"param", "parameters"},
                                    {"params", "parameters"},
                                    {"parameter", "parameters"},
                                    {"constants", "parameters"},
                                    {"constant", "parameters"},
                                    {"values", "parameters"},
                                    {"coordinate", "coordinates"},
                                    {"coords", "coordinates"},
                                    {"state", "states"},
                                    {"variables", "coordinates"},
                                    {"dof", "coordinates"},
                                    {"dofs", "coordinates"},
                                    {"generalizedcoordinates", "coordinates"},
                                    {"initial", "coordinates"},
                                    {"initialconditions", "coordinates"},
                                    {"initialvalues", "coordinates"},
                                    {"velocities", "speeds"},
                                    {"generalizedspeeds", "speeds"},
                                    {"speed", "speeds"},
                                    {"controls", "inputs"},
                                    {"control", "inputs"},
                                    {"input", "inputs"},
                                    {"definition", "definitions"},
                                    {"defs", "definitions"},
                                    {"let", "definitions"},
                                    {"output", "outputs"},
                                    {"function", "functions"},
                                    {"energies", "energy"},
                                    {"lagrangian", "energy"},
                                    {"potential", "energy"},
                                    {"kinetic", "energy"},
                                    {"rayleigh", "dissipation"},
                                    {"sim", "simulation"},
                                    {"simulate", "simulation"},
                                    {"solver", "simulation"},
                                    {"integration", "simulation"},
                                    {"integrator", "simulation"},
                                    {"options", "simulation"},
                                    {"settings", "simulation"},
                                    {"run", "simulation"},
                                    {"generalizedforces", "forces"},
                                    {"equations", "claim"},
                                    {"equation", "claim"},
                                    {"name", "title"},
                                    {"description", "notes"},
                                    {"author", "source"},
                                    {"g", "gravity"}};

constexpr Meaning typed_joint_types[] = {{"hinge", "revolute"},
                                         {"pin", "revolute"},
                                         {"pinjoint", "revolute"},
                                         {"pivot", "revolute"},
                                         {"rotary", "revolute"},
                                         {"rotational", "revolute"},
                                         {"continuous", "revolute"},
                                         {"revolutejoint", "revolute"},
                                         {"slider", "prismatic"},
                                         {"slide", "prismatic"},
                                         {"sliding", "prismatic"},
                                         {"linear", "prismatic"},
                                         {"translational", "prismatic"},
                                         {"prismaticjoint", "prismatic"},
                                         {"ball", "spherical"},
                                         {"ballandsocket", "spherical"},
                                         {"sphericaljoint", "spherical"},
                                         {"weld", "fixed"},
                                         {"welded", "fixed"},
                                         {"rigid", "fixed"},
                                         {"weldjoint", "fixed"},
                                         {"hooke", "universal"},
                                         {"cardan", "universal"},
                                         {"ujoint", "universal"},
                                         {"floating", "free"},
                                         {"helical", "screw"},
                                         {"cylinder", "cylindrical"},
                                         {"plane", "planar"},
                                         {"planarjoint", "planar"}};

constexpr Meaning typed_methods[] = {{"rk45", "dopri5"},
                                     {"ode45", "dopri5"},
                                     {"dormandprince", "dopri5"},
                                     {"rungekutta", "rk4"},
                                     {"rungekutta4", "rk4"},
                                     {"ode4", "rk4"},
                                     {"rk", "rk4"},
                                     {"ode113", "abm"},
                                     {"adams", "abm"},
                                     {"ode15s", "bdf"},
                                     {"lsoda", "auto"},
                                     {"odeint", "auto"},
                                     {"dassl", "bdf"},
                                     {"gear", "bdf"},
                                     {"vode", "bdf"},
                                     {"ode23s", "radau"},
                                     {"radauiia", "radau"},
                                     {"dprkn8", "rkn86"},
                                     {"rkn8", "rkn86"},
                                     {"dprkn12", "rkn1210"},
                                     {"rkn12", "rkn1210"},
                                     {"nystrom", "rkn1210"},
                                     {"leapfrog", "verlet"},
                                     {"stormerverlet", "verlet"},
                                     {"velocityverlet", "verlet"},
                                     {"explicit euler", "euler"},
                                     {"forwardeuler", "euler"},
                                     {"expliciteuler", "euler"},
                                     {"heun", "rk2"},
                                     {"midpoint", "rk2"},
                                     {"dop", "dop853"},
                                     {"adaptive", "auto"},
                                     {"default", "auto"}};

constexpr Meaning typed_formalisms[] = {{"eulerlagrange", "lagrange"},
                                        {"lagrangian", "lagrange"},
                                        {"lagranges", "lagrange"},
                                        {"lagrange2", "lagrange"},
                                        {"lagrangesecondkind", "lagrange"},
                                        {"lagrangefirstkind", "lagrange1"},
                                        {"newton", "schiehlen"},
                                        {"newtoneuler", "schiehlen"},
                                        {"ne", "schiehlen"},
                                        {"kanes", "kane"},
                                        {"hamiltonian", "hamilton"},
                                        {"alembert", "dalembert"},
                                        {"virtualwork", "dalembert"},
                                        {"gibbsappell", "appell"},
                                        {"gibbs", "appell"},
                                        {"featherstone", "recursive"},
                                        {"aba", "recursive"},
                                        {"rnea", "recursive"},
                                        {"articulatedbody", "recursive"},
                                        {"multipliers", "routh"},
                                        {"lagrangemultipliers", "routh"},
                                        {"ferrers", "routh"}};

}  // namespace

std::string bare(std::string_view word) {
    std::string result;
    for (const char c : word)
        if (c != ' ' && c != '-' && c != '_' && c != '\'')
            result += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    return result;
}

std::string_view function_meant(std::string_view word) {
    if (const std::string_view other = found_in(typed_functions, word); !other.empty()) return other;
    std::string small;
    for (const char c : word) small += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    if (small == word) return {};
    if (is_reserved_function(small)) return find_function(small)->name;
    return found_in(typed_functions, small);
}

std::string advice_on_function(std::string_view word) {
    const std::string_view other = found_in(instead_of_functions, bare(word));
    if (!other.empty()) return say("write {}", other);
    const std::string small = bare(word);
    if (small == "floor" || small == "ceil" || small == "round" || small == "mod" || small == "fmod")
        return say("steps are written with sign, abs, min and max");
    if (small == "if" || small == "where" || small == "piecewise" || small == "ifelse")
        return say("cases are written with min, max, abs or (1 + sign(x))/2, which is 0 and then 1");
    if (small == "integrate" || small == "integral" || small == "int")
        return say("there are no integrals in an expression");
    if (small == "differentiate" || small == "ddt") return say("(…)' is the derivative by the time");
    return {};
}

std::string advice_on_name(std::string_view word) {
    return std::string(found_in(typed_names, word));
}

std::string_view table_meant(std::string_view word) {
    const std::string small = bare(word);
    for (const TableKeys& one : table_keys)
        if (!one.table.empty() && one.table == small) return one.table;
    return found_in(typed_tables, small);
}

std::string_view joint_type_meant(std::string_view word) {
    return found_in(typed_joint_types, bare(word));
}

std::string_view method_meant(std::string_view word) {
    return found_in(typed_methods, bare(word));
}

std::string_view formalism_meant(std::string_view word) {
    return found_in(typed_formalisms, bare(word));
}

std::string advice_on_command(std::string_view command) {
    if (command == "dot") return "x'";
    if (command == "ddot") return "x''";
    if (command == "frac") return "(a)/(b)";
    if (command == "cdot" || command == "times") return "*";
    if (command == "sqrt") return "sqrt(x)";
    if (is_reserved_function(command)) return std::string(command) + "(x)";
    if (const GreekLetter* const greek = greek_named(command)) return std::string(greek->name);
    return {};
}

}  // namespace alembert
