# shellcheck shell=bash
# For naming.sh and headers.sh: the product's sources and headers, from the ROOT, that differ from the commit in `checked`,
# at which everything had been read and was good. changed RULES fails where git does not know that commit or the file of
# rules differs from it: then everything is to be read.
folders='calibration|assets|haptics|render|app'
changed() {
  local since
  since=$(git rev-parse -q --verify "$(cat tests/architecture/checked)^{commit}" 2>/dev/null) || return 1
  git diff --quiet "$since" -- "$1" || return 1
  { git diff --name-only --diff-filter=d "$since" && git ls-files --others --exclude-standard; } |
    grep -E "^($folders)/.*\.(cpp|h)$" | sort -u || true
}
