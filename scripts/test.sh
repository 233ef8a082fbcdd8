#!/usr/bin/env bash
# Installs packages, builds everything into build/ and runs all tests. With CI set, a warning is an error.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh test
if [[ -n ${CI:-} ]]; then werror=ON; else werror=OFF; fi
CMAKE_GENERATOR=Ninja cmake -S . -B build -DCMAKE_BUILD_TYPE=Release -DWAVEPATH_TESTS=ON -DWAVEPATH_BENCHMARKS=ON \
    -DWAVEPATH_WERROR=$werror
cmake --build build --parallel "$(nproc)"
# PoCL alone unless told otherwise. Two tests at a time: PoCL spreads each over all cores already.
export OCL_ICD_VENDORS=${OCL_ICD_VENDORS-pocl.icd}
ctest --test-dir build --output-on-failure --parallel 2
