# Headers of the runtime under the names that they had before they moved into folders: alembert/NAME.hpp includes
# alembert/ode/integrate.hpp. They are installed for one version, and nothing here includes them.
# Needs INCLUDE (where the runtime's headers go, relative to the prefix).
set(moved
  abi native/abi
  abm ode/abm
  along ode/running_extrema
  argument base/argument
  bdf ode/bdf
  canonical ode/hamiltonian
  code_functions native/simd_math
  collocation ode/collocation
  compile native/compile
  contact hybrid/contact
  dense base/dense
  differences ode/differences
  disturbance ode/disturbance
  dop853 ode/dop853
  drift ode/energy_error
  ensemble batch/ensemble
  error base/error
  even_shares hybrid/minimax_reactions
  event_code ode/event_code
  event_watch ode/event_watch
  events ode/events
  executable native/executable
  fingerprint native/fingerprint
  five_points ode/five_points
  gauss ode/gauss
  impact hybrid/impact
  inertia base/inertia
  integrate ode/integrate
  interval base/interval
  kick hybrid/impulsive_event
  leftover native/temporary_files
  methods ode/methods
  module native/module
  newton ode/newton
  own_file native/program_path
  pace ode/cost_model
  pack_run batch/pack_driver
  pack_step batch/pack_explicit_rk
  pack_taylor batch/pack_taylor
  packs batch/packs
  phases hybrid/hybrid_motion
  process native/process
  process_time base/process_time
  project ode/projection
  quick_times ode/input_time_scales
  radau ode/radau
  rattle ode/rattle
  recorder ode/recorder
  registers native/cpu_features
  regularized ode/time_transformation
  rhs ode/rhs
  rotation base/rotation
  rough_choice hybrid/contact_modes
  rough_cones hybrid/contact_cones
  rough_impact hybrid/impact_routh
  rough_strike hybrid/impact_dispatch
  rounding ode/rounding
  run ode/driver
  saddle_point ode/saddle_point
  series ode/series
  series_code native/series_code
  series_length ode/series_length
  series_pace ode/taylor_switch
  series_packs batch/pack_series
  series_sum ode/series_sum
  settle hybrid/contact_transition
  shifted ode/shifted_linear_solver
  shrinking ode/step_collapse
  step ode/explicit_rk
  step_size ode/step_size
  stepper ode/formula
  stiffness ode/stiffness
  straight ode/missed_feature_check
  switch_choice hybrid/mode_enumeration
  switch_moment hybrid/switching_scales
  switch_sides hybrid/sliding_mode
  switch_watch hybrid/mode_guards
  switching hybrid/filippov
  symplectic ode/symplectic
  tableau ode/tableau
  taylor ode/taylor
  tolerances base/tolerances
  trajectory ode/trajectory
  verner ode/verner
)
while(moved)
  list(POP_FRONT moved old new)
  file(WRITE $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${INCLUDE}/alembert/${old}.hpp
    "// SPDX-License-Identifier: MIT\n// Moved; this name goes with the next version.\n#pragma once\n#include \"alembert/${new}.hpp\"\n")
endwhile()
