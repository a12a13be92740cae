# Reads a setup file, and tells which robot it names.

echo 'export ROBOT=rover' > "$HOME/setup.bash"

bash "$HOME/setup.bash"
echo "the robot is $ROBOT"
