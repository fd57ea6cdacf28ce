#!/usr/bin/env bash
# check_refusals.sh PROGRAM SOURCES: what was found is not lost when a file, a picture or standard output refuses, and
# nothing is left behind. Every refusal is one line on standard error.
set -euo pipefail
program="$1"
folder="$(mktemp -d)"
unmount() { if mountpoint -q "$1"; then umount "$1"; fi; }
trap 'unmount "$folder/small"; unmount "$folder/sealed"; rm -rf "$folder"' EXIT
mkdir "$folder/here" "$folder/programs"
# A name without blanks, whatever the name of the sources' folder.
ln -s "$2/examples" "$folder/examples"
example="$folder/examples/M1.toml"
cd "$folder/here"
fail() { echo "refusals: $*" >&2; exit 1; }

# refused CODE WORDS... -- what the program says on standard error must hold $wanted.
refused() {
  local expected="$1" code=0
  shift
  # Through a pipe, so that a limit on the size of files does not hold for the answer.
  "$@" 2>"$folder/err" | cat >"$folder/out" || code=$?
  [[ $code -eq $expected ]] || fail "'$*' ends with exit code $code, not $expected: $(cat "$folder/err")"
  [[ $(wc -l <"$folder/err") -eq 1 ]] || fail "'$*' gives not one line but: $(cat "$folder/err")"
  grep -q "$wanted" "$folder/err" || fail "'$*' does not say '$wanted' but: $(cat "$folder/err")"
}
untouched() { [[ -z "$(ls -A)" ]] || fail "$1 leaves $(ls -A)"; }
"$program" pose "$example" --at 1 1.5 >"$folder/answer"
# What a run without a fault writes, before the faults and after each of them: the same bytes.
mkdir "$folder/tables"
"$program" conditioning "$example" --out "$folder/tables" --plot "$folder/tables/x.svg" >/dev/null
again() {
  rm -rf "$folder/again" && mkdir "$folder/again"
  "$program" conditioning "$example" --out "$folder/again" --plot "$folder/again/x.svg" >/dev/null 2>&1 ||
    fail "$1: the next run fails"
  diff -r "$folder/tables" "$folder/again" >/dev/null || fail "$1: the next run writes something else"
}
answered() { cmp -s "$folder/out" "$folder/answer" || fail "$1: the answer is not printed whole"; }

# Before anything is computed: exit code 2, no answer, nothing made.
wanted='no folder'
for target in "--plot none/x.svg" "--plot /nonexistent/x.svg" "--out none/o" "--out /dev/null/o"; do
  refused 2 "$program" workspace "$example" ${target% *} "${target#* }"
  [[ ! -s "$folder/out" ]] || fail "$target: something is printed"
done
untouched "a folder that is not there"
wanted='that is'
mkdir "$folder/x.svg"
refused 2 "$program" pose "$example" --at 1 1.5 --plot "$folder/x.svg"
refused 2 "$program" workspace "$example" --out "$example"

# An output that is the input, by whatever name.
cp "$2/examples/P2.toml" manipulator.toml
cp manipulator.toml "$folder/kept"
ln -s manipulator.toml link.toml
mkdir other
ln manipulator.toml other/manipulator.toml
cp manipulator.toml picture.svg
wanted='is the input'
refused 2 "$program" synthesize manipulator.toml --out .
refused 2 "$program" synthesize link.toml --out .
refused 2 "$program" synthesize manipulator.toml --out other
refused 2 "$program" pose picture.svg --at 1 1.5 --plot picture.svg
cmp manipulator.toml "$folder/kept" || fail "the input is not as it was"
rm -r manipulator.toml link.toml other picture.svg

# A new folder is made, and said to be.
wanted='made the folder'
refused 0 "$program" workspace "$example" --out new
[[ -s new/boundary.csv ]] || fail "no table in a new folder"
rm -r new

# gnuplot missing, failing, hanging, or without an end to its picture: the answer first, then a sentence.
gnuplot() { printf '#!/bin/sh\n%s\n' "$1" >"$folder/programs/gnuplot"; chmod +x "$folder/programs/gnuplot"; }
pose=("$program" pose "$example" --at 1 1.5 --plot x.svg)
wanted='x.svg is not drawn: gnuplot'
mkdir "$folder/empty"
PATH="$folder/empty" ; code=0; "${pose[@]}" >"$folder/out" 2>"$folder/err" || code=$?; PATH=/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin
[[ $code -eq 1 ]] && grep -q "$wanted" "$folder/err" || fail "without gnuplot: exit code $code, $(cat "$folder/err")"
answered "without gnuplot"
real="$(type -P gnuplot)"
PATH="$folder/programs:$PATH"
gnuplot 'echo broken >&2; exit 3'
refused 1 "${pose[@]}"; answered "gnuplot fails"
gnuplot "$real \"\$@\" | head -c 300"
refused 1 "${pose[@]}"; answered "half a picture"
gnuplot 'kill -KILL $$'
refused 1 "${pose[@]}"; answered "gnuplot is killed"
untouched "a picture that fails"

