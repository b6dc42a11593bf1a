#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Completes command lines as bash does: check_completion.bash COMPLETION_FILE. Fails, naming what differs.
set -uo pipefail
source "$1"
cd "$(mktemp -d)" || exit 1
trap 'rm -rf "$PWD"' EXIT
touch 'a mesh.off' apple.obj
mkdir attic
failures=0
complete -p lodestone > /dev/null || failures=1

# expect 'PROPOSAL PROPOSAL...' WORD...: the last word is the one at the cursor.
expect() {
  local expected=$1 found
  shift
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  _lodestone
  found=$(printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd ' ')
  [ "$found" = "$expected" ] && return
  echo "$*: expected '$expected', found '$found'"
  failures=$((failures + 1))
}

expect 'detect' lodestone de
expect '--version' lodestone --v
expect '--points' lodestone detect --po
expect 'certified exact particles senin' lodestone detect --mode ''
expect 'certified' lodestone detect --mode c
expect 'particles' lodestone detect --mode = p
expect 'certified exact particles senin' lodestone detect --mode =
expect 'a mesh.off apple.obj attic' lodestone detect a
expect 'a mesh.off apple.obj attic' lodestone detect x.off a
expect 'attic' lodestone detect x.off --out a
expect 'apple.obj' lodestone convert x.off --mesh ap
expect '' lodestone detect --particles ''
expect 'median_split metis' lodestone partition a.off --strategy me
expect 'teapot_sphere' lodestone experiment teapot
expect '--strategy-file' lodestone experiment partitions --strat
[ "$failures" -eq 0 ]
