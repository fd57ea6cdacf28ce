#!/usr/bin/env bash
# check_report.sh SOURCE: the report draws what is there, and is not made when a name is wrong.
set -euo pipefail
source="$1"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
fail() { echo "report: $*" >&2; exit 1; }

# A source tree and results of our own: one program with a table and a picture.
mkdir -p "$folder"/{source/paper,source/experiments,source/scripts,source/data/published,results/maker}
cp -r "$source"/paper/{build,filters,formulas.js,report.js,template.html,references.yaml,style.css,print.css,print.py,check_legends.py} "$folder/source/paper"
cp "$source/scripts/manifest" "$folder/source/scripts"
cp "$source/data/names.csv" "$folder/source/data"
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
 "source": {"commit": "0123456789abcdef", "dirty": false}, "libraries": {"Eigen": "3.4.0", "SuiteSparse": "5.12.0"},
 "build": {"compiler": "GNU \"12\"", "type": "Release", "flags": "-O3"}, "processor": "a processor",
 "cores": 2, "constants": {"points": 720.0},
 "finished": "2001-02-03T04:05:06Z", "seconds": 1.25, "inputs": {}, "outputs": []}
JSON
echo '// The program.' >"$folder/source/experiments/maker.cpp"
# A picture as gnuplot writes it: two curves in one panel, each with its entry in the legend.
curve() { echo "<g id=\"gnuplot_plot_$1\" ><title>gnuplot_plot_$1</title>$3<path stroke='rgb($2)' d='M0,0 L1.2345,2'/></g>"; }
entry() { echo "<g transform=\"translate(50.00,$1.00)\" text-anchor=\"start\"><text>$2</text></g>"; }
picture() {
  echo '<?xml version="1.0"?><svg width="100" height="80" xmlns="http://www.w3.org/2000/svg"><g id="gnuplot_canvas">'
  curve 1 '  0, 114, 178' "$(entry 60 'one 1.2345')"
  curve 2 '213,  94,   0' "$1"
  echo '</g></svg>'
}
picture "$(entry 70 two)" >"$folder/results/maker/maker.svg"
# The same in PNG, of twice the size, with samples in the colours given.
png_picture() {
  /usr/bin/python3 - "$folder/results/maker/maker.png" "$@" <<'PYTHON'
import sys
from PIL import Image
picture = Image.new("RGB", (200, 160), "white")
for number, colour in enumerate(sys.argv[2:]):
    picture.paste(colour, (60, 112 + 20 * number, 96, 116 + 20 * number))
picture.save(sys.argv[1])
PYTHON
}
png_picture '#0072b2' '#d55e00'
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
``` {.define}
largest: max(maker,
  value)
```

# A section {#a}

