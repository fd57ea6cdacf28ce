#!/usr/bin/env bash
# check_reprise.sh PROGRAM SOURCES: the program as a user runs it, from the examples and the help alone.
set -euo pipefail
program="$1"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/here" "$folder/there"
cd "$folder/here"
# A name without blanks, whatever the name of the sources' folder.
ln -s "$2/examples" "$folder/examples"
examples="$folder/examples"
fail() { echo "reprise: $*" >&2; exit 1; }

overview="$("$program" --help)"
for command in pose assemble workspace dextrous orientation conditioning synthesize compare sweep; do
  grep -q "^  $command " <<<"$overview" || fail "--help does not name $command"
  help="$("$program" "$command" --help)"
  grep -q -- --json <<<"$help" || fail "$command --help does not name --json"
  [[ "$("$program" help "$command")" == "$help" ]] || fail "help $command is not $command --help"
  # The examples of the help work (a few are slow, those of syntheses and sweeps are run elsewhere).
  [[ $command == synthesize || $command == compare || $command == sweep ]] && continue
  grep "^  reprise " <<<"$help" >examples
  [[ -s examples ]] || fail "$command --help has no examples"
  while read -r -a words; do
    (cd "$2" && "$program" "${words[@]:1}" >"$folder/out") || fail "an example of $command --help fails: ${words[*]}"
  done < <(sed -E "s| (--plot\|--out) | \1 $folder/there/|g" examples)
  rm examples
done
for kind in svg pdf png; do
  [[ -n $(find "$folder/there" -name "*.$kind" -size +0 -print -quit) ]] || fail "no example draws a $kind"
done
"$program" --version | grep '^reprise [0-9.]*$' >/dev/null || fail "--version"
"$program" help input | grep base_angle_deg >/dev/null || fail "help input"
"$program" help json | grep bifurcation_points >/dev/null || fail "help json"

# Each line is a wrong command line: exit code 2, one sentence, nothing on standard output, no file left.
while read -r -a arguments; do
  code=0
  "$program" "${arguments[@]}" >"$folder/out" 2>"$folder/err" || code=$?
  [[ $code -eq 2 ]] || fail "'${arguments[*]}' ends with exit code $code, not 2"
  [[ $(wc -l <"$folder/err") -eq 1 ]] || fail "'${arguments[*]}' gives not one line but: $(cat "$folder/err")"
  grep -q '^reprise.*: .*\.$' "$folder/err" || fail "'${arguments[*]}' does not give one sentence: $(cat "$folder/err")"
  [[ ! -s "$folder/out" ]] || fail "'${arguments[*]}' writes to standard output"
  [[ -z "$(ls -A)" ]] || fail "'${arguments[*]}' leaves files"
done <<ARGUMENTS

nonsense
help nonsense
completion tcsh
pose
pose $examples/M1.toml
pose $examples/M1.toml --at 1
pose $examples/M1.toml --at 1 x
pose $examples/M1.toml --at 1 2 3
pose $examples/M1.toml --at 1 nan
pose $examples/M1.toml stray --at 1 2
pose $examples/M1.toml --at 1 2 --nonsense
pose none.toml --at 1 2 --json --plot p.svg
pose $examples --at 1 2
pose /dev/null --at 1 2
assemble $examples/M1.toml --lengths 1 2
assemble $examples/M1.toml --lengths 1 2 -3
assemble $examples/two_legs.toml --lengths 1 2 3 --json
workspace $examples/M1.toml --chord 0 --out o
workspace $examples/M1.toml --exact --chord 0.1
workspace $examples/M1.toml --solver slsqp
workspace $examples/M1.toml --chord 0.1 --solver nonsense
workspace $examples/M1.toml --orientation inf --json
workspace $examples/M1.toml --plot p.gif --out o
dextrous $examples/M1.toml
dextrous $examples/M1.toml --range 5 -5
dextrous $examples/M1.toml --range -200 200
orientation $examples/M1.toml
conditioning $examples/M1.toml --grid 1
synthesize $examples/M1.toml --out o
synthesize $examples/P2.toml --optimizer nonsense
synthesize $examples/P2.toml --starts 0
compare $examples/P2.toml --optimizer slsqp,slsqp
ARGUMENTS

# A wrong file: the sentence has file, line and key, and nothing is written.
sed 's/length = .*/length = [[2, 1], [1, 2], [1, 2]]/' "$examples/M1.toml" >"$folder/reversed.toml"
code=0
"$program" workspace "$folder/reversed.toml" --json --plot p.svg --out o >"$folder/out" 2>"$folder/err" || code=$?
[[ $code -eq 2 && ! -s "$folder/out" && -z "$(ls -A)" ]] || fail "a wrong file: exit code $code, $(ls -A)"
grep -q 'reversed.toml, line [0-9]*: manipulator.length' "$folder/err" || fail "a wrong file gives: $(cat "$folder/err")"

"$2/tests/apps/check_refusals.sh" "$program" "$2"

# Tables and pictures appear whole, and nothing else does.
"$program" workspace "$examples/M1.toml" --out o --plot p.svg --json >"$folder/out"
[[ "$(ls -A . o | sort | tr '\n' ' ')" == *"bifurcation_points.csv boundary.csv o o: p.svg "* ]] || fail "files: $(ls -A . o)"
[[ "$(head -c 1 "$folder/out")" == '{' && "$(tail -c 2 "$folder/out")" == '}' ]] || fail "not one document"

# The completion knows commands, options and their values.
complete_line() {
  bash -c 'source <("$1" completion bash); shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _reprise; echo "${COMPREPLY[*]}"' \
    bash "$program" "$@"
}
[[ "$(complete_line reprise works)" == workspace ]] || fail "completion of a command: $(complete_line reprise works)"
[[ "$(complete_line reprise pose file --orient)" == --orientation ]] || fail "completion of an option"
[[ "$(complete_line reprise synthesize --formulation po)" == pointwise ]] || fail "completion of a value"
bash -n <("$program" completion zsh) || fail "the completion for zsh is no script"
"$program" completion fish | grep 'complete -c reprise .*-l orientation' >/dev/null || fail "the completion for fish"

# The tutorial works as it stands: its two files, then its commands in their order.
mkdir "$folder/tutorial"
cd "$folder/tutorial"
awk '/^```toml/ { n++; inside = 1; next } /^```/ { inside = 0 } inside { print > ("part" n) }' "$2/apps/reprise/tutorial.md"
cp part1 guess.toml
cat part1 part2 >problem.toml
grep '^    reprise ' "$2/apps/reprise/tutorial.md" >commands
[[ $(wc -l <commands) -ge 8 ]] || fail "the tutorial has lost its commands"
while read -r -a words; do
  "$program" "${words[@]:1}" >out || fail "a command of the tutorial fails: ${words[*]}"
done < <(sed "s/--starts 4 --max-evaluations 500/--starts 1 --max-evaluations 100/" commands)
for picture in $(sed -n 's/.*(tutorial\/\(.*\.png\)).*/\1/p' "$2/apps/reprise/tutorial.md"); do
  [[ -s "$picture" ]] || fail "the tutorial shows $picture, which its commands do not draw"
  [[ -s "$2/apps/reprise/tutorial/$picture" ]] || fail "the tutorial's picture $picture is missing"
done
"$program" orientation found/manipulator.toml --at 29 119 >out
grep -q from out || fail "the tutorial's design does not reach a corner of its workspace"