# A signal while gnuplot draws: the answer is there, gnuplot and its children are gone, nothing is left. The reader of
# the pipe ends when no process holds the other end open.
gnuplot "echo \$\$ >$folder/pid; sleep 1000 & sleep 1000"
mkfifo "$folder/held"
for signal in INT TERM HUP; do
  rm -f "$folder/pid"
  timeout 20 cat "$folder/held" &
  reader=$!
  env --default-signal "${pose[@]}" >"$folder/out" 2>"$folder/err" 9>"$folder/held" &
  job=$!
  until [[ -s "$folder/pid" ]]; do sleep 0.02; done
  kill -s "$signal" "$job"
  code=0
  wait "$job" || code=$?
  [[ $code -eq $((128 + $(kill -l "$signal"))) ]] || fail "SIG$signal while drawing: exit code $code"
  answered "SIG$signal while drawing"
  wait "$reader" || fail "SIG$signal: gnuplot goes on"
done
untouched "a signal"

# One that warns has drawn: the picture, and the warning once.
gnuplot "echo 'warning: no font' >&2; exec $real \"\$@\""
wanted='warning: no font'
refused 0 "${pose[@]}"; answered "a warning"
tail -c 8 x.svg | grep -q '</svg>' || fail "a warning takes the picture"
PATH="${PATH#*:}"
again "gnuplot"

# A symbolic link stays.
mkdir "$folder/there"
ln -sf "$folder/there/y.svg" x.svg
"${pose[@]}" >/dev/null
[[ -L x.svg && -s "$folder/there/y.svg" ]] || fail "a symbolic link is replaced"
rm x.svg

# Files that may not grow, and a full disk: the answer, one sentence, the old picture, nothing left.
echo old >x.svg
wanted='x.svg'
refused 1 bash -c 'ulimit -f 1; exec "$@"' bash "${pose[@]}"; answered "ulimit -f"
wanted='map.csv'
refused 1 bash -c 'ulimit -f 1; exec "$@"' bash "$program" conditioning "$example" --out .
[[ "$(ls -A)" == x.svg && "$(cat x.svg)" == old ]] || fail "ulimit -f leaves $(ls -A)"
rm x.svg
mkdir "$folder/small"
if mount -t tmpfs -o size=8k tmpfs "$folder/small" 2>/dev/null; then
  echo old >"$folder/small/x.svg"
  wanted='No space left'
  refused 1 "$program" pose "$example" --at 1 1.5 --plot "$folder/small/x.svg"; answered "a full disk"
  refused 1 "$program" conditioning "$example" --out "$folder/small"
  [[ "$(ls -A "$folder/small")" == x.svg && "$(cat "$folder/small/x.svg")" == old ]] ||
    fail "a full disk leaves $(ls -A "$folder/small")"
  again "a full disk"
else
  echo "refusals: nothing can be mounted here, so the full disk is left out"
fi

# A folder on a disk that may only be read: seen before anything is computed.
mkdir "$folder/sealed"
if mount -t tmpfs -o size=1m tmpfs "$folder/sealed" 2>/dev/null; then
  echo old >"$folder/sealed/x.svg"
  mount -o remount,ro "$folder/sealed"
  wanted='may not be written'
  for target in "--plot $folder/sealed/x.svg" "--plot $folder/sealed/y.svg" "--out $folder/sealed"; do
    refused 2 "$program" conditioning "$example" ${target% *} "${target#* }"
    [[ ! -s "$folder/out" ]] || fail "$target: something is printed"
  done
  wanted='no folder may be made'
  refused 2 "$program" conditioning "$example" --out "$folder/sealed/new"
  [[ "$(ls -A "$folder/sealed")" == x.svg && "$(cat "$folder/sealed/x.svg")" == old ]] ||
    fail "a disk that may only be read holds $(ls -A "$folder/sealed")"
  again "a disk that may only be read"
else
  echo "refusals: nothing can be mounted here, so the disk that may only be read is left out"
fi

# Standard output full, closed or gone: exit code 1 and a sentence; tables are written all the same.
wanted='standard output'
full() { "$@" >/dev/full; }
closed() { "$@" >&-; }
for words in "--help" "help json" "pose --help" "pose $example --at 1 1.5" "workspace $example --json"; do
  refused 1 full "$program" $words
  refused 1 closed "$program" $words
done
code=0
"$program" workspace "$example" --out new >/dev/full 2>"$folder/err" || code=$?
[[ $code -eq 1 && -s new/boundary.csv ]] || fail "a full standard output takes the tables: exit code $code"
rm -r new
untouched "standard output"
