// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/inertia.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/language/say.hpp"
#include "present/report/page.hpp"

namespace alembert {

namespace {

/// "A + m*d^2 = 0.31", or only the number.
std::string with_number(const std::optional<std::string>& text, double value) {
    const std::string number = fmt::format("{:.10g}", value == 0 ? 0.0 : value);
    return text && *text != number ? fmt::format("{} = {}", *text, number) : number;
}

}  // namespace

Json as_json(const SceneInertia& found) {
    Json result, text;
    result["of"] = found.of;
    result["about"] = found.about.empty() ? Json(nullptr) : Json(found.about);
    result["along"] = found.along;
    result["mass"] = found.mass;
    result["centre"] = found.centre;
    result["tensor"] = Json::array();
    text["mass"] = or_null(found.mass_text);
    text["centre"] = Json::array();
    text["tensor"] = Json::array();
    for (std::size_t i = 0; i < 3; ++i) {
        Json row = Json::array(), words = Json::array();
        for (std::size_t j = 0; j < 3; ++j) {
            row.push_back(found.tensor(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
            words.push_back(or_null(found.tensor_text[i][j]));
        }
        result["tensor"].push_back(row);
        text["tensor"].push_back(words);
        text["centre"].push_back(or_null(found.centre_text[i]));
    }
    result["principal"] = Json::array();
    for (const PrincipalMoment& p : found.principal)
        result["principal"].push_back({{"moment", p.moment}, {"axis", p.axis}});
    result["text"] = text;
    return result;
}

std::string as_text(const SceneInertia& found) {
    std::string page;
    put(page, "{}{}\n", fmt::join(found.of, ", "), found.of.size() > 1 ? say(" together") : "");
    say_on(page, "mass: {}\n", with_number(found.mass_text, found.mass));
    page += say("mass centre, from O along N:\n");
    for (std::size_t i = 0; i < 3; ++i)
        put(page, "  {}: {}\n", "xyz"[i], with_number(found.centre_text[i], found.centre[i]));
    say_on(page, "tensor of inertia about {}, along the axes of {}:\n",
           found.about.empty() ? say("the mass centre") : found.about, found.along);
    const char* const names[] = {"xx", "yy", "zz", "xy", "yz", "zx"};
    const std::size_t rows[] = {0, 1, 2, 0, 1, 2}, columns[] = {0, 1, 2, 1, 2, 0};
    for (std::size_t k = 0; k < 6; ++k)
        put(page, "  {}: {}\n", names[k],
            with_number(found.tensor_text[rows[k]][columns[k]],
                        found.tensor(static_cast<Eigen::Index>(rows[k]), static_cast<Eigen::Index>(columns[k]))));
    page += say("principal moments and axes:\n");
    for (const PrincipalMoment& p : found.principal)
        say_on(page, "  {:.10g} about ({:.6g}, {:.6g}, {:.6g})\n", p.moment, p.axis[0], p.axis[1], p.axis[2]);
    return page;
}

}  // namespace alembert
