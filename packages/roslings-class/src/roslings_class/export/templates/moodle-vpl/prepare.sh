#!/usr/bin/env bash
# Once on each execution server, in /opt/roslings-@LAB@: the environment, about 80 MB.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
if [ -d "$here/wheels" ]; then
    export ROSLINGS_WHEELS=$here/wheels
fi
chmod -R go+rX,go-w "$here"

# The trial is a grading of the starter. Any verdict shows that grading works.
trial=$(mktemp -d)
"$here/course/roslings" check @LAB@ "$here/course/labs/@LAB@/starter" \
    --vpl "$trial/result" --json "$trial/verdict.json" || echo "exit code of the check: $?"
chmod -R go+rX,go-w "$here"
if [ ! -s "$trial/verdict.json" ]; then
    echo "roslings cannot grade here: see above." >&2
    exit 1
fi
rm -rf "$trial"
echo "roslings can grade here."
