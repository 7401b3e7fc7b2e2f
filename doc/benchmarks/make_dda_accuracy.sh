#!/usr/bin/env bash
# Measures anew and makes doc/benchmarks/dda_accuracy.md, its table and its pictures, in some minutes on one core:
#   bash doc/benchmarks/make_dda_accuracy.sh BUILD_DIRECTORY
# BUILD_DIRECTORY is one that CMake has configured for release, without assertions (-DPOLYDDA_ASSERTIONS=OFF).
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:?usage: make_dda_accuracy.sh BUILD_DIRECTORY}
cmake --build "$build" --target error_time
export OPENBLAS_NUM_THREADS=1  # others would wait busily at first, and their time be counted
program=$build/tests/performance/error_time/error_time
"$program" measure doc/benchmarks/dda_accuracy.csv
"$program" page doc/benchmarks/dda_accuracy.csv doc/benchmarks
