#!/usr/bin/env bash
# The layers of architecture.md, held by grep: who may include what.
set -u
cd "$(dirname "$0")/.."
failed=0
forbid() { # REASON PATTERN FILES...
    local reason=$1 pattern=$2
    shift 2
    local found
    found=$(grep -nE "$pattern" "$@" 2>/dev/null)
    [ -z "$found" ] && return
    printf '%s:\n%s\n' "$reason" "$found"
    failed=1
}
files() { find "$@" -name '*.?pp' | sort; }
ginac='#include.*(ginac|cln/)'
mapfile -t runtime < <(files lib)
mapfile -t scene < <(files generator/scene)
mapfile -t graph < <(files generator/program generator/emit generator/machine)
mapfile -t generator < <(files generator | grep -v -e '^generator/commands' -e '^generator/main.cpp')
mapfile -t not_reader < <(files lib generator | grep -v '^generator/scene/')
mapfile -t not_module < <(files lib generator | grep -v '^lib/alembert/native/module.cpp')

# The rooms of generator/rooms.txt: each includes only itself, what stands before it, and the runtime.
mapfile -t rooms < <(sed -e '/^#/d' -e '/^$/d' -e 's/ .*//' generator/rooms.txt)
every=$(IFS='|'; echo "${rooms[*]}")
later=$every
for room in "${rooms[@]}"; do
    later=${later#"$room"}
    later=${later#|}
    [ -d "generator/$room" ] || { echo "generator/rooms.txt names the room '$room', which does not exist"; failed=1; continue; }
    [ -z "$later" ] && continue
    mapfile -t inside < <(files "generator/$room")
    forbid "the room $room includes a later one" "#include \"($later)/" "${inside[@]}"
done
for folder in generator/*/; do
    [[ " ${rooms[*]} peers " == *" $(basename "$folder") "* ]] || { echo "$folder is not in generator/rooms.txt"; failed=1; }
done

forbid 'the runtime includes the generator' "#include \"($every)/" "${runtime[@]}"
forbid 'the runtime includes GPL libraries' "$ginac" "${runtime[@]}"
forbid 'GiNaC in the scene layer' "$ginac" "${scene[@]}"
forbid 'GiNaC in the rooms program, emit and machine' '#include.*(ginac|"(symbolic|notation|model|formalism|lower)/)' "${graph[@]}"
forbid 'commands are used below the commands' '#include "commands/' "${generator[@]}"
forbid 'toml++ outside the reader' '#include.*toml\+\+' "${not_reader[@]}"
mapfile -t not_options < <(files lib generator | grep -v -e '^generator/commands/\(verb.cpp\|help\|command_line.cpp\)')
forbid 'CLI11 outside the files that walk through all verbs' '#include.*CLI' "${not_options[@]}"
mapfile -t not_urdf < <(files lib generator | grep -v '^generator/urdf/')
forbid 'urdfdom outside its reader' '#include.*(urdf_|tinyxml|console_bridge)' "${not_urdf[@]}"
mapfile -t not_server < <(files lib generator | grep -v '^generator/commands/page_server.cpp')
forbid 'cpp-httplib outside the server of pages' '#include.*httplib' "${not_server[@]}"
mapfile -t not_executable < <(files lib generator | grep -v '^lib/alembert/native/executable.cpp')
forbid 'dlfcn outside the module' '#include <dlfcn' "${not_module[@]}"
forbid 'memory that can be run outside its one file' 'PROT_EXEC' "${not_executable[@]}"
forbid 'the emitted code includes something' '^ *#include' templates/solver.cpp.mustache generated/*.cpp
forbid 'a shell' '\b(system|popen)\(' "${runtime[@]}" "${generator[@]}"

# Two types of one name in one namespace, each in a header of its own, are undefined behaviour that no compiler sees where no
# file includes both: the program crashes.
types=$(find lib generator -name '*.hpp' -exec sed -nE \
    -e 's/^namespace (alembert::)?([a-z_:]*) \{.*/@\2/p' -e 's/^\}  \/\/ namespace .*/@/p' \
    -e 's/^(struct|class|enum class|enum) ([A-Za-z_0-9]+)( final)?( :[^;]*)? \{.*/\2/p' {} + |
    awk '/^@/ { space = substr($0, 2); next } { print space "::" $0 }' | sort | uniq -d)
[ -z "$types" ] || { printf 'several headers have a type of this name:\n%s\n' "$types"; failed=1; }

# The emitted file's copy of the ABI's structs, word for word.
words() { sed -n "/^struct $1 {/,/^};/p" "$2" | sed 's|///.*||' | tr -s ' \n' ' '; }
for struct in alembert_solver_table alembert_pack_table alembert_projection_table; do
    [ "$(words $struct lib/alembert/native/abi.hpp)" = "$(words $struct templates/solver.cpp.mustache)" ] ||
        { echo "templates/solver.cpp.mustache and lib/alembert/native/abi.hpp disagree about $struct"; failed=1; }
done
missing=$(files lib generator tests | xargs grep -L 'SPDX-License-Identifier')
[ -z "$missing" ] || { printf 'no licence line in:\n%s\n' "$missing"; failed=1; }
[ "$failed" = 0 ] && echo 'the layers hold'
exit "$failed"
