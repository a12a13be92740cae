#!/usr/bin/env bash
# Grade one submission: bash grade.sh FOLDER. The reporter reads the step's output `result`.
set -u
submission=$(cd -- "$1" && pwd -P) || exit 1
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

"$here/course/roslings" check @LAB@ "$submission" --classroom "$place/result.json"
echo "exit code of the check: $?"

if [ ! -s "$place/result.json" ]; then
    message="This was not graded, and that is no fault of yours: tell your instructor."
    printf '{"version": 1, "status": "error", "max_score": 0, "tests": [%s]}\n' \
        "{\"name\": \"submission\", \"status\": \"error\", \"score\": 0, \"message\": \"$message\"}" \
        >"$place/result.json"
fi
echo "result=$(base64 -w0 <"$place/result.json")" >>"${GITHUB_OUTPUT:-/dev/stdout}"
