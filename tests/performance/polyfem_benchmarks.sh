#!/usr/bin/env bash
# Measures polyfem beside deal.II and CGAL and makes doc/benchmarks/polyfem.md anew, in some minutes on a quiet machine:
#   bash tests/performance/polyfem_benchmarks.sh [--quick]
# With --quick it is a rehearsal on coarse meshes, and the page goes to the build directory.
# BUILD=directory takes another build directory than build/benchmarks, one without assertions; measurements stay in its folder "benchmarks".
set -euo pipefail
cd "$(dirname "$0")/../.."
quick=${1:-}
build=${BUILD:-build/benchmarks}
options=(-DPOLYDDA_DEALII=ON)
[ -f "$build/CMakeCache.txt" ] || options+=(-G Ninja -DCMAKE_BUILD_TYPE=Release)
cmake -S . -B "$build" "${options[@]}"
kernels=(basis_performance basis_performance_native element_performance)
cmake --build "$build" --target work_precision voronoi_cantilever quadrature_performance benchmark_page "${kernels[@]}"

export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
programs=$build/tests/performance
measured=$build/benchmarks
page=doc/benchmarks/polyfem.md
sizes=(3000 100000)
n_polygons=100 n_toleranced=5000
kernel_options=(--benchmark_repetitions=5 --benchmark_enable_random_interleaving=true --benchmark_min_time=0.05)
mkdir -p "$measured"
if [ "$quick" = --quick ]; then
  cp "$page" "$measured"
  page=$measured/polyfem.md
  sizes=(3000)
  n_polygons=5 n_toleranced=20
  kernel_options=(--benchmark_min_time=0.001)
fi

for kernel in "${kernels[@]}"; do
  filter=.
  [[ $kernel == basis_* ]] && filter='/inside/n:(4|5|6|8|10|12|16|20)/points:16$'
  "$programs/$kernel" "${kernel_options[@]}" --benchmark_filter="$filter" \
    --benchmark_out="$measured/$kernel.json" --benchmark_out_format=json > "$measured/$kernel.txt"
done
"$programs/quadrature_performance" rules "$n_polygons" > "$measured/quadrature_rules.csv"
"$programs/quadrature_performance" tolerance "$n_toleranced" > "$measured/quadrature_tolerances.csv"
for cells in "${sizes[@]}"; do
  "$programs/work_precision/voronoi_cantilever" "$cells"
done > "$measured/voronoi_cantilever.csv"
"$programs/work_precision/work_precision" "$measured/work_precision.csv" ${quick:+"$quick"} |
  tee "$measured/work_precision.txt"
grep '^Limits of Cook' "$measured/work_precision.txt" > "$measured/reference.txt"
echo "$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1), $(g++ --version | head -n 1)," \
  "deal.II $(dpkg-query --show --showformat='${Version}' libdeal.ii-dev), $(grep '^BLAS' "$measured/work_precision.txt")." > "$measured/machine.txt"
"$programs/page/benchmark_page" "$measured" "$page"
echo "made $page"