Number [`maker[workspace=P1].value`{.value format="%.3f"}], [`maker[workspace=P1].small`{.value format="%.1e"}],
[`maker[workspace=P1].text`{.value}], [`published/table_5_3[workspace=P3].N_g`{.value format="%d"}],
setting [`setting('maker', '--chord')`{.value}], constant [`constant('maker', 'points')`{.value}], [`setting('maker', '--list')`{.value}], formula $x^2$.
Of rows [`count(maker)`{.value format=word}], [`count(maker, value < 0)`{.value format=Word}], [`largest`{.value format="%.2f"}],
[`min(maker[count>18], value) + 2 * median(maker, count)`{.value format="%.1f"}],
[`max(maker, maker[workspace=(workspace)].count - 1)`{.value}], [`sum(maker[workspace=P9], value)`{.value}],
[`distinct(maker, text)`{.value}], [`abs(round(0 - 1.26, 1))`{.value}].
[Most are right]{.claim test="any(maker, value > 0) and not all(maker, value > 0)"},
[all]{.claim test="all(maker, value > 0)" otherwise="not *all*"}. [Open](../explorer/index.html). See [](#tab-maker), [](#fig-maker) and [it](#a) [@hay].

$$\sqrt{\frac{1}{r}}$$

``` {.table}
table: maker
where: workspace=P2
column: workspace | **name**
column: value - small | difference | %+.2f
column: empty
thesis: Table 9
caption: A *caption* with `maker[workspace=P1].count`{.value}.
```

``` {.table}
table: maker
spread: workspace | count
column: P1
column: P2
```

``` {.figure}
figure: maker
caption: A figure.
```

``` {.manifest}
```

``` {.provenance}
```

::: {#refs}
:::
MARKDOWN
html="$(tr '\n' ' ' <"$folder/out/report.html")"  # pandoc breaks lines where it likes
text="$(sed 's/.*<main>//; s/<script>.*//; s/<[^>]*>//g' <<<"$html")"
for part in '[0.912]' $'[−2.5\u00a0×\u00a010⁻⁶]' '[a, "b"]' '[71]' '[0.02]' '[720]' '[a, b]' '[two]' '[One]' '[0.91]' '[38.9]' '[20]' \
  '[0]' '[1.3]' 'Most are right' 'not all. Open. See' $'Table\u00a01, Figure\u00a01' $'Table\u00a01 (Table\u00a09 of the chapter)' \
  'A caption with 21' '−0.50' 'make experiment NAME=maker' '2001-02-03, commit 0123456789ab' 'a processor, 2 cores' \
  'SuiteSparse: 5.12.0' \
  '--chord 0.02'; do
  [[ $text == *"$part"* ]] || fail "'$part' is not in the report"
done
# What the pointer says that rests on a cell, a heading, a number: file, column, row, unit.
for part in 'title="workspace [-] row 2: workspace=P2 text=c file maker.csv"' 'title="workspace [-]: a name"' \
  'title="value - small of value [-], small [-] row 2: workspace=P2 text=c file maker.csv"' \
  'title="value [-] row workspace=P1 file results/maker/maker.csv source experiments/maker.cpp command make' \
  'title="largest = max(maker, value) value [-] file results/maker/maker.csv source' \
  'title="option --chord file results/maker/maker.json source experiments/maker.cpp command make experiment NAME=maker"'; do
  [[ $html == *"$part"* || $html == *"${part//\"/\'}"* ]] || fail "'$part' is not in the report"
done
for part in '<strong>name</strong>' '<math ' '<svg xmlns' 'stroke="var(--blue)"' 'M0,0 L1.2,2' 'one 1.2345' 'command make experiment NAME=maker' \
  'href="report_files/results/maker/maker.csv"' 'href="report_files/sources/experiments/maker.cpp"' 'id="ref-hay"'; do
  [[ $html == *"$part"* || $html == *"${part//\"/\'}"* ]] || fail "'$part' is not in the report"
done
[[ $(ls -A "$folder/out") == $'report.html\nreport.pdf\nreport_files' ]] || fail "not just the report is left behind"
cmp "$folder/out/report_files/results/maker/maker.csv" "$folder/results/maker/maker.csv" || fail "the table is not shipped"
[[ "$(head -c 5 "$folder/out/report.pdf")" == "%PDF-" ]] || fail "report.pdf is no PDF"
grep -qa KaTeX "$folder/out/report.pdf" || fail "the printed formulas are not set by KaTeX"
# Every file that the report links to lies beside it.
grep -o 'href="report_files[^"]*"' "$folder/out/report.html" | sed 's/href="//; s/"$//' | while read -r file; do
  [[ -s "$folder/out/$file" ]] || fail "$file is not shipped"
done

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

# In print, text moves up in front of a picture that does not fit on the page; where there is none, the build says how
# much of the page is empty.
sed -i 's/width="100" height="80"/width="700" height="1000"/' "$folder/results/maker/maker.svg"
sentences() { for _ in {1..8}; do printf 'A sentence of ten words, of which there are many. %.0s' {1..12}; printf '\n\n'; done; }
figure=$'``` {.figure}\nfigure: maker\ncaption: x\n```\n'
build < <(printf -- '---\ntitle: A report\n---\n\n'; sentences | head -n 6; echo "$figure"; sentences) || fail "no report with a tall picture: $(cat "$folder/said")"
! grep 'percent empty' "$folder/said" || fail "text does not move in front of a picture that does not fit"
build < <(printf -- '---\ntitle: A report\n---\n\n'; sentences | head -n 6; echo "$figure"; echo "$figure") || fail "no report with tall pictures: $(cat "$folder/said")"
grep -q 'Page 1 of the printed report is [0-9]* percent empty' "$folder/said" || fail "an empty page is not reported"
sed -i 's/width="700" height="1000"/width="100" height="80"/' "$folder/results/maker/maker.svg"

# Each wrong block must stop the build with one sentence that holds the text after the name of the case.
refuse() {
  local expected="$1"
  if build; then fail "a report with a mistake is made ($expected)"; fi
  [[ $(wc -l <"$folder/said") -eq 1 ]] || fail "not one sentence but: $(cat "$folder/said")"
  grep -qF -- "$expected" "$folder/said" || fail "'$expected' is not in: $(cat "$folder/said")"
  [[ -z "$(ls -A "$folder/out")" ]] || fail "a failed build leaves files"
}
refuse "no program for the result 'nothing'" <<<'`nothing[workspace=P1].value`{.value}'
refuse "no column 'nothing'" <<<'`maker[workspace=P1].nothing`{.value}'
refuse "no column 'nothing'" <<<'`maker[nothing=P1].value`{.value}'
refuse "no row with workspace=P9" <<<'`maker[workspace=P9].value`{.value}'
refuse "means 2 rows" <<<'`maker[].value`{.value}'
refuse "'P1' is not a number" <<<'`maker[workspace=P1].workspace`{.value format="%.3f"}'
refuse "no option '--nothing'" <<<"\`setting('maker', '--nothing')\`{.value}"
refuse "records no constant 'nothing'" <<<"\`constant('maker', 'nothing')\`{.value}"
refuse "a line 'data: ...' names its tables" <<<$'``` {.figure}\nfigure: maker\ndata: maker_part\ncaption: x\n```'
refuse "maker_part.csv is not there; run 'make experiment NAME=maker' first" <<<'`maker_part[].value`{.value}'
refuse "table_9_9.csv is not there" <<<'`published/table_9_9[].value`{.value}'
refuse "lacks ')'" <<<'`max(maker, value`{.value}'
refuse "takes 'min' of no rows" <<<'`min(maker[workspace=P9], value)`{.value}'
refuse "'nobody', which is neither defined nor a column" <<<'`nobody + 1`{.value}'
refuse "maker_part.svg is not there" <<<$'``` {.figure}\nfigure: maker_part\ncaption: x\n```'
refuse "\nothing" <<<$'---\ntitle: A report\n---\nA formula $\\nothing{x}$.'
refuse "has no caption" <<<$'``` {.figure}\nfigure: maker\n```'
refuse "'tabel: maker' is not understood" <<<$'``` {.table}\ntabel: maker\n```'
refuse "has no line 'column: ...'" <<<$'``` {.table}\ntable: maker\n```'
refuse "too wide for a printed page" < <(printf -- '---\ntitle: A report\n---\n``` {.table}\ntable: maker\n'; printf 'column: workspace | aVeryLongHeading%d\n' {1..9}; printf '```\n')

# A claim that is false, and names the page.
refuse "paper/00.md: the claim 'All are positive' is false: all(maker, value > 0)." <<<'[All are positive]{.claim test="all(maker, value > 0)"}.'
refuse "takes '2' for true or false" <<<'[Two]{.claim test="count(maker)"}'
# Links that lead nowhere.
refuse "leads to '#nowhere', which is not in the report" <<<'See [there](#nowhere).'
refuse "leads to 'nothing.csv', which is not shipped" <<<'See [there](nothing.csv).'
refuse "leads to no table or figure" <<<$'# A {#a}\n\nSee [](#a).'
# A curve without its entry in the legend.
picture '' >"$folder/results/maker/maker.svg"
refuse "the legend of $folder/results/maker/maker.svg does not name what panel 1 draws in #d55e00" <<<$'``` {.figure}\nfigure: maker\ncaption: x\n```'
picture "$(entry 70 two)" >"$folder/results/maker/maker.svg"

# An entry that only the legend in PNG has no room for.
png_picture '#0072b2'
refuse "the legend of $folder/results/maker/maker.png does not name what is drawn in #d55e00" <<<$'---\ntitle: A report\n---\n``` {.figure}\nfigure: maker\ncaption: x\n```'
png_picture '#0072b2' '#d55e00'
mv "$folder/results/maker/maker.png" "$folder/maker.png"
refuse "maker.png is not there; run 'make experiment NAME=maker' first" <<<$'``` {.figure}\nfigure: maker\ncaption: x\n```'
mv "$folder/maker.png" "$folder/results/maker/maker.png"

echo '{"program": ' >"$folder/results/maker/maker.json"
refuse "is not JSON" <<<$'``` {.provenance}\n```'
rm "$folder/results/maker/maker.json"
refuse "maker.json is not there" <<<$'``` {.provenance}\n```'

# The report's own names: every table, figure and number it asks for must be known; only results may be missing.
code=0
"$source/paper/build" "$folder/no_results" "$folder/out" >"$folder/said" 2>&1 || code=$?
[[ $code -ne 0 ]] || fail "the report is made without results"
grep -q "is not there; run 'make experiment NAME=" "$folder/said" || fail "without results it says: $(cat "$folder/said")"
