#!/usr/bin/env bash
# Run once while the image is built. While grading, PrairieLearn gives the container no network.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)

# What no Python package brings; a compiler where the lab has message types that must be built.
missing=()
needed=(@SYSTEM@)
for package in "${needed[@]}"; do
    dpkg --status "$package" >/dev/null 2>&1 || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
    apt-get update
    apt-get install -y --no-install-recommends "${missing[@]}"
    rm -rf /var/lib/apt/lists/*
fi

if [ -d "$here/wheels" ]; then
    export ROSLINGS_WHEELS=$here/wheels
fi
chmod -R go+rX,go-w "$here/course"

# The trial is the grading that each submission gets, hidden checks included; here it is the
# starter's. It makes the environment (about 80 MB, once). Any verdict shows that grading works.
trial=$(mktemp -d)
cp -r "$here/course/labs/@LAB@/starter" "$trial/student"
bash "$here/grade.sh" "$trial" --json "$trial/verdict.json"
if [ ! -s "$trial/verdict.json" ]; then
    echo "roslings cannot grade here: see above." >&2
    exit 1
fi
rm -rf "$trial"
echo "roslings can grade here."
