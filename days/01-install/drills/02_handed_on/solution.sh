# Names the robot, and starts a program that tells which robot it has.

unset ROBOT
export ROBOT=rover
python3 -c 'import os; print("the robot is", os.environ.get("ROBOT"))'
