// SPDX-License-Identifier: MIT
// A program that a signal ends while the compiler runs leaves nothing behind: no temporary file, no folder, no
// compiler.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "scenes.hpp"
#include "shell.hpp"

namespace commands_signals {

using namespace alembert::test;
namespace fs = std::filesystem;

namespace {

/// A slow compiler that writes down its process number.
const std::string script = R"sh(
cd "$1"
cat >slow <<'END'
#!/bin/sh
echo $$ >"$NOTE"
sleep 600 &
wait
echo >"$NOTE.end"
END
chmod +x slow
export CXX="$PWD/slow" NOTE="$PWD/note" TMPDIR="$PWD/temporary" XDG_CACHE_HOME="$PWD/$4"
mkdir temporary
: >file
"$ALEMBERT" simulate --code compiled --no-tuning "$2" >out 2>err &
program=$!
until [ -s note ] || grep -q ') Z' /proc/$program/stat; do sleep 0.05; done
[ -s note ] || { cat err >&2; exit 99; }
kill "-$3" "$program"
wait "$program"
echo $?
while kill -0 "$(cat note)" 2>/dev/null; do sleep 0.05; done
[ -e note.end ] && echo "the compiler went on to its end"
find temporary cache -mindepth 1 -not -path cache/alembert 2>/dev/null
exit 0
)sh";

}  // namespace

TEST_CASE("signals: a run that is ended while it compiles removes its files and its compiler") {
    const std::string scene = source_path("scenes/textbook/cart_pole.toml");
    for (const auto& [signal, exit] : {std::pair{"TERM", "143\n"}, std::pair{"HUP", "129\n"}})
        for (const char* cache : {"cache", "file"}) {  // the second is no folder, so that a private folder is used
            CAPTURE(signal);
            CAPTURE(cache);
            const Run result = run_shell(script, {temporary_folder("signals"), scene, signal, cache});
            CHECK(result.exit == 0);
            CHECK(result.out == exit);
        }
}

}  // namespace commands_signals
