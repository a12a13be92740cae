#!/usr/bin/env bash
# The entry point: PrairieLearn runs it for each submission. The folder is /grade. prepare.sh runs it
# as a trial, in another folder and with more options for the check.
set -u
place=${1:-/grade}
[ $# -eq 0 ] || shift
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
results=$place/results/results.json
mkdir -p "$place/results"
chmod 700 "$place/results"
cd "$here" || exit 1
[ ! -e course/graders/hidden_checks.py ] || chmod 600 course/graders/hidden_checks.py

course/roslings check @LAB@ "$place/student" @HIDDEN@ --prairielearn "$results" "$@"
echo "exit code of the check: $?"

if [ ! -s "$results" ]; then
    message="This was not graded, and that is no fault of yours: tell your instructor."
    printf '{"gradable": false, "format_errors": ["%s"]}\n' "$message" >"$results"
fi
