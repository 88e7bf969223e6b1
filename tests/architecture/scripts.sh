#!/usr/bin/env bash
# Every shell script through shellcheck. scripts.sh FILE… Exit 77 (skipped) without shellcheck.
set -euo pipefail
if ! command -v shellcheck >/dev/null; then
  echo "SKIPPED: shellcheck is not installed, scripts were not checked (apt-get install shellcheck)"
  exit 77
fi
shellcheck -x "$@"
echo "$# scripts are sound"
