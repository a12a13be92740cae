#!/bin/bash
# VPL runs this first; what it runs then, and reads the grade from, is vpl_execution.
cat >vpl_execution <<'END'
#!/bin/bash
[ ! -f vpl_environment.sh ] || . ./vpl_environment.sh
roslings=${ROSLINGS_COURSE:-/opt/roslings-@LAB@/course}/roslings
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
"$roslings" check @LAB@ "$PWD" --vpl "$place/result" >"$place/log" 2>&1
if [ -s "$place/result" ]; then
    # The grade is of 100; VPL wants it between its own lowest and highest.
    awk -v low="${VPL_GRADEMIN:-0}" -v high="${VPL_GRADEMAX:-100}" '
        /^Grade :=>>/ { printf "Grade :=>> %.2f\n", low + (high - low) * $3 / 100; next }
        { print }' "$place/result"
else
    echo "Comment :=>>This was not graded, and that is no fault of yours: tell your instructor."
fi
END
chmod +x vpl_execution
