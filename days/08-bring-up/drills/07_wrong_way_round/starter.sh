# Starts a listener that must hear the topic /news. In its code, the topic is called chatter.

cd "$(mktemp -d)"    # a new, empty folder
cat > ear.launch.xml <<'END'
<launch>
  <node pkg="demo_nodes_py" exec="listener">
    <remap from="/news" to="chatter"/>
  </node>
</launch>
END

ros2 launch ear.launch.xml
