#!/usr/bin/env bash
# check_layers.sh SOURCE: the includes are those that scripts/layers.txt allows, and one that is not is found.
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
fail() { echo "layers: $*" >&2; exit 1; }
"$1/scripts/check-layers" || fail "the sources break scripts/layers.txt"

cp -r "$1"/{libs,apps,experiments,scripts} "$folder"
cd "$folder"
# refuse FILE INCLUDE WORD...: with this include in the file, the words are in what is said.
refuse() {
  local file="$1" include="$2" word
  shift 2
  cp "$file" kept
  echo "#include $include" >>"$file"
  ! scripts/check-layers 2>said || fail "$file may include $include"
  for word in "$@"; do grep -qF -- "$word" said || fail "'$word' is not in: $(cat said)"; done
  mv kept "$file"
}
refuse apps/reprise/main.cpp '"frame/experiment.hpp"' "apps/reprise/main.cpp" "experiments/frame"
refuse libs/base/src/require.cpp '"reprise/kinematics/manipulator.hpp"' "libs/base must not include from libs/kinematics"
refuse libs/synthesis/src/assessment.cpp '<boost/numeric/interval.hpp>' "libs/synthesis must not see"
refuse libs/workspace/src/trace.cpp '<nlopt.h>' "libs/workspace must not see"
refuse libs/geometry/include/reprise/geometry/region.hpp '"reprise/geometry/region_quadrature.hpp"' "in a circle" region_quadrature.hpp
refuse libs/geometry/src/region.cpp '"reprise/geometry/nothing.hpp"' "which is not there"
sed -i 's%^libs/geometry .*%libs/geometry libs/study%' scripts/layers.txt
! scripts/check-layers 2>said || fail "the table may have an arrow that runs up"
grep -q "libs/study does not stand above libs/geometry" said || fail "of an arrow that runs up it says: $(cat said)"
