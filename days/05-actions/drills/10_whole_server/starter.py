"""Write a whole node, from the first line to the last.

It is called pump, and performs /fill (rover_interfaces/action/Charge). Its tank is
empty at first: 0 percent. It goes up in steps of 20 percent to the target, with a
feedback after each step, and ends with success and the level as its result.
The tank stays as full as it is: the next goal goes on from there.
"""
