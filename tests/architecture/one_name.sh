#!/usr/bin/env bash
# A type has one home: no two files define the same name in the same namespace. The linker keeps one of two such types'
# functions without a word, and whoever uses the other crashes. one_name.sh ROOT
set -euo pipefail
cd "$1"
shopt -s globstar nullglob
files=({app,render,haptics,assets,calibration,tests}/**/*.{h,cpp})
[ "${#files[@]}" -gt 0 ] || { echo "no sources under $1" && exit 1; }
# What stands in an anonymous namespace is its file's own; what is declared and defined within one concept has one home.
awk '
  FNR == 1 { space = ""; own = 0 }
  /^namespace \{/ { own = 1 }
  /^\}  \/\/ namespace$/ { own = 0 }
  /^namespace [A-Za-z_:]+ \{/ { space = space "::" $2 }
  /^(struct|class|union|enum class) [A-Za-z_]+[^;]*\{/ && !own {
    name = $1 == "enum" ? $3 : $2
    key = space "::" name
    if (key in home && home[key] != FILENAME) {
      print key " is defined in " home[key] " and in " FILENAME
      twice = 1
    }
    home[key] = FILENAME
    ++types
  }
  END {
    print types + 0 " types, each with one home" > (twice || !types ? "/dev/null" : "/dev/stdout")
    exit twice || !types
  }' "${files[@]}"
