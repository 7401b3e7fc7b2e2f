#!/usr/bin/env bash
# Measures what steps cost and makes doc/benchmarks/dda.md anew:
#   bash doc/benchmarks/make_dda.sh BUILD_DIRECTORY [--long | --million]
# of a build with tests, without assertions (cmake --preset release -B BUILD_DIRECTORY -DPOLYDDA_ASSERTIONS=OFF).
# About ten minutes on a quiet machine; --long goes to 100 000 blocks and takes an hour and a half, --million on to a million, which takes
# 20 GB of memory. Measurements stay in the folder "benchmarks/dda" of the build directory; a set that is named (SETS="walls field") is
# measured alone, the others are taken from there.
set -euo pipefail
source_directory=$(cd "$(dirname "$0")/../.." && pwd)
build=${1:?usage: make_dda.sh BUILD_DIRECTORY [--long | --million]}
long=${2:-}
targets=(step_performance step_page dda)
cmake --build "$build" --target help | grep -q '^box2d_performance:' && targets+=(box2d_performance)
cmake --build "$build" --target "${targets[@]}"
export OPENBLAS_NUM_THREADS=1

measured=$build/benchmarks/dda
steps=$build/tests/performance/steps
mkdir -p "$measured"
sets=${SETS:-growth scenes skips walls threads field}
# Walls of 10 000 settle in five minutes; those of 100 000 take hours and are left out.
seconds=12 large=() million=() settled=(1000) settled_seconds=12
if [ -n "$long" ]; then
  seconds=120 large=(100000) settled=(1000 10000) settled_seconds=600
fi
if [ "$long" = --million ]; then
  million=(1000000)
fi

wants() { [[ " $sets " == *" $1 "* ]]; }
# measure TABLE OPTIONS...: adds to the table.
measure() {
  local table=$1
  shift
  "$steps/step_performance" run -o "$measured/$table.csv" --append --seconds "$seconds" "$@"
}

# Others use the machine too: the wall by each method and its rigid peer one after another.
if wants walls; then
  rm -f "$measured/walls.csv" "$measured/box2d.csv"
  [ -x "$steps/box2d_performance" ] && "$steps/box2d_performance" "$measured/box2d.csv"
  measure walls --sizes 200 1000 10000 --starts sudden --no-cholmod --warm 0 --steps 20
  seconds=$settled_seconds measure walls --sizes 200 "${settled[@]}" --starts settled --without none sleep --no-cholmod \
    --warm 100 --steps 20
  seconds=20 measure walls --sizes 200 1000 --starts sudden settled --methods classic --no-cholmod --warm 0 --steps 20
fi
if wants growth; then
  rm -f "$measured/growth.csv"
  measure growth --time-steps 1e-4 --sizes 1000 10000 100000 "${million[@]}" --warm 2 --steps 5
  measure growth --methods explicit --time-steps 1e-4 --sizes 1000 10000 100000 "${million[@]}" --warm 2 --steps 5
  measure growth --sizes 1000 10000 --warm 2 --steps 5
  measure growth --methods coarse explicit --sizes 1000 10000 --warm 2 --steps 5
  measure growth --scenes slide --sizes 1000 --warm 2 --steps 5
  seconds=$settled_seconds measure growth --scenes wall glide --starts settled --without sleep --sizes "${settled[@]}" --warm 5 --steps 10
  if [ -n "$long" ]; then
    measure growth --sizes "${large[@]}" --warm 0 --steps 1
    measure growth --scenes slide --sizes 10000 --warm 0 --steps 2
  fi
fi
if wants scenes; then
  rm -f "$measured/scenes.csv"
  measure scenes --scenes arch heap loose_heap slope slide rain field columns --sizes 100 1000 "${large[@]/100000/10000}" \
    --warm 2 --steps 5 --no-cholmod
  for practice in "bin 150 5e-3" "tunnel 290 1e-2" "filled_arch 64 1e-2" "slope 200 1e-2" "slide 200 1e-2"; do
    read -r scene size time_step <<< "$practice"
    measure scenes --scenes "$scene" --sizes "$size" --time-steps "$time_step" --methods default coarse --warm 30 --steps 50 --no-cholmod
  done
fi
if wants skips; then
  rm -f "$measured/skips.csv"
  measure skips --without none unchanged_factor cg skin congruent --warm 2 --steps 5 --no-cholmod
  measure skips --starts settled --without none unchanged_factor islands sleep islands+sleep \
    --warm 5 --steps 5 --no-cholmod
  measure skips --time-steps 1e-4 --without none cg skin --warm 2 --steps 5 --no-cholmod
  measure skips --scenes rain --without none islands skin --warm 2 --steps 5 --no-cholmod
  measure skips --scenes smooth_heap --without none friction_rows --warm 2 --steps 5 --no-cholmod
  measure skips --scenes field --without none islands sleep islands+sleep fixed_blocks skin --warm 30 --steps 5 \
    --no-cholmod
fi
if wants threads; then
  rm -f "$measured/threads.csv"
  measure threads --methods default explicit --time-steps 1e-4 --sizes 100000 --threads 1 2 --warm 1 --steps 3 --no-cholmod
  [ -z "$long" ] || measure threads --sizes "${large[@]}" --threads 1 2 --warm 0 --steps 1 --no-cholmod
fi
if wants field; then
  rm -f "$measured/field.csv"
  measure field --scenes field --sizes 0 10000 --warm 30 --steps 20 --no-cholmod
  measure field --scenes field --sizes 10000 --without sleep+islands --warm 30 --steps 5 --no-cholmod
fi

echo "$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1), $(g++ --version | head -n 1)," \
  "$(uname -sm), $(date +%Y-%m-%d)${long:+, with $long}." > "$measured/machine.txt"
"$steps/step_page" "$measured" "$source_directory/doc/benchmarks/dda.md"
echo "made doc/benchmarks/dda.md"
