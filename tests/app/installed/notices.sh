#!/bin/sh
# notices.sh PROGRAM COPYRIGHT [EXCEPT]: each C++ namespace of other projects in PROGRAM is named in COPYRIGHT, on a line
# "Comment: Namespace NAME." or "Comment: Namespaces NAME, NAME." A notice of namespace EXCEPT is ignored. Prints the
# namespaces without a notice.
set -eu
found=$(nm -C --defined-only "$1" | cut -c20- | grep -oE '(^|[^A-Za-z0-9_:>)}])[A-Za-z_][A-Za-z0-9_]*::' |
  grep -oE '[A-Za-z_][A-Za-z0-9_]*' | sed 's/^Im[A-Z].*/ImGui/' | sort -u |
  grep -vxE 'app|assets|calibration|haptics|render|const')
noticed=$(sed -nE 's/^Comment: Namespaces? ([^.]*)\..*/\1/p' "$2" | tr -s ', ' '\n' | grep -vxF "${3:- }")
if missing=$(echo "$found" | grep -vxF "$noticed"); then
  echo "no notice of: $(echo "$missing" | tr '\n' ' ')"
  exit 1
fi
