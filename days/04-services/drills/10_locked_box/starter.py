"""Write a whole node, from the first line to the last.

It is called box. It serves /lock (std_srvs/srv/SetBool), and is open at first. With
data true it locks itself, with false it opens: success True, message "locked" or
"open". Where it is so already: success False, message "nothing changed".
"""
