#!/usr/bin/env bash
# check_manifest.sh SOURCE: the manifest names every program of experiments/, and nothing else.
set -euo pipefail
cd "$1/experiments"
failed=0
fail() { echo "manifest: $*" >&2; failed=1; }

mapfile -t programs < <(../scripts/manifest rows | cut -d '|' -f 1)
[[ ${#programs[@]} -gt 0 ]] || fail "it names no program"
declare -A is_program
for program in "${programs[@]}"; do is_program[$program]=yes; done
known() { [[ -n ${is_program[$1]:-} ]]; }
while IFS='|' read -r program item title inputs pictures seconds; do
  [[ -f "$program.cpp" ]] || fail "$program has no $program.cpp"
  [[ -n $item && -n $title ]] || fail "$program has no thesis item or no title"
  [[ $item$title != *[\;\"\\]* ]] || fail "the item or the title of $program has a sign that CMake or C++ would take apart"
  [[ $seconds =~ ^[1-9][0-9]*$ ]] || fail "$program has no whole number of seconds"
  for input in $inputs; do
    if [[ $input == */* ]]; then
      compgen -G "../$input" >/dev/null || fail "$program reads $input, which is not there"
    else
      known "$input" || fail "$program reads results of $input, which is not in the manifest"
    fi
  done
  for picture in $pictures; do
    [[ $picture == "$program" || $picture == "$program"_* ]] || fail "the picture $picture is not named after $program"
  done
done < <(../scripts/manifest rows)
for file in *.cpp; do
  known "${file%.cpp}" || fail "$file is missing from it"
done
[[ -z "$(printf '%s\n' "${programs[@]}" | sort | uniq -d)" ]] || fail "a program comes twice"
exit "$failed"
