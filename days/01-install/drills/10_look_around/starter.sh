# A talker runs. Write two commands that show
#   1. which nodes there are
#   2. which topics there are, each with its type
# The drill runs that talker beside this script. By hand, start it first, in another
# terminal: python3 talker.py
