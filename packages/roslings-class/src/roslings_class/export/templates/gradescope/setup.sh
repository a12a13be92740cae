#!/usr/bin/env bash
# Gradescope runs this once, as root, while it builds the image; the network is there.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
course=$here/course

# What no Python package brings; a compiler where the lab has message types that must be built.
missing=()
python3 -c 'import ensurepip, venv' 2>/dev/null || missing+=(python3 python3-venv)
needed=(@SYSTEM@)
for package in "${needed[@]}"; do
    dpkg --status "$package" >/dev/null 2>&1 || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
    apt-get update
    apt-get install -y --no-install-recommends "${missing[@]}"
fi

# With a folder `wheels` beside this file (./roslings wheels DIR) nothing is downloaded.
if [ -d "$here/wheels" ]; then
    export ROSLINGS_WHEELS=$here/wheels
fi

# Another user runs the students' code: it must read Python and the course, and change nothing.
chmod -R go+rX,go-w "$course"

# The trial is the grading that each submission gets, hidden checks included; here it is the
# starter's. It makes the environment (about 80 MB, once). Any verdict shows that grading works.
trial=$(mktemp -d)
ln -s "$here" "$trial/source"
cp -r "$course/labs/@LAB@/starter" "$trial/submission"
(cd "$trial" && bash "$here/run_autograder" --json "$trial/verdict.json")
if [ ! -s "$trial/verdict.json" ]; then
    echo "roslings cannot grade here: see above." >&2
    exit 1
fi
rm -rf "$trial"
echo "roslings can grade here."
