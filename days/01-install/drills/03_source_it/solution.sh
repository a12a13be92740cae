# Writes a setup file into a new, empty folder, reads it, and tells which robot it names.

cd "$(mktemp -d)"
echo 'export ROBOT=rover' > rover.bash

source ./rover.bash
echo "the robot is $ROBOT"
