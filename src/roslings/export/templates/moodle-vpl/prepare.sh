#!/usr/bin/env bash
# Once on each execution server, in /opt/roslings-@LAB@: the environment, about 80 MB.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
if [ -d "$here/wheels" ]; then
    export ROSLINGS_WHEELS=$here/wheels
fi
chmod -R go+rX,go-w "$here"
result=$(mktemp)
status=0
"$here/course/roslings" check @LAB@ "$here/course/labs/@LAB@/starter" --vpl "$result" || status=$?
rm -f "$result"
chmod -R go+rX,go-w "$here"
case $status in
    0 | 1 | 3) echo "roslings can grade here." ;;
    *) echo "roslings cannot grade here: see above." >&2; exit 1 ;;
esac
