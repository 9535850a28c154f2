# What rhs.sh runs; built by it. bench_rhs times us alone; bench_rivals also the programs of Debian's packages that are here.
add_executable(bench_rhs EXCLUDE_FROM_ALL bench/rhs.cpp bench/rivals.cpp)
add_executable(bench_rivals EXCLUDE_FROM_ALL bench/rhs.cpp bench/rivals.cpp)
foreach(target bench_rhs bench_rivals)
  target_link_libraries(${target} PRIVATE alembert_runtime nlohmann_json::nlohmann_json fmt::fmt)
endforeach()
# For this processor, as emitted code is. The rivals' own files are not: their packages are compiled for any x86-64, and
# Eigen's and KDL's types change their size with the processor.
set_source_files_properties(bench/rhs.cpp PROPERTIES COMPILE_OPTIONS "-O2;-march=native;-ffp-contract=off")

# rival(NAME HEADER FOLDER LIBRARIES...): bench/rivals_NAME.cpp, where HEADER is found in FOLDER under an include path.
function(rival name header folder)
  string(TOUPPER RIVAL_${name} found)
  find_path(${found}_INCLUDE ${header} PATH_SUFFIXES ${folder})
  set(libraries)
  foreach(library ${ARGN})
    find_library(${found}_${library} ${library})
    list(APPEND libraries ${${found}_${library}})
  endforeach()
  mark_as_advanced(${found}_INCLUDE)
  if(NOT ${found}_INCLUDE OR libraries MATCHES NOTFOUND)
    return()
  endif()
  add_library(rival_${name} OBJECT EXCLUDE_FROM_ALL bench/rivals_${name}.cpp)
  target_include_directories(rival_${name} SYSTEM PRIVATE ${${found}_INCLUDE})
  target_compile_options(rival_${name} PRIVATE -O2)
  target_link_libraries(rival_${name} PRIVATE Eigen3::Eigen fmt::fmt)
  target_link_libraries(bench_rivals PRIVATE rival_${name} ${libraries})
  target_compile_definitions(bench_rivals PRIVATE ${found})
endfunction()

rival(mujoco mujoco/mujoco.h "" mujoco)
rival(kdl kdl/chain.hpp "" orocos-kdl)
rival(bullet BulletDynamics/Featherstone/btMultiBody.h bullet
  BulletDynamics-float64 BulletCollision-float64 LinearMath-float64)
rival(dart dart/dynamics/Skeleton.hpp "" dart)
rival(simbody Simbody.h simbody SimTKsimbody SimTKmath SimTKcommon)
if(TARGET rival_bullet)
  target_compile_definitions(rival_bullet PRIVATE BT_USE_DOUBLE_PRECISION)
endif()
if(TARGET rival_simbody)
  target_compile_options(rival_simbody PRIVATE -UNDEBUG)
  set_target_properties(rival_simbody PROPERTIES CXX_STANDARD 17)  # its == is ambiguous in C++20
endif()
