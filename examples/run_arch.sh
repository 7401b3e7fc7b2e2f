#!/usr/bin/env bash
# On a fresh Debian 12: installs what the program needs, builds it and runs the arch bridge of the paper.
set -euo pipefail
cd "$(dirname "$0")/.."
source tests/support/debian_packages.sh
install_packages "${program_packages[@]}"
cmake --preset program
cmake --build --preset program
build/program/apps/dda run examples/paper/arch_friction30.toml -o arch_friction30-out
echo
echo "How far the crown went, step by step:  arch_friction30-out/monitors.csv"
echo "Stress in every block:                 arch_friction30-out/blocks.csv"
echo "What the supports carry:"
cat arch_friction30-out/supports.csv
