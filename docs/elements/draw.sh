#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Draws the pictures of docs/elements.md: of each scene its figure and a plot of its motion.
#   docs/elements/draw.sh build/release/generator/alembert
set -eu
program=$(realpath "$1")
cd "$(dirname "$0")/../.."

draw() {  # scene, columns of the plot
    name=${1#*/}
    "$program" derive "scenes/$1.toml" --svg "docs/elements/$name.svg" > /dev/null
    "$program" simulate "scenes/$1.toml" --no-estimate --svg "docs/elements/$name-motion.svg" --show "$2" > /dev/null
}
draw elements/dc_motor "theta',i"
draw elements/filter "F,x'"
draw elements/pid_anti_windup "x,integral,F"
draw elements/lugre "x,z,friction"
draw elements/hydraulic_cylinder "x,p"
draw elements/tyre_relaxation "x',s"
draw elements/hill_muscle "q,a,l_m"
draw elements/rocket "h',M"
draw elements/winch "theta,l"
draw elements/backlash "phi_1,phi_2"
draw elements/hunt_crossley "y"
draw elements/quadratic_drag "x,y"
draw elements/cam "h,phi',N"
draw elements/drag_table "y',energy"
draw modes/sampled_hold "x,F"
draw modes/freewheel "phi_1',phi_2',locked"
draw modes/ratchet "phi,n"
draw modes/clutch "phi_1',phi_2',N"
draw modes/slack_rope "x,y,tight"
draw modes/pick_and_drop "y,on"
draw modes/roll_off "y,lambda_sphere"
