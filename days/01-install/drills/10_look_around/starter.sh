# Beside this script, a talker runs. Write two commands that show
#   1. which nodes there are
#   2. which topics there are, each with its type
