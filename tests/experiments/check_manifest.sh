#!/usr/bin/env bash
# check_manifest.sh SOURCE: the manifest names every program of experiments/, and nothing else.
set -euo pipefail
cd "$1/experiments"
failed=0
fail() { echo "manifest: $*" >&2; failed=1; }

mapfile -t rows < <(grep -v '^#' manifest | grep '|')
programs=()
for row in "${rows[@]}"; do
  IFS='|' read -r program item title inputs pictures seconds <<<"$row"
  program="$(xargs <<<"$program")"
  programs+=("$program")
  [[ -f "$program.cpp" ]] || fail "$program has no $program.cpp"
  [[ -n "$(xargs <<<"$item")" && -n "$(xargs <<<"$title")" ]] || fail "$program has no thesis item or no title"
  [[ "$(xargs <<<"$seconds")" =~ ^[1-9][0-9]*$ ]] || fail "$program has no whole number of seconds"
  for input in $inputs; do
    if [[ $input == */* ]]; then
      [[ -e ../$input ]] || fail "$program reads $input, which is not there"
    else
      grep -q "^$input *|" manifest || fail "$program reads results of $input, which is not in the manifest"
    fi
  done
  for picture in $pictures; do
    [[ $picture == "$program" || $picture == "$program"_* ]] || fail "the picture $picture is not named after $program"
  done
done
for file in *.cpp; do
  printf '%s\n' "${programs[@]}" | grep -qx "${file%.cpp}" || fail "$file is missing from it"
done
[[ -z "$(printf '%s\n' "${programs[@]}" | sort | uniq -d)" ]] || fail "a program comes twice"
exit "$failed"
