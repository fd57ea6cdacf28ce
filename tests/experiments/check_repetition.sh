#!/usr/bin/env bash
# check_repetition.sh PROGRAMS SOURCE: run twice, with one thread and with several, every program writes the same bytes,
# except for times, which stand in tables whose names end in _times.
set -euo pipefail
programs="$1"
source="$2"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
fail() { echo "repetition: $*" >&2; exit 1; }

# The programs in an order in which each finds its inputs.
mapfile -t order < <("$source/scripts/manifest" order)

run() {
  local results="$folder/$1"
  mkdir "$results"
  for program in "${order[@]}"; do
    arguments=(--quick --out "$results/$program")
    if [[ $("$programs/$program" --help) == *--from* ]]; then arguments+=(--from "$results"); fi
    OMP_NUM_THREADS="$2" OPENBLAS_NUM_THREADS="$2" "$programs/$program" "${arguments[@]}" >/dev/null ||
      fail "$program fails"
  done
}
run first 1 &
run second 3
wait $! || fail "the first run fails"

# A table without its column of seconds, which no two runs have the same.
without_seconds() {
  awk -F , '/^#/ { print; next }
    !header { header = 1; for (i = 1; i <= NF; ++i) if ($i == "seconds") skipped = i }
    { for (i = 1; i <= NF; ++i) if (i != skipped) printf "%s,", $i; print "" }' "$1"
}

count=0
while read -r file; do
  cmp <(without_seconds "$folder/first/$file") <(without_seconds "$folder/second/$file") || fail "$file is not the same"
  count=$((count + 1))
done < <(cd "$folder/first" && find . -name '*.csv' ! -name '*_times.csv')
[[ $count -ge ${#order[@]} ]] || fail "only $count tables were written"
[[ "$(cd "$folder/first" && find . -type f | sort)" == "$(cd "$folder/second" && find . -type f | sort)" ]] ||
  fail "not the same files were written"
