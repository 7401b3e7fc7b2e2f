#!/usr/bin/env bash
# On a fresh Debian 12: installs what the tests need too (deal.II among it), builds everything and runs all tests.
set -euo pipefail
cd "$(dirname "$0")/.."
source tests/support/debian_packages.sh
install_packages "${program_packages[@]}" "${python_packages[@]}" "${viewer_packages[@]}" "${test_packages[@]}"
cmake --preset release -DPOLYDDA_REQUIRE_ALL_TESTS=ON -DPOLYDDA_COMBINE_FILES=ON -DPOLYDDA_PYTHON=ON -DPython3_EXECUTABLE=/usr/bin/python3
cmake --build --preset release
ctest --preset release
ctest --preset verification
