#!/usr/bin/env bash
# From a fresh clone to a picture: installs packages, builds build/wavepath, and renders the Cornell box to
# cornell_box.exr and cornell_box.png at the root of the repository.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh demo
CMAKE_GENERATOR=Ninja cmake -S . -B build -DCMAKE_BUILD_TYPE=Release -DWAVEPATH_TESTS=OFF -DWAVEPATH_BENCHMARKS=OFF
cmake --build build --parallel "$(nproc)"
build/wavepath render scenes/cornell_box/scene.gltf -o cornell_box.exr -o cornell_box.png --size 512x512 --spp 128
