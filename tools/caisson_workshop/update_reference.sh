#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Builds, runs the regression tests whose name fits, and makes their outputs the
# new references tests/ROOM/NAME.output. A test that does not finish keeps its old
# one. Say in the commit why the numbers changed.
#
# Usage: tools/workshop update-reference REGEX
#   e.g. tools/workshop update-reference jack
set -euo pipefail
if [[ ${1:-} == --help || ${1:-} == -h ]]; then sed -n '4,/^set/s/^# \{0,1\}//p' "$0" && exit; fi
cd "$(dirname "$0")/../.."
if [ $# -ne 1 ]; then
  sed -n '4,10s/^# \{0,1\}//p' "$0" >&2
  exit 1
fi

# A test without a reference is not known to cmake. Some are lines add_variant(NAME ...
variants=$(grep -o '^add_variant([a-z_0-9]*' tests/*/CMakeLists.txt |
           sed 's|CMakeLists.txt:add_variant(\(.*\)|\1.prm|')
for source in tests/*/*.cc tests/*/*.prm $variants; do
  case $source in tests/program/*) continue ;; esac
  reference=${source%.*}.output
  [ -e "$reference" ] || touch "$reference"
done
scripts/build build_tests
rm -f build/release/tests/*/*/output
ctest --test-dir build/release -j "$(nproc)" -R "$1" -E '^(python|program)/' || true

status=0
while read -r name; do
  output=build/release/tests/$name/output
  if [ ! -e "$output" ]; then
    echo "update_reference: $name did not finish" >&2
    status=1
  elif ! cmp -s "$output" "tests/$name.output"; then
    cp "$output" "tests/$name.output"
    echo "new: tests/$name.output"
  fi
done < <(ctest --test-dir build/release -N -R "$1" -E '^(python|program)/' |
         sed -n 's|.*Test .*: ||p')
exit $status
