// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/text.hpp"
#include "present/report/kinematics.hpp"

#include <cmath>

namespace alembert {

namespace {

Json text_or_null(const std::optional<Phrase>& formula) {
    return formula ? Json(text(*formula)) : Json(nullptr);
}

Json formulas(const KinematicVector& v) {
    return {text_or_null(v[0].formula), text_or_null(v[1].formula), text_or_null(v[2].formula)};
}

Json values(const KinematicVector& v) {
    Json result = Json::array();
    for (const KinematicEntry& entry : v)
        result.push_back(std::isfinite(entry.value) ? Json(entry.value) : Json(nullptr));
    return result;
}

/// Rows along N, columns along the frame.
template <typename Show>
Json rows_of(const std::array<KinematicVector, 3>& axes, const Show& show) {
    Json result = Json::array();
    for (std::size_t i = 0; i < 3; ++i)
        result.push_back(show(KinematicVector{axes[0][i], axes[1][i], axes[2][i]}));
    return result;
}

Json steps_of(const FrameKinematics& f) {
    Json result = Json::array();
    for (const TurnStep& turn : f.turns)
        result.push_back({{"angle", text_or_null(turn.angle)},
                          {"axis", turn.angle ? formulas(turn.axis) : Json(nullptr)},
                          {"omega", formulas(turn.omega)},
                          {"alpha", formulas(turn.alpha)},
                          {"omega_cross_omega", formulas(turn.turning)}});
    if (f.carried)
        result.push_back({{"parent", f.parent},
                          {"omega", formulas((*f.carried)[0])},
                          {"alpha", formulas((*f.carried)[1])},
                          {"omega_cross_omega", formulas((*f.carried)[2])}});
    return result;
}

Json json_of(const FrameKinematics& f, bool steps) {
    Json result;
    if (!f.same_as.empty()) result["same_as"] = f.same_as;
    result["parent"] = f.parent;
    result["direction_cosines"] = rows_of(f.axes, formulas);
    result["omega"] = formulas(f.omega.along_N);
    result["alpha"] = formulas(f.alpha.along_N);
    const bool is_simple = f.is_simple && !f.turns.empty();
    result["axis"] = is_simple ? formulas(f.turns[0].axis) : Json(nullptr);
    result["angle"] = is_simple ? text_or_null(f.turns[0].angle) : Json(nullptr);
    result["own"] = {{"omega", formulas(f.omega.own)}, {"alpha", formulas(f.alpha.own)}};
    if (steps) result["steps"] = steps_of(f);
    Json& at = result["values"];
    at["direction_cosines"] = rows_of(f.axes, values);
    at["omega"] = values(f.omega.along_N);
    at["alpha"] = values(f.alpha.along_N);
    at["axis"] = f.turn ? Json({f.turn->axis[0], f.turn->axis[1], f.turn->axis[2]}) : Json(nullptr);
    at["angle"] = f.turn ? Json(f.turn->angle) : Json(nullptr);
    at["own"] = {{"omega", values(f.omega.own)}, {"alpha", values(f.alpha.own)}};
    return result;
}

Json steps_of(const PointKinematics& p) {
    Json result = Json::array();
    for (const PlaceStep& step : p.places)
        result.push_back({{"along", step.frame.empty() ? Json(nullptr) : Json(step.frame)},
                          {"offset", formulas(step.offset)},
                          {"relative_velocity", formulas(step.relative_velocity)},
                          {"turning_velocity", formulas(step.turning_velocity)},
                          {"relative", formulas(step.relative)},
                          {"tangential", formulas(step.tangential)},
                          {"centripetal", formulas(step.centripetal)},
                          {"coriolis", formulas(step.coriolis)}});
    return result;
}

Json json_of(const PointKinematics& p, bool steps) {
    Json result;
    result["from"] = p.from;
    const auto three = [&](const auto& show, auto along) {
        return Json{{"position", show(p.position.*along)},
                    {"velocity", show(p.velocity.*along)},
                    {"acceleration", show(p.acceleration.*along)}};
    };
    result.update(three(formulas, &TwofoldVector::along_N));
    if (!p.along.empty()) {
        result["own"] = {{"along", p.along}};
        result["own"].update(three(formulas, &TwofoldVector::own));
    }
    if (steps) result["steps"] = steps_of(p);
    result["values"] = three(values, &TwofoldVector::along_N);
    if (!p.along.empty()) result["values"]["own"] = three(values, &TwofoldVector::own);
    return result;
}

}  // namespace

Json as_json(const SceneKinematics& s, bool steps) {
    Json result;
    result["time"] = s.time;
    result["coordinates"] = by_name(s.coordinates, s.q);
    result["rates"] = by_name(s.coordinates, s.rates);
    result["accelerations"] = s.no_accelerations.empty() ? by_name(s.coordinates, s.accelerations) : Json(nullptr);
    if (!s.no_accelerations.empty()) result["no_accelerations"] = s.no_accelerations;
    if (!s.adjusted.empty()) result["adjusted"] = s.adjusted;
    result["frames"] = Json::object();
    for (const FrameKinematics& f : s.frames) result["frames"][f.name] = json_of(f, steps);
    result["points"] = Json::object();
    for (const PointKinematics& p : s.points) result["points"][p.name] = json_of(p, steps);
    for (const auto& [name, found] : s.jacobians) {
        result["points"][name]["jacobian"] = found.jacobian;
        result["points"][name]["drift"] = found.bias;
    }
    if (s.mass_centre)
        result["mass_centre"] = {{"position", s.mass_centre->position},
                                 {"jacobian", s.mass_centre->jacobian},
                                 {"linear_momentum", s.mass_centre->linear_momentum},
                                 {"angular_momentum", s.mass_centre->angular_momentum}};
    return result;
}

}  // namespace alembert
