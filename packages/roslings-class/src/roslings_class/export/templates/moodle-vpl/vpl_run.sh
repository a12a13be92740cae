#!/bin/bash
# The button Run: the same check, as a student reads it in a terminal, without a grade.
cat >vpl_execution <<'END'
#!/bin/bash
roslings=${ROSLINGS_COURSE:-/opt/roslings-@LAB@/course}/roslings
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
"$roslings" check @LAB@ "$PWD" --check50 "$place/result"
END
chmod +x vpl_execution
