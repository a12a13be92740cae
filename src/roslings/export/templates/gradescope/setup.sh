#!/usr/bin/env bash
# Gradescope runs this once, as root, while it builds the image; the network is there.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
course=$here/course

if ! python3 -c 'import ensurepip, venv' 2>/dev/null; then
    apt-get update
    apt-get install -y --no-install-recommends python3 python3-venv
fi

# With a folder `wheels` beside this file (./roslings wheels DIR) nothing is downloaded.
if [ -d "$here/wheels" ]; then
    export ROSLINGS_WHEELS=$here/wheels
fi

# Another user runs the students' code: it must read Python and the course, and change nothing.
chmod -R go+rX,go-w "$course"

# Makes the environment (about 80 MB, once) and grades the starter, to show that grading works here.
# 1: a check failed, as it must; 3: the machine was too busy to tell.
result=$(mktemp)
status=0
"$course/roslings" check @LAB@ "$course/labs/@LAB@/starter" --gradescope "$result" || status=$?
rm -f "$result"
case $status in
    0 | 1 | 3) echo "roslings can grade here." ;;
    *) echo "roslings cannot grade here: see above." >&2; exit 1 ;;
esac
