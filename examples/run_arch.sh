#!/usr/bin/env bash
# On a fresh Debian 12: installs what the program needs, builds it, runs the arch bridge of the paper and draws it.
set -euo pipefail
cd "$(dirname "$0")/.."
source tests/support/debian_packages.sh
install_packages "${program_packages[@]}"
cmake --preset program
cmake --build --preset program
build/program/apps/dda run examples/paper/arch_friction30.toml --set analysis.preset=default -o arch_friction30-out --force
build/program/apps/dda plot arch_friction30-out --field s1 --forces -o arch_friction30-out/stress.svg
echo
build/program/apps/dda info arch_friction30-out
echo
echo "The picture: arch_friction30-out/stress.svg (any web browser shows it)"
