#!/usr/bin/env bash
# The pages in Debian's Chromium. run.sh BUILD PROGRAM CACHE FILE.test.js…
# Installs the npm packages of package-lock.json into BUILD where they are missing. Exit 77 (skipped) where Chromium, node
# or those packages cannot be had. By hand, for figures: MOLAR_KEYS=200 MOLAR_STRICT=1, MOLAR_STANDS_MS=30000.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$1
export MOLAR_PROGRAM=$2 XDG_CACHE_HOME=$3
shift 3

skip() {
  echo "SKIPPED: $1; the pages were not looked at in a browser (apt-get install chromium nodejs npm)"
  exit 77
}
for program in chromium node npm; do
  command -v "$program" >/dev/null || skip "$program is not installed"
done
node -e 'process.exit(Number(process.versions.node.split(".")[0]) < 18 ? 1 : 0)' || skip "node is older than 18"

# One of several tests installs, the others wait for it.
mkdir -p "$build"
(
  flock 9
  if ! cmp -s "$here/package-lock.json" "$build/installed-lock.json"; then
    cp "$here/package.json" "$here/package-lock.json" "$build/"
    (cd "$build" && npm ci --ignore-scripts --no-audit --no-fund >npm.log 2>&1) || exit 1
    cp "$build/package-lock.json" "$build/installed-lock.json"
  fi
) 9>"$build/lock" || skip "the npm packages cannot be had ($build/npm.log)"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# Modules by their own package.json, as older versions of node ask for.
mkdir "$scratch/web"
cp "$here"/../../app/evaluation/console/web/*.js "$scratch/web/"
echo '{ "type": "module" }' >"$scratch/web/package.json"
export MOLAR_NODE_MODULES=$build/node_modules MOLAR_PAGES_SCRATCH=$scratch MOLAR_PAGES_WEB=$scratch/web
# Chromium's own files, too, go with the test.
export TMPDIR=$scratch

files=()
for file in "$@"; do files+=("$here/$file"); done
node --test "${files[@]}"
