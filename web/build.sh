#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Builds the program as WebAssembly on a Debian 12, from nothing: build/web/alembert.wasm and alembert.mjs.
#   web/build.sh          installs what is missing (as root), compiles CLN and GiNaC once, then the program
# What has been made is kept in build/web; remove that folder to begin anew.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=$root/build/web
export NODE_PATH=/usr/share/nodejs${NODE_PATH:+:$NODE_PATH}  # where node-acorn is, which a Node that is not from Debian does not look for
mkdir -p "$build"
began=$SECONDS
phase() { # NAME COMMAND...
  local name=$1 before=$SECONDS
  shift
  "$@"
  printf '%-44s %5d s\n' "$name" $((SECONDS - before))
}

packages() {
  local missing=() package
  # The compiler; what its optimizer and `apt-get source` need; the libraries of headers alone; the translations.
  for package in emscripten node-acorn dpkg-dev cmake ninja-build pkg-config gettext libeigen3-dev libfmt-dev libtomlplusplus-dev \
    libcli11-dev libkainjow-mustache-dev nlohmann-json3-dev; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] || apt-get install -y --no-install-recommends "${missing[@]}" >"$build/packages.log"
}

# The source packages of CLN and GiNaC, from where the binary packages come: a copy of the lists of sources that asks
# for sources, which leaves the lists of the system as they are.
sources() {
  [ -e "$build/sources/complete" ] && return
  rm -rf "$build/sources" "$build/apt"
  mkdir -p "$build/sources" "$build/apt/lists/partial" "$build/apt/from"
  local file from=0
  for file in /etc/apt/sources.list.d/*.sources; do
    [ -e "$file" ] && grep -q debian-archive "$file" || continue
    sed 's/^Types:.*/Types: deb-src/' "$file" >"$build/apt/from/$(basename "$file")" && from=1
  done
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ -e "$file" ] && grep -q '^deb ' "$file" || continue
    sed -n 's/^deb /deb-src /p' "$file" >"$build/apt/from/$(basename "$file" .list).list" && from=1
  done
  [ $from = 1 ] || { echo "no list of sources of Debian in /etc/apt"; exit 5; }
  local apt=(apt-get -qq -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$build/apt/from" -o "Dir::State::Lists=$build/apt/lists")
  "${apt[@]}" update
  (cd "$build/sources" && "${apt[@]}" source cln ginac >"$build/sources.log" 2>&1)
  rm -rf "$build/apt"
  touch "$build/sources/complete"
}

libraries() {
  local key
  key=$(cat "$root"/web/{libraries,headers}.sh "$root"/web/libraries/* | sha256sum)
  [ "$key" = "$(cat "$build/root/complete" 2>/dev/null)" ] && return
  "$root/web/libraries.sh" "$build/sources" "$build/root"
  echo "$key" >"$build/root/complete"
}

configured() {
  "$root/web/configure.sh" "$build/program" "$build/root" >"$build/configured.log"
}

phase 'packages' packages
phase 'sources of CLN and GiNaC' sources
phase 'CLN and GiNaC' libraries
phase 'configuration' configured
phase 'program' cmake --build "$build/program" --target alembert
printf '%-44s %5d s\n' 'all' $((SECONDS - began))
node -e 'for (const file of process.argv.slice(1)) {
  const zlib = require("node:zlib"), bytes = require("node:fs").readFileSync(file), kB = (all) => Math.round(all.length / 1000);
  console.log(`${file.split("/").pop()}: ${kB(bytes)} kB, with gzip ${kB(zlib.gzipSync(bytes, { level: 9 }))} kB, ` +
    `with brotli ${kB(zlib.brotliCompressSync(bytes))} kB`);
}' "$build/alembert.wasm" "$build/alembert.mjs"
