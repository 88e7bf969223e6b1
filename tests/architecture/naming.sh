#!/usr/bin/env bash
# Names in every .cpp of the product and in the headers it reads, as .clang-tidy says.
# naming.sh ROOT BUILD: BUILD has the compile_commands.json. A file that passed is not read again until it, a header or
# the rules change. Exit 77 (skipped) without clang-tidy.
set -euo pipefail
root=$1 build=$2

if ! command -v clang-tidy >/dev/null; then
  echo "SKIPPED: clang-tidy is not installed, names were not checked (apt-get install clang-tidy)"
  exit 77
fi

passed=$build/naming_passed
mkdir -p "$passed"
cd "$root"
rules=$({ cat .clang-tidy; find calibration assets haptics render app -name '*.h' -print0 | sort -z | xargs -0 cat; } |
  sha256sum | cut -c1-64)

# The product's own sources, as the build compiles them, that have not passed as they are.
waiting=()
while read -r source; do
  key=$(printf '%s %s %s' "$rules" "$source" "$(sha256sum <"$source")" | sha256sum | cut -c1-64)
  [ -e "$passed/$key" ] || waiting+=("$source $key")
done < <(sed -nE 's|^ *"file": "(.*\.cpp)",?$|\1|p' "$build/compile_commands.json" |
  grep -E "^$root/(calibration|assets|haptics|render|app)/" | sort -u)

# clang may stumble over a third party's header that only g++ reads; only names are judged here.
check() {
  read -r source key <<<"$1"
  said=$(clang-tidy -p "$build" --quiet --extra-arg=-w "$source" 2>/dev/null) || true
  if grep -F -A 3 '[readability-identifier-naming' <<<"$said"; then return 1; fi
  touch "$passed/$key"
}
export -f check
export build passed
if ! printf '%s\n' "${waiting[@]}" | grep . | xargs -r -P "$(nproc)" -d '\n' -I '{}' bash -c 'check "{}"'; then
  echo "the names above do not follow .clang-tidy"
  exit 1
fi
echo "${#waiting[@]} sources read, the rest had passed as they are"
