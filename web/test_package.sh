#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Tests the package from the packed file (web/package.sh): installed into a clean folder without a network, then the
# module (test_package.mjs), the command line against the native program, and, where there is a compiler of TypeScript, the types.
#   web/test_package.sh [PACKAGE [PROGRAM]]     build/web/alembert-*.tgz, build/release/generator/alembert
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
package=$(realpath "${1:-$(ls -t "$root"/build/web/alembert-*.tgz | head -1)}")
native=${2:-$root/build/release/generator/alembert}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export npm_config_cache=$folder/cache npm_config_update_notifier=false npm_config_fund=false npm_config_audit=false XDG_CACHE_HOME=$folder/cache
failures=0
expect() { # WHAT COMMAND...
  local what=$1
  shift
  if "$@"; then echo "ok     $what"; else
    echo "FAILED $what"
    failures=$((failures + 1))
  fi
}

mkdir "$folder/user" && cd "$folder/user"
echo '{ "name": "user", "private": true, "type": "module" }' >package.json
expect 'it installs without a network' npm install --offline --silent "$package"
cp "$root/web/test_package.mjs" .
expect 'the module' node test_package.mjs "$root"

# The command line: the same streams and exit codes as the native program has in the same folder.
mkdir work work/deep && cd work
cp "$root"/scenes/textbook/double_pendulum.toml scene.toml
cp "$root"/tests/derivations/double_pendulum_sign.tex .
printf 'title = "x"\n[coordinates]\nq = 1\n[energy]\nkinetic = "q'"'"'^2/2 + r"\n' >wrong.toml
printf "l1*theta1'' = 0\n" >claims.txt
same() { # WORDS...
  local mine=0 theirs=0
  ../node_modules/.bin/alembert "$@" <claims.txt >../mine.out 2>../mine.err || mine=$?
  "$native" "$@" <claims.txt >../native.out 2>../native.err || theirs=$?
  [ $mine = $theirs ] && cmp ../mine.out ../native.out && cmp ../mine.err ../native.err
}
expect 'derive' same derive scene.toml --steps
expect 'check, with a refuted claim on standard input' same check scene.toml -
expect 'check of a derivation' same check scene.toml double_pendulum_sign.tex
expect 'check of a folder' same check scene.toml .
expect 'a wrong scene' same derive wrong.toml
expect 'a scene that is not there' same derive missing.toml
expect 'an unknown option' same derive scene.toml --nothing
expect 'no words' same
expect 'Chinese' same derive scene.toml --language zh
expect 'JSON' same derive scene.toml --json
expect 'an output that is the scene' same simulate scene.toml -o scene.toml
expect 'an output in a folder that is not there' same derive scene.toml --svg nowhere/figure.svg
expect 'a scene in another folder' eval '(cd deep && same() { ../../node_modules/.bin/alembert "$@" >../../mine.out; "$native" "$@" >../../native.out; cmp ../../mine.out ../../native.out; }; same derive ../scene.toml)'
written() { # FILE WORDS...
  local file=$1
  shift
  rm -f "$file"
  npx --offline alembert "$@" >/dev/null 2>&1 && [ -s "$file" ]
}
expect 'a page beside the scene' written scene.html report scene.toml
expect 'a table at another place' written "$folder/motion.csv" simulate scene.toml -o "$folder/motion.csv"
expect 'a folder of sources' written solver/scene.c emit scene.toml -o solver --language c
expect 'a first scene' written pendulum.toml new
expect 'it does not replace a scene' same new
cd ..

# A page built by bundlers of npm's registry, where that can be reached, and opened in Chromium: the worker, its end by a signal.
page() { # FOLDER
  cat >"$1/index.html" <<<'<!doctype html><meta charset=utf8><title>t</title><pre id=said></pre><script type=module src="./main.js"></script>'
}
if npm install --silent --no-save --prefix "$folder/bundlers" vite esbuild >/dev/null 2>&1 && command -v chromium >/dev/null; then
  mkdir bundled && cp "$root/web/test_page_main.js" bundled/main.js && page bundled
  ln -s "$folder/user/node_modules" bundled/node_modules
  bundle() { (cd bundled && "$folder/bundlers/node_modules/.bin/$1" "${@:2}") >/dev/null 2>&1; }
  expect 'vite builds a page' bundle vite build --logLevel error
  expect 'the page of vite, in Chromium' node "$root/web/test_page.mjs" bundled/dist
  expect 'esbuild builds a page and the worker' bundle esbuild main.js node_modules/alembert/worker.js --bundle --format=esm --outdir=by_esbuild --entry-names='[name]'
  mkdir -p bundled/by_esbuild && page bundled/by_esbuild && cp node_modules/alembert/alembert.wasm bundled/by_esbuild
  expect 'the page of esbuild, in Chromium' node "$root/web/test_page.mjs" bundled/by_esbuild
else
  echo '-      there is no registry here, or no chromium: no page is bundled'
fi

# The types: by the compiler that is here, or by one from npm's registry, where that can be reached.
tsc=$(command -v tsc || true)
if [ -z "$tsc" ] && npm install --silent --no-save --prefix "$folder/typescript" typescript >/dev/null 2>&1; then
  tsc=$folder/typescript/node_modules/.bin/tsc
fi
if [ -n "$tsc" ]; then
  cp "$root/web/test_package.ts" .
  expect 'the types' "$tsc" --noEmit --strict --module nodenext --target es2022 test_package.ts
else
  echo '-      there is no tsc here, and no registry: the types are not checked'
fi
[ $failures = 0 ] && echo 'all is right' || { echo "$failures wrong"; exit 1; }
