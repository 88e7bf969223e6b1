#!/usr/bin/env bash
# Reads every source and header by naming.sh and headers.sh, ten minutes and more, and where all is good moves the mark
# `checked` to the commit that was read. everything.sh ROOT BUILD, nothing uncommitted.
set -euo pipefail
root=$(realpath "$1") build=$(realpath "$2") here=$(dirname "$0")
[ -z "$(git -C "$root" status --porcelain)" ] || { echo "commit first: the mark names a commit"; exit 1; }
"$here/headers.sh" "$root" "$build" all
"$here/naming.sh" "$root" "$build" all
git -C "$root" rev-parse HEAD >"$root/tests/architecture/checked"
