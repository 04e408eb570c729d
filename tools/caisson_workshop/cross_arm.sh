#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Compiles the kernels and their tests for ARM (aarch64) and runs these in an emulator:
# what they print is compared with the references of x86-64, at the same tolerances.
# Debian has no deal.II for ARM: a test that needs it is left out and named, and so is
# one that compares the instruction sets of x86-64 with each other.
#
# Usage: tools/workshop cross-arm [--host] [NAME]...    (default: all tests)
#   --host     with the compiler of this machine, without its intrinsics, and run as it is
#   CXX        the compiler, as in CXX=clang++ with --host
#   JOBS       tests at a time (default: one per core)
#   CXXFLAGS   further flags of the compiler, as in CXXFLAGS=-march=armv8.2-a
# Needs: apt-get install g++-aarch64-linux-gnu qemu-user-static
# The directory build/cross_arm (or build/generic_lanes) has all outputs.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
compiler=(aarch64-linux-gnu-g++) emulator=(qemu-aarch64-static) place=$root/build/cross_arm
if [ "${1:-}" = --host ]; then
  shift
  compiler=(g++ -DCAISSON_GENERIC_LANES) emulator=() place=$root/build/generic_lanes
fi
compiler[0]=${CXX:-${compiler[0]}}
# shellcheck disable=SC2206  # split into words on purpose
compiler+=(-std=c++17 -Wall -Wextra -Wno-psabi -Werror "-I$root/include" ${CXXFLAGS:-})
for tool in "${compiler[0]}" "${emulator[@]}"; do
  command -v "$tool" >/dev/null || { echo "cross_arm: $tool is missing: see $0" >&2 && exit 1; }
done
mkdir -p "$place"

# The flags of the kernels in CMakeLists.txt: those for GCC, if it is GCC.
kernels=(-O3 -Wno-uninitialized)
if ! "${compiler[0]}" --version | head -n 1 | grep -q clang; then
  kernels+=(-Wno-maybe-uninitialized -fno-tree-loop-distribute-patterns
            -fno-tree-vectorize -fno-tree-slp-vectorize)
fi
"${compiler[@]}" "${kernels[@]}" -DCAISSON_KERNEL_ISA=generic \
  -c "$root/source/kernels/kernels.cc" -o "$place/kernels.o"
"${compiler[@]}" -O2 -c "$root/source/kernels/dispatch.cc" -o "$place/dispatch.o"

# Whether a test, or a header beside it, includes deal.II or names a set of x86-64.
reason_to_leave_out() { # SOURCE
  local sources=("$1") header
  while read -r header; do sources+=("$(dirname "$1")/$header"); done < <(
    sed -n 's/^#include "\(.*\)"/\1/p' "$1")
  if grep -qs '^#include <deal\.II' "${sources[@]}"; then
    echo "it needs deal.II"
  elif grep -qs '"SSE2"' "${sources[@]}"; then
    echo "it compares the instruction sets of x86-64"
  fi
}

run_test() { # SOURCE; the last line says how it went
  local name reason
  name=$(basename "$1" .cc)
  reason=$(reason_to_leave_out "$1")
  if [ -n "$reason" ]; then
    echo "$name: left out, $reason"
  elif mkdir -p "$place/$name" &&
       "${compiler[@]}" -O1 "$1" "$place/kernels.o" "$place/dispatch.o" -static \
         -o "$place/$name/program" && cd "$place/$name" &&
       python3 -B "$root/tests/reference.py" "kernels/$name" "${emulator[@]}" ./program; then
    echo "$name: passed"
  else
    echo "$name: FAILED"
  fi
}

names=()
for source in "$root"/tests/kernels/*.cc; do
  name=$(basename "$source" .cc)
  if [ ! -e "$source" ] || { [ $# -gt 0 ] && [[ " $* " != *" $name "* ]]; }; then continue; fi
  while [ "$(jobs -rp | wc -l)" -ge "${JOBS:-$(nproc)}" ]; do wait -n || true; done
  run_test "$source" >"$place/$name.log" 2>&1 &
  names+=("$name")
done
wait
results=$(for name in "${names[@]}"; do tail -n 1 "$place/$name.log"; done)
echo "$results"
for name in "${names[@]}"; do
  if grep -q "^$name: FAILED$" <<<"$results"; then cat "$place/$name.log"; fi
done
echo "cross_arm: $(grep -c ': passed$' <<<"$results" || true) passed," \
  "$(grep -c 'left out' <<<"$results" || true) left out," \
  "$(grep -c ': FAILED$' <<<"$results" || true) failed"
grep -q ': passed$' <<<"$results" && ! grep -q ': FAILED$' <<<"$results"
