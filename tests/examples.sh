#!/usr/bin/env bash
# Installs the build into a temporary folder, and builds and runs examples/ against it as somebody else would.
#   examples.sh BUILD_DIRECTORY COMPILER [FLAGS]     flags: those that the build itself needs (sanitizers)
set -eu
build=$1
compiler=$2
flags=${3:-}
root=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >"$work/log"
cmake -G Ninja -S "$root/examples" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" >>"$work/log" 2>&1 ||
    { tail -n 30 "$work/log"; exit 1; }
cmake --build "$work/build" >>"$work/log" 2>&1 || { tail -n 30 "$work/log"; exit 1; }
export XDG_CACHE_HOME=$work/cache
prints() { # PROGRAM TEXT
    local printed
    printed=$("$work/build/$1") || { echo "$1 failed: $printed"; exit 1; }
    [ "$printed" = "$2" ] || { printf '%s printed:\n%s\nexpected:\n%s\n' "$1" "$printed" "$2"; exit 1; }
}
# Falls 5 m in 1 s, comes back at half the speed 1 s later.
prints bouncing_ball 'm \ddot{y} + m g = \lambda_{\mathrm{floor}}
impact at 1.000000000
impact at 2.000000000
the estimated error is below 1e-8'
prints chain '1 rods: the energy keeps to 1e-9
4 rods: the energy keeps to 1e-9'
prints homework "proved
refuted: sign in x''*cos(theta)"
prints controller 'the trolley is 0.000 m from its goal, the rope 0.000 rad from the vertical'
"$work/prefix/bin/alembert" --version

# A project with two systems, which links the runtime alone: neither GiNaC nor pkg-config is looked for.
cmake -G Ninja -S "$root/examples/project" -B "$work/project" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" >>"$work/log" 2>&1 ||
    { tail -n 30 "$work/log"; exit 1; }
cmake --build "$work/project" >>"$work/log" 2>&1 || { tail -n 30 "$work/log"; exit 1; }
ctest --test-dir "$work/project" --output-on-failure >>"$work/log" 2>&1 || { tail -n 30 "$work/log"; exit 1; }
loops() { # FOLDER: its crane_loop prints where the crane and the pendulum are
    local printed
    printed=$("$1/crane_loop")
    [ "$printed" = 'the trolley is 0.000 m from its goal, the rope 0.000 rad from the vertical
the pendulum is at -0.149218 rad after 10 s' ] || { printf '%s/crane_loop printed:\n%s\n' "$1" "$printed"; exit 1; }
}
loops "$work/project"
# The same program with the sources of the runtime in its own project, and with the runtime that is built and installed without
# the generator. Both are built without optimization, which takes half the time.
mkdir "$work/within"
cp -r "$root/lib" "$work/within/alembert" # a copy of this folder alone
cat >"$work/within/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(within LANGUAGES CXX)
add_subdirectory(alembert)
find_package(Threads REQUIRED)
add_executable(crane_loop $root/examples/project/loop.cpp $work/project/crane.cpp $work/project/pendulum.cpp)
target_include_directories(crane_loop PRIVATE $work/project)
target_link_libraries(crane_loop PRIVATE alembert::runtime Threads::Threads)
END
built() { # FOLDER OPTION...: configures and builds it in FOLDER/build
    local folder=$1
    shift
    cmake -G Ninja -B "$folder/build" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS="-O0 -g0 $flags" -DCMAKE_UNITY_BUILD=ON \
        -DCMAKE_CXX_COMPILER="$compiler" "$@" >>"$work/log" 2>&1 && cmake --build "$folder/build" >>"$work/log" 2>&1 ||
        { tail -n 30 "$work/log"; exit 1; }
}
built "$work/within" -S "$work/within"
loops "$work/within/build"
built "$work/runtime" -S "$root" -DALEMBERT_GENERATOR=OFF -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON
cmake --install "$work/runtime/build" --prefix "$work/runtime/prefix" >>"$work/log"
built "$work/of_runtime" -S "$root/examples/project" -DCMAKE_PREFIX_PATH="$work/runtime/prefix" -DALEMBERT="$work/prefix/bin/alembert" \
    -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON
loops "$work/of_runtime/build"

# The programs of docs/cpp.md: each block "```cpp NAME.cpp", and in the next block what it prints.
mkdir "$work/cpp"
awk -v folder="$work/cpp" '
    /^```cpp [a-z]+\.cpp$/ { file = folder "/" $2; name = substr($2, 1, length($2) - 4); next }
    /^```text$/ && name != "" { file = folder "/" name ".expected"; name = ""; next }
    /^```$/ { file = ""; next }
    file != "" { print > file }' "$root/docs/cpp.md"
{
    echo 'cmake_minimum_required(VERSION 3.25)'
    echo 'project(alembert_cpp_page LANGUAGES CXX)'
    echo 'find_package(alembert REQUIRED)'
    for source in "$work"/cpp/*.cpp; do
        name=$(basename "$source" .cpp)
        echo "add_executable($name $name.cpp)"
        echo "target_link_libraries($name PRIVATE alembert::alembert)"
    done
    # Every installed name of a header of the runtime, the old ones too.
    echo 'add_library(headers OBJECT headers.cc)'
    echo 'target_link_libraries(headers PRIVATE alembert::runtime)'
    # Old names of headers of the generator lead to the new ones.
    echo 'add_library(old_headers OBJECT old_headers.cc)'
    echo 'target_link_libraries(old_headers PRIVATE alembert::alembert)'
} >"$work/cpp/CMakeLists.txt"
(cd "$work/prefix/include" && printf '#include <%s>\n' alembert/*.hpp alembert/{ode,hybrid,batch,native,base}/*.hpp) |
    grep -v '<alembert/alembert.hpp>' >"$work/cpp/headers.cc"
(cd "$work/prefix/include" && grep -l 'Moved; this name' alembert/*/*.hpp | sed 's/.*/#include <&>/') >"$work/cpp/old_headers.cc"
[ "$(wc -l <"$work/cpp/old_headers.cc")" -gt 200 ] || { echo 'the old names of headers are not installed'; exit 1; }
cmake -G Ninja -S "$work/cpp" -B "$work/cpp/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" >>"$work/log" 2>&1 ||
    { tail -n 30 "$work/log"; exit 1; }
cmake --build "$work/cpp/build" >>"$work/log" 2>&1 || { tail -n 30 "$work/log"; exit 1; }
for expected in "$work"/cpp/*.expected; do
    name=$(basename "$expected" .expected)
    printed=$("$work/cpp/build/$name") || { echo "docs/cpp.md: $name failed: $printed"; exit 1; }
    [ "$printed" = "$(cat "$expected")" ] ||
        { printf 'docs/cpp.md: %s printed:\n%s\nexpected:\n%s\n' "$name" "$printed" "$(cat "$expected")"; exit 1; }
done
