#!/usr/bin/env bash
# check_readme.sh SOURCE: the numbers in the README are those that are stored, and the files it names are there.
set -euo pipefail
cd "$1"
fail() { echo "README: $*" >&2; exit 1; }

# The column of a table in data/ for one workspace, with so many digits.
value() { awk -F, -v key="$2" -v digits="$4" -v name="$3" '!/^#/ && !header { for (i = 1; i <= NF; ++i) at[$i] = i; header = 1; next }
  !/^#/ && index("," $0 ",", "," key ",") { print digits ? sprintf("%.*f", digits, $at[name]) : $at[name]; exit }' "data/$1.csv"; }

for table in 5.3 5.4 5.5; do
  name="table_${table/./_}"
  row="$(grep "^| Table $table," README.md)" || fail "Table $table has no row"
  expected=""
  for workspace in P1 P2 P3; do
    expected+=" $(value "published/$name" "$workspace" f_star 0) |"
    expected+=" $(value "reference/${name}_area" "$workspace" kappa_inv_dense 4) |"
    expected+=" $(value "reference/${name}_pointwise" "$workspace,slsqp" kappa_inv_dense 4) |"
  done
  [[ $row == *"|$expected" ]] || fail "the row of Table $table should end in |$expected"
done

while read -r file; do
  [[ -e $file ]] || fail "it names $file, which is not there"
done < <(grep -oE '\]\([^)]+\)' README.md | sed 's/^](//; s/)$//')
