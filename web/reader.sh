#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# What CMake calls in place of the compiler for web/read.sh: reader.sh em++ WORD... reads a source by the compiler that
# $ALEMBERT_READER names with its flags, and leaves an empty file where the object would be. Precompiled headers are made.
set -e
shift
words=()
object=
while [ $# -gt 0 ]; do
  case $1 in
    -emit-pch) exec $ALEMBERT_READER "${words[@]}" "$@" ;;
    -o) object=$2 && shift ;;
    -c) words+=(-fsyntax-only) ;;
    *) words+=("$1") ;;
  esac
  shift
done
$ALEMBERT_READER "${words[@]}"
: >"$object"
