"""Script: a wind that blows as it is told, and gives signs of life itself.

python wind.py '{"topic": "/wind", "lease_s": 4.0, "deadline_s": 1.5}'

<- {"blow": 23.5}
-> {"ready": true}  {"matched": COUNT}  {"blown": 23.5}
"""

from __future__ import annotations

import json
import sys
import threading
from typing import Any

AGAIN_S = 0.1


class Wind:
    """One node; it blows the same again and again."""

    def __init__(self, plan: dict[str, Any]) -> None:
        from rclpy.duration import Duration
        from rclpy.node import Node
        from rclpy.qos import LivelinessPolicy, QoSProfile
        from std_msgs.msg import Float64

        self.node = Node("_roslings_wind", start_parameter_services=False, enable_rosout=False)
        self._message, self._told, self._matched = Float64(data=1.0), 1.0, 0
        profile = QoSProfile(
            depth=10,
            deadline=Duration(seconds=plan["deadline_s"]),
            liveliness=LivelinessPolicy.MANUAL_BY_TOPIC,
            liveliness_lease_duration=Duration(seconds=plan["lease_s"]),
        )
        self._publisher = self.node.create_publisher(Float64, plan["topic"], profile)
        self.node.create_timer(AGAIN_S, self._blow)
        tell(ready=True)

    def obey(self, words: dict[str, Any]) -> None:
        """Blow so hard, once."""
        self._told = float(words["blow"])

    def _blow(self) -> None:
        speed_m_s, self._told = self._told, 1.0
        self._message.data = speed_m_s
        self._publisher.publish(self._message)
        if speed_m_s > 1.0:
            tell(blown=speed_m_s)
        if (count := self._publisher.get_subscription_count()) != self._matched:
            self._matched = count
            tell(matched=count)


def tell(**words: object) -> None:
    """One line to whoever began this."""
    print(json.dumps(words), flush=True)


def main(plan: dict[str, Any]) -> None:
    """Blow until nobody tells us anything any more."""
    import rclpy
    from rclpy.executors import ExternalShutdownException

    rclpy.init(args=["--ros-args", "--disable-external-lib-logs"])
    wind = Wind(plan)

    def listen() -> None:
        for line in sys.stdin:
            wind.obey(json.loads(line))
        rclpy.try_shutdown()

    threading.Thread(target=listen, daemon=True).start()
    try:
        rclpy.spin(wind.node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main(json.loads(sys.argv[1]))
