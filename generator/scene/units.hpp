// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The numbers of a scene in SI units.
///
///     [parameters]
///     l = { value = 200, unit = "mm" }     // is "(200)*(0.001)" afterwards, with the unit "m"
///
/// The number that is given for a name is in the unit of the name. An expression in other names is a quantity
/// already, since they are in SI units: "2*l". A quantity such as "200 mm" is read as one (scene/expression.cpp).
/// What the scene's own unit is stays in `shown`. Units of the SI, and words that are not known ("AU"), change
/// nothing.

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

/// Adds mistakes (a unit that is no multiple of one of the SI) and warnings (a value of which it is not known
/// whether it is in the unit) to `found`.
void convert_units(Scene& scene, std::vector<Diagnostic>& found);

/// The unit in which numbers are given for a name, a rate's too, and in which texts and pictures show it: that of
/// the scene, or that of the SI.
struct UnitOfName {
    std::string unit = {};  ///< "deg/s"; empty for none, and for names that are not known
    double size = 1;        ///< what 1 of it is worth in SI units: 0.001 for `l` in mm, π/180 for `theta'` in deg
    std::string exact = {};  ///< the size as an expression; empty where it is 1

    /// "phi [deg]"; only the name where the unit is of the SI.
    std::string label(const std::string& name) const { return size == 1 ? name : name + " [" + unit + "]"; }
};
UnitOfName unit_of_name(const Scene& scene, const std::string& name);

/// A value that is typed for a name, in SI units: "(30)*(pi/180)" for "30"; as it is where it has units, or the
/// name none.
std::string in_si(const Scene& scene, const std::string& name, const std::string& value);

/// Whether all units of the scene are of the SI once they are converted. Where words such as "AU" are among them,
/// its lengths need not be metres.
bool is_in_si(const Scene& scene);

/// Whether an expression has a name other than pi and t, or a quantity with a unit.
bool has_quantities(const Tree& tree);

}  // namespace alembert
