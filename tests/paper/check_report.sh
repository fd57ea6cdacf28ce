#!/usr/bin/env bash
# check_report.sh SOURCE: the report draws what is there, and is not made when a name is wrong.
set -euo pipefail
source="$1"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
fail() { echo "report: $*" >&2; exit 1; }

# A source tree and results of our own: one program with a table and a picture.
mkdir -p "$folder"/{source/paper,source/experiments,source/scripts,source/data/published,results/maker}
cp "$source"/paper/{build,results.lua,formulas.js,style.css,print.css} "$folder/source/paper"
cp "$source/scripts/manifest" "$folder/source/scripts"
echo 'maker | Table 9 | A title | | maker | 1' >"$folder/source/experiments/manifest"
cat >"$folder/results/maker/maker.csv" <<'CSV'
# A title
# workspace [-]: a name
workspace,value,small,count,empty,text
P1,0.91234,-2.5e-06,21,,"a, ""b"""
P2,-0.5,1e-10,17,,c
CSV
cat >"$folder/results/maker/maker.json" <<'JSON'
{"program": "maker", "options": {"--chord": 0.02, "--quick": false, "--list": ["a", "b"]},
 "source": {"commit": "0123456789abcdef", "dirty": false}, "libraries": {"Eigen": "3.4.0"},
 "build": {"compiler": "GNU \"12\"", "type": "Release", "flags": "-O3"}, "processor": "a processor",
 "finished": "2001-02-03T04:05:06Z", "seconds": 1.25, "measured": {"P1 21": 0.125, "P2 17": 0.25}, "inputs": {}, "outputs": []}
JSON
echo '<svg width="100" xmlns="http://www.w3.org/2000/svg"></svg>' >"$folder/results/maker/maker.svg"
base64 --decode >"$folder/results/maker/maker.png" <<<"iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNgAAAAAgABSK+kcQAAAABJRU5ErkJggg=="
cp "$source/data/published/table_5_3.csv" "$folder/source/data/published"

build() {
  cat >"$folder/source/paper/00.md"
  rm -rf "$folder/out"
  "$folder/source/paper/build" "$folder/results" "$folder/out" >"$folder/said" 2>&1
}

build <<'MARKDOWN' || fail "a right report is not made: $(cat "$folder/said")"
---
title: A report
---
Number [`maker value workspace=P1`{.value format="%.3f"}], [`maker small workspace=P1`{.value format="%.1e"}],
[`maker text workspace=P1`{.value}], [`published/table_5_3 N_g workspace=P3`{.value format="%d"}],
setting [`maker --chord`{.setting}], [`maker --list`{.setting}], formula $x^2$.

$$\sqrt{\frac{1}{r}}$$

``` {.table}
table: maker
where: workspace=P2
column: workspace | **name**
column: value - small | difference | %+.2f
column: empty
caption: A *caption*.
```

``` {.table}
table: maker
measured: workspace count
column: measured | seconds | %.3f
caption: Times.
```

``` {.figure}
figure: maker
caption: A figure.
```

``` {.manifest}
```

``` {.provenance}
```
MARKDOWN
html="$(tr '\n' ' ' <"$folder/out/report.html")"  # pandoc breaks lines where it likes
for part in '[0.912]' $'[−2.5\u00a0×\u00a010⁻⁶]' '[a, &quot;b&quot;]' '[71]' '[0.02]' '[a, b]' '<strong>name</strong>' '−0.50' '0.125' '0.250' \
  '<em>caption</em>' '<math ' 'data:image/svg' 'make experiment NAME=maker' '2001-02-03, commit 0123456789ab' 'a processor'; do
  [[ $html == *"$part"* ]] || fail "'$part' is not in the report"
done
[[ $(ls -A "$folder/out") == $'report.html\nreport.pdf' ]] || fail "not just the report is left behind"
[[ "$(head -c 5 "$folder/out/report.pdf")" == "%PDF-" ]] || fail "report.pdf is no PDF"
grep -qa KaTeX "$folder/out/report.pdf" || fail "the printed formulas are not set by KaTeX"
! grep -qa 'MediaBox \[ 0 0 841' "$folder/out/report.pdf" || fail "narrow tables are on a turned page"

