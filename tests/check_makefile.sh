#!/usr/bin/env bash
# check_makefile.sh SOURCE: what a NAME chooses, and that two makes in one folder do not run at once.
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cp -r "$1"/{Makefile,CMakePresets.json,experiments,data,scripts} "$folder"
cd "$folder"
# This may itself run below a make.
unset MAKEFLAGS MAKELEVEL MFLAGS LOCKED
fail() { echo "Makefile: $*" >&2; exit 1; }
chosen() { LOCKED="$folder" make --dry-run SETUP=skip experiment NAME="$1" 2>&1 | sed -n 's%^build/bin/\([^ ]*\) .*--out.*%\1%p' | tail -n 1; }

# A table or figure is known by its number, although other numbers begin with the same digits, and by its whole name.
while read -r number program; do
  [[ "$(chosen "$number")" == "$program" ]] || fail "NAME=$number means not $program but '$(chosen "$number")'"
done < <(scripts/manifest order | sed -n 's/^\(\(table\|figure\)_[0-9]*_[0-9]*\)_.*/\1 &/p')
[[ "$(chosen verify)" == verify ]] || fail "NAME=verify means '$(chosen verify)'"
[[ "$(chosen check_d)" == check_d_below_mo ]] || fail "NAME=check_d means '$(chosen check_d)'"

# Each of these names no program, or more than one.
for name in "" figure_5 figure_5_ nothing compare; do
  ! LOCKED="$folder" make --dry-run SETUP=skip experiment NAME="$name" >out 2>&1 || fail "NAME=$name is taken"
  grep -q 'NAME=' out || fail "NAME=$name gives: $(cat out)"
done

# A second make waits until the first has ended, and says so.
mkdir -p build
mkfifo go
flock build/.lock cat go &
while flock --nonblock build/.lock true; do sleep 0.05; done
make clean >out 2>&1 &
until grep -q 'Another make is at work' out; do sleep 0.05; done
[[ -d build ]] || fail "a second make does not wait"
echo >go
wait
[[ ! -e build ]] || fail "a second make does nothing when the first has ended: $(cat out)"
