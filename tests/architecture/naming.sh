#!/usr/bin/env bash
# Names in every .cpp of the product and in the headers it reads, as .clang-tidy says; and that each source says itself
# what it includes, which the presets that compile a library as one do not show.
# naming.sh ROOT BUILD [all]: works in BUILD. A file that passed is not read again until it, a header or the rules change.
# Where git knows the commit in `checked`, only what differs from it is read, unless told `all`.
# Exit 77 (skipped) without clang-tidy.
set -euo pipefail
root=$(realpath "$1") build=$(realpath "$2") extent=${3:-changed}

if ! command -v clang-tidy >/dev/null; then
  echo "SKIPPED: clang-tidy is not installed, names were not checked (apt-get install clang-tidy)"
  exit 77
fi

# Every source by itself, and what the build writes for them.
alone=$build/names
cmake -S "$root" -B "$alone" -G Ninja -DBUILD_TESTING=OFF >/dev/null 2>&1
cmake --build "$alone" --target render/shaders/shader_sources.inc >/dev/null
# As a target of the build it would wait for every library below it.
embed() {
  cmake -DFOLDER="$root/app/$1" -DFILES="$(cd "$root/app/$1" && printf '%s\n' *.toml | paste -sd,)" \
    -DOUT="$alone/app/$2" -P "$root/app/text/embed_toml.cmake"
}
embed procedure/steps procedure/steps/shipped_procedures.inc
embed procedure/coach procedure/coach/shipped_coach.inc
embed study/questionnaires study/shipped_questionnaires.inc

passed=$build/naming_passed
mkdir -p "$passed"
cd "$root"
# shellcheck source-path=SCRIPTDIR source=changed.sh
. tests/architecture/changed.sh
# shellcheck disable=SC2086 # a list of folders
rules=$({ cat .clang-tidy; find ${folders//|/ } -name '*.h' -print0 | sort -z | xargs -0 cat; } |
  sha256sum | cut -c1-64)

# Every source; or those that changed, and for a header that changed one that reads it.
sources=$(sed -nE 's|^ *"file": "(.*\.cpp)",?$|\1|p' "$alone/compile_commands.json" | grep -E "^$root/($folders)/" | sort -u)
if [ "$extent" != all ] && changed=$(changed .clang-tidy); then
  sources=$(while read -r file; do
    case $file in
      *.cpp) grep -Fx "$root/$file" <<<"$sources" || true ;;
      *.h) xargs grep -lF "#include \"$file\"" <<<"$sources" | head -n 1 || true ;;
    esac
  done <<<"$changed" | sort -u)
fi

# The product's own sources, as the build compiles them, that have not passed as they are.
waiting=()
while read -r source; do
  key=$(printf '%s %s %s' "$rules" "$source" "$(sha256sum <"$source")" | sha256sum | cut -c1-64)
  [ -e "$passed/$key" ] || waiting+=("$source $key")
done < <(grep . <<<"$sources" || true)

# clang may stumble over a third party's header that only g++ reads; only what is ours is judged here.
check() {
  read -r source key <<<"$1"
  said=$(clang-tidy -p "$alone" --quiet --extra-arg=-w "$source" 2>/dev/null) || true
  if grep -F -A 3 '[readability-identifier-naming' <<<"$said"; then return 1; fi
  if grep -E -A 3 "^$root/.*: error: " <<<"$said"; then return 1; fi
  touch "$passed/$key"
}
export -f check
export alone passed root
if ((${#waiting[@]} > 0)) && ! printf '%s\n' "${waiting[@]}" | xargs -P "$(nproc)" -d '\n' -I '{}' bash -c 'check "{}"'; then
  echo "the names above do not follow .clang-tidy, or a source does not stand alone"
  exit 1
fi
echo "${#waiting[@]} sources read, the rest had passed before"
