#!/usr/bin/env bash
# Compiles public headers alone. headers.sh ROOT BUILD [all]: those that differ from the commit in `checked`, and those
# that read one of them; all of them where git does not know that commit, or when told.
set -euo pipefail
root=$(realpath "$1") build=$(realpath "$2") extent=${3:-changed}
cd "$root"
# shellcheck source-path=SCRIPTDIR source=changed.sh
. tests/architecture/changed.sh

proved=$(ninja -C "$build" -t inputs all_verify_interface_header_sets | grep '_verify_interface_header_sets/.*\.h\.cxx$')
if [ "$extent" != all ] && found=$(changed CMakeLists.txt); then
  # Who reads them, who reads those, until no more come.
  for ((known = -1; known != $(wc -l <<<"$found"); )); do
    known=$(wc -l <<<"$found")
    # shellcheck disable=SC2086 # a list of folders
    read_by=$(xargs -d '\n' printf '#include "%s"\n' <<<"$found" | grep -rlFf - --include='*.h' ${folders//|/ } || true)
    found=$(printf '%s\n%s\n' "$found" "$read_by" | grep . | sort -u || true)
  done
  proved=$(grep -Ff <(grep '\.h$' <<<"$found" | sed 's|.*|_verify_interface_header_sets/&.cxx|') <<<"$proved" || true)
fi
count=$(grep -c . <<<"$proved" || true)
# What ninja makes of a file is that file's name with a ^.
if [ "$count" -gt 0 ]; then xargs -d '\n' -I '{}' printf '{}^\n' <<<"$proved" | xargs -d '\n' ninja -C "$build"; fi
echo "$count headers compiled alone"
