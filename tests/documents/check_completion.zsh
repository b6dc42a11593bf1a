#!/usr/bin/env zsh
# SPDX-License-Identifier: GPL-3.0-or-later
# Completes command lines in an interactive zsh: check_completion.zsh COMPLETION_FILE. Fails, naming what is missing.
emulate -R zsh
zmodload zsh/zpty
typeset -i failures=0
folder=$(mktemp -d)
trap 'rm -rf $folder' EXIT
cp $1 $folder/_lodestone
touch $folder/apple.obj

# expect WORD LINE: with the cursor at the end of LINE, the tabulator inserts or lists WORD.
expect() {
  local word=$1 line=$2 seen= part
  zpty shell "cd $folder && TERM=dumb ZDOTDIR=$folder zsh -f -i"
  zpty -w shell "PROMPT=; fpath=($folder \$fpath); autoload -Uz compinit; compinit -D -u; LISTMAX=1000; print re''ady"
  zpty -r shell part '*ready*'
  zpty -w -n shell "lodestone $line"$'\t\t'
  local -i end=$((SECONDS + 10))
  while ((SECONDS < end)) && [[ $seen != *$word* ]]; do
    zpty -r -t shell part && seen+=$part || sleep 0.05
  done
  zpty -d shell
  [[ $seen == *$word* ]] && return
  print -r -- "lodestone $line: expected $word, found ${(V)seen}"
  failures+=1
}

zsh -n $1 || failures+=1
expect convert conv
expect --points 'detect --poi'
expect certified 'detect --mode '
expect senin 'detect --mode=s'
expect apple.obj 'detect x.off a'
expect metis 'partition apple.obj --strategy me'
expect teapot_sphere 'experiment te'
((failures == 0))
