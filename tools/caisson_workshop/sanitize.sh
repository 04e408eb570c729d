#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Builds the program with the sanitizers of the compiler for addresses and undefined
# behavior, and with the assertions of the standard library, in build/sanitizers,
# and runs its tests there. What they find ends a program with status 99, which no
# test expects. Leaks are not looked for: Open MPI has its own, and unloads its
# plugins at the end, so that they have no name by which to leave them out.
#
# Usage: tools/workshop sanitize [option of ctest]...
#   e.g. tools/workshop sanitize -R kernels
set -euo pipefail
if [[ ${1:-} == --help || ${1:-} == -h ]]; then sed -n '4,/^set/s/^# \{0,1\}//p' "$0"; exit; fi
cd "$(dirname "$0")/../.."
export BUILD_DIRECTORY=build/sanitizers
CMAKE_OPTIONS="-DCAISSON_MPM_SANITIZERS=address,undefined ${CMAKE_OPTIONS:-}"
export CMAKE_OPTIONS
scripts/setup --check build pictures
scripts/build build_tests

. tools/caisson_workshop/test_environment.sh
export ASAN_OPTIONS=exitcode=99:detect_leaks=0:strict_string_checks=1
export UBSAN_OPTIONS=exitcode=99:print_stacktrace=1
exec ctest --test-dir "$BUILD_DIRECTORY" --output-on-failure "$@"
