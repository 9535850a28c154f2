# The libraries of headers alone, which are the same for every processor: those of Debian, in a folder without the
# headers of its C library.
foreach(package Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json tomlplusplus::tomlplusplus CLI11::CLI11 Threads::Threads)
  if(NOT TARGET ${package})
    add_library(${package} INTERFACE IMPORTED)
    target_include_directories(${package} SYSTEM INTERFACE ${ALEMBERT_WEB_ROOT}/include)
  endif()
endforeach()
target_include_directories(Eigen3::Eigen SYSTEM INTERFACE ${ALEMBERT_WEB_ROOT}/include/eigen3)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)

macro(alembert_web_package method name)
  if("${name}" MATCHES "^(Eigen3|fmt|nlohmann_json|tomlplusplus|CLI11|Threads)$")
    set(${name}_FOUND TRUE)
  endif()
endmacro()
cmake_language(SET_DEPENDENCY_PROVIDER alembert_web_package SUPPORTED_METHODS FIND_PACKAGE)
