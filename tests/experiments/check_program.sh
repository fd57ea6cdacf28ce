#!/usr/bin/env bash
# check_program.sh PROGRAM: what every experiment promises on the command line.
set -euo pipefail
program="$1"
name="$(basename "$program")"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$name: $*" >&2; exit 1; }

help="$("$program" --help)" || fail "--help fails"
for option in --out --quick --help; do
  grep -q -- "$option" <<<"$help" || fail "--help does not name $option"
done
code=0
"$program" --help >/dev/full 2>err || code=$?
[[ $code -eq 1 && $(wc -l <err) -eq 1 ]] || fail "a full standard output: exit code $code, $(cat err)"
rm err

# Each line is a wrong command line.
while read -r -a arguments; do
  code=0
  "$program" "${arguments[@]}" >out 2>err || code=$?
  [[ $code -eq 2 ]] || fail "'${arguments[*]}' ends with exit code $code, not 2"
  [[ $(wc -l <err) -eq 1 ]] || fail "'${arguments[*]}' gives not one line but: $(cat err)"
  grep -q "^$name: .*\.$" err || fail "'${arguments[*]}' does not give one sentence: $(cat err)"
  [[ ! -s out ]] || fail "'${arguments[*]}' writes to standard output"
  rm out err
  [[ -z "$(ls -A)" ]] || fail "'${arguments[*]}' leaves files"
done <<'ARGUMENTS'
--nonsense
stray
--out
--quick=3
--out here --out there
--optimizer nonsense
--formulation nonsense
--chord abc
--chord -1
--chord 0
--chord nan
ARGUMENTS

if grep -q -- --from <<<"$help"; then
  code=0
  "$program" --from nowhere --out here >out 2>err || code=$?
  [[ $code -eq 1 ]] || fail "without its inputs it ends with exit code $code, not 1"
  grep -q "make experiment NAME=" err || fail "without its inputs it does not say what makes them: $(cat err)"
  [[ ! -e here ]] || fail "without its inputs it leaves files"
fi
