// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "analysis/rigid/inertia.hpp"
#include "present/report/json.hpp"

namespace alembert {

Json as_json(const SceneInertia& found);
std::string as_text(const SceneInertia& found);

}  // namespace alembert
