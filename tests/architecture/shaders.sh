#!/usr/bin/env bash
# Every shader through the reference compiler, as the program embeds it. shaders.sh FILE…
# Exit 77 (skipped) without glslangValidator.
set -euo pipefail
if ! command -v glslangValidator >/dev/null; then
  echo "SKIPPED: glslangValidator is not installed, shaders were not checked (apt-get install glslang-tools)"
  exit 77
fi
[ $# -gt 0 ] || { echo "no shaders named"; exit 1; }
for shader in "$@"; do
  # -G: OpenGL's rules, every location and binding explicit.
  glslangValidator -G -o /dev/null "$shader" || { echo "$shader does not compile"; exit 1; }
done
echo "$# shaders compile"
