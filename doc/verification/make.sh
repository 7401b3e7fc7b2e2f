#!/usr/bin/env bash
# Makes doc/verification/paper.md and its pictures anew.
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake --preset release
cmake --build --preset release --target paper_verification
build/release/doc/verification/paper_verification doc/verification
