#!/usr/bin/env bash
# check_environment.sh SOURCE REPRISE EXPERIMENT...: the same bytes of every table and picture, and of what is printed, in
# every environment.
set -euo pipefail
examples="$1/examples"
reprise="$2"
shift 2
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
fail() { echo "environment: $*" >&2; exit 1; }

# Languages with a decimal comma, and with an i that is no I in capitals. Debian keeps only their sources.
for language in de_DE tr_TR; do
  localedef -i "$language" -f UTF-8 "$folder/$language.UTF-8" || fail "the package locales is not installed"
done
[[ "$(LOCPATH="$folder" LC_ALL=de_DE.UTF-8 locale decimal_point)" == , ]] || fail "de_DE.UTF-8 has no decimal comma"

# run NAME VARIABLE=VALUE...: all programs with nothing else in the environment.
run() {
  local name="$1" program
  shift
  mkdir -p "$folder/$name/reprise"
  for program in "${programs[@]}"; do
    env --ignore-environment PATH="$PATH" LOCPATH="$folder" "$@" "$program" --out "$folder/$name/$(basename "$program")" \
      >/dev/null 2>"$folder/error" || fail "$(basename "$program") fails with '$*': $(cat "$folder/error")"
  done
  cd "$folder/$name/reprise"
  ln -s "$examples" examples
  while read -r -a words; do
    env --ignore-environment PATH="$PATH" LOCPATH="$folder" "$@" "$reprise" "${words[@]}" \
      >"${words[0]}.txt" 2>"$folder/error" || fail "reprise ${words[0]} fails with '$*': $(cat "$folder/error")"
  done <<'COMMANDS'
pose examples/M1.toml --at 1 1.5 --plot pose.svg
workspace examples/M1.toml --orientation 0 --out workspace --plot workspace.svg --json
COMMANDS
}
programs=("$@")
run reference LC_ALL=C.UTF-8 HOME="$folder" TERM=xterm TMPDIR="$folder"
count="$(cd "$folder/reference" && find . -name '*.csv' -o -name '*.svg' -o -name '*.txt' | wc -l)"
[[ "$count" -ge $((2 * $# + 4)) ]] || fail "only $count tables and pictures were made"

compare() {
  run "$@"
  while read -r file; do
    cmp "$folder/reference/$file" "$folder/$1/$file" || fail "with '${*:2}' $file is not the same"
  done < <(cd "$folder/reference" && find . -name '*.csv' -o -name '*.svg' -o -name '*.txt')
}
compare nothing
compare posix LC_ALL=C HOME="$folder"
compare german LC_ALL=de_DE.UTF-8 HOME="$folder" TERM=dumb
compare turkish LANG=tr_TR.UTF-8 HOME=/nonexistent
compare unknown LANG=xx_XX.UTF-8 TMPDIR=/nonexistent HOME="$folder" TERM=nonsense
