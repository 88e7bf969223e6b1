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
cmake -DFOLDER="$root/app/evaluation/console/web" -DOUT="$alone/app/evaluation/page_files.inc" \
  -DFILES="$(cd "$root/app/evaluation/console/web" && printf '%s\n' *.html *.css *.js | paste -sd,)" \
  -P "$root/app/evaluation/console/embed_page.cmake"

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

# Those of one library are read together, as the presets compile them: most of a reading is the headers.
units=$alone/units
rm -rf "$units" && mkdir -p "$units"
printf '%s\n' "${waiting[@]}" >"$units/waiting"
sed -nE 's/^ *"(command|file)": "(.*)",?$/\2/p' "$alone/compile_commands.json" | paste - - |
  awk -v units="$units" -v directory="$alone" '
    NR == FNR { split($0, one, " "); key[one[1]] = one[2]; next }
    {
      split($0, both, "\t"); command = both[1]; source = both[2]
      if (!(source in key)) next
      place = match(command, / -o .*CMakeFiles\/[^\/]*\.dir\//)
      library = substr(command, place, RLENGTH); sub(/.*CMakeFiles\//, "", library); sub(/\.dir\/$/, "", library)
      before = substr(command, 1, place - 1)
      unit = units "/" library ".cpp"
      print "#include \"" source "\"" > unit
      print source, key[source] > (units "/" library ".sources")
      # As a shell reads it.
      gsub(/\\"/, "\"", before); gsub(/\\\\/, "\\", before)
      print before " -fsyntax-only " source > (units "/" library ".alone")
      delete key[source]
      if (library in read) next
      read[library] = 1
      escaped = substr(command, 1, place - 1)
      entry = "{\"directory\": \"" directory "\", \"command\": \"" escaped " -c " unit "\", \"file\": \"" unit "\"}"
      entries = entries (entries == "" ? "" : ",\n") entry
    }
    END { print "[" entries "]" > (units "/compile_commands.json") }' "$units/waiting" -

# Prints what is wrong in a file and returns 1. clang may stumble over a third party's header that only g++ reads; only
# what is ours is judged here.
named() {
  local said
  said=$(clang-tidy -p "$1" --config-file="$root/.clang-tidy" --quiet --extra-arg=-w "$2" 2>/dev/null) || true
  if grep -F -A 3 '[readability-identifier-naming' <<<"$said"; then return 1; fi
  if grep -E -A 3 "^$root/.*: error: " <<<"$said"; then return 1; fi
}
# A library's sources together; where that says no, one by one.
check() {
  local library=$1 source key good=0
  if named "$units" "$units/$library.cpp" >/dev/null; then
    # By itself, each: what it does not include would come from its neighbour.
    while read -r line; do bash -c "cd '$alone' && $line" || good=1; done <"$units/$library.alone"
    [ "$good" = 0 ] || return 1
    while read -r source key; do touch "$passed/$key"; done <"$units/$library.sources"
    return 0
  fi
  while read -r source key; do
    if named "$alone" "$source"; then touch "$passed/$key"; else good=1; fi
  done <"$units/$library.sources"
  return "$good"
}
export -f named check
export alone passed root units
if ((${#waiting[@]} > 0)) && ! (cd "$units" && ls -- *.sources) | sed 's/\.sources$//' |
  xargs -P "$(nproc)" -d '\n' -I '{}' bash -c 'check "{}"'; then
  echo "the names above do not follow .clang-tidy, or a source does not stand alone"
  exit 1
fi
echo "${#waiting[@]} sources read, the rest had passed before"
