#!/usr/bin/env bash
# Every source as clang-format leaves it. formatting.sh ROOT. Exit 77 (skipped) without clang-format.
set -euo pipefail
cd "$1"
if ! command -v clang-format >/dev/null; then
  echo "SKIPPED: clang-format is not installed, formatting was not checked (apt-get install clang-format)"
  exit 77
fi
if ! find calibration assets haptics render app tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 -n 20 -P "$(nproc)" clang-format --dry-run -Werror; then
  echo "format the files above with: clang-format -i FILE"
  exit 1
fi
