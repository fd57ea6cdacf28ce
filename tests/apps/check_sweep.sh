#!/usr/bin/env bash
# check_sweep.sh PROGRAM SOURCES: a sweep gives the same bytes however the work is divided or cut short, and a study that
# is wrong is refused before anything is written.
set -euo pipefail
program="$1"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "sweep: $*" >&2; exit 1; }
cp "$2"/examples/{M1,P2}.toml .

cat >areas.toml <<'TOML'
[sweep]
problem = "M1.toml"
compute = "workspace"
orientation_deg = 5
[[vary]]
key = "manipulator.design[0]"
from = -1.5
to = 0.5
count = 21
[[vary]]
name = "longest"
keys = ["manipulator.length[0][1]", "manipulator.length[1][1]"]
from = 1
to = 4
count = 13
spacing = "logarithmic"
TOML
"$program" sweep areas.toml --out whole >said || fail "a right study fails: $(cat said)"
[[ $(ls whole/blocks | wc -l) -eq 18 && -s whole/sweep.svg && -s whole/sweep.png ]] || fail "files are missing: $(ls whole)"
# The point (-1, 2) of M1 itself, by the program's other command.
area="$(awk -F , '$2 == -1 && $3 > 1.99 && $3 < 2.01 { print $3, $5 }' whole/sweep.csv)"
sed "s/^length = .*/length = [[\"sqrt(2)\", ${area% *}], [\"sqrt(2)\", ${area% *}], [1, \"sqrt(3)\"]]/" M1.toml >one.toml
"$program" workspace one.toml --orientation 5 --json >said
grep -q "^ \"area\": ${area#* },$" said ||
  fail "the area of a point is not that of the command workspace: $area"
# Where the shortest length is above the longest, the row says so.
grep -q '^[0-9]*,-1.5,1,wrong_input,,,,.*M1.toml, line [0-9]*: .*length' whole/sweep.csv || fail "a wrong point does not say what is wrong"

# Shares in any order, one of them missing at first; then all together.
for part in 3/4 1/4 4/4; do "$program" sweep areas.toml --out shares --part "$part" >said; done
code=0
"$program" sweep --merge shares >said || code=$?
[[ $code -eq 1 && ! -e shares/sweep.csv ]] || fail "a sweep that lacks a share is put together"
grep -q 'missing are the blocks 1, 5, 9, 13, 17\.' said || fail "what is missing is not said: $(cat said)"
"$program" sweep areas.toml --out shares --part 2/4 >said
"$program" sweep --merge shares >said || fail "shares are not put together: $(cat said)"
diff -r whole shares || fail "shares give other bytes"
cp shares/sweep.csv before
"$program" sweep areas.toml --out shares >said
grep -q '^0 blocks computed now' said || fail "what is there is computed again: $(cat said)"
cmp before shares/sweep.csv || fail "a second run gives other bytes"

# Syntheses, killed again and again; what a block holds depends on that block alone.
cat >designs.toml <<'TOML'
[sweep]
problem = "P2.toml"
compute = "synthesize"
[[vary]]
key = "workspace.semi_axes[0]"
from = 1.7
to = 1.75
count = 2
[[vary]]
key = "workspace.centre[1]"
from = 1.4
to = 1.6
count = 10
TOML
"$program" sweep designs.toml --out designs >said || fail "syntheses fail: $(cat said)"
for _ in 1 2 3; do
  "$program" sweep designs.toml --out killed >said 2>&1 &
  sleep 0.4
  kill -9 $! 2>/dev/null || true
  wait $! 2>/dev/null || true
done
"$program" sweep designs.toml --out killed >said || fail "a sweep does not go on after it was killed: $(cat said)"
diff -r designs killed || fail "a sweep that was killed gives other bytes"
[[ $(grep -c ',found,' designs/sweep.csv) -eq 20 ]] || fail "not all designs near P2 were found"

# Sobol's points fill the box: a quarter of a sample of 64 in each quarter of it.
cat >sample.toml <<'TOML'
[sweep]
problem = "M1.toml"
compute = "pose"
at = [1, 1.5]
sample = 64
[[vary]]
key = "manipulator.design[0]"
from = -2
to = 2
[[vary]]
key = "manipulator.design[3]"
from = 0
to = 4
TOML
"$program" sweep sample.toml --out sample >said || fail "a sample fails: $(cat said)"
counts="$(awk -F , '/^[0-9]/ { ++n[($2 > 0) 2 * ($3 > 2)] } END { for (k in n) print n[k] }' sample/sweep.csv | sort -u | tr '\n' ' ')"
for count in $counts; do [[ $count -ge 15 && $count -le 17 ]] || fail "the sample is not spread evenly: $counts"; done

# Wrong studies and command lines: exit code 2, one sentence, nothing written. refuse WORDS... with the study on input.
refuse() {
  local code=0
  cat >wrong.toml
  "$program" sweep wrong.toml --out wrong >said 2>err || code=$?
  [[ $code -eq 2 && ! -e wrong && ! -s said ]] || fail "exit code $code for '$1': $(cat err)"
  [[ $(wc -l <err) -eq 1 ]] || fail "not one line but: $(cat err)"
  grep -qF -- "$1" err || fail "'$1' is not in: $(cat err)"
}
study() { printf '[sweep]\nproblem = "M1.toml"\ncompute = "workspace"\n[[vary]]\n'; printf '%s\n' "$@"; }
refuse "has nothing of that name" < <(study 'key = "manipulator.designs[0]"' 'values = [1]')
refuse "has no number there" < <(study 'key = "manipulator.name"' 'values = [1]')
refuse "1000000000000 points, but at most 10000000" < <(study 'key = "manipulator.design[0]"' 'from = 0' 'to = 1' 'count = 1_000_000' \
  '[[vary]]' 'key = "manipulator.design[1]"' 'from = 0' 'to = 1' 'count = 1_000_000')
refuse "above 'from'" < <(study 'key = "manipulator.design[0]"' 'from = 1' 'to = 1' 'count = 3')
refuse "a list of 1 to" < <(study 'key = "manipulator.design[0]"' 'values = []')
refuse "the spacing is logarithmic" < <(study 'key = "manipulator.design[0]"' 'from = 0' 'to = 1' 'count = 3' 'spacing = "logarithmic"')
refuse "takes its manipulator from another file" < <(printf '[sweep]\nproblem = "P2.toml"\ncompute = "synthesize"\n[[vary]]\nkey = "manipulator.design[0]"\nvalues = [1]\n')
refuse "have the name" < <(study 'key = "manipulator.design[0]"' 'values = [1]' '[[vary]]' 'key = "manipulator.design[0]"' 'values = [1]')
refuse "did you mean 'values'" < <(study 'key = "manipulator.design[0]"' 'valeus = [1]')
refuse "a whole number" < <(study 'key = "manipulator.design[0]"' 'from = 0' 'to = 1' 'count = 2.5')
for part in 0/3 4/3 1 1/ a/b 1/3x; do
  code=0
  "$program" sweep areas.toml --out wrong --part "$part" >said 2>err || code=$?
  [[ $code -eq 2 && ! -e wrong ]] || fail "--part $part ends with exit code $code"
done
code=0
"$program" sweep sample.toml --out whole >said 2>err || code=$?
[[ $code -eq 2 ]] && grep -q 'holds another sweep' err || fail "another study is mixed in: $code, $(cat err)"
code=0
"$program" sweep --merge nowhere >said 2>err || code=$?
[[ $code -eq 2 ]] && grep -q 'holds no sweep' err || fail "nothing is put together: $code, $(cat err)"
