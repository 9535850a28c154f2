// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/sdf_left_out.hpp"

#include <set>

namespace alembert {

Robot::Effect effect_in_sdf(const XmlElement& e, const std::string& attribute) {
    using Effect = Robot::Effect;
    static const std::set<std::string> elements{"actor",
                                                "allow_auto_disable",
                                                "atmosphere",
                                                "audio",
                                                "audio_sink",
                                                "audio_source",
                                                "battery",
                                                "collision",
                                                "dissipation",
                                                "drake:acceleration",
                                                "drake:collision_filter_group",
                                                "drake:proximity_properties",
                                                "enable_wind",
                                                "frame",
                                                "gui",
                                                "light",
                                                "magnetic_field",
                                                "material",
                                                "must_be_base_link",
                                                "particle_emitter",
                                                "physics",
                                                "projector",
                                                "road",
                                                "scene",
                                                "self_collide",
                                                "sensor",
                                                "spherical_coordinates",
                                                "stiffness",
                                                "visual",
                                                "wind"};
    if (!attribute.empty()) return Effect::none;
    const std::string tag = e.Name(), file = e.Attribute("filename") != nullptr ? e.Attribute("filename") : "";
    if (tag == "effort" || tag == "velocity") return Effect::driven;
    if (tag == "plugin")
        for (const char* watches :
             {"physics-system", "user-commands", "scene-broadcaster", "sensors-system", "imu-system",
              "contact-system", "label-system", "publisher", "battery", "logical", "detector", "camera", "log-",
              "magnetometer", "altimeter", "navsat", "air-pressure", "follow-actor"})
            if (file.find(watches) != std::string::npos) return Effect::none;
    return elements.contains(tag) ? Effect::none : Effect::motion;
}

}  // namespace alembert
