"""asyncio keeps the time, and lets ROS have its turn now and then."""

import asyncio

import rclpy
from std_msgs.msg import String


async def talk(node):
    """Twice a second."""
    voice = node.create_publisher(String, "chatter", 10)
    loop = asyncio.get_running_loop()
    count, due_s = 0, loop.time()
    while rclpy.ok():
        voice.publish(String(data=f"Hello robotics {count}"))
        count += 1
        due_s += 0.5
        await asyncio.sleep(max(0.0, due_s - loop.time()))


async def turn(node):
    """ROS's turn."""
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.0)
        await asyncio.sleep(0.01)


async def both(node):
    """Side by side."""
    await asyncio.gather(talk(node), turn(node))


rclpy.init()
try:
    asyncio.run(both(rclpy.create_node("talker")))
except KeyboardInterrupt:
    pass
finally:
    rclpy.try_shutdown()
