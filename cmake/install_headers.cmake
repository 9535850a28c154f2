# Installs the headers of the generator's rooms under alembert/, so that no folder named `scene` or `model` stands in a user's
# include path: inside the repository a header is "model/mechanism.hpp", installed it is "alembert/model/mechanism.hpp".
# Needs SOURCE (the folder generator/) and INCLUDE (where the runtime's headers go, relative to the prefix).
set(into $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${INCLUDE}/alembert)
file(STRINGS ${SOURCE}/rooms.txt lines REGEX "^[a-z/]+ +[^= ]")
set(chambers "")
set(rooms "")
foreach(line IN LISTS lines)
  string(REGEX MATCH "^[a-z/]+" chamber "${line}")
  if(NOT chamber MATCHES "^(present/report|scene/import|commands)$")  # what only the program uses
    string(REGEX MATCH "^[a-z]+" room "${chamber}")
    list(APPEND rooms ${room})
    list(APPEND chambers ${chamber})
  endif()
endforeach()
list(REMOVE_DUPLICATES rooms)
list(JOIN rooms "|" any)
foreach(chamber IN LISTS chambers ITEMS .)  # and alembert.hpp, all of them in one header
  file(GLOB headers RELATIVE ${SOURCE} ${SOURCE}/${chamber}/*.hpp)
  foreach(header IN LISTS headers)
    file(READ ${SOURCE}/${header} text)
    string(REGEX REPLACE "#include \"(${any})/" "#include \"alembert/\\1/" text "${text}")
    file(WRITE ${into}/${header} "${text}")
  endforeach()
endforeach()

# The names that headers had while every chamber was a room: for one version, and nothing here includes them.
set(moved
  agree analysis/agree
  archive base/archive
  audit analysis/audit
  contact analysis/contact
  derive analysis/derive
  emit codegen/emit
  equilibrium stability/equilibrium
  exact analysis/exact
  figure present/figure
  fmu simulate/fmu
  formalism model/formalism
  kinematics simulate/kinematics
  language base/language
  linear stability/linear
  lower program/lower
  machine codegen/machine
  notation algebra/notation
  overview present/overview
  reaction analysis/reaction
  rigid analysis/rigid
  run simulate
  state analysis/state
  symbolic algebra/symbolic
)
function(forward old new)
  file(WRITE ${into}/${old}
    "// SPDX-License-Identifier: GPL-2.0-or-later\n// Moved; this name goes with the next version.\n#pragma once\n#include \"alembert/${new}\"\n")
endfunction()
forward(run/grid.hpp scene/grid.hpp)
forward(run/quad_motion.hpp program/quad_motion.hpp)
while(moved)
  list(POP_FRONT moved old new)
  file(GLOB headers RELATIVE ${SOURCE}/${new} ${SOURCE}/${new}/*.hpp)
  foreach(header IN LISTS headers)
    forward(${old}/${header} ${new}/${header})
  endforeach()
endwhile()
