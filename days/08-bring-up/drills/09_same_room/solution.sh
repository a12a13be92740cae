# Starts two talkers: /left/talker on /left/chatter, /right/talker on /right/chatter.

cd "$(mktemp -d)"    # a new, empty folder
cat > rooms.launch.xml <<'END'
<launch>
  <group>
    <push_ros_namespace namespace="left"/>
    <node pkg="demo_nodes_py" exec="talker"/>
  </group>
  <group>
    <push_ros_namespace namespace="right"/>
    <node pkg="demo_nodes_py" exec="talker"/>
  </group>
</launch>
END

ros2 launch rooms.launch.xml
