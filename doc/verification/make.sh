#!/usr/bin/env bash
# Makes doc/verification/paper.md, mechanics.md, blocks.md, dda.md, stability.md, jointed_rock.md and their pictures anew.
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake --preset release
cmake --build --preset release --target paper_verification mechanics_verification blocks_verification dda_verification stability_verification jointed_rock_verification
for page in paper mechanics blocks; do build/release/doc/verification/${page}_verification doc/verification; done
build/release/tests/validation/dda_verification doc/verification
build/release/tests/stability/stability_verification doc/verification
build/release/tests/jointed_rock/jointed_rock_verification doc/verification
