# The program for WebAssembly, by Debian's emscripten and what web/libraries.sh has compiled.
#   cmake -S . -B build/web/program -G Ninja -DCMAKE_TOOLCHAIN_FILE=web/toolchain.cmake -DALEMBERT_WEB_ROOT=build/web/root
# web/configure.sh does it, for web/build.sh and web/read.sh.
execute_process(COMMAND em-config EMSCRIPTEN_ROOT OUTPUT_VARIABLE emscripten OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
include(${emscripten}/cmake/Modules/Platform/Emscripten.cmake)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ALEMBERT_WEB_ROOT)
set(ENV{PKG_CONFIG_PATH} "")
set(ENV{PKG_CONFIG_LIBDIR} ${ALEMBERT_WEB_ROOT}/lib/pkgconfig)
set(PKG_CONFIG_EXECUTABLE pkg-config)
set(CMAKE_PROJECT_TOP_LEVEL_INCLUDES ${CMAKE_CURRENT_LIST_DIR}/packages.cmake)
