# Says hello on /news ten times a second. Meanwhile, hears it once.

ros2 topic pub --rate 10 /news std_msgs/msg/String "data: hello" &
ros2 topic echo --once /news std_msgs/msg/String