mv "$folder/out" "$folder/first"
"$folder/source/paper/build" "$folder/results" "$folder/out" >"$folder/said" 2>&1 || fail "it is made only once"
diff -r "$folder/first" "$folder/out" || fail "the same results give another report"
env --ignore-environment PATH="$PATH" TMPDIR=/nonexistent "$folder/source/paper/build" "$folder/results" "$folder/out" \
  >"$folder/said" 2>&1 || fail "it is not made in an empty environment: $(cat "$folder/said")"
diff -r "$folder/first" "$folder/out" || fail "an empty environment gives another report"

# Results that were made without git say so.
cp "$folder/results/maker/maker.json" "$folder/with_git.json"
sed -i 's/"commit": "[0-9a-f]*", "dirty": false/"commit": null, "dirty": null/' "$folder/results/maker/maker.json"
printf -- '---\ntitle: A report\n---\n``` {.provenance}\n```\n' | build || fail "no report without a commit: $(cat "$folder/said")"
grep -q 'commit unknown' "$folder/out/report.html" || fail "without a commit the report does not say that it is unknown"
cp "$folder/with_git.json" "$folder/results/maker/maker.json"

# A table that is too wide for a page goes on a turned one.
{ printf -- '---\ntitle: A report\n---\n``` {.table}\ntable: maker\n'; printf 'column: workspace | aVeryLongHeading%d\n' {1..9}; printf '```\n'; } | build ||
  fail "a wide table is not made: $(cat "$folder/said")"
grep -qa 'MediaBox \[ 0 0 841' "$folder/out/report.pdf" || fail "a wide table is not on a turned page"

# Each wrong block must stop the build with one sentence that holds the text after the name of the case.
refuse() {
  local expected="$1"
  if build; then fail "a report with a mistake is made ($expected)"; fi
  [[ $(wc -l <"$folder/said") -eq 1 ]] || fail "not one sentence but: $(cat "$folder/said")"
  grep -qF -- "$expected" "$folder/said" || fail "'$expected' is not in: $(cat "$folder/said")"
  [[ -z "$(ls -A "$folder/out")" ]] || fail "a failed build leaves files"
}
refuse "no program for the result 'nothing'" <<<'`nothing value workspace=P1`{.value}'
refuse "no column 'nothing'" <<<'`maker nothing workspace=P1`{.value}'
refuse "no column 'nothing'" <<<'`maker value nothing=P1`{.value}'
refuse "no row with workspace=P9" <<<'`maker value workspace=P9`{.value}'
refuse "means 2 rows" <<<'`maker value`{.value}'
refuse "'P1' is not a number" <<<'`maker workspace workspace=P1`{.value format="%.3f"}'
refuse "no option '--nothing'" <<<'`maker --nothing`{.setting}'
refuse "maker_part.csv is not there; run 'make experiment NAME=maker' first" <<<'`maker_part value`{.value}'
refuse "table_9_9.csv is not there" <<<'`published/table_9_9 value`{.value}'
refuse "maker_part.svg is not there" <<<$'``` {.figure}\nfigure: maker_part\ncaption: x\n```'
refuse "\nothing" <<<$'---\ntitle: A report\n---\nA formula $\\nothing{x}$.'
refuse "has no caption" <<<$'``` {.figure}\nfigure: maker\n```'
refuse "'tabel: maker' is not understood" <<<$'``` {.table}\ntabel: maker\n```'
refuse "has no line 'column: ...'" <<<$'``` {.table}\ntable: maker\n```'
refuse "has measured nothing named 'P1'" <<<$'``` {.table}\ntable: maker\nmeasured: workspace\ncolumn: measured\n```'
echo '{"program": ' >"$folder/results/maker/maker.json"
refuse "is not JSON" <<<$'``` {.provenance}\n```'
rm "$folder/results/maker/maker.json"
refuse "maker.json is not there" <<<$'``` {.provenance}\n```'

# The report's own names: every table, figure and number it asks for must be known; only results may be missing.
code=0
"$source/paper/build" "$folder/no_results" "$folder/out" >"$folder/said" 2>&1 || code=$?
[[ $code -ne 0 ]] || fail "the report is made without results"
grep -q "is not there; run 'make experiment NAME=" "$folder/said" || fail "without results it says: $(cat "$folder/said")"
